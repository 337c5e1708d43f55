//! What is true of every task: its request goes through JSON and back, an unknown key is refused, and one that is cancelled before it begins
//! does nothing.

#[path = "every/by_name.rs"]
mod by_name;
#[path = "every/curves.rs"]
mod curves;
#[path = "every/given.rs"]
mod given;
#[path = "every/place_by.rs"]
mod place_by;
#[path = "every/reach.rs"]
mod reach;
#[path = "every/optimise.rs"]
mod searches;
#[path = "every/optimise_more.rs"]
mod searches_more;
#[path = "every/sweep.rs"]
mod sweeps;
#[path = "every/sweep_ended.rs"]
mod sweeps_ended;
#[path = "every/sweep_equal.rs"]
mod sweeps_of_equal_designs;
#[path = "every/sweep_files.rs"]
mod sweeps_of_files;
#[path = "every/sweep_memory.rs"]
mod sweeps_without_memory;
#[path = "every/told.rs"]
mod told;

use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;
use unripple_tasks::*;

/// Whoever waits has gone.
struct Gone;

impl Progress for Gone {
    fn cancelled(&self) -> bool {
        true
    }
}

fn folder(name: &str) -> std::path::PathBuf {
    std::env::temp_dir().join(format!("unripple-every-{name}-{}", std::process::id()))
}

fn through_json<A: Serialize + DeserializeOwned + PartialEq + Debug>(ask: &A) {
    let text = serde_json::to_string(ask).unwrap();
    assert_eq!(&serde_json::from_str::<A>(&text).unwrap(), ask, "{text}");
    let mut other: serde_json::Value = serde_json::from_str(&text).unwrap();
    other["no_such_key"] = 1.into();
    assert!(serde_json::from_value::<A>(other).is_err(), "an unknown key is taken by {text}");
    assert!(serde_json::from_str::<A>("{}").is_ok(), "no defaults: {text}");
}

#[test]
fn asks_about_surfaces_and_devices_go_through_json() {
    through_json(&check::Ask::default());
    through_json(&design::Ask::default());
    through_json(&modes::Ask { top_hz: Some(500.5), ..modes::Ask::default() });
    through_json(&respond::Ask { pitch_m: 0.0075, ..respond::Ask::default() });
    through_json(&import::Ask {
        kind: Some(import::Kind::ImpulseResponses),
        per: Some(import::Per::Volt),
        band_hz: Some([50.0, 3e3]),
        ..import::Ask::default()
    });
    through_json(&export::Ask { format: Some(export::Format::Sofa), ..export::Ask::default() });
    through_json(&materials::Ask { name: Some("glass".into()) });
    through_json(&devices::Ask::default());
    through_json(&doctor::Ask::default());
    through_json(&drift::Ask { changed: 0.005, ..drift::Ask::default() });
    through_json(&verify::Ask {
        target_m: Some([0.062, 0.09]),
        clipped: Some(0.5),
        ..verify::Ask::default()
    });
    through_json(&fit::Ask::default());
    let mode = fit_modes::ModeAsk { frequency_hz: 73.2, decay_time_s: Some(0.25) };
    through_json(&fit_modes::Ask {
        modes: vec![mode],
        free: vec!["modulus".into()],
        ..fit_modes::Ask::default()
    });
    through_json(&listen::Ask { band_hz: Some([20.0, 2e3]), ..listen::Ask::default() });
    through_json(&calibrate::Ask { by: calibrate::By::Tap, ..calibrate::Ask::default() });
    through_json(&place::Ask {
        importance: Some("map.csv".into()),
        important: vec![place::ImportantAsk {
            area_m: vec![[0.0, 0.0], [0.1, 0.0], [0.1, 0.1]],
            weight: 2.0,
        }],
        methods: vec![unripple::focus::Method::Inverse],
        by: Some(place::ByAsk::FeltContrast),
        evaluations: Some(30),
        ..place::Ask::default()
    });
    through_json(&optimise::Ask { no_ask: true, ..optimise::Ask::default() });
    through_json(&sweep::Ask { shard: Some(3), output: Some("out".into()), ..sweep::Ask::default() });
}

#[test]
fn asks_for_drives_go_through_json() {
    through_json(&compare::Ask {
        others: vec!["drum".into()],
        methods: vec![unripple::focus::Method::Felt, unripple::focus::Method::OneBit],
        level: target::LevelAsk::PeakM(1e-5),
        ..compare::Ask::default()
    });
    through_json(&field::Ask {
        drive: field::DriveAsk::Samples { channels: vec![vec![0.5, 1.0]], rate_hz: 48e3 },
        ..field::Ask::default()
    });
    through_json(&focus::Ask {
        surface: SurfaceAsk::Text { toml: "format = 1".into(), name: Some("film.toml".into()) },
        points: vec![target::PointAsk { rate_hz: Some(5.0), ..target::PointAsk::at(0.062, 0.09) }],
        shapes: vec![target::ShapeAsk::Circle { centre_m: [0.075; 2], radius_m: 0.02 }],
        level: target::LevelAsk::FeltDb(12.0),
        method: unripple::focus::Method::Concentrate,
        losses: focus::Losses::PerMode,
        columns: Some(1),
        ..focus::Ask::default()
    });
    through_json(&waveform::Ask {
        waveforms: vec![waveform::WaveformAsk {
            at_m: [0.062, 0.09],
            sound: waveform::SoundAsk::Burst { hz: 250.0, cycles: 5.0 },
            level_m: 1e-6,
        }],
        ..waveform::Ask::default()
    });
    through_json(&stroke::Ask::default());
    through_json(&play::Ask::default());
}

