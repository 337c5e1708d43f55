//! Mesh size for a band and an accuracy, with eighth-order convergence assumed.

use crate::Medium;
use crate::PhysicsError;
use crate::fabric::{Fabric, Local};
use crate::mesh::{Corner, Mesh, Sizing, corners};
use crate::modes::bounds::Bounds;
use std::f64::consts::PI;
use unripple_core::{Edge, Outline, Point, ScattererKind, Surface};

/// Edge length times wavenumber at the top of the band for which frequencies are accurate to 1e-3: edges of 0.56
/// wavelengths. Halved, the first mesh has four times the triangles.
const FILL: f64 = 3.5;

/// Order of convergence in the edge length, from which the edge length for an accuracy follows. If it were lower, first
/// meshes would be finer than needed.
const ORDER: f64 = 8.0;

/// Least and largest edge length times wavenumber, whatever the accuracy: 21 and 1.6 edges per
/// wavelength. Refinements resolve what these do not.
const FILLS: [f64; 2] = [0.3, 4.0];

/// Number of unknowns for each vertex: six of its own and one for each edge, of which there are three per
/// vertex.
const UNKNOWNS: f64 = 9.0;

/// Edge length along a clamped rim at an accuracy of 1e-3, in multiples of √(D/T), the width of the boundary layer where
/// bending gives way to tension. With twice this value, the layer is resolved half as well, and a refinement follows.
const LAYER: f64 = 4.0;

/// Number of places along each side of the bounding box at which the sheet's properties are sampled. Variation within a
/// thirty-second of a side may be missed, and costs a refinement.
const LOOKS: usize = 33;

/// The edge lengths of a mesh for a surface and an accuracy.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// Edge length inside, in metres.
    size: f64,
    /// Factor by which the last refinement shortened the edges.
    ratio: f64,
    /// Accuracy that corners are graded for.
    accuracy: f64,
    /// Largest edge along held rims, as a share of `size`; 1 where there is no layer.
    layer: f64,
    bends: bool,
    near: Vec<(Point, f64, f64)>,
    /// Where sides meet.
    corners: Vec<Corner>,
    /// Largest wavenumber anywhere, in rad/m.
    wavenumber: f64,
    area: f64,
}

impl Plan {
    /// A plan that is likely to give the accuracy of `bounds`.
    ///
    /// # Errors
    /// [`PhysicsError::Outline`] for an invalid outline.
    pub(super) fn new(surface: &Surface, fabric: &Fabric, bounds: &Bounds) -> Result<Self, PhysicsError> {
        let omega = bounds.top_square().sqrt();
        let locals = looks(&surface.outline, fabric);
        let wavenumber = locals.iter().map(|l| medium(l).wavenumber(omega)).fold(0.0, f64::max);
        let finer = (bounds.accuracy / 1e-3).powf(1.0 / ORDER);
        let fill = (FILL * finer).clamp(FILLS[0], FILLS[1]);
        let size = fill / wavenumber;
        let clamped =
            surface.outline.loops().iter().any(|rim| rim.sides.iter().any(|(_, e)| *e == Edge::Clamped));
        let layer =
            locals.iter().filter(|_| clamped).map(|l| layer(l) * LAYER * finer / size).fold(1.0, f64::min);
        let near = surface.sheet.uneven.scatterers.iter().map(|scatterer| match scatterer.kind {
            ScattererKind::Mass(_) => (scatterer.at, 0.0, 0.25 * size),
            ScattererKind::Disc { radius, .. } => {
                (scatterer.at, 1.1 * radius, (0.5 * radius).min(0.5 * size))
            }
        });
        let corners = corners(&surface.outline)?;
        Ok(Self {
            size,
            ratio: 1.0,
            accuracy: bounds.accuracy,
            layer,
            bends: fabric.bends(),
            near: near.collect(),
            corners,
            wavenumber,
            area: surface.outline.area(),
        })
    }

    /// The sizing for the mesh generator.
    pub(super) fn sizing(&self) -> Sizing {
        let edge_size = (self.layer < 1.0).then_some(self.layer * self.size);
        let sizing = Sizing { size: self.size, near: self.near.clone(), corners: Vec::new(), edge_size };
        sizing.refined(&self.corners, self.bends, self.accuracy)
    }

    /// A plan with edges `ratio` times longer.
    pub(super) fn coarser(&self, ratio: f64) -> Self {
        let near = self.near.iter().map(|(at, reach, size)| (*at, *reach, size * ratio)).collect();
        Self {
            size: self.size * ratio,
            near,
            ratio: 1.0 / ratio,
            accuracy: 4.0 * self.accuracy,
            ..self.clone()
        }
    }

    /// A plan likely to have the relative error `wanted`, after this one had `error`; edges are shortened by at most a factor
    /// of 2.
    pub(super) fn refined(&self, error: f64, wanted: f64) -> Self {
        // Somewhat finer than the error requires; at least 1.25, so that the next difference is above rounding,
        // at most 2, which is four times the triangles.
        let ratio = (1.3 * error / wanted).powf(1.0 / (ORDER - 1.0)).clamp(1.25, 2.0);
        Self { ratio, accuracy: 0.25 * self.accuracy, ..self.coarser(1.0 / ratio) }
    }

    /// The factor by which this plan is finer than the plan before.
    pub(super) fn ratio(&self) -> f64 {
        self.ratio
    }

    /// This plan for a top wavenumber lower by the factor `share`.
    pub(super) fn lower(&self, share: f64) -> Self {
        let share = share.max(1e-6);
        Self { wavenumber: self.wavenumber * share, ..self.coarser(1.0 / share) }
    }

    /// Approximate number of unknowns of the plan on an outline.
    pub(super) fn unknowns(&self, outline: &Outline) -> Result<usize, PhysicsError> {
        Ok((UNKNOWNS * Mesh::estimate(outline, &self.sizing())? as f64) as usize)
    }

    /// Approximate number of modes (Weyl 1911, without the term of the perimeter).
    pub(super) fn modes(&self) -> usize {
        (self.area * self.wavenumber.powi(2) / (4.0 * PI)) as usize + 10
    }
}

/// The properties of the sheet at a grid of places over an outline; a single one for a uniform sheet.
fn looks(outline: &Outline, fabric: &Fabric) -> Vec<Local> {
    let (width, height) = outline.extent();
    let at = |i: usize, side: f64| side * i as f64 / (LOOKS - 1) as f64;
    let places = (0..LOOKS * LOOKS).map(|i| Point::new(at(i % LOOKS, width), at(i / LOOKS, height)));
    match fabric.uniform() {
        Some(local) => vec![local],
        None => places.map(|p| fabric.bare(p)).collect(),
    }
}

/// The isotropic sheet whose waves are as short as the shortest waves on this one.
fn medium(local: &Local) -> Medium {
    let softest = local.bending[0].min(local.bending[3]);
    Medium { areal_density: local.mass, tension: local.tension, bending_stiffness: softest, air_sides: 0.0 }
}

/// Width √(D/T) of the boundary layer at a clamped rim, in metres; infinite if there is no tension or no bending stiffness.
fn layer(local: &Local) -> f64 {
    let stiffest = local.bending[0].max(local.bending[3]);
    if stiffest > 0.0 && local.tension > 0.0 { (stiffest / local.tension).sqrt() } else { f64::INFINITY }
}
