//! Normal modes of a sheet: natural frequencies, decay rates and mass-normalised shapes.

mod best;
mod bounds;
mod disc;
pub(crate) mod eigen;
mod found;
mod general;
mod jacobi;
mod legendre;
pub(crate) mod losses;
mod rectangle;
mod ritz;

use crate::{Accuracy, PhysicsError};
use bounds::Bounds;
use found::{Errors, Found};
use std::f64::consts::TAU;
use unripple_core::{Cost, ModeError, Point, Pole, Shapes, Surface};
use unripple_linalg::Mat;

pub use legendre::gauss;

/// The normal modes of a surface without the loads of actuators and fingers: frequencies, decay rates and mass-normalised shapes.
///
/// Shapes φ satisfy ∫ρ φ_m φ_n dS = δ_mn, with ρ the mass per area including the added mass of air. They can be evaluated at any
/// point of the sheet; for a point outside they have the value at the nearest point of the sheet. The sign of a shape is such that
/// the first of its coefficients that is at least half the largest is positive. On a uniform rectangle, modes of equal frequency are
/// ordered by symmetry: even along x first, then even along y, then even under exchange of x and y. On a uniform circle, the one that is
/// even in y - centre is first. On other sheets, they may be any combination of each other.
#[derive(Debug)]
pub struct Modes {
    poles: Vec<Pole>,
    bending_shares: Vec<f64>,
    shapes: Box<dyn Shapes>,
    error: f64,
    errors: Vec<ModeError>,
}

impl Modes {
    /// Computes all modes of a surface up to `max_hz` (Hz), with a relative `accuracy` of their frequencies from 1e-12
    /// to 0.1. A plain number is refused if it cannot be reached; an [`Accuracy`] can name a larger error that is then
    /// accepted. On a mesh (see below), about 1e-7 is the best that can be reached.
    ///
    /// Clamped, supported, free and elastic sides may be mixed, and tension and bending act together. The modes of
    /// uniform isotropic rectangles are exact if all sides are supported, or if there is neither bending stiffness nor
    /// an elastic side. For other such rectangles they are found by the Ritz method, from products of polynomials (of
    /// sines between supported sides), split by symmetry. Polynomials are added until the estimated effect of further
    /// ones is below `accuracy`. Frequencies converge from above, by a factor e^-1.5 for each polynomial, but only with
    /// the fourth power of their number where a clamped side meets a free one. Springs so hard that rounding errors of
    /// their energy exceed `accuracy` are left to a mesh. A sheet that nothing holds has rigid-body modes at 0 Hz:
    /// three, or one if it is under tension.
    ///
    /// On a uniform isotropic circle with one edge condition all round the functions are polynomials of the radius times
    /// sines and cosines of the angle, one number of nodal diameters at a time.
    ///
    /// All other outlines, holes, membranes with elastic sides, orthotropy, profiles and scatterers are solved with
    /// continuously differentiable quintic elements on a mesh (Argyris, Fried and Scharpf 1968), curved along curved
    /// edges and graded towards singular corners. No mode is missed: the number of modes is known from the signs of
    /// pivots (Sylvester's law of inertia). Frequencies converge from above with the seventh to eighth power of the
    /// edge length. The error is bounded from three meshes, each finer than the one before, by the rate at which they
    /// converge, and the mesh is refined until it is below `accuracy`; where the rate is too slow for that, the
    /// accuracy is refused. A uniform isotropic plate supported along a convex polygon has the modes of the membrane on
    /// it (Conway 1961), and is solved as one.
    ///
    /// Air is an added mass ρ_0/√(k² - (ω/c_0)²) on each side, with k the wavenumber at the mode's frequency in vacuum. Modes faster
    /// than sound radiate instead, which adds to their decay rate ([`Medium`](crate::Medium)).
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for values out of range; [`PhysicsError::Outline`] for an invalid outline;
    /// [`PhysicsError::Unsupported`] for a sheet without restoring force, with free edges only and without bending stiffness;
    /// [`PhysicsError::TooLarge`] if more memory would be needed than [is allowed](unripple_core::Memory); [`PhysicsError::NotConverged`] if refinement does not
    /// reach an accuracy that is accepted; [`PhysicsError::Solver`] if the eigenvalue problem of a mesh cannot be solved.
    ///
    /// ```
    /// # use unripple_core::*;
    /// # use unripple_plates::Modes;
    /// # let sheet = Sheet { material: "BoPET".into(), young: 4e9, density: 1400.0, poisson: 0.3, strength: None,
    /// #     thickness: 0.125e-3, tension: 200.0, decay: Decay::Time(0.07), air: Air::None,
    /// #     uneven: Uneven::default() };
    /// # let surface = Surface { name: "film".into(), outline: Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 }),
    /// #     sheet, emission: Emission { band: [0.0, 3e3], rate: 48e3, limit: 1.0, rms_limit: None },
    /// #     finger: Finger::default(), accuracy: None, actuators: vec![] };
    /// let modes = Modes::solve(&surface, 400.0, 1e-6)?;
    /// let hz = modes.frequencies_hz();
    /// assert_eq!(hz.len(), 6);
    /// assert!((hz[0] - 163.7436).abs() < 1e-3);
    /// # Ok::<(), unripple_plates::PhysicsError>(())
    /// ```
    pub fn solve(
        surface: &Surface,
        max_hz: f64,
        accuracy: impl Into<Accuracy>,
    ) -> Result<Self, PhysicsError> {
        let bounds = Bounds::of(surface, max_hz, accuracy.into())?;
        rests(surface, &bounds)?;
        let found = match plain(surface, bounds)? {
            Some(found) => found,
            None => general::solve(surface, &bounds)?,
        };
        let decay = &surface.sheet.decay;
        let Found { omegas, bending_shares, shapes, error, errors } = found;
        let modes = || omegas.iter().zip(&bending_shares);
        let pole = |(omega, share): (&f64, &f64)| Pole::new(*omega, bounds.decay_rate(decay, *omega, *share));
        let stated = |((omega, share), errors): ((&f64, &f64), &Errors)| ModeError {
            frequency: errors.frequency,
            decay: bounds.decay_error(decay, *omega, *share, errors),
            shape: errors.shape,
        };
        let poles = modes().map(pole).collect();
        let errors = modes().zip(&errors).map(stated).collect();
        Ok(Self { poles, bending_shares, shapes, error, errors })
    }

