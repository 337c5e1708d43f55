//! Every method's drive against the same problem written out sample by sample and solved at once.

use crate::common;
use unripple_linalg::{Lu, Mat, MatRef, Scale, product};

use common::Membrane;
use unripple_core::{Drive, ModalResponses, Point, Pole};
use unripple_focus::{Focuser, Method, Options, Shaping, Target, focus};

const WINDOW: usize = 96;

fn options(method: Method, strength: f64) -> Options {
    let window = WINDOW as f64 / Membrane::small().rate;
    Options { method, window, strength: Some(strength), ..Options::default() }
}

fn target() -> Point {
    Point::new(0.062, 0.031)
}

/// Modal velocities at the focal instant after an impulse at each sample of each actuator: modes x samples.
fn map(modal: &ModalResponses, stretch: f64) -> Mat<f64> {
    let rate = modal.conditions.rate;
    Mat::from_fn(modal.poles.len(), modal.ports.len() * (WINDOW + 1), |m, row| {
        let (a, j) = (row / (WINDOW + 1), row % (WINDOW + 1));
        let pole = Pole { omega: stretch * modal.poles[m].omega, ..modal.poles[m] };
        modal.input[(a, m)] * pole.velocity((WINDOW - j) as f64 / rate) / rate
    })
}

fn column(values: Vec<f64>) -> Mat<f64> {
    Mat::from_fn(values.len(), 1, |i, _| values[i])
}

fn weights(modal: &ModalResponses, at: Point) -> Mat<f64> {
    modal.shapes.at_all(&[at]).transpose().to_owned()
}

/// A B.
fn by(a: &Mat<f64>, b: &Mat<f64>) -> Mat<f64> {
    product(a.as_ref(), b.as_ref())
}

/// Aᵀ B.
fn within(a: &Mat<f64>, b: &Mat<f64>) -> Mat<f64> {
    product(a.transpose(), b.as_ref())
}

/// `tr K² / tr K` with K the mean of x xᵀ over all cells, x the response of a cell to every sample.
fn unit(modal: &ModalResponses, map: &Mat<f64>) -> f64 {
    let cost = by(&cells(modal, &[]), &product(map.as_ref(), map.transpose()));
    let trace = |m: &Mat<f64>| (0..m.nrows()).map(|i| m[(i, i)]).sum::<f64>();
    trace(&by(&cost, &cost)) / trace(&cost)
}

/// Sum of φφᵀ over the cells outside the targets' discs, over the count of all cells.
fn cells(modal: &ModalResponses, targets: &[Point]) -> Mat<f64> {
    let lambda = modal.conditions.lambda_min;
    let (width, height) = modal.conditions.outline.extent();
    let (columns, rows) = ((6.0 * width / lambda).ceil() as usize, (6.0 * height / lambda).ceil() as usize);
    let cells: Vec<Point> = (0..columns * rows)
        .map(|c| {
            Point::new(
                ((c % columns) as f64 + 0.5) / columns as f64 * width,
                ((c / columns) as f64 + 0.5) / rows as f64 * height,
            )
        })
        .collect();
    let far: Vec<Point> = cells
        .iter()
        .copied()
        .filter(|c| targets.iter().all(|at| at.distance(*c) > 4.0 / 3.0 * lambda))
        .collect();
    let far = modal.shapes.at_all(&far);
    within(&far, &far) * Scale(1.0 / cells.len() as f64)
}

fn solve(matrix: &Mat<f64>, right: &Mat<f64>) -> Mat<f64> {
    let mut found = right.clone();
    Lu::new(matrix.as_ref()).solve(found.as_mut());
    found
}

fn identity(n: usize, factor: f64) -> Mat<f64> {
    Mat::from_fn(n, n, |i, j| if i == j { factor } else { 0.0 })
}

/// Compares a drive with samples that are right up to a factor.
fn agrees(method: &str, drive: &unripple_core::Drive, samples: &Mat<f64>) {
    let most = samples.col_as_slice(0).iter().fold(0.0_f64, |m, d| m.max(d.abs()));
    for (found, right) in drive.channels().iter().flatten().zip(samples.col_as_slice(0)) {
        assert!((found - right / most).abs() < 2e-6, "{method}: {found} {}", right / most);
    }
}

#[test]
fn inverse_is_the_least_energy_drive_of_a_delta() {
    let modal = Membrane::small().modal();
    let map = map(&modal, 1.0);
    for strength in [0.0, 0.5, 0.97, 0.999] {
        let drive = focus(
            &Membrane::small().responses(),
            &[Target::at(target())],
            &options(Method::Inverse, strength),
        );
        let energy = (1.0 - strength).max(1e-9) * unit(&modal, &map);
        let whole =
            within(&map, &by(&cells(&modal, &[]), &map)) * Scale(strength) + identity(map.ncols(), energy);
        let right = solve(&whole, &within(&map, &weights(&modal, target())));
        agrees("inverse", &drive.unwrap().drive, &right);
    }
}

