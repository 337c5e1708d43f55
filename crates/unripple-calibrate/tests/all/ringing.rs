//! Knocks made of decaying sines, hum and noise, with a double hit: what is heard of them.

use std::f64::consts::TAU;
use unripple_calibrate::CalibrateError;
use unripple_calibrate::ringing::{Knock, ListenOptions, listen};
use unripple_core::Random;

/// Samples per second of all recordings here.
const RATE: f64 = 48e3;

/// Modes of the surface: frequency in Hz, decay time in s, amplitude. Two are 5.5 Hz apart.
const MODES: [[f64; 3]; 7] = [
    [183.0, 0.12, 1.0],
    [301.0, 0.09, 0.7],
    [306.5, 0.08, 0.5],
    [520.0, 0.06, 0.8],
    [811.0, 0.04, 0.5],
    [1240.0, 0.03, 0.6],
    [2210.0, 0.012, 0.4],
];

/// A recording of 1.6 s with hits at some times, hum of a mains frequency that is a little off, a fan at 437 Hz, and noise.
fn recording(hits: &[f64], mains: f64, noise: f64, seed: u64) -> Vec<f64> {
    let mut random = Random::seeded(seed);
    let ring = |t: f64| -> f64 {
        let one = |[hz, time, amplitude]: &[f64; 3]| amplitude * (-t / time).exp() * (TAU * hz * t).sin();
        if t < 0.0 { 0.0 } else { MODES.iter().map(one).sum() }
    };
    let sample = |n: u32| {
        let t = f64::from(n) / RATE;
        let hum = |order: f64, amplitude: f64| amplitude * (TAU * order * mains * t + order).sin();
        let steady = hum(1.0, 0.05) + hum(3.0, 0.03) + hum(5.0, 0.01) + 0.01 * (TAU * 437.0 * t).sin();
        0.2 + hits.iter().map(|hit| ring(t - hit)).sum::<f64>() + steady + noise * random.normal()
    };
    (0..76_800).map(sample).collect()
}

fn heard(recording: &[f64]) -> Knock {
    listen(recording, RATE, &ListenOptions::default()).unwrap()
}

#[test]
fn frequencies_and_decay_times_are_those_of_the_knock() {
    for seed in [1, 2] {
        let found = heard(&recording(&[0.3, 0.385], 50.02, 3e-3, seed));
        assert_eq!(found.modes.len(), MODES.len(), "{:?}", found.modes);
        for (mode, [hz, time, _]) in found.modes.iter().zip(MODES) {
            assert!((mode.hz / hz - 1.0).abs() < 2e-3, "{mode:?}");
            assert!((mode.decay_time / time - 1.0).abs() < 0.1, "{mode:?}");
        }
    }
}

#[test]
fn a_double_hit_is_named_and_what_follows_the_last_is_used() {
    let found = heard(&recording(&[0.3, 0.385], 50.0, 3e-3, 3));
    assert_eq!(found.hits.len(), 2, "{:?}", found.hits);
    assert!((found.hits[0] - 0.3).abs() < 2e-3 && (found.hits[1] - 0.385).abs() < 2e-3, "{:?}", found.hits);
    assert!(found.used[0] > 0.385 && found.used[0] < 0.4, "{:?}", found.used);
    let apart = recording(&[0.2, 0.9], 50.0, 3e-3, 3);
    let first = listen(&apart, RATE, &ListenOptions { hit: Some(0), ..ListenOptions::default() }).unwrap();
    assert!(first.used[1] < 0.905 && first.modes.len() >= MODES.len() - 1, "{first:?}");
}