/// A task that was cancelled before it began.
fn does_nothing<A, R: Debug>(ask: &A, run: fn(&A, &mut dyn Progress) -> Result<R, TaskError>) {
    let found = run(ask, &mut Gone);
    assert!(matches!(found, Err(TaskError::Cancelled)), "{found:?}");
}

#[test]
fn a_cancelled_task_leaves_nothing() {
    let output = folder("cancelled");
    let points = vec![target::PointAsk::at(0.062, 0.09)];
    let place = Some(output.clone());
    does_nothing(&check::Ask::default(), check::run);
    does_nothing(&design::Ask::default(), design::run);
    does_nothing(&modes::Ask::default(), modes::run);
    does_nothing(&materials::Ask::default(), materials::run);
    does_nothing(&devices::Ask::default(), devices::run);
    does_nothing(&doctor::Ask::default(), doctor::run);
    does_nothing(&drift::Ask::default(), drift::run);
    does_nothing(&verify::Ask::default(), verify::run);
    let mode = fit_modes::ModeAsk { frequency_hz: 171.4, decay_time_s: None };
    let ask = fit_modes::Ask { modes: vec![mode], output: place.clone(), ..fit_modes::Ask::default() };
    does_nothing(&ask, fit_modes::run);
    does_nothing(
        &respond::Ask { pitch_m: 0.02, output: output.clone(), ..respond::Ask::default() },
        respond::run,
    );
    let ask = focus::Ask { points: points.clone(), output: place.clone(), ..focus::Ask::default() };
    does_nothing(&ask, focus::run);
    let ask = compare::Ask { points, output: place.clone(), ..compare::Ask::default() };
    does_nothing(&ask, compare::run);
    let ask =
        calibrate::Ask { points_m: vec![[0.05; 2]], output: output.clone(), ..calibrate::Ask::default() };
    does_nothing(&ask, calibrate::run);
    let sound = waveform::SoundAsk::Click { length_s: 0.002 };
    let waveforms = vec![waveform::WaveformAsk { at_m: [0.05; 2], sound, level_m: 1e-6 }];
    does_nothing(
        &waveform::Ask { waveforms, output: place.clone(), ..waveform::Ask::default() },
        waveform::run,
    );
    does_nothing(&stroke::Ask { output: place.clone(), ..stroke::Ask::default() }, stroke::run);
    does_nothing(&optimise::Ask { output: place.clone(), ..optimise::Ask::default() }, optimise::run);
    does_nothing(&sweep::Ask { output: place.clone(), ..sweep::Ask::default() }, sweep::run);
    let drive = field::DriveAsk::Samples { channels: vec![vec![1.0; 64]; 8], rate_hz: 48e3 };
    does_nothing(&field::Ask { drive, output: place, ..field::Ask::default() }, field::run);
    assert!(!output.exists());
}

#[test]
fn defaults_are_those_of_the_library() {
    let usual = unripple::focus::Options::default();
    let ask = focus::Ask::default();
    assert_eq!((ask.push, ask.spread, ask.method), (usual.push, usual.spread, usual.method));
}

#[test]
fn an_ask_names_the_field_that_is_wrong() {
    let field = |error: TaskError| match error {
        TaskError::Ask { field, .. } => field,
        other => panic!("{other}"),
    };
    let ask = focus::Ask::default();
    assert_eq!(field(focus::run(&ask, &mut Silent).unwrap_err()), "points, shapes");
    let ask = focus::Ask { points: vec![target::PointAsk::at(0.05, 0.05)], window_s: Some(-1.0), ..ask };
    assert_eq!(field(focus::run(&ask, &mut Silent).unwrap_err()), "window_s");
    let ask = compare::Ask { columns: Some(0), ..compare::Ask::default() };
    assert_eq!(field(compare::run(&ask, &mut Silent).unwrap_err()), "columns");
    let ask = compare::Ask { labels: vec!["a".into(), "b".into()], ..compare::Ask::default() };
    assert_eq!(field(compare::run(&ask, &mut Silent).unwrap_err()), "labels");
    let ask = drift::Ask { seconds: 0.1, ..drift::Ask::default() };
    assert_eq!(field(drift::run(&ask, &mut Silent).unwrap_err()), "seconds");
    let ask = drift::Ask { range: f64::NAN, ..drift::Ask::default() };
    assert_eq!(field(drift::run(&ask, &mut Silent).unwrap_err()), "range");
    let device = DeviceAsk { device: DeviceKind::Jack, ..DeviceAsk::default() };
    let ask = drift::Ask { changed: 0.01, device, ..drift::Ask::default() };
    assert_eq!(field(drift::run(&ask, &mut Silent).unwrap_err()), "changed");
    let ask = modes::Ask { top_hz: Some(f64::NAN), ..modes::Ask::default() };
    assert_eq!(field(modes::run(&ask, &mut Silent).unwrap_err()), "top_hz");
}
