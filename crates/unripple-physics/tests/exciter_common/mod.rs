//! Exciters on a supported plate, and the whole linear system of modes, housings and currents, solved directly at one frequency.
//!
//! Nothing here knows of impedances, reduced coordinates or steps: of each exciter there are M du/dt = -F + c(v - u) + k∫(v - u) dt,
//! L di/dt + R i = V - bl(v - u), and the force F - c(v - u) - k∫(v - u) dt - μ dv/dt on the plate, F = bl·i.
#![allow(dead_code)]

use crate::coupled_common::load;
use std::f64::consts::{PI, TAU};
use unripple_core::*;
use unripple_linalg::{Lu, Mat, c64};
use unripple_physics::*;

/// Modes along each side.
const ALONG: usize = 4;
/// Modes of the plate.
pub const MODES: usize = ALONG * ALONG;
/// Decay rate of all modes, in 1/s.
const SIGMA: f64 = 60.0;
/// Sides (m) and mass (kg) of the plate, and the root of its bending stiffness over its mass per area, in m²/s.
pub const SIDES: [f64; 2] = [0.24, 0.16];
const MASS: f64 = 0.1;
const BENDING: f64 = 2.0;

/// A place on the plate where its motion is read.
pub const PROBE: Point = Point::new(0.07, 0.11);

/// The products of sines of a supported plate.
#[derive(Debug)]
pub struct Sines;

fn wave(m: usize) -> [f64; 2] {
    [(m % ALONG + 1) as f64 * PI / SIDES[0], (m / ALONG + 1) as f64 * PI / SIDES[1]]
}

impl Shapes for Sines {
    fn modes(&self) -> usize {
        MODES
    }

    fn at(&self, p: Point, row: &mut [f64]) {
        for (m, row) in row.iter_mut().enumerate() {
            let [kx, ky] = wave(m);
            *row = 2.0 / MASS.sqrt() * (kx * p.x).sin() * (ky * p.y).sin();
        }
    }
}

/// The shapes at a place.
pub fn row(at: Point) -> Vec<f64> {
    let mut row = vec![0.0; MODES];
    Sines.at(at, &mut row);
    row
}

/// The poles of the plate alone, 177 Hz to 2.8 kHz.
pub fn poles() -> Vec<Pole> {
    let omega = |m: usize| wave(m).iter().map(|k| BENDING * k * k).sum::<f64>();
    (0..MODES).map(|m| Pole::new(omega(m), SIGMA)).collect()
}

/// An exciter by its constants, on a current or on a voltage.
#[derive(Clone, Copy, Debug)]
pub struct Exciter {
    pub at: Point,
    pub coil: Circuit,
    pub moving_mass: f64,
    pub housing: Housing,
    pub voltage: bool,
}

/// A housing of 40 g on a spring, 150 Hz and a quality factor of 3, on a coil of 1.2 g, at a place in mm.
pub fn maker(x: f64, y: f64, voltage: bool) -> Exciter {
    let omega = TAU * 150.0;
    Exciter {
        at: Point::from_mm(x, y),
        coil: Circuit { force_constant: 2.5, resistance: 4.0, inductance: 0.05e-3 },
        moving_mass: 1.2e-3,
        housing: Housing { mass: 0.04, damping: 0.04 * omega / 3.0, stiffness: 0.04 * omega * omega },
        voltage,
    }
}

impl Exciter {
    /// The exciter as a drive of the plate.
    pub fn transducer(&self) -> Transducer {
        let footprint = Footprint::point(self.at);
        let load = Load {
            circuit: self.voltage.then_some(self.coil),
            housing: Some(self.housing),
            ..load(footprint.clone(), self.moving_mass, 0.0, 0.0)
        };
        Transducer {
            footprint,
            gain: self.coil.force_constant,
            entry: if self.voltage { Entry::Voltage } else { Entry::Force },
            load: Some(load),
            unit: if self.voltage { "V" } else { "A" },
        }
    }
}

