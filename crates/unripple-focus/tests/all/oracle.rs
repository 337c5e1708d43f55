//! Drives against the equations that define them.

use crate::common;

use common::{Membrane, responses_at, velocity};
use unripple_core::{ModalResponses, Point, Pole, Responses, SampledResponses};
use unripple_focus::{FocusError, Focused, LossCorrection, Method, Options, Pattern, Target, focus};

const N: usize = 180;

fn options() -> Options {
    Options { window: 0.015, accuracy: 1e-10, ..Options::default() }
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "found {found}, expected {expected}");
}

/// Compares a drive with one computed otherwise, up to the scale that brings the latter's peak to `limit`.
fn same(focused: &Focused, expected: &[Vec<f64>], limit: f64) {
    let peak = expected.iter().flatten().fold(0.0, |m: f64, d| m.max(d.abs()));
    for (found, expected) in focused.drive.channels().iter().zip(expected) {
        assert_eq!(found.len(), expected.len());
        for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
            assert!(
                (found - expected / peak * limit).abs() < 1e-7 * limit,
                "sample {i}: {found} {}",
                expected / peak
            );
        }
    }
}

fn library(modal: &ModalResponses, points: &[Point], samples: usize) -> SampledResponses {
    let data =
        points.iter().flat_map(|at| responses_at(modal, *at, samples).concat()).map(|h| h as f32).collect();
    SampledResponses::new(modal.ports.clone(), points.to_vec(), modal.conditions.clone(), samples, data)
        .unwrap()
}

#[test]
fn time_reversal_is_the_reversed_response_at_the_limit() {
    let membrane = Membrane::small();
    let modal = membrane.modal();
    let at = Point::new(0.033, 0.044);
    let focused =
        focus(&membrane.responses(), &[Target::at(at)], &Options { limit: 2.5, ..options() }).unwrap();
    let expected: Vec<Vec<f64>> =
        responses_at(&modal, at, N + 1).iter().map(|h| h.iter().rev().copied().collect()).collect();
    same(&focused, &expected, 2.5);
    assert_eq!(focused.drive.peak(), 2.5);
    assert_eq!((focused.timing[0].instant, focused.timing[0].period), (N, None));
    assert_eq!(focused.drive.names(), ["a1", "a2", "a3"]);
    assert_eq!(focused.points, [[at]]);
    // Hudin et al. 2012, eq. 2: the focus is the energy of the responses, here times the scale of the drive.
    let energy: f64 = expected.iter().flatten().map(|h| h * h).sum::<f64>() / membrane.rate;
    let peak = expected.iter().flatten().fold(0.0, |m: f64, h| m.max(h.abs()));
    close(velocity(&modal, &focused.drive, at, N), energy * 2.5 / peak, 1e-7);
}

#[test]
fn drives_are_as_accurate_as_was_asked_for() {
    let membrane = Membrane::small();
    let modal = membrane.modal();
    let at = Point::new(0.033, 0.044);
    let exact: Vec<f64> = responses_at(&modal, at, N + 1).concat();
    let peak = exact.iter().fold(0.0, |m: f64, h| m.max(h.abs()));
    let mut row = vec![0.0; modal.poles.len()];
    modal.shapes.at(at, &mut row);
    let magnitudes =
        (0..3).map(|a| row.iter().enumerate().map(|(m, w)| (w * modal.input[(a, m)]).abs()).sum::<f64>());
    let magnitude = magnitudes.fold(0.0, f64::max);
    for accuracy in [1e-3, 1e-5, 1e-6, 1e-8, 1e-12] {
        let options = Options { accuracy, ..options() };
        let drive = focus(&membrane.responses(), &[Target::at(at)], &options).unwrap().drive;
        for (a, channel) in drive.channels().iter().enumerate() {
            for (d, h) in channel.iter().rev().zip(&exact[a * (N + 1)..]) {
                // Twice: once for the sample and once for the peak it is scaled by.
                assert!((d * peak - h).abs() < 2.0 * accuracy * magnitude, "{accuracy}: {} {h}", d * peak);
            }
        }
    }
}

#[test]
fn targets_are_weighted_by_gain_before_they_are_summed() {
    let membrane = Membrane::small();
    let modal = membrane.modal();
    let places = [Point::new(0.033, 0.044), Point::new(0.07, 0.02), Point::new(0.05, 0.06)];
    let gains = [1.0, -0.4, 2.0];
    let targets: Vec<Target> = places.iter().zip(gains).map(|(at, g)| Target::at(*at).with_gain(g)).collect();
    let mut expected = vec![vec![0.0; N + 1]; 3];
    for (at, gain) in places.iter().zip(gains) {
        for (to, h) in expected.iter_mut().zip(responses_at(&modal, *at, N + 1)) {
            to.iter_mut().zip(h.iter().rev()).for_each(|(d, h)| *d += gain * h);
        }
    }
    same(&focus(&membrane.responses(), &targets, &options()).unwrap(), &expected, 1.0);
}

