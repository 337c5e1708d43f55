//! Ritz mode shapes evaluated at points, in SIMD lanes.

use super::line::Line;
use super::product::Product;
use super::ritz::BlockModes;
use pulp::{Arch, NullaryFnOnce};
use rayon::prelude::*;
use unripple_core::Point;
use unripple_linalg::{Accum, Mat, MatMut, Par, multiply};

/// Number of points whose shapes one thread computes together; more are shared among threads. With twice this value, there are
/// half as many tasks.
const POINTS: usize = 128;

/// Number of modes whose coefficients are stored together: two cache lines. With twice this value, more zeros are added to fill
/// the last lanes.
const LANES: usize = 16;

/// Evaluates Ritz mode shapes: sums of products of one function along each side.
#[derive(Debug)]
pub(crate) struct Readout {
    sides: [f64; 2],
    lines: [Line; 2],
    /// Factor from functions orthonormal on [-1, 1]² to mass-normalised shapes, in 1/√kg.
    scale: f64,
    blocks: Vec<ReadoutBlock>,
    /// The SIMD instruction set of the processor.
    arch: Arch,
    modes: usize,
}

/// The modes of one symmetry class.
#[derive(Debug)]
struct ReadoutBlock {
    products: Vec<Product>,
    /// Coefficients of the mode shapes, products x modes, times each mode's factor.
    coefficients: Mat<f64>,
    /// Index of each mode of the class among all modes.
    ranks: Vec<usize>,
    /// A copy of the coefficients for evaluation at single points: [`LANES`] modes of all products, then
    /// the next modes.
    lanes: Vec<[f64; LANES]>,
}

impl Readout {
    /// A readout for the modes of all blocks. Mode m of block b has the index `ranks[b][m]` among all modes, and its shape is
    /// multiplied by `factors[b][m]` (sign and added mass of air); `mass` is that of the sheet in kg.
    pub(crate) fn new(
        sides: [f64; 2],
        lines: [Line; 2],
        mass: f64,
        blocks: Vec<BlockModes>,
        ranks: Vec<Vec<usize>>,
        factors: &[Vec<f64>],
    ) -> Self {
        let modes = ranks.iter().map(Vec::len).sum();
        let blocks: Vec<ReadoutBlock> = blocks
            .into_iter()
            .zip(ranks)
            .zip(factors)
            .filter(|((_, ranks), _)| !ranks.is_empty())
            .map(|((block, ranks), factors)| ReadoutBlock::new(block, ranks, factors))
            .collect();
        Self { sides, lines, scale: 2.0 / mass.sqrt(), blocks, arch: Arch::new(), modes }
    }

    /// Values of the functions along x (times `scale`) and along y at a point.
    fn functions_at(&self, point: Point) -> [Vec<f64>; 2] {
        let mut values = [vec![0.0; self.lines[0].count()], vec![0.0; self.lines[1].count()]];
        self.lines[0].at(2.0 * point.x / self.sides[0] - 1.0, &mut values[0]);
        self.lines[1].at(2.0 * point.y / self.sides[1] - 1.0, &mut values[1]);
        values[0].iter_mut().for_each(|v| *v *= self.scale);
        values
    }

    /// Mass-normalised shapes at a point, in 1/√kg.
    pub(crate) fn at(&self, point: Point, row: &mut [f64]) {
        let [along_x, along_y] = self.functions_at(point);
        let mut deflections = Vec::new();
        for block in &self.blocks {
            deflections.clear();
            deflections.extend(block.products.iter().map(|p| p.at(&along_x, &along_y)));
            self.arch.dispatch(Sum { block, deflections: &deflections, row });
        }
    }

    /// Shapes at many points, points x modes: one matrix product per symmetry class, points shared among threads.
    pub(crate) fn at_all(&self, points: &[Point]) -> Mat<f64> {
        let mut weights = Mat::zeros(points.len(), self.modes);
        if points.len() <= POINTS {
            self.fill(points, weights.as_mut());
        } else {
            weights
                .as_mut()
                .par_row_chunks_mut(POINTS)
                .zip(points.par_chunks(POINTS))
                .for_each(|(weights, points)| self.fill(points, weights));
        }
        weights
    }

    /// Shapes at a few points, on one thread.
    fn fill(&self, points: &[Point], mut weights: MatMut<f64>) {
        let mut functions = [0, 1].map(|axis: usize| Mat::zeros(points.len(), self.lines[axis].count()));
        for (p, point) in points.iter().enumerate() {
            let values = self.functions_at(*point);
            for (functions, values) in functions.iter_mut().zip(values) {
                functions.row_mut(p).iter_mut().zip(values).for_each(|(f, v)| *f = v);
            }
        }
        for block in &self.blocks {
            let mut deflections = Mat::zeros(points.len(), block.products.len());
            for (product, column) in block.products.iter().zip(deflections.col_iter_mut()) {
                product.fill(&functions, column);
            }
            let mut shapes = Mat::zeros(points.len(), block.ranks.len());
            let (deflections, coefficients) = (deflections.as_ref(), block.coefficients.as_ref());
            multiply(shapes.as_mut(), Accum::Replace, deflections, coefficients, 1.0, Par::Seq);
            for (column, rank) in block.ranks.iter().enumerate() {
                weights.as_mut().col_mut(*rank).copy_from(shapes.col(column));
            }
        }
    }
}

impl ReadoutBlock {
    /// The readout of one symmetry class, with each mode's coefficients multiplied by its factor.
    fn new(block: BlockModes, ranks: Vec<usize>, factors: &[f64]) -> Self {
        let BlockModes { products, mut coefficients, .. } = block;
        for (m, factor) in factors.iter().enumerate() {
            coefficients.col_mut(m).iter_mut().for_each(|c| *c *= factor);
        }
        let size = products.len();
        let mut lanes = vec![[0.0; LANES]; size * ranks.len().div_ceil(LANES)];
        for m in 0..ranks.len() {
            for (n, c) in coefficients.col(m).iter().enumerate() {
                lanes[m / LANES * size + n][m % LANES] = *c;
            }
        }
        Self { products, coefficients, ranks, lanes }
    }
}

/// Shapes of one symmetry class at a point, from the values of its products there.
struct Sum<'a> {
    block: &'a ReadoutBlock,
    deflections: &'a [f64],
    /// The shapes of all modes, of which those of the class are written.
    row: &'a mut [f64],
}

impl NullaryFnOnce for Sum<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let groups = self.block.lanes.chunks_exact(self.deflections.len());
        for (ranks, lanes) in self.block.ranks.chunks(LANES).zip(groups) {
            let mut sums = [0.0; LANES];
            for (lanes, deflection) in lanes.iter().zip(self.deflections) {
                for (sum, lane) in sums.iter_mut().zip(lanes) {
                    *sum += lane * deflection;
                }
            }
            for (rank, sum) in ranks.iter().zip(sums) {
                self.row[*rank] = sum;
            }
        }
    }
}