/// The motion of plate, housings and currents at a complex frequency s per unit of drive of one exciter.
pub struct Solved {
    s: c64,
    driven: usize,
    modes: Vec<c64>,
    housings: Vec<c64>,
    currents: Vec<c64>,
}

impl Solved {
    /// Unknowns are the velocities of modes and housings, and the currents.
    pub fn of(exciters: &[Exciter], driven: usize, s: c64) -> Self {
        let count = exciters.len();
        let size = MODES + 2 * count;
        let mut system = Mat::<c64>::zeros(size, size);
        let mut right = Mat::<c64>::zeros(size, 1);
        for (m, pole) in poles().iter().enumerate() {
            system[(m, m)] = s + 2.0 * pole.sigma + s.inv() * pole.omega.powi(2);
        }
        for (e, exciter) in exciters.iter().enumerate() {
            let (w, housing, current) = (row(exciter.at), MODES + e, MODES + count + e);
            let Circuit { force_constant: bl, resistance, inductance } = exciter.coil;
            let Housing { mass, damping, stiffness } = exciter.housing;
            let tie = s.inv() * stiffness + damping;
            for m in 0..MODES {
                for n in 0..MODES {
                    system[(m, n)] += (s * exciter.moving_mass + tie) * (w[m] * w[n]);
                }
                system[(m, housing)] -= tie * w[m];
                system[(housing, m)] -= tie * w[m];
                system[(m, current)] -= c64::new(bl * w[m], 0.0);
            }
            system[(housing, housing)] = s * mass + tie;
            system[(housing, current)] = c64::new(bl, 0.0);
            // The amplifier holds the current, or the voltage.
            system[(current, current)] = c64::new(1.0, 0.0);
            if exciter.voltage {
                (0..MODES).for_each(|m| system[(current, m)] = c64::new(bl * w[m], 0.0));
                system[(current, housing)] = c64::new(-bl, 0.0);
                system[(current, current)] = s * inductance + resistance;
            }
            right[(current, 0)] = c64::new(f64::from(u8::from(e == driven)), 0.0);
        }
        Lu::new(system.as_ref()).solve(right.as_mut());
        let part =
            |from: usize, count: usize| -> Vec<c64> { (from..from + count).map(|i| right[(i, 0)]).collect() };
        let (housings, currents) = (part(MODES, count), part(MODES + count, count));
        Self { s, driven, modes: part(0, MODES), housings, currents }
    }

    /// The velocity of the plate at a place.
    pub fn velocity(&self, at: Point) -> c64 {
        self.modes.iter().zip(row(at)).map(|(v, w)| v * w).sum()
    }

    /// The signal of an exciter as a sensor: what its terminals have, less what its own drive causes on a plate held still. Beside it
    /// the size of what its terminals have.
    pub fn signal(&self, exciters: &[Exciter], e: usize) -> (c64, f64) {
        let Exciter { at, coil, housing, voltage, .. } = exciters[e];
        let Circuit { force_constant: bl, resistance, inductance } = coil;
        let (s, drive) = (self.s, f64::from(u8::from(e == self.driven)));
        let whole = s * housing.mass + s.inv() * housing.stiffness + housing.damping;
        if voltage {
            // On a plate held still: (Ms + c + k/s) u = -bl i and (R + Ls) i = V + bl u.
            let held = (s * inductance + resistance + whole.inv() * (bl * bl)).inv() * drive;
            return (held - self.currents[e], self.currents[e].norm());
        }
        let apart = (self.velocity(at) - self.housings[e]) * bl;
        (apart - whole.inv() * (bl * bl * drive), apart.norm())
    }
}

/// Frequencies to compare at: steady tones, and others.
pub fn frequencies() -> Vec<c64> {
    let steady = [20.0, 90.0, 150.0, 170.0, 400.0, 1100.0, 2500.0].map(|hz| c64::new(0.0, TAU * hz));
    steady.into_iter().chain([c64::new(50.0, 700.0), c64::new(3e3, 0.0), c64::new(-20.0, 4e3)]).collect()
}
