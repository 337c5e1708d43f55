//! The vector of unknowns, its order and its priors.

use std::f64::consts::TAU;
use unripple_core::Point;
use unripple_physics::Medium;

/// Frequencies of the damping law's knots, as shares of the band's top. An octave apart: decay times vary slowly, and
/// the lowest modes are too few to determine more.
pub(super) const KNOTS: [f64; 5] = [0.0625, 0.125, 0.25, 0.5, 1.0];

/// Standard deviations of the priors around the nominal values. In order: logarithm of tension, logarithm of
/// bending stiffness, anisotropy as a share, each term of the profile with one half wave as a share,
/// logarithm of decay rates, place of an actuator (m), logarithm of gains, mass (kg), least damping (N·s/m),
/// place of a stray mass (m), logarithm of the gain common to all sensors, latency (s). Doubled, a standard
/// deviation lets the unknown deviate twice as far; halved, it keeps the unknown nearer to the value in the
/// surface file.
const TENSION: f64 = 0.1;
const BENDING: f64 = 0.1;
const SKEW: f64 = 0.02;
const PROFILE: f64 = 0.01;
const DECAY: f64 = 0.5;
const PLACE: f64 = 2e-3;
const GAIN: f64 = 0.02;
const MASS: f64 = 10e-6;
const RESISTANCE: f64 = 2e-3;
const STRAY: f64 = 10e-3;
const LEVEL: f64 = 0.2;
const LATE: f64 = 2e-5;

/// Damping to be expected, as a share of the sheet's driving-point impedance: what is fixed to a stiff plate
/// is sturdier than what a film can carry.
const DAMPED: f64 = 0.01;

/// The prior of a damping on a sheet, one standard deviation, in N·s/m, from the impedance of a point of the unbounded sheet at the top
/// of the band, `4 ρ_s c_g/k` (of a plate `8 √(ρ_s D)`: L. Cremer, M. Heckl, B. A. T. Petersson, *Structure-Borne Sound*).
pub(super) fn damping(medium: &Medium, top: f64) -> f64 {
    let k = medium.wavenumber(TAU * top);
    (DAMPED * 4.0 * medium.areal_density * medium.group_celerity(k) / k).max(RESISTANCE)
}

/// The unknowns of a fit, and their order in the vector of unknowns.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layout {
    /// Number of actuators.
    pub actuators: usize,
    /// Indices of actuators without measured responses. Their places and gains are not unknowns: the fit
    /// would move a free place to that of a stray mass.
    pub silent: Vec<usize>,
    /// Numbers of half waves along x and y in each term of the tension's profile.
    pub waves: Vec<[u32; 2]>,
    /// Number of stray masses.
    pub strays: usize,
    /// The prior of every damping, one standard deviation, in N·s/m.
    pub damping: f64,
}

/// One unknown of the fit, by its kind and its number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Unknown {
    Tension,
    Bending,
    Skew,
    Term(usize),
    Knot(usize),
    /// Coordinate of an actuator or stray mass: the load's number, then 0 for x or 1 for y.
    Place(usize, usize),
    Mass(usize),
    Resistance(usize),
    Drive(usize),
    Sense(usize),
    Level,
    Late,
}

/// The unknowns as numbers in SI, gains and decay rates as logarithms.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Values {
    /// Logarithm of the tension's ratio to nominal.
    pub tension: f64,
    /// Logarithm of the bending stiffness's ratio to nominal.
    pub bending: f64,
    /// Half the difference of the tensions along x and y, over their mean.
    pub skew: f64,
    /// Amplitude of each term of the tension's profile, as a share of the mean tension.
    pub profile: Vec<f64>,
    /// Logarithm of the decay rate (1/s) at each knot.
    pub knots: Vec<f64>,
    /// The actuators' places, then those of stray loads.
    pub places: Vec<Point>,
    /// Mass at each place, in kg.
    pub masses: Vec<f64>,
    /// Damping to the ground at each place, in N·s/m.
    pub resistances: Vec<f64>,
    /// Logarithm of each actuator's gain as a drive.
    pub drive: Vec<f64>,
    /// Logarithm of each actuator's gain as a sensor.
    pub sense: Vec<f64>,
    /// Logarithm of the gain common to all sensors.
    pub level: f64,
    /// Latency of the responses between actuators, in s.
    pub late: f64,
}

