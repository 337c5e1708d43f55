//! Waveforms and pulses against the sums that define what a drive does.

use crate::common;
use unripple_linalg::{Lu, Mat};

use common::{Membrane, responses_at, velocity};
use std::f64::consts::TAU;
use unripple_core::{Drive, ModalResponses, Point, Responses, SampledResponses};
use unripple_focus::waveform::{burst, click};
use unripple_focus::{
    FocusError, Pattern, PlayOptions, Pulse, PulseOptions, Quantity, Stroke, Waveform, play, strike,
};

const A: Point = Point { x: 0.033, y: 0.044 };
const B: Point = Point { x: 0.071, y: 0.022 };

/// Displacement that a drive makes at a point, sample by sample: Σ_m φ_m Σ_j u_m[i−j] q_m[j].
fn displacement(modal: &ModalResponses, drive: &Drive, at: Point, samples: usize) -> Vec<f64> {
    let mut row = vec![0.0; modal.shapes.modes()];
    modal.shapes.at(at, &mut row);
    let mut sum = vec![0.0; samples];
    for (m, pole) in modal.poles.iter().enumerate() {
        let [[a, b], [c, d]] = pole.step(1.0 / drive.rate());
        let (mut u, mut v) = (0.0, 0.0);
        for (i, sum) in sum.iter_mut().enumerate() {
            (u, v) = (a * u + b * v, c * u + d * v);
            let sent = |(port, channel): (usize, &Vec<f64>)| {
                modal.input[(port, m)] * channel.get(i).unwrap_or(&0.0) / drive.rate()
            };
            v += drive.channels().iter().enumerate().map(sent).sum::<f64>();
            *sum += row[m] * u;
        }
    }
    sum
}

fn energy(signal: impl IntoIterator<Item = f64>) -> f64 {
    signal.into_iter().map(|x| x * x).sum()
}

fn loud() -> PlayOptions {
    PlayOptions { limit: 1e9, ..PlayOptions::default() }
}

#[test]
fn a_target_follows_while_another_point_is_still() {
    let membrane = Membrane::small();
    let modal = membrane.modal();
    for samples in [burst(250.0, 5.0, 1e-6, 12e3).unwrap(), click(3e-3, 2e-6, 12e3).unwrap()] {
        let played = play(&membrane.responses(), &[Waveform::at(A, samples)], &[B], &loud()).unwrap();
        assert_eq!((played.starts[0], played.scale), (360, 1.0));
        assert!(played.lost[0] < 1e-3, "{}", played.lost[0]);
        // 200 ms, ten decay times, beyond the drive.
        let found = displacement(&modal, &played.drive, A, played.drive.samples() + 2400);
        let asked = energy(played.prescribed[0].iter().copied());
        let error = found.iter().enumerate().map(|(i, u)| u - played.prescribed[0].get(i).unwrap_or(&0.0));
        let error = 10.0 * (energy(error) / asked).log10();
        let silence = energy(displacement(&modal, &played.drive, B, found.len())) / asked;
        println!("error {error:.1} dB, silence {:.1} dB", 10.0 * silence.log10());
        assert!(error < -50.0 && silence < 1e-5, "{error} {silence}");
    }
}

/// A steady tone takes least drive where every channel sends conj(H_a) / Σ|H|².
#[test]
fn a_long_tone_is_made_with_the_least_energy() {
    let membrane = Membrane::small();
    let modal = membrane.modal();
    let (hz, rate) = (400.0, membrane.rate);
    let tone = (0..6000).map(|i| (TAU * hz * f64::from(i) / rate).cos()).collect();
    let options =
        PlayOptions { quantity: Quantity::Velocity, energy_weight: 1e-8, tolerance: 1e-6, ..loud() };
    let played = play(&membrane.responses(), &[Waveform::at(A, tone)], &[], &options).unwrap();
    let line = |signal: &[f64], from: usize| {
        let turn = |i: usize| (TAU * hz * i as f64 / rate).sin_cos();
        let sum = signal.iter().enumerate().map(|(i, x)| (x * turn(i + from).1, -x * turn(i + from).0));
        sum.fold((0.0, 0.0), |s, x| (s.0 + x.0, s.1 + x.1))
    };
    // Twenty-five decay times of each response, and a steady second half with whole periods.
    let transfer: Vec<_> = responses_at(&modal, A, 6000).iter().map(|h| line(h, 0)).collect();
    let power: f64 = transfer.iter().map(|h| (h.0 * h.0 + h.1 * h.1) / rate / rate).sum();
    let start = played.starts[0] + 1500;
    for (channel, h) in played.drive.channels().iter().zip(transfer) {
        let (c, s) = line(&channel[start..start + 3000], 1500);
        let (re, im) = (c / 1500.0, s / 1500.0);
        let exact = (h.0 / rate / power, -h.1 / rate / power);
        let size = 1.0 / power.sqrt();
        assert!((re - exact.0).hypot(im - exact.1) < 1e-4 * size, "({re}, {im}) {exact:?}");
    }
}

