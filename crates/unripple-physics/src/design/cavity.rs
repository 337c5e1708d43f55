//! Statistical contrast (velocity at a focus over the rms velocity elsewhere) of a reverberant surface:
//! modal overlap, decay, window.

use super::closed::exposure;
use super::waves::wave_decay_rate;
use crate::Medium;
use std::f64::consts::{PI, TAU};
use unripple_core::{FOCAL_RADIUS, Outline, Shape, Surface};

/// Number of intervals that a band is divided into, evenly in wavenumber, for integrals over the band.
/// With twice this value, the midpoint rule errs a quarter as much.
const BINS: usize = 400;

/// Statistical contrast of a surface as a reverberant cavity, from its modal density and decay time at each frequency.
///
/// This contrast refines [`super::closed::contrast`] in five ways, none of them fitted:
/// - the modal density n(f) grows towards the top of the band, so that sums over neighbouring modes give ∫n²df and not B n̄²;
/// - modes vanish (or are larger) at the rim, so that away from it, where targets are, they count S k²/4π and not M;
/// - mode shapes of a rectangle are products of two sines, whose squares have the relative variance 5/4 and not 2 as for
///   Gaussian random waves;
/// - before the first reflections return, modes act as if they were evenly spaced: a mode and its neighbours together leak
///   according to n, and the mode itself must not be counted twice;
/// - each frequency has its own decay time, radiation of sound included.
///
/// The band is divided into bins with dM modes each, dℓ of them as counted at the target, and n modes per hertz. With
/// I(T) = ∫_0^T e^{-2t/τ}/2 dt and V = ∫_0^T e^{-4t/τ}/8 dt,
/// 1/C² = Σ dℓ [n V / N + (s - ρ) I² / N + e (ℓ/M) I²] / (Σ dℓ I)², where s is 5/4 or 2, ℓ = Σ dℓ, M = Σ dM, and
/// ρ = 1 - e^{-2t_0/τ} I(T - t_0)²/I(T)² is the share of the beats of a mode with its neighbours before the time
/// t_0 = 2πS/(P c_g) of a return trip along the mean chord πS/P. For a single decay time and a constant density, with ρ = 0 and
/// s = 2, it reduces to [`super::closed::contrast`].
///
/// ```
/// # use unripple_core::*;
/// # let surface = unripple_physics::design::papers_surface();
/// let cavity = unripple_physics::design::Cavity::of(&surface, 3000.0);
/// let (once, repeated) = (cavity.contrast(8.0, 0.030), cavity.repeated(8.0, 0.030, 0.070));
/// assert!(once > 20.0 && repeated < once);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Cavity {
    bins: Vec<Bin>,
    /// Relative variance s of the squared mode shapes, ⟨φ⁴⟩/⟨φ²⟩² - 1.
    scatter: f64,
    /// Share e of a focus's energy that lies outside the focal disc.
    exposure: f64,
    /// Width of the band, in Hz.
    bandwidth: f64,
}

/// An interval of the frequency band.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bin {
    hz: f64,
    /// Number of modes in the interval.
    modes: f64,
    /// Number of modes in the interval as counted at a point away from the rim.
    local: f64,
    /// Modes per hertz.
    density: f64,
    /// Decay rate of the amplitude, in 1/s, by damping and by radiation of sound.
    sigma: f64,
    /// Time of a return trip along the mean chord, in s.
    trip: f64,
}

impl Bin {
    /// ∫_0^T e^{-2t/τ}/2 dt: the contribution of a mode to the focus.
    fn gathered(&self, window: f64) -> f64 {
        ring(2.0 * self.sigma, window) / 2.0
    }

    /// ∫_0^T e^{-4t/τ}/8 dt: the mean square leakage into a mode if there is one neighbouring mode per
    /// hertz.
    fn leaked(&self, window: f64) -> f64 {
        ring(4.0 * self.sigma, window) / 8.0
    }

    /// Share ρ of a mode's beats with its neighbours that falls before the return of the first reflections.
    fn regular(&self, window: f64) -> f64 {
        let left = self.gathered((window - self.trip).max(0.0)) / self.gathered(window);
        1.0 - (-2.0 * self.sigma * self.trip).exp() * left * left
    }
}

impl Cavity {
    /// The statistics of a surface in a band that ends at `top_hz` (Hz), with modes counted by Weyl's law.
    /// The law's perimeter term is left out where it would leave no mode.
    pub fn of(surface: &Surface, top_hz: f64) -> Self {
        Self::within(surface, [surface.emission.band[0], top_hz])
    }

