//! Bad input is refused with what was expected and what was found.

use crate::common;

use common::{Film, drive};
use unripple_core::{Drive, Point, Responses, SampledResponses};
use unripple_field::{Aim, Field, FieldError, MeasureOptions, measure};

fn film() -> Film {
    Film {
        top_hz: 1000.0,
        rate: 8e3,
        ports: vec![Point::new(0.03, 0.05), Point::new(0.11, 0.08)],
        ..Film::paper()
    }
}

fn refused(sent: &Drive, aims: &[Aim], options: &MeasureOptions) -> FieldError {
    measure(&film().responses(), sent, aims, options).unwrap_err()
}

#[test]
fn drives_of_another_surface() {
    let options = MeasureOptions::default();
    let names = |names: &[&str]| names.iter().map(|n| (*n).to_owned()).collect::<Vec<_>>();
    let channels = |count: usize| vec![vec![1.0; 10]; count];
    let fewer = Drive::new(8e3, names(&["a1"]), channels(1)).unwrap();
    assert_eq!(refused(&fewer, &[], &options).to_string(), "channels: expected 2 (a1, a2), found 1 (a1)");
    let swapped = Drive::new(8e3, names(&["a2", "a1"]), channels(2)).unwrap();
    assert_eq!(
        refused(&swapped, &[], &options).to_string(),
        "channels: expected 2 (a1, a2), found 2 (a2, a1)"
    );
    let slow = Drive::new(44.1e3, names(&["a1", "a2"]), channels(2)).unwrap();
    let rate = refused(&slow, &[], &options);
    assert_eq!(rate, FieldError::Rate { expected: 8e3, found: 44.1e3 });
    let empty = Drive::new(8e3, names(&["a1", "a2"]), vec![vec![], vec![]]).unwrap();
    assert!(matches!(refused(&empty, &[], &options), FieldError::Count { found: 0, .. }));
}

#[test]
fn aims_that_are_nowhere() {
    let sent = drive(&film().modal(), vec![vec![1.0; 10]; 2]);
    let options = MeasureOptions::default();
    let at = Point::new(0.05, 0.05);
    let out = refused(&sent, &[Aim::at(Point::from_mm(62.0, 190.0), 1e-3)], &options).to_string();
    assert_eq!(
        out,
        "(62.0000, 190.0000) mm is outside the surface, nearest legal point (62.0000, 150.0000) mm"
    );
    for instant in [-1.0, f64::NAN, f64::INFINITY, 1e9] {
        assert!(
            matches!(refused(&sent, &[Aim::at(at, instant)], &options), FieldError::Instant { .. }),
            "{instant}"
        );
    }
    assert!(matches!(
        refused(&sent, &[Aim { points: vec![], instant: 0.0 }], &options),
        FieldError::Count { .. }
    ));
    assert!(
        refused(&sent, &[Aim::at(Point::new(f64::NAN, 0.0), 0.0)], &options).to_string().contains("outside")
    );
    let long = refused(&sent, &vec![Aim::at(at, 1000.0); 10], &options).to_string();
    assert_eq!(long, "values of the traces: expected at most 100000000, found 320000020");
}

#[test]
fn periods_and_grids_without_meaning() {
    let sent = drive(&film().modal(), vec![vec![1.0; 80]; 2]);
    for period in [0.0, -1.0, f64::NAN, 0.0101] {
        let options = MeasureOptions { period: Some(period), ..Default::default() };
        assert!(matches!(refused(&sent, &[], &options), FieldError::Range(_)), "{period}");
    }
    let options = MeasureOptions { period: Some(0.005), ..Default::default() };
    let early = refused(&sent, &[Aim::at(Point::new(0.05, 0.05), 0.004)], &options);
    assert_eq!(
        early.to_string(),
        "instant: expected 5.0000 ms to 9.8750 ms, the last full period of the drive, found 4.0000 ms"
    );
    for cells in [0.0, f64::NAN, 1e7] {
        let options = MeasureOptions { cells, ..Default::default() };
        assert!(matches!(refused(&sent, &[], &options), FieldError::Range(_)), "{cells}");
    }
    let responses = film().responses();
    let field = Field::new(&responses, &sent, 8.0).unwrap();
    assert!(matches!(field.snapshots(&vec![0.0; 1_000_000]), Err(FieldError::Count { .. })));
    assert!(matches!(field.traces(&[Point::new(0.05, 0.05)], f64::NAN), Err(FieldError::Instant { .. })));
}

