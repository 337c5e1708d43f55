//! The Rayleigh-Ritz eigenvalue problem, one symmetry class at a time.

use super::super::eigen::product;
use super::super::losses;
use super::super::ritz::{lowest, missing};
use super::plate::Plate;
use super::product::{Product, Symmetry};
use unripple_core::Encoded;
use unripple_linalg::{Mat, MatRef, Par};

/// Number of products of a class from which its modes are those of a sparse problem: below, a full decomposition takes a fraction of a
/// second.
pub(crate) const LARGE: usize = 600;

/// Modes of one symmetry class, in order of ascending frequency.
#[derive(Debug)]
pub(crate) struct BlockModes {
    /// The products of basis functions of which mode shapes are sums.
    pub(crate) products: Vec<Product>,
    /// ω² of each mode, ascending, in 1/s².
    pub(crate) squares: Vec<f64>,
    /// Share of bending in the elastic energy of each mode; 0 for rigid-body modes.
    pub(crate) bending_shares: Vec<f64>,
    /// What a loss factor changes to second order, of each mode; see [`losses::second`].
    pub(crate) second: Vec<f64>,
    /// Coefficients, products x modes; columns are orthonormal.
    pub(crate) coefficients: Mat<f64>,
    /// Largest relative error of a frequency for want of further products, estimated; infinite if the products are too few to reach the
    /// top frequency.
    pub(crate) error: f64,
    /// A bound of the relative error of a squared frequency by rounding.
    pub(crate) rounded: f64,
}

impl Encoded for BlockModes {
    fn encode(&self, to: &mut Vec<u8>) {
        self.products.encode(to);
        self.squares.encode(to);
        self.bending_shares.encode(to);
        self.second.encode(to);
        self.coefficients.encode(to);
        [self.error, self.rounded].encode(to);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        let (products, squares) = <(Vec<Product>, Vec<f64>)>::decode(from)?;
        let (bending_shares, second) = <(Vec<f64>, Vec<f64>)>::decode(from)?;
        let coefficients = Mat::decode(from)?;
        let [error, rounded] = Encoded::decode(from)?;
        let sizes = (coefficients.nrows(), coefficients.ncols(), bending_shares.len());
        let fits = sizes == (products.len(), squares.len(), squares.len()) && second.len() == squares.len();
        fits.then_some(Self { products, squares, bending_shares, second, coefficients, error, rounded })
    }
}

impl BlockModes {
    /// The same modes with x and y exchanged.
    pub(crate) fn mirrored(&self) -> Self {
        Self {
            products: self.products.iter().map(|p| p.mirrored()).collect(),
            squares: self.squares.clone(),
            bending_shares: self.bending_shares.clone(),
            second: self.second.clone(),
            coefficients: self.coefficients.clone(),
            error: self.error,
            rounded: self.rounded,
        }
    }
}

/// The modes of one symmetry class with ω² up to `top`, without rigid-body modes. The error is estimated
/// from additional functions beyond those of the class.
///
/// `None` if the eigenvalue iteration does not converge.
pub(crate) fn solve_block(plate: &Plate, symmetry: Symmetry, top: f64, par: Par) -> Option<BlockModes> {
    let products = plate.products(symmetry);
    let energy = plate.stiffness(&products, &products);
    let (squares, coefficients) = lowest(&energy, top, par)?;
    let mut further = plate.products(symmetry.further(&plate.lines));
    further.retain(|p| p.x >= symmetry.x.end || p.y >= symmetry.y.end);
    let lifted = plate.lower_stiffness(&[products.as_slice(), &further].concat(), top);
    let between = plate.stiffness(&further, &products);
    let error = missing(lifted, between.as_ref(), (&squares, &coefficients), top, par);
    let inside = squares.partition_point(|v| *v <= top);
    let squares = squares[..inside].to_vec();
    let coefficients = coefficients.subcols(0, inside).to_owned();
    let (bending_shares, second) = losses(plate, &products, &squares, &coefficients, par);
    let rounded = squares.first().map_or(0.0, |lowest| plate.rounded(*lowest));
    Some(BlockModes { products, squares, bending_shares, second, coefficients, error, rounded })
}

/// The share of bending in each mode's elastic energy, 1 minus that of tension and springs, and what a loss factor changes to second order.
fn losses(
    plate: &Plate,
    products: &[Product],
    squares: &[f64],
    coefficients: &Mat<f64>,
    par: Par,
) -> (Vec<f64>, Vec<f64>) {
    if !plate.is_held_by_more_than_bending() {
        return all_bending(squares.len());
    }
    let others = plate.without_bending().stiffness(products, products);
    let forces = product(others.as_ref(), coefficients.as_ref(), par);
    shares(plate, squares, coefficients.as_ref(), forces.as_ref())
}

/// The shares of modes that store their energy in bending alone, and what a loss factor changes to second order.
pub(crate) fn all_bending(modes: usize) -> (Vec<f64>, Vec<f64>) {
    let shares = vec![1.0; modes];
    let second = losses::uncoupled(&shares);
    (shares, second)
}

/// The share of bending of each mode, and what a loss factor changes to second order, infinite for other laws of damping, for which it is not
/// computed: from the modes' shapes, in columns, and the forces (1/s²) of tension and springs on them.
pub(crate) fn shares(
    plate: &Plate,
    squares: &[f64],
    shapes: MatRef<f64>,
    forces: MatRef<f64>,
) -> (Vec<f64>, Vec<f64>) {
    let energy = |m: usize| shapes.col(m).iter().zip(forces.col(m).iter()).map(|(c, f)| c * f).sum::<f64>();
    let own: Vec<f64> =
        squares.iter().enumerate().map(|(m, square)| (1.0 - energy(m) / square).clamp(0.0, 1.0)).collect();
    let Some(far) = plate.far else { return (own, vec![f64::INFINITY; squares.len()]) };
    let others = product(shapes.transpose(), forces, Par::Seq);
    let bending = Mat::from_fn(squares.len(), squares.len(), |i, j| {
        if i == j { own[i] * squares[i] } else { -others[(i, j)] }
    });
    let second = losses::second(squares, bending.as_ref(), far, f64::INFINITY);
    (own, second)
}
