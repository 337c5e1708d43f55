//! One test per kind of fault of a rim: edges, paths, drawings and holes.

use crate::good::{GOOD, fault, faults, says};
use unripple_store::{Fault, parse_surface_with};

const SHAPE: &str = "rectangle_mm = [150, 100]";
const EDGE: &str = "edge = \"clamped\"";

/// `key: expected, found` of the one fault of the good film with another shape.
fn shape(to: &str) -> String {
    let list = faults(&GOOD.replacen(SHAPE, to, 1).replace("[12, 31]", "[12, 10]"));
    assert_eq!(list.len(), 1, "{list:#?}");
    list[0].to_string()
}

/// Faults of the good film with holes.
fn with_holes(holes: &str) -> Vec<Fault> {
    faults(&format!("{GOOD}{holes}"))
}

/// The text of the one fault of the good film with one more hole.
fn hole(lines: &str) -> String {
    let list = with_holes(&format!("[[hole]]\n{lines}\n"));
    assert_eq!(list.len(), 1, "{list:#?}");
    list[0].to_string()
}

fn drawn(svg: &str, file: &str) -> Vec<Fault> {
    let svg = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200">{svg}</svg>"#
    );
    parse_surface_with(file, "film.toml", &|_| Ok(svg.clone()))
        .map_or_else(|f| f.faults().to_vec(), |_| Vec::new())
}

#[test]
fn lists_of_edges_fit_the_sides() {
    for (sides, count) in [("circle_mm = 50", 1), ("stadium_mm = [60, 50]", 4), ("stadium_mm = [0, 50]", 2)] {
        let list = |n: usize| {
            let edge = format!("edge = [{}]", ["\"free\""; 9][..n].join(", "));
            faults(&GOOD.replace(SHAPE, sides).replace(EDGE, &edge))
        };
        assert_eq!(list(count), []);
        let fault = list(count + 1)[0].to_string();
        let expected = format!(
            "outline.edge: expected one word, or a list of {count}, one per side from the bottom, anticlockwise, \
             found a list of {}",
            count + 1
        );
        assert_eq!(fault, expected);
    }
}

#[test]
fn springs() {
    assert_eq!(
        says(EDGE, "edge = { lift_n_per_mm2 = -1.0, tilt_n = 2 }"),
        "5:27: outline.edge.lift_n_per_mm2: expected a number from 0 to 1000000 N/mm², found -1.0 (nearest: 0)"
    );
    assert_eq!(fault(EDGE, "edge = { tilt_n = 2 }").key, "outline.edge.lift_n_per_mm2");
    let typo = fault(EDGE, "edge = { lift_n_per_mm = 1, lift_n_per_mm2 = 1 }");
    assert_eq!((typo.nearest.as_deref(), typo.line), (Some("lift_n_per_mm2"), 5));
    let side = fault(EDGE, "edge = [\"free\", { lift_n_per_mm2 = nan }, \"free\", \"free\"]");
    assert_eq!(side.key, "outline.edge[1].lift_n_per_mm2");
    assert_eq!(
        fault(EDGE, "edge = 3").to_string(),
        "outline.edge: expected \"clamped\", \"supported\", \"free\", or springs { lift_n_per_mm2 = …, tilt_n = … } or \
         { adhesive_young_mpa = …, … }, found 3"
    );
}

#[test]
fn nothing_keeps_the_sheet() {
    let limp = |edge: &str| {
        GOOD.replace("material = \"BoPET\"", "material = \"BoPET\"\nyoung_gpa = 0").replace(EDGE, edge)
    };
    let expected = "outline.edge: expected an edge that is clamped, supported or on springs with lift_n_per_mm2 above 0, or a \
        sheet with young_gpa above 0, found no edge fixed and no stiffness: nothing holds the sheet (nearest: \"clamped\")";
    for edge in ["edge = \"free\"", "edge = { lift_n_per_mm2 = 0, tilt_n = 9 }"] {
        let list = faults(&limp(edge));
        assert_eq!((list.len(), list[0].line, list[0].column), (1, 5, 8));
        assert_eq!(list[0].to_string(), expected);
        assert_eq!(faults(&GOOD.replace(EDGE, edge)), []);
        let pinned = "[[hole]]\nslit_mm = [[50, 50], [60, 60]]\nedge = \"supported\"\n";
        assert_eq!(faults(&format!("{}{pinned}", limp(edge))), []);
    }
    assert_eq!(faults(&limp("edge = [\"free\", \"free\", \"supported\", \"free\"]")), []);
    assert_eq!(faults(&limp("edge = { lift_n_per_mm2 = 0.1 }")), []);
}

