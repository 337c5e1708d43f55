//! A library gives back what was put into it, refuses what it is not, and takes up where it was left.

use crate::library_common;

use library_common::{Folder, plan, quality, samples};
use std::fs;
use unripple_core::{Edge, Edges, Hole, Outline, Point, Shape, Side};
use unripple_store::{Library, LibraryPlan, PointState, Quality, StoreError, load_surface};

#[test]
fn gives_back_what_was_put() {
    let folder = Folder::new("back");
    let plan = plan(600, 3, 17);
    let mut library = Library::create(&folder.0, &plan).unwrap();
    assert!(library.done().is_empty() && library.nearest(Point::default()).is_none());
    for point in [599, 0, 256, 300] {
        library.put(point, &samples(&plan, point), &quality(&plan, point)).unwrap();
    }
    library.put_bad(7, &samples(&plan, 7), &quality(&plan, 7)).unwrap();
    library.set_reciprocity_error(0.0125).unwrap();

    let read = Library::open(&folder.0).unwrap();
    assert_eq!(read.plan(), &plan);
    assert_eq!(read.done(), [0, 256, 300, 599]);
    assert_eq!(read.in_state(PointState::Bad), [7]);
    assert_eq!(read.reciprocity_error().unwrap(), Some(0.0125));
    for point in [0, 7, 256, 300, 599] {
        assert_eq!(read.get(point).unwrap(), samples(&plan, point));
        assert_eq!(read.quality(point).unwrap(), quality(&plan, point));
    }
    assert!(read.quality(8).unwrap().iter().all(|q| q.coherence.is_nan()));
    assert!(read.get(8).unwrap_err().to_string().contains("c.8.0.0"));
    assert!(read.get(600).is_err() && read.quality(600).is_err());
    assert_eq!(read.nearest(plan.points[255]), Some(256));
    let responses = read.responses().unwrap();
    assert_eq!(responses.points, [0, 256, 300, 599].map(|p| plan.points[p]));
    assert_eq!(responses.response(2, 3), &samples(&plan, 599)[34..]);
    assert_eq!((responses.ports, responses.conditions), (plan.ports.clone(), plan.conditions.clone()));
    assert!(read.verify().is_empty());
}

#[test]
fn keeps_surface_and_every_outline() {
    let film = load_surface("hudin-2012").unwrap();
    let line =
        |x: f64, y: f64, to: (f64, f64)| Side::Line { from: Point::new(x, y), to: Point::new(to.0, to.1) };
    let curve = [(0.1, 0.1), (0.08, 0.13), (0.02, 0.12), (0.0, 0.1)].map(|(x, y)| Point::new(x, y));
    let sides = vec![
        line(0.0, 0.0, (0.1, 0.0)),
        line(0.1, 0.0, (0.1, 0.1)),
        Side::Cubic(curve),
        line(0.0, 0.1, (0.0, 0.0)),
    ];
    let elastic = Edge::Elastic { lift: 1e5 / 3.0, tilt: 0.1 + 0.2 };
    let corners = [(0.0, 0.0), (0.12, 0.0), (0.09, 0.08)].map(|(x, y)| Point::new(x, y)).to_vec();
    let outlines = [
        Outline::new(Shape::Circle { radius: 0.07 }).with_edges(Edges::All(elastic)),
        Outline::new(Shape::Stadium { straight: 0.06, radius: 0.04 }),
        Outline::new(Shape::Polygon(corners)).with_edges(Edges::PerSide(vec![
            Edge::Free,
            Edge::Clamped,
            Edge::Supported,
        ])),
        Outline::new(Shape::Path(sides)),
        Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 }).with_hole(Hole::slit(
            Point::new(0.12, 0.02),
            Point::new(0.17, 0.07),
            1e-3,
        )),
    ];
    for outline in outlines {
        let folder = Folder::new("outline");
        let mut plan = plan(2, 1, 4);
        plan.conditions.outline = outline;
        plan.conditions.lambda_min = 0.014_553_221_987_654_321;
        plan.surface = Some(film.clone());
        plan.onset = 1e-4 / 3.0;
        plan.provenance.insert("stimulus".into(), "sweep \"20–3000 Hz\"\n".into());
        Library::create(&folder.0, &plan).unwrap();
        assert_eq!(Library::open(&folder.0).unwrap().plan(), &plan);
    }
}

#[test]
fn gathered_responses_begin_at_the_impulse() {
    let folder = Folder::new("onset");
    let mut plan = plan(2, 2, 8);
    plan.onset = 3.2 / 48e3;
    let mut library = Library::create(&folder.0, &plan).unwrap();
    library.put(1, &samples(&plan, 1), &quality(&plan, 1)).unwrap();
    assert_eq!(library.get(1).unwrap(), samples(&plan, 1));
    let gathered = library.responses().unwrap();
    assert_eq!(gathered.samples(), 5);
    assert_eq!(gathered.response(1, 0), &samples(&plan, 1)[11..]);
}

