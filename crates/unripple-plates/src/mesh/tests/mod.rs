//! Whole meshes: what they cover, how their parts belong together, and the shape of their triangles.

mod random;
mod sheets;

use super::*;
use sheets::{named, sheets};
use std::collections::HashMap;
use unripple_core::plane::{cross, doubled, minus, sharpness};
use unripple_core::{Hole, Outline, Shape};

/// The area of a mesh with its curved edges: straight triangles, and what lies between chords and curves.
fn area(mesh: &Mesh) -> f64 {
    let at = |i: usize| mesh.vertices[i].at;
    let flat =
        mesh.triangles.iter().map(|t| doubled(at(t.vertices[0]), at(t.vertices[1]), at(t.vertices[2])));
    let bulge = |span: Span| {
        let (side, half) = (mesh.sides[span.side].0, 0.5 * (span.to - span.from));
        let start = side.at(span.from);
        let swept = |x: f64| {
            let t = span.from + half * (1.0 + x);
            cross(minus(side.at(t), start), side.derivative(t))
        };
        half * crate::modes::gauss(12).into_iter().map(|(x, w)| w * swept(x)).sum::<f64>()
    };
    0.5 * (flat.sum::<f64>() + mesh.edges.iter().filter_map(|e| e.span).map(bulge).sum::<f64>())
}

/// Least angle of all triangles, in degrees.
fn least_angle(mesh: &Mesh) -> f64 {
    let worst = mesh.triangles.iter().map(|t| sharpness(t.vertices.map(|i| mesh.vertices[i].at)));
    1.0_f64.atan2(worst.fold(0.0, f64::max)).to_degrees()
}

/// All that holds for any mesh of an outline.
fn check(mesh: &Mesh, outline: &Outline) {
    assert!((area(mesh) / outline.area() - 1.0).abs() < 1e-10, "{} {}", area(mesh), outline.area());
    let (v, e, t) = (mesh.vertices.len() as i64, mesh.edges.len() as i64, mesh.triangles.len() as i64);
    assert_eq!(v - e + t, 1 - outline.holes.len() as i64);
    check_edges(mesh);
    check_spans(mesh);
    for vertex in &mesh.vertices {
        assert!(vertex.on.len() < 3);
        for (side, t) in &vertex.on {
            let apart = mesh.sides[*side].0.at(*t).distance(vertex.at);
            assert!(apart < if *t == 1.0 { 1e-10 } else { 1e-16 }, "{apart:e}");
        }
    }
}

/// Every edge belongs to two triangles, or to one that lies to the left of a span.
fn check_edges(mesh: &Mesh) {
    let mut uses: HashMap<usize, Vec<[usize; 2]>> = HashMap::new();
    for t in &mesh.triangles {
        let [a, b, c] = t.vertices.map(|i| mesh.vertices[i].at);
        assert!(doubled(a, b, c) > 0.0);
        for i in 0..3 {
            uses.entry(t.edges[i]).or_default().push([t.vertices[i], t.vertices[(i + 1) % 3]]);
        }
    }
    for (i, edge) in mesh.edges.iter().enumerate() {
        let [a, b] = edge.ends;
        match edge.span {
            Some(_) => assert_eq!(uses[&i], vec![[a, b]]),
            None => {
                let found = &uses[&i];
                assert!(found.len() == 2 && found.contains(&[a, b]) && found.contains(&[b, a]), "{found:?}");
            }
        }
    }
}

/// The spans cover every side once, in order, and their edges end where they do.
fn check_spans(mesh: &Mesh) {
    let mut spans: Vec<Vec<Span>> = vec![Vec::new(); mesh.sides.len()];
    for edge in &mesh.edges {
        let Some(span) = edge.span else { continue };
        spans[span.side].push(span);
        for (end, t) in edge.ends.into_iter().zip([span.from, span.to]) {
            assert!(mesh.vertices[end].on.contains(&(span.side, t)));
        }
    }
    for mut list in spans {
        list.sort_by(|a, b| a.from.total_cmp(&b.from));
        assert_eq!((list[0].from, list[list.len() - 1].to), (0.0, 1.0));
        assert!(list.windows(2).all(|w| w[0].to == w[1].from && w[0].from < w[0].to));
    }
}

#[test]
fn meshes_cover_their_outlines() {
    for sheet in sheets() {
        let mesh = Mesh::new(&sheet.outline, &sheet.sizing).unwrap();
        check(&mesh, &sheet.outline);
    }
}

#[test]
fn triangles_are_well_shaped() {
    for sheet in sheets() {
        let mesh = Mesh::new(&sheet.outline, &sheet.sizing).unwrap();
        let least = least_angle(&mesh);
        assert!(least > sheet.least, "{}: {least}", sheet.name);
    }
}

