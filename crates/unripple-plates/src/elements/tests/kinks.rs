//! Truth: functions with a jump of curvature at the rim of a disc.

use super::meshes;
use super::patch::{energy, interpolated};
use super::solve::{omegas, surface};
use crate::elements::Space;
use crate::fabric::Fabric;
use crate::mesh::Mesh;
use proptest::prelude::*;
use unripple_core::*;

/// A sheet with a disc of its own material and twice its thickness.
fn laminated(tension: f64, at: Point, radius: f64) -> Surface {
    let mut surface = surface(2.0, 1.0, tension, 0.3);
    let Sheet { young, density, poisson, thickness, .. } = surface.sheet;
    let kind = ScattererKind::Disc { radius, thickness: 2.0 * thickness, young, density, poisson };
    surface.sheet.uneven.scatterers = vec![Scatterer { at, kind }];
    surface
}

/// The circle of radius 1 around (1, 1), in rings of triangles, and its space with jumps.
fn space(rings: usize, edge: Edge, surface: &Surface) -> (Mesh, Fabric, Space) {
    let (mesh, fabric) = (meshes::circle(1.0, rings, edge), Fabric::of(surface).unwrap());
    let space = Space::new(&mesh, true).with_kinks(&mesh, &fabric);
    (mesh, fabric, space)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20))]

    #[test]
    fn value_and_slope_are_continuous_and_curvature_is_not(x in 0.8..1.2, y in 0.8..1.2, radius in 0.2..0.7) {
        let at = Point::new(x, y);
        let (mesh, _, space) = space(4, Edge::Clamped, &laminated(0.0, at, radius));
        prop_assert!(space.unknowns() > Space::new(&mesh, true).unknowns());
        let unknowns: Vec<f64> = (0..space.unknowns()).map(|i| (17.0 * i as f64).sin()).collect();
        let value = |p: Point| {
            let (which, rows) = space.derivatives(p);
            rows.map(|row| row.iter().zip(which).map(|(w, u)| w * unknowns[*u]).sum::<f64>())
        };
        let mut jumps: f64 = 0.0;
        for i in 0..200 {
            let (s, c) = (0.0314 * f64::from(i)).sin_cos();
            let [inside, outside] = [-1e-9, 1e-9].map(|d| value(Point::new(x + (radius + d) * c, y + (radius + d) * s)));
            // Over 2e-9 a slope changes by so much times the curvature, a value by so much times the slope.
            let curved = inside[3..].iter().chain(&outside[3..]).fold(0.0, |most: f64, h| most.max(h.abs()));
            for d in 0..3 {
                let most = 1e-5 + 8e-9 * curved;
                prop_assert!((inside[d] - outside[d]).abs() < most, "{i} {d}: {} {} {curved}", inside[d], outside[d]);
            }
            jumps = jumps.max((inside[3] - outside[3]).abs());
        }
        prop_assert!(jumps > 1.0, "{jumps}");
        // From triangle to triangle as well.
        for (a, left) in mesh.triangles.iter().enumerate() {
            for (i, edge) in left.edges.iter().enumerate() {
                let beside = |t: &crate::mesh::Triangle| t.edges.contains(edge) && t.vertices != left.vertices;
                let Some(b) = mesh.triangles.iter().position(beside) else { continue };
                for s in [0.13, 0.5, 0.77] {
                    let p = space.elements[a].borders[i].at(s);
                    let [from, to] = [a, b].map(|e| {
                        let element = &space.elements[e];
                        let rows = element.jets(p, element.covering(p));
                        rows.map(|row| row.iter().zip(&element.unknowns).map(|(w, u)| w * unknowns[*u]).sum::<f64>())
                    });
                    for d in 0..3 {
                        // Functions of a mean square of 1e-13 are scaled to 1, their rounding with them.
                        prop_assert!((from[d] - to[d]).abs() < 1e-6, "{p} {d}: {} {}", from[d], to[d]);
                    }
                }
            }
        }
    }
}

#[test]
fn smooth_functions_have_the_energy_they_had() {
    // u = x² and ν = 0.3: ½κᵀDκ is D/2 · 4; a disc of twice the thickness makes 27 times of it.
    let (radius, at) = (0.45, Point::new(0.9, 1.05));
    let (mesh, fabric, space) = space(4, Edge::Free, &laminated(3.0, at, radius));
    let mut u = interpolated(&mesh, |p| [p.x * p.x, 2.0 * p.x, 0.0, 2.0, 0.0, 0.0]);
    u.resize(space.unknowns(), 0.0);
    let forms = space.assemble(&fabric);
    let area = std::f64::consts::PI;
    let bent = 4.0 * area * (1.0 + 26.0 * radius * radius);
    assert!((energy(&forms.bending, &u) / bent - 1.0).abs() < 1e-11);
    // ∫x² over the circle around (1, 1): π (1 + ¼), by 4 and the tension.
    let stretched = 3.0 * 4.0 * area * 1.25;
    assert!((energy(&forms.stiffness, &u) / (bent + stretched) - 1.0).abs() < 1e-11);
    let mut one = interpolated(&mesh, |_| [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    one.resize(space.unknowns(), 0.0);
    let mass = area * (1.0 + 2.0 * radius * radius);
    assert!((energy(&forms.mass, &one) / mass - 1.0).abs() < 1e-12);
}

#[test]
fn functions_that_jump_make_frequencies_with_a_disc_converge() {
    // Off the centre, so that the rim crosses triangles anyhow.
    let surface = laminated(0.0, Point::new(1.07, 0.94), 0.41);
    let of = |rings: usize| {
        let (_, fabric, space) = space(rings, Edge::Clamped, &surface);
        omegas(&space, &fabric, 0.0, 8)
    };
    let fine = of(10);
    let worst =
        |found: Vec<f64>| found.iter().zip(&fine).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
    let (coarse, middle) = (worst(of(4)), worst(of(8)));
    let mesh = meshes::circle(1.0, 8, Edge::Clamped);
    let plain = worst(omegas(&Space::new(&mesh, true), &Fabric::of(&surface).unwrap(), 0.0, 8));
    assert!(middle < 1.5e-4 && plain > 1e-2, "{middle:e} {plain:e}");
    assert!(coarse / middle > 2.0_f64.powf(4.0), "{coarse:e} {middle:e}");
}

#[test]
fn discs_that_touch_are_left_as_they_are() {
    let mut surface = laminated(0.0, Point::new(0.8, 1.0), 0.3);
    let other = Scatterer { at: Point::new(1.2, 1.0), ..surface.sheet.uneven.scatterers[0] };
    surface.sheet.uneven.scatterers.push(other);
    let (mesh, fabric, space) = space(4, Edge::Clamped, &surface);
    assert_eq!(space.unknowns(), Space::new(&mesh, true).unknowns());
    assert_eq!(space.assemble(&fabric).mass.nrows(), space.unknowns());
}
