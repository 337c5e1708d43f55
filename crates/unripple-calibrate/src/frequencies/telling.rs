//! What a further measurement would have to be to tell two surfaces apart that explain the same frequencies.

use super::solve::Problem;
use crate::CalibrateError;
use unripple_core::{Point, Shapes, Surface};
use unripple_linalg::Mat;
use unripple_physics::{Accuracy, Modes};

/// Frequencies are compared up to this multiple of the highest measured one: a few more modes than were heard.
const BEYOND: f64 = 1.4;

/// Modes are computed a little further, so that each has its neighbours.
const AHEAD: f64 = 1.15;

/// Frequencies tell two surfaces apart where they differ by more than this many standard deviations.
const CLEAR: f64 = 4.0;

/// Amplitudes relative to the largest tell two surfaces apart where they differ by more than this.
const SEEN: f64 = 0.2;

/// Places along each side of the bounding box at which shapes are compared.
const PLACES: usize = 15;

/// Modes whose shapes are compared, the lowest ones: their shapes are coarse, so that a place need not be met exactly.
const SHAPES: usize = 3;

/// Relative accuracy of the modes that are compared.
const ACCURACY: f64 = 1e-4;

/// The measurement that tells two surfaces apart best.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Telling {
    /// A mode that one of them has, and the other has not.
    Frequency {
        /// Its frequency in Hz.
        hz: f64,
        /// Whether it is one of the first of the two surfaces.
        of_first: bool,
        /// The nearest frequency of the other, in Hz.
        nearest_hz: f64,
    },
    /// A place where the two move differently in a mode that both have.
    Place {
        /// The place, in m.
        at: Point,
        /// The frequency of the mode of each, in Hz.
        hz: [f64; 2],
        /// How far each moves there, over the largest amplitude of the mode.
        motion: [f64; 2],
    },
}

/// The modes of a surface that are compared: those of its sheet alone, without the loads of actuators.
pub(super) fn compared(surface: &Surface, problem: &Problem) -> Result<Modes, CalibrateError> {
    Ok(Modes::solve(surface, AHEAD * BEYOND * problem.top(), Accuracy::or_best(ACCURACY))?)
}

impl Telling {
    /// The measurement that tells `first` and another surface apart, by the [compared] modes of both; `None` if neither a frequency nor a
    /// place does.
    pub(super) fn of(first: &Surface, modes: [&Modes; 2], problem: &Problem) -> Option<Self> {
        let hz = modes.map(Modes::frequencies_hz);
        by_frequency(&hz, BEYOND * problem.top(), problem).or_else(|| by_place(first, modes, &hz))
    }
}

/// The frequency of one surface that is farthest from all of the other.
fn by_frequency(hz: &[Vec<f64>; 2], top: f64, problem: &Problem) -> Option<Telling> {
    let mut best: Option<(f64, Telling)> = None;
    for (which, own) in hz.iter().enumerate() {
        let others = &hz[1 - which];
        for hz in own.iter().filter(|hz| **hz > 1e-6 * top && **hz <= top) {
            let far = |other: f64| (other / hz).ln().abs();
            let nearest = others.iter().copied().filter(|hz| *hz > 0.0);
            let nearest = nearest.min_by(|a, b| far(*a).total_cmp(&far(*b)));
            let Some(nearest) = nearest else { continue };
            if best.is_none_or(|(most, _)| far(nearest) > most) {
                let told = Telling::Frequency { hz: *hz, of_first: which == 0, nearest_hz: nearest };
                best = Some((far(nearest), told));
            }
        }
    }
    best.filter(|(apart, _)| *apart > CLEAR * problem.deviation).map(|(_, told)| told)
}

/// The place where the amplitudes of the lowest modes differ most.
fn by_place(surface: &Surface, modes: [&Modes; 2], hz: &[Vec<f64>; 2]) -> Option<Telling> {
    let (width, height) = surface.outline.extent();
    let along = |length: f64, i: usize| length * (i as f64 + 0.5) / PLACES as f64;
    let grid = (0..PLACES * PLACES).map(|n| Point::new(along(width, n % PLACES), along(height, n / PLACES)));
    let places: Vec<Point> = grid.filter(|at| surface.outline.contains(*at)).collect();
    let shapes: [Mat<f64>; 2] = [0, 1].map(|which| modes[which].at_all(&places));
    let rigid = [0, 1].map(|which| hz[which].iter().take_while(|hz| **hz <= 0.0).count());
    let mut best: Option<(f64, Telling)> = None;
    for mode in 0..SHAPES {
        let columns = rigid.map(|rigid| rigid + mode);
        if (0..2).any(|which| columns[which] >= hz[which].len()) {
            break;
        }
        let size = |which: usize, place: usize| shapes[which][(place, columns[which])].abs();
        let largest = [0, 1].map(|which| (0..places.len()).map(|p| size(which, p)).fold(0.0, f64::max));
        if largest.contains(&0.0) {
            continue;
        }
        for (place, at) in places.iter().enumerate() {
            let motion = [0, 1].map(|which| size(which, place) / largest[which]);
            let apart = (motion[0] - motion[1]).abs();
            if best.is_none_or(|(most, _)| apart > most) {
                let hz = [0, 1].map(|which| hz[which][columns[which]]);
                best = Some((apart, Telling::Place { at: *at, hz, motion }));
            }
        }
    }
    best.filter(|(apart, _)| *apart > SEEN).map(|(_, told)| told)
}
