//! Property: random pencils against a dense solution.

use super::*;
use proptest::prelude::*;
use unripple_linalg::{Cholesky, exact_symmetric, solve_lower_alone};

/// λ of all eigenpairs, ascending, by M = LLᵀ and L⁻¹KL⁻ᵀ.
fn dense(stiffness: &Sparse, mass: &Sparse) -> Vec<f64> {
    let (mut ratio, mass) = (stiffness.to_dense(), mass.to_dense());
    let factor = Cholesky::new(mass.as_ref()).expect("positive definite");
    solve_lower_alone(factor.lower(), ratio.as_mut());
    let mut turned = ratio.transpose().to_owned();
    solve_lower_alone(factor.lower(), turned.as_mut());
    exact_symmetric(turned.as_ref()).expect("eigenvalues").0
}

/// K = ΣbbᵀS and M = 1 + Σccᵀ over random sparse b and c, with units that differ by unknown.
fn pencil(n: usize, parts: &[(usize, usize, f64, f64)], rank: usize) -> (Sparse, Sparse) {
    let mut stiffness = Entries { n, list: Vec::new() };
    let mut mass = Entries::identity(n);
    let unit = |i: usize| [1.0, 0.1, 30.0][i % 3];
    for (number, (i, j, x, y)) in parts.iter().enumerate() {
        let places = [(i % n, *x), ((i + 1 + j % 17) % n, *y), ((i + j) % n, x - y)];
        let into = if number % 4 == 0 { &mut mass } else { &mut stiffness };
        for (a, u) in places {
            into.list.extend(places.iter().map(|(b, v)| (a, *b, u * v)));
        }
    }
    stiffness.list.extend((rank..n).map(|i| (i, i, 0.3)));
    for matrix in [&mut stiffness, &mut mass] {
        matrix.list.iter_mut().for_each(|(i, j, v)| *v *= unit(*i) * unit(*j));
    }
    (stiffness.matrix(), mass.matrix())
}

fn parts(n: usize) -> impl Strategy<Value = Vec<(usize, usize, f64, f64)>> {
    prop::collection::vec((0..n, 0..n, -1.0..1.0, -1.0..1.0), 2 * n..3 * n)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    #[test]
    fn random_pencils_agree_with_a_dense_solution(
        n in 330..420_usize,
        parts in parts(420),
        rank in 0..20_usize,
        part in 0.05..0.6,
    ) {
        let (stiffness, mass) = pencil(n, &parts, rank);
        let values = dense(&stiffness, &mass);
        let top = bound_near(&values, values[(part * n as f64) as usize].max(1e-3));
        let expected = ascending(values, top);
        check(&stiffness, &mass, top, &expected, 1e-9, 1e-2);
    }
}

#[test]
fn every_shift_counts_what_lies_below() {
    let entries = Entries::second_difference(30, false);
    let one = Entries::identity(30);
    let stiffness = entries.times(&one).plus(one.times(&entries)).matrix();
    let s = second_differences(30, false);
    let values = sums(&s, &s);
    for i in 0..40 {
        let sigma = bound_near(&values, 0.2 * i as f64);
        let expected = values.iter().filter(|v| **v < sigma).count();
        assert_eq!(
            count_below(stiffness.as_ref(), Entries::identity(900).matrix().as_ref(), sigma),
            Ok(expected)
        );
    }
}