    /// What [`Modes::solve`] will cost, before any mesh is made or problem solved; an estimate, mostly within a factor of two.
    ///
    /// # Errors
    /// Those of [`Modes::solve`] that are known before solving, such as [`PhysicsError::TooLarge`].
    ///
    /// ```
    /// # use unripple_core::*;
    /// # use unripple_plates::Modes;
    /// # let sheet = Sheet { material: "BoPET".into(), young: 4e9, density: 1400.0, poisson: 0.3, strength: None,
    /// #     thickness: 0.125e-3, tension: 200.0, decay: Decay::Time(0.07), air: Air::None,
    /// #     uneven: Uneven::default() };
    /// # let surface = Surface { name: "film".into(), outline: Outline::new(Shape::Stadium { straight: 0.1, radius: 0.05 }),
    /// #     sheet, emission: Emission { band: [0.0, 3e3], rate: 48e3, limit: 1.0, rms_limit: None },
    /// #     finger: Finger::default(), accuracy: None, actuators: vec![] };
    /// let [low, high] = [1000.0, 3000.0].map(|top| Modes::cost(&surface, top, 1e-4).unwrap());
    /// assert!(low.seconds < high.seconds && low.bytes < high.bytes && high.bytes < 1e9);
    /// ```
    pub fn cost(surface: &Surface, max_hz: f64, accuracy: impl Into<Accuracy>) -> Result<Cost, PhysicsError> {
        let bounds = Bounds::of(surface, max_hz, accuracy.into())?;
        rests(surface, &bounds)?;
        if let Some(rectangle) = rectangle::Problem::of(surface, bounds)? {
            return rectangle::cost(&rectangle);
        }
        match disc::Problem::of(surface, bounds)? {
            Some(disc) => disc::cost(&disc),
            None => general::estimate(surface, &bounds),
        }
    }

    /// Whether a [cache](unripple_core::Cached) holds the modes that [`Modes::solve`] would compute for these
    /// arguments.
    ///
    /// # Errors
    /// Those of [`Modes::solve`] for values out of range.
    pub fn are_cached(
        surface: &Surface,
        max_hz: f64,
        accuracy: impl Into<Accuracy>,
    ) -> Result<bool, PhysicsError> {
        let bounds = Bounds::of(surface, max_hz, accuracy.into())?;
        if let Some(rectangle) = rectangle::Problem::of(surface, bounds)? {
            return Ok(rectangle::are_cached(&rectangle));
        }
        match disc::Problem::of(surface, bounds)? {
            Some(_) => Ok(false),
            None => general::are_cached(surface, &bounds),
        }
    }