#[test]
fn hum_and_steady_tones_are_no_modes() {
    let found = heard(&recording(&[0.3], 50.02, 3e-3, 4));
    assert_eq!(found.mains, Some(50.0));
    let orders: Vec<f64> = found.hum.iter().map(|tone| (tone.hz / 50.02).round()).collect();
    assert_eq!(orders, [1.0, 3.0, 5.0], "{:?}", found.hum);
    assert!(found.tones.iter().any(|tone| (tone.hz - 437.0).abs() < 1.0), "{:?}", found.tones);
    assert!(found.modes.iter().all(|mode| (mode.hz - 437.0).abs() > 10.0 && mode.hz > 180.0));
    assert_eq!(heard(&recording(&[0.3], 59.97, 3e-3, 4)).mains, Some(60.0));
    // A frequency that is named and not heard is none: no tone here is a multiple of 70 Hz.
    let named = ListenOptions { mains: Some(70.0), ..ListenOptions::default() };
    let found = listen(&recording(&[0.3], 50.0, 3e-3, 4), RATE, &named).unwrap();
    assert!(found.mains.is_none() && found.hum.is_empty(), "{:?}", found.hum);
}

#[test]
fn intervals_hold_the_truth_in_most_cases() {
    let mut counts = [0, 0, 0];
    for seed in 10..14 {
        let found = heard(&recording(&[0.3], 50.0, 0.02, seed));
        for mode in &found.modes {
            let Some([hz, time, _]) = MODES.iter().find(|[hz, ..]| (hz / mode.hz - 1.0).abs() < 5e-3) else {
                continue;
            };
            counts[0] += 1;
            counts[1] += usize::from((mode.hz_interval[0]..=mode.hz_interval[1]).contains(hz));
            counts[2] += usize::from((mode.decay_interval[0]..=mode.decay_interval[1]).contains(time));
        }
    }
    // 95 % of some 28; what overlaps from other sub-bands takes a few.
    assert!(
        counts[0] >= 24 && counts[1] * 10 >= counts[0] * 8 && counts[2] * 10 >= counts[0] * 8,
        "{counts:?}"
    );
}

#[test]
fn the_sound_of_a_room_is_doubtful() {
    let mut doubtful = 0;
    for seed in 20..24 {
        let mut random = Random::seeded(seed);
        let mut sound = recording(&[0.3], 50.0, 3e-3, seed);
        // Noise that falls by 60 dB in 0.3 s, as in a small room.
        let begin = (0.3 * RATE) as usize;
        for (n, sample) in sound[begin..].iter_mut().enumerate() {
            *sample += 0.2 * 1e3_f64.powf(-(n as f64) / RATE / 0.3) * random.normal();
        }
        let found = heard(&sound);
        let known = |hz: f64| MODES.iter().any(|mode| (mode[0] / hz - 1.0).abs() < 5e-3);
        let clear: Vec<f64> =
            found.modes.iter().filter(|mode| !mode.is_doubtful()).map(|mode| mode.hz).collect();
        assert!(clear.len() >= 5 && clear.iter().all(|hz| known(*hz)), "{:?}", found.modes);
        doubtful += found.modes.iter().filter(|mode| !known(mode.hz)).count();
    }
    assert!(doubtful > 0, "the room is to be heard");
}

#[test]
fn recordings_without_a_knock_are_refused() {
    let usual = ListenOptions::default();
    let told = |recording: &[f64], options: &ListenOptions| listen(recording, RATE, options).unwrap_err();
    assert!(matches!(told(&[0.0; 48_000], &usual), CalibrateError::Recording { .. }));
    assert!(matches!(told(&[], &usual), CalibrateError::Recording { .. }));
    let knock = recording(&[0.3], 50.0, 3e-3, 5);
    assert!(matches!(told(&knock[..15_000], &usual), CalibrateError::Recording { .. }));
    let third = ListenOptions { hit: Some(2), ..usual.clone() };
    assert!(told(&knock, &third).to_string().contains("found 3"));
    let wide = ListenOptions { band: Some([20.0, 30e3]), ..usual };
    assert!(matches!(told(&knock, &wide), CalibrateError::Range(_)));
    assert!(listen(&knock, f64::NAN, &ListenOptions::default()).is_err());
}
