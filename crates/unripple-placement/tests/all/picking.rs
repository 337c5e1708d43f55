//! D-optimal designs: against closed forms, against all designs where they are few, and the certificate.

use unripple_core::{Point, Random};
use unripple_linalg::{Lu, Mat, norm};
use unripple_placement::{Informations, Picking, PlacementError};

/// Information of the coefficients of a polynomial of some degree from a measurement at x.
fn powers(x: f64, degree: usize) -> Mat<f64> {
    Mat::from_fn(degree + 1, degree + 1, |i, j| x.powi((i + j) as i32))
}

/// Information of several random channels at each of some places, of unknowns whose scales differ by some orders of magnitude.
fn drawn(places: usize, unknowns: usize, channels: usize, seed: u64) -> Vec<Mat<f64>> {
    let mut random = Random::seeded(seed);
    let mut one = || {
        let slopes = Mat::from_fn(channels, unknowns, |_, u| 30f64.powi(u as i32 % 4) * random.normal());
        Mat::from_fn(unknowns, unknowns, |i, j| {
            (0..channels).map(|c| slopes[(c, i)] * slopes[(c, j)]).sum::<f64>()
        })
    };
    (0..places).map(|_| one()).collect()
}

fn plus(a: &Mat<f64>, b: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)] + b[(i, j)])
}

fn in_a_row(count: usize) -> Vec<Point> {
    (0..count).map(|i| Point::from_mm(10.0 * i as f64, 0.0)).collect()
}

/// Of a polynomial of degree d: equal shares at -1, 1 and the roots of the derivative of the Legendre polynomial of degree d (P. G. Hoel,
/// *Ann. Math. Statist.* 29, 1134, 1958).
#[test]
fn polynomials_are_measured_where_the_closed_form_says() {
    let roots: [&[f64]; 3] = [&[0.0], &[0.2_f64.sqrt()], &[0.0, (3.0_f64 / 7.0).sqrt()]];
    for (degree, inner) in (2..).zip(roots) {
        let mut at: Vec<f64> = (-60..=60).map(|i| f64::from(i) / 60.0).collect();
        let exact: Vec<f64> = inner.iter().flat_map(|x| [*x, -x]).chain([1.0, -1.0]).collect();
        at.retain(|x| exact.iter().all(|root| (x - root).abs() > 1e-9));
        let others = at.len();
        at.extend(
            inner.iter().flat_map(|x| if *x == 0.0 { vec![0.0] } else { vec![*x, -x] }).chain([1.0, -1.0]),
        );
        let each: Vec<Mat<f64>> = at.iter().map(|x| powers(*x, degree)).collect();
        let all = Informations::new(&Mat::zeros(degree + 1, degree + 1), &each).unwrap();
        let best = all.approximate(1, None).unwrap();
        assert!(best.is_certified(), "{degree}: {:e}", best.excess);
        assert!((best.told - (degree + 1) as f64).abs() < 1e-9);
        for (i, weight) in best.weights.iter().enumerate() {
            let share = if i < others { 0.0 } else { 1.0 / (degree + 1) as f64 };
            assert!((weight - share).abs() < 1e-3, "degree {degree}, {}: {weight}", at[i]);
        }
        // As many single places as the closed form has are those of the closed form, and then no design is better.
        let line: Vec<Point> = at.iter().map(|x| Point::new(x + 2.0, 0.0)).collect();
        let picking = Picking { informations: &all, at: &line, kept: &[], apart: 0.0 };
        let found = picking.restarts(degree + 1, 6, 1).unwrap();
        let found = found.into_iter().reduce(|a, b| if b.log_det > a.log_det { b } else { a }).unwrap();
        let bound = all.approximate(degree + 1, None).unwrap();
        assert!(bound.efficiency(&all, found.log_det) > 1.0 - 1e-5, "{degree}");
        assert!(found.places.iter().all(|place| *place >= others), "{degree}: {:?}", found.places);
    }
}

#[test]
fn the_best_of_few_designs_is_found_and_none_is_above_the_bound() {
    for seed in 1..6 {
        let (places, unknowns, count) = (14, 5, 3);
        let each = drawn(places, unknowns, 2, seed);
        let before = Mat::identity(unknowns, unknowns);
        let all = Informations::new(&before, &each).unwrap();
        let line = in_a_row(places);
        let picking = Picking { informations: &all, at: &line, kept: &[], apart: 0.0 };
        let greedy = picking.each_number(count).unwrap().remove(count - 1);
        let others = picking.restarts(count, 10, seed).unwrap();
        let found =
            others.into_iter().chain([greedy]).map(|found| found.log_det).fold(f64::NEG_INFINITY, f64::max);
        // Determinants by another factor than the search's, in the unknowns' own units.
        let exact = |set: &[usize]| {
            let sum = set.iter().fold(before.clone(), |sum, place| plus(&sum, &each[*place]));
            log_det(&sum)
        };
        let bound = all.approximate(count, None).unwrap();
        assert!(bound.is_certified());
        let (mut most, mut most_repeated) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for a in 0..places {
            for b in a..places {
                for c in b..places {
                    let reached = exact(&[a, b, c]);
                    most_repeated = most_repeated.max(reached);
                    if a < b && b < c {
                        most = most.max(reached);
                    }
                }
            }
        }
        assert!((found - most).abs() < 1e-8, "seed {seed}: {found} {most}");
        assert!(most_repeated <= bound.bound(&all) + 1e-9, "seed {seed}");
        let least = bound.efficiency(&all, found);
        assert!(least > 0.0 && least <= 1.0 && bound.told < unknowns as f64, "{least}");
        // The best choice that may repeat places leaves no less, and adds no more, than is said of the one that was found.
        let before = all.log_det(&[]);
        assert!(((found - most_repeated) / unknowns as f64).exp() >= least - 1e-9, "seed {seed}");
        assert!(
            (found - before) / (most_repeated - before) >= bound.added(&all, found) - 1e-9,
            "seed {seed}"
        );
    }
}

