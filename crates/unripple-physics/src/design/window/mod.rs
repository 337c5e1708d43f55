//! The time-reversal window (the length of the responses that are reversed): contrast (velocity at the
//! focus over the rms elsewhere) against the window, and the recommended window.

mod modal;
mod places;

use super::weyl::Weyl;
use super::{Cavity, Statistics};
use crate::{Accuracy, Medium, Modes, ResponseOptions, accuracy, responses, responses_on};
pub(super) use modal::{Modal, Term, integral};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_core::{Cached, Encoded, Responses, Surface};

/// Share of the largest contrast that the recommended window reaches: a longer window would gain little for
/// its delay. At 1, the window of the largest contrast would be recommended, however long it is.
pub(super) const WORTHWHILE: f64 = 0.9;

/// Least number of times that waves cross the surface in a window, along the mean chord. In a shorter window waves do not
/// reach all of the surface, and the contrast depends on how much of it is silent rather than on the quality of the focus.
/// With twice this value, small surfaces would get windows twice as long.
const CROSSINGS: f64 = 3.0;

/// Description of a window of three crossings, for people.
const CROSSED: &str =
    "in which waves cross the surface three times, the shortest in which they reach every part of it";

/// The longest window that is considered, in seconds; four times the shortest window if that is longer. A
/// window delays the focus by its length, and a longer delay is of no use. Where losses grow with
/// frequency, contrast can keep growing for minutes, as the lowest modes outlast the others. With twice
/// this value, such surfaces get longer windows.
const LONGEST: f64 = 0.5;

/// Share of the largest contrast that counts as equal to it: the window of the largest contrast is taken as the shortest with
/// this share. At 1, it would depend on the last digits of a curve that is nearly flat.
const AS_GOOD: f64 = 0.995;

/// Number of windows computed for each doubling of the window: contrast changes by at most 6 % from one to
/// the next, and is interpolated. With twice this value, the curve takes twice as long.
const PER_DOUBLING: f64 = 6.0;

/// Largest number of modes below the top of the band up to which they are solved for. The work grows as its
/// square, and statistics are accurate for more modes. With twice this value, the largest surfaces take
/// four times as long.
const MOST_MODES: f64 = 2000.0;

/// Contrast of a time-reversed focus as a function of its window T, for the actuators of a surface.
///
/// The contrast is computed from the modes of the surface with the loads of its actuators, for targets spread over the surface away from the
/// rim: 1/C² is the mean over targets of (rms velocity outside the focal disc)²/(velocity at the target)² at the focal instant. For
/// a surface of more than 2000 modes, or whose modes cannot be computed, it is the statistical contrast of [`Cavity`], for a band
/// that begins at the first mode.
///
/// All parts of the software that recommend a window use this, so that they agree.
///
/// ```
/// use unripple_physics::design::{Windows, papers_surface};
///
/// let windows = Windows::of(&papers_surface());
/// let (patient, prompt) = (windows.recommended(), windows.shortest(0.75));
/// assert!(prompt.seconds < patient.seconds && patient.contrast > 0.89 * patient.largest);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Windows {
    /// Pairs of window (s) and contrast, in order of ascending window.
    curve: Vec<(f64, f64)>,
    /// The 5 % and 95 % quantiles of the contrast over targets, for each window; empty where the curve is
    /// computed from statistics.
    spread: Vec<[f64; 2]>,
    /// Expected contrast for any number of actuators, from the modes; `None` where the curve is computed
    /// from statistics of the band.
    by_modes: Option<Statistics>,
    /// Why the curve is computed from statistics; `None` if it is computed from the modes.
    statistics: Option<String>,
}

/// A recommended length of the time-reversal window, its contrast, and the reason for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Recommended {
    /// The recommended window, in s, rounded up to three digits.
    pub seconds: f64,
    /// Expected contrast with the recommended window.
    pub contrast: f64,
    /// The largest contrast among all windows considered.
    pub largest: f64,
    /// The shortest window whose contrast is within half a per cent of the largest, in s.
    pub largest_at: f64,
    /// Whether the recommended window is the shortest one considered, in which waves cross the surface
    /// three times.
    pub at_floor: bool,
    /// Why this window is recommended, in words, without the window's length.
    pub why: String,
}