/// `min dᵀ(κ Σ GᵀSG / plants + (1 - κ) s) d` at a given velocity of the target, in the space of drives.
fn least(modal: &ModalResponses, stretches: &[f64], strength: f64) -> Mat<f64> {
    let nominal = map(modal, stretches[0]);
    let maps: Vec<Mat<f64>> = stretches.iter().map(|stretch| map(modal, *stretch)).collect();
    let cost = cells(modal, &[target()]);
    let mut whole = identity(nominal.ncols(), (1.0 - strength) * unit(modal, &nominal));
    for map in &maps {
        whole += within(map, &by(&cost, map)) * Scale(strength / maps.len() as f64);
    }
    solve(&whole, &within(&nominal, &weights(modal, target())))
}

#[test]
fn concentrate_leaves_least_outside() {
    let modal = Membrane::small().modal();
    for strength in [0.0, 0.5, 0.92, 0.99] {
        let options = options(Method::Concentrate, strength);
        let drive = focus(&Membrane::small().responses(), &[Target::at(target())], &options).unwrap().drive;
        agrees("concentrate", &drive, &least(&modal, &[1.0], strength));
    }
}

#[test]
fn robust_leaves_least_over_all_plants() {
    let modal = Membrane::small().modal();
    let options = Options { spread: 0.01, ..options(Method::Robust, 0.95) };
    let drive = focus(&Membrane::small().responses(), &[Target::at(target())], &options).unwrap().drive;
    agrees("robust", &drive, &least(&modal, &[1.0, 0.99, 1.01], 0.95));
}

/// Conditions of Karush, Kuhn and Tucker: free samples have no slope along the constraint's price, clipped ones point outwards.
#[test]
fn limited_is_optimal_within_its_limits() {
    let modal = Membrane::small().modal();
    let (map, strength) = (map(&modal, 1.0), 0.95);
    let whole = within(&map, &by(&cells(&modal, &[target()]), &map)) * Scale(strength)
        + identity(map.ncols(), (1.0 - strength) * unit(&modal, &map));
    let reading = within(&map, &weights(&modal, target()));
    for push in [0.1, 0.4, 0.7, 0.9] {
        let options = Options { push, limit: 0.3, ..options(Method::Limited, strength) };
        let drive = focus(&Membrane::small().responses(), &[Target::at(target())], &options).unwrap().drive;
        let samples = column(drive.channels().iter().flatten().copied().collect());
        let slope = by(&whole, &samples);
        let pairs: Vec<(f64, f64, f64)> =
            (0..samples.nrows()).map(|i| (samples[(i, 0)], slope[(i, 0)], reading[(i, 0)])).collect();
        let free = || pairs.iter().filter(|(d, ..)| d.abs() < 0.3 * (1.0 - 1e-9));
        let price = free().map(|(_, s, r)| s * r).sum::<f64>() / free().map(|(_, _, r)| r * r).sum::<f64>();
        let size = pairs.iter().map(|(_, s, _)| s.abs()).fold(0.0, f64::max);
        let clipped = pairs.len() - free().count();
        assert!(clipped > 3, "{clipped} clipped");
        for (d, s, r) in &pairs {
            let left = s - price * r;
            if d.abs() < 0.3 * (1.0 - 1e-9) {
                assert!(left.abs() < 1e-3 * size, "push {push}: {left} of {size}");
            } else {
                assert!(left * d.signum() < 1e-3 * size, "push {push}: {left} of {size} at the limit");
            }
        }
    }
}

/// Below the level of the unlimited drive the limits do not bind, and above it a share of the level is that of a lower push.
#[test]
fn limited_at_a_level_is_solved_for_it() {
    let responses = Membrane::small().responses();
    let targets = [Target::at(target())];
    let with = |push: f64| Options { push, limit: 0.3, ..options(Method::Limited, 0.95) };
    let level = |drive: &Drive| {
        let map = map(&Membrane::small().modal(), 1.0);
        let samples = column(drive.channels().iter().flatten().copied().collect());
        within(&weights(&Membrane::small().modal(), target()), &by(&map, &samples))[(0, 0)]
    };
    let unit_peak = |drive: &Drive| drive.clone().scaled(1.0 / drive.peak());
    let (lowest, highest) = (with(0.0), with(0.8));
    let (lowest, highest) =
        (Focuser::new(&responses, &lowest).unwrap(), Focuser::new(&responses, &highest).unwrap());
    let (free, full) = (lowest.focus(&targets).unwrap(), highest.focus(&targets).unwrap());
    assert_eq!((free.shaping, full.shaping), (Shaping::Unshaped, Shaping::Shaped));
    assert!(full.drive.peak() <= 0.3);
    let share = level(&free.drive) / level(&full.drive);
    for part in [0.01, 0.5, 0.999] {
        let low = highest.focus_at(&targets, part * share).unwrap();
        assert_eq!(low.shaping, Shaping::Unshaped);
        assert!((low.drive.peak() / (part * free.drive.peak()) - 1.0).abs() < 1e-9);
        agrees("below the limits", &unit_peak(&low.drive), &column(free.drive.channels().concat()));
    }
    let between = highest.focus_at(&targets, 0.5 * (1.0 + share)).unwrap();
    let pushed = focus(&responses, &targets, &with(0.4)).unwrap();
    assert_eq!(between.shaping, Shaping::Shaped);
    agrees("half way", &unit_peak(&between.drive), &column(pushed.drive.channels().concat()));
    assert!(highest.focus_at(&targets, -1.0).is_err());
}

