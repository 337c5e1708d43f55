//! Small meshes made by hand.

use crate::mesh::{Mesh, MeshEdge, Span, Triangle, Vertex};
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use unripple_core::{Edge, Point, Side};

/// A mesh of vertices, triangles and the pieces of sides that some pairs of vertices stand for.
pub(super) fn mesh(
    sides: Vec<(Side, Edge)>,
    points: &[Point],
    triangles: &[[usize; 3]],
    rims: &[([usize; 2], Span)],
) -> Mesh {
    let mut vertices: Vec<Vertex> = points.iter().map(|at| Vertex { at: *at, on: Vec::new() }).collect();
    let mut edges: Vec<MeshEdge> = Vec::new();
    let mut index = HashMap::new();
    for (ends, span) in rims {
        index.insert([ends[0].min(ends[1]), ends[0].max(ends[1])], edges.len());
        edges.push(MeshEdge { ends: *ends, span: Some(*span) });
        vertices[ends[0]].on.push((span.side, span.from));
        if span.to == 1.0 {
            vertices[ends[1]].on.push((span.side, span.to));
        }
    }
    let mut joined = |a: usize, b: usize| {
        *index.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            edges.push(MeshEdge { ends: [a, b], span: None });
            edges.len() - 1
        })
    };
    let triangles = triangles
        .iter()
        .map(|t| Triangle { vertices: *t, edges: [0, 1, 2].map(|i| joined(t[i], t[(i + 1) % 3])) })
        .collect();
    Mesh { sides, vertices, edges, triangles }
}

