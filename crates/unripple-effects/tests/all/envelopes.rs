//! Curves and waveforms against closed forms and brute force.

use proptest::prelude::*;
use std::f64::consts::TAU;
use unripple_effects::{Curve, Envelope};

#[test]
fn a_chirp_is_the_closed_form() {
    // 20 to 60 Hz in a second: phase 20 t + 20 t².
    let chirp = Envelope::new(vec![(0.0, 0.0), (1.0, 1.0)], vec![(0.0, 20.0), (1.0, 60.0)]).unwrap();
    let wave = chirp.sampled(8e3).unwrap();
    // The last 2 ms fall, as the amplitude does not end at zero.
    for (i, sample) in wave.samples.iter().enumerate().take(7984) {
        let t = i as f64 / 8e3;
        let expected = t * (TAU * (20.0 * t + 20.0 * t * t)).sin();
        assert!((f64::from(*sample) - expected).abs() < 1e-6, "{i}");
    }
    assert_eq!(wave.samples[8000], 0.0);
}

#[test]
fn a_loop_meets_itself() {
    for frequency in [1.0, 37.3, 100.0, 440.1, 999.9] {
        let envelope = Envelope::sine(frequency).unwrap();
        let wave = envelope.looped(48e3).unwrap();
        // The frequency of the loop, counted in whole periods.
        let periods = (frequency * wave.duration()).round();
        let off = periods / wave.duration() / frequency - 1.0;
        assert!(off.abs() < 5e-5 && wave.duration() >= 0.25 - 1e-4, "{frequency} {off}");
        let step = |a: f32, b: f32| (f64::from(a) - f64::from(b)).abs();
        let inside = wave.samples.windows(2).map(|w| step(w[0], w[1])).fold(0.0, f64::max);
        assert!(step(wave.samples[wave.samples.len() - 1], wave.samples[0]) <= inside * (1.0 + 1e-6));
    }
}

proptest! {
    #[test]
    fn integrals_are_sums(points in proptest::collection::vec((0.0..1.0_f64, 0.0..5.0_f64), 1..8), x in -0.5..1.5_f64) {
        let mut points = points;
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let first = points[0].0;
        let curve = Curve::new("x", points, [0.0, 1.0], [0.0, 5.0]).unwrap();
        let steps = 20_000;
        let width = (x - first) / f64::from(steps);
        let sum: f64 = (0..steps).map(|i| curve.at(first + width * (f64::from(i) + 0.5)) * width).sum();
        // A step between two points costs at most its height times the width of a slice.
        prop_assert!((curve.integral(x) - sum).abs() < 8.0 * 5.0 * width.abs() + 1e-9);
    }

    #[test]
    fn waveforms_are_within_their_amplitude(
        amplitude in proptest::collection::vec((0.0..0.5_f64, 0.0..1.0_f64), 2..6),
        frequency in proptest::collection::vec((0.0..0.5_f64, 1.0..1000.0_f64), 1..6),
    ) {
        let (mut amplitude, mut frequency) = (amplitude, frequency);
        amplitude.sort_by(|a, b| a.0.total_cmp(&b.0));
        frequency.sort_by(|a, b| a.0.total_cmp(&b.0));
        let envelope = Envelope::new(amplitude, frequency);
        prop_assume!(envelope.is_ok());
        let envelope = envelope.unwrap();
        for wave in [envelope.sampled(4e3).unwrap(), envelope.looped(4e3).unwrap()] {
            for (i, sample) in wave.samples.iter().enumerate() {
                // Next to a step either value is right.
                let most = (-2..=2).map(|d| envelope.amplitude().at((i as f64 + f64::from(d)) / 4e3)).fold(0.0, f64::max);
                prop_assert!(f64::from(sample.abs()) <= most + 0.01, "{} {} {}", i, sample, most);
            }
        }
        // Nothing steps at the end of what is played once.
        let once = envelope.sampled(4e3).unwrap();
        prop_assert!(once.samples[once.samples.len() - 1].abs() < 1e-3 || envelope.duration() * 4e3 % 1.0 != 0.0);
        prop_assert_eq!(once.samples[0], 0.0);
    }
}
