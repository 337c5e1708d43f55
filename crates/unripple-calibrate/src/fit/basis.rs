//! Nominal modes as a Rayleigh-Ritz basis for sheets of other tension and thickness.

use super::coil::Coil;
use super::quadrature;
use crate::CalibrateError;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use unripple_core::{Outline, Point, Shapes, Surface};
use unripple_linalg::{Mat, MatRef, product};
use unripple_physics::{Accuracy, Entry, Footprint, Medium, Modes, Transducer, sensors, transducers};

/// Half the distance of the central difference for slopes of mode shapes, in metres: relative error 2e-7 for a wave of 1000 rad/m.
const STEP: f64 = 1e-6;

/// Relative accuracy of the natural frequencies, unless the surface specifies one: far below what a fit can
/// resolve. A hundred times coarser, it would show in the residuals of a quiet recording.
const ACCURACY: f64 = 1e-6;

/// The nominal modes as a Ritz basis, with the stiffness of other tensions in their coordinates.
#[derive(Debug)]
pub(super) struct Basis {
    /// The nominal modes, mass-normalised.
    pub modes: Arc<Modes>,
    /// Tension, bending stiffness and mass per area of the nominal sheet.
    pub medium: Medium,
    /// Squares of the nominal frequencies, (rad/s)².
    pub squares: Vec<f64>,
    /// Stiffness due to the nominal tension, modes x modes, in (rad/s)².
    pub tension: Mat<f64>,
    /// Stiffness due to the nominal tension along x minus that due to the tension along y, modes x modes, in
    /// (rad/s)².
    pub skew: Mat<f64>,
    /// Stiffness due to each term of the tension's profile with an amplitude of the nominal tension, modes x
    /// modes, in (rad/s)².
    pub terms: Vec<Mat<f64>>,
    /// Numbers of half waves along x and y in each term of the tension's profile.
    pub waves: Vec<[u32; 2]>,
    /// The actuators, and their nominal places.
    pub transducers: Vec<(Transducer, Point)>,
    /// The coil of each actuator whose force depends on frequency: exciters, and coils with an inductance
    /// driven by a voltage; `None` for all others.
    pub coils: Vec<Option<Coil>>,
    /// Outline of the sheet.
    pub outline: Outline,
}

impl Basis {
    /// Computes the modes of a surface up to `max_hz`, and the stiffness of a tension profile of cosines
    /// with up to `order` half waves along x and y together.
    pub fn new(surface: &Surface, max_hz: f64, order: usize) -> Result<Self, CalibrateError> {
        let modes = Modes::solve(surface, max_hz, Accuracy::of(surface.accuracy, ACCURACY))?;
        let medium = Medium::of(&surface.sheet);
        let k = 2.0 * medium.wavenumber(TAU * max_hz);
        let extent = surface.outline.extent();
        let points = quadrature::over(&surface.outline, k);
        let slopes = slopes(&modes, &points);
        let waves: Vec<[u32; 2]> =
            (1..=order as u32).flat_map(|n| (0..=n).map(move |i| [n - i, i])).collect();
        let ones = vec![1.0; points.len()];
        let [xx, yy] = [0, 1].map(|axis| gram(slopes[axis].as_ref(), &ones, medium.tension));
        let terms = waves
            .par_iter()
            .map(|wave| {
                let values: Vec<f64> = points.iter().map(|(p, _)| term(*wave, *p, extent)).collect();
                let [xx, yy] = [0, 1].map(|axis| gram(slopes[axis].as_ref(), &values, medium.tension));
                xx + yy
            })
            .collect();
        let squares = modes.poles().iter().map(|pole| pole.omega * pole.omega).collect();
        let places = surface.actuators.iter().map(|actuator| actuator.at);
        let all = transducers(surface)?;
        let coils = all.iter().zip(&sensors(surface)?).map(|(t, sensor)| Coil::of(t, sensor)).collect();
        Ok(Self {
            medium,
            squares,
            tension: &xx + &yy,
            skew: xx - yy,
            terms,
            waves,
            modes: Arc::new(modes),
            transducers: all.into_iter().zip(places).collect(),
            coils,
            outline: surface.outline.clone(),
        })
    }

    /// Contact points of load `number` when it is at the place `at`: of an actuator, or, for numbers beyond the actuators, of a
    /// stray mass at a point.
    pub fn footprint(&self, number: usize, at: Point) -> Footprint {
        let Some((transducer, nominal)) = self.transducers.get(number) else { return Footprint::point(at) };
        let (dx, dy) = (at.x - nominal.x, at.y - nominal.y);
        let moved = |(p, w): &(Point, f64)| (Point::new(p.x + dx, p.y + dy), *w);
        Footprint { points: transducer.footprint.points.iter().map(moved).collect() }
    }

    /// Natural logarithms of the actuators' nominal gains: force per unit of drive, which is also the sensor
    /// signal per unit of velocity. Of a coil driven by a voltage only the resistance counts, not the
    /// inductance; the housing of an exciter is taken to be at rest.
    pub fn gains(&self) -> Vec<f64> {
        let gain = |(t, _): &(Transducer, Point)| match (t.entry, t.load.as_ref().and_then(|l| l.circuit)) {
            (Entry::Voltage, Some(coil)) => t.gain / coil.resistance,
            _ => t.gain,
        };
        self.transducers.iter().map(|t| gain(t).abs().max(f64::MIN_POSITIVE).ln()).collect()
    }

    /// The coil of load `number` if its force depends on frequency; `None` for other actuators and for stray
    /// loads.
    pub fn coil(&self, number: usize) -> Option<&Coil> {
        self.coils.get(number).and_then(Option::as_ref)
    }

    /// Number of modes at or below a frequency (Hz).
    pub fn below(&self, hz: f64) -> usize {
        self.squares.partition_point(|square| square.sqrt() <= TAU * hz)
    }
}

/// Value of a term of the tension's profile at a point.
fn term([along, up]: [u32; 2], at: Point, (width, height): (f64, f64)) -> f64 {
    (f64::from(along) * PI * at.x / width).cos() * (f64::from(up) * PI * at.y / height).cos()
}

/// Slopes of the shapes along x and along y, times the root of each point's weight, points x modes.
fn slopes(modes: &Modes, points: &[(Point, f64)]) -> [Mat<f64>; 2] {
    [Point::new(STEP, 0.0), Point::new(0.0, STEP)].map(|d| {
        let moved =
            |s: f64| points.iter().map(|(p, _)| Point::new(p.x + s * d.x, p.y + s * d.y)).collect::<Vec<_>>();
        let (after, before) = (modes.at_all(&moved(1.0)), modes.at_all(&moved(-1.0)));
        Mat::from_fn(points.len(), modes.modes(), |p, m| {
            points[p].1.sqrt() * (after[(p, m)] - before[(p, m)]) / (2.0 * STEP)
        })
    })
}

/// Σ_p value · slope slopeᵀ, times a factor.
fn gram(slopes: MatRef<'_, f64>, values: &[f64], factor: f64) -> Mat<f64> {
    let weighed = Mat::from_fn(slopes.nrows(), slopes.ncols(), |p, m| factor * values[p] * slopes[(p, m)]);
    product(slopes.transpose(), weighed.as_ref())
}
