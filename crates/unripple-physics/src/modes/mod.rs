//! Modes of rectangular sheets.

mod adapt;
mod eigen;
mod legendre;
mod line;
mod order;
mod plate;
mod polynomials;
mod problem;
mod product;
mod readout;
mod ritz;
mod separable;

use crate::damping::decay_rate;
use crate::{Medium, PhysicsError};
use faer::Mat;
use problem::Problem;
use readout::Readout;
use separable::{Separable, Wave};
use std::f64::consts::TAU;
use unripple_core::{Point, Pole, Shapes, Surface};

pub(crate) use problem::check;

/// Memory that a solution may take, in bytes.
const MEMORY: f64 = 4.0 * GIB;
const GIB: f64 = (1u64 << 30) as f64;

/// The modes of a surface: frequencies, decay and mass-normalised shapes.
///
/// Shapes φ satisfy ∫ρ φ_m φ_n dS = δ_mn, ρ the mass per area with the air that moves along. They are evaluated at any
/// point of the rectangle to near machine precision; places outside it stand for the nearest place inside. A shape's sign
/// makes positive the first of its coefficients that is at least half the largest; modes of one frequency
/// are ordered by symmetry: even along x first, then even along y, then even under exchange of x and y.
#[derive(Debug)]
pub struct Modes {
    poles: Vec<Pole>,
    bending_shares: Vec<f64>,
    form: Form,
    sides: [f64; 2],
    error: f64,
}

/// How shapes are known.
#[derive(Debug)]
enum Form {
    /// One sine or cosine along each side.
    Separable(Separable),
    /// Sums of products.
    Ritz(Box<Readout>),
}

impl Modes {
    /// All modes of a rectangular surface up to `max_hz`, to a relative `accuracy` of their frequencies (1e-12 to 0.1).
    ///
    /// Any mix of clamped, supported and free sides, tension and bending together. Plates supported all round and
    /// membranes without bending stiffness are exact, any number of modes of them. All others are Ritz sums of
    /// polynomials, split by symmetry, and of sines between supported sides; polynomials are added until what the
    /// next ones would change is below `accuracy`. Frequencies approach from above; by e^-1.5 for each polynomial, but only
    /// as their fourth power where a clamped side meets a free one. A sheet that nothing holds has rigid
    /// modes at 0 Hz: three, or one if tension levels it.
    ///
    /// Air at the sides is an added mass ρ_0/√(k² - (ω/c_0)²) a side, k the wavenumber of the mode's frequency in vacuum.
    ///
    /// # Errors
    /// [`PhysicsError::Unsupported`] unless the outline is a rectangle; [`PhysicsError::Range`] for values out of range;
    /// [`PhysicsError::Coincidence`] if with air the top reaches the coincidence frequency;
    /// [`PhysicsError::TooLarge`] before more than 4 GiB would be taken; [`PhysicsError::NotConverged`] if rounding stops
    /// short of the accuracy.
    ///
    /// ```
    /// # use unripple_core::*;
    /// # use unripple_physics::Modes;
    /// # let sheet = Sheet { material: "BoPET".into(), young: 4e9, density: 1400.0, poisson: 0.3, strength: None,
    /// #     thickness: 0.125e-3, tension: 200.0, decay: Decay::Time(0.07), air: Air::None };
    /// # let surface = Surface { name: "film".into(), outline: Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 }),
    /// #     sheet, emission: Emission { band: [0.0, 3e3], rate: 48e3, limit: 1.0, rms_limit: None },
    /// #     finger: Finger::default(), actuators: vec![] };
    /// let modes = Modes::solve(&surface, 400.0, 1e-6)?;
    /// let hz = modes.frequencies_hz();
    /// assert_eq!(hz.len(), 6);
    /// assert!((hz[0] - 163.7436).abs() < 1e-3);
    /// # Ok::<(), unripple_physics::PhysicsError>(())
    /// ```
    pub fn solve(surface: &Surface, max_hz: f64, accuracy: f64) -> Result<Self, PhysicsError> {
        let problem = Problem::of(surface, max_hz, accuracy)?;
        let found = if problem.separable() { separable(&problem)? } else { ritz(&problem)? };
        let poles = found
            .omegas
            .iter()
            .zip(&found.bending_shares)
            .map(|(omega, share)| Pole {
                omega: *omega,
                sigma: decay_rate(&surface.sheet.decay, *omega, *share),
            })
            .collect();
        Ok(Self {
            poles,
            bending_shares: found.bending_shares,
            form: found.form,
            sides: problem.sides,
            error: found.error,
        })
    }