/// A rectangle in columns and rows of two triangles each, the vertices inside moved about by a part of the pitch.
pub(super) fn rectangle(size: [f64; 2], cells: [usize; 2], shake: f64, held: [Edge; 4]) -> Mesh {
    let [nx, ny] = cells;
    let at = |i: usize, j: usize| j * (nx + 1) + i;
    let mut points = Vec::new();
    for j in 0..=ny {
        for i in 0..=nx {
            let inside = i > 0 && i < nx && j > 0 && j < ny;
            let noise = |k: usize| ((i * 37 + j * 101 + k * 17) as f64 * 1.234).sin();
            let off = |k: usize| if inside { shake * noise(k) } else { 0.0 };
            let (x, y) = ((i as f64 + off(0)) / nx as f64, (j as f64 + off(1)) / ny as f64);
            points.push(Point::new(size[0] * x, size[1] * y));
        }
    }
    let mut triangles = Vec::new();
    for j in 0..ny {
        for i in 0..nx {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let rising = (i + j) % 2 == 0;
            triangles.extend(if rising { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
        }
    }
    let corners = [at(0, 0), at(nx, 0), at(nx, ny), at(0, ny)];
    let side = |s: usize| Side::Line { from: points[corners[s]], to: points[corners[(s + 1) % 4]] };
    let sides = (0..4).map(|s| (side(s), held[s])).collect();
    let mut rims = Vec::new();
    for side in 0..4 {
        let count = if side % 2 == 0 { nx } else { ny };
        let vertex = |k: usize| match side {
            0 => at(k, 0),
            1 => at(nx, k),
            2 => at(nx - k, ny),
            _ => at(0, ny - k),
        };
        for k in 0..count {
            let (from, to) = (k as f64 / count as f64, (k + 1) as f64 / count as f64);
            rims.push(([vertex(k), vertex(k + 1)], Span { side, from, to }));
        }
    }
    mesh(sides, &points, &triangles, &rims)
}

/// A circle cornered at the origin, in rings around its centre, the j-th of 6j vertices.
pub(super) fn circle(radius: f64, rings: usize, held: Edge) -> Mesh {
    let centre = Point::new(radius, radius);
    let mut points = vec![centre];
    for ring in 1..=rings {
        for k in 0..6 * ring {
            let (r, a) = (radius * ring as f64 / rings as f64, TAU * k as f64 / (6 * ring) as f64 - PI / 2.0);
            points.push(Point::new(centre.x + r * a.cos(), centre.y + r * a.sin()));
        }
    }
    let at = |ring: usize, k: usize| if ring == 0 { 0 } else { 1 + 3 * ring * (ring - 1) + k % (6 * ring) };
    let mut triangles = Vec::new();
    for ring in 1..=rings {
        for sector in 0..6 {
            for i in 0..ring {
                let (inner, outer) = (sector * (ring - 1) + i, sector * ring + i);
                triangles.push([at(ring, outer), at(ring, outer + 1), at(ring - 1, inner)]);
                if i + 1 < ring {
                    triangles.push([at(ring - 1, inner), at(ring, outer + 1), at(ring - 1, inner + 1)]);
                }
            }
        }
    }
    let side = Side::Arc { centre, radius, start: -PI / 2.0, sweep: TAU };
    let count = 6 * rings;
    let rims: Vec<_> = (0..count)
        .map(|k| {
            let (from, to) = (k as f64 / count as f64, (k + 1) as f64 / count as f64);
            ([at(rings, k), at(rings, k + 1)], Span { side: 0, from, to })
        })
        .collect();
    mesh(vec![(side, held)], &points, &triangles, &rims)
}

/// A ring between two radii, in layers of `around` cells of two triangles each; the outer side first.
pub(super) fn ring(radii: [f64; 2], layers: usize, around: usize, held: [Edge; 2]) -> Mesh {
    let centre = Point::new(radii[1], radii[1]);
    let at = |layer: usize, k: usize| layer * around + k % around;
    let mut points = Vec::new();
    for layer in 0..=layers {
        for k in 0..around {
            let r = radii[0] + (radii[1] - radii[0]) * layer as f64 / layers as f64;
            let a = TAU * k as f64 / around as f64;
            points.push(Point::new(centre.x + r * a.cos(), centre.y + r * a.sin()));
        }
    }
    let mut triangles = Vec::new();
    for layer in 0..layers {
        for k in 0..around {
            let [a, b] = [at(layer, k), at(layer, k + 1)];
            let [c, d] = [at(layer + 1, k + 1), at(layer + 1, k)];
            triangles.extend([[a, d, b], [b, d, c]]);
        }
    }
    let outer = Side::Arc { centre, radius: radii[1], start: 0.0, sweep: TAU };
    let inner = Side::Arc { centre, radius: radii[0], start: 0.0, sweep: -TAU };
    let span =
        |k: usize, side| Span { side, from: k as f64 / around as f64, to: (k + 1) as f64 / around as f64 };
    let outside = (0..around).map(|k| ([at(layers, k), at(layers, k + 1)], span(k, 0)));
    let inside = (0..around).map(|k| ([at(0, around - k), at(0, around - k - 1)], span(k, 1)));
    let rims: Vec<_> = outside.chain(inside).collect();
    mesh(vec![(outer, held[0]), (inner, held[1])], &points, &triangles, &rims)
}

/// A stadium of radius 1: a circle's halves with a rectangle between.
pub(super) fn stadium(straight: f64, rings: usize, held: Edge) -> Mesh {
    let (round, columns) = (circle(1.0, rings, held), (straight * rings as f64).ceil() as usize);
    let mut points: Vec<Point> = Vec::new();
    let mut at = |p: Point| {
        points.iter().position(|q| q.distance(p) < 1e-9).unwrap_or_else(|| {
            points.push(p);
            points.len() - 1
        })
    };
    let mut triangles: Vec<[usize; 3]> = Vec::new();
    for t in &round.triangles {
        let corners = t.vertices.map(|v| round.vertices[v].at);
        let right = corners.iter().map(|p| p.x).sum::<f64>() > 3.0;
        triangles.push(corners.map(|p| at(Point::new(if right { p.x + straight } else { p.x }, p.y))));
    }
    let node =
        |i: usize, j: usize| Point::new(1.0 + straight * i as f64 / columns as f64, j as f64 / rings as f64);
    for i in 0..columns {
        for j in 0..2 * rings {
            let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)].map(&mut at);
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let sides = unripple_core::Shape::Stadium { straight, radius: 1.0 }.sides();
    let rims = rims_on(&sides, &points, &triangles);
    mesh(sides.into_iter().map(|side| (side, held)).collect(), &points, &triangles, &rims)
}

/// The rim's edges of triangles, on the sides that both their ends lie on.
fn rims_on(sides: &[Side], points: &[Point], triangles: &[[usize; 3]]) -> Vec<([usize; 2], Span)> {
    let edges: Vec<[usize; 2]> =
        triangles.iter().flat_map(|t| [0, 1, 2].map(|i| [t[i], t[(i + 1) % 3]])).collect();
    let outer = edges.iter().filter(|[a, b]| !edges.contains(&[*b, *a]));
    let on = |side: &Side, v: usize| {
        let t = side.nearest(points[v]);
        (side.at(t).distance(points[v]) < 1e-9).then_some(t)
    };
    outer
        .filter_map(|ends| {
            let found = sides.iter().enumerate().find_map(|(i, side)| {
                let (from, to) = (on(side, ends[0])?, on(side, ends[1])?);
                Some(Span { side: i, from, to })
            });
            Some((*ends, found?))
        })
        .collect()
}

/// The same mesh turned about the origin.
pub(super) fn turned(mesh: &Mesh, angle: f64) -> Mesh {
    let (s, c) = angle.sin_cos();
    let turn = |p: Point| Point::new(c * p.x - s * p.y, s * p.x + c * p.y);
    let mut mesh = mesh.clone();
    mesh.vertices.iter_mut().for_each(|v| v.at = turn(v.at));
    for (side, _) in &mut mesh.sides {
        *side = match *side {
            Side::Line { from, to } => Side::Line { from: turn(from), to: turn(to) },
            Side::Arc { centre, radius, start, sweep } => {
                Side::Arc { centre: turn(centre), radius, start: start + angle, sweep }
            }
            Side::Cubic(points) => Side::Cubic(points.map(turn)),
        };
    }
    mesh
}
