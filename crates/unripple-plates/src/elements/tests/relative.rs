//! Around free corners with the shortest edges: unknowns relative to the corner give the same functions, and rigid motion no energy.

use super::patch::{energy, interpolated};
use super::solve::fabric;
use crate::elements::Space;
use crate::mesh::{Mesh, Sizing};
use unripple_core::*;
use unripple_linalg::Mat;

/// Corners of a hole, in metres: a triangle of which one corner is cut by a side of 3e-6, and another by one of 7e-4.
const HOLE: [[f64; 2]; 5] = [[0.4005, 0.4], [0.7, 0.5], [0.45, 0.65], [0.449998, 0.649998], [0.4, 0.4005]];
const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

/// A square plate of side 1 with that hole, edges at the hole's corners a billionth of those elsewhere.
fn notched(edge: Edge) -> Mesh {
    let corners = HOLE.map(|[x, y]| Point::new(x, y));
    let outline = Outline {
        edges: Edges::All(Edge::Free),
        ..Outline::new(Shape::Rectangle { width: 1.0, height: 1.0 }).with_hole(Hole {
            edges: Edges::All(edge),
            ..Hole::new(&Shape::Polygon(corners.to_vec()), Point::new(0.0, 0.0))
        })
    };
    let mut sizing = Sizing::even(0.1);
    sizing.corners = [[f64::INFINITY; 4].as_slice(), &[1e-10; 5]].concat();
    Mesh::new(&outline, &sizing).unwrap()
}

/// The integral of a quadratic over a polygon, by the middles of the sides of triangles.
fn over(polygon: &[[f64; 2]], function: &dyn Fn(Point) -> f64) -> f64 {
    let fan = polygon.windows(2).skip(1).map(|pair| [polygon[0], pair[0], pair[1]]);
    let triangle = |[a, b, c]: [[f64; 2]; 3]| {
        let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        let middle = |p: [f64; 2], q: [f64; 2]| Point::new(0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]));
        area * [middle(a, b), middle(b, c), middle(c, a)].map(function).iter().sum::<f64>() / 3.0
    };
    fan.map(triangle).sum()
}

/// The same over the plate.
fn over_plate(function: impl Fn(Point) -> f64) -> f64 {
    over(&SQUARE, &function) - over(&HOLE, &function)
}

/// The unknowns of a function that is given with its derivatives, and its nodal values.
fn both(space: &Space, mesh: &Mesh, function: impl Fn(Point) -> [f64; 6]) -> (Vec<f64>, Vec<f64>) {
    let nodal = interpolated(mesh, function);
    let mut moved = Mat::from_fn(nodal.len(), 1, |u, _| nodal[u]);
    space.nodal(&mut moved);
    // What a corner's motion adds depends on the corner alone.
    let unknowns = nodal.iter().enumerate().map(|(u, value)| value - (moved[(u, 0)] - value)).collect();
    (unknowns, nodal)
}

/// u = 1 + 2x - 3y.
fn linear(p: Point) -> [f64; 6] {
    [1.0 + 2.0 * p.x - 3.0 * p.y, 2.0, -3.0, 0.0, 0.0, 0.0]
}

/// u = x² - xy.
fn quadratic(p: Point) -> [f64; 6] {
    [p.x * p.x - p.x * p.y, 2.0 * p.x - p.y, -p.x, 2.0, -1.0, 0.0]
}

#[test]
fn rigid_motion_stores_no_energy_at_free_corners() {
    let mesh = notched(Edge::Free);
    let space = Space::new(&mesh, true);
    let forms = space.assemble(&fabric(1.0, 0.0, 0.3));
    let (unknowns, nodal) = both(&space, &mesh, linear);
    let relative = unknowns.iter().zip(&nodal).filter(|(a, b)| a != b).count();
    assert!(relative > 500, "{relative}");
    // The energies of the plate's lowest modes are some hundreds.
    let bent = energy(&forms.bending, &unknowns).abs();
    assert!(bent < 1e-7, "{bent:e}");
    let (heavy, exact) = (energy(&forms.mass, &unknowns), over_plate(|p| linear(p)[0].powi(2)));
    assert!((heavy / exact - 1.0).abs() < 1e-11, "{heavy} {exact}");
}

#[test]
fn energies_do_not_depend_on_what_unknowns_are_relative_to() {
    let (lift, tilt) = (3.0, 0.7);
    for (edge, lift) in
        [(Edge::Free, 0.0), (Edge::Elastic { lift, tilt: 0.0 }, lift), (Edge::Elastic { lift, tilt }, lift)]
    {
        let mesh = notched(edge);
        let space = Space::new(&mesh, true);
        let forms = space.assemble(&fabric(2.0, 5.0, 0.3));
        let (unknowns, _) = both(&space, &mesh, quadratic);
        // ∫ D (u_xx² + u_yy² + 2ν u_xx u_yy + 2 (1-ν) u_xy²).
        let exact = 2.0 * (4.0 + 2.0 * 0.7) * over_plate(|_| 1.0);
        let bent = energy(&forms.bending, &unknowns);
        // Two corners d = 7e-4 apart have one motion: of triangles of size h at the second, ε (d²/h)² is left, some 1e-9 of each.
        assert!((bent / exact - 1.0).abs() < 1e-7, "{bent} {exact}");
        let pulled = 5.0 * over_plate(|p| quadratic(p)[1].powi(2) + quadratic(p)[2].powi(2));
        // Along the hole, by Gauss's rule, which is exact for polynomials of degree 5.
        let places =
            [(0.5 - 0.15f64.sqrt(), 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + 0.15f64.sqrt(), 5.0 / 18.0)];
        let side = |(a, b): (&[f64; 2], &[f64; 2])| {
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let length = dx.hypot(dy);
            let at = |(t, w): (f64, f64)| {
                let [u, x, y, ..] = quadratic(Point::new(a[0] + t * dx, a[1] + t * dy));
                let slope = (x * dy - y * dx) / length;
                let tilt = if let Edge::Elastic { tilt, .. } = edge { tilt } else { 0.0 };
                w * length * (lift * u * u + tilt * slope * slope)
            };
            places.map(at).iter().sum::<f64>()
        };
        let sprung: f64 = HOLE.iter().zip(HOLE.iter().cycle().skip(1)).map(side).sum();
        let (all, exact) = (energy(&forms.stiffness, &unknowns), exact + pulled + sprung);
        assert!((all / exact - 1.0).abs() < 1e-7, "{edge:?}: {all} {exact}");
    }
}