#[test]
fn measured_responses_play_as_the_modes_they_were_taken_from() {
    let membrane = Membrane::small();
    let modal = membrane.modal();
    let (points, samples) = ([A, B], 2400);
    let data =
        points.iter().flat_map(|at| responses_at(&modal, *at, samples).concat()).map(|h| h as f32).collect();
    let library =
        SampledResponses::new(modal.ports.clone(), points.to_vec(), modal.conditions.clone(), samples, data);
    let library = Responses::Sampled(library.unwrap());
    let near = Point::new(A.x + 1e-3, A.y);
    let waves = |at| [Waveform::at(at, burst(300.0, 6.0, 1e-6, 12e3).unwrap()).delayed(0.01)];
    for (quantity, least) in [(Quantity::Velocity, 1e-6), (Quantity::Displacement, 1e-5)] {
        let options = PlayOptions { quantity, tolerance: 1e-6, ..loud() };
        let modes = play(&membrane.responses(), &waves(A), &[B], &options).unwrap();
        let sampled = play(&library, &waves(near), &[B], &options).unwrap();
        assert_eq!((sampled.points[0][0], sampled.starts[0]), (A, 480));
        let pairs = modes.drive.channels().iter().flatten().zip(sampled.drive.channels().iter().flatten());
        let share = energy(pairs.map(|(a, b)| a - b)) / energy(modes.drive.channels().concat());
        assert!(share < least, "{quantity:?}: {share}");
    }
}

#[test]
fn limits_scale_the_whole() {
    let responses = Membrane::small().responses();
    let waves = |level| [Waveform::at(A, burst(250.0, 5.0, level, 12e3).unwrap())];
    let free = play(&responses, &waves(1e-6), &[B], &loud()).unwrap();
    let limit = free.drive.peak() / 4.0;
    let held = play(&responses, &waves(1e-6), &[B], &PlayOptions { limit, ..loud() }).unwrap();
    assert!((held.scale - 0.25).abs() < 1e-12 && (held.drive.peak() / limit - 1.0).abs() < 1e-12);
    assert!(held.prescribed[0].iter().zip(&free.prescribed[0]).all(|(a, b)| (a - b / 4.0).abs() < 1e-18));
    let quiet = PlayOptions { rms_limit: Some(1e-4 * limit), limit, ..loud() };
    let quiet = play(&responses, &waves(1e-6), &[], &quiet).unwrap();
    let rms = quiet.drive.channels().iter().map(|c| (energy(c.iter().copied()) / c.len() as f64).sqrt());
    assert!((rms.fold(0.0, f64::max) / (1e-4 * limit) - 1.0).abs() < 1e-9);
}

#[test]
fn what_cannot_be_played_is_refused() {
    let membrane = Membrane::small();
    let responses = membrane.responses();
    let wave = |at| Waveform::at(at, vec![1e-6; 10]);
    let refused = |waves: &[Waveform], options: &PlayOptions| {
        play(&responses, waves, &[], options).unwrap_err().to_string()
    };
    assert!(refused(&[], &loud()).contains("expected 1 to"));
    assert!(refused(&[wave(Point::new(1.0, 1.0))], &loud()).contains("outside the surface"));
    assert!(refused(&[wave(Point::new(0.0, 0.04))], &loud()).contains("no actuator can move"));
    assert!(refused(&[Waveform::at(A, vec![])], &loud()).contains("samples of a waveform"));
    assert!(refused(&[Waveform::at(A, vec![f64::NAN])], &loud()).contains("finite numbers"));
    assert!(refused(&[wave(A).delayed(-1.0)], &loud()).contains("delay of waveform 1 (s)"));
    assert!(refused(&[wave(A).delayed(1e9)], &loud()).contains("samples of a waveform and its decay"));
    for options in [
        PlayOptions { band: Some([0.0, 2e3]), ..loud() },
        PlayOptions { band: Some([1e3, 500.0]), ..loud() },
        PlayOptions { energy_weight: 0.0, ..loud() },
        PlayOptions { lead: [f64::NAN, 0.0], ..loud() },
        PlayOptions { limit: -1.0, ..loud() },
    ] {
        assert!(matches!(play(&responses, &[wave(A)], &[], &options), Err(FocusError::Range(_))));
    }
    let endless = Membrane { decay_time: f64::INFINITY, ..membrane }.responses();
    assert!(play(&endless, &[wave(A)], &[], &loud()).unwrap_err().to_string().contains("died out"));
}