    /// The statistics of a surface in a band from `first_hz`, the frequency of its first mode, to `top_hz`
    /// (both Hz); from the bottom of the surface's band if the first mode is not in it. Nothing resonates
    /// below the first mode, where decay that grows longer towards low frequency would count as long
    /// reverberation.
    pub(super) fn ringing(surface: &Surface, first_hz: f64, top_hz: f64) -> Self {
        let low = surface.emission.band[0];
        let first = low.max(first_hz);
        Self::within(surface, [if first < top_hz { first } else { low }, top_hz])
    }

    /// The statistics of a surface between two frequencies (Hz), computed as in [`Cavity::of`].
    pub(super) fn within(surface: &Surface, [low_hz, top_hz]: [f64; 2]) -> Self {
        let medium = Medium::of(&surface.sheet);
        let first = medium.wavenumber(TAU * low_hz.max(0.0));
        let last = medium.wavenumber(TAU * top_hz);
        let width = (last - first) / BINS as f64;
        let outline = &surface.outline;
        let (area, perimeter) = (outline.area(), outline.perimeter());
        // Of a sheet of few wavelengths the term of the rim can leave no mode at all, though it has some: that of the area is left then,
        // and an exact count scales it.
        let rim = Some(signed_perimeter(outline)).filter(|rim| weyl(area, *rim, last) > 0.0).unwrap_or(0.0);
        let bins = (0..BINS)
            .map(|i| {
                let k = first + (i as f64 + 0.5) * width;
                let omega = medium.omega(k);
                let per_wavenumber = weyl(area, rim, k).max(0.0);
                let group = medium.group_celerity(k);
                Bin {
                    hz: omega / TAU,
                    modes: per_wavenumber * width,
                    local: area * k * width / TAU,
                    density: per_wavenumber * TAU / group,
                    sigma: wave_decay_rate(&surface.sheet, &medium, k, omega),
                    trip: TAU * area / (perimeter * group),
                }
            })
            .collect();
        let scatter = if matches!(surface.outline.shape, Shape::Rectangle { .. }) { 1.25 } else { 2.0 };
        Self { bins, scatter, exposure: exposure(TAU * FOCAL_RADIUS), bandwidth: top_hz - low_hz }
    }

    /// The same surface with its modal density scaled so that the band holds `modes` modes, an exact count.
    pub fn counted(mut self, modes: f64) -> Self {
        let ratio = modes / self.modes();
        if ratio.is_finite() && ratio > 0.0 {
            self.bins.iter_mut().for_each(|bin| {
                bin.modes *= ratio;
                bin.density *= ratio;
            });
        }
        self
    }

    /// The same surface with a single decay time, in seconds, at all frequencies.
    pub fn with_decay_time(mut self, decay_time: f64) -> Self {
        self.bins.iter_mut().for_each(|bin| bin.sigma = 1.0 / decay_time);
        self
    }

    /// Number of modes M in the band.
    pub fn modes(&self) -> f64 {
        self.bins.iter().map(|bin| bin.modes).sum()
    }

    /// Number of modes in the band as counted at a point away from the rim: Weyl's law without the term of the perimeter,
    /// S k²/4π.
    pub fn local_modes(&self) -> f64 {
        self.bins.iter().map(|bin| bin.local).sum()
    }

    /// Width of the band, in Hz.
    pub fn bandwidth(&self) -> f64 {
        self.bandwidth
    }

    /// Width, in Hz, of a band of constant modal density that has the same number of modes and the same
    /// leakage between modes: M²/∫n²df.
    pub fn effective_bandwidth(&self) -> f64 {
        self.modes().powi(2) / self.sum(|bin| bin.modes * bin.density)
    }

    /// Decay time of the amplitude, in s, by damping and by radiation of sound: the reciprocal of the mean decay rate of the modes.
    pub fn decay_time(&self) -> f64 {
        self.modes() / self.sum(|bin| bin.modes * bin.sigma)
    }

    /// Exponent p, dimensionless, of the modal density, modelled as growing from the bottom of the band as
    /// a power p of frequency; chosen so that the modes have their actual mean frequency.
    pub fn growth(&self) -> f64 {
        let top = self.bins.last().map_or(1.0, |bin| bin.hz);
        let low = top - self.bandwidth;
        let mean = (self.sum(|bin| bin.modes * bin.hz) / self.modes() - low) / self.bandwidth;
        ((2.0 * mean - 1.0) / (1.0 - mean)).clamp(0.0, 4.0)
    }

    /// Contrast, a ratio of amplitudes, of a single focus with a given number of `actuators` and a window
    /// in seconds.
    pub fn contrast(&self, actuators: f64, window: f64) -> f64 {
        self.noise(actuators, window, |_| 0.0, |_| 0.0).powf(-0.5)
    }

