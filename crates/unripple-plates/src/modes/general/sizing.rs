//! Mesh size for a band and an accuracy: eighth-order convergence assumed.

use crate::Medium;
use crate::PhysicsError;
use crate::fabric::{Fabric, Local};
use crate::mesh::{Corner, Mesh, Sizing, corners};
use crate::modes::bounds::Bounds;
use std::f64::consts::PI;
use unripple_core::{Edge, Outline, Point, ScattererKind, Surface};

/// Edge length times wavenumber at the top of the band for which frequencies are right to 1e-3: edges of 0.56
/// wavelengths. Halved, the first mesh has four times the triangles.
const FILL: f64 = 3.5;

/// The order that errors fall with inside: by it an accuracy becomes an edge length. Were it lower, first
/// meshes would be finer than needed.
const ORDER: f64 = 8.0;

/// The least and largest edge in wavenumbers, whatever accuracy is asked for: 21 and 1.6 edges per
/// wavelength. What that does not resolve, refinements must.
const FILLS: [f64; 2] = [0.3, 4.0];

/// Unknowns for each vertex: six of its own and the middles of three edges, of which there are three per
/// vertex.
const UNKNOWNS: f64 = 9.0;

/// Edges along a held rim, in lengths √(D/T) of the layer where bending gives way to tension, at an accuracy
/// of 1e-3. Doubled, the layer is resolved half as well, and a refinement follows.
const LAYER: f64 = 4.0;

/// Places along each side of the bounding box where the fabric is looked at. What varies within a
/// thirty-second of a side may be passed over, and costs a refinement.
const LOOKS: usize = 33;

/// How finely a surface is meshed for an accuracy.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// Edge length inside, in metres.
    size: f64,
    /// What the last refinement divided it by.
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
    /// [`PhysicsError::Outline`] if the outline bounds no sheet.
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

    /// The sizing that the mesh is asked for.
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

    /// A plan likely to be accurate to `wanted`, after one that was off by `error`, both relative; finer by
    /// no more than half.
    pub(super) fn refined(&self, error: f64, wanted: f64) -> Self {
        // Somewhat finer than the error asks for; at least 1.25, so that the next difference tells something,
        // at most 2, which is four times the triangles.
        let ratio = (1.3 * error / wanted).powf(1.0 / (ORDER - 1.0)).clamp(1.25, 2.0);
        Self { ratio, accuracy: 0.25 * self.accuracy, ..self.coarser(1.0 / ratio) }
    }

    /// The factor by which it is finer than the plan before.
    pub(super) fn ratio(&self) -> f64 {
        self.ratio
    }

    /// The same for a top wavenumber lower by the factor `share`.
    pub(super) fn lower(&self, share: f64) -> Self {
        let share = share.max(1e-6);
        Self { wavenumber: self.wavenumber * share, ..self.coarser(1.0 / share) }
    }

    /// About the number of unknowns that it takes on an outline.
    pub(super) fn unknowns(&self, outline: &Outline) -> Result<usize, PhysicsError> {
        Ok((UNKNOWNS * Mesh::estimate(outline, &self.sizing())? as f64) as usize)
    }

    /// About the number of modes (Weyl 1911, rims aside).
    pub(super) fn modes(&self) -> usize {
        (self.area * self.wavenumber.powi(2) / (4.0 * PI)) as usize + 10
    }
}

/// The fabric at places all over an outline.
fn looks(outline: &Outline, fabric: &Fabric) -> Vec<Local> {
    let (width, height) = outline.extent();
    let at = |i: usize, side: f64| side * i as f64 / (LOOKS - 1) as f64;
    let places = (0..LOOKS * LOOKS).map(|i| Point::new(at(i % LOOKS, width), at(i / LOOKS, height)));
    match fabric.uniform() {
        Some(local) => vec![local],
        None => places.map(|p| fabric.bare(p)).collect(),
    }
}

/// The isotropic sheet on which waves are as short as the shortest on this one.
fn medium(local: &Local) -> Medium {
    let softest = local.bending[0].min(local.bending[3]);
    Medium { areal_density: local.mass, tension: local.tension, bending_stiffness: softest, air_sides: 0.0 }
}

/// The length √(D/T) over which a clamped rim's slope gives way to tension, in metres; infinite without either.
fn layer(local: &Local) -> f64 {
    let stiffest = local.bending[0].max(local.bending[3]);
    if stiffest > 0.0 && local.tension > 0.0 { (stiffest / local.tension).sqrt() } else { f64::INFINITY }
}
