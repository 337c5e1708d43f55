//! What holds for every film, drive and place.

use crate::common;

use common::{Film, drive, reversed};
use proptest::prelude::*;
use unripple_core::{Drive, ModalResponses, Point, Responses};
use unripple_field::{Aim, Field, MeasureOptions, Trace, measure};

/// Small films with random sides, tension, losses and ports.
fn films() -> impl Strategy<Value = Film> {
    let place = (0.1..0.9, 0.1..0.9);
    let ports = prop::collection::vec(place, 1..4);
    (0.06..0.12, 0.06..0.12, 50.0..400.0, 5e-3..0.2, ports).prop_map(
        |(width, height, tension, decay_time, ports)| Film {
            width,
            height,
            tension,
            decay_time,
            top_hz: 1200.0,
            rate: 12e3,
            ports: ports.into_iter().map(|(x, y)| Point::new(x * width, y * height)).collect(),
            ..Film::paper()
        },
    )
}

/// A film, a place on it, and two drives.
fn scenes() -> impl Strategy<Value = (Film, Point, Vec<Vec<f64>>, Vec<Vec<f64>>)> {
    films().prop_flat_map(|film| {
        let channels = prop::collection::vec(prop::collection::vec(-1.0..1.0, 40), film.ports.len());
        let (width, height) = (film.width, film.height);
        let place = (0.05..0.95, 0.05..0.95).prop_map(move |(x, y)| Point::new(x * width, y * height));
        (Just(film), place, channels.clone(), channels)
    })
}

fn trace(modal: &ModalResponses, sent: &Drive, at: Point) -> Trace {
    let responses = Responses::Modal(modal.clone());
    let field = Field::new(&responses, sent, 2.0).unwrap();
    field.traces(&[at], 99.0 / modal.conditions.rate).unwrap().remove(0)
}