    /// Contrast of a focus repeated every `period` seconds (T_r), in the steady state, with a given number
    /// of `actuators` and a window in seconds.
    ///
    /// With x = e^{-2T_r/τ}, the field at a focal instant contains, besides the pulse itself,
    /// - from the pulse k periods before: its leakage times x^k, with a new phase for each pair of modes;
    /// - from the pulse k periods after, which has begun if kT_r < T: x^k times the leakage of a window T - kT_r;
    /// - from both, the focus of each mode, no longer in phase with the other modes. The earlier has decayed by x^{k/2}, the
    ///   later has the amplitude x^{k/2} r with r = I(T - kT_r)/I(T), and both vary as cos ω_m kT_r: together ½ x^k (1 + r)².
    pub fn repeated(&self, actuators: f64, window: f64, period: f64) -> f64 {
        let begun = (window / period).ceil().clamp(1.0, 1e6) as u32;
        let later = move |bin: &Bin, f: &dyn Fn(f64, f64) -> f64| -> f64 {
            (1..begun)
                .map(|k| f64::from(k) * period)
                .map(|lag| f((-2.0 * bin.sigma * lag).exp(), window - lag))
                .sum()
        };
        let earlier = move |bin: &Bin| 1.0 / (2.0 * bin.sigma * period).exp_m1();
        let leakage =
            |bin: &Bin| earlier(bin) + later(bin, &|x, left| x * bin.leaked(left) / bin.leaked(window));
        let echo = |bin: &Bin| {
            let whole = bin.gathered(window);
            let begun = later(bin, &|x, left| {
                let r = bin.gathered(left) / whole;
                x * r * (2.0 + r)
            });
            (earlier(bin) + begun) / 2.0
        };
        self.noise(actuators, window, leakage, echo).powf(-0.5)
    }

    /// Contrast with noise in the recorded responses or in the emitted drive, for a given number of
    /// `actuators` and a window in s. `ratio` is the rms of the noise over the rms of the responses, both
    /// in the band and over the window.
    pub fn noisy(&self, actuators: f64, window: f64, ratio: f64) -> f64 {
        let noise = super::closed::noise_share(actuators, self.bandwidth, window, ratio);
        let heard = self.modes() / self.local_modes();
        (self.contrast(actuators, window).powi(-2) + noise * heard).powf(-0.5)
    }

    /// Time that waves take to cross the surface along the mean chord πS/P, averaged over the modes of the
    /// band, in s.
    pub fn crossing(&self) -> f64 {
        self.sum(|bin| bin.modes * bin.trip) / self.modes() / 2.0
    }

    /// The reciprocal square 1/C² of the contrast; `leakage` and `echo` are the parts that repetition adds,
    /// relative to the leakage between modes and to the modes' own contribution to the focus.
    fn noise(
        &self,
        actuators: f64,
        window: f64,
        leakage: impl Fn(&Bin) -> f64,
        echo: impl Fn(&Bin) -> f64,
    ) -> f64 {
        let peak = self.sum(|bin| bin.local * bin.gathered(window));
        let tail = self.exposure * self.local_modes() / self.modes();
        let noise = self.sum(|bin| {
            let leaked = bin.density * bin.leaked(window) * (1.0 + leakage(bin)) / actuators;
            let uneven = (self.scatter - bin.regular(window)) / actuators;
            let own = uneven + tail + echo(bin) * (1.0 + uneven);
            bin.local * (leaked + own * bin.gathered(window).powi(2))
        });
        noise / (peak * peak)
    }

    /// Sum of the quantity `f` over all bins.
    fn sum(&self, f: impl Fn(&Bin) -> f64) -> f64 {
        self.bins.iter().map(f).sum()
    }
}

/// Effective perimeter P in Weyl's law: length of the fixed edges (clamped or supported) minus that of the
/// edges that move (free or elastic), in metres.
fn signed_perimeter(outline: &Outline) -> f64 {
    outline.perimeter() - 2.0 * outline.free_length()
}

/// Modes per unit wavenumber, in metres, for an area S (m²) and a perimeter P (m) at the wavenumber `k`
/// (rad/m).
fn weyl(area: f64, rim: f64, k: f64) -> f64 {
    (2.0 * area * k - rim) / (4.0 * PI)
}

/// ∫_0^T e^{-rate·t} dt, in s; the window T if the rate is zero.
fn ring(rate: f64, window: f64) -> f64 {
    // For smaller values the quotient loses digits, and the integral is the window.
    if rate * window > 1e-9 { -(-rate * window).exp_m1() / rate } else { window }
}
