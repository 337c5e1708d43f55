//! Options of live play.

use crate::{Full, LiveError};
use unripple_core::{Emission, Surface};
use unripple_focus::{Method, Options as FocusOptions};
use unripple_player::{Limit, Options as PlayerOptions, Running, WaveOptions};

/// Longest ping that may be sent between effects, in s. A longer one would seldom fit between two touches.
const LONGEST_PING: f64 = 0.15;

/// Longest window of live play, in s: nobody waits that long for the answer to a touch. Windows twice as long need filters of twice the
/// memory.
pub const LONGEST_WINDOW: f64 = 10.0;

/// Options of live play: method, level, waveforms, limits, prediction.
#[derive(Clone, Debug, PartialEq)]
pub struct LiveOptions {
    /// Options of focusing. Their window is the delay of every focus.
    pub focus: FocusOptions,
    /// The full level, which a share of 1 stands for; with `None`, it is that of a drive at its limit.
    pub full: Option<Full>,
    /// Largest number of waveforms at once; 0 for none.
    pub waves: usize,
    /// Time constant of the average power that the rms limit of an actuator applies to, in s.
    pub rms_seconds: f64,
    /// Whether a focus set off by a moving finger is aimed at the place of the finger predicted for the focal
    /// instant.
    pub predict: bool,
}

impl LiveOptions {
    /// Default options for a surface: time reversal with a window of `window` s, the surface's limits, ten
    /// waveforms at once, prediction of moving fingers.
    pub fn new(surface: &Surface, window: f64) -> Self {
        let Emission { limit, .. } = surface.emission;
        let focus = FocusOptions { method: Method::TimeReversal, window, limit, ..FocusOptions::default() };
        Self { focus, full: None, waves: 10, rms_seconds: 1.0, predict: true }
    }

    /// Options of the player, for blocks of `block` samples.
    ///
    /// # Errors
    /// [`LiveError::Range`] for a window that is not above 0 and at most 10 s.
    pub(crate) fn player(&self, surface: &Surface, block: usize) -> Result<PlayerOptions, LiveError> {
        let emission = &surface.emission;
        let window = self.focus.window;
        if !(window > 0.0 && window <= LONGEST_WINDOW) {
            let expected = format!("above 0, at most {LONGEST_WINDOW}");
            return Err(LiveError::Range { what: "window in s", expected, found: window.to_string() });
        }
        let taps = (window * emission.rate).round() as usize + 1;
        let running = |level: f64| Running { level, seconds: self.rms_seconds };
        let limit = Limit { peak: emission.limit, rms: emission.rms_limit.map(running), thermal: None };
        let waves = WaveOptions {
            inputs: self.waves.max(1),
            taps,
            band_top_hz: emission.band[1],
            ..WaveOptions::default()
        };
        Ok(PlayerOptions {
            outputs: surface.actuators.len(),
            block,
            rate: emission.rate,
            limits: vec![limit],
            longest: taps.max((LONGEST_PING * emission.rate) as usize),
            waves: (self.waves > 0).then_some(waves),
            ..PlayerOptions::default()
        })
    }
}

/// Sample rate, window and block length of live play.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Samples per second.
    pub rate: f64,
    /// Time from the beginning of a drive to its focus, in s.
    pub window: f64,
    /// Samples of a block of the player.
    pub block: usize,
}
