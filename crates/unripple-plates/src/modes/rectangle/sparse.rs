//! The Rayleigh-Ritz problem of a symmetry class with many products, as a sparse one.

use super::super::ritz::ABOVE;
use super::line::{Class, Line};
use super::plate::Plate;
use super::product::{Product, Symmetry};
use super::ritz::{BlockModes, all_bending, shares};
use crate::modes::eigen::product;
use crate::spectrum::{self, Pairs, SpectrumError};
use unripple_core::Observed;
use unripple_linalg::sparse::{SparseColMat, SymbolicSparseColMat};
use unripple_linalg::{Cholesky, Mat, MatRef, Par, exact_symmetric, solve_lower_alone, solve_upper_alone};

/// Share of the top ω² up to which modes are combined anew in cubics: below, rounding errors of functions that fade mix modes that are as close
/// as they are. With twice this value, a seventh more modes are.
const LOWEST: f64 = 1e-3;

/// A rectangle's energy in functions that couple with few others; see [`Integrated`](super::integrated::Integrated).
#[derive(Debug)]
pub(crate) struct SparsePlate {
    /// In functions that fade from the sides, by which modes are found.
    plate: Plate,
    /// In cubics instead, by which the energies of the lowest modes are found to more digits.
    cubic: Plate,
    /// The functions of `plate` along each side in terms of those of `cubic`.
    in_cubics: [Mat<f64>; 2],
    /// The functions of `plate` along each side in terms of orthonormal ones.
    in_orthonormal: [Mat<f64>; 2],
}

impl SparsePlate {
    /// A plate in functions that fade from the sides and in cubics, and the `orthonormal` functions of the same space along both sides.
    pub(crate) fn new(plate: Plate, cubic: Plate, orthonormal: &[Line; 2]) -> Self {
        let in_cubics = [0, 1].map(|axis: usize| plate.lines[axis].in_cubics());
        let in_orthonormal = [0, 1].map(|axis: usize| orthonormal[axis].coordinates(&plate.lines[axis]));
        Self { plate, cubic, in_cubics, in_orthonormal }
    }

    /// The modes of one symmetry class with ω² up to `top`, as by [`solve_block`](super::ritz::solve_block): the same space, and the same
    /// estimate of the error.
    ///
    /// # Errors
    /// Those of [`spectrum::below`].
    pub(crate) fn solve_block(&self, symmetry: Symmetry, top: f64) -> Result<BlockModes, SpectrumError> {
        let plate = &self.plate;
        let inner: Vec<Product> = symmetry.products().collect();
        let mut pairs = self.lowest(&inner, symmetry.mirror, top * (1.0 + ABOVE))?;
        let cubic = matrices(&self.cubic, &inner, symmetry.mirror);
        self.settle(symmetry, &inner, &cubic, &mut pairs, top * LOWEST);
        let error = self.missing(symmetry, &inner, top, (&pairs.values, pairs.vectors.as_ref()))?;
        // Rigid-body modes are known exactly, and listed elsewhere.
        let rigid = plate.rigid_products(symmetry).min(pairs.values.len());
        let inside = pairs.values.partition_point(|v| *v <= top).max(rigid);
        let vectors = pairs.vectors.as_ref().subcols(rigid, inside - rigid);
        let smooth = turned(symmetry, &self.in_cubics, (&inner, vectors), &inner);
        let [stiffness, _] = cubic;
        let (squares, rounded) = energies(stiffness, smooth.as_ref());
        let (bending_shares, second) = self.losses(&inner, symmetry.mirror, &squares, smooth.as_ref());
        let products = plate.products(symmetry);
        let coefficients = turned(symmetry, &self.in_orthonormal, (&inner, vectors), &products);
        Ok(BlockModes { products, squares, bending_shares, second, coefficients, error, rounded })
    }

    /// The modes between the given products with ω² below `top`, K x = ω² M x with xᵀMx = 1, from the pencil K x = κ (K + τM) x.
    ///
    /// Its eigenvalues are κ = ω²/(ω²+τ) and its vectors the same, but the norm is one of energy: where sides are free, M is singular in
    /// double precision, since the integrated polynomials can all but make up the cubics on the sheet though not at its sides.
    fn lowest(&self, products: &[Product], mirror: f64, top: f64) -> Result<Pairs, SpectrumError> {
        let [stiffness, mut norm] = matrices(&self.plate, products, mirror);
        for (m, k) in norm.val_mut().iter_mut().zip(stiffness.val()) {
            *m = k + top * *m;
        }
        let mut pairs = spectrum::below(stiffness.as_ref(), norm.as_ref(), 0.5, &Observed::default())?;
        for (value, vector) in pairs.values.iter_mut().zip(pairs.vectors.as_mut().col_iter_mut()) {
            *value *= top / (1.0 - *value);
            let scale = (*value + top).sqrt();
            vector.iter_mut().for_each(|x| *x *= scale);
        }
        Ok(pairs)
    }

