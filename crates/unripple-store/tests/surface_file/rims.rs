//! What rims and holes of a file mean, and the way back.

use crate::good::GOOD;
use std::f64::consts::{FRAC_PI_2, PI};
use unripple_core::{Edge, Edges, Hole, Outline, Point, Shape, Side};
use unripple_store::{parse_surface, parse_surface_with, to_toml};

/// The outline of the good film with another shape, edges and holes; it comes back from its own file.
fn outline(shape: &str, edge: &str, holes: &str) -> Outline {
    drawn(shape, edge, holes, "")
}

fn drawn(shape: &str, edge: &str, holes: &str, svg: &str) -> Outline {
    let text = GOOD
        .replace("rectangle_mm = [150, 100]", shape)
        .replace("edge = \"clamped\"", edge)
        .replace("[12, 31]", "[60, 3]");
    let svg = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200">{svg}</svg>"#
    );
    let read = parse_surface_with(&(text + holes), "film.toml", &|_| Ok(svg.clone()));
    let surface = read.unwrap_or_else(|faults| panic!("{faults:#}"));
    let back = to_toml(&surface);
    assert_eq!(parse_surface(&back, "copy.toml").unwrap_or_else(|f| panic!("{f:#}\n{back}")), surface);
    surface.outline
}

fn p(x: f64, y: f64) -> Point {
    Point::from_mm(x, y)
}

const SPRING: Edge = Edge::Elastic { lift: 0.5e6, tilt: 2.0 };

#[test]
fn edges_of_every_shape() {
    let list = "edge = [{ lift_n_per_mm2 = 0.5, tilt_n = 2 }, \"free\"]";
    let two = outline("stadium_mm = [0, 60]", list, "");
    assert_eq!(two.edges, Edges::PerSide(vec![SPRING, Edge::Free]));
    let one = outline("circle_mm = 60", "edge = [{ lift_n_per_mm2 = 0.5, tilt_n = 2 }]", "");
    assert_eq!(one.edges, Edges::PerSide(vec![SPRING]));
    let all = outline("circle_mm = 60", "edge = { lift_n_per_mm2 = 1e-3 }", "");
    assert_eq!(all.edges, Edges::All(Edge::Elastic { lift: 1e3, tilt: 0.0 }));
}

#[test]
fn a_path_of_every_kind_of_side() {
    let path = "path_mm = [[[0, 0], [120, 0]], [[120, 0], [120, 80]],
        { centre_mm = [90, 80], radius_mm = 30, start_deg = 0, sweep_deg = 90 },
        [[90, 110], [60, 110], [60, 60], [0, 60]], [[0, 60], [0, 0]]]";
    let read = outline(path, "edge = [\"free\", \"free\", \"supported\", \"free\", \"free\"]", "");
    let Shape::Path(sides) = &read.shape else { panic!("{read:?}") };
    assert_eq!(sides[2], Side::Arc { centre: p(90.0, 80.0), radius: 0.03, start: 0.0, sweep: FRAC_PI_2 });
    assert_eq!(sides[3], Side::Cubic([p(90.0, 110.0), p(60.0, 110.0), p(60.0, 60.0), p(0.0, 60.0)]));
    assert_eq!(read.edge(2), Edge::Supported);
    assert_eq!(sides.len(), 5);
}