    /// Natural frequencies ω/2π, ascending, in Hz.
    pub fn frequencies_hz(&self) -> Vec<f64> {
        self.poles.iter().map(|pole| pole.omega / TAU).collect()
    }

    /// Amplitude decay times 1/σ, in s, infinite where nothing dissipates.
    pub fn decay_times(&self) -> Vec<f64> {
        self.poles.iter().map(|pole| 1.0 / pole.sigma).collect()
    }

    /// The decaying oscillations, frequencies ascending.
    pub fn poles(&self) -> &[Pole] {
        &self.poles
    }

    /// Bending's share of each mode's elastic energy, 0 to 1; 0 for rigid modes.
    pub fn bending_shares(&self) -> &[f64] {
        &self.bending_shares
    }

    /// Largest relative error of a frequency, as estimated; 0 where modes are exact.
    pub fn error(&self) -> f64 {
        self.error
    }

    fn inside(&self, point: Point) -> Point {
        Point::new(point.x.clamp(0.0, self.sides[0]), point.y.clamp(0.0, self.sides[1]))
    }
}

impl Shapes for Modes {
    fn modes(&self) -> usize {
        self.poles.len()
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

/// What both kinds of solution give, modes ascending.
struct Found {
    omegas: Vec<f64>,
    bending_shares: Vec<f64>,
    form: Form,
    error: f64,
}

fn separable(problem: &Problem) -> Result<Found, PhysicsError> {
    Separable::guard(problem)?;
    let waves = problem.edges.map(|[low, high]| Wave::of(low, high));
    let (shapes, wavenumbers) = Separable::up_to(problem.sides, waves, problem.k_top, problem.mass());
    let vacuum: Medium = problem.vacuum();
    let (omegas, factors): (Vec<f64>, Vec<f64>) =
        wavenumbers.iter().map(|k| loaded(problem, vacuum.omega(*k).powi(2))).unzip();
    let bending_shares = wavenumbers.iter().map(|k| vacuum.bending_share(*k)).collect();
    Ok(Found { omegas, bending_shares, form: Form::Separable(shapes.scaled(&factors)), error: 0.0 })
}

fn ritz(problem: &Problem) -> Result<Found, PhysicsError> {
    let adapt::Solution { lines, blocks, error } = adapt::solve(problem)?;
    let (squares, places) = order::ascending(&blocks);
    let mut ranks: Vec<Vec<usize>> = blocks.iter().map(|b| vec![0; b.squares.len()]).collect();
    let mut factors: Vec<Vec<f64>> = blocks.iter().map(|b| vec![0.0; b.squares.len()]).collect();
    let (mut omegas, mut bending_shares) = (Vec::new(), Vec::new());
    for (rank, (square, (b, m))) in squares.iter().zip(places).enumerate() {
        let (omega, factor) = loaded(problem, *square);
        omegas.push(omega);
        bending_shares.push(blocks[b].bending_shares[m]);
        ranks[b][m] = rank;
        factors[b][m] = factor * order::sign(blocks[b].coefficients.col(m));
    }
    let readout = Readout::new(problem.sides, lines, problem.mass(), blocks, ranks, &factors);
    Ok(Found { omegas, bending_shares, form: Form::Ritz(Box::new(readout)), error })
}

/// Frequency (rad/s) with the air's mass, and what that mass does to a mass-normalised shape: √(ρ_s/ρ_eff) = ω/ω_vacuum.
fn loaded(problem: &Problem, square: f64) -> (f64, f64) {
    let omega = problem.omega_in_air(square);
    (omega, if square > 0.0 { omega / square.sqrt() } else { 1.0 })
}