    /// Combines the modes with ω² below `bound` anew, rigid-body modes among them, by a Rayleigh-Ritz step in cubics, of which `cubic` has the
    /// matrices of energy and mass: in functions that fade,
    /// their energies are small differences of large numbers, whose rounding errors mix them.
    fn settle(
        &self,
        symmetry: Symmetry,
        inner: &[Product],
        cubic: &[SparseColMat<usize, f64>; 2],
        pairs: &mut Pairs,
        bound: f64,
    ) {
        let count = pairs.values.partition_point(|value| *value < bound);
        let few = pairs.vectors.as_ref().subcols(0, count);
        let smooth = turned(symmetry, &self.in_cubics, (inner, few), inner);
        let [stiffness, mass] = cubic.each_ref().map(|matrix| {
            let products = spectrum::symmetric_times(matrix.as_ref(), smooth.as_ref());
            product(smooth.transpose(), products.as_ref(), Par::Seq)
        });
        let Some((values, turn)) = generalised(&stiffness, &mass) else { return };
        let settled = product(few, turn.as_ref(), Par::Seq);
        pairs.vectors.as_mut().subcols_mut(0, count).copy_from(&settled);
        pairs.values[..count].iter_mut().zip(values).for_each(|(to, value)| *to = value.max(0.0));
    }

    /// Largest relative change of a frequency by the functions beyond those of the class; see [`missing`](super::ritz::missing).
    fn missing(
        &self,
        symmetry: Symmetry,
        inner: &[Product],
        top: f64,
        (values, vectors): (&[f64], MatRef<f64>),
    ) -> Result<f64, SpectrumError> {
        let all: Vec<Product> = symmetry.further(&self.plate.lines).products().collect();
        if all.len() == inner.len() || values.is_empty() {
            return Ok(0.0);
        }
        let mut places = all.iter().enumerate();
        let places: Vec<usize> =
            inner.iter().filter_map(|p| places.find(|(_, q)| *q == p).map(|(place, _)| place)).collect();
        let mut padded = Mat::zeros(all.len(), vectors.ncols());
        for (mut to, from) in padded.as_mut().col_iter_mut().zip(vectors.col_iter()) {
            places.iter().zip(from.iter()).for_each(|(place, value)| to[*place] = *value);
        }
        let [stiffness, mass] = matrices(&self.plate, &all, symmetry.mirror);
        let known = (values, padded.as_ref());
        let Some(works) = spectrum::lifted_works(stiffness.as_ref(), mass.as_ref(), top, known)? else {
            return Ok(f64::INFINITY);
        };
        let rigid = self.plate.rigid_products(symmetry);
        let inside = values.partition_point(|value| *value <= top);
        let changes = (rigid..inside).map(|m| works[m] / values[m]);
        // What is no number bounds nothing.
        Ok(changes.fold(0.0, |most, change| if change.is_nan() { f64::INFINITY } else { most.max(change) }))
    }

    /// The share of bending in the elastic energy of each mode, given in cubics, 1 minus that of tension and springs, and what a loss
    /// factor changes to second order.
    fn losses(
        &self,
        inner: &[Product],
        mirror: f64,
        squares: &[f64],
        smooth: MatRef<f64>,
    ) -> (Vec<f64>, Vec<f64>) {
        if !self.cubic.is_held_by_more_than_bending() {
            return all_bending(squares.len());
        }
        let [stiffness, _] = matrices(&self.cubic.without_bending(), inner, mirror);
        let forces = spectrum::symmetric_times(stiffness.as_ref(), smooth);
        shares(&self.cubic, squares, smooth, forces.as_ref())
    }
}

