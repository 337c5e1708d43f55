//! The eigenvalue problem of a rectangle: sides, edges, top frequency.

use super::super::bounds::Bounds;
use crate::PhysicsError;
use unripple_core::{Edge, Shape, Surface, require};

/// The eigenvalue problem of a rectangle: its sides, their edge conditions, and the modes requested.
#[derive(Debug)]
pub(crate) struct Problem {
    /// Width and height, in metres.
    pub(crate) sides: [f64; 2],
    /// The edges at the lower and upper end of x, then of y.
    pub(crate) edges: [[Edge; 2]; 2],
    /// The sheet, the top frequency and the accuracy.
    pub(crate) bounds: Bounds,
}

impl Problem {
    /// The problem of a surface; `None` unless it is a uniform, isotropic rectangle without holes and without elastic sides.
    pub(crate) fn of(surface: &Surface, bounds: Bounds) -> Result<Option<Self>, PhysicsError> {
        let Shape::Rectangle { width, height } = surface.outline.shape else { return Ok(None) };
        let positive = "a positive finite number";
        require("width", width > 0.0, positive, width)?;
        require("height", height > 0.0, positive, height)?;
        let edge = |side| surface.outline.edge(side);
        let edges = [[edge(3), edge(1)], [edge(0), edge(2)]];
        let springs = edges.as_flattened().iter().any(|e| matches!(e, Edge::Elastic { .. }));
        let plain = surface.outline.holes.is_empty() && surface.sheet.uneven.is_nothing() && !springs;
        Ok(plain.then_some(Self { sides: [width, height], edges, bounds }))
    }

    /// Whether every mode is a product of two waves.
    pub(crate) fn separable(&self) -> bool {
        self.bounds.medium.bending_stiffness == 0.0
            || self.edges.as_flattened().iter().all(|e| *e == Edge::Supported)
    }

    /// Whether x and y may be exchanged.
    pub(crate) fn square(&self) -> bool {
        self.sides[0] == self.sides[1] && self.edges[0] == self.edges[1]
    }

    /// Mass of the sheet, in kg.
    pub(crate) fn mass(&self) -> f64 {
        self.bounds.medium.areal_density * self.sides[0] * self.sides[1]
    }
}
