//! Normal modes of any sheet: natural frequencies, decay rates and mass-normalised shapes.

mod bounds;
pub(crate) mod eigen;
mod general;
mod legendre;
mod rectangle;

use crate::PhysicsError;
use bounds::Bounds;
use rectangle::Problem;
use std::f64::consts::TAU;
use unripple_core::{Point, Pole, Shapes, Surface};
use unripple_linalg::Mat;

pub use legendre::gauss;

/// Memory that a solution may take, in bytes. Doubled, top frequencies may be about 1.4 times as high before
/// they are refused.
const MEMORY: f64 = 4.0 * GIB;
/// Bytes of a GiB, 2³⁰ by definition.
const GIB: f64 = (1u64 << 30) as f64;

/// The modes of a surface: frequencies, decay and mass-normalised shapes.
///
/// Shapes φ satisfy ∫ρ φ_m φ_n dS = δ_mn, ρ the mass per area with the air that moves along. They are evaluated at any
/// point of the sheet; places outside it stand for the nearest place inside. A shape's sign makes positive the first of its
/// coefficients that is at least half the largest. On a rectangle, modes of one frequency are ordered by symmetry: even along
/// x first, then even along y, then even under exchange of x and y; elsewhere any combination of them may come.
#[derive(Debug)]
pub struct Modes {
    poles: Vec<Pole>,
    bending_shares: Vec<f64>,
    shapes: Box<dyn Shapes>,
    error: f64,
}

/// What every kind of solution gives, modes ascending.
struct Found {
    omegas: Vec<f64>,
    bending_shares: Vec<f64>,
    shapes: Box<dyn Shapes>,
    error: f64,
}

impl Modes {
    /// All modes of a surface up to `max_hz`, to a relative `accuracy` of their frequencies (1e-12 to 0.1; 1e-7 is about the
    /// least that anything but a plain rectangle reaches).
    ///
    /// Any mix of clamped, supported, free and elastic sides, tension and bending together. Uniform isotropic rectangles
    /// supported all round and membranes without bending stiffness are exact. Other rectangles are Ritz sums of
    /// polynomials, split by symmetry, and of sines between supported sides; polynomials are added until what the
    /// next ones would change is below `accuracy`. Frequencies approach from above; by e^-1.5 for each polynomial, but only
    /// as their fourth power where a clamped side meets a free one. A sheet that nothing holds has rigid
    /// modes at 0 Hz: three, or one if tension levels it.
    ///
    /// Every other outline, holes, springs at the rim, grain, profiles and scatterers take continuously differentiable
    /// quintic elements on a mesh (Argyris, Fried and Scharpf 1968), curved along curved rims and graded towards corners
    /// that need it. All modes below the top are there: their number is that of negative pivots (Sylvester). Frequencies fall
    /// towards their limits as the seventh to eighth power of the edge length; two meshes are compared, and refined until they
    /// agree to `accuracy`.
    ///
    /// Air at the sides is an added mass ρ_0/√(k² - (ω/c_0)²) a side, k the wavenumber of the mode's frequency in vacuum;
    /// modes faster than sound radiate instead, and decay the faster ([`Medium`](crate::Medium)).
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for values out of range; [`PhysicsError::Outline`] for a rim that crosses itself, bounds
    /// nothing, or holes beyond it; [`PhysicsError::Unsupported`] for a sheet that nothing brings back, free all round
    /// and without stiffness; [`PhysicsError::TooLarge`] before more than 4 GiB would be taken;
    /// [`PhysicsError::NotConverged`] if refinement stalls short of the accuracy; [`PhysicsError::Solver`] if the eigenproblem
    /// of a mesh fails.
    ///
    /// ```
    /// # use unripple_core::*;
    /// # use unripple_plates::Modes;
    /// # let sheet = Sheet { material: "BoPET".into(), young: 4e9, density: 1400.0, poisson: 0.3, strength: None,
    /// #     thickness: 0.125e-3, tension: 200.0, decay: Decay::Time(0.07), air: Air::None,
    /// #     uneven: Uneven::default() };
    /// # let surface = Surface { name: "film".into(), outline: Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 }),
    /// #     sheet, emission: Emission { band: [0.0, 3e3], rate: 48e3, limit: 1.0, rms_limit: None },
    /// #     finger: Finger::default(), actuators: vec![] };
    /// let modes = Modes::solve(&surface, 400.0, 1e-6)?;
    /// let hz = modes.frequencies_hz();
    /// assert_eq!(hz.len(), 6);
    /// assert!((hz[0] - 163.7436).abs() < 1e-3);
    /// # Ok::<(), unripple_plates::PhysicsError>(())
    /// ```
    pub fn solve(surface: &Surface, max_hz: f64, accuracy: f64) -> Result<Self, PhysicsError> {
        let bounds = Bounds::of(surface, max_hz, accuracy)?;
        rests(surface, &bounds)?;
        let found = match Problem::of(surface, bounds)? {
            Some(rectangle) => rectangle::solve(&rectangle)?,
            None => general::solve(surface, &bounds)?,
        };
        let poles = found
            .omegas
            .iter()
            .zip(&found.bending_shares)
            .map(|(omega, share)| Pole::new(*omega, bounds.decay_rate(&surface.sheet.decay, *omega, *share)))
            .collect();
        Ok(Self { poles, bending_shares: found.bending_shares, shapes: found.shapes, error: found.error })
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

    /// Largest relative error of a frequency, dimensionless, as estimated; 0 where modes are exact.
    pub fn error(&self) -> f64 {
        self.error
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

/// Refuses a sheet that nothing brings back: free all round, without stiffness.
fn rests(surface: &Surface, bounds: &Bounds) -> Result<(), PhysicsError> {
    if bounds.medium.bending_stiffness > 0.0 || surface.outline.holds() {
        return Ok(());
    }
    Err(PhysicsError::Unsupported {
        what: "a sheet without bending stiffness",
        expected: "a rim held somewhere: clamped, supported or on springs",
        found: "a rim that is free all round".into(),
    })
}
