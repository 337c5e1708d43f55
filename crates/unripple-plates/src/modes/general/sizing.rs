//! Edge lengths of a mesh for a band and an accuracy, assuming convergence of eighth order; edges near
//! singular points are refined at the same pace.

use crate::Medium;
use crate::PhysicsError;
use crate::fabric::{Fabric, Local};
use crate::mesh::{Corner, GROWTH, Mesh, Sizing, corners, growth, singular, unresolved};
use crate::modes::bounds::Bounds;
use std::f64::consts::PI;
use unripple_core::{Edge, Outline, Point, Scatterer, ScattererKind, Surface};

/// Edge length times wavenumber at the top of the band with which the estimated error of frequencies is
/// about 1e-3: edges of 0.45 wavelengths. Halved, the first mesh has four times the triangles.
const FILL: f64 = 2.8;

/// Order of convergence in the edge length, from which the edge length for an accuracy is computed. If it
/// were lower, first meshes would be finer than needed.
const ORDER: f64 = 8.0;

/// Order in the edge length at which the errors at corners and masses are made to fall from one mesh to the
/// next: an order that errors elsewhere are sure to reach. A comparison of meshes then shows all of them.
pub(super) const PACE: f64 = 6.0;

/// Share of the requested accuracy that the errors at all corners together may take.
const AT_CORNERS: f64 = 0.2;

/// Relative error down to which edges grow by [`GROWTH`] per distance from shorter ones wherever they are short, as in boundary layers; for
/// smaller errors they grow by less, since what rings of longer and longer triangles miss falls as the eighth power of the growth. Where
/// edges grew by [`GROWTH`] at 1e-6 too, a ring under tension lost two digits.
const COMMON: f64 = 1e-4;

/// Least growth of edges per distance: along a line away from a corner each edge is a tenth longer than the
/// edge before. Halved, a corner would take four times the triangles.
const LEAST_GROWTH: f64 = 0.1;

/// Least and largest edge length times wavenumber, for any accuracy: 21 and 1.6 edges per wavelength.
/// Refinements resolve what these do not.
const FILLS: [f64; 2] = [0.3, 4.0];

/// Number of unknowns per vertex of the mesh: six of the vertex and one for each edge; there are three
/// edges per vertex.
const UNKNOWNS: f64 = 9.0;

/// Edge length along a clamped rim at an accuracy of 1e-3, in multiples of √(D/T), the width of the boundary layer where
/// bending gives way to tension. With twice this value, the layer is resolved half as well, and a refinement follows.
const LAYER: f64 = 4.0;

/// Longest edge under a disc at an accuracy of 1e-3, relative to the disc's radius: the rim is divided into
/// eighteen edges. With 0.5, the first meshes tell no rate, and a fourth follows.
const IN_DISC: f64 = 0.35;

/// Number of places along each side of the bounding box at which the sheet's properties are sampled. Variation within a
/// thirty-second of a side may be missed, and costs a refinement.
const LOOKS: usize = 33;

/// A point mass, and the edge length at it.
#[derive(Clone, Copy, Debug)]
struct AtMass {
    at: Point,
    /// Edge length at the mass, in metres.
    edge: f64,
}

/// A glued disc, and the edge length under it and around its rim, all in metres.
#[derive(Clone, Copy, Debug)]
struct AtDisc {
    at: Point,
    radius: f64,
    edge: f64,
}

