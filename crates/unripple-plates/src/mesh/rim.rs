//! Rims cut into edges, whose lengths follow from the sizing, the curvature and the width of narrow places.

use super::field::{Field, Source};
use super::sizing::Sizing;
use super::{Span, Vertex};
use std::f64::consts::{FRAC_PI_2, PI};
use unripple_core::plane::{Rims, norm, turned};
use unripple_core::{Edge, Point};

/// Greatest turn of a rim edge, in radians: a small hole gets at least 14 edges. With twice this value, it
/// gets 7.
const TURN: f64 = 0.45;
/// Greatest length of a rim edge as a share of the width of the sheet there. With twice this value, edges would be longer than narrow
/// places are wide.
const GAP: f64 = 0.7;
/// Number of samples of the desired edge length per edge when a side is cut. With twice this value, cutting takes twice as long.
const STEPS: f64 = 6.0;
/// Shortest edge length, relative to the extent of the outline: above the resolution of coordinates.
const SHORTEST: f64 = 1e-12;
/// Number of rounds in which short edges on one side shorten those nearby. More rounds change only edges
/// far from short ones, and little.
const ROUNDS: usize = 3;

/// The rims of an outline, cut into edges.
#[derive(Clone, Debug)]
pub(super) struct Cut {
    /// The vertices, rim by rim, in order.
    pub(super) vertices: Vec<Vertex>,
    /// The edges: indices of both ends, with the sheet to the left, and the pieces of sides that they represent.
    pub(super) edges: Vec<([usize; 2], Span)>,
    /// Index of the vertex at which each side starts.
    pub(super) starts: Vec<usize>,
    /// The desired edge length at any point.
    pub(super) field: Field,
}

/// Cuts rims into edges for a sizing, and finer by the factor `finer` on curves and in narrow places.
pub(super) fn cut(rims: &Rims, sizing: &Sizing, finer: f64) -> Cut {
    let wanted = Wanted { rims, sizing, finer };
    let given = wanted.given();
    let mut field = Field::new(sizing.size, sizing.growth, given.iter().copied());
    let mut spans = Vec::new();
    for _ in 0..ROUNDS {
        spans = wanted.spans(&field);
        let own = spans.iter().flatten().map(|span| wanted.source(span));
        field = Field::new(sizing.size, sizing.growth, given.iter().copied().chain(own));
    }
    join(rims, &spans, |edges| {
        let own = edges.map(|span| {
            let side = &rims.sides[span.side].0;
            let at = side.at(0.5 * (span.from + span.to));
            Source { at, reach: 0.0, edge: side.at(span.from).distance(side.at(span.to)) }
        });
        Field::new(sizing.size, sizing.growth, given.iter().copied().chain(own.collect::<Vec<_>>()))
    })
}

/// The inputs that determine the lengths of rim edges.
struct Wanted<'a> {
    rims: &'a Rims,
    sizing: &'a Sizing,
    finer: f64,
}

