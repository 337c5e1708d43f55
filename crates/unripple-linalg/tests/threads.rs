//! The same numbers to the last bit on one thread, on two and on four.

use unripple_linalg::sparse::{
    SparseColMat, SupernodalLdltRef, SymbolicCholeskyRaw, Triplet, Unfactored, analyse, factor_ldlt,
};
use unripple_linalg::{
    Cholesky, CholeskyInPlace, Lu, Mat, MatMut, MatRef, Par, add_square, adjoint_times, c64, exact_symmetric,
    general, norm, product, singular, solve_lower, solve_lower_alone, solve_upper_alone, sparse_times,
    squared_norm, symmetric, times_adjoint, times_column,
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
        let [a, b] = &complex;
        is_one("adjoint first", || {
            parts(adjoint_times(a.adjoint().to_owned().as_ref(), b.as_ref()).as_ref())
        });
        is_one("adjoint last", || parts(times_adjoint(a.as_ref(), b.adjoint().to_owned().as_ref()).as_ref()));
        is_one("a column", || {
            let column = times_column(left.as_ref(), right.col(0));
            column.iter().map(|x| x.to_bits()).collect()
        });
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
        let positive = product(matrix.as_ref(), matrix.transpose()) + Mat::<f64>::identity(n, n);
        let cholesky = || Cholesky::new(positive.as_ref()).unwrap();
        for right in [&one, &many] {
            let by = |solve: &dyn Fn(MatMut<'_, f64>)| {
                let mut found = right.clone();
                solve(found.as_mut());
                bits(found.as_ref())
            };
            is_one("Cholesky", || by(&|right| cholesky().solve(right)));
            is_one("LU", || by(&|right| Lu::new(matrix.as_ref()).solve(right)));
            is_one("lower", || by(&|right| solve_lower(cholesky().lower(), right)));
        }
        is_one("inverse", || bits(cholesky().inverse().as_ref()));
        is_one("inverse by LU", || bits(Lu::new(matrix.as_ref()).inverse().as_ref()));
    }
}

#[test]
fn decompositions_are_right() {
    let matrix = random(30, 30, 8);
    let found = general(matrix.as_ref()).unwrap();
    let complex = Mat::from_fn(30, 30, |i, j| c64::new(matrix[(i, j)], 0.0));
    let turned = product(complex.as_ref(), found.vectors.as_ref());
    let scaled = Mat::from_fn(30, 30, |i, j| found.vectors[(i, j)] * found.values[j]);
    let off = |i: usize| (0..30).map(|j| (turned[(i, j)] - scaled[(i, j)]).norm_sqr()).sum::<f64>();
    assert!((0..30).map(off).sum::<f64>().sqrt() < 1e-11);
    assert!(found.values.iter().any(|value| value.im != 0.0));
    let again = general(complex.as_ref()).unwrap();
    let trace = |values: &[c64]| values.iter().fold(c64::new(0.0, 0.0), |sum, value| sum + value);
    assert!((trace(&again.values) - trace(&found.values)).norm() < 1e-11);
    let even = &matrix + matrix.transpose();
    for (values, vectors) in [symmetric(even.as_ref()).unwrap(), exact_symmetric(even.as_ref()).unwrap()] {
        let scaled = Mat::from_fn(30, 30, |i, j| vectors[(i, j)] * values[j]);
        assert!(norm((product(even.as_ref(), vectors.as_ref()) - scaled).as_ref()) < 1e-11);
        assert!(values.is_sorted());
    }
    let thin = random(30, 4, 9);
    let found = singular(thin.as_ref()).unwrap();
    let energy: f64 = found.values.iter().map(|value| value * value).sum();
    assert!((energy - squared_norm(thin.as_ref())).abs() < 1e-12 * energy);
    let positive = product(matrix.as_ref(), matrix.transpose()) + Mat::<f64>::identity(30, 30);
    let mut solved = [thin.clone(), thin.clone(), thin.clone(), thin.clone()];
    let cholesky = Cholesky::new(positive.as_ref()).unwrap();
    cholesky.solve(solved[0].as_mut());
    Lu::new(positive.as_ref()).solve(solved[1].as_mut());
    CholeskyInPlace::new(positive.clone()).unwrap().solve(solved[2].as_mut());
    solve_lower_alone(cholesky.lower(), solved[3].as_mut());
    solve_upper_alone(cholesky.lower().transpose(), solved[3].as_mut());
    let off = |solved: &Mat<f64>| norm((product(positive.as_ref(), solved.as_ref()) - &thin).as_ref());
    assert!(solved.iter().all(|solved| off(solved) < 1e-11));
    let within = product(found.left.transpose(), found.left.as_ref()) - Mat::<f64>::identity(4, 4);
    assert!(norm(within.as_ref()) < 1e-12);
    assert!(
        symmetric(Mat::from_fn(3, 3, |_, _| f64::NAN).as_ref()).is_none_or(|(values, _)| values[0].is_nan())
    );
}