/// Eigenvalues of K x = λ M x, ascending, and vectors with xᵀMx = 1, of small matrices. `None` if M is not positive definite.
fn generalised(stiffness: &Mat<f64>, mass: &Mat<f64>) -> Option<(Vec<f64>, Mat<f64>)> {
    let factor = Cholesky::new(mass.as_ref())?;
    let mut half = stiffness.clone();
    solve_lower_alone(factor.lower(), half.as_mut());
    let mut whole = half.transpose().to_owned();
    solve_lower_alone(factor.lower(), whole.as_mut());
    let (values, mut vectors) = exact_symmetric(whole.as_ref())?;
    solve_upper_alone(factor.lower().transpose(), vectors.as_mut());
    Some((values, vectors))
}

/// The energy xᵀKx of each shape, and the largest relative error that rounding of the entries of K may leave, ε|x|ᵀ|K||x|.
fn energies(mut stiffness: SparseColMat<usize, f64>, vectors: MatRef<f64>) -> (Vec<f64>, f64) {
    let energies = spectrum::works(stiffness.as_ref(), vectors);
    stiffness.val_mut().iter_mut().for_each(|value| *value = value.abs());
    let sizes = Mat::from_fn(vectors.nrows(), vectors.ncols(), |i, j| vectors[(i, j)].abs());
    let most = spectrum::works(stiffness.as_ref(), sizes.as_ref());
    let worst = energies.iter().zip(&most).map(|(energy, most)| most / energy).fold(0.0, f64::max);
    (energies, f64::EPSILON * worst)
}

/// The energy matrix (1/s²) and the mass matrix between products, which are in the order of their indices along x, then y; both
/// triangles.
fn matrices(plate: &Plate, products: &[Product], mirror: f64) -> [SparseColMat<usize, f64>; 2] {
    let [x, y] = &plate.lines;
    let high = y.count();
    let mut places = vec![usize::MAX; x.count() * high];
    products.iter().enumerate().for_each(|(place, p)| places[p.x * high + p.y] = place);
    let (mut starts, mut rows) = (vec![0], Vec::new());
    let (mut stiffness, mut mass) = (Vec::new(), Vec::new());
    for q in products {
        let mut column = Vec::new();
        let images = if mirror == 0.0 { vec![*q] } else { vec![*q, q.mirrored()] };
        for image in images {
            for i in x.near(image.x) {
                column.extend(y.near(image.y).map(|j| places[i * high + j]));
            }
        }
        column.retain(|place| *place != usize::MAX);
        column.sort_unstable();
        column.dedup();
        for place in column {
            let (k, m) = (plate.element(products[place], *q), plate.mass(products[place], *q));
            if k != 0.0 || m != 0.0 {
                rows.push(place);
                stiffness.push(k);
                mass.push(m);
            }
        }
        starts.push(rows.len());
    }
    let pattern = SymbolicSparseColMat::new_checked(products.len(), products.len(), starts, None, rows);
    [stiffness, mass].map(|values| SparseColMat::new(pattern.clone(), values))
}

/// Shapes given by products of functions, in products of others; `turns` has the functions along each side in terms of those. Products x
/// modes.
fn turned(
    symmetry: Symmetry,
    turns: &[Mat<f64>; 2],
    (from, vectors): (&[Product], MatRef<f64>),
    to: &[Product],
) -> Mat<f64> {
    let Symmetry { x, y, .. } = symmetry;
    let within = |axis: usize, class: Class| {
        Mat::from_fn(class.len(), class.len(), |i, j| turns[axis][(class.index(i), class.index(j))])
    };
    let (along_x, along_y) = (within(0, x), within(1, y));
    let place = |p: &Product| (y.place(p.y), x.place(p.x));
    let mut shapes = Mat::zeros(to.len(), vectors.ncols());
    for (shape, vector) in shapes.as_mut().col_iter_mut().zip(vectors.col_iter()) {
        // Rows along y, columns along x: with the mirror images, both triangles.
        let mut grid = Mat::zeros(y.len(), x.len());
        for (p, value) in from.iter().zip(vector.iter()) {
            grid[place(p)] += p.weight() * value;
            if p.mirror != 0.0 {
                grid[place(&p.mirrored())] += p.mirror * p.weight() * value;
            }
        }
        let half = product(along_y.as_ref(), grid.as_ref(), Par::Seq);
        let grid = product(half.as_ref(), along_x.transpose(), Par::Seq);
        for (p, value) in to.iter().zip(shape.iter_mut()) {
            let images = if p.mirror != 0.0 && p.x == p.y { 2.0 } else { 1.0 };
            *value = grid[place(p)] / (images * p.weight());
        }
    }
    shapes
}

