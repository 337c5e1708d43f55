//! The full level, that of a gain of 1: by default the largest that stays within linear theory.

use crate::drive_cache::pulse_felt;
use crate::{FocusDrive, FocusWorker, Full, LiveError};
use std::fmt;
use unripple_core::{Point, Surface};
use unripple_physics::design::{LinearLevel, linearity};

/// The full level of a surface: what a gain of 1 in an effect stands for.
///
/// A drive at the limit may move a sheet by many times its thickness, where it is no longer linear. So a
/// full pulse moves the sheet as far as linear theory allows ([`LinearLevel`]: nowhere by more than half its
/// thickness), unless the drive limit in the surface file is lower or is requested.
#[derive(Clone, Copy, Debug)]
pub struct Level {
    /// Sensation level of a full pulse or waveform, and the place where it is defined; `None` if the full
    /// level is that of the limit in the surface file.
    pub full: Option<Full>,
    /// Displacement at a focus, in m, of a full pulse and at the surface's own limit.
    moved: [f64; 2],
    limit: f64,
    /// Whether the scale of the responses is known.
    scaled: bool,
}

impl Level {
    /// The full level of a surface: that of a pulse that moves the sheet as far as linear theory allows. It
    /// is the level of a drive at the limit in the surface file if that is lower, or if `limited` is true.
    ///
    /// # Errors
    /// Those of [`FocusWorker::focus`] and [`FocusWorker::reach`].
    pub fn of(surface: &Surface, maker: &FocusWorker, limited: bool) -> Result<Self, LiveError> {
        let limit = surface.emission.limit;
        let (width, height) = surface.outline.extent();
        let place = surface.outline.nearest(Point::new(0.41 * width, 0.6 * height));
        let made = maker.focus(&[place])?;
        let trace = maker.trace(&made)?;
        let most = trace.iter().fold(0.0, |m: f64, u| m.max(u.abs()));
        let share = if limited { None } else { Self::linear(surface, maker, &made)? };
        let Some(share) = share.filter(|share| *share < 1.0) else {
            return Ok(Self { full: None, moved: [most, most], limit, scaled: true });
        };
        let felt_db = 20.0 * (share * pulse_felt(&made, &trace)).log10();
        Ok(Self { full: Some(Full { place, felt_db }), moved: [share * most, most], limit, scaled: true })
    }

    /// The full level for responses of unknown scale: since displacements are unknown, it is the level of a
    /// drive at the limit in the surface file.
    ///
    /// # Errors
    /// Those of [`Level::of`].
    pub fn without_scale(surface: &Surface, maker: &FocusWorker) -> Result<Self, LiveError> {
        Ok(Self { scaled: false, ..Self::of(surface, maker, true)? })
    }

    /// The factor on a drive at the limit that linear theory allows; `None` where that is not known.
    fn linear(surface: &Surface, maker: &FocusWorker, made: &FocusDrive) -> Result<Option<f64>, LiveError> {
        let reach = maker.reach(made)?;
        let steep = reach.steepness.unwrap_or_default();
        let (slope, square) = (steep.slope, steep.mean_square_slope);
        let found = linearity(surface, reach.displacement, slope, square, steep.curvature);
        Ok(LinearLevel::of(surface, &found).map(|level| level.factor))
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [used, own] = self.moved.map(|u| u * 1e6);
        match self.full {
            _ if !self.scaled => {
                write!(f, "full level the surface's limit of {}: its displacement is unknown", self.limit)
            }
            Some(full) => write!(
                f,
                "full level {:.0} dB above the threshold of touch, a pulse of {used:.1} µm; the surface's limit of {} would move it \
                 by {own:.0} µm (--full-limit)",
                full.felt_db, self.limit
            ),
            None => write!(f, "full level the surface's limit of {}: a pulse of {used:.1} µm", self.limit),
        }
    }
}
