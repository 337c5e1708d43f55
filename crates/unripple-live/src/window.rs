//! The focusing window of live play: a compromise between latency and contrast.

use unripple_core::Surface;
use unripple_physics::design::{Recommended, Windows, milliseconds};

/// Fraction of the largest contrast that is enough: a longer window is not worth the time it takes.
const WORTH: f64 = 0.75;

/// The focusing window of live play, and the contrast expected with it.
///
/// A focus comes one whole window after the touch that asked for it, so the window is latency. Contrast at first
/// grows like the square root of the window, then saturates when responses have decayed: beyond three quarters of the
/// largest contrast, each millisecond gains little. More actuators reach the same contrast in a shorter window (Hudin
/// et al. 2012, section 3).
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
    /// Length of the window, in s: from the first sample to the focus.
    pub seconds: f64,
    /// Contrast expected with this window.
    pub contrast: f64,
    /// The window that `design` recommends where latency does not matter, in s.
    pub unhurried: f64,
    /// The largest contrast expected of any window.
    pub largest: f64,
    /// The shortest window whose contrast is within half a per cent of the largest, in s.
    pub largest_at: f64,
}

impl Window {
    /// The shortest window that reaches three quarters of the largest contrast ([`Windows`]).
    pub fn prompt(surface: &Surface) -> Self {
        Self::prompt_within(surface, f64::INFINITY)
    }

    /// The shortest window that reaches three quarters of the largest contrast, but at most `longest`, the duration
    /// of the responses in s.
    pub fn prompt_within(surface: &Surface, longest: f64) -> Self {
        Self::prompt_and(surface, longest, None).0
    }

    /// The window of [`Window::prompt_within`], and a second window of `asked` s, which equals the first if
    /// `asked` is `None`. The modes are computed only once for both.
    pub fn prompt_and(surface: &Surface, longest: f64, asked: Option<f64>) -> (Self, Self) {
        let windows = Windows::of(surface);
        let prompt = Self::among(&windows, windows.shortest(WORTH).seconds.min(longest), longest);
        (prompt, asked.map_or(prompt, |seconds| Self::among(&windows, seconds, longest)))
    }

    /// A window of a given length in s, with its expected contrast.
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