/// The edge lengths of a mesh for a surface and an accuracy.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// Edge length away from corners, masses and discs, in metres.
    size: f64,
    /// Relative error that each corner may cause.
    accuracy: f64,
    /// Growth of edges per distance from shorter edges.
    growth: f64,
    /// Factor by which edges along curves and in narrow places are shorter than needed to follow them.
    finer: f64,
    /// Largest edge along clamped and supported rims, relative to `size`; 1 if there is no boundary layer.
    layer: f64,
    bends: bool,
    masses: Vec<AtMass>,
    discs: Vec<AtDisc>,
    /// The corners, where sides meet.
    corners: Vec<Corner>,
    /// Largest wavenumber at any place of the sheet, in rad/m.
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
        let narrowest = locals.iter().map(layer).fold(f64::INFINITY, f64::min);
        let in_layer = (narrowest * LAYER * finer).min(size);
        let layer = if clamped { in_layer / size } else { 1.0 };
        let masses = masses(surface, size, bounds.accuracy);
        let discs = discs(surface, in_layer, finer);
        let corners = corners(&surface.outline)?;
        let at_corners = AT_CORNERS * bounds.accuracy;
        let count = singular(&corners, size, fabric.bends(), at_corners).max(1);
        let each = at_corners / count as f64;
        let common = GROWTH * (bounds.accuracy / COMMON).powf(1.0 / ORDER).min(1.0);
        Ok(Self {
            size,
            accuracy: each,
            growth: growth(&corners, size, fabric.bends(), each, at_corners).min(common),
            finer: 1.0,
            layer,
            bends: fabric.bends(),
            masses,
            discs,
            corners,
            wavenumber,
            area: surface.outline.area(),
        })
    }

    /// The sizing for the mesh generator.
    pub(super) fn sizing(&self) -> Sizing {
        let edge_size = (self.layer < 1.0).then_some(self.layer * self.size);
        let masses = self.masses.iter().map(|mass| (mass.at, 0.0, mass.edge));
        let discs = self.discs.iter().map(|disc| (disc.at, 1.1 * disc.radius, disc.edge));
        let sizing = Sizing {
            size: self.size,
            near: masses.chain(discs).collect(),
            corners: Vec::new(),
            edge_size,
            growth: GROWTH,
            finer: self.finer,
        };
        let sizing = sizing.refined(&self.corners, self.bends, self.accuracy);
        Sizing { growth: self.growth.clamp(LEAST_GROWTH, GROWTH), ..sizing }
    }

    /// A plan with edges `ratio` times longer; at corners and masses edges are lengthened so much that the
    /// errors there rise as the power [`PACE`] of the ratio.
    pub(super) fn coarser(&self, ratio: f64) -> Self {
        // At a mass errors are as the edge squared.
        let at_mass = ratio.powf(0.5 * PACE);
        let lighter = |mass: &AtMass| AtMass { edge: mass.edge * at_mass, ..*mass };
        let wider = |disc: &AtDisc| AtDisc { edge: disc.edge * ratio, ..*disc };
        Self {
            size: self.size * ratio,
            masses: self.masses.iter().map(lighter).collect(),
            discs: self.discs.iter().map(wider).collect(),
            accuracy: self.accuracy * ratio.powf(PACE),
            growth: self.growth * ratio,
            finer: self.finer / ratio,
            ..self.clone()
        }
    }

    /// The numbers by which plans for one surface and frequency differ.
    pub(super) fn numbers(&self) -> Vec<f64> {
        let whole = [self.size, self.accuracy, self.growth, self.finer, self.layer];
        let masses = self.masses.iter().map(|mass| mass.edge);
        whole.into_iter().chain(masses).chain(self.discs.iter().map(|disc| disc.edge)).collect()
    }

    /// The plan for the same surface and frequency with these numbers; `None` if they are not as many.
    pub(super) fn with_numbers(mut self, numbers: &[f64]) -> Option<Self> {
        let ([size, accuracy, growth, finer, layer], edges) = numbers.split_first_chunk()?;
        (self.size, self.accuracy, self.growth) = (*size, *accuracy, *growth);
        (self.finer, self.layer) = (*finer, *layer);
        let (masses, discs) = edges.split_at_checked(self.masses.len())?;
        self.masses.iter_mut().zip(masses).for_each(|(mass, edge)| mass.edge = *edge);
        self.discs.iter_mut().zip(discs).for_each(|(disc, edge)| disc.edge = *edge);
        (discs.len() == self.discs.len()).then_some(self)
    }

    /// The relative error of frequencies due to effects that a comparison with a coarser mesh does not
    /// show.
    pub(super) fn unresolved(&self) -> f64 {
        unresolved(&self.corners, self.size, self.bends, self.accuracy, self.sizing().growth)
    }

    /// A plan that is likely to have the relative error `wanted`, given that this plan had `error`; edges
    /// are shortened by at most a factor of 1.6.
    pub(super) fn refined(&self, error: f64, wanted: f64) -> Self {
        // Somewhat finer than the error requires; at least 1.25, so that the next difference is above rounding,
        // at most 1.6, which is two and a half times the triangles and hides little of what falls slowly.
        let ratio = (1.3 * error / wanted).powf(1.0 / (ORDER - 1.0)).clamp(1.25, 1.6);
        self.coarser(1.0 / ratio)
    }

    /// This plan for a top wavenumber that is lower by the factor `share`.
    pub(super) fn lower(&self, share: f64) -> Self {
        let share = share.max(1e-6);
        let masses = self.masses.iter().map(|mass| AtMass { edge: mass.edge / share, ..*mass }).collect();
        Self { size: self.size / share, wavenumber: self.wavenumber * share, masses, ..self.clone() }
    }

    /// Approximate number of unknowns that this plan gives on an outline.
    pub(super) fn unknowns(&self, outline: &Outline) -> Result<usize, PhysicsError> {
        Ok((UNKNOWNS * Mesh::estimate(outline, &self.sizing())? as f64) as usize)
    }

    /// Approximate number of modes (Weyl 1911, without the perimeter term).
    pub(super) fn modes(&self) -> usize {
        (self.area * self.wavenumber.powi(2) / (4.0 * PI)) as usize + 10
    }
}