#[cfg(test)]
mod tests {
    use super::super::adapt::{lines, plate, sparse};
    use super::super::counts::first_counts;
    use super::super::problem::Problem;
    use super::super::ritz::solve_block;
    use super::*;
    use crate::Medium;
    use crate::modes::bounds::Bounds;
    use unripple_core::Edge;

    const CLAMPED: Edge = Edge::Clamped;
    const FREE: Edge = Edge::Free;
    const HELD: Edge = Edge::Supported;
    const SOFT: Edge = Edge::Elastic { lift: 2e4, tilt: 3.0 };
    const HARD: Edge = Edge::Elastic { lift: 2e9, tilt: 0.0 };

    fn problem(sides: [f64; 2], edges: [[Edge; 2]; 2], tension: f64, k_top: f64) -> Problem {
        let medium = Medium { areal_density: 1.25, tension, bending_stiffness: 0.76, air_sides: 0.0 };
        let bounds =
            Bounds { medium, poisson: 0.22, max_hz: 1e3, k_top, accuracy: 1e-8, most: 1e-4, lossy: true };
        Problem { sides, edges, bounds }
    }

    /// Solves all classes both ways, and compares ω² within `accuracy`, vectors, and estimates of the error.
    fn agree(problem: &Problem, accuracy: f64) {
        let counts = first_counts(problem, problem.bounds.k_top);
        let dense = plate(problem, lines(problem, counts));
        let sparse = sparse(problem, counts, &dense.lines).unwrap();
        let classes = [0, 1].map(|axis| dense.lines[axis].classes(counts[axis]));
        let top = problem.bounds.top_square();
        for (symmetry, _) in Symmetry::all(&classes[0], &classes[1], dense.square) {
            let exact = solve_block(&dense, symmetry, top, Par::Seq).unwrap();
            let found = sparse.solve_block(symmetry, top).unwrap();
            assert_eq!(found.products, exact.products);
            assert_eq!(found.squares.len(), exact.squares.len());
            for (m, exact_square) in exact.squares.iter().enumerate() {
                let apart = (found.squares[m] / exact_square - 1.0).abs();
                let share = (found.bending_shares[m] - exact.bending_shares[m]).abs();
                assert!(apart < accuracy && share < 1e-8, "{m}: {apart:e} {share:e}");
            }
            assert!(found.rounded < 1e-10, "{:e}", found.rounded);
            assert!((found.error / exact.error - 1.0).abs() < 2e-3, "{} {}", found.error, exact.error);
            let gram = product(found.coefficients.transpose(), found.coefficients.as_ref(), Par::Seq);
            let same = product(exact.coefficients.transpose(), found.coefficients.as_ref(), Par::Seq);
            for (i, j) in (0..gram.nrows()).flat_map(|i| (0..gram.nrows()).map(move |j| (i, j))) {
                assert!((gram[(i, j)] - f64::from(i == j)).abs() < 1e-11, "{i} {j}: {}", gram[(i, j)]);
                let apart = exact.squares[i] / exact.squares[j] - 1.0;
                assert!(same[(i, j)].abs() < 1e-8 || apart.abs() < 1e-6, "{i} {j}: {}", same[(i, j)]);
            }
        }
    }

    #[test]
    fn dense_and_sparse_problems_agree() {
        agree(&problem([0.15, 0.1], [[CLAMPED; 2]; 2], 0.0, 600.0), 1e-10);
        agree(&problem([0.15, 0.1], [[FREE; 2]; 2], 0.0, 500.0), 1e-10);
        agree(&problem([0.15, 0.1], [[FREE; 2]; 2], 500.0, 500.0), 1e-10);
        agree(&problem([0.15, 0.1], [[CLAMPED, FREE], [HELD, CLAMPED]], 500.0, 300.0), 1e-10);
        agree(&problem([0.15, 0.1], [[HELD, FREE], [FREE, FREE]], 0.0, 300.0), 1e-10);
        agree(&problem([0.12, 0.12], [[CLAMPED; 2]; 2], 100.0, 600.0), 1e-10);
        agree(&problem([0.12, 0.12], [[CLAMPED, FREE]; 2], 100.0, 400.0), 1e-10);
        agree(&problem([0.15, 0.1], [[SOFT; 2]; 2], 0.0, 400.0), 1e-10);
        agree(&problem([0.15, 0.1], [[SOFT, FREE], [SOFT; 2]], 0.0, 300.0), 1e-10);
        agree(&problem([0.15, 0.1], [[HARD; 2]; 2], 0.0, 400.0), 1e-10);
    }
}