#[test]
fn one_bit_is_the_sign_of_time_reversal() {
    let membrane = Membrane::small();
    let targets = [Target::at(Point::new(0.033, 0.044))];
    let soft = focus(&membrane.responses(), &targets, &options()).unwrap();
    let hard = Options { method: Method::OneBit, limit: 0.7, ..options() };
    let hard = focus(&membrane.responses(), &targets, &hard).unwrap();
    for (soft, hard) in soft.drive.channels().iter().flatten().zip(hard.drive.channels().iter().flatten()) {
        assert_eq!(*hard, if *soft == 0.0 { 0.0 } else { 0.7 * soft.signum() });
    }
    // Among all drives within the limit none reaches a higher velocity: it is Σ|h| · limit / rate.
    let modal = membrane.modal();
    let ceiling: f64 =
        responses_at(&modal, targets[0].points[0], N + 1).concat().iter().map(|h| h.abs()).sum();
    close(velocity(&modal, &hard.drive, targets[0].points[0], N), 0.7 * ceiling / membrane.rate, 1e-9);
}

#[test]
fn a_set_of_points_has_the_mean_level_of_its_points() {
    let membrane = Membrane::small();
    let modal = membrane.modal();
    let disc = Pattern::circle(Point::new(0.04, 0.045), 0.012).filled();
    let set = disc.sample(Pattern::pitch(modal.conditions.lambda_min)).unwrap();
    let lone = Point::new(0.085, 0.02);
    let pair = [Target::of(set.clone()).with_gain(2.0), Target::at(lone).with_gain(1.0)];
    let focused = focus(&membrane.responses(), &pair, &options()).unwrap();
    // Undo the common scale through one sample, then split the drive into the two targets by linearity.
    let alone = |target: Target| focus(&membrane.responses(), &[target], &options()).unwrap().drive;
    let (a, b) = (alone(Target::of(set.clone())), alone(Target::at(lone)));
    let dot = |x: &unripple_core::Drive, y: &unripple_core::Drive| -> f64 {
        x.channels().iter().flatten().zip(y.channels().iter().flatten()).map(|(x, y)| x * y).sum()
    };
    let (aa, ab, bb) = (dot(&a, &a), dot(&a, &b), dot(&b, &b));
    let (ad, bd) = (dot(&a, &focused.drive), dot(&b, &focused.drive));
    let determinant = aa * bb - ab * ab;
    let (weight_a, weight_b) = ((ad * bb - bd * ab) / determinant, (bd * aa - ad * ab) / determinant);
    let level = |drive: &unripple_core::Drive, points: &[Point]| {
        points.iter().map(|p| velocity(&modal, drive, *p, N)).sum::<f64>() / points.len() as f64
    };
    let energy = |p: &Point| responses_at(&modal, *p, N + 1).concat().iter().map(|h| h * h).sum::<f64>();
    let mean_energy = set.iter().map(energy).sum::<f64>() / set.len() as f64;
    let ratio = weight_a * level(&a, &set) / (weight_b * level(&b, &[lone]));
    close(ratio, 2.0 * mean_energy / energy(&lone), 1e-6);
    assert!(set.len() > 8, "{}", set.len());
}

#[test]
fn losses_are_undone_uniformly_or_mode_by_mode() {
    let membrane = Membrane::small();
    let target = [Target::at(Point::new(0.033, 0.044))];
    let lossless = Membrane { decay_time: f64::INFINITY, ..membrane.clone() }.modal();
    let corrected = |loss| focus(&membrane.responses(), &target, &Options { loss, ..options() }).unwrap();
    let [uniform, per_mode] =
        [LossCorrection::Uniform(membrane.decay_time), LossCorrection::PerMode].map(corrected);
    // With one decay time for all modes the two are the same, and close to time reversal without losses: what is left
    // is the shift of ω_d and the σ/ω part of the velocity.
    for (a, b) in uniform.drive.channels().concat().iter().zip(per_mode.drive.channels().concat()) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
    let ideal: Vec<Vec<f64>> = responses_at(&lossless, target[0].points[0], N + 1);
    let reversed = ideal.iter().map(|h| h.iter().rev());
    let (mut dot, mut own, mut other) = (0.0, 0.0, 0.0);
    for (d, h) in uniform.drive.channels().iter().flatten().zip(reversed.flatten()) {
        (dot, own, other) = (dot + d * h, own + d * d, other + h * h);
    }
    assert!(dot / (own * other).sqrt() > 0.995, "{}", dot / (own * other).sqrt());
    // Left alone, the oldest tenth of the window is weaker by e^{-t/τ}.
    let plain = corrected(LossCorrection::None);
    let share = |focused: &Focused| {
        let energy =
            |end: usize| focused.drive.channels().iter().flat_map(|c| &c[..end]).map(|d| d * d).sum::<f64>();
        energy(N / 10) / energy(N + 1)
    };
    assert!(share(&uniform) > 1.5 * share(&plain), "{} {}", share(&uniform), share(&plain));
}

