//! The focusing window of live play: short, for latency, against contrast.

use unripple_core::Surface;
use unripple_physics::design::{Recommended, Windows, milliseconds};

/// Share of the largest contrast below which a shorter window is not worth the time it saves.
const WORTH: f64 = 0.75;

/// The window that live play uses, and what it costs.
///
/// A focus comes a whole window after the touch that asked for it, so the window is latency. Contrast grows like its square
/// root at first and then stops, as the surface forgets: past three quarters of the largest, each millisecond buys little. More
/// actuators reach the same contrast in a shorter one (Hudin et al. 2012, section 3).
///
/// ```
/// use unripple_live::Window;
/// use unripple_physics::design::papers_surface;
///
/// let window = Window::prompt(&papers_surface());
/// assert!(window.seconds < window.unhurried && window.contrast > 0.7 * window.largest);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// The window, in s: from the first sample to the focus.
    pub seconds: f64,
    /// Contrast to be expected with it.
    pub contrast: f64,
    /// The window that `design` recommends where nobody waits, in s.
    pub unhurried: f64,
    /// The largest contrast to be expected of any.
    pub largest: f64,
    /// The shortest window within half a per cent of it, in s.
    pub largest_at: f64,
}

impl Window {
    /// The shortest that reaches three quarters of the largest contrast ([`Windows`]).
    pub fn prompt(surface: &Surface) -> Self {
        Self::prompt_within(surface, f64::INFINITY)
    }

    /// The shortest window that reaches three quarters of the largest contrast, or the longest that responses last,
    /// in s.
    pub fn prompt_within(surface: &Surface, longest: f64) -> Self {
        Self::prompt_and(surface, longest, None).0
    }

    /// The same, and the one that was asked for, in s, if one was: the modes are solved for once.
    pub fn prompt_and(surface: &Surface, longest: f64, asked: Option<f64>) -> (Self, Self) {
        let windows = Windows::of(surface);
        let prompt = Self::among(&windows, windows.shortest(WORTH).seconds.min(longest), longest);
        (prompt, asked.map_or(prompt, |seconds| Self::among(&windows, seconds, longest)))
    }

    /// One that was asked for, in s.
    pub fn of(surface: &Surface, seconds: f64) -> Self {
        Self::among(&Windows::of(surface), seconds, f64::INFINITY)
    }

    fn among(windows: &Windows, seconds: f64, longest: f64) -> Self {
        let recommended = windows.recommended().within(longest, windows);
        let Recommended { seconds: unhurried, largest, largest_at, .. } = recommended;
        Self { seconds, contrast: windows.contrast(seconds), unhurried, largest, largest_at }
    }
}

impl std::fmt::Display for Window {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "window {} ms: contrast {:.1}, {:.0} % of the largest ({:.1} at {:.1} ms); `design` recommends {} ms",
            milliseconds(self.seconds),
            self.contrast,
            100.0 * self.contrast / self.largest,
            self.largest,
            1e3 * self.largest_at,
            milliseconds(self.unhurried)
        )
    }
}
