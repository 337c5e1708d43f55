//! The desired edge lengths of a mesh.

use super::corner::{Corner, smallest_edge};
#[cfg(test)]
use super::field::GROWTH;
use crate::PhysicsError;
use unripple_core::{Point, require};

/// The desired edge lengths of a mesh.
#[derive(Clone, Debug)]
pub(crate) struct Sizing {
    /// Largest edge length, used unless a shorter one is desired, in metres.
    pub(crate) size: f64,
    /// Places with shorter edges: the place, the radius around it, and the edge length there, all in metres. A vertex is put at
    /// each place that is not too near a rim or another place.
    pub(crate) near: Vec<(Point, f64, f64)>,
    /// Edge length at the start of each side, in metres, in the order of
    /// [`Mesh::sides`](super::Mesh::sides); edges grow from there. Infinite, or missing at the end of the
    /// list, for no limit.
    pub(crate) corners: Vec<f64>,
    /// Greatest edge length along rims that are clamped or supported, in metres.
    pub(crate) edge_size: Option<f64>,
    /// Growth of the edge length per distance from shorter edges, more than 0 and at most [`GROWTH`](super::GROWTH).
    pub(crate) growth: f64,
    /// Factor by which edges are shorter along curved rims and in narrow places than a mesh needs to follow them; 1 is usual.
    pub(crate) finer: f64,
}

impl Sizing {
    /// Edges of one length `size` (m) everywhere.
    #[cfg(test)]
    pub(crate) fn even(size: f64) -> Self {
        let (near, corners) = (Vec::new(), Vec::new());
        Self { size, near, corners, edge_size: None, growth: GROWTH, finer: 1.0 }
    }

    /// Returns this sizing, with edges at the corners of an outline short enough for eigenvalues with the
    /// relative `accuracy`.
    pub(crate) fn refined(mut self, corners: &[Corner], bending: bool, accuracy: f64) -> Self {
        let smallest = |corner: &Corner| {
            let share = smallest_edge(corner, self.size, bending, accuracy);
            if share < 1.0 { share * self.size } else { f64::INFINITY }
        };
        self.corners = corners.iter().map(smallest).collect();
        self
    }

    /// Refuses lengths that are not positive.
    pub(super) fn check(&self) -> Result<(), PhysicsError> {
        let positive =
            |what: &'static str, value: f64| require(what, value > 0.0, "a positive finite number", value);
        positive("edge length of a mesh in m", self.size)?;
        self.edge_size.map_or(Ok(()), |size| positive("edge length along rims in m", size))?;
        for (place, reach, edge) in &self.near {
            require(
                "place of short edges in m",
                place.is_finite(),
                "a place on the sheet",
                place.x + place.y,
            )?;
            require("reach of short edges in m", *reach >= 0.0, "0 or more", *reach)?;
            positive("edge length near a place in m", *edge)?;
        }
        positive("growth of edge lengths per distance", self.growth)?;
        positive("fineness of edges along curved rims", self.finer)?;
        let corner = |edge: &f64| {
            if *edge > 0.0 { Ok(()) } else { positive("edge length at a corner in m", *edge) }
        };
        Ok(self.corners.iter().try_for_each(corner)?)
    }
}
