//! Oracle: pencils with eigenvalues in closed form.

use super::*;

/// A grid of `a` x `b` places, held around.
fn grid(a: usize, b: usize) -> (Sparse, Sparse, Vec<f64>) {
    let [x, y] = [a, b].map(|n| Entries::second_difference(n, false));
    let stiffness = x.times(&Entries::identity(b)).plus(Entries::identity(a).times(&y));
    let values = sums(&second_differences(a, false), &second_differences(b, false));
    (stiffness.matrix(), Entries::identity(a * b).matrix(), values)
}

#[test]
fn a_square_has_its_pairs_twice() {
    let (stiffness, mass, values) = grid(60, 60);
    let top = bound_near(&values, 0.7);
    let pairs = check(&stiffness, &mass, top, &ascending(values, top), 1e-12, 0.0);
    assert!(pairs.values.len() > 180);
}

#[test]
fn a_large_oblong_misses_none() {
    let (stiffness, mass, values) = grid(200, 100);
    let top = bound_near(&values, 0.25);
    let pairs = check(&stiffness, &mass, top, &ascending(values, top), 1e-11, 0.0);
    assert!(pairs.values.len() > 350);
}

#[test]
fn a_cube_has_its_pairs_three_and_six_times() {
    let n = 14;
    let one = Entries::identity(n);
    let line = Entries::second_difference(n, false);
    let square = line.times(&one).plus(one.times(&line));
    let cube = square.times(&one).plus(one.times(&one).times(&line));
    let s = second_differences(n, false);
    let values = sums(&sums(&s, &s), &s);
    let top = bound_near(&values, 2.8);
    let mass = Entries::identity(n * n * n).matrix();
    let pairs = check(&cube.matrix(), &mass, top, &ascending(values, top), 1e-12, 0.0);
    assert!(pairs.values.len() > 100);
}

#[test]
fn what_nothing_holds_has_one_at_zero() {
    let (a, b) = (50, 41);
    let [x, y] = [a, b].map(|n| Entries::second_difference(n, true));
    let stiffness = x.times(&Entries::identity(b)).plus(Entries::identity(a).times(&y));
    let values = sums(&second_differences(a, true), &second_differences(b, true));
    let top = bound_near(&values, 0.5);
    let mass = Entries::identity(a * b).matrix();
    let pairs = check(&stiffness.matrix(), &mass, top, &ascending(values, top), 1e-11, 1e-2);
    assert!(pairs.values[0].abs() < 1e-12 && pairs.values[1] > 1e-3);
}

#[test]
fn twenty_alike_are_found_twenty_times() {
    let (line, count) = (Entries::second_difference(60, false), 20);
    let stiffness = Entries::identity(count).times(&line).matrix();
    let mass = Entries::identity(60 * count).matrix();
    let s = second_differences(60, false);
    let values: Vec<f64> = (0..count).flat_map(|_| s.clone()).collect();
    let top = 0.5 * (s[5] + s[6]);
    check(&stiffness, &mass, top, &ascending(values, top), 1e-12, 0.0);
}

#[test]
fn one_eigenvalue_for_all() {
    let mass = Entries::second_difference(400, false).plus(Entries::identity(400));
    let stiffness = mass.clone().scaled(3.0).matrix();
    check(&stiffness, &mass.matrix(), 4.0, &[3.0; 400], 1e-12, 0.0);
}

#[test]
fn all_eigenpairs_of_a_pencil() {
    let (stiffness, mass, values) = grid(25, 24);
    check(&stiffness, &mass, 9.0, &ascending(values, 9.0), 1e-12, 0.0);
}

#[test]
fn few_unknowns_are_taken_as_dense() {
    let (stiffness, mass, values) = grid(13, 12);
    let top = bound_near(&values, 2.0);
    check(&stiffness, &mass, top, &ascending(values, top), 1e-12, 0.0);
}

#[test]
fn below_all_there_is_nothing() {
    let (stiffness, mass, _) = grid(30, 20);
    for top in [-1.0, 0.0, 1e-3] {
        check(&stiffness, &mass, top, &[], 1e-12, 0.0);
    }
}

/// Fourth differences of a strip of 999 x 4 places with a condition number of 10¹⁰; all entries are whole numbers.
#[test]
fn a_stiff_strip() {
    let (a, b) = (999, 4);
    let x = Entries::second_difference(a, false).scaled(1e6);
    let y = Entries::second_difference(b, false).scaled(25.0);
    let laplacian = x.times(&Entries::identity(b)).plus(Entries::identity(a).times(&y)).matrix();
    let stiffness = &laplacian * &laplacian;
    let scaled = |n, factor: f64| second_differences(n, false).iter().map(|v| v * factor).collect::<Vec<_>>();
    let values: Vec<f64> = sums(&scaled(a, 1e6), &scaled(b, 25.0)).iter().map(|v| v * v).collect();
    let top = bound_near(&values, 4e10);
    let mass = Entries::identity(a * b).matrix();
    let pairs = check(&stiffness, &mass, top, &ascending(values, top), 1e-12, 0.0);
    assert!(pairs.values.len() > 400);
}

/// The sum of two clamped beams, in bending, is that of their eigenvalues.
#[test]
fn beams_across_each_other_add_up() {
    let [[b, m], [c, l]] = [128, 8].map(beam);
    let stiffness = b.times(&l).plus(m.times(&c)).matrix();
    let all = |k: &Entries, m: &Entries| {
        below(k.matrix().as_ref(), m.matrix().as_ref(), 1e6, &Observed::default())
            .expect("eigenpairs of a beam")
            .values
    };
    let (long, short) = (all(&b, &m), all(&c, &l));
    // The root of cos x cosh x = 1, to the fourth power.
    assert!((420.0 * long[0] / 4.730040744862704_f64.powi(4) - 1.0).abs() < 1e-7);
    let values = sums(&long, &short);
    let top = bound_near(&values, 1e6);
    let pairs = check(&stiffness, &m.times(&l).matrix(), top, &ascending(values, top), 1e-12, 0.0);
    assert!(pairs.values.len() > 300);
}

/// Bending and 420 times mass of a beam of cubic Hermite elements of one metre together, clamped at both ends; without
/// rounding if their number is a power of two.
fn beam(elements: usize) -> [Entries; 2] {
    let h = 1.0 / elements as f64;
    let bending =
        [[12.0, 6.0, -12.0, 6.0], [6.0, 4.0, -6.0, 2.0], [-12.0, -6.0, 12.0, -6.0], [6.0, 2.0, -6.0, 4.0]];
    let mass = [
        [156.0, 22.0, 54.0, -13.0],
        [22.0, 4.0, 13.0, -3.0],
        [54.0, 13.0, 156.0, -22.0],
        [-13.0, -3.0, -22.0, 4.0],
    ];
    let n = 2 * (elements - 1);
    [(bending, h.powi(-3)), (mass, h)].map(|(element, factor)| {
        let mut list = Vec::new();
        for start in 0..elements {
            for (i, row) in element.iter().enumerate() {
                for (j, v) in row.iter().enumerate() {
                    let slope = |k: usize| if k % 2 == 1 { h } else { 1.0 };
                    let (a, b) = (2 * start + i, 2 * start + j);
                    if a >= 2 && b >= 2 && a < n + 2 && b < n + 2 {
                        list.push((a - 2, b - 2, v * factor * slope(i) * slope(j)));
                    }
                }
            }
        }
        Entries { n, list }
    })
}
