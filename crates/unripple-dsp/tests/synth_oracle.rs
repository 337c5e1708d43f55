//! Truth: the sum that defines modal responses, taken term by term in double precision.

use unripple_core::Pole;
use unripple_dsp::{DspError, ModalSynth};
use unripple_linalg::Mat;

/// Modes of a film-like spectrum up to `top_hz`, decaying with `sigma`.
fn poles(count: usize, top_hz: f64, sigma: f64) -> Vec<Pole> {
    (0..count)
        .map(|m| {
            let part = (m + 1) as f64 / count as f64;
            Pole::new(std::f64::consts::TAU * top_hz * part.sqrt(), sigma)
        })
        .collect()
}

fn weights(rows: usize, modes: usize) -> Mat<f64> {
    Mat::from_fn(rows, modes, |r, m| ((r * 31 + m * m * 7 + 3) as f64).sin())
}

/// Largest error of any sample over what its row may err by, e^{-σt} included.
fn worst(poles: &[Pole], rate: f64, samples: usize, found: &[f64], weights: &Mat<f64>) -> f64 {
    let mut worst: f64 = 0.0;
    for row in 0..weights.nrows() {
        for i in 0..samples {
            let t = i as f64 / rate;
            let (mut exact, mut scale) = (0.0, 0.0);
            for (m, pole) in poles.iter().enumerate() {
                exact += weights[(row, m)] * pole.velocity(t);
                scale += weights[(row, m)].abs();
            }
            worst = worst.max((found[row * samples + i] - exact).abs() / scale);
        }
    }
    worst
}

#[test]
fn agrees_with_the_direct_sum_at_every_accuracy() {
    for accuracy in [1e-2, 1e-4, 1e-6, 1e-9, 1e-12] {
        for (rate, top_hz) in [(48e3, 3e3), (48e3, 12e3), (48e3, 23e3), (44.1e3, 500.0), (8e3, 3.9e3)] {
            for (rows, samples) in [(1, 1), (3, 1441), (40, 97), (300, 50)] {
                let poles = poles(60, top_hz, 14.0);
                let synth = ModalSynth::new(&poles, rate, samples, accuracy);
                let weights = weights(rows, poles.len());
                let mut out = vec![f64::NAN; rows * samples];
                synth.respond(weights.as_ref(), &mut out).unwrap();
                let error = worst(&poles, rate, samples, &out, &weights);
                assert!(error <= accuracy, "{accuracy} {rate} {top_hz} {rows} {samples}: {error}");
            }
        }
    }
}

#[test]
fn sums_damped_and_rigid_modes_too() {
    let mut poles = poles(200, 3e3, 14.0);
    poles[0] = Pole::new(0.0, 0.0);
    poles[1] = Pole::new(300.0, 300.0);
    poles[2] = Pole::new(300.0, 5e3);
    poles[3] = Pole::new(9e3, 8e3);
    poles[4] = Pole::new(1e6, 10.0);
    let weights = weights(8, poles.len());
    for accuracy in [1e-4, 1e-8] {
        let synth = ModalSynth::new(&poles, 48e3, 500, accuracy);
        let mut out = vec![f64::NAN; 8 * 500];
        synth.respond(weights.as_ref(), &mut out).unwrap();
        let error = worst(&poles, 48e3, 500, &out, &weights);
        assert!(error <= accuracy, "{accuracy}: {error}");
    }
}

#[test]
fn does_less_where_modes_ring_low() {
    let synth = ModalSynth::new(&poles(306, 3e3, 14.0), 48e3, 1441, 1e-6);
    assert!(synth.step() >= 4);
    assert!(synth.operations() < 2 * 306 * 1441 / 3, "{}", synth.operations());
}

#[test]
fn single_precision_is_single_precision() {
    let poles = poles(306, 3e3, 14.0);
    for rows in [1, 8, 200] {
        let weights = weights(rows, poles.len());
        let narrow = Mat::from_fn(rows, poles.len(), |r, m| weights[(r, m)] as f32);
        let mut out = vec![f32::NAN; rows * 400];
        ModalSynth::new(&poles, 48e3, 400, 1e-6).respond_f32(narrow.as_ref(), &mut out).unwrap();
        let out: Vec<f64> = out.into_iter().map(f64::from).collect();
        let error = worst(&poles, 48e3, 400, &out, &weights);
        assert!(error < 2e-6, "{rows}: {error}");
    }
}

#[test]
fn the_same_on_any_number_of_threads_or_rows_at_once() {
    let poles = poles(100, 3e3, 14.0);
    let synth = ModalSynth::new(&poles, 48e3, 301, 1e-9);
    let weights = weights(300, poles.len());
    let mut together = vec![0.0; 300 * 301];
    synth.respond(weights.as_ref(), &mut together).unwrap();
    for first in [0, 77, 299] {
        let mut alone = vec![0.0; 301];
        synth.respond(weights.as_ref().subrows(first, 1), &mut alone).unwrap();
        for (a, b) in alone.iter().zip(&together[first * 301..]) {
            assert!((a - b).abs() < 1e-11, "{first}: {a} {b}");
        }
    }
}

#[test]
fn empty_and_mismatched() {
    let poles = poles(5, 1e3, 14.0);
    let synth = ModalSynth::new(&poles, 48e3, 10, 1e-6);
    let mut short = [0.0; 9];
    let found = synth.respond(weights(1, 5).as_ref(), &mut short);
    assert_eq!(found, Err(DspError::Size { what: "samples of all responses", expected: 10, found: 9 }));
    assert!(synth.respond(weights(1, 4).as_ref(), &mut [0.0; 10]).is_err());
    assert!(synth.respond(weights(0, 5).as_ref(), &mut []).is_ok());
    let mut silent = [f64::NAN; 3];
    ModalSynth::new(&[], 48e3, 3, 1e-6).respond(Mat::zeros(1, 0).as_ref(), &mut silent).unwrap();
    assert_eq!(silent, [0.0; 3]);
    for accuracy in [0.0, f64::NAN, f64::INFINITY, -1.0] {
        let synth = ModalSynth::new(&poles, 48e3, 10, accuracy);
        let mut out = [f64::NAN; 10];
        synth.respond(weights(1, 5).as_ref(), &mut out).unwrap();
        assert!(out.iter().all(|v| v.is_finite()), "{accuracy}");
    }
}
