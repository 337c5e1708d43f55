//! What is felt, against closed forms and the sums that define it.

use crate::common;
use crate::small::small;
use unripple_linalg::{Mat, product};

use common::{Film, displacement, drive, reversed};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use std::ops::Range;
use std::sync::Arc;
use unripple_core::{ModalResponses, Point, Pole, Responses, SampledResponses};
use unripple_field::{Aim, Field, MeasureOptions, Measured, TargetFigures, Threshold, measure};

/// One mode of a square film, lossless or not.
fn single(pole: Pole, rate: f64) -> ModalResponses {
    let film = Film { height: 0.10, ..small() };
    let mut modal = film.modal();
    modal.poles = vec![pole];
    modal.conditions.rate = rate;
    modal.input = modal.input.subcols(0, 1).to_owned();
    modal.shapes = Arc::new(common::Sines {
        width: 0.10,
        height: 0.10,
        areal_density: film.areal_density,
        numbers: vec![(1.0, 1.0)],
    });
    modal
}

fn db(ratio: f64) -> f64 {
    20.0 * ratio.log10()
}

fn near(found: Option<f64>, expected: f64, tolerance: f64) {
    let found = found.expect("not silent");
    assert!((found - expected).abs() < tolerance, "found {found} dB, expected {expected} dB");
}

/// The next even size whose prime factors are 2, 3 and 5.
fn transform(least: usize) -> usize {
    let smooth = |mut n: usize| {
        for p in [2, 3, 5] {
            while n.is_multiple_of(p) {
                n /= p;
            }
        }
        n == 1
    };
    (least.max(2)..).find(|n| n.is_multiple_of(2) && smooth(*n)).expect("there is always one")
}

/// A signal filtered by 1/threshold, from the sum that defines a Fourier transform of `size` samples.
struct Slow {
    /// What an impulse at sample 0 becomes.
    kernel: Vec<f64>,
}

impl Slow {
    fn new(threshold: &Threshold, rate: f64, size: usize) -> Self {
        let line = |shift: usize, k: usize| {
            let hz = k.min(size - k) as f64 * rate / size as f64;
            (TAU * ((k * shift) % size) as f64 / size as f64).cos() / (size as f64 * threshold.at(hz))
        };
        Self { kernel: (0..size).map(|shift| (0..size).map(|k| line(shift, k)).sum()).collect() }
    }

    fn weigh(&self, signal: &[f64], span: Range<usize>) -> Vec<f64> {
        let size = self.kernel.len();
        let at = |i: usize| (0..signal.len()).map(|j| self.kernel[(size + i - j) % size] * signal[j]).sum();
        span.map(at).collect()
    }
}

/// All figures of one target from weighed signals over the span, at the target and outside.
fn check(target: &TargetFigures, own: &[f64], outside: &[Vec<f64>], first: usize, rate: f64) {
    let extreme = (0..own.len()).max_by(|a, b| own[*a].abs().total_cmp(&own[*b].abs())).expect("not empty");
    let level = own[extreme].abs();
    let rms = |range: Range<usize>| {
        let squares: f64 = outside.iter().flat_map(|signal| &signal[range.clone()]).map(|w| w * w).sum();
        (squares / (outside.len() * range.len()) as f64).sqrt()
    };
    let worst = outside.iter().flatten().fold(0.0, |m: f64, w| m.max(w.abs()));
    assert!((target.felt_peak_time_s - (first + extreme) as f64 / rate).abs() < 1e-12);
    near(target.felt_level_db, db(level), 1e-6);
    near(target.felt_contrast_db, db(level / rms(extreme..extreme + 1)), 2e-3);
    near(target.felt_background_db, db(level / rms(0..own.len())), 2e-3);
    near(target.felt_worst_spot_db, db(level / worst), 2e-3);
}

fn far(found: &Measured, aims: &[Point]) -> Vec<Point> {
    let outside = |p: &&Point| aims.iter().all(|at| at.distance(**p) > found.focal_radius_m);
    found.maps.points.iter().filter(outside).copied().collect()
}