    /// Natural frequencies ω/2π, ascending, in Hz.
    pub fn frequencies_hz(&self) -> Vec<f64> {
        self.poles.iter().map(|pole| pole.omega / TAU).collect()
    }

    /// Amplitude decay times 1/σ of the modes, in s; infinite for modes without damping.
    pub fn decay_times(&self) -> Vec<f64> {
        self.poles.iter().map(|pole| 1.0 / pole.sigma).collect()
    }

    /// The poles of the modes (frequency and decay rate), in order of ascending frequency.
    pub fn poles(&self) -> &[Pole] {
        &self.poles
    }

    /// Share of bending in each mode's elastic energy, 0 to 1; 0 for rigid-body modes.
    pub fn bending_shares(&self) -> &[f64] {
        &self.bending_shares
    }

    /// An upper bound of the relative error of all frequencies, dimensionless; 0 where modes are exact. On
    /// a mesh it is about nine times the true error: from 1.5 to 200 times in tests on sheets whose
    /// frequencies are known by another method.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// Upper bounds of the relative errors of each mode, one for each pole.
    ///
    /// That of a decay time follows from those of the frequency and of the share of bending, and, with a loss factor η, from what it
    /// changes to second order: decay times are those of modes without loss, and loss couples modes where bending and tension or springs
    /// share the sheet.
    ///
    /// ```
    /// # use unripple_core::*;
    /// # use unripple_plates::Modes;
    /// # let sheet = Sheet { material: "glass".into(), young: 70e9, density: 2500.0, poisson: 0.22, strength: None,
    /// #     thickness: 1e-3, tension: 0.0, decay: Decay::LossFactor(0.02), air: Air::None,
    /// #     uneven: Uneven::default() };
    /// # let outline = Outline::new(Shape::Rectangle { width: 0.3, height: 0.2 }).with_edges(Edges::All(Edge::Supported));
    /// # let pane = Surface { name: "pane".into(), outline,
    /// #     sheet, emission: Emission { band: [0.0, 3e3], rate: 48e3, limit: 1.0, rms_limit: None },
    /// #     finger: Finger::default(), accuracy: None, actuators: vec![] };
    /// // Exact modes: all that is left is η²/8.
    /// let first = Modes::solve(&pane, 1000.0, 1e-6)?.errors()[0];
    /// assert_eq!(first.frequency, 0.0);
    /// assert!(first.decay.is_some_and(|error| (error / (0.02_f64.powi(2) / 8.0) - 1.0).abs() < 0.01));
    /// # Ok::<(), unripple_plates::PhysicsError>(())
    /// ```
    pub fn errors(&self) -> &[ModeError] {
        &self.errors
    }
}

impl Shapes for Modes {
    fn modes(&self) -> usize {
        self.poles.len()
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        self.shapes.at(point, row);
    }

    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        self.shapes.at_all(points)
    }
}

/// Modes of uniform rectangles and round sheets in functions of their own; `None` for all others, and where a mesh may reach the accuracy and
/// these do not: rounding errors of hard springs are small on a mesh, where only the unknowns at the side feel them.
fn plain(surface: &Surface, bounds: Bounds) -> Result<Option<Found>, PhysicsError> {
    let (found, meshed) = if let Some(rectangle) = rectangle::Problem::of(surface, bounds)? {
        (rectangle::solve(&rectangle), rectangle.has_springs())
    } else if let Some(disc) = disc::Problem::of(surface, bounds)? {
        (disc::solve(&disc), true)
    } else {
        return Ok(None);
    };
    match found {
        Err(PhysicsError::NotConverged { .. }) if meshed => Ok(None),
        found => found.map(Some),
    }
}

/// Refuses a sheet without restoring force: with free edges only and without bending stiffness.
fn rests(surface: &Surface, bounds: &Bounds) -> Result<(), PhysicsError> {
    if bounds.medium.bending_stiffness > 0.0 || surface.outline.resists_displacement() {
        return Ok(());
    }
    Err(PhysicsError::Unsupported {
        what: "a sheet without bending stiffness",
        expected: "a rim held somewhere: clamped, supported or on springs",
        found: "a rim that is free all round".into(),
    })
}
