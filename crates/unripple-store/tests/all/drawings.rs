//! SVG drawings: known shapes in metres, and hostile documents.

use unripple_store::{Drawing, FillRule, Polyline};

/// A document of 100 x 50 mm in millimetre units.
fn document(body: &str) -> String {
    format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
        width="100mm" height="50mm" viewBox="0 0 100 50">{body}</svg>"#
    )
}

fn drawing(body: &str) -> Drawing {
    Drawing::parse(&document(body), "d.svg", 1e-6).unwrap()
}

fn refusal(text: &str) -> String {
    Drawing::parse(text, "d.svg", 1e-6).unwrap_err().to_string()
}

fn extent(piece: &Polyline) -> [f64; 4] {
    let xs = piece.points.iter().map(|p| p.x);
    let ys = piece.points.iter().map(|p| p.y);
    let (left, right) = (xs.clone().fold(f64::MAX, f64::min), xs.fold(f64::MIN, f64::max));
    let (bottom, top) = (ys.clone().fold(f64::MAX, f64::min), ys.fold(f64::MIN, f64::max));
    [left, right, bottom, top].map(|v| (v * 1e5).round() / 1e2)
}

#[test]
fn every_element_lands_where_it_should() {
    for (body, expected, closed) in [
        (r#"<rect x="10" y="5" width="20" height="8"/>"#, [10.0, 30.0, 37.0, 45.0], true),
        (r#"<circle cx="30" cy="20" r="10"/>"#, [20.0, 40.0, 20.0, 40.0], true),
        (r#"<ellipse cx="30" cy="20" rx="20" ry="10"/>"#, [10.0, 50.0, 20.0, 40.0], true),
        (r#"<polygon points="0,0 10,0 10,50"/>"#, [0.0, 10.0, 0.0, 50.0], true),
        (r#"<polyline points="0,0 10,0 10,50"/>"#, [0.0, 10.0, 0.0, 50.0], false),
        (r#"<line x1="1" y1="2" x2="3" y2="4" stroke="red"/>"#, [1.0, 3.0, 46.0, 48.0], false),
        (r#"<path d="M 10 10 q 10 -20 20 0 z"/>"#, [10.0, 30.0, 40.0, 50.0], true),
        (
            r#"<g transform="translate(50 10) scale(2)"><rect width="5" height="4"/></g>"#,
            [50.0, 60.0, 32.0, 40.0],
            true,
        ),
        (
            r##"<defs><rect id="r" width="5" height="4"/></defs><use xlink:href="#r" x="1" y="1"/>"##,
            [1.0, 6.0, 45.0, 49.0],
            true,
        ),
    ] {
        let drawing = drawing(body);
        assert_eq!(drawing.shapes.len(), 1, "{body}");
        let pieces = &drawing.shapes[0].polylines;
        assert_eq!((pieces.len(), pieces[0].closed), (1, closed), "{body}");
        assert_eq!(extent(&pieces[0]), expected, "{body}");
    }
}

#[test]
fn physical_size() {
    for (size, millimetres) in [
        (r#"width="4in" height="2in" viewBox="0 0 1000 500""#, 0.1016),
        (r#"width="96" height="48" viewBox="0 0 1000 500""#, 0.0254),
        (r#"viewBox="0 0 1000 500""#, 0.0254 * 1000.0 / 96.0),
        (r#"width="10cm" height="5cm" viewBox="0 0 1000 500""#, 0.1),
    ] {
        let text = format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" {size}><rect width="1000" height="500"/></svg>"#
        );
        let drawing = Drawing::parse(&text, "d.svg", 1e-6).unwrap();
        assert!((drawing.width - millimetres).abs() < 1e-7, "{size}: {}", drawing.width);
        let right = drawing.shapes[0].polylines[0].points.iter().map(|p| p.x).fold(0.0, f64::max);
        assert!((right - millimetres).abs() < 1e-7, "{size}: {right}");
    }
}

#[test]
fn paint() {
    let drawing = drawing(
        r#"<style>.thin { fill: none; stroke: black; stroke-width: 0.5px }</style>
        <path id="ring" fill-rule="evenodd" d="M0 0H30V30H0ZM10 10H20V20H10Z"/>
        <path class="thin" d="M0 0L10 10"/>
        <g transform="scale(3)"><rect width="2" height="2" fill="blue" stroke="red" stroke-width="2"/></g>
        <rect width="9" height="9" fill="none"/>
        <rect width="9" height="9" visibility="hidden"/>"#,
    );
    assert_eq!(drawing.shapes.len(), 3);
    let ring = &drawing.shapes[0];
    assert_eq!((ring.id.as_str(), ring.fill, ring.stroke_width), ("ring", Some(FillRule::EvenOdd), None));
    assert!(ring.polylines.len() == 2 && ring.polylines.iter().all(|p| p.closed && p.points.len() == 4));
    assert_eq!(drawing.shapes[1].fill, None);
    assert!((drawing.shapes[1].stroke_width.unwrap() - 0.5e-3).abs() < 1e-9);
    assert_eq!(drawing.shapes[2].fill, Some(FillRule::NonZero));
    assert!((drawing.shapes[2].stroke_width.unwrap() - 6e-3).abs() < 1e-8);
}

#[test]
fn what_is_no_drawing() {
    for (text, part) in [
        ("", "expected an SVG document"),
        ("<html/>", "expected an SVG document"),
        ("<svg xmlns=\"http://www.w3.org/2000/svg\"", "expected an SVG document"),
        (&document(""), "found no visible shape"),
        (&document("<text>hello</text>"), "turn text into paths"),
        (&document(r#"<path d="M0 0 L nan 3"/>"#), "found no visible shape"),
        (&document(r#"<path d="M0 0 L 1e30 3 L 3 9"/>"#), "expected coordinates of at most 100 m"),
        (
            &document(r##"<clipPath id="c"/><rect width="3" height="3" clip-path="url( '#c' )"/>"##),
            "<clipPath id=\"c\">",
        ),
        (
            &document(r##"<style>rect{mask:URL(#m)}</style><mask id="m"/><rect width="3" height="3"/>"##),
            "<mask",
        ),
        ("<!DOCTYPE svg [<!ENTITY a \"b\">]><svg xmlns=\"http://www.w3.org/2000/svg\"/>", "without entities"),
    ] {
        let error = refusal(text);
        assert!(error.contains(part), "{text}: {error}");
    }
}

#[test]
fn hostile_documents_fail_clearly() {
    let nested = |n: usize| document(&format!("{}{}", "<g>".repeat(n), "</g>".repeat(n)));
    assert!(refusal(&nested(10_000)).contains("nested at most 64 deep"));
    assert!(refusal(&nested(100_000)).contains("expected"));
    assert!(refusal(&document(&"<rect/>".repeat(30_000))).contains("expected an SVG document"));
    assert!(refusal(&" ".repeat((1 << 20) + 1)).contains("at most 1048576 bytes"));
    let laughs: String = (0..30)
        .map(|i| format!(r##"<g id="l{}"><use xlink:href="#l{i}"/><use xlink:href="#l{i}"/></g>"##, i + 1))
        .collect();
    assert!(
        refusal(&document(&format!("<rect id=\"l0\" width=\"1\" height=\"1\"/>{laughs}")))
            .contains("copy of a copy")
    );
    let ring = r##"<g id="a"><use xlink:href="#b"/></g><g id="b"><use xlink:href="#a"/></g>"##;
    assert!(refusal(&document(ring)).contains("copy of a copy"));
    let curves = "q 60 60 20 -40 -60 -60 -20 40 ".repeat(25_000);
    let text = document(&format!(r#"<path transform="scale(40)" d="M0 0 {curves}"/>"#));
    assert!(Drawing::parse(&text, "d.svg", 0.0).unwrap_err().to_string().contains("at most 1000000 points"));
    let attributes: String = (0..60_000).map(|i| format!(" a{i}=\"\"")).collect();
    assert!(refusal(&document(&format!("<rect{attributes}/>"))).contains("at most 200 attributes"));
    let rules = |n: usize| format!("<style>{}</style>", "g rect{fill:red}".repeat(n));
    assert!(refusal(&document(&format!("{}<rect/>", rules(2000)))).contains("at most 16384 bytes of style"));
    let many = format!("{}{}", rules(1000), "<rect width=\"1\" height=\"1\"/>".repeat(15_000));
    assert!(refusal(&document(&many)).contains("bytes of style sheets, given the number of elements"));
}
