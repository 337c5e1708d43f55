//! Fields and figures against closed forms, the defining sums, and another kind of responses.

use crate::common;
use crate::small::small;
use unripple_linalg::{Mat, product};

use common::{Film, displacement, drive, reversed, velocity};
use std::f64::consts::PI;
use std::ops::Range;
use unripple_core::{ModalResponses, Point, Pole, Responses, SampledResponses};
use unripple_field::{Aim, Field, Grid, MeasureOptions, TakenOn, Trace, measure};

/// Numbers between −1 and 1 without order, the same on every run.
fn noise(count: usize, seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state as f64 / u64::MAX as f64 * 2.0 - 1.0
    };
    (0..count).map(|_| next()).collect()
}

fn library(modal: &ModalResponses, points: Vec<Point>, samples: usize) -> Responses {
    let ringing = Mat::from_fn(modal.poles.len(), samples, |m, i| {
        modal.poles[m].velocity(i as f64 / modal.conditions.rate)
    });
    let weights = modal.shapes.at_all(&points);
    let ports = modal.ports.len();
    let rows = Mat::from_fn(points.len() * ports, ringing.nrows(), |row, m| {
        weights[(row / ports, m)] * modal.input[(row % ports, m)]
    });
    let rows = product(rows.as_ref(), ringing.as_ref());
    let data = (0..rows.nrows() * samples).map(|i| rows[(i / samples, i % samples)] as f32).collect();
    Responses::Sampled(
        SampledResponses::new(modal.ports.clone(), points, modal.conditions.clone(), samples, data).unwrap(),
    )
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "found {found}, expected {expected}");
}

#[test]
fn the_focus_of_time_reversal_is_the_energy_of_the_responses() {
    let film = Film::paper();
    let modal = film.modal();
    assert_eq!(modal.poles.len(), 318, "exact count of the supported film below 3 kHz");
    let at = Point::from_mm(62.0, 90.0);
    let n = 1440;
    let sent = reversed(&modal, at, n);
    let energy: f64 = sent.channels().iter().flatten().map(|h| h * h).sum::<f64>() / film.rate;
    let found = measure(&film.responses(), &sent, &[Aim::at(at, 0.030)], &MeasureOptions::default()).unwrap();
    let target = &found.targets[0];
    close(target.peak_velocity_m_s, energy, 1e-10);
    close(found.drive.energy, energy, 1e-12);
    assert_eq!(target.peak_time_s, 0.030);
    assert_eq!(target.span_s, [0.0, 0.060]);
    assert_eq!(found.maps.points.len(), 6889);
    close(found.lambda_min_m, 14.55e-3, 1e-3);
}

#[test]
fn stepping_is_the_defining_sum() {
    let film = small();
    let modal = film.modal();
    let sent = drive(&modal, (0..3).map(|a| noise(90, a + 1)).collect());
    let places = [Point::new(0.033, 0.044), Point::new(0.013, 0.021), Point::new(0.09, 0.01)];
    let responses = film.responses();
    let traces = Field::new(&responses, &sent, 8.0).unwrap().traces(&places, 199.0 / film.rate).unwrap();
    for (at, trace) in places.iter().zip(&traces) {
        assert_eq!((trace.velocity.len(), trace.displacement.len()), (200, 200));
        type Response = fn(&ModalResponses, usize, Point, usize) -> f64;
        for (response, found) in
            [(velocity as Response, &trace.velocity), (displacement, &trace.displacement)]
        {
            let h: Vec<Vec<f64>> =
                (0..3).map(|a| (0..200).map(|i| response(&modal, a, *at, i)).collect()).collect();
            let scale = found.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            for (i, value) in found.iter().enumerate() {
                let terms =
                    |a: usize| (0..=i.min(89)).map(|j| h[a][i - j] * sent.channels()[a][j]).sum::<f64>();
                let sum = (0..3).map(terms).sum::<f64>() / film.rate;
                assert!((value - sum).abs() < 1e-9 * scale, "{at} at {i}: {value} {sum}");
            }
        }
    }
}