/// Displacements of places up to and with a sample.
fn moved(responses: &Responses, sent: &unripple_core::Drive, places: &[Point], last: usize) -> Vec<Vec<f64>> {
    let field = Field::new(responses, sent, 8.0).unwrap();
    let traces = field.traces(places, last as f64 / sent.rate()).unwrap();
    traces.into_iter().map(|trace| trace.displacement).collect()
}

#[test]
fn figures_of_a_pulse_are_those_of_the_definition() {
    let film = small();
    let modal = film.modal();
    let responses = film.responses();
    let places = [Point::new(0.030, 0.042), Point::new(0.075, 0.050)];
    let instants = [150, 90];
    let mut sum = reversed(&modal, places[0], 150).channels().to_vec();
    for (to, from) in sum.iter_mut().zip(reversed(&modal, places[1], 90).channels()) {
        to.iter_mut().zip(from).for_each(|(to, from)| *to += 0.7 * from);
    }
    let sent = drive(&modal, sum);
    let aims = [0, 1].map(|i| Aim::at(places[i], instants[i] as f64 / film.rate));
    let threshold = Threshold::new(vec![[100.0, 1e-6], [300.0, 0.2e-6], [900.0, 4e-6]]).unwrap();
    for threshold in [Threshold::default(), threshold] {
        let options = MeasureOptions { threshold: threshold.clone(), ..Default::default() };
        let found = measure(&responses, &sent, &aims, &options).unwrap();
        let outside = far(&found, &places);
        let mut loudest: f64 = 0.0;
        for i in 0..2 {
            let n = instants[i];
            let slow = Slow::new(&threshold, film.rate, transform(4 * n + 1));
            let weigh = |signal: &Vec<f64>| slow.weigh(signal, 0..2 * n + 1);
            let own = weigh(&moved(&responses, &sent, &places[i..=i], 3 * n)[0]);
            let around: Vec<Vec<f64>> = moved(&responses, &sent, &outside, 3 * n).iter().map(weigh).collect();
            check(&found.targets[i], &own, &around, 0, film.rate);
            loudest = around.iter().flatten().fold(loudest, |m, w| m.max(w.abs()));
        }
        near(found.felt_outside_db, db(loudest), 2e-3);
        let peaks = found.maps.felt_peak.iter().zip(&found.maps.outside).filter(|(_, out)| **out);
        let most = peaks.fold(0.0, |m: f64, (peak, _)| m.max(f64::from(*peak)));
        near(Some(db(most)), db(loudest), 2e-3);
        assert_eq!(found.maps.felt_peak.len(), found.maps.points.len());
    }
}

#[test]
fn figures_of_a_repeated_drive_are_those_of_its_last_period_for_ever() {
    let film = small();
    let modal = film.modal();
    let responses = film.responses();
    let (at, period) = (Point::new(0.033, 0.044), 151);
    let one = reversed(&modal, at, period - 1);
    let sent = drive(&modal, one.channels().iter().map(|channel| channel.repeat(12)).collect());
    let first = 11 * period;
    let aim = Aim::at(at, (first + 20) as f64 / film.rate);
    let options = MeasureOptions { period: Some(period as f64 / film.rate), ..Default::default() };
    let found = measure(&responses, &sent, &[aim], &options).unwrap();
    let slow = Slow::new(&Threshold::default(), film.rate, period);
    let last = |places: &[Point]| -> Vec<Vec<f64>> {
        let whole = moved(&responses, &sent, places, 12 * period - 1);
        whole.iter().map(|signal| slow.weigh(&signal[first..], 0..period)).collect()
    };
    check(&found.targets[0], &last(&[at])[0], &last(&far(&found, &[at])), first, film.rate);
}

