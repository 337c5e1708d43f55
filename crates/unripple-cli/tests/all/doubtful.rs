//! Libraries that are doubtful: why, who is told, and what takes it back.

use crate::bench;
use crate::common;
use crate::elsewhere;

use bench::Bench;
use common::{number, run};
use elsewhere::{apart, bring, response};
use serde_json::Value;
use unripple::core::Point;
use unripple_store::{Doubt, Library};

/// The reasons for which a library is doubtful, as `calibrate` tells them.
fn doubts(told: &Value) -> Vec<&str> {
    told["doubtful"].as_array().unwrap().iter().map(|doubt| doubt.as_str().unwrap()).collect()
}

#[test]
fn doubts_are_told_by_every_command() {
    let mut bench = Bench::new("takes-doubts", 1, &[]);
    // Sensors that hear others as well contradict reciprocity, and no exchange of wires mends it.
    bench.bring_changed(1, |mut lines| {
        for (one, other) in [(1, 3), (0, 2)] {
            let other = lines[other].clone();
            lines[one].iter_mut().zip(other).for_each(|(x, y)| *x += 0.8 * y);
        }
        lines
    });
    let (output, told, said) = bench.calibrate(1, &["--no-model"]);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("is doubtful") && said.contains("between the two directions"), "{said}");
    assert!(told["doubtful"].to_string().contains("between the two directions"), "{told}");
    assert!(number(&told, "/reciprocity_error") > 0.15);
    assert!(told["notes"].to_string().contains("--no-model"), "{told}");

    let output = bench.focus(&["--json"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success() && said.contains("doubtful: the responses between actuators differ"),
        "{said}"
    );
    let focus: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(focus["notes"].to_string().contains("between the two directions"), "{focus}");
    let drive = format!("{}/drive.wav", bench.scratch.join("out"));
    let wav = bench.scratch.join("wav");
    let others = [
        vec!["field", &bench.library, "--drive", &drive, "--at", "52,47"],
        vec!["export", &bench.library, "-o", &wav],
        vec!["play", &bench.library, "--seconds", "0.1"],
    ];
    for command in others {
        let output = run(&[&command[..], &["--json"]].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && said.contains("doubtful: the responses"), "{command:?}: {said}");
        let told: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(told["notes"].to_string().contains("between the two directions"), "{command:?}: {told}");
    }

    // The log of the measurement is in the library.
    let library = Library::open(&bench.library).unwrap();
    let last = library.logged("runs").unwrap().as_array().unwrap().last().unwrap();
    assert!(last["software"].as_str().unwrap().starts_with("unripple ") && last["device"] == "tape");
    assert!(library.logged("takes").unwrap()["actuators.wav"]["hash"].is_string());
    drop(library);

    // Good recordings make it good again.
    bench.bring_all(1);
    let (output, told, said) = bench.calibrate(1, &[]);
    assert!(output.status.success() && told["doubtful"].as_array().unwrap().is_empty(), "{said}");
    // What is doubted elsewhere is told as well.
    let mut library = Library::open(&bench.library).unwrap();
    library.set_doubts("fit", vec![Doubt::of("fit", "the model contradicts itself")]).unwrap();
    drop(library);
    let said = bench.focus(&[]).stderr;
    assert!(String::from_utf8_lossy(&said).contains("the model contradicts itself"));
}

