//! Tension found on virtual surfaces whose truth has another: by how much, whether it goes on changing, and what cannot be followed.

use std::path::PathBuf;
use unripple_store::{Library, LibraryPlan, Quality, load_surface, to_toml};
use unripple_tasks::drift::{self, Ask, Report, Verdict};
use unripple_tasks::{DeviceAsk, Report as _, Silent, SurfaceAsk, calibrate, respond};

/// The paper's film in a third of its band, where a fit takes seconds.
fn film() -> SurfaceAsk {
    let mut film = load_surface("hudin-2012").unwrap();
    film.emission.band[1] = 1000.0;
    SurfaceAsk::Text { toml: to_toml(&film), name: None }
}

fn asked(ask: Ask) -> Report {
    let report = drift::run(&ask, &mut Silent).unwrap();
    println!("{}", report.text());
    report
}

/// How many standard errors a change is from the truth.
fn off(report: &Report, truth: f64) -> f64 {
    (report.change.unwrap() - truth).abs() / report.change_error.unwrap()
}

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("unripple-drift-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

#[test]
fn a_change_is_found_within_its_error_and_none_is_none() {
    for changed in [0.0, 0.005, -0.02, 0.06] {
        let report = asked(Ask { surface: film(), seconds: 2.0, changed, ..Ask::default() });
        assert_eq!(report.verdict, Verdict::Steady);
        assert!(off(&report, changed) < 2.0, "{} of its error off", off(&report, changed));
        assert!(report.change_error.unwrap() < 2e-4 && report.failure().is_none());
        assert!(report.change_per_min.unwrap().abs() < 3.0 * report.change_per_min_error.unwrap());
        assert!(report.latency_samples.abs() < 0.05);
        let focus = report.focus.unwrap();
        match changed {
            0.0 => assert!(
                (focus.peak_share - 1.0).abs() < 1e-3 && report.text().contains("nothing need be done")
            ),
            _ if changed.abs() > 0.01 => assert!(focus.peak_share < 0.98),
            _ => assert!(focus.peak_share < 1.0),
        }
    }
}

#[test]
fn a_sheet_that_warms_drifts() {
    let (changed, changing_per_min) = (0.005, -0.02);
    let ask = Ask { surface: film(), seconds: 3.2, changed, changing_per_min, ..Ask::default() };
    let report = asked(ask);
    assert_eq!(report.verdict, Verdict::Drifting);
    let rate = report.change_per_min.unwrap();
    assert!((rate - changing_per_min).abs() < 3.0 * report.change_per_min_error.unwrap(), "{rate}");
    // The noise is listened to for 0.2 s and some blocks before the first ping.
    let began = 0.2 + 10.0 * 128.0 / 48e3;
    for step in report.pings.iter().skip(1) {
        let truth = changed + changing_per_min * (began + step.time_s) / 60.0;
        assert!((step.change.unwrap() - truth).abs() < 3e-4, "{step:?}, in truth {truth}");
    }
}

#[test]
fn a_calibrated_sheet_is_followed_from_what_it_was() {
    let output = folder("measured");
    let device = DeviceAsk { unknowns: Some(7), ..DeviceAsk::default() };
    let surface = film();
    let ask = calibrate::Ask {
        surface: surface.clone(),
        device: device.clone(),
        output: output.clone(),
        ..calibrate::Ask::default()
    };
    calibrate::run(&ask, &mut Silent).unwrap();
    let library = SurfaceAsk::Name(output.display().to_string());
    for changed in [0.0, 0.005] {
        let ask =
            Ask { surface: library.clone(), device: device.clone(), seconds: 2.0, changed, ..Ask::default() };
        let report = asked(ask);
        assert_eq!(report.verdict, Verdict::Steady);
        assert!(off(&report, changed) < 3.0, "{} of its error off", off(&report, changed));
        assert!(report.change_error.unwrap() < 3e-3);
    }
    std::fs::remove_dir_all(&output).unwrap();
}

#[test]
fn what_has_no_model_is_refused_by_name() {
    let computed = folder("computed");
    let ask = respond::Ask { surface: film(), pitch_m: 0.05, length_s: Some(0.02), output: computed.clone() };
    respond::run(&ask, &mut Silent).unwrap();
    let from = Library::open(&computed).unwrap();
    let (plan, values) = (from.plan().clone(), from.get(0).unwrap());
    let refused = |name: &str, provenance: &[(&str, &str)]| {
        let place = folder(name);
        let said = provenance.iter().map(|(key, text)| ((*key).to_owned(), (*text).to_owned())).collect();
        let mut library = Library::create(&place, &LibraryPlan { provenance: said, ..plan.clone() }).unwrap();
        library.put(0, &values, &vec![Quality::UNKNOWN; plan.ports.len()]).unwrap();
        drop(library);
        let ask = Ask { surface: SurfaceAsk::Name(place.display().to_string()), ..Ask::default() };
        let error = drift::run(&ask, &mut Silent).unwrap_err();
        assert!(error.is_bad_input(), "{error}");
        std::fs::remove_dir_all(&place).unwrap();
        error.to_string()
    };
    let error = refused("probed", &[("device", "jack")]);
    assert!(error.contains("found 0 of them with sensors"), "{error}");
    let error = refused("fitted", &[("device", "fitted model"), ("fitted to", "no-such-library")]);
    assert!(error.contains("no-such-library"), "{error}");
    // One that was computed is followed by the file that it was computed from.
    let name = SurfaceAsk::Name(computed.display().to_string());
    let report = asked(Ask { surface: name, seconds: 1.2, changed: 0.01, ..Ask::default() });
    assert!(off(&report, 0.01) < 2.0 && report.against.contains("computed"));
    std::fs::remove_dir_all(&computed).unwrap();
}