#[test]
fn takes_up_the_same_plan_and_no_other() {
    let folder = Folder::new("resume");
    let mut first = plan(4, 2, 8);
    first.provenance.insert("created".into(), "Monday".into());
    let mut library = Library::create(&folder.0, &first).unwrap();
    library.put(2, &samples(&first, 2), &quality(&first, 2)).unwrap();

    // Two processes cannot write at once.
    let second = Library::create(&folder.0, &first).unwrap_err();
    assert!(
        matches!(&second, StoreError::Occupied { found, .. } if found.contains("another process")),
        "{second}"
    );
    drop(library);

    let mut later = first.clone();
    later.provenance.insert("created".into(), "Tuesday".into());
    assert_eq!(Library::create(&folder.0, &later).unwrap().done(), [2]);

    type Change = (&'static str, fn(&mut LibraryPlan));
    let changes: [Change; 7] = [
        ("samples: 8 instead of 9", |p| p.samples = 9),
        ("actuator 2: `a2`", |p| p.ports[1].name = "b".into()),
        ("point 4: (", |p| p.points[3].x += 1e-9),
        ("points: 4 instead of 3", |p| p.points.truncate(3)),
        ("sample rate in Hz: 48000 instead of 44100", |p| p.conditions.rate = 44.1e3),
        ("outline", |p| p.conditions.outline = Outline::new(Shape::Circle { radius: 0.1 })),
        ("provenance `device`: nothing instead of `card`", |p| {
            p.provenance.insert("device".into(), "card".into());
        }),
    ];
    for (told, change) in changes {
        let mut other = first.clone();
        change(&mut other);
        let error = Library::create(&folder.0, &other).unwrap_err();
        assert!(matches!(&error, StoreError::Occupied { found, .. } if found.contains(told)), "{error}");
    }
    assert_eq!(Library::open(&folder.0).unwrap().done(), [2]);
}

#[test]
fn leaves_what_is_not_its_own() {
    let folder = Folder::new("foreign");
    fs::create_dir(&folder.0).unwrap();
    fs::write(folder.0.join("thesis.tex"), "x").unwrap();
    let plan = plan(1, 1, 1);
    assert!(matches!(Library::create(&folder.0, &plan), Err(StoreError::Occupied { .. })));
    fs::write(folder.0.join("zarr.json"), r#"{"zarr_format":3,"node_type":"group","attributes":{}}"#)
        .unwrap();
    assert!(matches!(Library::create(&folder.0, &plan), Err(StoreError::Content { .. })));
    assert!(matches!(Library::open(&folder.0), Err(StoreError::Content { .. })));
    fs::remove_file(folder.0.join("zarr.json")).unwrap();
    fs::remove_file(folder.0.join("thesis.tex")).unwrap();
    Library::create(&folder.0, &plan).unwrap();
    let file = folder.0.join("zarr.json");
    assert!(matches!(Library::create(&file, &plan), Err(StoreError::Occupied { .. })));
}

#[test]
fn refuses_plans_and_responses_that_do_not_fit() {
    let folder = Folder::new("unfit");
    let changes: [fn(&mut LibraryPlan); 13] = [
        |p| p.ports.clear(),
        |p| p.points.clear(),
        |p| p.samples = 0,
        |p| p.samples = 1 << 40,
        |p| p.drive_units.clear(),
        |p| p.ports[1].name = "a1".into(),
        |p| p.points[0].x = f64::NAN,
        |p| p.conditions.rate = 0.0,
        |p| p.conditions.rate = 44_100.5,
        |p| p.conditions.band = [3e3, 3e3],
        |p| p.conditions.lambda_min = f64::INFINITY,
        |p| p.onset = f64::NAN,
        |p| p.conditions.outline = Outline::new(Shape::Polygon(Vec::new())),
    ];
    for change in changes {
        let mut bad = plan(2, 2, 4);
        change(&mut bad);
        let error = Library::create(&folder.0, &bad).unwrap_err();
        assert!(matches!(error, StoreError::Content { .. }) && !folder.0.exists(), "{error}");
    }
    let plan = plan(2, 2, 4);
    let mut library = Library::create(&folder.0, &plan).unwrap();
    let known = [Quality::UNKNOWN; 2];
    assert!(library.put(2, &[0.0; 8], &known).is_err());
    assert!(library.put(0, &[0.0; 7], &known).is_err());
    assert!(library.put(0, &[0.0; 8], &known[..1]).is_err());
    assert!(library.put(0, &[f32::NAN; 8], &known).is_err());
    assert!(library.done().is_empty() && Library::open(&folder.0).unwrap().done().is_empty());
}

#[test]
fn exports_wav() {
    let folder = Folder::new("wav");
    let plan = plan(12, 2, 5);
    let mut library = Library::create(&folder.0, &plan).unwrap();
    for point in [3, 11] {
        library.put(point, &samples(&plan, point), &quality(&plan, point)).unwrap();
    }
    let out = Folder::new("wav-out");
    library.export_wav(&out.0).unwrap();
    assert!(library.export_wav(&out.0).unwrap().replaced);
    let wav = unripple_store::read_wav(out.0.join("point-11.wav")).unwrap();
    let values: Vec<f32> = wav.channels.concat().iter().map(|x| *x as f32).collect();
    assert_eq!((values, wav.rate), (samples(&plan, 11), 48e3));
    let text = fs::read_to_string(out.0.join("library.json")).unwrap();
    let told: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(told["files"][0]["file"], "point-03.wav");
    assert_eq!(told["files"][1]["at_m"][0], plan.points[11].x);
    assert_eq!(fs::read_dir(&out.0).unwrap().count(), 4);
}
