//! Truth: rectangles on springs, solved in polynomials, against strips solved piece by piece, against elements on a mesh, and limits.

use crate::truth_common::{sheets, strips};
use std::f64::consts::TAU;
use unripple_core::*;
use unripple_plates::Modes;

const SIDES: [f64; 2] = [1.0, 0.7];

/// A plate of unit stiffness and mass per area on a rectangle, with its edges from the bottom, anticlockwise.
fn rectangle(edges: [Edge; 4], tension: f64) -> Surface {
    let outline = Outline::new(Shape::Rectangle { width: SIDES[0], height: SIDES[1] });
    sheets::sheet(outline.with_edges(Edges::PerSide(edges.into())), 1.0, tension, 0.3)
}

/// The same as a polygon, which is solved on a mesh.
fn on_a_mesh(surface: &Surface) -> Surface {
    let corners = [[0.0, 0.0], [SIDES[0], 0.0], SIDES, [0.0, SIDES[1]]];
    let mut other = surface.clone();
    other.outline = sheets::polygon(&corners, surface.outline.edges.clone());
    other
}

fn elastic(lift: f64, tilt: f64) -> Edge {
    Edge::Elastic { lift, tilt }
}

#[test]
fn springs_between_supported_sides_are_those_of_strips() {
    use Edge::{Clamped, Free, Supported};
    let cases = [
        ([elastic(10.0, 0.1); 2], 0.0),
        ([elastic(1e3, 3.0); 2], 40.0),
        ([elastic(1e7, 1e4); 2], 0.0),
        ([elastic(200.0, 0.0), elastic(0.0, 7.0)], 0.0),
        ([elastic(500.0, 2.0), Free], 10.0),
        ([Clamped, elastic(500.0, 2.0)], 0.0),
    ];
    for (edges, tension) in cases {
        let surface = rectangle([Supported, edges[1], Supported, edges[0]], tension);
        let at = |_: f64| strips::Local { bending: 1.0, tension, mass: 1.0 };
        let known = strips::frequencies(SIDES, edges, 0.3, at, 80.0);
        let modes = Modes::solve(&surface, 80.0, 1e-8).unwrap();
        let found = modes.frequencies_hz();
        assert_eq!(found.len(), known.len(), "{edges:?}");
        for (found, known) in found.iter().zip(&known) {
            assert!((found / known - 1.0).abs() < modes.error() + 1e-9, "{edges:?}: {found} {known}");
        }
    }
}

#[test]
fn springs_on_all_sides_are_those_of_a_mesh() {
    use Edge::{Clamped, Free};
    let soft = elastic(20.0, 0.2);
    let hard = elastic(1e6, 1e3);
    let cases = [
        ([soft; 4], 0.0),
        ([hard; 4], 0.0),
        ([hard; 4], 50.0),
        ([elastic(300.0, 0.0), Free, elastic(0.0, 5.0), Free], 0.0),
        ([soft, hard, Clamped, elastic(1e3, 0.0)], 20.0),
    ];
    for (edges, tension) in cases {
        let surface = rectangle(edges, tension);
        let [ritz, mesh] = [&surface, &on_a_mesh(&surface)].map(|s| Modes::solve(s, 60.0, 1e-5).unwrap());
        let (found, known) = (ritz.frequencies_hz(), mesh.frequencies_hz());
        assert_eq!(found.len(), known.len(), "{edges:?}");
        let most = ritz.error() + mesh.error();
        for (found, known) in found.iter().zip(&known).filter(|(_, known)| **known > 0.0) {
            assert!((found / known - 1.0).abs() < most, "{edges:?}: {found} {known} {most:e}");
        }
        let place = Point::new(0.31, 0.22);
        for m in 0..6 {
            let [a, b] = [&ritz, &mesh].map(|modes| modes.at_all(&[place])[(0, m)].abs());
            assert!((a - b).abs() < 1e-3 * (1.0 + b), "{edges:?} {m}: {a} {b}");
        }
        for (a, b) in ritz.bending_shares().iter().zip(mesh.bending_shares()) {
            assert!((a - b).abs() < 1e-3, "{edges:?}: {a} {b}");
        }
    }
}

/// A sheet on springs that are far softer than itself moves as a whole: ω² is lift times rim over mass.
#[test]
fn on_soft_springs_it_moves_as_a_whole() {
    let lift = 1e-4;
    let modes = Modes::solve(&rectangle([elastic(lift, 0.0); 4], 0.0), 5.0, 1e-6).unwrap();
    let known = (lift * 2.0 * (SIDES[0] + SIDES[1]) / (SIDES[0] * SIDES[1])).sqrt() / TAU;
    let found = modes.frequencies_hz()[0];
    assert!((found / known - 1.0).abs() < 1e-5, "{found} {known}");
}

/// Springs against rotation leave motions across which they do not turn; springs against displacement along one side leave a hinge.
#[test]
fn motions_that_no_spring_resists_are_at_rest() {
    let (free, turn) = (Edge::Free, elastic(0.0, 3.0));
    let cases = [
        ([free; 4], 3),
        ([free, turn, free, turn], 2),
        ([turn; 4], 1),
        ([free, elastic(1.0, 0.0), free, free], 1),
        ([free, elastic(1.0, 0.1), free, free], 0),
        ([free, elastic(1.0, 0.0), free, elastic(2.0, 0.0)], 0),
    ];
    for (edges, rigid) in cases {
        let modes = Modes::solve(&rectangle(edges, 0.0), 30.0, 1e-4).unwrap();
        let still = modes.frequencies_hz().iter().filter(|hz| **hz == 0.0).count();
        assert_eq!(still, rigid, "{edges:?}");
    }
}

/// Ever harder springs become a clamp, also where rounding errors leave them to the mesh.
#[test]
fn hard_springs_clamp() {
    let clamped = Modes::solve(&rectangle([Edge::Clamped; 4], 0.0), 60.0, 1e-6).unwrap().frequencies_hz();
    let mut before = f64::INFINITY;
    for stiffness in [1e2, 1e4, 1e6, 1e9, 1e13] {
        let held = rectangle([elastic(1e5 * stiffness, stiffness); 4], 0.0);
        let found = Modes::solve(&held, 60.0, 1e-4).unwrap().frequencies_hz();
        assert_eq!(found.len(), clamped.len(), "{stiffness:e}");
        let far = found.iter().zip(&clamped).map(|(f, c)| (f / c - 1.0).abs()).fold(0.0, f64::max);
        // To first order a frequency falls by some D/(tilt a) of itself, beside the accuracy asked for.
        assert!(far < 10.0 / stiffness + 2e-4 && far < before + 2e-4, "{stiffness:e}: {far:e}");
        before = far;
    }
}
