//! Mode shapes of round sheets at points.

use super::super::eigen::{product, sign};
use super::order::OrderModes;
use super::problem::Problem;
use super::radial::Radial;
use rayon::prelude::*;
use std::f64::consts::PI;
use unripple_core::{Point, Shapes};
use unripple_linalg::{Mat, Par, row_chunks};

/// Number of points that one thread computes together. With twice this value, there are half as many tasks to share.
const POINTS: usize = 128;

/// Mode shapes of a round sheet; a point outside has the value at the nearest point inside.
#[derive(Debug)]
pub(super) struct Round {
    radius: f64,
    modes: usize,
    orders: Vec<Order>,
}

/// Those of one angular order.
#[derive(Debug)]
struct Order {
    radial: Radial,
    /// The shape of each mode along the radius, modes x functions, in 1/√kg.
    weights: Mat<f64>,
    /// Index among all modes of each mode's cosine.
    cosines: Vec<usize>,
    /// Index among all modes of each mode's sine; empty for order 0.
    sines: Vec<usize>,
}

impl Order {
    /// The modes of one order, each with the factor `factors[m]` of its shape.
    fn new(problem: &Problem, of: OrderModes, factors: &[f64]) -> Self {
        let circle = if of.radial.order == 0 { 2.0 * PI } else { PI };
        let mass = problem.bounds.medium.areal_density * problem.radius * problem.radius * circle;
        let scale = |m: usize| sign(of.coefficients.col(m)) * factors[m] / mass.sqrt();
        let scales: Vec<f64> = (0..factors.len()).map(scale).collect();
        let (modes, functions) = (scales.len(), of.radial.count());
        let weights = Mat::from_fn(modes, functions, |m, j| scales[m] * of.coefficients[(j, m)]);
        Self { radial: of.radial, weights, cosines: Vec::new(), sines: Vec::new() }
    }

    /// Writes its modes at points (radius as a share of the whole, angle in rad) into `values`, all modes x points.
    fn write(&self, points: &[(f64, f64)], values: &mut Mat<f64>) {
        let mut functions = Mat::zeros(self.radial.count(), points.len());
        for (column, (xi, _)) in functions.col_iter_mut().zip(points) {
            let column = column.try_as_col_major_mut().expect("columns of a new matrix are contiguous");
            self.radial.at(*xi, column.as_slice_mut());
        }
        let along = product(self.weights.as_ref(), functions.as_ref(), Par::Seq);
        for (p, (_, theta)) in points.iter().enumerate() {
            let (sin, cos) = (self.radial.order as f64 * theta).sin_cos();
            self.cosines.iter().enumerate().for_each(|(m, place)| values[(*place, p)] = along[(m, p)] * cos);
            self.sines.iter().enumerate().for_each(|(m, place)| values[(*place, p)] = along[(m, p)] * sin);
        }
    }
}

/// The place of a mode: its angular order, its rank there, and whether it is the sine.
pub(super) type Place = (usize, usize, bool);

impl Round {
    /// Mode i of all is the one at `places[i]`; mode `m` of angular order `n` has the factor `factors[n][m]`.
    pub(super) fn new(
        problem: &Problem,
        orders: Vec<OrderModes>,
        places: &[Place],
        factors: &[Vec<f64>],
    ) -> Self {
        let all = orders.into_iter().zip(factors);
        let mut orders: Vec<Order> = all.map(|(of, factors)| Order::new(problem, of, factors)).collect();
        // Of each order in ascending rank, since all modes are in ascending frequency.
        for (i, (n, _, sine)) in places.iter().enumerate() {
            let order = &mut orders[*n];
            if *sine { order.sines.push(i) } else { order.cosines.push(i) }
        }
        orders.retain(|order| !order.cosines.is_empty());
        Self { radius: problem.radius, modes: places.len(), orders }
    }

    /// All modes x points.
    fn block(&self, points: &[Point]) -> Mat<f64> {
        let polar = |point: &Point| {
            let (x, y) = (point.x / self.radius - 1.0, point.y / self.radius - 1.0);
            (x.hypot(y).min(1.0), y.atan2(x))
        };
        let polar: Vec<(f64, f64)> = points.iter().map(polar).collect();
        let mut values = Mat::zeros(self.modes, points.len());
        self.orders.iter().for_each(|order| order.write(&polar, &mut values));
        values
    }
}

impl Shapes for Round {
    fn modes(&self) -> usize {
        self.modes
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        let values = self.block(&[point]);
        row.iter_mut().zip(values.col(0).iter()).for_each(|(to, value)| *to = *value);
    }

    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        let mut all = Mat::zeros(points.len(), self.modes);
        row_chunks(all.as_mut(), POINTS).into_par_iter().zip(points.par_chunks(POINTS)).for_each(
            |(rows, points)| {
                let mut rows = rows;
                rows.copy_from(self.block(points).transpose());
            },
        );
        all
    }
}