/// ln det by the pivots of a Gaussian elimination.
fn log_det(matrix: &Mat<f64>) -> f64 {
    let mut left = matrix.clone();
    let mut sum = 0.0;
    for pivot in 0..left.nrows() {
        sum += left[(pivot, pivot)].ln();
        for i in pivot + 1..left.nrows() {
            let share = left[(i, pivot)] / left[(pivot, pivot)];
            for j in pivot..left.nrows() {
                let taken = share * left[(pivot, j)];
                left[(i, j)] -= taken;
            }
        }
    }
    sum
}

/// The theorem itself: the sensitivity is at most the number of unknowns, and is that number where there are measurements.
#[test]
fn the_certificate_holds_for_many_places_and_unknowns() {
    let (places, unknowns) = (200, 12);
    let each = drawn(places, unknowns, 4, 9);
    for (before, count) in [(Mat::zeros(unknowns, unknowns), 1), (Mat::identity(unknowns, unknowns), 6)] {
        let all = Informations::new(&before, &each).unwrap();
        let best = all.approximate(count, None).unwrap();
        let sum = best.weights.iter().zip(&each).fold(before.clone(), |sum, (weight, one)| {
            Mat::from_fn(unknowns, unknowns, |i, j| sum[(i, j)] + weight * count as f64 * one[(i, j)])
        });
        let inverse = Lu::new(sum.as_ref()).inverse();
        assert!((best.weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        assert!((log_det(&sum) - best.log_det).abs() < 1e-7);
        for (place, one) in each.iter().enumerate() {
            let there = Mat::from_fn(unknowns, unknowns, |i, j| before[(i, j)] + count as f64 * one[(i, j)]);
            let trace: f64 = (0..unknowns)
                .map(|i| (0..unknowns).map(|j| inverse[(i, j)] * there[(j, i)]).sum::<f64>())
                .sum();
            assert!((trace - best.sensitivity[place]).abs() < 1e-6 * unknowns as f64);
            assert!(trace <= unknowns as f64 * (1.0 + 2e-6), "{place}: {trace}");
            assert!(best.weights[place] < 1e-6 || trace > unknowns as f64 * (1.0 - 1e-4), "{place}: {trace}");
        }
        // From a design that is already the best, there is nothing to do.
        assert_eq!(all.approximate(count, Some(&best.weights)).unwrap().weights, best.weights);
    }
}

#[test]
fn covariances_are_inverses_and_distances_are_kept() {
    let (places, unknowns) = (20, 4);
    let each = drawn(places, unknowns, 2, 3);
    let before = Mat::identity(unknowns, unknowns);
    let all = Informations::new(&before, &each).unwrap();
    let exact = Lu::new(plus(&plus(&before, &each[2]), &each[7]).as_ref()).inverse();
    let found = all.covariance(&[2, 7]).unwrap();
    assert!(norm(plus(&found, &-&exact).as_ref()) < 1e-9 * norm(exact.as_ref()));
    let line = in_a_row(places);
    let kept = [Point::from_mm(100.0, 0.0)];
    let picking = Picking { informations: &all, at: &line, kept: &kept, apart: 25e-3 };
    for found in picking.restarts(3, 5, 2).unwrap() {
        for (i, a) in found.places.iter().enumerate() {
            let others = found.places[..i].iter().map(|b| line[*b]).chain(kept);
            assert!(others.into_iter().all(|other| other.distance(line[*a]) >= 25e-3 - 1e-12), "{found:?}");
        }
    }
    let error = picking.restarts(9, 1, 2).unwrap_err();
    assert!(matches!(error, PlacementError::Few { expected: 9, .. }), "{error}");
}

#[test]
fn what_no_place_tells_is_refused() {
    let each: Vec<Mat<f64>> = (0..5).map(|i| powers(f64::from(i), 0)).collect();
    let blind = Mat::from_fn(2, 2, |i, j| if i == 0 && j == 0 { 1.0 } else { 0.0 });
    let error = Informations::new(&Mat::zeros(2, 2), &vec![blind; 3]).unwrap_err();
    assert_eq!(error, PlacementError::Untold { places: 3, unknowns: 2 });
    assert!(Informations::new(&Mat::zeros(1, 1), &each).is_ok());
    assert!(matches!(Informations::new(&Mat::zeros(1, 1), &[]), Err(PlacementError::Few { .. })));
}

#[test]
fn threads_change_no_design() {
    let each = drawn(60, 8, 3, 4);
    let found = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let all = Informations::new(&Mat::identity(8, 8), &each).unwrap();
            let line = in_a_row(60);
            let picking = Picking { informations: &all, at: &line, kept: &[], apart: 0.0 };
            (
                all.approximate(4, None).unwrap(),
                picking.restarts(4, 4, 1).unwrap(),
                picking.each_number(3).unwrap(),
            )
        })
    };
    assert_eq!(found(1), found(2));
}
