//! Block Lanczos with full reorthogonalisation.

use super::SpectrumError;
use super::factor::Factor;
use super::panel::{LANES, NONE, Panel, Row, Square, project, subtract, transform};
use super::pencil::Pencil;
use super::small::{Triangle, identity, product, transposed};
use super::solve::solve;
use unripple_core::Random;
use unripple_linalg::{Mat, exact_symmetric};

/// Ratio of the smallest to the largest pivot of a panel's Gram matrix (columns scaled to one) below which
/// another pass of orthogonalisation is needed: above it at most two digits are lost. Nearer to 1, panels
/// take more passes.
const WELL: f64 = 1e-2;
/// Ratio of pivots above which the additional pass is within the panel alone, and below which it is against
/// all panels.
const ILL: f64 = 1e-4;
/// Largest number of passes of Gram-Schmidt orthogonalisation: more than two are needed where vectors are nearly
/// dependent or replaced.
const PASSES: usize = 6;
/// Relative size of the parts subtracted from a vector up to which the vector's product with M is not
/// computed again: some hundred rounding errors. Smaller, nearly every pass would multiply by M.
const ROUNDING: f64 = 1e-13;
/// Relative size of the remainder of a vector below which the vector counts as dependent on the others and
/// is replaced by a random vector.
const NOTHING: f64 = 1e-14;

/// Block Lanczos iteration on (K - σM)⁻¹M (Grimes, Lewis and Simon, *SIAM J. Matrix Anal. Appl.* 15, 228,
/// 1994): each step adds a panel of vectors, and all vectors are kept M-orthonormal.
///
/// From each new panel the terms of the three-term recurrence are subtracted first, and then its remaining parts along all other
/// panels; one such pass suffices since these are small.
pub(super) struct Lanczos<'a> {
    pencil: &'a Pencil,
    factor: &'a Factor<'a>,
    /// Number of panels of known eigenvectors; the basis is orthogonal to these vectors.
    known: usize,
    /// The panels of known eigenvectors, then those of the basis; the operator has not been applied to the
    /// last panel.
    panels: Vec<Panel>,
    /// The product of M and the last panel.
    weighed: Panel,
    /// The operator projected on the basis: the blocks on its diagonal, and those below it.
    diagonal: Vec<Square>,
    below: Vec<Square>,
    random: Random,
    /// Scratch memory for solves.
    rows: Vec<Row>,
}

/// The Ritz approximations of eigenpairs in the basis.
pub(super) struct Ritz {
    /// The numbers 1/(λ-σ), ascending: the first belongs to the nearest λ below σ, the last to the nearest
    /// above.
    pub(super) inverses: Vec<f64>,
    /// Residuals: norms in M of (K - σM)⁻¹Mx - x/(λ-σ), times abs(λ-σ).
    pub(super) residuals: Vec<f64>,
    /// The Ritz vectors, as coefficients of the basis.
    pub(super) vectors: Mat<f64>,
}

impl<'a> Lanczos<'a> {
    /// A basis of one panel, M-orthogonal to known eigenvectors; its random numbers start from `seed`.
    ///
    /// # Errors
    /// [`SpectrumError::Matrices`] if M is not positive definite.
    pub(super) fn new(
        pencil: &'a Pencil,
        factor: &'a Factor<'a>,
        known: Vec<Panel>,
        seed: u64,
    ) -> Result<Self, SpectrumError> {
        let mut random = Random::seeded(seed);
        let mut start: Panel = (0..pencil.len()).map(|_| any(&mut random)).collect();
        let mut lanczos = Self {
            pencil,
            factor,
            known: known.len(),
            panels: known,
            weighed: vec![NONE; pencil.len()],
            diagonal: Vec::new(),
            below: Vec::new(),
            random,
            rows: Vec::new(),
        };
        solve(pencil.arch, factor, &mut start, &mut lanczos.rows);
        lanczos.append(start)?;
        Ok(lanczos)
    }

    /// Number of vectors to which the operator has been applied.
    pub(super) fn len(&self) -> usize {
        self.diagonal.len() * LANES
    }

    /// Number of vectors of the known panels and of the basis together.
    pub(super) fn taken(&self) -> usize {
        self.panels.len() * LANES
    }

