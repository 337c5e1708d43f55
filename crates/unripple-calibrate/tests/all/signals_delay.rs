//! Truth: delays that were put in.

use crate::signals_bench;

use signals_bench::{Noise, Plant, RATE, error};
use unripple_calibrate::signals::{Band, Delay, Gate, onset, shift};

const BAND: Band = Band { low: [30.0, 45.0], high: [3000.0, 3600.0] };

#[test]
fn a_loopback_is_found_to_a_fraction_of_a_sample() {
    let mut impulse = vec![0.0; 4096];
    impulse[2000] = 1.0;
    for (by, gain) in [(3.37, 0.5), (-12.5, -2.0), (700.123, 1.0), (0.0, 1.0)] {
        for band in [BAND, Band::ALL, Band { low: [30.0, 45.0], high: [15e3, 18e3] }] {
            let mut found = shift(&impulse, by);
            found.iter_mut().for_each(|x| *x *= gain);
            let delay = Delay::of_impulse(&found, RATE, band).unwrap();
            let wrong = delay.samples - 2000.0 - by;
            assert!(wrong.abs() < 0.01, "{by} in {band:?}: wrong by {wrong}");
            assert_eq!(delay.inverted, gain < 0.0);
            assert!(delay.correlation > 0.999);
        }
    }
}

#[test]
fn a_known_onset_is_found_in_noise_too() {
    let response = Plant::new(7, 306, 0.07).response(1441);
    let mut model = vec![0.0; 4000];
    model[500..1941].copy_from_slice(&response);
    BAND.limit(&mut model, RATE).unwrap();
    let late = shift(&model, 3.37);
    let clean = Delay::between(&late, &model, RATE, BAND).unwrap();
    assert!((clean.samples - 3.37).abs() < 1e-6 && clean.correlation > 1.0 - 1e-9);
    for seed in 0..20 {
        let mut noisy = late.clone();
        Noise(seed).spoil(&mut noisy, 30.0);
        let delay = Delay::between(&noisy, &model, RATE, BAND).unwrap();
        assert!((delay.samples - 3.37).abs() < 0.1, "{}", delay.samples);
    }
    assert!(Delay::between(&[0.0; 9], &model, RATE, BAND).is_err());
    assert!(Delay::between(&model, &[], RATE, BAND).is_err());
}

/// The Cramér-Rao bound of a delay in white noise: variance = noise / Σ (slope of the signal)².
#[test]
fn no_estimate_could_be_much_better() {
    let mut model = Plant::new(8, 306, 0.07).response(3000);
    BAND.limit(&mut model, RATE).unwrap();
    let slopes: f64 = model.windows(3).map(|w| ((w[2] - w[0]) / 2.0).powi(2)).sum();
    let noise = signals_bench::rms(&model) * 0.1;
    let errors: Vec<f64> = (0..60)
        .map(|seed| {
            let heard = Noise(seed).of(model.len(), noise);
            let heard: Vec<f64> = heard.iter().zip(&model).map(|(n, x)| n + x).collect();
            Delay::between(&heard, &model, RATE, Band::ALL).unwrap().samples
        })
        .collect();
    let ratio = signals_bench::rms(&errors) / (noise / slopes.sqrt());
    assert!((0.75..1.25).contains(&ratio), "{ratio}");
}

#[test]
fn shifts_add_up_and_move_samples_whole() {
    let mut signal = Noise(9).of(800, 1.0);
    Gate { begin: 200.0, rise: 100.0, end: 600.0, fall: 100.0 }.apply(&mut signal);
    // No lower edge, and a soft upper one: what rings long would ring beyond the ends.
    Band { low: [0.0; 2], high: [3000.0, 9000.0] }.limit(&mut signal, RATE).unwrap();
    let there = shift(&signal, 7.3);
    assert!(error(&shift(&there, -7.3), &signal) < 1e-3);
    assert!(error(&shift(&there, 2.7)[10..], &signal[..790]) < 1e-3);
    assert!(shift(&signal, f64::NAN).iter().all(|x| *x == 0.0) && shift(&[], 1.0).is_empty());
}

#[test]
fn the_band_lets_tones_through_as_its_weight_says() {
    let tone = |hz: f64| -> Vec<f64> {
        (0..48_000).map(|i| (std::f64::consts::TAU * hz * f64::from(i) / RATE).sin()).collect()
    };
    for hz in [10.0, 38.0, 100.0, 2999.0, 3300.0, 4000.0] {
        let (given, mut left) = (tone(hz), tone(hz));
        BAND.limit(&mut left, RATE).unwrap();
        let middle = 12_000..36_000;
        let share: f64 =
            left[middle.clone()].iter().zip(&given[middle]).map(|(a, b)| a * b).sum::<f64>() / 12_000.0;
        assert!((share - BAND.weight(hz)).abs() < 3e-3, "{hz}: {share} {}", BAND.weight(hz));
    }
    assert!(Band { low: [f64::NAN, 1.0], high: [2.0, 3.0] }.limit(&mut [1.0], RATE).is_err());
    assert_eq!(onset(&[0.0; 4], 20.0), Ok(None));
    assert!(onset(&[1.0], 0.0).is_err());
}