impl Wanted<'_> {
    /// The places with short edges that the sizing itself asks for, and those at short sides.
    fn given(&self) -> Vec<Source> {
        let near = self.sizing.near.iter();
        let near = near.map(|(at, reach, edge)| Source { at: *at, reach: reach.max(*edge), edge: *edge });
        let corners = (0..self.rims.sides.len()).map(|i| {
            let (side, before) = (&self.rims.sides[i].0, &self.rims.sides[self.rims.previous(i)].0);
            let wanted = self.sizing.corners.get(i).copied().unwrap_or(f64::INFINITY);
            let edge = wanted.min(side.length()).min(before.length());
            Source { at: side.at(0.0), reach: 0.0, edge: edge.max(SHORTEST * self.rims.extent) }
        });
        near.chain(corners).collect()
    }

    /// The greatest edge length (m) at a point of a rim: limited by the rim's curvature, the distance of
    /// the opposite rim, and the edge condition.
    fn limit(&self, side: usize, t: f64) -> f64 {
        let (curve, edge) = self.rims.sides[side];
        let held = match (edge, self.sizing.edge_size) {
            (Edge::Clamped | Edge::Supported, Some(size)) => size.min(self.sizing.size),
            _ => self.sizing.size,
        };
        let bend = TURN / (self.finer * curve.curvature(t).abs()).max(f64::MIN_POSITIVE);
        let d = curve.derivative(t);
        let inward = turned(Point::new(d.x / norm(d), d.y / norm(d)), FRAC_PI_2);
        let share = GAP / self.finer;
        let gap = self.rims.gap(side, t, inward, held / share) * share;
        // Where curvature is infinite or a gap nothing, edges still have some length.
        let least = 1e-7 * self.rims.extent;
        held.min(bend.max(least)).min(gap.max(least))
    }

    /// The source in the size field by which a rim edge limits the length of edges around it.
    fn source(&self, span: &Span) -> Source {
        let t = 0.5 * (span.from + span.to);
        Source { at: self.rims.sides[span.side].0.at(t), reach: 0.0, edge: self.limit(span.side, t) }
    }

    /// The edges into which each side is cut.
    fn spans(&self, field: &Field) -> Vec<Vec<Span>> {
        (0..self.rims.sides.len()).map(|i| self.cut_side(i, field)).collect()
    }

    /// Cuts one side into edges: its length is measured in desired edge lengths, and divided into equal parts of that measure.
    fn cut_side(&self, side: usize, field: &Field) -> Vec<Span> {
        let curve = &self.rims.sides[side].0;
        let least = SHORTEST * self.rims.extent;
        let (mut t, mut edges) = (0.0, 0.0);
        let mut table = vec![(0.0, 0.0)];
        let step_to = |t: f64, length: f64| (t + length / norm(curve.derivative(t)).max(1e-9)).min(1.0);
        while t < 1.0 {
            let here = self.limit(side, t).min(field.at(curve.at(t)));
            // No step passes over more than a twentieth of the side's parameter.
            let mut end = step_to(t, here.max(least) / STEPS).min(t + 0.05);
            end = if end > 1.0 - 1e-14 || end <= t { 1.0 } else { end };
            let half = 0.5 * (t + end);
            let wanted = self.limit(side, half).min(field.at(curve.at(half))).max(least);
            edges += curve.at(t).distance(curve.at(end)) / wanted;
            t = end;
            table.push((t, edges));
        }
        let rim = self.rims.loops.iter().find(|rim| rim.contains(&side)).map_or(3, |rim| rim.len());
        let fewest = if rim < 3 { 4 / rim } else { 1 };
        // A remainder of up to a tenth of an edge is spread over the others.
        let count = ((edges - 0.1).ceil() as usize).max(fewest);
        let places: Vec<f64> = (0..=count).map(|i| place(&table, edges, i, count)).collect();
        places.windows(2).map(|w| Span { side, from: w[0], to: w[1] }).collect()
    }
}

/// The parameter at the end of part `i` of `count` parts of a side that are equal in the measure of
/// `table`.
fn place(table: &[(f64, f64)], edges: f64, i: usize, count: usize) -> f64 {
    if i == 0 || i == count {
        return if i == 0 { 0.0 } else { 1.0 };
    }
    let goal = edges * i as f64 / count as f64;
    let j = table.partition_point(|(_, e)| *e < goal).clamp(1, table.len() - 1);
    let ((t, e), (u, f)) = (table[j - 1], table[j]);
    t + (u - t) * ((goal - e) / (f - e).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
}

/// Joins the pieces of all sides to vertices and edges.
fn join(rims: &Rims, spans: &[Vec<Span>], field: impl Fn(&mut dyn Iterator<Item = &Span>) -> Field) -> Cut {
    let (mut vertices, mut edges) = (Vec::new(), Vec::new());
    let mut starts = vec![0; rims.sides.len()];
    for rim in &rims.loops {
        let first = vertices.len();
        for side in rim.clone() {
            starts[side] = vertices.len();
            for (i, span) in spans[side].iter().enumerate() {
                let here = vertices.len();
                let at = rims.sides[side].0.at(span.from);
                let on = if i == 0 {
                    vec![(rims.previous(side), 1.0), (side, 0.0)]
                } else {
                    vec![(side, span.from)]
                };
                vertices.push(Vertex { at, on });
                edges.push(([here, here + 1], *span));
            }
        }
        if let Some((ends, _)) = edges.last_mut() {
            ends[1] = first;
        }
    }
    let field = field(&mut spans.iter().flatten());
    Cut { vertices, edges, starts, field }
}

/// Best number of triangles at a corner with a given angle (rad): about 60° each.
pub(super) fn fan(angle: f64) -> usize {
    ((angle / (PI / 3.0)).round() as usize).max(1)
}