/// Point masses with the edge length at each, for edges of `size` (m) elsewhere and a given accuracy.
fn masses(surface: &Surface, size: f64, accuracy: f64) -> Vec<AtMass> {
    let share = (accuracy / 1e-3).min(1.0);
    // Together with `size`, as the root of the accuracy.
    let edge = 0.25 * size * share.powf(0.5 - 1.0 / ORDER);
    let masses = surface.sheet.uneven.scatterers.iter().filter(|s| matches!(s.kind, ScattererKind::Mass(_)));
    masses.map(|mass| AtMass { at: mass.at, edge }).collect()
}

/// Discs with the edge length at each: at most `in_layer` (m), the length in boundary layers, since there
/// is a boundary layer around a stiff disc; `finer` is the factor on edge lengths for the accuracy.
fn discs(surface: &Surface, in_layer: f64, finer: f64) -> Vec<AtDisc> {
    let disc = |scatterer: &Scatterer| match scatterer.kind {
        ScattererKind::Mass(_) => None,
        ScattererKind::Disc { radius, .. } => {
            Some(AtDisc { at: scatterer.at, radius, edge: (IN_DISC * finer * radius).min(in_layer) })
        }
    };
    surface.sheet.uneven.scatterers.iter().filter_map(disc).collect()
}

/// The properties of the sheet at a grid of points over an outline; a single element for a uniform sheet.
fn looks(outline: &Outline, fabric: &Fabric) -> Vec<Local> {
    let (width, height) = outline.extent();
    let at = |i: usize, side: f64| side * i as f64 / (LOOKS - 1) as f64;
    let places = (0..LOOKS * LOOKS).map(|i| Point::new(at(i % LOOKS, width), at(i / LOOKS, height)));
    match fabric.uniform() {
        Some(local) => vec![local],
        None => places.map(|p| fabric.bare(p)).collect(),
    }
}

/// An isotropic sheet on which waves are as short as the shortest waves on a sheet with the given local
/// properties.
fn medium(local: &Local) -> Medium {
    let softest = local.bending[0].min(local.bending[3]);
    Medium { areal_density: local.mass, tension: local.tension, bending_stiffness: softest, air_sides: 0.0 }
}

/// Width √(D/T) of the boundary layer at a clamped rim, in metres; infinite if there is no tension or no bending stiffness.
fn layer(local: &Local) -> f64 {
    let stiffest = local.bending[0].max(local.bending[3]);
    if stiffest > 0.0 && local.tension > 0.0 { (stiffest / local.tension).sqrt() } else { f64::INFINITY }
}
