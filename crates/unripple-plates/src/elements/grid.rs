//! Point location: which triangle a point lies in.

use super::element::Element;
use crate::mesh::Mesh;
use unripple_core::{Point, Side};

/// A point outside a triangle by up to this distance, in units of the triangle's size, counts as on its
/// edge: some million times the rounding error. With twice this value, points up to twice as far outside
/// are used as they are instead of the nearest point of the rim.
const ON: f64 = 1e-9;

/// Number of points of a curve from which a bounding box is computed; the box is widened by the curve's
/// chord over twice this number. With twice this value, boxes of curved triangles are tighter.
const STEPS: usize = 8;

/// A regular grid of cells, each with the triangles whose bounding boxes meet it, and the rims with their triangles.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    corner: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    /// Index in `members` where each cell's triangles begin, and the end of the last.
    starts: Vec<usize>,
    members: Vec<usize>,
    /// The sides of rims, each with the triangles along it and the side's parameter at which each triangle
    /// starts.
    rims: Vec<(Side, Vec<(f64, usize)>)>,
}

/// Lower-left and upper-right corners of a box.
type Bounds = [Point; 2];

impl Grid {
    /// The grid of a mesh with as many cells as triangles.
    pub(crate) fn new(mesh: &Mesh, elements: &[Element]) -> Self {
        let boxes: Vec<Bounds> = elements.iter().map(bounds).collect();
        let around = boxes.iter().copied().reduce(|all, one| join(all, &one));
        let [corner, far] = around.unwrap_or_default();
        let (width, height) = (far.x - corner.x, far.y - corner.y);
        let cell = (width * height / elements.len().max(1) as f64).sqrt().max(f64::MIN_POSITIVE);
        let count = |length: f64| ((length / cell).ceil() as usize).clamp(1, elements.len().max(1));
        let (columns, rows) = (count(width), count(height));
        let empty = Self { corner, cell, columns, rows, starts: vec![], members: vec![], rims: rims(mesh) };
        let mut cells = vec![Vec::new(); columns * rows];
        for (e, [low, high]) in boxes.iter().enumerate() {
            let ([i0, j0], [i1, j1]) = (empty.cell_of(*low), empty.cell_of(*high));
            for j in j0..=j1 {
                cells[j * columns + i0..=j * columns + i1].iter_mut().for_each(|c| c.push(e));
            }
        }
        let mut starts = vec![0];
        starts.extend(cells.iter().scan(0, |sum, cell| {
            *sum += cell.len();
            Some(*sum)
        }));
        Self { starts, members: cells.concat(), ..empty }
    }

    fn cell_of(&self, p: Point) -> [usize; 2] {
        let place = |x: f64, count: usize| ((x / self.cell) as usize).min(count - 1);
        [place(p.x - self.corner.x, self.columns), place(p.y - self.corner.y, self.rows)]
    }

    /// Index of the triangle that contains a point (m), and the point itself; for a point outside the
    /// sheet, the nearest point of the rim and its triangle.
    pub(crate) fn locate(&self, elements: &[Element], p: Point) -> (usize, Point) {
        let [i, j] = self.cell_of(p);
        let cell = j * self.columns + i;
        let mut best = (f64::NEG_INFINITY, 0);
        for &e in &self.members[self.starts[cell]..self.starts[cell + 1]] {
            let depth = elements[e].depth(p);
            if depth > best.0 {
                best = (depth, e);
            }
        }
        if best.0 >= -ON { (best.1, p) } else { self.on_rim(p) }
    }

    /// The nearest point of the rim, and its triangle.
    fn on_rim(&self, p: Point) -> (usize, Point) {
        let nearest = self
            .rims
            .iter()
            .map(|(side, along)| {
                let t = side.nearest(p);
                (side.at(t), t, along)
            })
            .min_by(|a, b| a.0.distance(p).total_cmp(&b.0.distance(p)));
        let Some((at, t, along)) = nearest else { return (0, p) };
        let after = along.partition_point(|(from, _)| *from <= t);
        (along.get(after.saturating_sub(1)).map_or(0, |(_, e)| *e), at)
    }
}

/// The sides of rims, each with the triangles along it in order.
fn rims(mesh: &Mesh) -> Vec<(Side, Vec<(f64, usize)>)> {
    let mut rims: Vec<_> = mesh.sides.iter().map(|(side, _)| (*side, Vec::new())).collect();
    for (t, triangle) in mesh.triangles.iter().enumerate() {
        for span in triangle.edges.iter().filter_map(|e| mesh.edges[*e].span) {
            if let Some((_, along)) = rims.get_mut(span.side) {
                along.push((span.from, t));
            }
        }
    }
    rims.iter_mut().for_each(|(_, along)| along.sort_by(|a, b| a.0.total_cmp(&b.0)));
    rims.retain(|(_, along)| !along.is_empty());
    rims
}

/// A box around a triangle with its curved edges.
pub(crate) fn bounds(element: &Element) -> Bounds {
    let first = element.borders[0].at(0.0);
    let mut all = [first; 2];
    for border in &element.borders {
        let steps = if border.is_straight() { 1 } else { STEPS };
        let points = (0..steps).map(|i| border.at(i as f64 / steps as f64));
        all = points.fold(all, |b, p| join(b, &[p; 2]));
        if steps > 1 {
            // Between these points, the curve is at most this far from its chords.
            let reach = border.at(0.0).distance(border.at(1.0)) / (2 * steps) as f64;
            let [low, high] = all;
            all = [Point::new(low.x - reach, low.y - reach), Point::new(high.x + reach, high.y + reach)];
        }
    }
    all
}

fn join([low, high]: Bounds, [a, b]: &Bounds) -> Bounds {
    [
        Point::new(low.x.min(a.x).min(b.x), low.y.min(a.y).min(b.y)),
        Point::new(high.x.max(a.x).max(b.x), high.y.max(a.y).max(b.y)),
    ]
}
