//! Where the motion outside is strongest and how much of the surface is outside, how fast the motion is and how long it goes on.

use crate::common;
use crate::small::small;

use common::{Sines, drive, reversed, velocity};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use unripple_core::{ModalResponses, Point, Pole, Responses};
use unripple_field::{Aim, Field, MeasureOptions, measure};

/// The first modes of the small film with other poles, at another rate.
fn retuned(poles: Vec<Pole>, rate: f64) -> ModalResponses {
    let film = small();
    let mut modal = film.modal();
    let numbers = [(1.0, 1.0), (2.0, 1.0)][..poles.len()].to_vec();
    modal.input = modal.input.subcols(0, poles.len()).to_owned();
    modal.poles = poles;
    modal.conditions.rate = rate;
    let (width, height, areal_density) = (film.width, film.height, film.areal_density);
    modal.shapes = Arc::new(Sines { width, height, areal_density, numbers });
    modal
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "found {found}, expected {expected}");
}

/// The sum that defines the velocity, at the place and instant of the worst spot, is as far below the peak as the ratio says; no
/// place outside moves faster, and all places but those of a disc are outside.
#[test]
fn the_worst_spot_is_where_and_when_the_defining_sum_has_it() {
    let film = small();
    let modal = film.modal();
    let responses = film.responses();
    let (at, n) = (Point::new(0.045, 0.042), 180);
    let sent = reversed(&modal, at, n);
    let options = MeasureOptions { cells: 16.0, ..Default::default() };
    let aim = Aim::at(at, n as f64 / film.rate);
    let found = measure(&responses, &sent, &[aim], &options).unwrap();
    let target = &found.targets[0];
    let sum = |place: Point, i: usize| -> f64 {
        let of = |(a, channel): (usize, &Vec<f64>)| {
            (0..=i.min(n)).map(|j| velocity(&modal, a, place, i - j) * channel[j]).sum::<f64>()
        };
        sent.channels().iter().enumerate().map(of).sum::<f64>() / film.rate
    };
    let ([x, y], time) = (target.worst_spot_at_m.unwrap(), target.worst_spot_time_s.unwrap());
    let (place, i) = (Point::new(x, y), (time * film.rate).round() as usize);
    let radius = 4.0 / 3.0 * modal.conditions.lambda_min;
    assert!(place.distance(at) > radius && i <= 2 * n, "{place} at {i}");
    let worst = sum(place, i).abs();
    close(worst * target.worst_spot.unwrap(), sum(at, n).abs(), 1e-5);

    let outside: Vec<Point> = found.maps.points.iter().copied().filter(|p| p.distance(at) > radius).collect();
    let traces =
        Field::new(&responses, &sent, 1.0).unwrap().traces(&outside, 2.0 * target.instant_s).unwrap();
    let most = traces.iter().flat_map(|trace| &trace.velocity).fold(0.0, |m: f64, v| m.max(v.abs()));
    close(most, worst, 1e-5);

    // The disc lies within the sheet: cells of a sixteenth of the wavelength count its area to within half a per cent of the sheet's.
    let disc = PI * radius * radius / (film.width * film.height);
    assert!((found.outside_share - (1.0 - disc)).abs() < 5e-3, "{} {disc}", found.outside_share);
}

/// Two lossless modes struck once: each moves a place as its shape says, and the energies are those of two sines.
#[test]
fn the_share_above_a_kilohertz_is_that_of_the_fast_mode() {
    let (rate, n) = (24e3, 240);
    let modal = retuned(vec![Pole::new(TAU * 400.0, 0.0), Pole::new(TAU * 2000.0, 0.0)], rate);
    let strike = drive(&modal, vec![vec![1.0], vec![0.0], vec![0.0]]);
    let at = Point::new(0.03, 0.03);
    let aim = Aim::at(at, n as f64 / rate);
    let found =
        measure(&Responses::Modal(modal.clone()), &strike, &[aim], &MeasureOptions::default()).unwrap();
    let expected = |place: Point| {
        let mut shape = [0.0; 2];
        modal.shapes.at(place, &mut shape);
        let [slow, fast] = [0, 1].map(|m| (modal.input[(0, m)] * shape[m]).powi(2));
        fast / (slow + fast)
    };
    let target = &found.targets[0];
    let [x, y] = target.worst_spot_at_m.unwrap();
    for (share, place) in
        [(target.share_above_1khz, at), (target.worst_spot_share_above_1khz.unwrap(), Point::new(x, y))]
    {
        let expected = expected(place);
        assert!((share - expected).abs() < 5e-3, "{place}: {share} {expected}");
    }
}

/// A mode driven at its own 250 Hz builds up to half of its last level in about ln 2/60 s, and falls to half of it in as long.
#[test]
fn a_motion_goes_on_as_long_as_it_is_felt_and_without_end_if_it_is_repeated() {
    let rate = 12e3;
    let modal = retuned(vec![Pole::new(TAU * 250.0, 60.0)], rate);
    let responses = Responses::Modal(modal.clone());
    let samples = |seconds: f64| (seconds * rate).round() as usize;
    // A tone with rest after it up to a period, as often as that comes; and how long it is felt.
    let felt = |tone: f64, period: f64, times: usize, repeated: bool| {
        let wave = |i: usize| if i < samples(tone) { (TAU * 250.0 * i as f64 / rate).sin() } else { 0.0 };
        let one: Vec<f64> = (0..samples(period)).map(wave).collect();
        let channel = one.repeat(times);
        let rest = vec![0.0; channel.len()];
        let sent = drive(&modal, vec![channel, rest.clone(), rest]);
        let last = (times - 1) * samples(period) + samples(tone);
        let aim = Aim::at(Point::new(0.05, 0.04), last as f64 / rate);
        let options = MeasureOptions { period: repeated.then_some(period), ..Default::default() };
        measure(&responses, &sent, &[aim], &options).unwrap().targets[0].felt_duration_s
    };
    let long = felt(0.4, 0.45, 1, false).unwrap();
    assert!((0.38..0.42).contains(&long), "{long}");
    let brief = 0.018..0.032;
    let once = felt(0.02, 0.05, 1, false).unwrap();
    assert!(brief.contains(&once), "{once}");
    // Pauses of 30 ms are no end, those of half a second are; and a single period comes once.
    assert_eq!(felt(0.02, 0.05, 12, true), None);
    for (period, times) in [(0.5, 2), (0.05, 1)] {
        let each = felt(0.02, period, times, true).unwrap();
        assert!(brief.contains(&each), "{period}: {each}");
    }
}