    /// Applies the operator to the last panel, and appends the orthonormalised result as a new panel.
    ///
    /// # Errors
    /// [`SpectrumError::Matrices`] if M is not positive definite.
    pub(super) fn step(&mut self) -> Result<(), SpectrumError> {
        let arch = self.pencil.arch;
        let mut new = self.weighed.clone();
        solve(arch, self.factor, &mut new, &mut self.rows);
        let middle = project(arch, [&self.weighed], &new)[0];
        let count = self.panels.len();
        subtract(arch, &self.panels[count - 1..], &[middle], &mut new);
        if let Some(below) = self.below.last() {
            subtract(arch, &self.panels[count - 2..count - 1], &[transposed(below)], &mut new);
        }
        let other = transposed(&middle);
        self.diagonal
            .push(std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (middle[i][j] + other[i][j]))));
        let below = self.append(new)?;
        self.below.push(below);
        Ok(())
    }

    /// Makes a panel M-orthonormal, also to all other panels, by block Gram-Schmidt with
    /// reorthogonalisation, and appends it. Returns the coefficients of the given panel in the appended
    /// one.
    fn append(&mut self, mut new: Panel) -> Result<Square, SpectrumError> {
        let (arch, pencil) = (self.pencil.arch, self.pencil);
        let mut coefficients = identity();
        let mut first = 0;
        pencil.weigh(&new, &mut self.weighed);
        for _ in 0..PASSES {
            let before = squares(&project(arch, [&new], &self.weighed));
            if first < self.panels.len() {
                let factors = project(arch, &self.panels[first..], &self.weighed);
                subtract(arch, &self.panels[first..], &factors, &mut new);
                if !factors.iter().all(|factor| small(factor, &before)) {
                    pencil.weigh(&new, &mut self.weighed);
                }
            }
            let gram = project(arch, [&new], &self.weighed);
            let left: Row = std::array::from_fn(|i| squares(&gram)[i] / before[i]);
            first = 0;
            if !left.iter().all(|l| *l > NOTHING * NOTHING) {
                self.replace(&mut new, left.map(|l| l.is_nan() || l <= NOTHING * NOTHING), &mut coefficients);
                continue;
            }
            let triangle = Triangle::of(&gram[0])?;
            transform(arch, &triangle.inverse, &mut new);
            transform(arch, &triangle.inverse, &mut self.weighed);
            coefficients = product(&triangle.upper, &coefficients);
            let ratio = left.iter().fold(triangle.ratio, |a, b| a.min(*b));
            if ratio > WELL {
                break;
            }
            if ratio > ILL {
                first = self.panels.len();
            } else {
                pencil.weigh(&new, &mut self.weighed);
            }
        }
        self.panels.push(new);
        Ok(coefficients)
    }

    /// Replaces vectors that depend on the basis by random ones.
    fn replace(&mut self, new: &mut Panel, spent: [bool; LANES], coefficients: &mut Square) {
        for row in new.iter_mut() {
            let random = any(&mut self.random);
            for ((x, random), spent) in row.iter_mut().zip(random).zip(spent) {
                if spent {
                    *x = random;
                }
            }
        }
        for row in coefficients {
            row.iter_mut().zip(spent).filter(|(_, spent)| *spent).for_each(|(c, _)| *c = 0.0);
        }
        self.pencil.weigh(new, &mut self.weighed);
    }

    /// The eigenpairs of the operator within the basis; `None` if the eigenvalue iteration does not
    /// converge.
    pub(super) fn ritz(&self) -> Option<Ritz> {
        let count = self.len();
        let mut between = Mat::zeros(count, count);
        for (s, (middle, below)) in self.diagonal.iter().zip(&self.below).enumerate() {
            for i in 0..LANES {
                for j in 0..LANES {
                    between[(s * LANES + i, s * LANES + j)] = middle[i][j];
                    if s + 1 < self.diagonal.len() {
                        between[((s + 1) * LANES + i, s * LANES + j)] = below[i][j];
                    }
                }
            }
        }
        let (inverses, vectors) = exact_symmetric(between.as_ref())?;
        let last = self.below.last()?;
        let residuals = vectors.col_iter().zip(&inverses).map(|(vector, inverse)| {
            let end = vector.subrows(count - LANES, LANES);
            let rest = last.iter().map(|row| row.iter().zip(end.iter()).map(|(l, v)| l * v).sum::<f64>());
            rest.map(|r| r * r).sum::<f64>().sqrt() / inverse.abs()
        });
        Some(Ritz { residuals: residuals.collect(), inverses, vectors })
    }

    /// The eigenvectors of the Ritz pairs with the given indices, in panels; the last panel is padded with
    /// zeros.
    pub(super) fn vectors(&self, ritz: &Ritz, numbers: &[usize]) -> Vec<Panel> {
        let panels = &self.panels[self.known..][..self.diagonal.len()];
        let mut out = Vec::new();
        for numbers in numbers.chunks(LANES) {
            let factor = |p: usize| -> Square {
                std::array::from_fn(|i| {
                    std::array::from_fn(|j| {
                        numbers.get(j).map_or(0.0, |number| -ritz.vectors[(p * LANES + i, *number)])
                    })
                })
            };
            let factors: Vec<Square> = (0..panels.len()).map(factor).collect();
            let mut panel = vec![NONE; self.pencil.len()];
            subtract(self.pencil.arch, panels, &factors, &mut panel);
            out.push(panel);
        }
        out
    }
}

/// A row of random numbers between -1 and 1.
fn any(random: &mut Random) -> Row {
    std::array::from_fn(|_| random.between(-1.0, 1.0))
}

/// Whether the parts subtracted from each vector are below rounding errors, given the squares of the vectors' norms.
fn small(factor: &Square, squares: &Row) -> bool {
    factor.iter().all(|row| row.iter().zip(squares).all(|(f, s)| f * f <= ROUNDING * ROUNDING * s))
}

/// Squared norms of a panel's vectors, from their Gram matrix.
fn squares(gram: &[Square]) -> Row {
    std::array::from_fn(|i| gram[0][i][i])
}