#[test]
fn holes_are_where_the_file_says() {
    let holes = "
[[hole]]
circle_mm = 6.1
centre_mm = [20.3, 75.7]
[[hole]]
rectangle_mm = [12, 8]
at_mm = [95, 30]
edge = [\"free\", \"clamped\", { lift_n_per_mm2 = 0.5, tilt_n = 2 }, \"free\"]
[[hole]]
slit_mm = [[110, 50.1], [140, 85.3]]
edge = \"supported\"
[[hole]]
slit_mm = [[30, 12], [90, 12]]
width_mm = 0.01
[[hole]]
polygon_mm = [[30, 40], [33, 52], [42, 44]]
edge = [\"free\", \"clamped\", \"supported\"]
[[hole]]
stadium_mm = [10, 3]
at_mm = [60, 50]
[[hole]]
path_mm = [[[60, 30], [60, 40], [70, 40], [70, 30]], [[70, 30], [60, 30]]]
edge = [\"clamped\", \"free\"]
[[hole]]
circle_mm = 2
at_mm = [10.7, 10.1]
";
    let read = outline("rectangle_mm = [150, 100]", "edge = \"clamped\"", holes);
    let by = |shape, x, y| Hole::new(&shape, p(x, y));
    assert_eq!(read.holes.len(), 8);
    let circle = &read.holes[0];
    assert_eq!((circle.sides.len(), circle.edges.clone()), (1, Edges::All(Edge::Free)));
    assert!(circle.at.distance(p(14.2, 69.6)) < 1e-15);
    let rectangle = by(Shape::Rectangle { width: 0.012, height: 0.008 }, 95.0, 30.0);
    assert_eq!(read.holes[1].sides, rectangle.sides);
    assert_eq!(read.holes[1].edges, Edges::PerSide(vec![Edge::Free, Edge::Clamped, SPRING, Edge::Free]));
    let slit = Hole::slit(p(110.0, 50.1), p(140.0, 85.3), 0.2e-3);
    assert_eq!(read.holes[2], Hole { edges: Edges::All(Edge::Supported), ..slit });
    assert_eq!(read.holes[3], Hole::slit(p(30.0, 12.0), p(90.0, 12.0), 1e-5));
    // Listed clockwise: turned, and the edges with it.
    let turned: Vec<Point> = read.holes[4].sides().iter().map(|side| side.at(0.0)).collect();
    assert!(
        turned.iter().zip([p(30.0, 40.0), p(42.0, 44.0), p(33.0, 52.0)]).all(|(a, b)| a.distance(b) < 1e-15)
    );
    assert_eq!(read.holes[4].edges, Edges::PerSide(vec![Edge::Supported, Edge::Clamped, Edge::Free]));
    assert_eq!(read.holes[5], by(Shape::Stadium { straight: 0.01, radius: 0.003 }, 60.0, 50.0));
    let curved = &read.holes[6];
    assert_eq!(curved.at, p(60.0, 30.0));
    assert!(curved.sides[0].is_straight() && curved.sides[0].at(1.0).distance(p(10.0, 0.0)) < 1e-15);
    assert_eq!(curved.edges, Edges::PerSide(vec![Edge::Free, Edge::Clamped]));
    assert_eq!(read.holes[7], by(Shape::Circle { radius: 0.002 }, 10.7, 10.1));
}

#[test]
fn files_are_written_as_people_would() {
    let text = GOOD.to_owned()
        + "[[hole]]\ncircle_mm = 6.1\ncentre_mm = [20.3, 75.7]\n\
           [[hole]]\nslit_mm = [[110, 50.1], [140, 85.3]]\nwidth_mm = 0.3\n\
           [[hole]]\nrectangle_mm = [12, 8]\nat_mm = [95, 30]\nedge = \"clamped\"\n";
    let back = to_toml(&parse_surface(&text, "film.toml").unwrap());
    for part in [
        "[[hole]]\ncircle_mm = 6.1\ncentre_mm = [20.3, 75.7]\nedge = \"free\"\n",
        "[[hole]]\nslit_mm = [[110, 50.1], [140, 85.3]]\nwidth_mm = 0.3\nedge = \"free\"\n",
        "[[hole]]\nrectangle_mm = [12, 8]\nat_mm = [95, 30]\nedge = \"clamped\"\n",
    ] {
        assert!(back.contains(part), "{back}");
    }
}

#[test]
fn drawings_keep_their_curves() {
    let drawing = r#"<path d="M20 180H140A40 40 0 0 0 140 100H20Z"/>"#;
    let edge = "edge = [\"clamped\", \"free\", \"supported\", { lift_n_per_mm2 = 0.5, tilt_n = 2 }]";
    let read = drawn("svg = \"a.svg\"", edge, "", drawing);
    let Shape::Path(sides) = &read.shape else { panic!("{read:?}") };
    let exact = 0.12 * 0.08 + PI * 0.04 * 0.04 / 2.0;
    assert!((read.area() - exact).abs() < 1e-8, "{}", read.area() - exact);
    assert_eq!(sides.iter().filter(|side| side.is_straight()).count(), 3);
    for (i, side) in sides.iter().enumerate() {
        let expected = match side {
            Side::Cubic(_) => Edge::Free,
            _ if side.at(0.5).y < 1e-6 => Edge::Clamped,
            _ if side.at(0.5).x < 1e-6 => SPRING,
            _ => Edge::Supported,
        };
        assert_eq!(read.edge(i), expected, "{i}");
    }
    // Drawn the other way round, the edges go with their sides.
    let other = r#"<path d="M20 180V100H140A40 40 0 0 1 140 180Z"/>"#;
    let edge = "edge = [{ lift_n_per_mm2 = 0.5, tilt_n = 2 }, \"supported\", \"free\", \"clamped\"]";
    let turned = drawn("svg = \"a.svg\"", edge, "", other);
    let ends = |outline: &Outline| -> Vec<(Point, Edge)> {
        outline.loops()[0].sides.iter().map(|(side, edge)| (side.at(0.5), *edge)).collect()
    };
    let (mut a, mut b) = (ends(&read), ends(&turned));
    let by_place =
        |a: &(Point, Edge), b: &(Point, Edge)| (a.0.x - a.0.y * 0.7).total_cmp(&(b.0.x - b.0.y * 0.7));
    a.sort_by(by_place);
    b.sort_by(by_place);
    assert!(a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| a.0.distance(b.0) < 1e-7 && a.1 == b.1));
}

#[test]
fn lines_drawn_are_a_polygon_and_paths_inside_are_holes() {
    let drawing =
        r#"<path d="M10 10H150V110H10Z"/><circle cx="60" cy="60" r="20"/><path d="M100 40V80H120V40Z"/>"#;
    let read = drawn("svg = \"a.svg\"", "edge = [\"free\", \"free\", \"free\", \"clamped\"]", "", drawing);
    let Shape::Polygon(vertices) = &read.shape else { panic!("{read:?}") };
    assert!(vertices.iter().any(|v| v.distance(p(0.0, 0.0)) < 1e-8) && vertices.len() == 4);
    assert_eq!(read.holes.len(), 2);
    assert!((read.area() - (0.14 * 0.1 - PI * 4e-4 - 8e-4)).abs() < 1e-8);
    assert!(read.holes.iter().all(|hole| hole.edges == Edges::All(Edge::Free)));
    assert!(!read.contains(p(50.0, 50.0)) && read.contains(p(50.0, 72.0)));
    // A hole drawn in a file of its own.
    let hole = "[[hole]]\nsvg = \"hole.svg\"\nat_mm = [70, 20]\nedge = [\"free\", \"free\", \"clamped\", \"free\"]\n";
    let round = r#"<ellipse cx="60" cy="60" rx="20" ry="10"/>"#;
    let read = drawn("rectangle_mm = [150, 100]", "", hole, round);
    let [hole] = &read.holes[..] else { panic!("{read:?}") };
    assert_eq!(hole.at, p(70.0, 20.0));
    assert!((read.area() - (0.015 - PI * 2e-4)).abs() < 1e-8);
    let held = read.loops()[1].sides.iter().filter(|(_, edge)| *edge == Edge::Clamped).count();
    assert_eq!((hole.sides.len() % 4, held), (0, hole.sides.len() / 4));
}
