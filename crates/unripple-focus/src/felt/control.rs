//! Control points at which the felt displacement outside the targets is bounded.

use super::reduced::Reduced;
use unripple_core::{Outline, Point};
use unripple_linalg::{Mat, Scale, product};

/// Points whose shape weights are computed at once. With twice this value, twice the memory for them; results stay the
/// same.
const AT_ONCE: usize = 1024;

/// Along each side, every third point of the lattice belongs to the coarse lattice. With twice this spacing, the
/// lattice near targets and actuators has four times the points.
const COARSE: usize = 3;

/// Control points at which the felt displacement is evaluated, on a lattice over the outline's bounding box.
#[derive(Clone, Debug)]
pub(crate) struct Control {
    /// The lattice points within the outline.
    pub points: Vec<Point>,
    /// Mode shapes at the points, then the static deflections (springs) per actuator of all higher modes:
    /// (modes and springs) x points.
    pub shapes: Mat<f32>,
    /// Distance between neighbouring points of the fine lattice, in metres.
    pub pitch: f64,
    /// Whether each point is evaluated wherever the targets are; the others only near targets.
    coarse: Vec<bool>,
}

/// A lattice that is fine around targets, and around actuators, where the surface is bent sharply, and coarse elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lattice {
    /// Columns and rows.
    cells: [usize; 2],
    pitch: f64,
}

impl Lattice {
    /// A lattice whose coarse points are at most `pitch` metres apart, at least 8 of them along the shorter
    /// side.
    pub fn new(outline: &Outline, pitch: f64) -> Self {
        let (width, height) = outline.extent();
        let pitch = pitch.min(width.min(height) / 8.0) / COARSE as f64;
        let cells = [width, height].map(|side| ((side / pitch).ceil() as usize).max(1));
        Self { cells, pitch }
    }

    /// Number of lattice points, including those outside the outline.
    pub fn count(&self) -> usize {
        self.cells[0].saturating_mul(self.cells[1])
    }

    /// The points within the outline, and whether each belongs to the coarse lattice.
    fn points(&self, outline: &Outline) -> (Vec<Point>, Vec<bool>) {
        let (width, height) = outline.extent();
        let place = |cell: usize, side: f64, cells: usize| (cell as f64 + 0.5) * side / cells as f64;
        let [columns, rows] = self.cells;
        let all = (0..self.count()).map(|i| {
            let (column, row) = (i % columns, i / columns);
            let at = Point::new(place(column, width, columns), place(row, height, rows));
            (at, column % COARSE == 1 && row % COARSE == 1)
        });
        all.filter(|(at, _)| outline.contains(*at)).unzip()
    }
}

impl Control {
    /// Evaluates the mode shapes of `watched` at the control points, and the mean over the surface of the
    /// product of each two mode shapes of `heard`, modes x modes.
    pub fn read(
        outline: &Outline,
        lattice: Lattice,
        watched: &Reduced<'_>,
        heard: &Reduced<'_>,
    ) -> (Self, Mat<f64>) {
        let (points, mut coarse) = lattice.points(outline);
        for port in watched.ports() {
            let near = |p: &Point| p.distance(port.at) < COARSE as f64 / 2.0 * lattice.pitch;
            coarse.iter_mut().zip(&points).for_each(|(coarse, p)| *coarse |= near(p));
        }
        let mut shapes = Mat::zeros(watched.count(), points.len());
        let mut products = Mat::zeros(heard.count(), heard.count());
        for (chunk, some) in points.chunks(AT_ONCE).enumerate() {
            let read = heard.at_all(some);
            products += product(read.transpose(), read.as_ref());
            let read = watched.at_all(some);
            for p in 0..some.len() {
                (0..watched.count()).for_each(|m| shapes[(m, chunk * AT_ONCE + p)] = read[(p, m)] as f32);
            }
        }
        products *= Scale(1.0 / points.len().max(1) as f64);
        (Self { points, shapes, pitch: lattice.pitch, coarse }, products)
    }

    /// Distance between neighbouring points of the coarse lattice, in metres.
    pub fn coarse_pitch(&self) -> f64 {
        self.pitch * COARSE as f64
    }

    /// Indices of the control points farther than `radius` (m) from all `targets`: all such points of the
    /// coarse lattice, and those of the fine lattice that are within one pitch of this radius.
    pub fn outside(&self, targets: &[Point], radius: f64) -> Vec<usize> {
        let nearest = |p: &Point| targets.iter().map(|t| t.distance(*p)).fold(f64::INFINITY, f64::min);
        let apart = |i: &usize| {
            let distance = nearest(&self.points[*i]);
            distance > radius && (self.coarse[*i] || distance <= radius + self.pitch)
        };
        (0..self.points.len()).filter(apart).collect()
    }
}
