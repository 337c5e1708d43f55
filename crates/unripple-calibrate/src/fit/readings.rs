//! Responses between the actuators and many places at once, with their derivatives: what the forward model gives for taps at these places.
//!
//! A place that carries no load moves with the sheet and does not change it. So its response, and each derivative of it, is a sum over the
//! modes of their shapes there, with amplitudes that do not depend on the place: one matrix product for all places.

use super::basis::Basis;
use super::forward::multiply_alone;
use super::layout::{KNOTS, Unknown, around};
use super::system::System;
use std::f64::consts::TAU;
use unripple_core::{Point, Shapes};
use unripple_linalg::{Accum, Mat, MatRef, Par, c64, multiply, product};

/// The stiffness of a system by each unknown that changes it, in coordinates of the system's own modes: modes x modes, in (rad/s)² per unit
/// of the unknown.
#[derive(Clone, Debug)]
pub(super) struct Stiffening(Vec<Mat<f64>>);

/// Responses at many places at one complex frequency.
#[derive(Clone, Debug)]
pub(super) struct Reading {
    s: c64,
    actuators: usize,
    loads: usize,
    /// Number of unknowns that change the stiffness.
    stiff: usize,
    /// Sums over the modes, places x columns, the real part of each column followed by its imaginary part. In this order: velocities per
    /// force at each load; their changes by each stiffness, then by each knot, for each actuator; the reaction of each load to the
    /// place; slopes of the velocity at each load along x, then along y, per force at the place.
    sums: Mat<f64>,
    /// Slopes of the velocity at each load along x and y, per force at each actuator: loads x actuators.
    felt: [Mat<c64>; 2],
    /// (1 + Z Y₀)⁻¹ of the loads.
    shared: Mat<c64>,
    /// Admittance between the loads.
    admittance: Mat<c64>,
}

impl Stiffening {
    /// That of a system without taps.
    pub fn of(system: &System, basis: &Basis) -> Self {
        let turn = system.sheet.turn.as_ref();
        let one = |(stiffness, scale): (MatRef<'_, f64>, f64)| {
            let turned = product(product(turn.transpose(), stiffness).as_ref(), turn);
            Mat::from_fn(turned.nrows(), turned.ncols(), |i, j| scale * turned[(i, j)])
        };
        Self(system.stiffnesses(basis).into_iter().map(one).collect())
    }
}

impl System {
    /// The shapes of the system's modes at places (m) that carry no load: modes x places.
    pub fn shapes_at(&self, basis: &Basis, places: &[Point]) -> Mat<f64> {
        let all = basis.modes.at_all(places);
        product(self.sheet.turn.transpose(), all.subcols(0, self.sheet.squares.len()).transpose())
    }

    /// The responses at places with some `shapes`, modes x places, at a complex frequency (1/s). The system has no taps.
    pub fn reading(&self, stiffening: &Stiffening, shapes: &Mat<f64>, s: c64) -> Reading {
        let (modes, loads, actuators) = (self.shapes.nrows(), self.layout.loaded(), self.layout.actuators);
        let point = self.point(s);
        let mobility = self.mobility(s);
        // With G = (1 + Z Y₀)⁻¹, the loads react to a force at a place by -G Z times the velocities that it gives them.
        let reaction = Mat::from_fn(loads, loads, |p, q| point.shared[(p, q)] * self.impedance(q, s));
        let reacting = times(point.free.as_ref(), reaction.transpose());
        // Amplitudes whose sum over the shapes at a place is the modal velocity for a force at the place times some modal forces.
        let met = |forces: &Mat<c64>| {
            let back = times(point.free.transpose(), forces.as_ref());
            let lost = times(reacting.as_ref(), back.as_ref());
            Mat::from_fn(modes, forces.ncols(), |m, a| mobility[m] * forces[(m, a)] - lost[(m, a)])
        };
        let moved = Mat::from_fn(modes, actuators, |m, a| point.moved[(m, a)]);
        let mut columns = vec![point.moved.clone()];
        let factor = -s.inv();
        for stiffness in &stiffening.0 {
            let forces = real_times(stiffness, &moved);
            columns.push(met(&Mat::from_fn(modes, actuators, |m, a| factor * forces[(m, a)])));
        }
        for knot in 0..KNOTS.len() {
            let rates: Vec<f64> = (0..modes).map(|m| self.rate_by_knot(m, knot)).collect();
            columns.push(met(&Mat::from_fn(modes, actuators, |m, a| moved[(m, a)] * (-2.0 * rates[m]))));
        }
        columns.push(reacting.clone());
        let slopes =
            [0, 1].map(|axis| Mat::from_fn(modes, loads, |m, p| c64::new(self.slopes[axis][(m, p)], 0.0)));
        columns.extend(slopes.iter().map(met));
        Reading {
            s,
            actuators,
            loads,
            stiff: stiffening.0.len(),
            sums: summed(&columns, shapes),
            felt: slopes.map(|slope| times(slope.transpose(), moved.as_ref())),
            shared: point.shared,
            admittance: point.admittance,
        }
    }