/// One quantity at a target and at every outside point.
struct Signals {
    own: Vec<f64>,
    outside: Vec<Vec<f64>>,
}

impl Signals {
    /// Level at the target at a sample, and its ratios: to the rms then, to the rms and to the largest over the span.
    fn ratios(&self, sample: usize, span: Range<usize>) -> [f64; 4] {
        let level = self.own[sample];
        let rms = |range: Range<usize>| {
            let squares: f64 = self.outside.iter().flat_map(|t| &t[range.clone()]).map(|x| x * x).sum();
            (squares / (self.outside.len() * range.len()) as f64).sqrt()
        };
        let worst = self.outside.iter().flat_map(|t| &t[span.clone()]).fold(0.0, |m: f64, x| m.max(x.abs()));
        [level, level.abs() / rms(sample..sample + 1), level.abs() / rms(span.clone()), level.abs() / worst]
    }
}

fn all_close(found: [Option<f64>; 4], expected: [f64; 4], tolerance: f64) {
    found.iter().zip(expected).for_each(|(found, expected)| close(found.unwrap(), expected, tolerance));
}

#[test]
fn figures_are_those_of_the_definitions() {
    let film = small();
    let modal = film.modal();
    let responses = film.responses();
    let places = [Point::new(0.030, 0.042), Point::new(0.075, 0.050)];
    let (n, rate) = (180, film.rate);
    let mut sum = reversed(&modal, places[0], n).channels().to_vec();
    for (to, from) in sum.iter_mut().flatten().zip(reversed(&modal, places[1], n).channels().iter().flatten())
    {
        *to += 0.7 * from;
    }
    let sent = drive(&modal, sum);
    let instants = [n, 150];
    let aims = [0, 1].map(|i| Aim::at(places[i], instants[i] as f64 / rate));
    let found = measure(&responses, &sent, &aims, &MeasureOptions::default()).unwrap();

    let lambda = modal.conditions.lambda_min;
    let [columns, rows] = [film.width, film.height].map(|side| (8.0 * side / lambda).ceil());
    let cell = |i: usize| {
        let (column, row) = ((i % columns as usize) as f64 + 0.5, (i / columns as usize) as f64 + 0.5);
        Point::new(column * film.width / columns, row * film.height / rows)
    };
    let far = |p: &Point| places.iter().all(|at| at.distance(*p) > 4.0 / 3.0 * lambda);
    let outside: Vec<Point> = (0..(columns * rows) as usize).map(cell).filter(far).collect();
    assert_eq!(found.outside_points, outside.len());
    let field = Field::new(&responses, &sent, 8.0).unwrap();
    let around = field.traces(&outside, 360.0 / rate).unwrap();
    let own = field.traces(&places, 360.0 / rate).unwrap();
    let signals = |index: usize, of: fn(&Trace) -> &Vec<f64>| Signals {
        own: of(&own[index]).clone(),
        outside: around.iter().map(|trace| of(trace).clone()).collect(),
    };
    for (index, target) in found.targets.iter().enumerate() {
        let span = 0..2 * instants[index] + 1;
        let velocity = signals(index, |t| &t.velocity);
        let figures =
            [Some(target.peak_velocity_m_s), target.contrast, target.background_contrast, target.worst_spot];
        all_close(figures, velocity.ratios(instants[index], span.clone()), 1e-5);

        let displacement = signals(index, |t| &t.displacement);
        let larger = |a: &usize, b: &usize| displacement.own[*a].abs().total_cmp(&displacement.own[*b].abs());
        let extreme = span.clone().max_by(larger).unwrap();
        close(target.displacement_peak_time_s, extreme as f64 / rate, 1e-12);
        let figures = [
            Some(target.peak_displacement_m),
            target.displacement_contrast,
            target.displacement_background_contrast,
            target.displacement_worst_spot,
        ];
        all_close(figures, displacement.ratios(extreme, span), 1e-5);
    }
    let peaks =
        found.maps.points.iter().zip(&found.maps.peak_velocity).filter(|(p, _)| far(p)).map(|(_, v)| *v);
    for (peak, trace) in peaks.zip(&around) {
        close(f64::from(peak), trace.velocity.iter().fold(0.0, |m: f64, x| m.max(x.abs())), 1e-4);
    }
}