#[test]
fn paths() {
    let rest = "[[120, 0], [120, 80]], [[120, 80], [80, 110], [40, 50], [0, 80]], [[0, 80], [0, 0]]";
    let path = |first: &str| shape(&format!("path_mm = [{first}, {rest}]"));
    let ends = "outline.path_mm: expected sides that meet end to end, the last also with the first, found side 0 that \
                ends at [110, 0] and side 1 that starts at [120, 0]";
    assert_eq!(path("[[0, 0], [110, 0]]"), ends);
    for (item, part) in [
        (
            "[[0, 0], [60, 5], [120, 0]]",
            "expected a side: a line [[x, y], [x, y]], a cubic curve of four points",
        ),
        ("[[0, 0], [120, nan]]", "outline.path_mm[0][1][1]: expected a number from -1000000 to 1000000 mm"),
        (
            "{ centre_mm = [60, 0], radius_mm = 60, start_deg = 180 }",
            "outline.path_mm[0].sweep_deg: expected",
        ),
        (
            "{ centre_mm = [60, 0], radius_mm = 60, start_deg = 180, sweep_deg = 0 }",
            "expected a number other than 0",
        ),
        ("{ centre_mm = [60, 0], radius_mm = 60, start_deg = 900, sweep_deg = 9 }", "(nearest: 720)"),
        ("[[0, 0], [0, 0]]", "expected a side with a length"),
        ("[[0, 0], [60, 120], [60, 120], [120, 0]]", "found sides 0 and 2 that cross or touch"),
        ("[[0, 0], [200, 70], [-80, 70], [120, 0]]", "found side 0 that crosses or touches itself"),
        ("[[0, 0], [60, -10], [60, -10], [120, 0]]", "whose bounding box starts at [0, -7.5] mm"),
    ] {
        assert!(path(item).contains(part), "{item}: {}", path(item));
    }
    let turned = "[[0, 0], [0, 80]], [[0, 80], [120, 80]], [[120, 80], [90, 20], [30, 30], [0, 0]]";
    assert!(shape(&format!("path_mm = [{turned}]")).contains("sides listed anticlockwise: reverse the list"));
    let flat = "[[0, 0], [60, 0], [90, 0], [120, 0]], [[120, 0], [0, 0]]";
    assert!(shape(&format!("path_mm = [{flat}]")).contains("found a path without area"));
    assert!(shape("path_mm = []").contains("expected a list, each item a side"));
    let many = "[[1, 2], [3, 4]], ".repeat(4097);
    assert!(shape(&format!("path_mm = [{many}]")).contains("expected at most 4096 sides"));
}