/// Why the modes of a surface are not solved for, if they are too many.
fn too_many(surface: &Surface) -> Option<String> {
    let top = surface.emission.band[1];
    let below = Weyl::of(surface).below(Medium::of(&surface.sheet).wavenumber(TAU * top));
    let most = below.is_nan() || below > MOST_MODES;
    most.then(|| format!("some {below:.0} modes are too many to be solved for here"))
}

/// Responses to the default accuracy, or to a coarser one if that is all that can be had.
fn options(surface: &Surface) -> ResponseOptions {
    ResponseOptions { accuracy: Accuracy::or_best(accuracy(surface).aim), ..ResponseOptions::default() }
}

impl Recommended {
    /// Limits the recommended window to `longest` (s), the length of the responses; `windows` gives the
    /// contrast at the limit.
    pub fn within(self, longest: f64, windows: &Windows) -> Self {
        if self.seconds <= longest {
            return self;
        }
        let why = format!(
            "the longest that the responses last; {} ms would be better: {}",
            milliseconds(self.seconds),
            self.why
        );
        Self { seconds: longest, contrast: windows.contrast(longest), why, ..self }
    }

    /// Text for people: the length of the window in milliseconds, and why it is recommended.
    pub fn text(&self) -> String {
        format!("{} ms, {}", milliseconds(self.seconds), self.why)
    }
}

impl Windows {
    /// Computes the contrast of a surface against the window, from responses that it computes to the [default accuracy](accuracy).
    pub fn of(surface: &Surface) -> Self {
        if let Some(reason) = too_many(surface) {
            return Self::by_law(surface, reason);
        }
        match responses(surface, &options(surface)) {
            Ok(responses) => Self::on(surface, &responses),
            Err(error) => Self::by_law(surface, error.to_string()),
        }
    }

    /// Computes the contrast of a surface against the window from its responses, computed earlier from the modes of its band. From those
    /// that [`Windows::of`] computes it is the same to the last digit.
    pub fn on(surface: &Surface, responses: &Responses) -> Self {
        if let Some(reason) = too_many(surface) {
            return Self::by_law(surface, reason);
        }
        let Responses::Modal(responses) = responses else {
            return Self::by_law(surface, "its modes are not known");
        };
        let key = || {
            let input: Vec<f64> =
                responses.input.col_iter().flat_map(|column| column.iter()).copied().collect();
            let of = (&responses.ports, &responses.conditions, &responses.poles);
            format!("contrast by window: {surface:?} {of:?} {input:?}")
        };
        let found = Cached::here().result_by(
            key,
            || {
                let modal = Modal::of(responses)?;
                let by_modes = Some(Statistics::on(&modal, responses, Medium::of(&surface.sheet)));
                let along = Self::along(surface, None, modal.settled(), |window| modal.contrast(window));
                Ok::<_, &str>(Self { by_modes, ..along })
            },
            Self::encode,
            Self::decode,
        );
        found.unwrap_or_else(|reason| Self::by_law(surface, reason))
    }

    /// Appends the bytes of contrasts that are computed from modes.
    fn encode(&self, to: &mut Vec<u8>) {
        let curve: Vec<[f64; 2]> = self.curve.iter().map(|(window, contrast)| [*window, *contrast]).collect();
        curve.encode(to);
        self.spread.encode(to);
        if let Some(statistics) = &self.by_modes {
            statistics.encode(to);
        }
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        let (curve, spread) = <(Vec<[f64; 2]>, Vec<[f64; 2]>)>::decode(from)?;
        let curve = curve.into_iter().map(|[window, contrast]| (window, contrast)).collect();
        Some(Self { curve, spread, by_modes: Some(Statistics::decode(from)?), statistics: None })
    }

    /// As [`Windows::on`], from the modes of which [`responses_on`] makes responses.
    pub(super) fn on_modes(surface: &Surface, modes: Arc<Modes>) -> Self {
        match responses_on(surface, modes, &options(surface)) {
            Ok(responses) => Self::on(surface, &responses),
            Err(error) => Self::by_law(surface, error.to_string()),
        }
    }