/// One lossless mode struck once: everything about it is a sine.
#[test]
fn a_single_mode_by_hand() {
    let film = Film { height: 0.10, ..small() };
    let mut modal = film.modal();
    let (omega, rate) = (2.0 * PI * 100.0, 24e3);
    modal.poles = vec![Pole::new(omega, 0.0)];
    modal.conditions.rate = rate;
    modal.input = modal.input.subcols(0, 1).to_owned();
    modal.shapes = std::sync::Arc::new(common::Sines {
        width: film.width,
        height: film.height,
        areal_density: film.areal_density,
        numbers: vec![(1.0, 1.0)],
    });
    let centre = Point::new(0.05, 0.05);
    let phi =
        |p: Point| 2.0 / (film.areal_density * 0.01).sqrt() * (PI * p.x / 0.1).sin() * (PI * p.y / 0.1).sin();
    let strike = drive(&modal, vec![vec![3.0], vec![0.0], vec![0.0]]);
    let aim = Aim::at(centre, 0.010); // A full period later.
    let found =
        measure(&Responses::Modal(modal.clone()), &strike, &[aim], &MeasureOptions::default()).unwrap();
    let target = &found.targets[0];
    let speed = 3.0 / rate * phi(modal.ports[0].at) * phi(centre);
    close(target.peak_velocity_m_s, speed, 1e-12);
    assert_eq!(target.peak_displacement_m.signum(), speed.signum());
    close(target.peak_displacement_m, speed / omega, 1e-12);
    close(target.displacement_peak_time_s, 0.0025, 1e-12);
    close(target.pulse_duration_s.unwrap(), 0.010 / 3.0, 1e-4);
    assert_eq!(target.displacement_pulse_duration_s.map(|t| (t * 1e5).round()), Some(333.0));
    let outside = Grid::new(&modal.conditions, 8.0).unwrap().points();
    let outside = outside.iter().filter(|p| p.distance(centre) > 4.0 / 3.0 * modal.conditions.lambda_min);
    let (count, squares) = outside.fold((0.0, 0.0), |(n, s), p| (n + 1.0, s + phi(*p).powi(2)));
    close(target.contrast.unwrap(), phi(centre) / (squares / count).sqrt(), 1e-6);
    close(target.displacement_contrast.unwrap(), target.contrast.unwrap(), 1e-5);

    let half = |angle: f64| {
        let excess = |r: f64| (PI * r * angle.cos() / 0.1).cos() * (PI * r * angle.sin() / 0.1).cos() - 0.5;
        let (mut low, mut high) = (0.0, 0.05);
        for _ in 0..60 {
            let middle = (low + high) / 2.0;
            if excess(middle) > 0.0 { low = middle } else { high = middle }
        }
        low
    };
    let diameter = (0..8).map(|i| 2.0 * half(PI * f64::from(i) / 8.0)).sum::<f64>() / 8.0;
    close(target.spot_diameter_m.unwrap(), diameter, 1e-4);
    close(target.displacement_spot_diameter_m.unwrap(), diameter, 1e-4);
}

