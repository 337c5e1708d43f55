//! The convolver against plain convolution.

use crate::common;

use common::noise;
use proptest::prelude::*;
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_player::Convolver;

/// A signal without anything above 3 kHz: some sines at 48 kHz, faded in after a silence in which filters come in.
fn in_band(seed: u64, samples: usize) -> Vec<f64> {
    let parts = noise(seed, 20);
    let sine = |k: usize, i: usize| {
        let hertz = 60.0 + 2900.0 * f64::from(parts[2 * k].abs());
        (TAU * (hertz * i as f64 / 48e3 + f64::from(parts[2 * k + 1]))).sin()
    };
    let rise = |i: usize| {
        let along = (i.saturating_sub(256) as f64 / 960.0).min(1.0);
        (along * TAU / 4.0).sin().powi(4)
    };
    (0..samples).map(|i| rise(i) * (0..10).map(|k| sine(k, i)).sum::<f64>() / 10.0).collect()
}

/// Plain convolution at the full rate.
fn convolved(signal: &[f64], response: &[f32]) -> Vec<f64> {
    let sample = |i: usize| response.iter().zip((0..=i).rev()).map(|(&h, j)| f64::from(h) * signal[j]).sum();
    (0..signal.len()).map(sample).collect()
}

/// Runs planar signals through a convolver; planar outputs.
fn run(convolver: &mut Convolver, block: usize, signals: &[Vec<f64>], outputs: usize) -> Vec<Vec<f64>> {
    let mut heard = vec![Vec::new(); outputs];
    let mut out = vec![0f32; outputs * block];
    for start in (0..signals[0].len()).step_by(block) {
        let input: Vec<f32> =
            signals.iter().flat_map(|s| &s[start..start + block]).map(|&x| x as f32).collect();
        convolver.process(&input, &mut out);
        let parts = heard.iter_mut().zip(out.chunks_exact(block));
        parts.for_each(|(heard, part)| heard.extend(part.iter().map(|&x| f64::from(x))));
    }
    heard
}

#[test]
fn equals_plain_convolution_in_the_band() {
    for (block, outputs, taps) in [(64, 5, 1440), (16, 1, 100), (60, 9, 333), (256, 3, 700), (30, 2, 5)] {
        let mut convolver = Convolver::new([2, outputs], block, 48e3, taps, 3e3).unwrap();
        let decay = |i: usize| (-(i as f32) / 500.0).exp() / (taps as f32).sqrt();
        let response =
            |seed| noise(seed, taps).iter().enumerate().map(|(i, x)| x * decay(i)).collect::<Vec<f32>>();
        let responses: Vec<Vec<Vec<f32>>> =
            (0..2).map(|i| (0..outputs).map(|o| response((100 * i + o + 1) as u64)).collect()).collect();
        for (input, responses) in responses.iter().enumerate() {
            let filters = Arc::new(convolver.plan().prepare(responses).unwrap());
            assert!(convolver.turn(input, filters, 1).is_none());
        }
        let samples = 7200usize.next_multiple_of(block);
        let signals = [in_band(3, samples), in_band(4, samples)];
        let heard = run(&mut convolver, block, &signals, outputs);
        let delay = convolver.delay();
        for (output, heard) in heard.iter().enumerate() {
            let parts: Vec<Vec<f64>> =
                (0..2).map(|i| convolved(&signals[i], &responses[i][output])).collect();
            let wanted: Vec<f64> = parts[0].iter().zip(&parts[1]).map(|(a, b)| a + b).collect();
            let largest = wanted.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            let errors = heard[delay..].iter().zip(&wanted).map(|(a, b)| (a - b).abs());
            let error = errors.fold(0.0, f64::max) / largest;
            assert!(error < 1e-4, "block {block}, output {output}: {error}");
        }
    }
}

