//! What a library says of its own making: kept, replaced check by check, believed only if it is whole; and libraries that grow.

use crate::library_common;

use library_common::{Folder, filled, plan, quality, samples};
use serde_json::json;
use std::collections::BTreeMap;
use std::fs;
use unripple_core::Point;
use unripple_store::{Doubt, Library, LibraryPlan, PointState};

#[test]
fn doubts_and_log_are_kept_check_by_check() {
    let folder = Folder::new("doubts");
    let plan = plan(4, 2, 9);
    let mut library = filled(&folder.0, &plan);
    assert!(library.doubts().is_empty() && library.logged("latency").is_none());
    assert!(!folder.0.join("calibration").exists(), "nothing was to be said");

    let far = Doubt::of("", "responses both ways differ by 80 %");
    library.set_doubts("reciprocity", vec![far]).unwrap();
    library
        .set_doubts("model", vec![Doubt::of("model", "point 3 is no place of the sheet").at(vec![2])])
        .unwrap();
    library.log("latency", json!({ "samples": 12.5 })).unwrap();
    library.log("dead", json!(["a2"])).unwrap();
    library.log("scale", json!({ "unknown": "--input-scale" })).unwrap();
    library.log_points(BTreeMap::from([(1, json!({ "hash": "00ff" })), (3, json!("x"))])).unwrap();

    let read = Library::open(&folder.0).unwrap();
    assert_eq!(read.doubts().len(), 2);
    assert_eq!((read.doubts()[0].check.as_str(), &read.doubts()[0].points[..]), ("model", &[2][..]));
    assert_eq!(read.doubts()[1].to_string(), "responses both ways differ by 80 %");
    assert_eq!(read.logged("latency").unwrap()["samples"], 12.5);
    assert_eq!((read.dead(), read.without_scale()), (vec![1], Some("--input-scale")));
    assert_eq!(read.logged_point(1).unwrap()["hash"], "00ff");
    assert!(read.verify().is_empty());

    // A check that runs again says all that it finds; others stay.
    library.set_doubts("model", Vec::new()).unwrap();
    library.log("scale", json!(null)).unwrap();
    let read = Library::open(&folder.0).unwrap();
    assert_eq!(read.doubts().len(), 1);
    assert_eq!(read.without_scale(), None);
    assert!(library.log_points(BTreeMap::from([(4, json!(1))])).is_err());

    library.log_points(BTreeMap::from([(1, json!({ "late": 3, "hash": null }))])).unwrap();
    assert_eq!(library.logged_point(1), Some(&json!({ "late": 3 })), "keys of their own");

    // A point that is to be measured anew is missing, for whoever opens it too.
    library.forget(&[1, 3]).unwrap();
    assert!(library.forget(&[4]).is_err());
    let read = Library::open(&folder.0).unwrap();
    assert_eq!((read.done(), read.in_state(PointState::Missing)), (vec![2], vec![0, 1, 3]));
    assert!(read.logged_point(1).is_none() && read.logged_point(3).is_none());
}

#[test]
fn a_damaged_record_is_a_doubt_of_its_own() {
    let folder = Folder::new("doubts-damaged");
    let mut library = filled(&folder.0, &plan(3, 2, 9));
    library.set_doubts("model", vec![Doubt::of("model", "point 1 is wrong")]).unwrap();
    drop(library);
    let file = folder.0.join("calibration/zarr.json");
    let text = fs::read_to_string(&file).unwrap();
    for broken in [text.replace("point 1 is wrong", "all is well"), "{".into(), String::new()] {
        fs::write(&file, broken).unwrap();
        let library = Library::open(&folder.0).unwrap();
        let doubts = library.doubts();
        assert!(doubts.len() == 1 && doubts[0].what.contains("cannot be read"), "{doubts:?}");
        assert_eq!(library.verify().len(), 1);
    }
    let mut library = Library::open(&folder.0).unwrap();
    assert_eq!(library.repair().unwrap().len(), 1);
    let library = Library::open(&folder.0).unwrap();
    assert!(library.verify().is_empty());
    assert!(library.doubts()[0].what.contains("cannot be read"), "what was lost stays in doubt");
}

#[test]
fn what_is_said_of_responses_goes_with_them() {
    let folder = Folder::new("doubts-lost");
    let mut library = filled(&folder.0, &plan(4, 2, 9));
    library
        .log_points(BTreeMap::from([
            (1, json!({ "model": { "delay_s": 1e-3 }, "said": null })),
            (2, json!({ "hash": "11" })),
        ]))
        .unwrap();
    assert_eq!(
        library.logged_point(1),
        Some(&json!({ "model": { "delay_s": 1e-3 } })),
        "nothing is kept as such"
    );
    library.set_doubts("model", vec![Doubt::of("model", "point 2 is wrong").at(vec![1])]).unwrap();
    drop(library);
    fs::write(folder.0.join("responses/c.1.0.0"), b"nothing").unwrap();

    let mut library = Library::open(&folder.0).unwrap();
    assert_eq!(library.repair().unwrap().len(), 1);
    let read = Library::open(&folder.0).unwrap();
    assert_eq!(read.state(1), Some(PointState::Missing));
    assert!(read.logged_point(1).is_none() && read.doubts().is_empty(), "{:?}", read.doubts());
    assert_eq!(read.logged_point(2), Some(&json!({ "hash": "11" })));
}

#[test]
fn a_library_grows_and_keeps_what_it_knows() {
    let folder = Folder::new("grow");
    let small = plan(300, 2, 9);
    let mut library = filled(&folder.0, &small);
    library.put_bad(0, &samples(&small, 0), &quality(&small, 0)).unwrap();
    library.set_reciprocity_error(0.03).unwrap();
    library.log_points(BTreeMap::from([(299, json!("own"))])).unwrap();
    library.set_doubts("model", vec![Doubt::of("model", "the last one").at(vec![299])]).unwrap();
    drop(library);

    // Two new points before the last of the old ones.
    let mut points = small.points.clone();
    points.insert(299, Point::from_mm(1.0, 2.0));
    points.insert(300, Point::from_mm(3.0, 4.0));
    let large = LibraryPlan { points, ..small.clone() };
    let known: Vec<Option<usize>> =
        (0..302).map(|i| if i < 299 { Some(i) } else { (i == 301).then_some(299) }).collect();
    let grown = Library::grow(&folder.0, &large, &known).unwrap();
    assert_eq!((grown.plan(), grown.in_state(PointState::Missing)), (&large, vec![299, 300]));
    assert_eq!(grown.in_state(PointState::Bad), [0]);
    assert_eq!(grown.get(301).unwrap(), samples(&small, 299));
    assert_eq!(grown.quality(301).unwrap(), quality(&small, 299));
    assert_eq!(grown.reciprocity_error().unwrap(), Some(0.03));
    assert_eq!(grown.logged_point(301), Some(&json!("own")));
    assert_eq!(grown.doubts()[0].points, [301]);
    assert!(grown.verify().is_empty() && !folder.0.join(".unripple").exists());
    // Nothing of the old one is left beside it, and it can be taken up.
    drop(grown);
    let above = folder.0.parent().unwrap();
    let own = folder.0.file_name().unwrap().to_str().unwrap().to_owned();
    let names = fs::read_dir(above).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
    assert_eq!(names.filter(|name| name.contains(&own)).collect::<Vec<_>>(), [own]);
    assert_eq!(Library::create(&folder.0, &large).unwrap().done().len(), 299);
    // One that somebody writes is left alone.
    let busy = Library::create(&folder.0, &large).unwrap();
    assert!(Library::grow(&folder.0, &large, &[]).is_err());
    drop(busy);
}