#[test]
fn a_library_of_the_same_points_gives_the_same_figures() {
    let film = small();
    let modal = film.modal();
    let grid = Grid::new(&modal.conditions, 8.0).unwrap();
    let at = grid.points()[grid.inside.len() / 2 + grid.columns / 3];
    let n = 180;
    let sent = reversed(&modal, at, n);
    let aim = Aim::at(Point::new(at.x + 1e-3, at.y), n as f64 / film.rate);
    let exact =
        measure(&film.responses(), &sent, &[Aim::at(at, aim.instant)], &MeasureOptions::default()).unwrap();
    let stored = library(&modal, grid.points(), 2 * n + 1);
    let found = measure(&stored, &sent, std::slice::from_ref(&aim), &MeasureOptions::default()).unwrap();
    assert_eq!((exact.taken_on, found.taken_on), (TakenOn::Grid, TakenOn::Library));
    let (a, b) = (&exact.targets[0], &found.targets[0]);
    close(b.misplaced_m, 1e-3, 1e-9);
    assert!(b.span_complete);
    close(b.peak_velocity_m_s, a.peak_velocity_m_s, 1e-6);
    close(b.contrast.unwrap(), a.contrast.unwrap(), 1e-5);
    close(b.background_contrast.unwrap(), a.background_contrast.unwrap(), 1e-5);
    close(b.worst_spot.unwrap(), a.worst_spot.unwrap(), 1e-5);
    close(b.pulse_duration_s.unwrap(), a.pulse_duration_s.unwrap(), 1e-5);
    close(b.peak_displacement_m, a.peak_displacement_m, 1e-3);
    close(b.displacement_contrast.unwrap(), a.displacement_contrast.unwrap(), 1e-3);
    close(b.displacement_background_contrast.unwrap(), a.displacement_background_contrast.unwrap(), 1e-3);
    close(b.displacement_worst_spot.unwrap(), a.displacement_worst_spot.unwrap(), 1e-3);
    close(b.spot_diameter_m.unwrap(), a.spot_diameter_m.unwrap(), 0.05);
    close(b.displacement_spot_diameter_m.unwrap(), a.displacement_spot_diameter_m.unwrap(), 0.05);

    let short = library(&modal, grid.points(), n + 1);
    let cut = measure(&short, &sent, &[aim], &MeasureOptions::default()).unwrap();
    assert!(!cut.targets[0].span_complete);
    close(cut.targets[0].span_s[1], n as f64 / film.rate, 1e-12);
    close(cut.targets[0].contrast.unwrap(), a.contrast.unwrap(), 1e-5);
}

#[test]
fn a_repeated_drive_reaches_the_sum_of_the_geometric_series() {
    let film = small();
    let modal = film.modal();
    let (period, repeats) = (150, 24);
    let mut train = vec![0.0; period * repeats];
    train.iter_mut().step_by(period).for_each(|d| *d = 1.0);
    let silent = vec![0.0; train.len()];
    let sent = drive(&modal, vec![train, silent.clone(), silent]);
    let at = Point::new(0.033, 0.044);
    let mut row = vec![0.0; modal.poles.len()];
    modal.shapes.at(at, &mut row);
    // Velocity of a mode is Re[(1 + jσ/ω_d) e^{λt}], λ = −σ + jω_d; over all earlier strikes, divided by 1 − e^{λ T_r}.
    let steady = |i: usize| -> f64 {
        let term = |m: usize| {
            let Pole { omega, sigma, .. } = modal.poles[m];
            let wd = (omega * omega - sigma * sigma).sqrt();
            let (t, repeat) = (i as f64 / film.rate, period as f64 / film.rate);
            let (decay, turn) = ((-sigma * repeat).exp(), wd * repeat);
            let (re, im) = (1.0 - decay * turn.cos(), -decay * turn.sin());
            let (a, b) =
                ((wd * t).cos() - sigma / wd * (wd * t).sin(), (wd * t).sin() + sigma / wd * (wd * t).cos());
            modal.input[(0, m)] * row[m] * (-sigma * t).exp() * (a * re + b * im) / (re * re + im * im)
        };
        (0..modal.poles.len()).map(term).sum::<f64>() / film.rate
    };
    let responses = film.responses();
    let start = period * (repeats - 1);
    for instant in [0, 40, 149] {
        let aim = Aim::at(at, (start + instant) as f64 / film.rate);
        let options = MeasureOptions { period: Some(period as f64 / film.rate), ..Default::default() };
        let found = measure(&responses, &sent, &[aim], &options).unwrap();
        let scale = (0..period).map(|i| steady(i).abs()).fold(0.0, f64::max);
        let target = &found.targets[0];
        assert!((target.peak_velocity_m_s - steady(instant)).abs() < 1e-5 * scale, "{instant}");
        let first = target.span_s[0] * film.rate;
        assert_eq!(
            (first.round() as usize, target.span_s[1]),
            (start, (sent.samples() - 1) as f64 / film.rate)
        );
        close(found.drive.rms, (1.0 / (3.0 * period as f64)).sqrt(), 1e-12);
    }
}

