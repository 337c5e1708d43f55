//! Statistical contrast of time reversal (velocity at the focus over the rms elsewhere) from the natural
//! frequencies of a surface's own modes, for any number of actuators.

use super::window::{Modal, Term, integral};
use crate::Medium;
use std::f64::consts::{PI, TAU};
use unripple_core::{Encoded, ModalResponses};
use unripple_dsp::bessel_j;
use unripple_linalg::c64;

/// Number of modes on either side over which the mean gain of actuators is averaged, so that it depends on
/// frequency and not on the nodes of a single mode. With twice this value, it would blur the bottom of the
/// band, where gains near a rim change from mode to mode.
const NEIGHBOURS: usize = 8;

/// Number of steps of the integral over the focal disc. Doubled, the error of Simpson's rule is a
/// sixteenth.
const RINGS: usize = 32;

/// Expected contrast of time reversal for any number of actuators like those of a surface, computed from
/// the surface's own natural frequencies and decay rates, with mode shapes treated as random functions.
///
/// Time reversal of the responses at A gives mode m the velocity Σ_n W_mn I_mn φ_n(A), with W_mn = Σ_a φ_m(a) φ_n(a) and
/// I_mn = ∫_0^T g_m g_n dt ([`Windows`](super::Windows)). Frequencies and decay rates enter exactly, through I_mn: so neighbouring modes
/// that the window does not resolve, few modes, decay that depends on frequency and damping by actuators are as they are. Of the shapes,
/// means alone enter: ⟨φ_m²⟩ over the surface, over targets, and over actuators, b_m = ⟨φ_m²(a)⟩, smoothed over neighbouring modes.
/// With N actuators, E W_mm = N b_m, Var W_mm = N² v b_m² + N s b_m² and E W_mn² = N b_m b_n, with s the relative variance of squared
/// shapes at the actuators and v that of their mean over all actuators (the modes that no actuator along a rim excites well). So
///
/// 1/C² = { Σ_m u_m [Σ_{n≠m} N b_m b_n I_mn² t_n + (s N + v N²) b_m² I_mm² t_m] + o } / (Σ_m N b_m I_mm t_m)²,
///
/// with t_m the mean square shape at targets, u_m that over the surface, and o the part of the perfect focus f(r) =
/// Σ_m N b_m I_mm t_m J0(k_m r) that lies outside the focal disc.
#[derive(Clone, Debug, PartialEq)]
pub struct Statistics {
    /// The velocities of all modes as exponentials.
    terms: Vec<Term>,
    modes: Vec<Mode>,
    /// Relative variance of the squared mode shape at an actuator, without the part that all actuators have
    /// in common.
    scatter: f64,
    /// Relative variance over modes of the squared mode shape averaged over all actuators, for an infinite
    /// number of actuators.
    shared: f64,
    /// Radius of the focal disc, in metres.
    radius: f64,
    /// Area of the surface, in m².
    area: f64,
}

/// Statistics of a mode on which the mean contrast depends.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Mode {
    /// Mean square gain of the actuators, averaged over this mode and its neighbours.
    driven: f64,
    /// Mean square shape at targets.
    at_targets: f64,
    /// Mean square shape over the surface.
    everywhere: f64,
    /// Wavenumber, in rad/m.
    wavenumber: f64,
}

impl Encoded for Statistics {
    fn encode(&self, to: &mut Vec<u8>) {
        self.terms.encode(to);
        let modes = self.modes.iter().map(|m| [m.driven, m.at_targets, m.everywhere, m.wavenumber]);
        modes.collect::<Vec<_>>().encode(to);
        [self.scatter, self.shared, self.radius, self.area].encode(to);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        let (terms, modes) = <(Vec<Term>, Vec<[f64; 4]>)>::decode(from)?;
        let [scatter, shared, radius, area] = Encoded::decode(from)?;
        let mode = |[driven, at_targets, everywhere, wavenumber]: [f64; 4]| Mode {
            driven,
            at_targets,
            everywhere,
            wavenumber,
        };
        Some(Self { terms, modes: modes.into_iter().map(mode).collect(), scatter, shared, radius, area })
    }
}

impl Statistics {
    /// The statistics of modal responses on a sheet of this `medium`; `None` if there is no actuator, no
    /// mode, or no room for targets.
    pub fn of(responses: &ModalResponses, medium: Medium) -> Option<Self> {
        Some(Self::on(&Modal::of(responses).ok()?, responses, medium))
    }

