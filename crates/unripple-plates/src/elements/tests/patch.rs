//! What the space can do: quintics exactly, no jump of value or slope, rims held.

use super::meshes;
use super::solve::fabric;
use crate::elements::Space;
use crate::elements::topology::Topology;
use crate::mesh::Mesh;
use crate::modes::gauss;
use proptest::prelude::*;
use unripple_core::{Edge, Point};

/// A quintic Σ c x^i y^j and its derivatives u, u_x, u_y, u_xx, u_xy, u_yy.
fn quintic(p: Point) -> [f64; 6] {
    let mut sum = [0.0; 6];
    let power = |x: f64, i: i32, by: i32| {
        let factor: f64 = (0..by).map(|k| f64::from(i - k)).product();
        if i < by { 0.0 } else { factor * x.powi(i - by) }
    };
    for i in 0..=5 {
        for j in 0..=5 - i {
            let c = f64::from(7 * i + 3 * j + 1).sin();
            for (s, [a, b]) in sum.iter_mut().zip([[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]]) {
                *s += c * power(p.x, i, a) * power(p.y, j, b);
            }
        }
    }
    sum
}

/// The unknowns of a function, given with its derivatives, on a mesh whose rims are all free.
pub(super) fn interpolated(mesh: &Mesh, function: impl Fn(Point) -> [f64; 6]) -> Vec<f64> {
    let lengths = Topology::of(mesh).lengths;
    let at_vertices = mesh.vertices.iter().zip(&lengths).flat_map(|(v, h)| {
        let [u, x, y, xx, xy, yy] = function(v.at);
        [u, h * x, h * y, h * h * xx, h * h * xy, h * h * yy]
    });
    let at_edges = mesh.edges.iter().map(|edge| {
        let [a, b] = edge.ends.map(|v| mesh.vertices[v].at);
        let (middle, d) = match edge.span {
            Some(span) => {
                let (side, t) = (mesh.sides[span.side].0, 0.5 * (span.from + span.to));
                (side.at(t), side.derivative(t))
            }
            None => (Point::new(0.5 * (a.x + b.x), 0.5 * (a.y + b.y)), Point::new(b.x - a.x, b.y - a.y)),
        };
        let [_, x, y, ..] = function(middle);
        a.distance(b) * (x * -d.y + y * d.x) / d.x.hypot(d.y)
    });
    at_vertices.chain(at_edges).collect()
}

fn value(space: &Space, unknowns: &[f64], p: Point) -> [f64; 6] {
    let (which, rows) = space.derivatives(p);
    rows.map(|row| row.iter().zip(which).map(|(w, u)| w * unknowns[*u]).sum())
}

/// uᵀ F u.
pub(super) fn energy(form: &unripple_linalg::sparse::SparseColMat<usize, f64>, u: &[f64]) -> f64 {
    form.triplet_iter().map(|t| u[t.row] * u[t.col] * t.val).sum()
}

#[test]
fn quintics_are_reproduced() {
    let free = [Edge::Free; 4];
    let meshes = [
        meshes::rectangle([1.0, 0.7], [5, 4], 0.3, free),
        meshes::circle(0.5, 3, Edge::Free),
        meshes::ring([0.2, 0.6], 2, 9, [Edge::Free; 2]),
    ];
    for mesh in meshes {
        let (space, unknowns) = (Space::new(&mesh, true), interpolated(&mesh, quintic));
        assert_eq!(space.unknowns(), unknowns.len());
        for t in &mesh.triangles {
            let [a, b, c] = t.vertices.map(|v| mesh.vertices[v].at);
            let p = Point::new(0.5 * a.x + 0.3 * b.x + 0.2 * c.x, 0.5 * a.y + 0.3 * b.y + 0.2 * c.y);
            let scales = [1.0, 10.0, 10.0, 100.0, 100.0, 100.0];
            for ((found, exact), scale) in value(&space, &unknowns, p).iter().zip(quintic(p)).zip(scales) {
                assert!((found - exact).abs() < 1e-11 * scale, "{p}: {found} {exact}");
            }
        }
    }
}