    /// Computes the contrast of a surface against the window from statistics, without solving for its
    /// modes, which is much faster. `reason` says, for people, why statistics are used.
    pub fn by_law(surface: &Surface, reason: impl Into<String>) -> Self {
        let first = Medium::of(&surface.sheet).omega(Weyl::of(surface).first_wavenumber()) / TAU;
        let [low, top] = surface.emission.band;
        // Below the first mode there is no resonance, whatever Weyl's law gives.
        let cavity = Cavity::within(surface, [low.max(first).min(top), top]);
        let actuators = surface.actuators.len() as f64;
        Self::along(surface, Some(reason.into()), f64::INFINITY, |window| {
            (cavity.contrast(actuators, window), [f64::NAN; 2])
        })
    }

    /// Evaluates `contrast`, which gives the mean contrast and its 5 % and 95 % quantiles for a window (s),
    /// at all windows that are considered; from the window `settled` (s) on it is the same.
    fn along(
        surface: &Surface,
        statistics: Option<String>,
        settled: f64,
        contrast: impl Fn(f64) -> (f64, [f64; 2]) + Sync,
    ) -> Self {
        let shortest = CROSSINGS * Cavity::of(surface, surface.emission.band[1]).crossing();
        let longest = LONGEST.max(4.0 * shortest);
        let steps = (PER_DOUBLING * (longest / shortest).log2()).ceil();
        let at = |step: u32| shortest * (longest / shortest).powf(f64::from(step) / steps);
        let windows: Vec<f64> = (0..=steps as u32).map(at).collect();
        let moving = windows.partition_point(|window| *window < settled);
        let computed = &windows[..windows.len().min(moving + 1)];
        let contrasts: Vec<_> = computed.par_iter().map(|window| contrast(*window)).collect();
        let found: Vec<_> = (0..windows.len()).map(|i| (windows[i], contrasts[i.min(moving)])).collect();
        let spread = match &statistics {
            Some(_) => Vec::new(),
            None => found.iter().map(|(_, (_, spread))| *spread).collect(),
        };
        let curve = found.into_iter().map(|(window, (mean, _))| (window, mean)).collect();
        Self { curve, spread, by_modes: None, statistics }
    }

    /// Whether the contrasts are computed from the modes coupled to all that is attached to the sheet, rather than from statistics.
    pub fn is_modal(&self) -> bool {
        self.statistics.is_none()
    }

    /// The window that `unripple design` recommends: the shortest that reaches nine tenths of the largest contrast.
    pub fn recommended(&self) -> Recommended {
        self.shortest(WORTHWHILE)
    }

    /// The shortest window whose contrast reaches the given `share` (0 to 1) of the largest contrast.
    pub fn shortest(&self, share: f64) -> Recommended {
        let known = self.curve.iter().map(|(_, c)| *c).filter(|c| c.is_finite());
        let Some(largest) = known.max_by(f64::total_cmp) else {
            let seconds = rounded_up(self.floor());
            let why = format!("{CROSSED}: no contrast can be computed here to compare windows");
            let (largest, at_floor) = (f64::NAN, true);
            return Recommended { seconds, contrast: largest, largest, largest_at: seconds, at_floor, why };
        };
        let as_good = self.curve.iter().find(|(_, c)| *c >= AS_GOOD * largest);
        let largest_at = as_good.map_or(f64::NAN, |(t, _)| *t);
        let aim = share * largest;
        let crossed = self.curve.iter().position(|(_, c)| *c >= aim).unwrap_or(0);
        let seconds = match crossed.checked_sub(1) {
            None => self.floor(),
            Some(before) => {
                let ((t0, c0), (t1, c1)) = (self.curve[before], self.curve[crossed]);
                t0 * (t1 / t0).powf(((aim - c0) / (c1 - c0)).clamp(0.0, 1.0))
            }
        };
        let seconds = rounded_up(seconds);
        let at_floor = crossed == 0;
        let why = self.why(share, at_floor, (largest_at, largest));
        Recommended { seconds, contrast: self.contrast(seconds), largest, largest_at, at_floor, why }
    }

