//! A surface known by what its actuators hear of each other alone: calibrated without a probe, fitted, focused upon.

use crate::common;

use common::{Scratch, json, number, refused, run};
use unripple::core::{ActuatorKind, CoilDrive, ModalResponses, Point, Responses, Surface};
use unripple::field::Field;
use unripple::focus::{Focuser, Method, Options, Target};
use unripple::physics::{ResponseOptions, responses};
use unripple_devices::Perturbation;
use unripple_store::{Doubt, Library, load_surface, to_toml};

const WINDOW: f64 = 0.030;

/// The paper's film in a third of its band.
fn film() -> String {
    film_to(1000.0)
}

/// The paper's film up to a frequency (Hz). Up to 600 Hz a fit takes half as long as up to 1000 Hz; places of actuators are less certain.
fn film_to(hz: f64) -> String {
    let mut film = load_surface("hudin-2012").unwrap();
    film.emission.band[1] = hz;
    to_toml(&film)
}

/// The true responses behind a surface and a seed, its drives' gains included.
fn truth(surface: &Surface, seed: u64) -> ModalResponses {
    let truth = Perturbation { seed, ..Perturbation::default() }.truth(surface).unwrap();
    let options = ResponseOptions { accuracy: 1e-4.into(), ..ResponseOptions::default() };
    let Ok(Responses::Modal(mut modal)) = responses(&truth.surface, &options) else { unreachable!() };
    for (a, gain) in truth.drive_gains.iter().enumerate() {
        modal.input.row_mut(a).iter_mut().for_each(|w| *w *= gain);
    }
    modal
}

/// A list of a report, as one text.
fn said(report: &serde_json::Value, list: &str) -> String {
    let lines = report[list].as_array().into_iter().flatten().filter_map(|line| line.as_str());
    lines.collect::<Vec<_>>().join("\n")
}

/// What a run reports, whatever comes of it.
fn reported(arguments: &[&str]) -> serde_json::Value {
    let output = run(&[arguments, &["--json"]].concat());
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{arguments:?}: {error}: {}", String::from_utf8_lossy(&output.stderr)))
}