#[test]
fn every_tap_is_where_it_belongs() {
    let (block, taps, samples) = (16, 150, 1600);
    let signal = in_band(9, samples);
    for tap in 0..taps {
        let mut convolver = Convolver::new([1, 1], block, 48e3, taps, 3e3).unwrap();
        let mut response = vec![0.0; tap + 1];
        response[tap] = 1.0;
        let filters = Arc::new(convolver.plan().prepare(&[response]).unwrap());
        convolver.turn(0, filters, 1);
        let heard = run(&mut convolver, block, std::slice::from_ref(&signal), 1).remove(0);
        let late = &heard[convolver.delay() + tap..];
        assert!(late.iter().zip(&signal).all(|(a, b)| (a - b).abs() < 1e-4), "tap {tap}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20, max_shrink_iters: 50, ..ProptestConfig::default() })]

    /// What enters is shared among the old and the new responses by a line over the fade; each share keeps its own to the end. With
    /// a band up to half the rate nothing is lowered, so plain convolution tells.
    #[test]
    fn filters_turn_without_cutting_off_what_rings(
        seed in 1u64..1000,
        turns in prop::collection::vec((0usize..30, 1u32..6), 1..6),
    ) {
        let (block, taps, blocks) = (16, 150, 50);
        let mut convolver = Convolver::new([1, 1], block, 48e3, taps, 24e3).unwrap();
        prop_assert_eq!((convolver.factor(), convolver.delay()), (1, 0));
        let response = |k: usize| noise(seed + k as u64, taps);
        let signal: Vec<f64> = noise(seed + 99, blocks * block).into_iter().map(f64::from).collect();
        let mut weights = vec![vec![0.0; signal.len()]; turns.len() + 1];
        let (mut now, mut waits) = (0, None);
        let mut turning: Option<(usize, u32, u32)> = None;
        let mut heard = Vec::new();
        for index in 0..blocks {
            for (k, turn) in turns.iter().enumerate().filter(|(_, turn)| turn.0 == index) {
                let filters = Arc::new(convolver.plan().prepare(&[response(k + 1)]).unwrap());
                let overtaken = convolver.turn(0, filters, turn.1).is_some();
                prop_assert_eq!(overtaken, waits.replace((k + 1, turn.1)).is_some());
            }
            turning = turning.or_else(|| waits.take().map(|(to, over)| (to, 0, over)));
            let share = |i: usize, (_, done, over): (usize, u32, u32)| {
                (f64::from(done) + (i + 1) as f64 / block as f64) / f64::from(over)
            };
            for i in 0..block {
                let new = turning.map_or(0.0, |turning| share(i, turning));
                weights[now][index * block + i] += 1.0 - new;
                turning.into_iter().for_each(|(to, ..)| weights[to][index * block + i] += new);
            }
            if let Some((to, done, over)) = turning {
                now = if done + 1 == over { to } else { now };
                turning = (done + 1 < over).then_some((to, done + 1, over));
            }
            let part = signal[index * block..(index + 1) * block].to_vec();
            heard.extend(run(&mut convolver, block, &[part], 1).remove(0));
        }
        let mut wanted = vec![0.0; signal.len()];
        for (k, weights) in weights.iter().enumerate().skip(1) {
            let shared: Vec<f64> = signal.iter().zip(weights).map(|(x, w)| x * w).collect();
            wanted.iter_mut().zip(convolved(&shared, &response(k))).for_each(|(sum, x)| *sum += x);
        }
        for (a, b) in heard.iter().zip(&wanted) {
            prop_assert!((a - b).abs() < 1e-4, "{a} {b}");
        }
    }
}

#[test]
fn what_does_not_fit_is_given_back_or_silent() {
    let mut convolver = Convolver::new([1, 2], 64, 48e3, 100, 3e3).unwrap();
    let plan = convolver.plan().clone();
    assert!(plan.prepare(&[vec![0.0]]).is_err());
    assert!(plan.prepare(&[vec![0.0; 101], vec![]]).is_err());
    assert!(plan.prepare(&[vec![f32::NAN], vec![]]).is_err());
    let other = Convolver::new([1, 2], 64, 48e3, 1000, 3e3).unwrap();
    let filters = Arc::new(other.plan().prepare(&[vec![1.0], vec![]]).unwrap());
    assert!(convolver.turn(0, filters, 1).is_some());
    assert!(convolver.turn(1, Arc::new(plan.prepare(&[vec![1.0], vec![]]).unwrap()), 1).is_some());
    let mut out = [1.0; 128];
    convolver.process(&[0.0; 63], &mut out);
    assert_eq!(out, [0.0; 128]);
}
