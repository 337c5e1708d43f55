//! Elastic energy of a rectangular plate in products of one-dimensional functions.

use super::line::Line;
use super::product::{Product, Symmetry};
use super::springs::Springs;
use unripple_linalg::Mat;

/// A rectangle's elastic energy per mass, in products of one function along x and one along y, both on [-1, 1].
///
/// Twice the energy of u over ρ_s is
/// R/ρ_s ∫u_x² + u_y² + D/ρ_s ∫u_xx² + u_yy² + 2ν u_xx u_yy + 2(1-ν) u_xy²,
/// so its matrix has the squares of the angular frequencies for eigenvalues relative to that of ∫u² (Leissa, *Vibration
/// of Plates*, NASA SP-160, 1969).
#[derive(Debug)]
pub(crate) struct Plate {
    /// Basis functions along x and along y.
    pub(crate) lines: [Line; 2],
    /// Tension over mass for each direction, R/ρ_s · (2/side)², in 1/s².
    pub(crate) tension: [f64; 2],
    /// Bending stiffness over mass for each direction, D/ρ_s · (2/side)⁴, in 1/s².
    pub(crate) bending: [f64; 2],
    /// Springs at the ends of x, and at those of y.
    pub(crate) springs: [Option<Springs>; 2],
    /// Poisson's ratio of the sheet, dimensionless.
    pub(crate) poisson: f64,
    /// How a loss factor couples modes to those far above; see [`losses::second`](crate::modes::losses::second).
    pub(crate) far: Option<f64>,
    /// Whether the problem is unchanged if x and y are exchanged.
    pub(crate) square: bool,
}

impl Plate {
    /// One element of the energy matrix, in 1/s².
    pub(crate) fn element(&self, p: Product, q: Product) -> f64 {
        mirrored(p, q, |p, q| self.direct(p, q))
    }

    /// One element of the mass matrix, which is the identity where the functions are orthonormal.
    pub(crate) fn mass(&self, p: Product, q: Product) -> f64 {
        let [x, y] = &self.lines;
        mirrored(p, q, |p, q| x.mass[(p.x, q.x)] * y.mass[(p.y, q.y)])
    }

    /// One element of the energy matrix, for products without their mirror images.
    fn direct(&self, Product { x: i, y: j, .. }: Product, Product { x: k, y: l, .. }: Product) -> f64 {
        let [x, y] = &self.lines;
        let mut sum = self.cross()
            * (self.poisson * (x.mixed[(i, k)] * y.mixed[(l, j)] + x.mixed[(k, i)] * y.mixed[(j, l)])
                + 2.0 * (1.0 - self.poisson) * x.slope[(i, k)] * y.slope[(j, l)]);
        let (along_x, along_y) = (x.mass[(i, k)], y.mass[(j, l)]);
        if along_y != 0.0 {
            sum += along_y * (self.tension[0] * x.slope[(i, k)] + self.bending[0] * x.curvature[(i, k)]);
            sum += along_y * self.springs[0].as_ref().map_or(0.0, |springs| springs.energy[(i, k)]);
        }
        if along_x != 0.0 {
            sum += along_x * (self.tension[1] * y.slope[(j, l)] + self.bending[1] * y.curvature[(j, l)]);
            sum += along_x * self.springs[1].as_ref().map_or(0.0, |springs| springs.energy[(j, l)]);
        }
        sum
    }

    fn cross(&self) -> f64 {
        (self.bending[0] * self.bending[1]).sqrt()
    }

    /// The energy matrix between two sets of products, rows x columns, in 1/s².
    pub(crate) fn stiffness(&self, rows: &[Product], columns: &[Product]) -> Mat<f64> {
        Mat::from_fn(rows.len(), columns.len(), |r, c| self.element(rows[r], columns[c]))
    }

    /// The energy matrix of one set of n products, n x n in 1/s², minus `shift` (1/s²) times the identity;
    /// only the lower triangle is filled.
    pub(crate) fn lower_stiffness(&self, products: &[Product], shift: f64) -> Mat<f64> {
        let n = products.len();
        let mut matrix = Mat::zeros(n, n);
        for c in 0..n {
            for r in c..n {
                matrix[(r, c)] = self.element(products[r], products[c]);
            }
            matrix[(c, c)] -= shift;
        }
        matrix
    }

    /// The same sheet with its tension and its springs alone.
    pub(crate) fn without_bending(&self) -> Self {
        Self { bending: [0.0; 2], lines: self.lines.clone(), springs: self.springs.clone(), ..*self }
    }

    /// Whether tension or springs store energy in addition to bending.
    pub(crate) fn is_held_by_more_than_bending(&self) -> bool {
        self.tension[0] > 0.0 || self.springs.iter().any(Option::is_some)
    }

    /// Whether a product moves without strain: a constant, or with no tension anything linear in x and y. Springs against displacement
    /// leave nothing, those against rotation nothing that is linear across their side.
    pub(crate) fn is_rigid(&self, product: Product) -> bool {
        let springs = |axis: usize| self.springs[axis].as_ref();
        if [0, 1].iter().any(|axis| springs(*axis).is_some_and(|springs| springs.lift)) {
            return false;
        }
        let most = usize::from(self.tension[0] == 0.0);
        let degree = |axis: usize, n: usize| {
            let degree = self.lines[axis].degree(n)?;
            (degree == 0 || !springs(axis).is_some_and(|springs| springs.tilt)).then_some(degree)
        };
        match (degree(0, product.x), degree(1, product.y)) {
            (Some(along_x), Some(along_y)) => along_x + along_y <= most,
            _ => false,
        }
    }

    /// A bound of the relative error that rounding of the energy of springs leaves in a squared frequency of `square` (rad²/s²). Where the
    /// springs are hard, their energies cancel each other in each mode.
    pub(crate) fn rounded(&self, square: f64) -> f64 {
        let springs: f64 = self.springs.iter().flatten().map(Springs::trace).sum();
        f64::EPSILON * springs / square
    }

    /// The products of one symmetry class that are rigid-body motions.
    pub(crate) fn rigid_products(&self, symmetry: Symmetry) -> usize {
        symmetry.products().filter(|p| self.is_rigid(*p)).count()
    }

    /// The products of one symmetry class, without rigid-body motions.
    pub(crate) fn products(&self, symmetry: Symmetry) -> Vec<Product> {
        symmetry.products().filter(|p| !self.is_rigid(*p)).collect()
    }
}

/// An element of a symmetric matrix between two products, each with its mirror image, from those of products alone.
fn mirrored(p: Product, q: Product, direct: impl Fn(Product, Product) -> f64) -> f64 {
    if p.mirror == 0.0 {
        return direct(p, q);
    }
    2.0 * p.weight() * q.weight() * (direct(p, q) + p.mirror * direct(p, q.mirrored()))
}