#[test]
fn products_are_right() {
    let both = [random(7, 5, 10), random(7, 5, 11)];
    let [a, b] = &both;
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let exact = |i: usize, j: usize| dot(a.col_as_slice(i), b.col_as_slice(j));
    let all = || (0..5).flat_map(|i| (0..5).map(move |j| (i, j)));
    let within = product(a.transpose(), b.as_ref());
    assert!(all().all(|(i, j)| (within[(i, j)] - exact(i, j)).abs() < 1e-14));
    let column = times_column(a.transpose(), b.col(3));
    assert!((0..5).all(|i| (column[i] - exact(i, 3)).abs() < 1e-14));
    let mut lower = Mat::<f64>::identity(5, 5);
    add_square(lower.as_mut(), -2.0, a.transpose());
    let square =
        |i: usize, j: usize| f64::from(u8::from(i == j)) - 2.0 * dot(a.col_as_slice(i), a.col_as_slice(j));
    assert!(all().filter(|(i, j)| i >= j).all(|(i, j)| (lower[(i, j)] - square(i, j)).abs() < 1e-14));
    let z = Mat::from_fn(7, 5, |i, j| c64::new(a[(i, j)], b[(i, j)]));
    let [gram, wide] = [adjoint_times(z.as_ref(), z.as_ref()), times_adjoint(z.as_ref(), z.as_ref())];
    let conj = Mat::from_fn(5, 7, |i, j| z[(j, i)].conj());
    let [exact, outer] = [product(conj.as_ref(), z.as_ref()), product(z.as_ref(), conj.as_ref())];
    assert!(all().all(|(i, j)| (gram[(i, j)] - exact[(i, j)]).norm() < 1e-14));
    assert!(all().all(|(i, j)| (wide[(i, j)] - outer[(i, j)]).norm() < 1e-14));
}

/// K of a chain of springs less σ has as many negative pivots as eigenvalues 4 sin²(πi/2(n+1)) below σ, (Sylvester).
#[test]
fn sparse_factors_count_what_lies_below() {
    let n = 40;
    let entry = |i: usize, j: usize| if i == j { 2.0 } else { -1.0 };
    let pairs = (0..n).map(|i| (i, i)).chain((1..n).map(|i| (i, i - 1)));
    let triplets: Vec<_> = pairs.map(|(i, j)| Triplet::new(i, j, entry(i, j))).collect();
    let lower = SparseColMat::try_new_from_triplets(n, n, &triplets).unwrap();
    let structure = analyse(lower.symbolic()).unwrap();
    let SymbolicCholeskyRaw::Supernodal(supernodes) = structure.raw() else { panic!("not of supernodes") };
    let order = structure.perm().unwrap().arrays().0.to_vec();
    let ordered = |shift: f64| {
        let value = |i: usize, j: usize| if i == j { 2.0 - shift } else { -1.0 };
        let place = |new: usize| order[new];
        let below = (0..n).flat_map(|j| (j..n).map(move |i| (i, j)));
        let near = below.filter(|(i, j)| place(*i).abs_diff(place(*j)) < 2);
        let triplets: Vec<_> = near.map(|(i, j)| Triplet::new(i, j, value(i, j))).collect();
        SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &triplets).unwrap()
    };
    let step = std::f64::consts::PI / (2 * (n + 1)) as f64;
    for shift in [0.0, 0.013, 0.7, 2.2, 3.9, 4.0] {
        let matrix = ordered(shift);
        let values = factor_ldlt(supernodes, matrix.as_ref(), Par::Seq).unwrap();
        let factor = SupernodalLdltRef::new(supernodes, &values);
        let negative =
            |s: usize| factor.supernode(s).val().col_iter().enumerate().filter(|(j, c)| c[*j] < 0.0).count();
        let below: usize = (0..supernodes.n_supernodes()).map(negative).sum();
        let exact = (1..=n).filter(|i| 4.0 * (step * *i as f64).sin().powi(2) < shift).count();
        assert_eq!(below, exact, "{shift}");
    }
    let dense = sparse_times(ordered(0.0).as_ref(), Mat::<f64>::identity(n, n).as_ref());
    assert!((0..n).all(|i| dense[(i, i)] == 2.0));
    assert_eq!(factor_ldlt(supernodes, ordered(2.0).as_ref(), Par::Seq), Err(Unfactored::Pivot));
}