    /// Expected contrast (a ratio of amplitudes) for a window, in s. Interpolated between the computed
    /// windows; a window shorter or longer than all of them takes the contrast of the nearest.
    pub fn contrast(&self, window: f64) -> f64 {
        self.interpolated(window, |i| Some(self.curve[i].1)).unwrap_or(f64::NAN)
    }

    /// The 5 % and 95 % quantiles of the contrast over targets, for a window in s; `None` where they are
    /// not computed from the modes.
    pub fn interval(&self, window: f64) -> Option<[f64; 2]> {
        let end = |which: usize| self.interpolated(window, |i| Some(self.spread.get(i)?[which]));
        Some([end(0)?, end(1)?])
    }

    /// Expected contrast for each number of `actuators` like those of the surface and a window in s, from
    /// the modes; `None` where the modes are not known.
    pub fn expected(&self, actuators: &[f64], window: f64) -> Option<Vec<f64>> {
        Some(self.by_modes.as_ref()?.contrasts(actuators, window))
    }

    /// A quantity at a window (s), interpolated between its values at the computed windows, which `value`
    /// gives by index.
    fn interpolated(&self, window: f64, value: impl Fn(usize) -> Option<f64>) -> Option<f64> {
        let after = self.curve.partition_point(|(t, _)| *t < window);
        let last = self.curve.len().checked_sub(1)?;
        if after == 0 || after > last {
            return value(after.min(last));
        }
        let ((t0, _), (t1, _)) = (self.curve[after - 1], self.curve[after]);
        let (c0, c1) = (value(after - 1)?, value(after)?);
        Some(c0 + (c1 - c0) * (window / t0).ln() / (t1 / t0).ln())
    }

    /// The window nearest to the given one (s), between the shortest and the longest for which contrast was
    /// computed.
    pub(super) fn nearest(&self, window: f64) -> f64 {
        let ends = self.curve.first().zip(self.curve.last());
        ends.map_or(window, |((shortest, _), (longest, _))| window.max(*shortest).min(*longest))
    }

    fn floor(&self) -> f64 {
        self.curve.first().map_or(0.0, |(t, _)| *t)
    }

    /// Why a window is recommended, in words.
    fn why(&self, share: f64, at_floor: bool, (largest_at, largest): (f64, f64)) -> String {
        let peak = format!("{largest:.1} at {:.1} ms", 1e3 * largest_at);
        let longest = self.curve.last().map_or(0.0, |(t, _)| *t);
        let share =
            if share == WORTHWHILE { "nine tenths".into() } else { format!("{:.0} %", 100.0 * share) };
        let mut why = if at_floor {
            format!("{CROSSED}, with no less than {share} of the largest contrast ({peak})")
        } else {
            format!("the shortest with {share} of the largest contrast ({peak})")
        };
        let still = self.contrast(longest);
        if still >= AS_GOOD * largest && still > (2.0 - AS_GOOD) * self.contrast(0.5 * longest) {
            why += &format!(", which still grows at {:.0} ms, the longest considered", 1e3 * longest);
        }
        if let Some(reason) = &self.statistics {
            why += &format!(", by the statistics of its modes: {reason}");
        }
        why
    }
}

/// A window, given in s, as text in milliseconds with three digits, without the unit.
pub fn milliseconds(seconds: f64) -> String {
    let ms = 1e3 * seconds;
    let decimals = (2.0 - ms.log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{ms:.decimals$}")
}

/// A window in s, rounded up to three digits, so that it is printed exactly and still reaches the contrast
/// for which it was chosen.
fn rounded_up(seconds: f64) -> f64 {
    if !(seconds > 0.0 && seconds.is_finite()) {
        return seconds;
    }
    // In units of a power of ten below one, so that the digits are those of a decimal number.
    let unit = 10f64.powi(2 - seconds.log10().floor() as i32);
    // Slightly less, so that a number of three digits does not change.
    (seconds * unit * (1.0 - 1e-9)).ceil() / unit
}
