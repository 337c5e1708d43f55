//! Around free corners with the shortest edges: unknowns relative to the corner give the same functions, and rigid motion no energy.

use super::patch::{energy, interpolated};
use super::solve::fabric;
use crate::elements::Space;
use crate::mesh::{Mesh, Sizing};
use unripple_core::*;
use unripple_linalg::Mat;

/// Corners of the hole, in metres: a triangle of which one corner is cut.
const HOLE: [[f64; 2]; 4] = [[0.4, 0.4], [0.7, 0.5], [0.45, 0.65], [0.449998, 0.649998]];

/// A free square plate of side 1 with a triangular hole, edges at the hole's corners a billionth of those elsewhere; one corner is cut by a side
/// of 3e-6.
fn notched() -> Mesh {
    let corners = HOLE.map(|[x, y]| Point::new(x, y));
    let outline = Outline {
        edges: Edges::All(Edge::Free),
        ..Outline::new(Shape::Rectangle { width: 1.0, height: 1.0 })
            .with_hole(Hole::new(&Shape::Polygon(corners.to_vec()), Point::new(0.0, 0.0)))
    };
    let mut sizing = Sizing::even(0.1);
    sizing.corners = [[f64::INFINITY; 4], [1e-10; 4]].concat();
    Mesh::new(&outline, &sizing).unwrap()
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

#[test]
fn rigid_motion_stores_no_energy_at_free_corners() {
    let mesh = notched();
    let space = Space::new(&mesh, true);
    let forms = space.assemble(&fabric(1.0, 0.0, 0.3));
    let linear = |p: Point| [1.0 + 2.0 * p.x - 3.0 * p.y, 2.0, -3.0, 0.0, 0.0, 0.0];
    let (unknowns, nodal) = both(&space, &mesh, linear);
    let relative = unknowns.iter().zip(&nodal).filter(|(a, b)| a != b).count();
    assert!(relative > 500, "{relative}");
    // The energies of the plate's lowest modes are some hundreds.
    let bent = energy(&forms.bending, &unknowns).abs();
    assert!(bent < 1e-7, "{bent:e}");
    let heavy = energy(&forms.mass, &unknowns);
    let exact = {
        let mean =
            |f: &dyn Fn(f64) -> f64| (0..200).map(|i| f((f64::from(i) + 0.5) / 200.0)).sum::<f64>() / 200.0;
        let square = mean(&|x| mean(&|y| linear(Point::new(x, y))[0].powi(2)));
        let hole = |f: &dyn Fn([f64; 2]) -> f64| {
            let [a, b, c, _] = HOLE;
            let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
            let middle = |p: [f64; 2], q: [f64; 2]| [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
            area * [middle(a, b), middle(b, c), middle(c, a)].map(f).iter().sum::<f64>() / 3.0
        };
        square - hole(&|[x, y]| linear(Point::new(x, y))[0].powi(2))
    };
    assert!((heavy / exact - 1.0).abs() < 1e-4, "{heavy} {exact}");
}

#[test]
fn energies_do_not_depend_on_what_unknowns_are_relative_to() {
    let mesh = notched();
    let space = Space::new(&mesh, true);
    let forms = space.assemble(&fabric(2.0, 0.0, 0.3));
    // u = x² - xy: κ = (2, 0, -2) without Poisson's part; ∫ D (u_xx² + u_yy² + 2ν u_xx u_yy + 2 (1-ν) u_xy²).
    let quadratic = |p: Point| [p.x * p.x - p.x * p.y, 2.0 * p.x - p.y, -p.x, 2.0, -1.0, 0.0];
    let (unknowns, _) = both(&space, &mesh, quadratic);
    let ring = HOLE.iter().zip(HOLE.iter().cycle().skip(1));
    let area = 1.0 - 0.5 * ring.map(|([ax, ay], [bx, by])| ax * by - bx * ay).sum::<f64>();
    let exact = 2.0 * area * (4.0 + 2.0 * 0.7);
    let bent = energy(&forms.bending, &unknowns);
    assert!((bent / exact - 1.0).abs() < 1e-9, "{bent} {exact}");
    assert_eq!(energy(&forms.stiffness, &unknowns), bent);
}
