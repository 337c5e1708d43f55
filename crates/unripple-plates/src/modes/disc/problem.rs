//! The eigenvalue problem of a round sheet: radius, rim, top frequency.

use super::super::bounds::Bounds;
use crate::PhysicsError;
use unripple_core::{Edge, Shape, Surface, require};

/// Functions that resolve a boundary layer, as a multiple of the root of the radius over its width. With half this value, a quarter more
/// functions leave half of the error, and the estimate of it is too low.
const RESOLVED: f64 = 1.5;

/// Largest number of functions for a boundary layer. With twice this value, an angular order takes eight times as long; thinner layers are left
/// to a mesh.
const LAYERED: f64 = 1000.0;

/// The eigenvalue problem of a round sheet with one edge condition all round.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Problem {
    /// Radius, in metres.
    pub(super) radius: f64,
    /// The condition at the rim.
    pub(super) edge: Edge,
    /// The sheet, the top frequency and the accuracy.
    pub(super) bounds: Bounds,
}

impl Problem {
    /// The problem of a surface; `None` unless it is a uniform, isotropic circle without holes.
    pub(crate) fn of(surface: &Surface, bounds: Bounds) -> Result<Option<Self>, PhysicsError> {
        let Shape::Circle { radius } = surface.outline.shape else { return Ok(None) };
        require("radius", radius > 0.0, "a positive finite number", radius)?;
        let edge = surface.outline.edge(0);
        // Springs against rotation do nothing on a sheet without bending stiffness.
        let tilted = matches!(edge, Edge::Elastic { tilt, .. } if tilt > 0.0)
            && bounds.medium.bending_stiffness == 0.0;
        let plain = surface.outline.holes.is_empty() && surface.sheet.uneven.is_uniform();
        let problem = Self { radius, edge, bounds };
        Ok((plain && !tilted && problem.in_layer() <= LAYERED).then_some(problem))
    }

    /// Number of functions that resolve the boundary layer at a rim that resists rotation, of the width √(D/T): polynomials of degree N tell
    /// places there apart that are a few N⁻² of the diameter from each other. From this number on, further ones gain more and more digits.
    pub(super) fn in_layer(&self) -> f64 {
        let layer = self.bounds.layer(self.edge).filter(|width| *width > 0.0);
        layer.map_or(0.0, |width| RESOLVED * (self.radius / width).sqrt())
    }

    /// Order of the zero of deflections at the rim.
    pub(super) fn zeros(&self) -> i32 {
        let most = if self.bounds.medium.bending_stiffness > 0.0 { 2 } else { 1 };
        match self.edge {
            Edge::Free | Edge::Elastic { .. } => 0,
            Edge::Supported => 1,
            Edge::Clamped => most,
        }
    }

    /// Stiffness of springs at the rim against displacement (N/m²) and rotation (N).
    pub(super) fn springs(&self) -> Option<[f64; 2]> {
        match self.edge {
            Edge::Elastic { lift, tilt } => Some([lift, tilt]),
            _ => None,
        }
    }

    /// Number of functions, the first, of an angular order that are rigid-body motions: they store no energy.
    pub(super) fn rigid(&self, order: usize) -> usize {
        let [lift, tilt] = match self.edge {
            Edge::Free => [0.0; 2],
            Edge::Elastic { lift, tilt } => [lift, tilt],
            _ => return 0,
        };
        let free =
            lift == 0.0 && (order == 0 || order == 1 && tilt == 0.0 && self.bounds.medium.tension == 0.0);
        usize::from(free)
    }
}
