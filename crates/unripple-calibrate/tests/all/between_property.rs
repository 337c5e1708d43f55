//! What holds of any responses between points, and what is refused.

use std::f64::consts::TAU;
use unripple_calibrate::{Between, BetweenOptions, CalibrateError, Interpolation};
use unripple_core::{Conditions, Outline, Point, Port, SampledResponses, Shape};

const RATE: f64 = 8000.0;
const SAMPLES: usize = 161;
const CELERITY: f64 = 50.0;

fn conditions() -> Conditions {
    let outline = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 });
    Conditions { rate: RATE, band: [0.0, 1000.0], lambda_min: CELERITY / 1000.0, outline }
}

/// Standing waves of a few frequencies along different directions; of two actuators, the second half the first.
fn waves(points: &[Point]) -> SampledResponses {
    let ports = ["a1", "a2"].map(|name| Port { name: name.into(), at: Point::default() }).to_vec();
    let mut data = Vec::new();
    for p in points {
        for gain in [1.0, 0.5] {
            data.extend((0..SAMPLES).map(|i| {
                let wave = |n: i32| {
                    let hz = 50.0 * f64::from(3 * n + 2);
                    let (sin, cos) = (1.3 * f64::from(n)).sin_cos();
                    let along = TAU * hz / CELERITY * (p.x * cos + p.y * sin) + f64::from(n);
                    along.cos() * (TAU * hz * i as f64 / RATE).cos()
                };
                (gain * (0..6).map(wave).sum::<f64>()) as f32
            }));
        }
    }
    SampledResponses::new(ports, points.to_vec(), conditions(), SAMPLES, data).unwrap()
}

fn grid(pitch: f64) -> Vec<Point> {
    let [columns, rows] = [0.2, 0.1].map(|length: f64| (length / pitch).round() as usize);
    let at = |i: usize| (i as f64 + 0.5) * pitch;
    (0..columns * rows).map(|i| Point::new(at(i % columns), at(i / columns))).collect()
}

fn k(omega: f64) -> f64 {
    omega / CELERITY
}

fn exact() -> BetweenOptions {
    BetweenOptions { noise: 1e-5, gain_error: 0.0, nugget: 1e-4, ..BetweenOptions::default() }
}

fn off(found: &SampledResponses, truth: &SampledResponses) -> f64 {
    let pairs = (0..truth.points.len()).flat_map(|p| [(0, p), (1, p)]);
    let (mut wrong, mut right) = (0.0, 0.0);
    for (f, t) in pairs.flat_map(|(a, p)| found.response(a, p).iter().zip(truth.response(a, p))) {
        wrong += f64::from(f - t).powi(2);
        right += f64::from(*t).powi(2);
    }
    (wrong / right).sqrt()
}

#[test]
fn points_keep_their_own_responses() {
    let measured = waves(&grid(0.02));
    for interpolation in Interpolation::ALL {
        let between = Between::plan(&measured, k, &BetweenOptions { interpolation, ..exact() }).unwrap();
        let error = off(&between.onto(&measured.points).unwrap(), &measured);
        assert!(error < 2e-3, "{}: {error}", interpolation.name());
    }
}

#[test]
fn waves_are_continued_between_points() {
    let places: Vec<Point> = (0..20).map(|i| Point::new(0.04 + 0.006 * f64::from(i), 0.05)).collect();
    let (measured, truth) = (waves(&grid(0.02)), waves(&places));
    let between = Between::plan(&measured, k, &exact()).unwrap();
    let error = off(&between.onto(&places).unwrap(), &truth);
    assert!(error < 0.01, "{error}");
    let one = between.at(places[3]).unwrap();
    assert_eq!(one.points, vec![places[3]]);
    let both = one.response(0, 0).iter().zip(one.response(1, 0));
    assert!(both.into_iter().all(|(a, b)| (a - 2.0 * b).abs() < 1e-4));
}

#[test]
fn neighbourhoods_agree_with_the_whole() {
    let places: Vec<Point> = (0..20).map(|i| Point::new(0.04 + 0.006 * f64::from(i), 0.05)).collect();
    let measured = waves(&grid(0.01));
    let whole = Between::plan(&measured, k, &exact()).unwrap().onto(&places).unwrap();
    let parts = BetweenOptions { most: 150, ..exact() };
    let parts = Between::plan(&measured, k, &parts).unwrap().onto(&places).unwrap();
    assert!(off(&parts, &whole) < 5e-3, "{}", off(&parts, &whole));
}

#[test]
fn errors_grow_away_from_points() {
    let measured = waves(&grid(0.025));
    let between = Between::plan(&measured, k, &exact()).unwrap();
    let relative = |x, y| between.error(Point::new(x, y)).unwrap().relative;
    let (at, beside, rim) = (relative(0.1125, 0.0375), relative(0.1, 0.05), relative(0.1999, 0.0999));
    assert!(at < beside && beside < rim, "{at} {beside} {rim}");
    let error = between.error(Point::new(0.1, 0.05)).unwrap();
    assert!(error.hz.len() == error.share.len() && (error.rms[0] / error.rms[1] - 2.0).abs() < 1e-3);
    assert!(error.share.iter().all(|share| (0.0..1.1).contains(share)));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let measured = waves(&grid(0.025));
    let between = Between::plan(&measured, k, &exact()).unwrap();
    assert!(matches!(between.at(Point::new(0.3, 0.05)), Err(CalibrateError::Outside { place: 0, .. })));
    assert!(matches!(between.error(Point::new(f64::NAN, 0.05)), Err(CalibrateError::Outside { .. })));
    let range = |found: Result<Between, CalibrateError>| matches!(found, Err(CalibrateError::Range(_)));
    assert!(range(Between::plan(&measured, |_| f64::NAN, &exact())));
    assert!(range(Between::plan(&measured, |omega| -omega, &exact())));
    for wrong in [
        BetweenOptions { noise: f64::NAN, ..exact() },
        BetweenOptions { gain_error: -0.1, ..exact() },
        BetweenOptions { position_error: f64::INFINITY, ..exact() },
        BetweenOptions { nugget: 2.0, ..exact() },
        BetweenOptions { top: 0.5, ..exact() },
        BetweenOptions { most: 0, ..exact() },
    ] {
        assert!(range(Between::plan(&measured, k, &wrong)), "{wrong:?}");
    }
    let bad = |points: &[Point], samples: usize, value: f32| {
        let ports = waves(&[]).ports;
        let data = vec![value; 2 * points.len() * samples];
        SampledResponses::new(ports, points.to_vec(), conditions(), samples, data).unwrap()
    };
    let somewhere = [Point::new(0.1, 0.05)];
    for (responses, count) in [
        (bad(&[], SAMPLES, 0.0), true),
        (bad(&somewhere, 1, 0.0), true),
        (bad(&somewhere, SAMPLES, f32::NAN), false),
        (bad(&[Point::new(f64::NAN, 0.0)], SAMPLES, 0.0), false),
    ] {
        let error = Between::plan(&responses, k, &exact()).unwrap_err();
        assert_eq!(matches!(error, CalibrateError::Count { .. }), count, "{error}");
    }
    let silent = bad(&somewhere, SAMPLES, 0.0);
    let heard = Between::plan(&silent, k, &exact()).unwrap().at(Point::new(0.11, 0.05)).unwrap();
    assert!(heard.response(1, 0).iter().all(|h| *h == 0.0));
}