/// Two places a fiftieth of a millimetre apart, one of which is to move a hundred times as much as the other. The sum of
/// magnitudes of the difference of their responses bounds the difference of their velocities, far below the level that the
/// push asks for: no drive within the limit reaches it.
#[test]
fn limited_says_when_targets_do_not_reach_their_levels_together() {
    let responses = Membrane::small().responses();
    let beside = Point::new(target().x + 2e-5, target().y);
    let targets = [Target::at(target()), Target::at(beside).with_gain(0.01)];
    let with = |push: f64| Options { push, limit: 0.3, ..options(Method::Limited, 0.95) };
    let pushed = with(0.9);
    let focuser = Focuser::new(&responses, &pushed).unwrap();
    let (free, given_up) =
        (focus(&responses, &targets, &with(0.0)).unwrap(), focuser.focus(&targets).unwrap());
    assert_eq!((free.shaping, given_up.shaping), (Shaping::Unshaped, Shaping::GaveUp { attempts: 6 }));
    let unit_peak = |drive: &Drive| drive.clone().scaled(1.0 / drive.peak());
    agrees("given up", &unit_peak(&given_up.drive), &column(free.drive.channels().concat()));
    assert!((given_up.drive.peak() / 0.3 - 1.0).abs() < 1e-9);
    // A level that this drive reaches is no longer too much.
    let low = focuser.focus_at(&targets, 1e-5).unwrap();
    assert!(low.shaping == Shaping::Unshaped && low.drive.peak() < 0.3, "{:?}", low.shaping);
}

#[test]
fn limited_keeps_every_rms() {
    let responses = Membrane::small().responses();
    let square = |c: &Vec<f64>| c.iter().map(|d| d * d).sum::<f64>() / c.len() as f64;
    let squares = |options: Options| -> Vec<f64> {
        let drive = focus(&responses, &[Target::at(target())], &options).unwrap().drive;
        assert!(drive.peak() <= 1.0);
        drive.channels().iter().map(square).collect()
    };
    let plain = Options { push: 0.6, ..options(Method::Limited, 0.95) };
    let each = squares(Options { rms_limit: Some(0.35), ..plain.clone() });
    let most = each.iter().copied().fold(0.0, f64::max).sqrt();
    assert!((most - 0.35).abs() < 1e-6, "{most}");
    let together = squares(Options { total_rms: Some(0.5), ..plain.clone() }).iter().sum::<f64>().sqrt();
    assert!((together - 0.5).abs() < 1e-6, "{together}");
    let both = squares(Options { rms_limit: Some(0.3), total_rms: Some(0.4), ..plain });
    assert!(both.iter().all(|square| square.sqrt() < 0.3 + 1e-6));
    assert!(both.iter().sum::<f64>().sqrt() < 0.4 + 1e-6);
}

/// The drive of one period against the sum of many, written out.
#[test]
fn periodic_drives_are_least_in_their_steady_state() {
    let modal = Membrane::small().modal();
    let (rate, period) = (modal.conditions.rate, 150);
    let steady = Mat::from_fn(modal.poles.len(), modal.ports.len() * period, |m, row| {
        let (a, j) = (row / period, row % period);
        let at = |p: usize| (period - 1 - j + p * period) as f64 / rate;
        let sum: f64 = (0..60).map(|p| modal.poles[m].velocity(at(p))).sum();
        modal.input[(a, m)] * sum / rate
    });
    let strength = 0.9;
    let whole = within(&steady, &by(&cells(&modal, &[target()]), &steady)) * Scale(strength)
        + identity(steady.ncols(), (1.0 - strength) * unit(&modal, &steady));
    let right = solve(&whole, &within(&steady, &weights(&modal, target())));
    let hz = rate / period as f64;
    let focused = focus(
        &Membrane::small().responses(),
        &[Target::at(target()).repeated(hz)],
        &options(Method::Concentrate, strength),
    )
    .unwrap();
    let instant = focused.timing[0].instant;
    let most = right.col_as_slice(0).iter().fold(0.0_f64, |m, d| m.max(d.abs()));
    for (a, channel) in focused.drive.channels().iter().enumerate() {
        let last = &channel[instant + 1 - period..=instant];
        let right =
            MatRef::from_column_major_slice(&right.col_as_slice(0)[a * period..][..period], period, 1);
        for (found, right) in last.iter().zip(right.col(0).iter()) {
            assert!((found - right / most).abs() < 2e-6, "{found} {}", right / most);
        }
    }
}