#[test]
fn very_lossy_modes_stay_finite() {
    let mut modal = Membrane::small().modal();
    modal.poles.iter_mut().for_each(|pole| pole.sigma = 0.999 * pole.omega);
    modal.poles[0].sigma = 50.0 * modal.poles[0].omega;
    let options = Options { loss: LossCorrection::PerMode, window: 1.0, ..options() };
    let focused = focus(&Responses::Modal(modal), &[Target::at(Point::new(0.033, 0.044))], &options).unwrap();
    assert_eq!(focused.drive.peak(), 1.0);
}

#[test]
fn repetition_is_a_comb_that_has_become_steady() {
    let membrane = Membrane::small();
    let modal = membrane.modal();
    let (fast, slow) = (Point::new(0.033, 0.044), Point::new(0.07, 0.02));
    let targets = [Target::at(fast).repeated(100.0), Target::at(slow).repeated(40.0).with_gain(0.5)];
    let focused = focus(&membrane.responses(), &targets, &options()).unwrap();
    let period = focused.period.unwrap();
    assert_eq!(period, 600);
    assert_eq!(focused.timing.iter().map(|t| t.period).collect::<Vec<_>>(), [Some(120), Some(300)]);
    let length = focused.drive.samples();
    let mut expected = vec![vec![0.0; length]; 3];
    for (at, step, gain) in [(fast, 120, 1.0), (slow, 300, 0.5)] {
        let h = responses_at(&modal, at, N + 1);
        for focus in (N..length + N).step_by(step) {
            for (to, h) in expected.iter_mut().zip(&h) {
                (0..=N).filter(|k| focus - k < length).for_each(|k| to[focus - k] += gain * h[k]);
            }
        }
    }
    same(&focused, &expected, 1.0);
    // Periodic from the window on, and the field, too, by the start of the last full period.
    for channel in focused.drive.channels() {
        assert!((N..length - period).all(|i| (channel[i] - channel[i + period]).abs() < 1e-12));
    }
    let sent = &focused.drive;
    for timing in &focused.timing {
        assert!((length - period..length).contains(&timing.instant));
        let (before, now) = (
            velocity(&modal, sent, fast, timing.instant - period),
            velocity(&modal, sent, fast, timing.instant),
        );
        close(before, now, 2e-3);
    }
}

#[test]
fn the_rms_limit_scales_the_whole_drive() {
    let membrane = Membrane::small();
    let target = [Target::at(Point::new(0.033, 0.044))];
    let free = focus(&membrane.responses(), &target, &options()).unwrap().drive;
    let rms = |channel: &Vec<f64>| (channel.iter().map(|d| d * d).sum::<f64>() / channel.len() as f64).sqrt();
    let loudest = free.channels().iter().map(rms).fold(0.0, f64::max);
    let held = Options { rms_limit: Some(loudest / 3.0), ..options() };
    let held = focus(&membrane.responses(), &target, &held).unwrap().drive;
    close(held.channels().iter().map(rms).fold(0.0, f64::max), loudest / 3.0, 1e-12);
    for (free, held) in free.channels().iter().flatten().zip(held.channels().iter().flatten()) {
        assert!((free - 3.0 * held).abs() < 1e-12);
    }
    let loose = Options { rms_limit: Some(loudest * 1.01), ..options() };
    assert_eq!(focus(&membrane.responses(), &target, &loose).unwrap().drive, free);
}

#[test]
fn a_library_gives_the_drive_of_its_nearest_point() {
    let membrane = Membrane::small();
    let modal = membrane.modal();
    let known = [Point::new(0.033, 0.044), Point::new(0.07, 0.02)];
    let stored = Responses::Sampled(library(&modal, &known, N + 30));
    let asked = [Target::at(Point::new(0.035, 0.044)), Target::at(known[1]).with_gain(0.3)];
    let found = focus(&stored, &asked, &options()).unwrap();
    assert_eq!(found.points, [[known[0]], [known[1]]]);
    let exact = [Target::at(known[0]), Target::at(known[1]).with_gain(0.3)];
    let exact = focus(&membrane.responses(), &exact, &options()).unwrap();
    for (a, b) in found.drive.channels().iter().flatten().zip(exact.drive.channels().iter().flatten()) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
    let far = focus(&stored, &[Target::at(Point::new(0.05, 0.044))], &options()).unwrap_err();
    assert!(far.to_string().contains("nearest legal point (33.0000, 44.0000) mm"), "{far}");
    let long = Options { window: 0.02, ..options() };
    let long = focus(&stored, &asked, &long).unwrap_err();
    assert_eq!(
        long.to_string(),
        "samples of the window: expected at most 210, the length of the responses, found 241"
    );
    let per_mode = Options { loss: LossCorrection::PerMode, ..options() };
    assert_eq!(
        focus(&stored, &asked, &per_mode),
        Err(FocusError::NeedsModes("loss correction per mode (uniform correction needs none)"))
    );
}

