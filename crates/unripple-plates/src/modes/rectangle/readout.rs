//! Ritz mode shapes evaluated at points: in SIMD lanes at one, by matrix products at many.

use super::line::Line;
use super::product::Product;
use super::ritz::BlockModes;
use pulp::{Arch, NullaryFnOnce};
use rayon::prelude::*;
use unripple_core::Point;
use unripple_linalg::{Accum, Mat, MatMut, MatRef, Par, multiply, row_chunks};

/// Number of points whose shapes one thread computes together; more are shared among threads. With twice this value, there are
/// half as many tasks.
const POINTS: usize = 128;

/// Number of modes whose coefficients are stored together: two cache lines. With twice this value, more zeros are added to fill
/// the last lanes.
const LANES: usize = 16;

/// Number of values of y for which one thread holds sums over the functions along y. With twice this value, twice the memory: 6 MiB in each
/// thread for 500 modes of 100 functions along x.
const LINES: usize = 16;

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
    /// Indices of the functions along x and along y.
    functions: [Vec<usize>; 2],
    /// Coefficients of the mode shapes times each mode's factor: a row for each function along x of each mode in turn, a column for each
    /// function along y.
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
            .map(|((block, ranks), factors)| ReadoutBlock::new(&block, ranks, factors))
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

    /// Shapes at many points, points x modes; points are shared among threads.
    pub(crate) fn at_all(&self, points: &[Point]) -> Mat<f64> {
        let mut weights = Mat::zeros(points.len(), self.modes);
        if points.len() <= POINTS {
            self.fill(points, weights.as_mut());
        } else {
            row_chunks(weights.as_mut(), POINTS)
                .into_par_iter()
                .zip(points.par_chunks(POINTS))
                .for_each(|(weights, points)| self.fill(points, weights));
        }
        weights
    }

    /// Shapes at a few points, on one thread. Sums over the functions along y are shared by the points with the same y, as those of a row
    /// of a grid.
    fn fill(&self, points: &[Point], mut weights: MatMut<f64>) {
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by(|a, b| points[*a].y.total_cmp(&points[*b].y));
        let lines: Vec<&[usize]> = order.chunk_by(|a, b| points[*a].y == points[*b].y).collect();
        let values: Vec<[Vec<f64>; 2]> = points.iter().map(|point| self.functions_at(*point)).collect();
        for (block, lines) in self.blocks.iter().flat_map(|b| lines.chunks(LINES).map(move |l| (b, l))) {
            let [along_x, along_y] = &block.functions;
            let modes = block.ranks.len();
            let at_lines =
                Mat::from_fn(along_y.len(), lines.len(), |n, l| values[lines[l][0]][1][along_y[n]]);
            let mut sums = Mat::zeros(along_x.len() * modes, lines.len());
            let coefficients = block.coefficients.as_ref();
            multiply(sums.as_mut(), Accum::Replace, coefficients, at_lines.as_ref(), 1.0, Par::Seq);
            for (l, line) in lines.iter().enumerate() {
                let sums = MatRef::from_column_major_slice(sums.col_as_slice(l), along_x.len(), modes);
                let at_points =
                    Mat::from_fn(line.len(), along_x.len(), |p, n| values[line[p]][0][along_x[n]]);
                let mut shapes = Mat::zeros(line.len(), modes);
                multiply(shapes.as_mut(), Accum::Replace, at_points.as_ref(), sums, 1.0, Par::Seq);
                for (shape, rank) in shapes.col_iter().zip(&block.ranks) {
                    line.iter()
                        .zip(shape.iter())
                        .for_each(|(point, value)| weights[(*point, *rank)] = *value);
                }
            }
        }
    }
}

impl ReadoutBlock {
    /// The readout of one symmetry class, with each mode's coefficients multiplied by its factor.
    fn new(block: &BlockModes, ranks: Vec<usize>, factors: &[f64]) -> Self {
        let BlockModes { products, coefficients, .. } = block;
        let images = |p: &Product| if p.mirror == 0.0 { vec![*p] } else { vec![*p, p.mirrored()] };
        let mut functions = [Vec::new(), Vec::new()];
        for image in products.iter().flat_map(images) {
            functions[0].push(image.x);
            functions[1].push(image.y);
        }
        for functions in &mut functions {
            functions.sort_unstable();
            functions.dedup();
        }
        let wide = functions[0].len();
        let place = |axis: usize, function: usize| functions[axis].partition_point(|other| *other < function);
        let mut whole = Mat::zeros(wide * ranks.len(), functions[1].len());
        let size = products.len();
        let mut lanes = vec![[0.0; LANES]; size * ranks.len().div_ceil(LANES)];
        for (n, p) in products.iter().enumerate() {
            let (x, y) = (place(0, p.x), place(1, p.y));
            let mirrored = (p.mirror != 0.0).then(|| (place(0, p.y), place(1, p.x)));
            for m in 0..ranks.len() {
                let value = factors[m] * coefficients[(n, m)];
                lanes[m / LANES * size + n][m % LANES] = value;
                whole[(m * wide + x, y)] += p.weight() * value;
                if let Some((x, y)) = mirrored {
                    whole[(m * wide + x, y)] += p.mirror * p.weight() * value;
                }
            }
        }
        Self { products: products.clone(), functions, coefficients: whole, ranks, lanes }
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
