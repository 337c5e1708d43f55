//! Estimate of the number of vertices of a mesh before it is made.

use super::region::Region;
use super::rim::cut;
use super::sizing::Sizing;
use super::{Mesh, field::Field};
use crate::PhysicsError;
use std::f64::consts::PI;
use unripple_core::plane::{Bounds, Rims};
use unripple_core::{Edge, OutOfRange, Outline, Point};

/// Number of halvings of a cell after which its centre is taken for all of it: 30 along each direction, a
/// billionth of the outline. One more doubles the cells only where shorter edges are desired.
const DEEPEST: u32 = 60;

/// Number of vertices up to which an estimate integrates the density of vertices; for more, a rough sum is used, so that an
/// estimate takes little time.
const COUNTED: f64 = 1e6;
/// Largest number of vertices of a mesh: more would not fit into the memory allowed for modes. With twice this value, such a mesh
/// is refused after the estimate rather than at once.
const MOST: f64 = 1e7;

impl Mesh {
    /// Estimated number of vertices of a mesh, from the rims of the outline and the desired edge lengths.
    ///
    /// # Errors
    /// As [`Mesh::new`], except for too many vertices.
    pub(crate) fn estimate(outline: &Outline, sizing: &Sizing) -> Result<usize, PhysicsError> {
        sizing.check()?;
        let rims = Rims::new(outline)?;
        let rough = rough(&rims, outline.area(), sizing);
        if rough > COUNTED {
            return Ok(rough as usize);
        }
        let cut = cut(&rims, sizing, sizing.finer);
        let at = |i: usize| cut.vertices[i].at;
        let region = Region::new(cut.edges.iter().map(|(ends, _)| ends.map(at)).collect());
        let all: Vec<Point> = cut.vertices.iter().map(|v| v.at).collect();
        let bounds = Bounds::around(&all, 0.0);
        let size = cut.field.at(bounds.centre());
        let within = density(&region, &cut.field, (bounds, size), DEEPEST);
        // Vertices on rims have only half the triangles of those inside.
        Ok((within + 0.5 * all.len() as f64) as usize)
    }
}

/// Refuses a mesh of an area (m²) that would have too many vertices.
pub(super) fn check_count(rims: &Rims, area: f64, sizing: &Sizing) -> Result<(), PhysicsError> {
    let count = rough(rims, area, sizing);
    if count <= MOST {
        return Ok(());
    }
    Err(PhysicsError::Range(OutOfRange::new(
        "edge lengths of a mesh, by the vertices they take",
        format!("at most {MOST:e}"),
        count,
    )))
}

/// A rough number of vertices for a sizing, without the extra ones at curves, corners and narrow places.
fn rough(rims: &Rims, area: f64, sizing: &Sizing) -> f64 {
    let each = |size: f64| size * size * 0.75_f64.sqrt();
    let inside = area / each(sizing.size);
    let length = |held: bool| {
        let sides =
            rims.sides.iter().filter(|(_, edge)| matches!(edge, Edge::Clamped | Edge::Supported) == held);
        sides.map(|(side, _)| side.length()).sum::<f64>()
    };
    let layer = sizing.edge_size.map_or(0.0, |edge| {
        let extra = (1.0 / edge - 1.0 / sizing.size).max(0.0);
        length(true) * extra * (1.0 / (sizing.growth * 0.75_f64.sqrt()) + 0.5)
    });
    let near = sizing.near.iter().map(|(_, reach, edge)| (PI * reach * reach).min(area) / each(*edge));
    let rims = 0.5 * (length(true) + length(false)) / sizing.size;
    inside + rims + layer + near.sum::<f64>()
}

/// The integral of 1/(h² √¾) over the part of a box that lies within the region, with h the desired edge length, which is `size` in the
/// middle of the box.
fn density(region: &Region, field: &Field, (bounds, size): (Bounds, f64), depth: u32) -> f64 {
    let (width, height) = (bounds.high.x - bounds.low.x, bounds.high.y - bounds.low.y);
    let (centre, longer) = (bounds.centre(), width.max(height));
    let whole = width * height / (size * size * 0.75_f64.sqrt());
    let cut = region.cuts(&bounds);
    let small = longer < 0.5 * size;
    let settled = small || (!cut && field.is_common(size) && field.is_even(&bounds));
    if settled || depth == 0 || (!cut && !region.contains(centre)) {
        return if region.contains(centre) { whole } else { 0.0 };
    }
    let (low, high) = (bounds.low, bounds.high);
    let halves = if width > height {
        [
            Bounds { low, high: Point::new(centre.x, high.y) },
            Bounds { low: Point::new(centre.x, low.y), high },
        ]
    } else {
        [
            Bounds { low, high: Point::new(high.x, centre.y) },
            Bounds { low: Point::new(low.x, centre.y), high },
        ]
    };
    let half = |half: Bounds| {
        let size = field.near(half.centre(), size, 0.25 * longer);
        density(region, field, (half, size), depth - 1)
    };
    halves.into_iter().map(half).sum()
}
