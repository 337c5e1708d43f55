//! Outlines that mesh tests share.

use crate::mesh::{Sizing, corners};
use unripple_core::{Edge, Edges, Hole, Outline, Point, Shape, Side};

/// An outline, how fine its mesh should be, and the angle (degrees) that its triangles should exceed.
pub(super) struct Sheet {
    pub(super) name: &'static str,
    pub(super) outline: Outline,
    pub(super) sizing: Sizing,
    pub(super) least: f64,
}

/// The sheet of a name.
pub(super) fn named(name: &str) -> Sheet {
    sheets().into_iter().find(|sheet| sheet.name == name).unwrap()
}

fn polygon(points: &[(f64, f64)]) -> Outline {
    Outline::new(Shape::Polygon(points.iter().map(|&(x, y)| Point::from_mm(x, y)).collect()))
}

fn rectangle() -> Outline {
    Outline::new(Shape::Rectangle { width: 0.15, height: 0.1 })
}

/// Six bent arms.
fn star() -> Outline {
    let sides = (0..6).map(|i| {
        let at = |k: f64, r: f64| {
            let a = std::f64::consts::TAU * (f64::from(i) + k) / 6.0;
            Point::new(0.07 + r * a.cos(), 0.07 + r * a.sin())
        };
        Side::Cubic([at(0.0, 0.04), at(0.3, 0.045), at(0.4, 0.09), at(1.0, 0.04)])
    });
    Outline::new(Shape::Path(sides.collect()))
}

/// Two arcs that meet at sharp corners.
fn lens() -> Outline {
    let (radius, half) = (0.1, 0.6_f64);
    let (x, y) = (radius * half.sin(), radius * half.cos());
    let arc = |centre, start| Side::Arc { centre, radius, start, sweep: 2.0 * half };
    let up = std::f64::consts::FRAC_PI_2;
    Outline::new(Shape::Path(vec![
        arc(Point::new(x, y + radius - y), -up - half),
        arc(Point::new(x, radius - y - y), up - half),
    ]))
}

/// Every kind of sheet that a mesh must cope with.
pub(super) fn sheets() -> Vec<Sheet> {
    let sheet = |name, outline, size, least| Sheet { name, outline, sizing: Sizing::even(size), least };
    let mut all = vec![
        sheet("rectangle", rectangle(), 0.006, 40.0),
        sheet("fine rectangle", rectangle(), 0.002, 40.0),
        sheet("circle", Outline::new(Shape::Circle { radius: 0.07 }), 0.008, 30.0),
        sheet("coarse circle", Outline::new(Shape::Circle { radius: 0.07 }), 0.05, 30.0),
        sheet("stadium", Outline::new(Shape::Stadium { straight: 0.08, radius: 0.04 }), 0.008, 30.0),
        sheet(
            "irregular",
            polygon(&[(10.0, 0.0), (120.0, 12.0), (150.0, 70.0), (90.0, 110.0), (0.0, 60.0)]),
            0.008,
            30.0,
        ),
        sheet("star", star(), 0.006, 30.0),
        sheet("lens", lens(), 0.008, 20.0),
        sheet("wedge", polygon(&[(0.0, 0.0), (100.0, 0.0), (100.0, 30.0)]), 0.005, 14.0),
    ];
    all.extend(pierced());
    all.extend(graded());
    all
}

fn pierced() -> Vec<Sheet> {
    let p = Point::from_mm;
    let disc = |radius: f64, x, y| Hole::new(&Shape::Circle { radius }, p(x, y));
    let sheet = |name, outline, size, least| Sheet { name, outline, sizing: Sizing::even(size), least };
    let holes = rectangle()
        .with_hole(disc(0.01, 20.0, 20.0))
        .with_hole(disc(0.002, 45.0, 30.0))
        .with_hole(Hole::new(&Shape::Rectangle { width: 0.02, height: 0.03 }, p(90.0, 40.0)));
    let neck = rectangle().with_hole(disc(0.02, 30.0, 1.0)).with_hole(disc(0.02, 70.05, 1.5));
    let slit = |width| rectangle().with_hole(Hole::slit(p(40.0, 40.0), p(110.0, 70.0), width));
    vec![
        sheet("holes", holes, 0.006, 30.0),
        sheet("neck", neck, 0.008, 20.0),
        sheet("slit", slit(1e-4), 0.008, 25.0),
        sheet("thin slit", slit(1e-5), 0.008, 25.0),
        sheet("dot", rectangle().with_hole(Hole::slit(p(40.0, 40.0), p(40.0, 40.0), 1e-4)), 0.008, 25.0),
    ]
}

fn graded() -> Vec<Sheet> {
    let p = Point::from_mm;
    let l = polygon(&[(0.0, 0.0), (100.0, 0.0), (100.0, 50.0), (50.0, 50.0), (50.0, 100.0), (0.0, 100.0)]);
    let mut corner = vec![f64::INFINITY; 6];
    corner[3] = 1e-7;
    let near = vec![(p(40.0, 30.0), 0.0, 1e-4), (p(100.0, 70.0), 0.005, 2e-3)];
    let mixed =
        rectangle().with_edges(Edges::PerSide(vec![Edge::Clamped, Edge::Free, Edge::Supported, Edge::Free]));
    let mixed = mixed.with_hole(Hole::new(&Shape::Rectangle { width: 0.03, height: 0.02 }, p(60.0, 30.0)));
    let refined = Sizing::even(0.01).refined(&corners(&mixed).unwrap(), true, 1e-5);
    let sheet = |name, outline, sizing, least| Sheet { name, outline, sizing, least };
    vec![
        sheet("graded L", l.clone(), Sizing { corners: corner, ..Sizing::even(0.01) }, 25.0),
        sheet("finest L", l, Sizing { corners: vec![1e-11; 6], ..Sizing::even(0.01) }, 25.0),
        sheet("places", rectangle(), Sizing { near, ..Sizing::even(0.006) }, 25.0),
        sheet("layer", rectangle(), Sizing { edge_size: Some(0.002), ..Sizing::even(0.01) }, 25.0),
        sheet("refined", mixed, refined, 25.0),
    ]
}
