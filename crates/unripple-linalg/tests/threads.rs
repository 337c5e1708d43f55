//! The same numbers to the last bit on one thread, on two and on four.

use faer::linalg::solvers::DenseSolveCore;
use faer::{Mat, MatRef, Side, c64};
use unripple_linalg::{
    exact_symmetric, general, product, singular, solve_cholesky, solve_lower, solve_lu, symmetric,
};

/// Numbers between -0.5 and 0.5 that look random.
fn random(rows: usize, columns: usize, seed: u64) -> Mat<f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    Mat::from_fn(rows, columns, |_, _| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    })
}

fn bits(matrix: MatRef<'_, f64>) -> Vec<u64> {
    matrix.col_iter().flat_map(|column| column.iter().map(|x| x.to_bits()).collect::<Vec<_>>()).collect()
}

fn parts(matrix: MatRef<'_, c64>) -> Vec<u64> {
    let both = |x: &c64| [x.re.to_bits(), x.im.to_bits()];
    matrix.col_iter().flat_map(|column| column.iter().flat_map(both).collect::<Vec<_>>()).collect()
}

/// Whether `work` gives the same on each number of threads.
fn is_one(what: &str, work: impl Fn() -> Vec<u64> + Sync) {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(&work)
    };
    let first = on(1);
    assert!([2, 4].iter().all(|threads| on(*threads) == first), "{what}");
}

#[test]
fn products_are_one() {
    for [m, k, n] in
        [[1500, 300, 1], [1500, 1500, 1], [64, 1500, 1], [1, 1500, 300], [300, 300, 300], [700, 40, 3]]
    {
        let (left, right) = (random(m, k, 1), random(k, n, 2));
        let turned = [left.transpose().to_owned(), right.transpose().to_owned()];
        is_one("as they lie", || bits(product(left.as_ref(), right.as_ref()).as_ref()));
        is_one("turned", || bits(product(turned[0].transpose(), turned[1].transpose()).as_ref()));
        let small = [&left, &right].map(|m| Mat::from_fn(m.nrows(), m.ncols(), |i, j| m[(i, j)] as f32));
        is_one("in f32", || {
            let found = product(small[0].as_ref(), small[1].as_ref());
            bits(Mat::from_fn(m, n, |i, j| f64::from(found[(i, j)])).as_ref())
        });
        let complex =
            [&left, &right].map(|m| Mat::from_fn(m.nrows(), m.ncols(), |i, j| c64::new(m[(i, j)], 0.5)));
        is_one("complex", || parts(product(complex[0].as_ref(), complex[1].as_ref()).as_ref()));
    }
}

#[test]
fn decompositions_are_one() {
    for n in [40, 120, 300] {
        let matrix = random(n, n, 3);
        let even = &matrix + matrix.transpose();
        is_one("symmetric", || bits(symmetric(even.as_ref()).unwrap().1.as_ref()));
        is_one("exact", || bits(exact_symmetric(even.as_ref()).unwrap().1.as_ref()));
        is_one("general", || parts(general(matrix.as_ref()).unwrap().vectors.as_ref()));
        let thin = random(n, 16, 4);
        is_one("singular", || bits(singular(thin.as_ref()).unwrap().left.as_ref()));
    }
}

#[test]
fn solutions_are_one() {
    for n in [40, 300, 700] {
        let (matrix, one, many) = (random(n, n, 5), random(n, 1, 6), random(n, 16, 7));
        let positive = &matrix * matrix.transpose() + Mat::<f64>::identity(n, n);
        for right in [&one, &many] {
            let by = |solve: &dyn Fn(faer::MatMut<'_, f64>)| {
                let mut found = right.clone();
                solve(found.as_mut());
                bits(found.as_ref())
            };
            is_one("Cholesky", || by(&|right| solve_cholesky(&positive.llt(Side::Lower).unwrap(), right)));
            is_one("LU", || by(&|right| solve_lu(&matrix.partial_piv_lu(), right)));
            is_one("lower", || by(&|right| solve_lower(positive.llt(Side::Lower).unwrap().L(), right)));
        }
        // As faer has them.
        is_one("inverse", || bits(positive.llt(Side::Lower).unwrap().inverse().as_ref()));
        is_one("inverse by LU", || bits(matrix.partial_piv_lu().inverse().as_ref()));
    }
}

#[test]
fn decompositions_are_right() {
    let matrix = random(30, 30, 8);
    let found = general(matrix.as_ref()).unwrap();
    let complex = Mat::from_fn(30, 30, |i, j| c64::new(matrix[(i, j)], 0.0));
    let turned = product(complex.as_ref(), found.vectors.as_ref());
    let scaled = Mat::from_fn(30, 30, |i, j| found.vectors[(i, j)] * found.values[j]);
    assert!((&turned - &scaled).norm_l2() < 1e-11);
    assert!(found.values.iter().any(|value| value.im != 0.0));
    let again = general(complex.as_ref()).unwrap();
    let trace = |values: &[c64]| values.iter().fold(c64::new(0.0, 0.0), |sum, value| sum + value);
    assert!((trace(&again.values) - trace(&found.values)).norm() < 1e-11);
    let even = &matrix + matrix.transpose();
    for (values, vectors) in [symmetric(even.as_ref()).unwrap(), exact_symmetric(even.as_ref()).unwrap()] {
        let scaled = Mat::from_fn(30, 30, |i, j| vectors[(i, j)] * values[j]);
        assert!((&even * &vectors - scaled).norm_l2() < 1e-11);
        assert!(values.is_sorted());
    }
    let thin = random(30, 4, 9);
    let found = singular(thin.as_ref()).unwrap();
    let energy: f64 = found.values.iter().map(|value| value * value).sum();
    assert!((energy - thin.squared_norm_l2()).abs() < 1e-12 * energy);
    let positive = &matrix * matrix.transpose() + Mat::<f64>::identity(30, 30);
    let mut solved = [thin.clone(), thin.clone()];
    solve_cholesky(&positive.llt(Side::Lower).unwrap(), solved[0].as_mut());
    solve_lu(&positive.partial_piv_lu(), solved[1].as_mut());
    assert!(solved.iter().all(|solved| (&positive * solved - &thin).norm_l2() < 1e-11));
    let within = product(found.left.transpose(), found.left.as_ref()) - Mat::<f64>::identity(4, 4);
    assert!(within.norm_l2() < 1e-12);
    assert!(
        symmetric(Mat::from_fn(3, 3, |_, _| f64::NAN).as_ref()).is_none_or(|(values, _)| values[0].is_nan())
    );
}