/// Levels of pulses that share actuators, time and neighbourhood, and the energy of the dense solution of least norm.
#[test]
fn pulses_reach_their_levels_with_the_least_energy() {
    let membrane = Membrane::small();
    let modal = membrane.modal();
    let pulse = |points: &[Point], instant, level| Pulse { points: points.to_vec(), instant, level };
    let pulses =
        [pulse(&[A], 0.0, 1.0), pulse(&[Point::new(0.035, 0.044), B], 0.002, -0.4), pulse(&[B], 0.005, 0.7)];
    let options =
        PulseOptions { window: 10e-3, ridge: 1e-12, limit: 1e9, accuracy: 1e-12, ..PulseOptions::default() };
    let struck = strike(&membrane.responses(), &pulses, &options).unwrap();
    assert_eq!(struck.instants, [120, 144, 180]);
    let wanted: Vec<(Point, usize, f64)> = pulses
        .iter()
        .zip(&struck.instants)
        .flat_map(|(p, i)| p.points.iter().map(move |at| (*at, *i, p.level)))
        .collect();
    for (at, instant, level) in &wanted {
        let found = velocity(&modal, &struck.drive, *at, *instant);
        assert!((found - level).abs() < 1e-6, "{at} {instant}: {found} {level}");
    }
    let length = struck.drive.samples();
    let rows: Vec<Vec<f64>> = wanted
        .iter()
        .map(|(at, instant, _)| {
            let h = responses_at(&modal, *at, instant + 1);
            h.iter()
                .flat_map(|h| (0..length).map(|j| if j <= *instant { h[instant - j] } else { 0.0 }))
                .collect()
        })
        .collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let gram = Mat::from_fn(rows.len(), rows.len(), |k, l| dot(&rows[k], &rows[l]));
    let levels = Mat::from_fn(rows.len(), 1, |k, _| wanted[k].2 * membrane.rate);
    let mut gains = levels.clone();
    Lu::new(gram.as_ref()).solve(gains.as_mut());
    let exact: Vec<f64> =
        (0..rows[0].len()).map(|j| (0..rows.len()).map(|k| gains[(k, 0)] * rows[k][j]).sum()).collect();
    let found = struck.drive.channels().concat();
    let difference = energy(found.iter().zip(&exact).map(|(a, b)| a - b)) / energy(exact.iter().copied());
    assert!(difference < 1e-10, "{difference}");
}

#[test]
fn shapes_have_one_level_along_their_length() {
    let membrane = Membrane::small();
    let modal = membrane.modal();
    let circle = Pattern::circle(Point::new(0.05, 0.04), 0.02);
    let points = circle.sample(Pattern::pitch(modal.conditions.lambda_min)).unwrap();
    let pulse = Pulse { points: points.clone(), instant: 0.0, level: 0.1 };
    let options = PulseOptions { limit: 1e9, accuracy: 1e-10, ..PulseOptions::default() };
    let struck = strike(&membrane.responses(), &[pulse], &options).unwrap();
    for at in &points {
        let found = velocity(&modal, &struck.drive, *at, struck.instants[0]);
        assert!((found / 0.1 - 1.0).abs() < 2e-3, "{at}: {found}");
    }
}

#[test]
fn strokes_are_pulses_at_even_steps() {
    let responses = Membrane::small().responses();
    let circle = Stroke::along(Pattern::circle(Point::new(0.05, 0.04), 0.01), 0.1);
    let pulses = circle.pulses(&responses).unwrap();
    assert_eq!(pulses.len(), (circle.duration() * 200.0).ceil() as usize);
    let closing = pulses[0].points[0].distance(pulses[pulses.len() - 1].points[0]);
    assert!((closing / pulses[0].points[0].distance(pulses[1].points[0]) - 1.0).abs() < 0.02);
    // Faster than an eighth of a wavelength per pulse: more pulses.
    let fast = Stroke { speed: 2.0, ..circle.clone() }.pulses(&responses).unwrap();
    let lambda = responses.conditions().lambda_min;
    assert!(fast.windows(2).all(|two| two[0].points[0].distance(two[1].points[0]) <= lambda / 8.0));
    for bad in [
        Stroke { speed: 0.0, ..circle.clone() },
        Stroke { speed: 1e3, ..circle.clone() },
        Stroke { speed: 1e-9, ..circle.clone() },
        Stroke { speed: 1e-300, ..circle.clone() },
        Stroke { rate_hz: f64::NAN, ..circle.clone() },
        Stroke { rate_hz: 1e6, ..circle.clone() },
        Stroke { level: -1.0, ..circle.clone() },
        Stroke { path: Pattern::polygon(vec![A; 3]), ..circle.clone() },
        Stroke { path: Pattern { lines: vec![], filled: false }, ..circle },
    ] {
        assert!(matches!(bad.pulses(&responses), Err(FocusError::Range(_))), "{bad:?}");
    }
}

#[test]
fn pulses_that_no_memory_holds_are_refused() {
    let responses = Membrane::small().responses();
    let many = strike(&responses, &vec![Pulse::at(A, 0.1); 8193], &PulseOptions::default()).unwrap_err();
    assert_eq!(
        many.to_string(),
        "points over all pulses: expected at most 8192: fewer pulses or a shorter time, found 8193"
    );
}