/// Peak over rms outside, on the true surface, of a drive made from some responses.
fn contrast(plant: &Responses, known: &Responses, method: Method, at: Point) -> f64 {
    let options = Options { method, window: WINDOW, ..Options::default() };
    let drive = Focuser::new(known, &options).unwrap().focus(&[Target::at(at)]).unwrap().drive.as_emitted();
    let field = Field::new(plant, &drive, 8.0).unwrap();
    let shot = &field.snapshots(&[WINDOW]).unwrap()[0];
    let peak = field.traces(&[at], WINDOW).unwrap()[0].velocity.last().copied().unwrap();
    let radius = 4.0 / 3.0 * plant.conditions().lambda_min;
    let outside = field.points().iter().zip(&shot.velocity).filter(|(p, _)| p.distance(at) > radius);
    let squares: Vec<f64> = outside.map(|(_, v)| f64::from(*v).powi(2)).collect();
    peak.abs() / (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

#[test]
fn actuators_alone_make_a_library_of_points_anywhere() {
    let scratch = Scratch::new("fit");
    let file = scratch.file("film.toml", film());
    let (heard, fitted) = (scratch.join("heard"), scratch.join("fitted"));
    let measured = json(&["calibrate", &file, "--unknowns", "7", "-o", &heard]);
    assert_eq!((number(&measured, "/probed"), number(&measured, "/measured")), (0.0, 8.0));

    let report = json(&["fit", &heard, "--grid-mm", "12", "--at", "62,90", "--at", "100,60", "-o", &fitted]);
    println!("{report:#}");
    assert_eq!(report["verdict"], "good");
    assert!(number(&report, "/written/points") > 100.0);
    let surface = load_surface(&file).unwrap();
    let told = Perturbation { seed: 7, ..Perturbation::default() }.truth(&surface).unwrap();
    for (n, actuator) in told.surface.actuators.iter().enumerate() {
        let c = |axis| number(&report, &format!("/actuators/{n}/at_m/{axis}/value"));
        assert!(Point::new(c(0), c(1)).distance(actuator.at) < 0.5e-3, "{}", actuator.name);
    }

    let plant = Responses::Modal(truth(&surface, 7));
    let library = Library::open(&fitted).unwrap();
    assert_eq!(library.plan().provenance["device"], "fitted model");
    let known = Responses::Sampled(library.responses().unwrap());
    for at in [Point::from_mm(62.0, 90.0), Point::from_mm(100.0, 60.0)] {
        for (method, least) in [(Method::TimeReversal, 0.95), (Method::Inverse, 0.85)] {
            let share = contrast(&plant, &known, method, at) / contrast(&plant, &plant, method, at);
            println!("{at}, {method:?}: {share:.3} of the contrast by true responses");
            assert!(share > least, "{at}, {method:?}: {share}");
        }
    }
    let focus = ["focus", &fitted, "--at", "62,90", "--window-ms", "30", "--on", &file, "-o"];
    let focus = json(&[&focus[..], &[&scratch.join("touch")]].concat());
    assert!(number(&focus, "/targets/0/contrast") > 1.0);
}

/// Two takes of a probe that were exchanged: the model is as good as ever, and is not corrected by them.
#[test]
fn probed_points_that_contradict_the_model_are_left_out_and_named() {
    let scratch = Scratch::new("fit-exchanged");
    let file = scratch.file("film.toml", film());
    let (heard, fitted) = (scratch.join("heard"), scratch.join("fitted"));
    let points = ["--at", "62,90", "--at", "100,60", "--at", "45,50"];
    json(&[&["calibrate", &file, "--unknowns", "7", "-o", &heard][..], &points].concat());
    let mut library = Library::open(&heard).unwrap();
    let (first, second) = (library.get(0).unwrap(), library.get(1).unwrap());
    for (point, samples) in [(0, &second), (1, &first)] {
        let quality = library.quality(point).unwrap();
        library.put(point, samples, &quality).unwrap();
    }
    drop(library);
    let report = json(&["fit", &heard, "--at", "62,90", "-o", &fitted]);
    println!("{report:#}");
    assert_eq!(report["verdict"], "good");
    let left_out: Vec<&str> =
        report["left_out"].as_array().unwrap().iter().filter_map(|v| v.as_str()).collect();
    assert_eq!(left_out.len(), 2, "{left_out:?}");
    assert!(left_out[0].starts_with("point 1:") && left_out[1].starts_with("point 2:"), "{left_out:?}");
    assert!(left_out.iter().all(|why| why.contains("exchanged")), "{left_out:?}");
    let plant = Responses::Modal(truth(&load_surface(&file).unwrap(), 7));
    let at = Point::from_mm(62.0, 90.0);
    let known = Responses::Sampled(Library::open(&fitted).unwrap().responses().unwrap());
    let contrast = |known| contrast(&plant, known, Method::TimeReversal, at);
    assert!(contrast(&known) > 0.97 * contrast(&plant));
}

/// Nobody can say how large what is fitted is, if nobody could of what was measured; and no model makes a dead actuator drive.
#[test]
fn an_unknown_scale_and_a_dead_actuator_stay_so() {
    let scratch = Scratch::new("fit-scale");
    let file = scratch.file("film.toml", film_to(600.0));
    let (heard, fitted) = (scratch.join("heard"), scratch.join("fitted"));
    json(&["calibrate", &file, "--unknowns", "7", "-o", &heard]);
    let mut library = Library::open(&heard).unwrap();
    let name = library.plan().ports[2].name.clone();
    library.log("scale", serde_json::json!({ "unknown": "level unknown until it is told" })).unwrap();
    library.log("dead", serde_json::json!([name])).unwrap();
    drop(library);
    // What cannot be heard of an actuator may be anything.
    reported(&["fit", &heard, "--at", "62,90", "--even-if-doubtful", "-o", &fitted]);
    let library = Library::open(&fitted).unwrap();
    assert_eq!(library.without_scale(), Some("level unknown until it is told"));
    assert_eq!(library.dead(), [2]);
    let responses = library.responses().unwrap();
    for actuator in 0..8 {
        let drives = responses.response(actuator, 0).iter().any(|h| *h != 0.0);
        assert_eq!(drives, actuator != 2, "actuator {}", actuator + 1);
    }
    drop(library);
    let focus = ["focus", &fitted, "--at", "62,90", "--window-ms", "30", "-o", &scratch.join("touch")];
    assert!(json(&focus).to_string().contains("level unknown until it is told"));
}

/// A library whose points have the probe's own delay, as those made without a model have.
#[test]
fn a_late_probe_is_moved_back_before_it_corrects_the_model() {
    let scratch = Scratch::new("fit-late");
    let file = scratch.file("film.toml", film());
    let (heard, fitted) = (scratch.join("heard"), scratch.join("fitted"));
    let points = ["--at", "62,90", "--at", "100,60", "--at", "45,50"];
    json(&[&["calibrate", &file, "--unknowns", "7", "-o", &heard][..], &points].concat());
    let mut library = Library::open(&heard).unwrap();
    let (before, samples) = (library.get(0).unwrap(), library.plan().samples);
    for point in 0..3 {
        let values = library.get(point).unwrap();
        let late = values.chunks_exact(samples).flat_map(|row| {
            let row: Vec<f64> = row.iter().map(|h| f64::from(*h)).collect();
            unripple_calibrate::signals::shift(&row, 48.0)
        });
        let late: Vec<f32> = late.map(|h| h as f32).collect();
        let quality = library.quality(point).unwrap();
        library.put(point, &late, &quality).unwrap();
    }
    drop(library);
    let report = json(&["fit", &heard, "--at", "62,90", "-o", &fitted]);
    println!("{report:#}");
    assert!(said(&report, "notes").contains("ms later than those of the sensors"));
    assert!(report.get("left_out").is_none(), "{report:#}");
    let blended = Library::open(&fitted).unwrap().get(0).unwrap();
    let (mut off, mut all) = (0.0, 0.0);
    for (before, now) in before.chunks_exact(samples).zip(blended.chunks_exact(samples)) {
        // What was moved beyond the end is lost.
        for (x, y) in before.iter().zip(now).take(samples - 100) {
            off += f64::from(x - y).powi(2);
            all += f64::from(*x).powi(2);
        }
    }
    assert!((off / all).sqrt() < 0.15, "off by {}", (off / all).sqrt());

    // Two actuators are not enough to check points by.
    let mut library = Library::open(&heard).unwrap();
    let names: Vec<String> = library.plan().ports[2..].iter().map(|port| port.name.clone()).collect();
    library.log("dead", serde_json::json!(names)).unwrap();
    drop(library);
    let report = reported(&["fit", &heard, "--strays", "0"]);
    assert!(said(&report, "notes").contains("not checked against the model"), "{report:#}");
}

/// What the inductance of a coil on a voltage makes of what it drives and hears is no latency, and belongs to what is fitted.
#[test]
fn coils_on_a_voltage_are_fitted_with_their_circuits() {
    let scratch = Scratch::new("fit-coils");
    let mut film = load_surface(&scratch.file("plain.toml", film())).unwrap();
    for actuator in &mut film.actuators {
        actuator.kind = ActuatorKind::MovingMagnet {
            force_constant: 0.1,
            resistance: 6.2,
            inductance: 1.9e-3,
            moving_mass: 5e-6,
            driven_by: CoilDrive::Voltage,
        };
    }
    let file = scratch.file("film.toml", to_toml(&film));
    let (heard, fitted) = (scratch.join("heard"), scratch.join("fitted"));
    let measured = json(&["calibrate", &file, "--unknowns", "7", "--at", "100,60", "-o", &heard]);
    assert!(!said(&measured, "notes").contains("later than those of the sensors"), "{measured:#}");
    let report = json(&["fit", &heard, "--at", "62,90", "--at", "100,60", "-o", &fitted]);
    println!("{report:#}");
    assert!(report["verdict"] == "good" && number(&report, "/unexplained") < 0.01, "{report:#}");
    assert!(!said(&report, "notes").contains("later than those of the sensors"), "{report:#}");
    let plant = Responses::Modal(truth(&film, 7));
    let known = Responses::Sampled(Library::open(&fitted).unwrap().responses().unwrap());
    for at in [Point::from_mm(62.0, 90.0), Point::from_mm(100.0, 60.0)] {
        let contrast = |known| contrast(&plant, known, Method::TimeReversal, at);
        let share = contrast(&known) / contrast(&plant);
        println!("{at}: {share:.3} of the contrast by true responses");
        assert!(share > 0.95, "{at}: {share}");
    }
}

/// What is doubted of a sensor leaves no point out.
#[test]
fn a_reversed_sensor_is_doubted_and_no_point_is_left_out_for_it() {
    let scratch = Scratch::new("fit-reversed");
    let file = scratch.file("film.toml", film_to(600.0));
    let heard = scratch.join("heard");
    json(&["calibrate", &file, "--unknowns", "7", "--at", "62,90", "-o", &heard]);
    let mut library = Library::open(&heard).unwrap();
    let (own, name) = (library.points().len() - 8 + 3, library.plan().ports[3].name.clone());
    let turned: Vec<f32> = library.get(own).unwrap().iter().map(|h| -h).collect();
    let quality = library.quality(own).unwrap();
    library.put(own, &turned, &quality).unwrap();
    drop(library);
    let report = reported(&["fit", &heard, "--strays", "0"]);
    println!("{report:#}");
    assert!(said(&report, "doubts").contains(&format!("sensor of `{name}` is reversed")), "{report:#}");
    assert!(!said(&report, "left_out").contains("sensor of"), "{report:#}");
}

/// With stray masses that it is not allowed to find, a model is doubtful: exit 1 and no library, unless it is asked for.
#[test]
fn a_doubtful_fit_writes_no_library_unless_asked() {
    let scratch = Scratch::new("fit-doubtful");
    let file = scratch.file("film.toml", film_to(600.0));
    let (heard, fitted) = (scratch.join("heard"), scratch.join("fitted"));
    json(&["calibrate", &file, "--unknowns", "7", "-o", &heard]);
    // What was doubted before, by checks of another name and of the fit's own; what is doubted of a point goes with the point.
    let of_all = [("reciprocity", "both ways differ"), ("fit", "an earlier fit was doubtful")];
    let mut library = Library::open(&heard).unwrap();
    for (check, what) in of_all {
        let of_point = Doubt::of(check, "a point is doubtful").at(vec![0]);
        library.set_doubts(check, vec![Doubt::of(check, what), of_point]).unwrap();
    }
    drop(library);
    let fit = ["fit", &heard, "--strays", "0", "--at", "62,90", "-o", &fitted];
    let said = |arguments: &[&str]| {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(1));
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    let without = said(&fit);
    assert!(without.contains("doubtful") && without.contains("--even-if-doubtful"), "{without}");
    assert!(!Library::is_at(&fitted));
    assert!(said(&[&fit[..], &["--even-if-doubtful"]].concat()).contains("doubtful"));
    let library = Library::open(&fitted).unwrap();
    let kept: Vec<(&str, &str)> =
        library.doubts().iter().map(|doubt| (doubt.check.as_str(), doubt.what.as_str())).collect();
    assert!(of_all.iter().all(|doubt| kept.contains(doubt)), "{kept:?}");
    let own =
        |(check, what): &&(&str, &str)| *check == "fit" && what.contains("the fitted model is doubtful");
    assert!(kept.iter().filter(own).count() == 1 && kept.len() == 3, "{kept:?}");
}

#[test]
fn what_cannot_be_fitted_is_refused() {
    let scratch = Scratch::new("fit-refused");
    let file = scratch.file("film.toml", film_to(600.0));
    assert!(refused(&["fit", &scratch.join("nothing")], 2).contains("expected a library"));
    let modelled = scratch.join("modelled");
    json(&["respond", &file, "--grid-mm", "50", "--length-ms", "10", "-o", &modelled]);
    assert!(refused(&["fit", &modelled], 2).contains("responses between"));
    assert!(refused(&["fit", &modelled, "--strays", "99"], 2).contains("--strays"));
    assert!(refused(&["fit", &modelled, "-o", &scratch.join("out")], 2).contains("--grid-mm"));
    assert!(refused(&["fit", &modelled, "--at", "1,1"], 2).contains("--output"));
}