/// A mode that is made to swing as one sine at 250 Hz for ever, 1 µm high at its middle, is 20 dB above threshold.
#[test]
fn a_steady_sine_has_its_level() {
    let rate = 48e3;
    let (omega, sigma) = (TAU * 180.0, 60.0);
    let modal = single(Pole::new(omega, sigma), rate);
    let centre = Point::new(0.05, 0.05);
    // Long enough for what was there at first to be gone: 0.6 s of e^{−60 t}.
    let (period, periods, hz) = (192, 150, 250.0);
    let tone: Vec<f64> = (0..period * periods).map(|i| (TAU * hz * i as f64 / rate).sin()).collect();
    let unit = drive(&modal, vec![tone.clone(), vec![0.0; tone.len()], vec![0.0; tone.len()]]);
    let responses = Responses::Modal(modal.clone());
    let options = MeasureOptions { period: Some(period as f64 / rate), ..Default::default() };
    let aim = Aim::at(centre, 149.5 * period as f64 / rate);
    let moved = |sent| measure(&responses, sent, std::slice::from_ref(&aim), &options).unwrap();
    let largest = moved(&unit).targets[0].peak_displacement_m.abs();
    let found = moved(&unit.clone().scaled(1e-6 / largest));
    let target = &found.targets[0];
    near(target.felt_level_db, 20.0, 0.01);
    // Every place swings as its shape says: the ratios are those of the shape, the worst at the disc's rim.
    let shape = |p: &Point| (PI * p.x / 0.1).sin() * (PI * p.y / 0.1).sin();
    let outside = far(&found, &[centre]);
    let rms = (outside.iter().map(|p| shape(p).powi(2)).sum::<f64>() / outside.len() as f64).sqrt();
    near(target.felt_contrast_db, -db(rms), 1e-4);
    near(target.felt_background_db, -db(rms / 2f64.sqrt()), 1e-3);
    let worst = outside.iter().map(shape).fold(0.0, f64::max);
    near(target.felt_worst_spot_db, -db(worst), 1e-4);
    near(found.felt_outside_db, 20.0 + db(worst), 0.01);
}

/// A decaying mode struck once: its spectrum is the sum of a geometric series, line by line.
#[test]
fn a_struck_mode_by_hand() {
    let rate = 12e3;
    let (omega, sigma, n) = (TAU * 210.0, 90.0, 240);
    let modal = single(Pole::new(omega, sigma), rate);
    let at = Point::new(0.03, 0.06);
    let strike = drive(&modal, vec![vec![2e-3], vec![0.0], vec![0.0]]);
    let aim = Aim::at(at, n as f64 / rate);
    let found =
        measure(&Responses::Modal(modal.clone()), &strike, &[aim], &MeasureOptions::default()).unwrap();
    let size = transform(4 * n + 1);
    let damped = (omega * omega - sigma * sigma).sqrt();
    let mut shape = [0.0];
    modal.shapes.at(at, &mut shape);
    let height = 2e-3 / rate * modal.input[(0, 0)] * shape[0] / damped;
    // Σ e^{(λ − jω_k) i / rate} over i = 0 … 3n, of which the sine is the imaginary part for real signals.
    let series = |angle: f64| -> [f64; 2] {
        let power = |count: f64| {
            let size = (-sigma * count / rate).exp();
            [size * (angle * count).cos(), size * (angle * count).sin()]
        };
        let ([a, b], [c, d]) = (power((3 * n + 1) as f64), power(1.0));
        let ([a, b], [c, d]) = ([1.0 - a, -b], [1.0 - c, -d]);
        let square = c * c + d * d;
        [(a * c + b * d) / square, (b * c - a * d) / square]
    };
    let lines: Vec<[f64; 2]> = (0..size)
        .map(|k| {
            let turn = TAU * k as f64 / size as f64;
            let (plus, minus) = (series(damped / rate - turn), series(-damped / rate - turn));
            let hz = k.min(size - k) as f64 * rate / size as f64;
            let gain = height / Threshold::default().at(hz) / size as f64;
            // (S₊ − S₋) / 2j
            [gain * (plus[1] - minus[1]) / 2.0, -gain * (plus[0] - minus[0]) / 2.0]
        })
        .collect();
    let felt = |i: usize| -> f64 {
        let value = |(k, [re, im]): (usize, &[f64; 2])| {
            let turn = TAU * ((k * i) % size) as f64 / size as f64;
            re * turn.cos() - im * turn.sin()
        };
        lines.iter().enumerate().map(value).sum()
    };
    let level = (0..=2 * n).map(|i| felt(i).abs()).fold(0.0, f64::max);
    near(found.targets[0].felt_level_db, db(level), 1e-6);
}

