use unripple_core::Surface;
use unripple_physics::design::{Cavity, recommended_window};

/// Share of the contrast of an endless window below which a shorter one is not worth the time it saves.
const WORTH: f64 = 0.75;

/// The window that live play uses, and what it costs.
///
/// A focus comes a whole window after the touch that asked for it, so the window is latency. Contrast grows like its square
/// root at first and then stops, as the surface forgets: past three quarters of what an endless window gives, each
/// millisecond buys little. More actuators reach the same contrast in a shorter one (Hudin et al. 2012, section 3).
///
/// ```
/// use unripple_live::Window;
/// use unripple_physics::design::papers_surface;
///
/// let window = Window::prompt(&papers_surface());
/// assert!(window.seconds < window.unhurried && window.contrast > 0.7 * window.endless);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// The window, in s: from the first sample to the focus.
    pub seconds: f64,
    /// Contrast to be expected with it.
    pub contrast: f64,
    /// The window that `design` recommends where nobody waits, in s.
    pub unhurried: f64,
    /// Contrast to be expected with an endless one.
    pub endless: f64,
}

impl Window {
    /// The shortest that reaches three quarters of the contrast of an endless window.
    pub fn prompt(surface: &Surface) -> Self {
        let cavity = Cavity::of(surface, surface.emission.band[1]);
        let count = surface.actuators.len().max(1) as f64;
        Self::of(surface, cavity.window_for(count, WORTH))
    }

    /// One that was asked for, in s.
    pub fn of(surface: &Surface, seconds: f64) -> Self {
        let cavity = Cavity::of(surface, surface.emission.band[1]);
        let count = surface.actuators.len().max(1) as f64;
        let unhurried = recommended_window(surface, None);
        Self {
            seconds,
            contrast: cavity.contrast(count, seconds),
            unhurried,
            endless: cavity.contrast(count, 20.0 * unhurried.max(seconds)),
        }
    }
}

impl std::fmt::Display for Window {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "window {:.1} ms: contrast {:.1}; the unhurried {:.1} ms would come that much later, an endless one would give {:.1}",
            1e3 * self.seconds,
            self.contrast,
            1e3 * self.unhurried,
            self.endless
        )
    }
}
