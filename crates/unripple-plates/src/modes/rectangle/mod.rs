//! Modes of rectangles: in closed form, or by the Rayleigh-Ritz method with products of one function along each side.

mod adapt;
mod cost;
mod counts;
mod integrated;
mod line;
mod order;
mod plate;
mod polynomials;
mod problem;
mod product;
mod readout;
mod ritz;
mod separable;
mod sparse;
mod springs;

use super::eigen::sign;
use super::found::{Errors, Found};
use super::losses;
use crate::{Medium, PhysicsError};
use readout::Readout;
use separable::{Separable, Wave};
use unripple_core::{Cached, Point, Shapes};
use unripple_linalg::Mat;

pub(super) use cost::cost;
pub(super) use problem::Problem;

/// Modes of a rectangle: in closed form where they are products of sines and cosines, otherwise by the Ritz
/// method.
pub(super) fn solve(problem: &Problem) -> Result<Found, PhysicsError> {
    if problem.separable() { separable(problem) } else { ritz(problem) }
}

/// Mode shapes of a rectangle; a point outside has the value at the nearest point inside.
#[derive(Debug)]
struct Rectangle {
    sides: [f64; 2],
    modes: usize,
    form: Form,
}

/// The form of mode shapes.
#[derive(Debug)]
enum Form {
    /// Products of a sine or cosine along each side.
    Separable(Separable),
    /// Sums of products of basis functions.
    Ritz(Box<Readout>),
}

impl Rectangle {
    fn inside(&self, point: Point) -> Point {
        Point::new(point.x.clamp(0.0, self.sides[0]), point.y.clamp(0.0, self.sides[1]))
    }
}

impl Shapes for Rectangle {
    fn modes(&self) -> usize {
        self.modes
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        match &self.form {
            Form::Separable(shapes) => shapes.at(self.inside(point), row),
            Form::Ritz(shapes) => shapes.at(self.inside(point), row),
        }
    }

    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        let inside: Vec<Point> = points.iter().map(|p| self.inside(*p)).collect();
        match &self.form {
            Form::Separable(shapes) => shapes.at_all(&inside),
            Form::Ritz(shapes) => shapes.at_all(&inside),
        }
    }
}

/// Exact modes: products of one wave along each side.
fn separable(problem: &Problem) -> Result<Found, PhysicsError> {
    Separable::guard(problem)?;
    let waves = problem.edges.map(|[low, high]| Wave::of(low, high));
    let (shapes, wavenumbers) = Separable::up_to(problem.sides, waves, problem.bounds.k_top, problem.mass());
    let vacuum: Medium = problem.bounds.vacuum();
    let (omegas, factors): (Vec<f64>, Vec<f64>) =
        wavenumbers.iter().map(|k| problem.bounds.loaded(vacuum.omega(*k).powi(2))).unzip();
    let bending_shares: Vec<f64> = wavenumbers.iter().map(|k| vacuum.bending_share(*k)).collect();
    let exact = |second| Errors { second, ..Errors::default() };
    let errors = losses::uncoupled(&bending_shares).into_iter().map(exact).collect();
    let form = Form::Separable(shapes.scaled(&factors));
    let shapes = Rectangle { sides: problem.sides, modes: omegas.len(), form };
    Ok(Found { omegas, bending_shares, shapes: Box::new(shapes), error: 0.0, errors })
}

/// The key of a problem's solution in a cache.
fn key(problem: &Problem) -> String {
    format!("modes of a rectangle: {problem:?}")
}

/// Whether the modes are in the cache.
pub(super) fn are_cached(problem: &Problem) -> bool {
    !problem.separable() && Cached::here().holds(|| key(problem))
}

/// Modes by the Ritz method, in order of frequency, with the added mass of air and a definite sign.
fn ritz(problem: &Problem) -> Result<Found, PhysicsError> {
    let key = || key(problem);
    let adapt::Solution { counts, blocks, error } = Cached::here().result(key, || adapt::solve(problem))?;
    let lines = adapt::lines(problem, counts);
    let (squares, places) = order::ascending(&blocks);
    let mut ranks: Vec<Vec<usize>> = blocks.iter().map(|b| vec![0; b.squares.len()]).collect();
    let mut factors: Vec<Vec<f64>> = blocks.iter().map(|b| vec![0.0; b.squares.len()]).collect();
    let (mut omegas, mut bending_shares, mut errors) = (Vec::new(), Vec::new(), Vec::new());
    for (rank, (square, (b, m))) in squares.iter().zip(places).enumerate() {
        let (omega, factor) = problem.bounds.loaded(*square);
        omegas.push(omega);
        let share = blocks[b].bending_shares[m];
        bending_shares.push(share);
        errors.push(if *square > 0.0 {
            Errors::of_ritz(error, share, blocks[b].second[m])
        } else {
            Errors::default()
        });
        ranks[b][m] = rank;
        factors[b][m] = factor * sign(blocks[b].coefficients.col(m));
    }
    let readout = Readout::new(problem.sides, lines, problem.mass(), blocks, ranks, &factors);
    let form = Form::Ritz(Box::new(readout));
    let shapes = Rectangle { sides: problem.sides, modes: omegas.len(), form };
    Ok(Found { omegas, bending_shares, shapes: Box::new(shapes), error, errors })
}
