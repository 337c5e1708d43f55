//! Curves of drawings: kept as they are, arcs of ellipses to a tenth of a micrometre.

use std::f64::consts::{PI, TAU};
use unripple_core::{Point, Side};
use unripple_store::{Curve, read_curves};

/// The curves of a drawing of 100 x 100 mm in millimetre units.
fn curves(body: &str) -> Vec<Curve> {
    let text = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">{body}</svg>"#
    );
    read_curves(&text, "d.svg").unwrap()
}

fn mm(x: f64, y: f64) -> Point {
    Point::from_mm(x, 100.0 - y)
}

/// Points all along a curve.
fn points(curve: &Curve) -> impl Iterator<Item = Point> {
    curve.sides.iter().flat_map(|side| (0..=40).map(|i| side.at(f64::from(i) / 40.0)))
}

#[test]
fn sides_are_kept() {
    let [curve] =
        curves(r#"<path d="M10 90 L60 90 C80 90 80 50 60 50 Q40 30 10 50 Z"/>"#).try_into().unwrap();
    assert_eq!((curve.sides.len(), curve.counts.as_slice(), curve.closed), (4, &[1, 1, 1, 1][..], true));
    let near = |a: &[Point], b: &[Point]| {
        assert!(a.iter().zip(b).all(|(a, b)| a.distance(*b) < 2e-8), "{a:?} {b:?}");
    };
    let [
        Side::Line { from, to },
        Side::Cubic(cubic),
        Side::Cubic(raised),
        Side::Line { from: last, to: start },
    ] = curve.sides[..]
    else {
        panic!("{curve:?}")
    };
    near(&[from, to, last, start], &[mm(10.0, 90.0), mm(60.0, 90.0), mm(10.0, 50.0), mm(10.0, 90.0)]);
    near(&cubic, &[mm(60.0, 90.0), mm(80.0, 90.0), mm(80.0, 50.0), mm(60.0, 50.0)]);
    // A quadratic curve with its handle at q is the cubic one with handles two thirds of the way to q.
    let third = |a: f64, q: f64| a + (q - a) / 1.5;
    let handles = [mm(third(60.0, 40.0), third(50.0, 30.0)), mm(third(10.0, 40.0), third(50.0, 30.0))];
    near(&raised, &[mm(60.0, 50.0), handles[0], handles[1], mm(10.0, 50.0)]);
}

#[test]
fn arcs_are_followed_within_a_tenth_of_a_micrometre() {
    // On a circle: distance from its centre. Aslant: a circle turned and stretched by a transform.
    for body in [
        r#"<circle cx="50" cy="50" r="40"/>"#,
        r#"<path d="M10 50A40 40 0 0 1 90 50A40 40 0 0 1 10 50"/>"#,
        r#"<path d="M50 90a40 40 0 1 1 40 -40a40 40 0 0 1 -40 40z"/>"#,
        r#"<path transform="translate(50 50) scale(40)" d="M-1 0A1 1 0 0 0 1 0A1 1 0 1 0 -1 0z"/>"#,
        r#"<ellipse cx="5" cy="5" rx="4" ry="4" transform="scale(10)"/>"#,
    ] {
        let [curve] = curves(body).try_into().unwrap();
        assert!(curve.closed && curve.counts.iter().sum::<usize>() == curve.sides.len());
        let off = points(&curve).map(|p| (p.distance(mm(50.0, 50.0)) - 0.04).abs()).fold(0.0, f64::max);
        assert!(off < 1e-7, "{body}: {off:e}");
        assert!(curve.sides.len() <= 24, "{body}: {}", curve.sides.len());
    }
    let [aslant] =
        curves(r#"<ellipse rx="30" ry="10" transform="translate(50 50) rotate(30)"/>"#).try_into().unwrap();
    let (sin, cos) = (PI / 6.0).sin_cos();
    let off = points(&aslant).map(|p| {
        let (x, y) = (p.x - 0.05, 0.05 - p.y);
        let (u, v) = ((x * cos + y * sin) / 0.03, (y * cos - x * sin) / 0.01);
        (u.hypot(v) - 1.0).abs() * 0.01
    });
    assert!(off.fold(0.0, f64::max) < 1e-7);
}

#[test]
fn an_arc_is_one_side_and_a_circle_four() {
    let count = |body: &str| curves(body)[0].counts.len();
    assert_eq!(count(r#"<path d="M10 50A40 40 0 0 1 90 50Z"/>"#), 2);
    assert_eq!(count(r#"<path d="M10 50A40 40 0 1 1 50 90L20 90A10 10 0 0 1 10 80Z"/>"#), 4);
    assert_eq!(count(r#"<circle cx="50" cy="50" r="40"/>"#), 4);
    assert_eq!(count(r#"<rect width="50" height="50" rx="10"/>"#), 8);
    assert_eq!(count(r#"<rect width="50" height="50"/>"#), 4);
    // Without radius an arc is a line; lines drawn as curves are lines.
    assert!(
        curves(r#"<path d="M10 50A0 40 0 0 1 90 50C80 60 60 80 50 90Z"/>"#)[0]
            .sides
            .iter()
            .all(Side::is_straight)
    );
}

/// A rounded rectangle's length against its closed form.
#[test]
fn round_corners() {
    let curve = &curves(r#"<rect x="10" y="20" width="50" height="30" rx="10"/>"#)[0];
    let length: f64 = curve.sides.iter().map(Side::length).sum();
    let straight = 2.0 * (0.03 + 0.01);
    // Nowhere off by more than 1e-7 m, so not by more than a turn of that.
    assert!((length - straight - TAU * 0.01).abs() < TAU * 1e-7, "{length}");
}

#[test]
fn several_curves_open_and_closed() {
    let list = curves(
        r#"<path d="M10 10H50V50H10ZM20 20H30V30Z" stroke="red"/><path fill="none" stroke="red" d="M1 1H9"/>"#,
    );
    let closed: Vec<(usize, bool)> = list.iter().map(|c| (c.sides.len(), c.closed)).collect();
    assert_eq!(closed, [(4, true), (3, true), (1, false)]);
    // Back at the start without being told to close; a last step too short to be a side.
    let back = &curves(r#"<path d="M10 10H50V50L10 10"/>"#)[0];
    assert_eq!((back.sides.len(), back.closed), (3, true));
    let short = &curves(r#"<path d="M10 10H50V50L10.00001 10.00001Z"/>"#)[0];
    assert_eq!((short.sides.len(), short.closed), (3, true));
    assert_eq!(short.sides[2].at(1.0), short.sides[0].at(0.0));
}

#[test]
fn what_is_no_drawing() {
    for (text, part) in [
        ("", "expected an SVG document"),
        ("<svg xmlns=\"http://www.w3.org/2000/svg\"/>", "no visible shape"),
        (
            "<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M0 0A1 1e30 0 0 1 3 3Z\"/></svg>",
            "at most 100 m",
        ),
        (
            "<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M0 0A1 nan 0 0 1 3 3Z\"/></svg>",
            "no visible shape",
        ),
    ] {
        let error = read_curves(text, "d.svg").unwrap_err().to_string();
        assert!(error.contains(part), "{text}: {error}");
    }
    let many = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M0 0{}"/></svg>"#,
        "l1 1-1-1".repeat(50_000)
    );
    assert!(read_curves(&many, "d.svg").unwrap_err().to_string().contains("at most 65536 sides"));
}