#[test]
fn drawings_of_rims() {
    let file = GOOD.replace(SHAPE, "svg = \"rim.svg\"");
    for (svg, part) in [
        (r#"<path d="M0 0H99V99L0 150L50 -9Z"/>"#, "sides 0 and 3 that cross or touch"),
        (r#"<path d="M0 99A50 50 0 0 1 100 99Q50 -150 0 99Z"/>"#, "sides 0 and 1 that cross or touch"),
        (
            r#"<path d="M0 0L100 0L50 0Z"/>"#,
            "expected a path that encloses something, found a path without area",
        ),
        (
            r#"<path fill="none" stroke="red" d="M0 0H99V99"/>"#,
            "expected closed paths, one around all others",
        ),
        (
            r#"<rect width="99" height="99"/><circle cx="150" cy="50" r="9"/>"#,
            "found a hole outside the outline",
        ),
        (
            r#"<rect width="99" height="99"/><circle cx="9" cy="50" r="9"/>"#,
            "hole that touches or crosses the rim",
        ),
        (
            r#"<rect width="99" height="99"/><circle cx="50" cy="50" r="9"/><circle cx="50" cy="50" r="5"/>"#,
            "found a hole within outline.svg",
        ),
    ] {
        let list = drawn(svg, &file);
        assert!(list.iter().any(|f| f.to_string().contains(part) && f.line == 4), "{svg}: {list:#?}");
    }
    let sides = "l1 1".repeat(4097);
    let list = drawn(&format!(r#"<path d="M0 0{sides}H0Z" transform="scale(0.01)"/>"#), &file);
    assert_eq!(list[0].to_string(), "outline.svg: expected at most 4096 sides, found 4099 sides");
    let circles: String = (0..300).map(|_| r#"<circle cx="50" cy="50" r="9"/>"#).collect();
    assert_eq!(drawn(&circles, &file)[0].expected, "at most 256 holes");
}

#[test]
fn holes_have_one_shape_and_a_place() {
    let (key, expected) =
        ("hole[0]", "exactly one of circle_mm, rectangle_mm, stadium_mm, polygon_mm, path_mm");
    assert!(hole("edge = \"free\"").starts_with(&format!("{key}: expected {expected}")));
    assert!(
        hole("circle_mm = 5\nslit_mm = [[1, 1], [2, 2]]")
            .contains("found hole[0].circle_mm and hole[0].slit_mm")
    );
    assert!(hole("circle_mm = 5").starts_with("hole[0].centre_mm: expected [x, y] in mm, found no such key"));
    assert!(
        hole("rectangle_mm = [5, 6]").starts_with("hole[0].at_mm: expected [x, y] in mm, of the lower-left")
    );
    assert!(
        hole("circle_mm = 5\ncentre_mm = [50, 50]\nat_mm = [45, 45]")
            .contains("expected exactly one of them")
    );
    let misplaced = hole("rectangle_mm = [5, 6]\nat_mm = [9, 9]\ncentre_mm = [50, 50]");
    assert!(
        misplaced.starts_with("hole[0].centre_mm: expected this key only beside circle_mm"),
        "{misplaced}"
    );
    assert!(hole("slit_mm = [[9, 9], [20, 20]]\nat_mm = [9, 9]").contains("this key not beside slit_mm"));
    assert!(hole("circle_mm = 5\ncentre_mm = [50, 50]\nwidth_mm = 1").contains("only beside slit_mm"));
    assert!(hole("circle_mm = 5\ncentre_mm = [50, 50]\nedeg = 1").contains("(nearest: edge)"));
    assert!(
        hole("circle_mm = 0.001\ncentre_mm = [50, 50]").contains("expected a number from 0.01 to 100000 mm")
    );
    assert!(hole("slit_mm = [[9, 9], [20, 20]]\nwidth_mm = 0").contains("(nearest: 0.01)"));
    assert!(
        hole("slit_mm = [[9, 9], [9, 9]]").contains("expected two different ends, found [[9, 9], [9, 9]]")
    );
    assert!(hole("slit_mm = 9").contains("[[x, y], [x, y]] in mm, the two ends"));
    assert!(hole("svg = \"a.svg\"\nat_mm = [9, 9]").contains("which `svg` is relative to"));
    assert_eq!(with_holes("[hole]\ncircle_mm = 5")[0].expected, "a list of tables, each headed [[hole]]");
}

#[test]
fn shapes_of_holes() {
    for (lines, part) in [
        ("polygon_mm = [[20, 20], [30, 30]]", "expected at least 3 vertices"),
        ("polygon_mm = [[20, 20], [30, 30], [40, 40]]", "found a polygon without area"),
        ("polygon_mm = [[20, 20], [30, 30], [30, 20], [20, 40]]", "found sides 0 and 2 that cross or touch"),
        ("polygon_mm = [[20, 20], [30, 30], [30, 20]]\nat_mm = [0, 0]", "starts at [20, 20] mm"),
        (
            "path_mm = [[[20, 20], [90, 60], [-30, 60], [40, 20]], [[40, 20], [20, 20]]]",
            "side 0 that crosses",
        ),
        (
            "path_mm = [[[20, 20], [30, 30]]]",
            "side 0 that ends at [30, 30] and side 0 that starts at [20, 20]",
        ),
        ("stadium_mm = [5]\nat_mm = [20, 20]", "expected [straight length, radius] in mm"),
        (
            "circle_mm = 5\ncentre_mm = [50, 50]\nedge = [\"free\", \"free\"]",
            "a list of 1, one per side from",
        ),
        (
            "polygon_mm = [[20, 20], [30, 30], [20, 40]]\nedge = [\"free\"]",
            "a list of 3, one per side in its own",
        ),
    ] {
        assert!(hole(lines).contains(part), "{lines}: {}", hole(lines));
    }
    let file = format!("{GOOD}[[hole]]\nsvg = \"a.svg\"\nat_mm = [20, 20]\n");
    let two = r#"<rect width="9" height="9"/><rect x="20" width="9" height="9"/>"#;
    assert_eq!(
        drawn(two, &file)[0].to_string(),
        "hole[0].svg: expected exactly one closed path, found 2 of them"
    );
}

#[test]
fn holes_lie_on_the_sheet_and_apart() {
    let circle = |x: f64, y: f64, r: f64| format!("[[hole]]\ncircle_mm = {r}\ncentre_mm = [{x}, {y}]\n");
    let found = |holes: &str| -> Vec<(usize, String)> {
        with_holes(holes).iter().map(|f| (f.line - 18, format!("{} {}", f.key, f.found))).collect()
    };
    let expected = "a hole inside the outline, at least 0.001 mm from its rim and from every other hole";
    assert_eq!(with_holes(&circle(200.0, 50.0, 9.0))[0].expected, expected);
    for (hole, what) in [
        (circle(200.0, 50.0, 9.0), "outside the outline"),
        (circle(5.0, 50.0, 9.0), "that touches or crosses the rim"),
        (circle(9.0, 50.0, 9.0), "that touches or crosses the rim"),
        (circle(9.0009, 50.0, 9.0), "that touches or crosses the rim"),
        (circle(75.0, 50.0, 400.0), "outside the outline"),
    ] {
        assert_eq!(found(&hole), [(2, format!("hole[0].circle_mm a hole {what}"))], "{hole}");
    }
    assert_eq!(found(&circle(9.002, 50.0, 9.0)), []);
    let pair = |second: String| found(&(circle(60.0, 50.0, 9.0) + &second));
    assert_eq!(pair(circle(80.0, 50.0, 9.0)), []);
    for (second, what) in [
        (circle(75.0, 50.0, 9.0), "that touches or overlaps hole[0]"),
        (circle(78.0, 50.0, 9.0), "that touches or overlaps hole[0]"),
        (circle(60.0, 50.0, 9.0), "that touches or overlaps hole[0]"),
        (circle(60.0, 52.0, 5.0), "within hole[0]"),
    ] {
        assert_eq!(pair(second), [(5, format!("hole[1].circle_mm a hole {what}"))]);
    }
    let around = found(&(circle(60.0, 50.0, 9.0) + &circle(60.0, 52.0, 30.0)));
    assert_eq!(around, [(2, "hole[0].circle_mm a hole within hole[1]".into())]);
    let slit = "[[hole]]\nslit_mm = [[10, 10], [80, 80]]\n";
    assert_eq!(found(&(circle(60.0, 50.0, 9.0) + slit)).len(), 1);
    assert_eq!(found(&format!("{}{slit}", circle(66.0, 40.0, 9.0))), []);
}

#[test]
fn things_in_holes() {
    let text = |at: &str| {
        format!("{}[[hole]]\nslit_mm = [[20, 20], [60, 60]]\nwidth_mm = 4\n", GOOD.replace("[12, 31]", at))
    };
    assert_eq!(faults(&text("[12, 31]")), []);
    let list = faults(&text("[40, 41]"));
    assert_eq!(
        list[0].to_string(),
        "actuator[0].at_mm: expected a point on the sheet: this one is in a hole, 1.293 mm from its rim, found [40, 41] \
         (nearest: [39.086, 41.915])"
    );
    assert_eq!((list.len(), list[0].line), (1, 17));
    assert_eq!(faults(&text("[39.086, 41.915]")), []);
    let scatterer =
        format!("{}[[scatterer]]\nkind = \"mass\"\nmass_mg = 1\nat_mm = [59, 61]\n", text("[9, 9]"));
    let list = faults(&scatterer);
    assert_eq!((list.len(), list[0].key.as_str()), (1, "scatterer[0].at_mm"));
    assert!(list[0].expected.contains("in a hole"));
}

#[test]
fn many_holes() {
    let hole = |i: usize| {
        format!("[[hole]]\ncircle_mm = 1\ncentre_mm = [{}, {}]\n", 20 + i % 32 * 4, 10 + i / 32 * 4)
    };
    let holes = |n: usize| (0..n).map(hole).collect::<String>();
    assert_eq!(with_holes(&holes(256)), []);
    let list = with_holes(&holes(257));
    assert_eq!((list.len(), list[0].found.as_str()), (1, "257 holes"));
    assert_eq!((list[0].expected.as_str(), list[0].nearest.as_deref()), ("at most 256 holes", Some("256")));
    let saw: String =
        (0..4000).map(|i| format!("[{}, {}],", 0.001 * f64::from(i), 0.05 * f64::from(i % 2))).collect();
    let saws: String = (0..5)
        .map(|i| format!("[[hole]]\npolygon_mm = [[4, 50], [0, 50], {saw}]\nat_mm = [{}, 20]\n", 20 + 10 * i))
        .collect();
    let list = with_holes(&saws);
    assert_eq!(list[0].expected, "at most 16384 sides of all rims together");
    assert_eq!((list.len(), list[0].key.as_str()), (1, "hole[4].polygon_mm"));
}