#[test]
fn a_single_mode_by_hand() {
    let mut modal = Membrane::small().modal();
    modal.poles.iter_mut().for_each(|pole| *pole = Pole::new(0.0, 100.0));
    let focused =
        focus(&Responses::Modal(modal), &[Target::at(Point::new(0.033, 0.044))], &options()).unwrap();
    // Every response is a multiple of e^{-2σt}: 2σu̇ without stiffness.
    let loudest = focused.drive.channels().iter().find(|c| c[N].abs() == 1.0).unwrap();
    for (i, d) in loudest.iter().enumerate() {
        close(d.abs(), (-200.0 * (N - i) as f64 / 12e3).exp(), 1e-6);
    }
}

#[test]
fn refuses_what_cannot_be_done() {
    let membrane = Membrane::small();
    let responses = membrane.responses();
    let good = [Target::at(Point::new(0.033, 0.044))];
    let refused = |options: &Options| focus(&responses, &good, options).unwrap_err().to_string();
    assert!(
        refused(&Options { window: 1e-5, ..options() }).contains("expected at least 1 (0.0833 ms), found 0")
    );
    for window in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        assert!(
            refused(&Options { window, ..options() }).starts_with("window (s): expected a positive number")
        );
    }
    assert!(refused(&Options { window: 1e6, ..options() }).contains("expected at most 16666665"));
    assert!(refused(&Options { limit: 0.0, ..options() }).starts_with("limit"));
    assert!(refused(&Options { rms_limit: Some(f64::NAN), ..options() }).starts_with("rms limit"));
    assert!(
        refused(&Options { duration: Some(0.001), ..options() })
            .starts_with("duration (s): expected at least")
    );
    assert!(refused(&Options { loss: LossCorrection::Uniform(0.0), ..options() }).contains("decay time"));
    let edge = [Target::at(Point::new(0.0, 0.04))];
    assert!(matches!(focus(&responses, &edge, &options()), Err(FocusError::Still { target: 0, .. })));
    let rim = [good[0].clone(), Target::at(Point::new(0.10, 0.04))];
    assert!(matches!(focus(&responses, &rim, &options()), Err(FocusError::Still { target: 1, .. })));
    let unknown = "one-bits".parse::<Method>().unwrap_err();
    assert_eq!(
        unknown.to_string(),
        "no method `one-bits`: expected one of `time-reversal`, `one-bit`, `inverse`, `concentrate`, `limited`, `robust`, `felt`"
    );
    assert_eq!("one-bit".parse(), Ok(Method::OneBit));
}

/// What would take gigabytes is refused before any of it is allocated.
#[test]
fn tables_that_no_memory_holds_are_refused() {
    let membrane = Membrane::small();
    let responses = membrane.responses();
    let at = Point::new(0.033, 0.044);
    let refused = |responses: &Responses, target: Target, options: &Options| {
        focus(responses, &[target], options).unwrap_err().to_string()
    };
    let concentrate = Options { method: Method::Concentrate, ..options() };
    let long = Options { window: 1200.0, ..concentrate.clone() };
    let found = refused(&responses, Target::at(at), &long);
    assert!(
        found.starts_with("samples of the window times modes: expected at most 268435456, found"),
        "{found}"
    );
    let found = refused(&responses, Target::at(at).repeated(1.5e-3), &concentrate);
    assert!(
        found.starts_with("samples of the period times modes: expected at most 268435456, found"),
        "{found}"
    );
    let found = refused(&responses, Target::of(vec![at; 8193]), &concentrate);
    assert_eq!(
        found,
        "points over all targets: expected at most 8192 for a drive that is optimised, found 8193"
    );
    let alone = Membrane { ports: membrane.ports[..1].to_vec(), ..membrane }.responses();
    let felt = Options { method: Method::Felt, window: 2.6, ..options() };
    let found = refused(&alone, Target::at(at), &felt);
    assert!(found.starts_with("values of the plan: expected at most 134217728, found"), "{found}");
}
