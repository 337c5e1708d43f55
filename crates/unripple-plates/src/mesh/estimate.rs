//! Number of vertices that a sizing will take, before there is a mesh.

use super::region::Region;
use super::rim::cut;
use super::sizing::Sizing;
use super::{Mesh, field::Field, field::GROWTH};
use crate::PhysicsError;
use std::f64::consts::PI;
use unripple_core::plane::{Bounds, Rims};
use unripple_core::{Edge, OutOfRange, Outline, Point};

/// Halvings of a cell after which its middle speaks for it: 30 along each direction, a billionth of the
/// outline. One more doubles the cells only where edges are wanted shorter than that.
const DEEPEST: u32 = 60;

/// Vertices that are counted one by one; of more, what rims and places ask for is only added up, so that an
/// estimate takes little time.
const COUNTED: f64 = 1e6;
/// Most vertices of a mesh: more would not fit into the memory that modes are allowed. Doubled, such a mesh
/// is refused after it was estimated rather than at once.
const MOST: f64 = 1e7;

impl Mesh {
    /// About how many vertices a mesh will have, from its rims and the lengths wanted within.
    ///
    /// # Errors
    /// As [`Mesh::new`], but for the number of vertices.
    pub(crate) fn estimate(outline: &Outline, sizing: &Sizing) -> Result<usize, PhysicsError> {
        sizing.check()?;
        let rims = Rims::new(outline)?;
        let rough = rough(&rims, outline.area(), sizing);
        if rough > COUNTED {
            return Ok(rough as usize);
        }
        let cut = cut(&rims, sizing, 1.0);
        let at = |i: usize| cut.vertices[i].at;
        let region = Region::new(cut.edges.iter().map(|(ends, _)| ends.map(at)).collect());
        let all: Vec<Point> = cut.vertices.iter().map(|v| v.at).collect();
        let within = density(&region, &cut.field, Bounds::around(&all, 0.0), DEEPEST);
        // Of the vertices of equilateral triangles, those of rims have but half their triangles.
        Ok((within + 0.5 * all.len() as f64) as usize)
    }
}

/// A typed error if a mesh of an area (m²) would have more vertices than can be handled.
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

/// The vertices that a sizing asks for, without what curves, corners and narrow places need.
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
        length(true) * extra * (1.0 / (GROWTH * 0.75_f64.sqrt()) + 0.5)
    });
    let near = sizing.near.iter().map(|(_, reach, edge)| (PI * reach * reach).min(area) / each(*edge));
    inside + 0.5 * (length(true) + length(false)) / sizing.size + layer + near.sum::<f64>()
}

/// The integral of 1/(h² √¾) over what of a box lies within, h the length wanted.
fn density(region: &Region, field: &Field, bounds: Bounds, depth: u32) -> f64 {
    let (width, height) = (bounds.high.x - bounds.low.x, bounds.high.y - bounds.low.y);
    let (centre, longer) = (bounds.centre(), width.max(height));
    let size = field.at(centre);
    let whole = width * height / (size * size * 0.75_f64.sqrt());
    let cut = region.cuts(&bounds);
    let settled = if cut { longer < 0.5 * size } else { longer < 0.5 * size || field.is_even(&bounds) };
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
    halves.into_iter().map(|half| density(region, field, half, depth - 1)).sum()
}