fn library(modal: &ModalResponses, points: Vec<Point>, samples: usize) -> Responses {
    let mut data = Vec::new();
    let weights = modal.shapes.at_all(&points);
    let ringing = Mat::from_fn(modal.poles.len(), samples, |m, i| {
        modal.poles[m].velocity(i as f64 / modal.conditions.rate)
    });
    for p in 0..points.len() {
        let rows =
            Mat::from_fn(modal.ports.len(), modal.poles.len(), |a, m| weights[(p, m)] * modal.input[(a, m)]);
        let rows = product(rows.as_ref(), ringing.as_ref());
        (0..rows.nrows()).for_each(|a| data.extend((0..samples).map(|i| rows[(a, i)] as f32)));
    }
    Responses::Sampled(
        SampledResponses::new(modal.ports.clone(), points, modal.conditions.clone(), samples, data).unwrap(),
    )
}

#[test]
fn a_library_is_felt_as_its_surface_is() {
    let film = small();
    let modal = film.modal();
    let n = 150;
    let aim = |at| Aim::at(at, n as f64 / film.rate);
    let options = MeasureOptions { cells: 4.0, ..Default::default() };
    let bare = measure(&film.responses(), &drive(&modal, vec![vec![1.0]; 3]), &[], &options).unwrap();
    let points = bare.maps.points;
    let at = points[points.len() / 2 + 5];
    let sent = reversed(&modal, at, n);
    let exact = measure(&film.responses(), &sent, &[aim(at)], &options).unwrap();
    let stored = measure(&library(&modal, points.clone(), 3 * n + 1), &sent, &[aim(at)], &options).unwrap();
    for (found, expected) in four(&stored.targets[0]).into_iter().zip(four(&exact.targets[0])) {
        near(found, expected.unwrap(), 0.01);
    }
    // Responses that end at 2T are at rest after that, which is hardly felt before.
    let short = measure(&library(&modal, points, 2 * n + 1), &sent, &[aim(at)], &options).unwrap();
    near(short.targets[0].felt_level_db, exact.targets[0].felt_level_db.unwrap(), 0.1);
    near(short.targets[0].felt_background_db, exact.targets[0].felt_background_db.unwrap(), 0.5);
}

fn four(target: &TargetFigures) -> [Option<f64>; 4] {
    [target.felt_level_db, target.felt_contrast_db, target.felt_background_db, target.felt_worst_spot_db]
}

#[test]
fn sets_of_points_are_felt_by_their_mean() {
    let film = small();
    let modal = film.modal();
    let places = vec![Point::new(0.03, 0.042), Point::new(0.034, 0.042), Point::new(0.06, 0.05)];
    let sent = reversed(&modal, places[0], 120);
    let responses = film.responses();
    let set = Aim { points: places.clone(), instant: 120.0 / film.rate };
    let found = measure(&responses, &sent, &[set], &MeasureOptions::default()).unwrap();
    let each = moved(&responses, &sent, &places, 360);
    let mean: Vec<f64> = (0..361).map(|i| each.iter().map(|u| u[i]).sum::<f64>() / 3.0).collect();
    let felt = Slow::new(&Threshold::default(), film.rate, transform(481)).weigh(&mean, 0..241);
    near(found.targets[0].felt_level_db, db(felt.iter().fold(0.0, |m: f64, w| m.max(w.abs()))), 1e-6);
}

#[test]
fn silence_is_not_felt_and_the_first_sample_is_an_instant() {
    let film = small();
    let modal = film.modal();
    let at = Point::new(0.05, 0.05);
    let silent = drive(&modal, vec![vec![0.0; 10]; 3]);
    let options = MeasureOptions::default();
    let found = measure(&film.responses(), &silent, &[Aim::at(at, 1e-3)], &options).unwrap();
    assert_eq!((four(&found.targets[0]), found.felt_outside_db), ([None; 4], None));
    assert!(found.maps.felt_peak.iter().all(|w| *w == 0.0));
    // A blow is felt from its own sample on, but an impulse moves nothing at once.
    let strike = drive(&modal, vec![vec![1.0]; 3]);
    let found = measure(&film.responses(), &strike, &[Aim::at(at, 0.0)], &options).unwrap();
    assert_eq!(four(&found.targets[0]), [None; 4]);
    assert_eq!(displacement(&modal, 0, at, 0), 0.0);
    // Nothing is outside a surface smaller than a focal disc, and yet it is felt.
    let mut tiny = modal;
    tiny.conditions.lambda_min = 1.0;
    let sent = drive(&tiny, vec![vec![1.0; 30]; 3]);
    let found = measure(&Responses::Modal(tiny), &sent, &[Aim::at(at, 2e-3)], &options).unwrap();
    assert!(found.targets[0].felt_level_db.is_some());
    assert_eq!((&four(&found.targets[0])[1..], found.felt_outside_db), (&[None; 3][..], None));
}