#[test]
fn vertices_are_as_many_as_estimated() {
    for sheet in sheets() {
        let mesh = Mesh::new(&sheet.outline, &sheet.sizing).unwrap();
        let ratio =
            Mesh::estimate(&sheet.outline, &sheet.sizing).unwrap() as f64 / mesh.vertices.len() as f64;
        assert!((0.8..1.25).contains(&ratio), "{}: {ratio}", sheet.name);
    }
}

#[test]
fn an_even_mesh_has_little_more_than_the_fewest_vertices() {
    for name in ["rectangle", "fine rectangle", "circle", "stadium", "irregular"] {
        let sheet = named(name);
        let mesh = Mesh::new(&sheet.outline, &sheet.sizing).unwrap();
        let rims = mesh.vertices.iter().filter(|v| !v.on.is_empty()).count() as f64;
        let ideal = sheet.outline.area() / (0.75_f64.sqrt() * sheet.sizing.size.powi(2)) + 0.5 * rims;
        let ratio = mesh.vertices.len() as f64 / ideal;
        assert!((0.95..1.07).contains(&ratio), "{name}: {ratio}");
    }
}

/// Lengths of some edges, in metres.
fn lengths(mesh: &Mesh, which: impl Fn(&MeshEdge) -> bool) -> impl Iterator<Item = f64> {
    let at = |i: usize| mesh.vertices[i].at;
    mesh.edges.iter().filter(move |e| which(e)).map(move |e| at(e.ends[0]).distance(at(e.ends[1])))
}

#[test]
fn edges_are_as_long_as_wanted() {
    let sheet = named("graded L");
    let mesh = Mesh::new(&sheet.outline, &sheet.sizing).unwrap();
    let shortest = lengths(&mesh, |_| true).fold(f64::INFINITY, f64::min);
    assert!((0.5e-7..2e-7).contains(&shortest), "{shortest:e}");
    let longest = lengths(&mesh, |_| true).fold(0.0, f64::max);
    assert!(longest < 1.6 * sheet.sizing.size, "{longest}");
    let sheet = named("layer");
    let mesh = Mesh::new(&sheet.outline, &sheet.sizing).unwrap();
    let longest = lengths(&mesh, |e| e.span.is_some()).fold(0.0, f64::max);
    assert!(longest < 1.1 * sheet.sizing.edge_size.unwrap(), "{longest}");
}

#[test]
fn a_vertex_lies_at_each_place_wanted() {
    let sheet = named("places");
    let mesh = Mesh::new(&sheet.outline, &sheet.sizing).unwrap();
    for (place, _, edge) in &sheet.sizing.near {
        let vertex = mesh.vertices.iter().position(|v| v.at == *place).unwrap();
        let found: Vec<f64> = lengths(&mesh, |e| e.ends.contains(&vertex)).collect();
        assert!(found.iter().all(|l| (0.6 * edge..1.5 * edge).contains(l)), "{found:?} {edge}");
    }
}

#[test]
fn a_small_hole_is_round_and_a_curve_stays_out_of_its_triangle() {
    let outline = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 })
        .with_hole(Hole::new(&Shape::Circle { radius: 1e-3 }, Point::from_mm(90.0, 50.0)));
    let mesh = Mesh::new(&outline, &Sizing::even(0.02)).unwrap();
    let hole: Vec<&MeshEdge> = mesh.edges.iter().filter(|e| e.span.is_some_and(|s| s.side == 4)).collect();
    assert!(hole.len() >= 12, "{}", hole.len());
    for t in &mesh.triangles {
        for i in 0..3 {
            if mesh.edges[t.edges[i]].span.is_none_or(|s| s.side != 4) {
                continue;
            }
            let [a, b, c] = [0, 1, 2].map(|j| mesh.vertices[t.vertices[(i + j) % 3]].at);
            let (chord, height) = (a.distance(b), doubled(a, b, c) / a.distance(b));
            let sagitta = 1e-3 - (1e-6 - 0.25 * chord * chord).sqrt();
            assert!(sagitta < 0.2 * height);
        }
    }
}

#[test]
fn lengths_that_cannot_be_are_refused() {
    let outline = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 });
    for size in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-9] {
        let refused = Mesh::new(&outline, &Sizing::even(size));
        assert!(matches!(refused, Err(crate::PhysicsError::Range(_))), "{size}");
    }
    let count = Mesh::estimate(&outline, &Sizing::even(1e-8)).unwrap() as f64;
    assert!((count / (0.02 / (0.75_f64.sqrt() * 1e-16)) - 1.0).abs() < 1e-3);
    let layer = Sizing { edge_size: Some(1e-8), ..Sizing::even(0.01) };
    assert!(Mesh::estimate(&outline, &layer).unwrap() > 10_000_000);
}