#[test]
fn places_and_times_a_library_does_not_know() {
    let modal = film().modal();
    let known = vec![Point::new(0.05, 0.05)];
    let stored =
        SampledResponses::new(modal.ports.clone(), known, modal.conditions.clone(), 20, vec![1.0; 40])
            .unwrap();
    let stored = Responses::Sampled(stored);
    let sent = drive(&modal, vec![vec![1.0; 10]; 2]);
    let refuse = |at, instant| {
        measure(&stored, &sent, &[Aim::at(at, instant)], &MeasureOptions::default()).unwrap_err()
    };
    let far = refuse(Point::new(0.07, 0.05), 1e-3).to_string();
    assert!(far.contains("20.000 mm from the nearest point with responses"), "{far}");
    assert!(far.contains("nearest legal point (50.0000, 50.0000) mm"), "{far}");
    let late = refuse(Point::new(0.05, 0.05), 20.0 / 8e3);
    assert!(matches!(late, FieldError::Instant { last, .. } if (last - 19.0 / 8e3).abs() < 1e-12));
    let nothing =
        SampledResponses::new(modal.ports.clone(), vec![], modal.conditions.clone(), 20, vec![]).unwrap();
    let none = measure(&Responses::Sampled(nothing), &sent, &[], &MeasureOptions::default()).unwrap();
    assert_eq!(none.outside_points, 0);
}

#[test]
fn silence_and_tiny_surfaces_have_no_ratios() {
    let modal = film().modal();
    let silent = drive(&modal, vec![vec![0.0; 10]; 2]);
    let aim = Aim::at(Point::new(0.05, 0.05), 1e-3);
    let found = measure(&film().responses(), &silent, std::slice::from_ref(&aim), &MeasureOptions::default())
        .unwrap();
    let target = &found.targets[0];
    assert_eq!((target.peak_velocity_m_s, target.contrast, target.worst_spot), (0.0, None, None));
    assert_eq!((target.spot_diameter_m, target.pulse_duration_s), (None, None));
    assert_eq!((found.drive.peak, found.drive.share_above_band), (0.0, 0.0));

    let mut tiny = modal;
    tiny.conditions.lambda_min = 1.0;
    let sent = drive(&tiny, vec![vec![1.0; 10]; 2]);
    let found = measure(&Responses::Modal(tiny), &sent, &[aim], &MeasureOptions::default()).unwrap();
    assert_eq!((found.outside_points, found.targets[0].contrast), (0, None));
}

#[test]
fn without_aims_there_are_maps_and_the_drives_figures() {
    let modal = film().modal();
    let sent = drive(&modal, vec![vec![1.0; 10], vec![0.0; 10]]);
    let found = measure(&film().responses(), &sent, &[], &MeasureOptions::default()).unwrap();
    assert!(found.targets.is_empty());
    assert!(found.maps.peak_velocity.iter().any(|v| *v > 0.0));
    assert_eq!(found.drive.peak, 1.0);
}

#[test]
fn the_report_has_the_agreed_keys() {
    let modal = film().modal();
    let sent = common::reversed(&modal, Point::new(0.05, 0.06), 80);
    let aim = Aim::at(Point::new(0.05, 0.06), 0.010);
    let found = measure(&film().responses(), &sent, &[aim], &MeasureOptions::default()).unwrap();
    let json = serde_json::to_value(&found).unwrap();
    for key in [
        "at_m",
        "peak_velocity_m_s",
        "peak_displacement_m",
        "peak_time_s",
        "contrast",
        "background_contrast",
        "worst_spot",
        "spot_diameter_m",
        "pulse_duration_s",
        "displacement_contrast",
        "displacement_background_contrast",
        "displacement_worst_spot",
        "displacement_spot_diameter_m",
        "displacement_pulse_duration_s",
        "displacement_peak_time_s",
        "felt_level_db",
        "felt_peak_time_s",
        "felt_contrast_db",
        "felt_background_db",
        "felt_worst_spot_db",
    ] {
        let value = &json["targets"][0][key];
        assert!(value.is_number() || value.is_array(), "{key}: {value}");
    }
    for key in ["peak", "rms", "energy", "share_above_band"] {
        assert!(json["drive"][key].is_number(), "{key}");
    }
    assert!(json["lambda_min_m"].is_number() && json["felt_outside_db"].is_number());
    assert!(json.get("maps").is_none());
}
