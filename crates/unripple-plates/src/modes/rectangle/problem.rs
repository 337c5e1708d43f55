//! The eigenvalue problem of a rectangle: sides, edges, top frequency.

use super::super::bounds::Bounds;
use crate::PhysicsError;
use unripple_core::{Edge, Shape, Surface, require};

/// The eigenvalue problem of a rectangle: its sides, their edge conditions, and the modes requested.
#[derive(Debug)]
pub(crate) struct Problem {
    /// Width and height, in metres.
    pub(crate) sides: [f64; 2],
    /// The edge conditions at the lower and upper end of x, then of y.
    pub(crate) edges: [[Edge; 2]; 2],
    /// The sheet, the top frequency and the accuracy.
    pub(crate) bounds: Bounds,
}

impl Problem {
    /// The problem of a surface; `None` unless it is a uniform, isotropic rectangle without holes, and not a membrane with
    /// elastic sides.
    pub(crate) fn of(surface: &Surface, bounds: Bounds) -> Result<Option<Self>, PhysicsError> {
        let Shape::Rectangle { width, height } = surface.outline.shape else { return Ok(None) };
        let positive = "a positive finite number";
        require("width", width > 0.0, positive, width)?;
        require("height", height > 0.0, positive, height)?;
        let edge = |side| surface.outline.edge(side);
        let edges = [[edge(3), edge(1)], [edge(0), edge(2)]];
        let problem = Self { sides: [width, height], edges, bounds };
        // The Ritz functions are those of a sheet with bending stiffness, and waves between elastic sides have no closed form.
        let membrane = bounds.medium.bending_stiffness == 0.0 && problem.has_springs();
        let plain = surface.outline.holes.is_empty() && surface.sheet.uneven.is_uniform();
        Ok((plain && !membrane && !problem.is_hinged()).then_some(problem))
    }

    /// Whether springs against displacement along one side alone hold the sheet, which then turns about that side: a rigid-body mode that is
    /// no single product of functions.
    fn is_hinged(&self) -> bool {
        let lifted = |edge: &&Edge| matches!(edge, Edge::Elastic { lift, .. } if *lift > 0.0);
        let sides = self.edges.as_flattened();
        let others_move = sides.iter().all(|edge| edge.moves());
        others_move && self.bounds.medium.tension == 0.0 && sides.iter().filter(lifted).count() == 1
    }

    /// Whether a side is elastic.
    pub(crate) fn has_springs(&self) -> bool {
        self.edges.as_flattened().iter().any(|edge| matches!(edge, Edge::Elastic { .. }))
    }

    /// Whether every mode is a product of a sine or cosine along each side.
    pub(crate) fn separable(&self) -> bool {
        self.bounds.medium.bending_stiffness == 0.0
            || self.edges.as_flattened().iter().all(|e| *e == Edge::Supported)
    }

    /// Whether the problem is unchanged if x and y are exchanged.
    pub(crate) fn square(&self) -> bool {
        self.sides[0] == self.sides[1] && self.edges[0] == self.edges[1]
    }

    /// Mass of the sheet, in kg.
    pub(crate) fn mass(&self) -> f64 {
        self.bounds.medium.areal_density * self.sides[0] * self.sides[1]
    }
}