    /// Derivative of a mode's decay rate (1/s) by the logarithm of the rate at a knot.
    fn rate_by_knot(&self, mode: usize, knot: usize) -> f64 {
        let share = self.sheet.squares[mode].max(0.0).sqrt() / (TAU * self.top);
        let weight: f64 = around(share).iter().filter(|(k, _)| *k == knot).map(|(_, weight)| weight).sum();
        self.sheet.sigmas[mode] * weight
    }
}

impl Reading {
    /// Number of columns of sums that a reading holds, for so many actuators and unknowns that change the stiffness.
    pub fn columns(actuators: usize, stiff: usize) -> usize {
        (1 + stiff + KNOTS.len() + 1 + 2) * actuators
    }

    /// Velocity at a place per force at a load, and the other way round, in m/s/N.
    pub fn admittance(&self, place: usize, load: usize) -> c64 {
        self.sum(place, load)
    }

    /// Derivative of the admittance between a place and an actuator by an unknown, in SI; 0 for gains and latency.
    pub fn slope(&self, place: usize, actuator: usize, unknown: Unknown) -> c64 {
        let by_actuator = |column: usize| self.sum(place, self.loads + column * self.actuators + actuator);
        let reacting = self.loads + (self.stiff + KNOTS.len()) * self.actuators;
        match unknown {
            Unknown::Tension => by_actuator(0),
            Unknown::Bending => by_actuator(1),
            Unknown::Skew => by_actuator(2),
            Unknown::Term(t) => by_actuator(3 + t),
            Unknown::Knot(k) => by_actuator(self.stiff + k),
            Unknown::Place(p, axis) => {
                let slope = self.sum(place, reacting + (1 + axis) * self.loads + p);
                self.shared[(p, actuator)] * slope
                    - self.felt[axis][(p, actuator)] * self.sum(place, reacting + p)
            }
            Unknown::Mass(p) => -self.s * self.admittance[(p, actuator)] * self.sum(place, p),
            Unknown::Resistance(p) => -(self.admittance[(p, actuator)] * self.sum(place, p)),
            Unknown::Drive(_) | Unknown::Sense(_) | Unknown::Level | Unknown::Late => c64::new(0.0, 0.0),
        }
    }

    fn sum(&self, place: usize, column: usize) -> c64 {
        c64::new(self.sums[(place, 2 * column)], self.sums[(place, 2 * column + 1)])
    }
}

/// Sums over the modes of shapes, modes x places, times amplitudes, each modes x columns: places x twice the columns of all.
fn summed(amplitudes: &[Mat<c64>], shapes: &Mat<f64>) -> Mat<f64> {
    let columns: usize = amplitudes.iter().map(Mat::ncols).sum();
    let mut all = Mat::<f64>::zeros(shapes.nrows(), 2 * columns);
    let mut first = 0;
    for part in amplitudes {
        for a in 0..part.ncols() {
            for m in 0..part.nrows() {
                let x = part[(m, a)];
                (all[(m, 2 * (first + a))], all[(m, 2 * (first + a) + 1)]) = (x.re, x.im);
            }
        }
        first += part.ncols();
    }
    let mut sums = Mat::zeros(shapes.ncols(), 2 * columns);
    multiply_alone(&mut sums, shapes.transpose(), all.as_ref());
    sums
}

/// A real matrix times a complex one.
fn real_times(a: &Mat<f64>, b: &Mat<c64>) -> Mat<c64> {
    let part = |of: &dyn Fn(c64) -> f64| {
        let right = Mat::from_fn(b.nrows(), b.ncols(), |i, j| of(b[(i, j)]));
        let mut out = Mat::zeros(a.nrows(), b.ncols());
        multiply_alone(&mut out, a.as_ref(), right.as_ref());
        out
    };
    let (real, imaginary) = (part(&|x| x.re), part(&|x| x.im));
    Mat::from_fn(a.nrows(), b.ncols(), |i, j| c64::new(real[(i, j)], imaginary[(i, j)]))
}

/// A product on one thread, since frequencies run in parallel.
fn times(a: MatRef<'_, c64>, b: MatRef<'_, c64>) -> Mat<c64> {
    let mut out = Mat::zeros(a.nrows(), b.ncols());
    multiply(out.as_mut(), Accum::Replace, a, b, c64::new(1.0, 0.0), Par::Seq);
    out
}