#[test]
fn nothing_but_a_new_recording_takes_back_what_a_model_said() {
    let mut bench = Bench::new("takes-exchanged", 3, &[]);
    bench.bring_all(3);
    let folder = bench.folder.clone();
    let [first, second, spare] =
        ["point-001.wav", "point-002.wav", "spare"].map(|name| format!("{folder}/{name}"));
    for (from, to) in [(&first, &spare), (&second, &first), (&spare, &second)] {
        std::fs::rename(from, to).unwrap();
    }
    let of = |told: &Value, point: usize| {
        doubts(told).iter().any(|doubt| doubt.starts_with(&format!("point {point}: ")))
    };
    let (output, told, said) = bench.calibrate(3, &[]);
    assert!(output.status.code() == Some(1) && of(&told, 1) && of(&told, 2) && !of(&told, 3), "{said}");

    // The same without a model: nothing is known better.
    let (output, told, said) = bench.calibrate(3, &["--no-model"]);
    assert!(output.status.code() == Some(1) && of(&told, 1) && of(&told, 2), "{said}");
    let said = String::from_utf8_lossy(&bench.focus(&[]).stderr).into_owned();
    assert!(said.contains("doubtful: point 1: "), "{said}");

    // What is recorded again is not that of before; whoever uses it is told that no model was asked.
    let heard = bench.hear(0, 12);
    bring(&folder, "point-001.wav", &heard);
    let (output, told, said) = bench.calibrate(3, &["--no-model"]);
    assert!(output.status.code() == Some(1) && !of(&told, 1) && of(&told, 2), "{said}");
    let heard = bench.hear(1, 13);
    bring(&folder, "point-002.wav", &heard);
    let (output, told, said) = bench.calibrate(3, &["--no-model"]);
    assert!(output.status.success() && doubts(&told).is_empty(), "{said}");
    let said = String::from_utf8_lossy(&bench.focus(&[]).stderr).into_owned();
    assert!(
        said.contains("not checked against a model (--no-model)") && !said.contains("doubtful"),
        "{said}"
    );

    // With one all is well, and nobody says otherwise when nothing is measured anew.
    for more in [vec![], vec!["--no-model"]] {
        let (output, told, said) = bench.calibrate(3, &more);
        assert!(output.status.success() && !told["notes"].to_string().contains("not checked"), "{said}");
    }
    // So it is with what is said of the latency.
    let mut library = Library::open(&bench.library).unwrap();
    library.set_doubts("latency", vec![Doubt::of("latency", "actuators disagree")]).unwrap();
    drop(library);
    let (output, told, said) = bench.calibrate(3, &["--no-model"]);
    assert!(output.status.code() == Some(1) && doubts(&told) == ["actuators disagree"], "{said}");
    let (output, told, said) = bench.calibrate(3, &[]);
    assert!(output.status.success() && doubts(&told).is_empty(), "{said}");
}

#[test]
fn a_library_without_what_actuators_hear_is_doubtful() {
    let mut bench = Bench::new("takes-own-refused", 1, &[]);
    bench.bring_all(1);
    // A sensor with hardly more than noise, in the actuators' own recording alone.
    let mut own = bench.surface.record(Point::from_mm(60.0, 50.0), 9_000, 1);
    let peak = own[1].iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let mut state = 1_u64;
    own[1].iter_mut().for_each(|x| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        *x += 0.7 * peak * ((state >> 11) as f64 / (1u64 << 52) as f64 - 1.0);
    });
    bring(&bench.folder, "actuators.wav", &own);
    let (output, told, said) = bench.calibrate(1, &[]);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("sensor of `a2`") && number(&told, "/measured") == 1.0, "{said}");
    assert!(doubts(&told).iter().any(|doubt| doubt.contains("points at a1, a2, a3, a4, a5")), "{told}");
    let output = bench.focus(&[]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("doubtful: the points at a1"));

    // Recorded again it is good.
    bench.bring_all(1);
    let (output, told, said) = bench.calibrate(1, &[]);
    assert!(output.status.success() && doubts(&told).is_empty(), "{said}");
}

#[test]
fn a_record_that_was_lost_is_written_anew_from_the_recordings() {
    let mut bench = Bench::new("takes-record", 1, &[]);
    bench.bring_all(1);
    assert!(bench.calibrate(1, &[]).0.status.success());
    let before = response(&bench.library, 0);
    std::fs::write(format!("{}/calibration/zarr.json", bench.library), "{").unwrap();
    let said = String::from_utf8_lossy(&bench.focus(&[]).stderr).into_owned();
    assert!(said.contains("doubtful: the record of its calibration cannot be read"), "{said}");

    // All is measured again by the same files, so that nothing is left to be doubted.
    let (output, told, said) = bench.calibrate(1, &[]);
    assert!(output.status.success() && doubts(&told).is_empty(), "{said}");
    assert!(apart(&response(&bench.library, 0), &before) < 1e-6);
}

#[test]
fn the_error_that_is_told_is_the_one_that_is_judged() {
    let mut bench = Bench::new("takes-gains", 1, &[]);
    // One sensor's gain is another: that is no error of reciprocity.
    bench.bring_changed(1, |mut lines| {
        lines[4].iter_mut().for_each(|x| *x *= 3.0);
        lines
    });
    let (output, told, said) = bench.calibrate(1, &[]);
    assert!(output.status.success(), "{said}");
    let judged = Library::open(&bench.library).unwrap().logged("reciprocity").unwrap()["error"].clone();
    assert_eq!(told["reciprocity_error"], judged);
    assert!(number(&told, "/reciprocity_error") < 0.05);
}