impl Layout {
    /// Number of loads on the sheet: actuators and stray masses.
    pub fn loaded(&self) -> usize {
        self.actuators + self.strays
    }

    /// All unknowns in the order of their vector; those on which the sheet's admittance depends come first.
    pub fn unknowns(&self) -> Vec<Unknown> {
        use Unknown::*;
        let loaded = 0..self.loaded();
        let mut all = vec![Tension, Bending, Skew];
        all.extend((0..self.waves.len()).map(Term));
        all.extend((0..KNOTS.len()).map(Knot));
        all.extend(loaded.clone().flat_map(|p| [Place(p, 0), Place(p, 1)]));
        all.extend(loaded.clone().map(Mass));
        all.extend(loaded.map(Resistance));
        all.extend((0..self.actuators).map(Drive));
        all.extend((0..self.actuators).map(Sense));
        all.extend([Level, Late]);
        all.retain(|unknown| match unknown {
            Place(p, _) | Drive(p) | Sense(p) => !self.silent.contains(p),
            _ => true,
        });
        all
    }

    /// Standard deviation of an unknown's prior around its nominal value, in the unknown's unit.
    pub fn spread(&self, unknown: Unknown) -> f64 {
        match unknown {
            Unknown::Tension => TENSION,
            Unknown::Bending => BENDING,
            Unknown::Skew => SKEW,
            Unknown::Term(t) => PROFILE / f64::from(self.waves[t][0] + self.waves[t][1]),
            Unknown::Knot(_) => DECAY,
            Unknown::Place(p, _) => {
                if p < self.actuators {
                    PLACE
                } else {
                    STRAY
                }
            }
            Unknown::Mass(_) => MASS,
            Unknown::Resistance(_) => self.damping,
            Unknown::Drive(_) | Unknown::Sense(_) => GAIN,
            Unknown::Level => LEVEL,
            Unknown::Late => LATE,
        }
    }
}

impl Values {
    /// Product of the gains of the drive of actuator `driven` and the sensor of actuator `heard`, in SI
    /// units.
    pub fn gain(&self, driven: usize, heard: usize) -> f64 {
        (self.drive[driven] + self.sense[heard] + self.level).exp()
    }

    /// Mutable reference to the value of an unknown, in the unit of the field of [`Values`] that holds it: an
    /// SI unit, or none for logarithms and shares.
    pub fn of(&mut self, unknown: Unknown) -> &mut f64 {
        match unknown {
            Unknown::Tension => &mut self.tension,
            Unknown::Bending => &mut self.bending,
            Unknown::Skew => &mut self.skew,
            Unknown::Term(t) => &mut self.profile[t],
            Unknown::Knot(k) => &mut self.knots[k],
            Unknown::Place(p, 0) => &mut self.places[p].x,
            Unknown::Place(p, _) => &mut self.places[p].y,
            Unknown::Mass(p) => &mut self.masses[p],
            Unknown::Resistance(p) => &mut self.resistances[p],
            Unknown::Drive(a) => &mut self.drive[a],
            Unknown::Sense(a) => &mut self.sense[a],
            Unknown::Level => &mut self.level,
            Unknown::Late => &mut self.late,
        }
    }
}

/// Weights of the two knots around a frequency that is given as a share of the band's top: linear in the
/// logarithm, constant beyond both ends.
pub(super) fn around(share: f64) -> [(usize, f64); 2] {
    let above = KNOTS.partition_point(|knot| *knot <= share);
    match above {
        0 => [(0, 1.0), (0, 0.0)],
        n if n == KNOTS.len() => [(n - 1, 1.0), (n - 1, 0.0)],
        n => {
            let t = (share / KNOTS[n - 1]).ln() / (KNOTS[n] / KNOTS[n - 1]).ln();
            [(n - 1, 1.0 - t), (n, t)]
        }
    }
}