    /// The statistics of modal responses for which `modal` (exponentials and mode shapes) has been
    /// prepared.
    pub(super) fn on(modal: &Modal, responses: &ModalResponses, medium: Medium) -> Self {
        let ModalResponses { poles, input, conditions, .. } = responses;
        let count = poles.len();
        let [at_targets, everywhere] = modal.mean_squares();
        let actuators = input.nrows();
        let squares = |m: usize| (0..actuators).map(move |a| input[(a, m)] * input[(a, m)]);
        let own: Vec<f64> = (0..count).map(|m| squares(m).sum::<f64>() / actuators as f64).collect();
        let driven = smoothed(&own);
        // Analysis of variance, relative to the smoothed gain: within modes (over actuators) and between them.
        let relative = |m: usize, value: f64| (value / driven[m] - 1.0).powi(2);
        let whole = (0..count).flat_map(|m| squares(m).map(move |s| (m, s)));
        let total = whole.map(|(m, s)| relative(m, s)).sum::<f64>() / (count * actuators) as f64;
        let between = (0..count).map(|m| relative(m, own[m])).sum::<f64>() / count as f64;
        let n = actuators as f64;
        // E between = shared + scatter/n, E total = shared + scatter; with one actuator the two cannot be distinguished.
        let shared = if actuators > 1 { ((n * between - total) / (n - 1.0)).max(0.0) } else { 0.0 };
        let modes = (0..count).map(|m| Mode {
            driven: driven[m],
            at_targets: at_targets[m],
            everywhere: everywhere[m],
            wavenumber: medium.wavenumber(poles[m].omega),
        });
        Self {
            terms: modal.terms().to_vec(),
            modes: modes.collect(),
            scatter: (total - shared).max(0.0),
            shared,
            radius: conditions.focal_radius(),
            area: conditions.outline.area(),
        }
    }

    /// Expected contrast, a ratio of amplitudes, for each number of `actuators` and a window in seconds.
    pub fn contrasts(&self, actuators: &[f64], window: f64) -> Vec<f64> {
        let Gathered { own, leaked } = self.gathered(window);
        let count = self.modes.len();
        let focus: Vec<f64> =
            (0..count).map(|m| self.modes[m].driven * own[m] * self.modes[m].at_targets).collect();
        let peak: f64 = focus.iter().sum();
        // Of the mean square over the surface: the perfect focus, and what each mode's own gain adds by varying.
        let square = |m: usize| {
            let mode = &self.modes[m];
            mode.everywhere * (mode.driven * own[m]).powi(2) * mode.at_targets
        };
        let whole: f64 = (0..count).map(square).sum();
        let disc = PI * self.radius * self.radius / self.area;
        let beyond = ((whole - self.inside(&focus)) / (1.0 - disc)).max(0.0);
        let contrast = |n: f64| {
            let noise = n * leaked + (self.scatter * n + self.shared * n * n) * whole + n * n * beyond;
            n * peak / noise.sqrt()
        };
        actuators.iter().map(|n| contrast(*n)).collect()
    }

    /// Integral of the square of the perfect focus over the focal disc, divided by the area of the surface.
    fn inside(&self, focus: &[f64]) -> f64 {
        let step = self.radius / RINGS as f64;
        let ring = |i: usize| {
            let r = i as f64 * step;
            let field: f64 = focus
                .iter()
                .zip(&self.modes)
                .map(|(part, mode)| part * bessel_j(0, mode.wavenumber * r))
                .sum();
            let weight = match i {
                0 | RINGS => 1.0,
                _ if i % 2 == 1 => 4.0,
                _ => 2.0,
            };
            weight * field * field * TAU * r
        };
        (0..=RINGS).map(ring).sum::<f64>() * step / 3.0 / self.area
    }

    /// I_mm of each mode, and Σ_m u_m Σ_{n≠m} b_m b_n I_mn² t_n.
    fn gathered(&self, window: f64) -> Gathered {
        let count = self.modes.len();
        let ends: Vec<c64> = self.terms.iter().map(|term| (term.rate * window).exp()).collect();
        let first: Vec<usize> =
            (0..=count).map(|m| self.terms.partition_point(|term| term.mode < m)).collect();
        let pair = |m: usize, n: usize| -> f64 {
            let parts = (first[m]..first[m + 1]).flat_map(|i| (first[n]..first[n + 1]).map(move |j| (i, j)));
            parts.map(|(i, j)| integral([&self.terms[i], &self.terms[j]], [ends[i], ends[j]], window)).sum()
        };
        let own = (0..count).map(|m| pair(m, m)).collect();
        let mut leaked = 0.0;
        for m in 0..count {
            for n in 0..m {
                let (a, b) = (&self.modes[m], &self.modes[n]);
                let both = a.everywhere * b.at_targets + b.everywhere * a.at_targets;
                leaked += a.driven * b.driven * pair(m, n).powi(2) * both;
            }
        }
        Gathered { own, leaked }
    }
}

/// Integrals of the products of modes over a window.
struct Gathered {
    own: Vec<f64>,
    leaked: f64,
}

/// Mean of each value and its neighbours on either side; fewer neighbours at the ends.
fn smoothed(values: &[f64]) -> Vec<f64> {
    let about = |m: usize| {
        let reach = NEIGHBOURS.min(m).min(values.len() - 1 - m);
        &values[m - reach..=m + reach]
    };
    (0..values.len()).map(|m| about(m).iter().sum::<f64>() / about(m).len() as f64).collect()
}