#[test]
fn energies_of_quintics_are_exact() {
    let mesh = meshes::rectangle([1.0, 0.7], [4, 3], 0.25, [Edge::Elastic { lift: 2.0, tilt: 0.5 }; 4]);
    let (space, u) = (Space::new(&mesh, true), interpolated(&mesh, quintic));
    let (poisson, bending, tension) = (0.3, 1.7, 0.6);
    let forms = space.assemble(&fabric(bending, tension, poisson));
    let rule: Vec<(f64, f64)> = gauss(12).into_iter().map(|(x, w)| (0.5 + 0.5 * x, 0.5 * w)).collect();
    let area = |f: &dyn Fn([f64; 6]) -> f64| -> f64 {
        let at = |x: f64, y: f64| f(quintic(Point::new(x, 0.7 * y)));
        rule.iter().flat_map(|(x, a)| rule.iter().map(move |(y, b)| 0.7 * a * b * at(*x, *y))).sum()
    };
    let bent = area(&|[_, _, _, xx, xy, yy]| {
        bending * (xx * xx + yy * yy + 2.0 * poisson * xx * yy + 2.0 * (1.0 - poisson) * xy * xy)
    });
    let stretched = area(&|[_, x, y, ..]| tension * (x * x + y * y));
    let rim: f64 = rule
        .iter()
        .map(|(s, w)| {
            let spring = |x: f64, y: f64, along: usize| {
                let q = quintic(Point::new(x, y));
                2.0 * q[0] * q[0] + 0.5 * q[3 - along] * q[3 - along]
            };
            let (flat, steep) =
                (spring(*s, 0.0, 1) + spring(*s, 0.7, 1), spring(0.0, 0.7 * s, 2) + spring(1.0, 0.7 * s, 2));
            w * (flat + 0.7 * steep)
        })
        .sum();
    let near = |found: f64, exact: f64| assert!((found / exact - 1.0).abs() < 1e-11, "{found} {exact}");
    near(energy(&forms.mass, &u), area(&|[u, ..]| u * u));
    near(energy(&forms.bending, &u), bent);
    near(energy(&forms.stiffness, &u), bent + stretched + rim);
}

#[test]
fn forms_are_symmetric_with_one_pattern() {
    let space = Space::new(&meshes::circle(1.0, 2, Edge::Clamped), true);
    let forms = space.assemble(&fabric(1.0, 2.0, 0.3));
    for form in [&forms.stiffness, &forms.bending, &forms.mass] {
        assert_eq!(form.row_idx(), forms.mass.row_idx());
        let dense = form.to_dense();
        let worst = (&dense - dense.transpose()).norm_max() / dense.norm_max();
        assert!(worst < 1e-14, "{worst:e}");
    }
}

/// Meshes of every kind of rim.
fn held() -> Vec<Mesh> {
    let mixed = [Edge::Clamped, Edge::Supported, Edge::Free, Edge::Clamped];
    vec![
        meshes::rectangle([1.0, 0.7], [3, 3], 0.3, mixed),
        meshes::circle(0.5, 2, Edge::Clamped),
        meshes::circle(0.5, 2, Edge::Supported),
        meshes::ring([0.2, 0.6], 1, 8, [Edge::Supported, Edge::Clamped]),
        meshes::stadium(1.0, 2, Edge::Supported),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20))]

    #[test]
    fn value_and_slope_are_continuous(seed in 0u32..10_000, bending in any::<bool>()) {
        for mesh in held() {
            let space = Space::new(&mesh, bending);
            let unknowns: Vec<f64> = (0..space.unknowns()).map(|i| f64::from(seed + 17 * i as u32).sin()).collect();
            for (a, left) in mesh.triangles.iter().enumerate() {
                for (i, edge) in left.edges.iter().enumerate() {
                    let Some(b) = mesh.triangles.iter().position(|t| t.edges.contains(edge) && t.vertices != left.vertices)
                    else { continue };
                    for s in [0.0, 0.13, 0.4, 0.77, 1.0] {
                        let p = space.elements[a].borders[i].at(s);
                        let [from, to] = [a, b].map(|e| {
                            let element = &space.elements[e];
                            let jets = element.jets(p, element.covering(p));
                            [0, 1, 2].map(|d| {
                                let row = &jets[d];
                                row.iter().zip(&element.unknowns).map(|(w, u)| w * unknowns[*u]).sum::<f64>()
                            })
                        });
                        for (d, (x, y)) in from.iter().zip(to).enumerate() {
                            let size = if d == 0 { 1.0 } else { 1.0 / space.elements[a].frame.scale };
                            prop_assert!((x - y).abs() < 1e-10 * size, "{p} {d}: {x} {y}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn rims_stay_where_they_are_held() {
    for mesh in held() {
        let space = Space::new(&mesh, true);
        let unknowns: Vec<f64> = (0..space.unknowns()).map(|i| (17.0 * i as f64).sin()).collect();
        for element in &space.elements {
            for border in element.borders.iter().filter(|b| b.held.is_some()) {
                // Between its points a curve is held but for the third power of its turning.
                let most = if border.is_straight() { 1e-12 } else { 2e-3 };
                for s in [0.0, 0.1, 0.31, 0.5, 0.83, 1.0] {
                    let (p, [nx, ny]) = (border.at(s), border.directions(s).1);
                    let jets = element.jets(p, None).map(|row| {
                        row.iter().zip(&element.unknowns).map(|(w, u)| w * unknowns[*u]).sum::<f64>()
                    });
                    if border.held != Some(Edge::Free) {
                        assert!(jets[0].abs() < most, "{p} {}", jets[0]);
                    }
                    if border.held == Some(Edge::Clamped) {
                        let slope = element.frame.scale * (nx * jets[1] + ny * jets[2]);
                        assert!(slope.abs() < 20.0 * most, "{p} {slope}");
                    }
                }
            }
        }
    }
}