/// A film up to 6 kHz driven below 1 kHz: modes that nobody feels are left out, and nothing is off by more than promised.
#[test]
fn modes_left_out_are_not_missed() {
    let film = Film { top_hz: 6000.0, rate: 24e3, ..small() };
    let modal = film.modal();
    let n = 120;
    let slow: Vec<f64> = (0..=n).map(|i| (PI * f64::from(i) / f64::from(n)).sin().powi(4)).collect();
    let n = slow.len() - 1;
    let sent = drive(&modal, vec![slow.clone(), slow.iter().map(|d| -0.3 * d).collect(), slow]);
    let at = Point::new(0.042, 0.033);
    let options = MeasureOptions { cells: 2.0, ..Default::default() };
    let found = measure(&film.responses(), &sent, &[Aim::at(at, n as f64 / film.rate)], &options).unwrap();
    let direct = Slow::new(&Threshold::default(), film.rate, transform(4 * n + 1));
    let level = 10f64.powf(found.targets[0].felt_level_db.unwrap() / 20.0);
    for (displacement, peak) in
        moved(&film.responses(), &sent, &found.maps.points, 3 * n).iter().zip(&found.maps.felt_peak)
    {
        let exact = direct.weigh(displacement, 0..2 * n + 1).iter().fold(0.0, |m: f64, w| m.max(w.abs()));
        assert!((f64::from(*peak) - exact).abs() < 1.05e-4 * level, "{peak} {exact} of {level}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn louder_drives_are_felt_louder_alike_everywhere(
        channels in prop::collection::vec(prop::collection::vec(-1.0..1.0_f64, 40), 3),
        at in (0.01..0.09_f64, 0.01..0.07_f64), factor in 1e-6..1e6_f64, shift in -12.0..12.0_f64,
    ) {
        let film = small();
        let modal = film.modal();
        let responses = film.responses();
        let aim = Aim::at(Point::new(at.0, at.1), 39.0 / film.rate);
        let figures = |channels, threshold| {
            let options = MeasureOptions { cells: 4.0, threshold, ..Default::default() };
            measure(&responses, &drive(&modal, channels), std::slice::from_ref(&aim), &options).unwrap()
        };
        let louder = channels.iter().map(|channel| channel.iter().map(|d| -factor * d).collect()).collect();
        let a = figures(channels.clone(), Threshold::default());
        let b = figures(louder, Threshold::default());
        let gain = db(factor);
        let same = |a: Option<f64>, b: Option<f64>, gain: f64| (a.unwrap() + gain - b.unwrap()).abs() < 1e-3;
        prop_assert!(same(a.targets[0].felt_level_db, b.targets[0].felt_level_db, gain));
        prop_assert!(same(a.felt_outside_db, b.felt_outside_db, gain));
        prop_assert_eq!(a.targets[0].felt_peak_time_s, b.targets[0].felt_peak_time_s);
        for (a, b) in four(&a.targets[0]).into_iter().zip(four(&b.targets[0])).skip(1) {
            prop_assert!(same(a, b, 0.0));
        }
        // A finger less fine by so many dB feels that much less, and the same ratios.
        let coarse = 10f64.powf(shift / 20.0);
        let knots = Threshold::default().knots().iter().map(|[hz, u]| [*hz, u * coarse]).collect();
        let c = figures(channels, Threshold::new(knots).unwrap());
        for (i, (a, c)) in four(&a.targets[0]).into_iter().zip(four(&c.targets[0])).enumerate() {
            prop_assert!(same(a, c, if i == 0 { -shift } else { 0.0 }), "{} {:?} {:?}", i, a, c);
        }
    }
}