/// Without losses, what the actuators do in work is what the film holds in the end.
#[test]
fn work_becomes_energy() {
    let film = Film { decay_time: f64::INFINITY, ..small() };
    let modal = film.modal();
    let sent = drive(&modal, (0..3).map(|a| noise(200, 7 + a)).collect());
    let responses = film.responses();
    let field = Field::new(&responses, &sent, 8.0).unwrap();
    let after = field.traces(&film.ports, 199.0 / film.rate).unwrap();
    let mut work = 0.0;
    for i in 0..200 {
        let struck: Vec<f64> = sent.channels().iter().map(|channel| channel[i] / film.rate).collect();
        for (a, trace) in after.iter().enumerate() {
            let jump: f64 = (0..3).map(|b| struck[b] * velocity(&modal, b, film.ports[a], 0)).sum();
            work += struck[a] * (trace.velocity[i] - jump / 2.0);
        }
    }
    let snapshot = &field.snapshots(&[199.0 / film.rate]).unwrap()[0];
    let weights = modal.shapes.at_all(field.points());
    let grid = field.grid().unwrap();
    let mass = film.areal_density * grid.width * grid.height;
    // Midpoint sums over the grid are exact for products of these sines.
    let project = |values: &[f32], m: usize| {
        values.iter().enumerate().map(|(p, x)| mass * f64::from(*x) * weights[(p, m)]).sum::<f64>()
    };
    let held: f64 = (0..modal.poles.len())
        .map(|m| {
            let (v, u) = (project(&snapshot.velocity, m), project(&snapshot.displacement, m));
            (v * v + (modal.poles[m].omega * u).powi(2)) / 2.0
        })
        .sum();
    close(held, work, 1e-5);
}

#[test]
fn sets_of_points_are_measured_by_their_mean() {
    let film = small();
    let modal = film.modal();
    let places = vec![Point::new(0.03, 0.042), Point::new(0.034, 0.042), Point::new(0.06, 0.05)];
    let sent = reversed(&modal, places[0], 180);
    let instant = 180.0 / film.rate;
    let responses = film.responses();
    let set = Aim { points: places.clone(), instant };
    let found = measure(&responses, &sent, &[set], &MeasureOptions::default()).unwrap();
    let traces = Field::new(&responses, &sent, 8.0).unwrap().traces(&places, instant).unwrap();
    let levels: Vec<f64> = traces.iter().map(|t| t.velocity[180]).collect();
    let target = &found.targets[0];
    close(target.peak_velocity_m_s, levels.iter().sum::<f64>() / 3.0, 1e-12);
    let [least, greatest] = target.velocity_range_m_s.unwrap();
    close(least, levels.iter().copied().fold(f64::MAX, f64::min), 1e-12);
    close(greatest, levels[0], 1e-12);
    assert_eq!((target.points, target.spot_diameter_m), (3, None));
    let far = |p: &Point| places.iter().all(|at| at.distance(*p) > found.focal_radius_m);
    assert_eq!(found.outside_points, found.maps.points.iter().filter(|p| far(p)).count());
}