fn same(a: &[f64], b: &[f64], tolerance: f64) -> Result<(), TestCaseError> {
    let scale = a.iter().chain(b).fold(0.0, |m: f64, x| m.max(x.abs()));
    for (a, b) in a.iter().zip(b) {
        prop_assert!((a - b).abs() <= tolerance * scale, "{a} {b} of {scale}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn fields_add_up((film, at, one, other) in scenes(), factor in -3.0..3.0) {
        let modal = film.modal();
        let both = one.iter().zip(&other).map(|(a, b)| a.iter().zip(b).map(|(a, b)| a + factor * b).collect()).collect();
        let [one, other, both] = [one, other, both].map(|channels| trace(&modal, &drive(&modal, channels), at));
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + factor * b).collect::<Vec<_>>();
        same(&sum(&one.velocity, &other.velocity), &both.velocity, 1e-11)?;
        same(&sum(&one.displacement, &other.displacement), &both.displacement, 1e-11)?;
    }

    #[test]
    fn fields_shift_with_their_drives((film, at, one, _) in scenes(), delay in 1usize..50) {
        let modal = film.modal();
        let late = one.iter().map(|channel| [vec![0.0; delay], channel.clone()].concat()).collect();
        let [one, late] = [one, late].map(|channels| trace(&modal, &drive(&modal, channels), at));
        same(&one.velocity[..100 - delay], &late.velocity[delay..], 1e-11)?;
        same(&one.displacement[..100 - delay], &late.displacement[delay..], 1e-11)?;
    }

    #[test]
    fn responses_are_reciprocal((film, at, one, _) in scenes()) {
        let there = film.modal();
        let back = Film { ports: vec![at], ..film.clone() }.modal();
        let strike = vec![one[0].clone()];
        let mut channels = vec![vec![0.0; 40]; film.ports.len()];
        channels[0] = strike[0].clone();
        let (a, b) = (trace(&there, &drive(&there, channels), at), trace(&back, &drive(&back, strike), film.ports[0]));
        same(&a.velocity, &b.velocity, 1e-11)?;
        same(&a.displacement, &b.displacement, 1e-11)?;
    }

    #[test]
    fn displacement_is_the_integral_of_velocity((film, at, one, _) in scenes()) {
        let modal = film.modal();
        let sent = drive(&modal, one.clone());
        let found = trace(&modal, &sent, at);
        // Between strikes the film rings freely and the velocity is smooth: Simpson's rule over each interval, its
        // middle from the same strikes at twice the rate, its end before the next strike.
        let fine = Film { rate: 2.0 * film.rate, ..film.clone() }.modal();
        let twice = one.iter().map(|c| c.iter().flat_map(|d| [2.0 * d, 0.0]).collect()).collect();
        let fine_sent = drive(&fine, twice);
        let responses = Responses::Modal(fine.clone());
        let fine_trace = Field::new(&responses, &fine_sent, 2.0).unwrap().traces(&[at], 198.0 / fine.conditions.rate).unwrap().remove(0);
        let scale = found.displacement.iter().fold(0.0, |m: f64, u| m.max(u.abs()));
        let mut u = 0.0;
        for i in 0..99 {
            let jump: f64 = (0..film.ports.len())
                .map(|a| one[a].get(i + 1).map_or(0.0, |d| d / film.rate * common::velocity(&modal, a, at, 0)))
                .sum();
            let ends = fine_trace.velocity[2 * i] + fine_trace.velocity[2 * i + 2] - jump;
            u += (ends + 4.0 * fine_trace.velocity[2 * i + 1]) / (6.0 * film.rate);
            prop_assert!((u - found.displacement[i + 1]).abs() < 1e-3 * scale, "{i}: {u} {}", found.displacement[i + 1]);
        }
    }

    #[test]
    fn ratios_do_not_depend_on_the_level((film, at, one, _) in scenes(), factor in 1e-6..1e6_f64, sign in any::<bool>()) {
        let modal = film.modal();
        let responses = film.responses();
        let factor = if sign { factor } else { -factor };
        let figures = |channels| {
            let aim = Aim::at(at, 39.0 / film.rate);
            measure(&responses, &drive(&modal, channels), &[aim], &MeasureOptions::default()).unwrap()
        };
        let louder = one.iter().map(|channel| channel.iter().map(|d| factor * d).collect()).collect();
        let (a, b) = (figures(one), figures(louder));
        let (drive_a, drive_b) = (a.drive, b.drive);
        let (a, b) = (&a.targets[0], &b.targets[0]);
        let pairs = [
            (a.contrast, b.contrast), (a.background_contrast, b.background_contrast), (a.worst_spot, b.worst_spot),
            (a.displacement_contrast, b.displacement_contrast), (a.displacement_worst_spot, b.displacement_worst_spot),
            (a.spot_diameter_m, b.spot_diameter_m), (a.pulse_duration_s, b.pulse_duration_s),
            (Some(factor * a.peak_velocity_m_s), Some(b.peak_velocity_m_s)),
            (Some(factor * a.peak_displacement_m), Some(b.peak_displacement_m)),
            (Some(factor * factor * drive_a.energy), Some(drive_b.energy)),
            (Some(drive_a.share_above_band), Some(drive_b.share_above_band)),
        ];
        for (a, b) in pairs {
            prop_assert_eq!(a.is_some(), b.is_some());
            let (a, b) = (a.unwrap_or_default(), b.unwrap_or_default());
            prop_assert!((a - b).abs() <= 1e-4 * a.abs(), "{} {}", a, b);
        }
    }

    #[test]
    fn no_drive_of_the_same_energy_peaks_higher_than_time_reversal((film, at, one, _) in scenes()) {
        let modal = film.modal();
        let responses = film.responses();
        let peak_per_energy = |sent: &Drive| {
            let aim = Aim::at(at, 39.0 / film.rate);
            let found = measure(&responses, sent, &[aim], &MeasureOptions { cells: 2.0, ..Default::default() }).unwrap();
            found.targets[0].peak_velocity_m_s.abs() / found.drive.energy.sqrt()
        };
        let best = peak_per_energy(&reversed(&modal, at, 39));
        prop_assert!(peak_per_energy(&drive(&modal, one.clone())) <= best * (1.0 + 1e-12));
        // A drive close to it falls short by the part that is not along it.
        let near = reversed(&modal, at, 39);
        let nudge = near.peak() * 0.3;
        let nudged = near.channels().iter().zip(&one).map(|(h, d)| h.iter().zip(d).map(|(h, d)| h + nudge * d).collect());
        prop_assert!(peak_per_energy(&drive(&modal, nudged.collect())) <= best * (1.0 + 1e-12));
    }
}
