//! The modes of a coupled system that are left once most are known: eigenvectors in the complement of those found.

use super::state::{Root, State};
use unripple_core::Random;
use unripple_linalg::{General, Lu, Mat, c64, general, product, singular};

/// Largest size of the complement, as a share of the whole state: beyond, the eigenvalues of the whole cost less than twice as much.
const MOST: f64 = 0.5;

/// Least singular value of the states that span the complement, relative to the largest. With less, what is independent would be rounding
/// error.
const INDEPENDENT: f64 = 1e-8;

/// Largest residual ‖Ay - sy‖/‖y‖ of an eigenvector, relative to the highest frequency or rate: a thousand rounding errors of a large state.
/// Where loads are so regular that several of these have one frequency it may be larger, and the whole state is decomposed.
const RESIDUAL: f64 = 1e-10;

/// The exponentials of a system beside those `found`, all of which oscillate; `None` if they are too many, or not sure to be found.
///
/// With the signs J of [`State`], yᵀJy' vanishes between eigenvectors. So the states with yᵀJy' = 0 for all y found are those that the other
/// eigenvectors span (deflation, as of symmetric matrices; Parlett, *The Symmetric Eigenvalue Problem*, chapter 15).
pub(super) fn roots(state: &State<'_>, found: &[Root]) -> Option<Vec<Root>> {
    let size = state.size();
    // Of each pair of complex conjugates one is found.
    let left = size - 2 * found.len();
    if left == 0 {
        return Some(Vec::new());
    }
    if left as f64 > MOST * size as f64 {
        return None;
    }
    // What they begin from does not matter, as long as its parts in the complement are independent.
    let mut random = Random::seeded(1);
    let begun = Mat::from_fn(size, left, |_, _| random.between(-1.0, 1.0));
    let known = Known::of(state, found);
    // Twice, since the first leaves rounding errors of what it takes away.
    let spanning = known.without(state, known.without(state, begun));
    let basis = singular(spanning.as_ref())?;
    let largest = basis.values.iter().copied().fold(0.0, f64::max);
    if !basis.values.iter().all(|value| *value > INDEPENDENT * largest) {
        return None;
    }
    let basis = basis.left;
    let moved = state.moved(basis.as_ref());
    let signed = signed(state, &basis);
    let (mut within, mut dual) = (product(signed.transpose(), moved.as_ref()), signed.transpose().to_owned());
    let gram = Lu::new(product(signed.transpose(), basis.as_ref()).as_ref());
    gram.solve(within.as_mut());
    gram.solve(dual.as_mut());
    let General { values, vectors } = general(within.as_ref())?;
    // Left eigenvectors by an inverse, since those of one eigenvalue need not be orthogonal.
    let left = complex_product(&Lu::new(vectors.as_ref()).inverse(), &dual);
    let [real, imaginary] = [|x: c64| x.re, |x: c64| x.im].map(|part| {
        let parts = Mat::from_fn(vectors.nrows(), vectors.ncols(), |i, k| part(vectors[(i, k)]));
        [product(basis.as_ref(), parts.as_ref()), product(moved.as_ref(), parts.as_ref())]
    });
    let rates = (0..state.coils.len()).map(|coil| state.rate(coil));
    let top = state.modes.omegas.iter().copied().chain(rates).fold(0.0, f64::max);
    let root = |k: usize| {
        let of = |which: usize, row: usize| c64::new(real[which][(row, k)], imaginary[which][(row, k)]);
        let s = values[k];
        let length = |at: &dyn Fn(usize) -> c64| (0..size).map(|row| at(row).norm_sqr()).sum::<f64>().sqrt();
        let off = length(&|row| of(1, row) - of(0, row) * s);
        // Not so either where something is not finite.
        let good = off <= RESIDUAL * top * length(&|row| of(0, row));
        good.then(|| Root {
            s,
            shape: state.displacement(s, |row| of(0, row)),
            input: state.inputs(|row| c64::new(left[0][(k, row)], left[1][(k, row)])),
        })
    };
    (0..values.len()).filter(|k| values[*k].im >= 0.0).map(root).collect()
}

/// The real and the imaginary part of a complex matrix times a real one.
fn complex_product(left: &Mat<c64>, right: &Mat<f64>) -> [Mat<f64>; 2] {
    [|x: c64| x.re, |x: c64| x.im].map(|part| {
        let part = Mat::from_fn(left.nrows(), left.ncols(), |i, j| part(left[(i, j)]));
        product(part.as_ref(), right.as_ref())
    })
}

/// J Y of states, the columns of Y.
fn signed(state: &State<'_>, states: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(states.nrows(), states.ncols(), |row, k| state.sign(row) * states[(row, k)])
}

/// The eigenvectors that are known, one of each pair of complex conjugates.
struct Known {
    real: Mat<f64>,
    imaginary: Mat<f64>,
    /// yᵀJy of each.
    norms: Vec<c64>,
}

impl Known {
    fn of(state: &State<'_>, found: &[Root]) -> Self {
        let vectors: Vec<Vec<c64>> = found.iter().map(|root| state.vector(root.s, &root.shape)).collect();
        let norm = |y: &Vec<c64>| y.iter().enumerate().map(|(row, x)| x * x * state.sign(row)).sum::<c64>();
        let part = |part: fn(&c64) -> f64| {
            Mat::from_fn(state.size(), vectors.len(), |row, k| part(&vectors[k][row]))
        };
        Self { norms: vectors.iter().map(norm).collect(), real: part(|x| x.re), imaginary: part(|x| x.im) }
    }

    /// States without their parts along the known eigenvectors and the conjugates of these.
    fn without(&self, state: &State<'_>, states: Mat<f64>) -> Mat<f64> {
        let signed = signed(state, &states);
        let [real, imaginary] =
            [&self.real, &self.imaginary].map(|y| product(y.transpose(), signed.as_ref()));
        let along = |i: usize, k: usize| c64::new(real[(i, k)], imaginary[(i, k)]) / self.norms[i] * 2.0;
        let [re, im] = [|x: c64| x.re, |x: c64| x.im]
            .map(|part| Mat::from_fn(real.nrows(), real.ncols(), |i, k| part(along(i, k))));
        states - product(self.real.as_ref(), re.as_ref()) + product(self.imaginary.as_ref(), im.as_ref())
    }
}
