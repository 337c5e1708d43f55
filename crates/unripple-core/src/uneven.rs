//! Deviations of a sheet from a uniform, isotropic one: orthotropy, profiles of its properties, attached
//! masses and resonators.

use crate::{Lattice, Point, Resonator};

/// Deviations of a sheet from a uniform, isotropic one, and resonators on it. The default is neither.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Uneven {
    /// Orthotropy: a different stiffness along and across the grain of the material.
    pub grain: Option<Grain>,
    /// Thickness over the surface, as a factor on the thickness of the sheet.
    pub thickness: Option<Profile>,
    /// Tension over the surface, as a factor on the tension of the sheet.
    pub tension: Option<Profile>,
    /// Distributed mass on the sheet that does not stiffen it, in kg/m².
    pub added_mass: Option<Profile>,
    /// Point masses and discs fixed to the sheet.
    pub scatterers: Vec<Scatterer>,
    /// Resonators that stand on the sheet one by one; they are loads on it and leave the sheet itself as it is.
    pub resonators: Vec<Resonator>,
    /// Lattices of resonators.
    pub lattices: Vec<Lattice>,
}

impl Uneven {
    /// Whether the sheet is uniform and isotropic: none of the deviations is present. Resonators are no deviation, but loads on the sheet.
    pub fn is_uniform(&self) -> bool {
        let Self { grain, thickness, tension, added_mass, scatterers, .. } = self;
        let even = thickness.is_none() && tension.is_none() && added_mass.is_none();
        grain.is_none() && even && scatterers.is_empty()
    }

    /// Whether any resonator stands on the sheet.
    pub fn resonates(&self) -> bool {
        !(self.resonators.is_empty() && self.lattices.is_empty())
    }
}

/// The elastic constants that an orthotropic sheet has in addition to those in [`Sheet`](crate::Sheet).
/// There, Young's modulus is the one along the grain, and Poisson's ratio the one for stress along the
/// grain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Direction of the grain in radians from the x axis; for a film, the machine direction.
    pub direction: f64,
    /// Young's modulus across the grain, in Pa.
    pub young_across: f64,
    /// Shear modulus G, in Pa.
    pub shear: f64,
}

/// A quantity that varies over the surface: values at the nodes of a regular grid that spans the outline's bounding box,
/// borders included, with Catmull-Rom interpolation between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    columns: usize,
    values: Vec<f64>,
}

impl Profile {
    /// A profile from rows of values (dimensionless factors, or kg/m² for added mass), the lowest row first, each from left
    /// to right.
    ///
    /// Returns `None` if there are no values, if rows differ in length, or if a value is not finite.
    pub fn new(rows: &[Vec<f64>]) -> Option<Self> {
        let columns = rows.first()?.len();
        let values = rows.concat();
        let whole = columns > 0 && rows.iter().all(|row| row.len() == columns);
        (whole && values.iter().all(|v| v.is_finite())).then_some(Self { columns, values })
    }

    /// The rows of values, the lowest first, each from left to right.
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks(self.columns)
    }

    /// Least and greatest value at the nodes, in the unit of the profile.
    pub fn range(&self) -> (f64, f64) {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        self.values.iter().fold(ends, |(low, high), v| (low.min(*v), high.max(*v)))
    }

    /// The interpolated value at a point (m), in the profile's unit; `extent` is the width and height of the outline's bounding
    /// box, in metres. Points outside the box take the value at its nearest border. The result is limited to the range of the
    /// nodes' values.
    pub fn at(&self, point: Point, extent: (f64, f64)) -> f64 {
        let rows = self.values.len() / self.columns;
        let (columns, wx) = weights(point.x / extent.0, self.columns);
        let (lines, wy) = weights(point.y / extent.1, rows);
        let row = |line: usize| {
            columns.iter().zip(wx).map(|(c, w)| w * self.values[line * self.columns + c]).sum::<f64>()
        };
        let value = lines.iter().zip(wy).map(|(line, w)| w * row(*line)).sum::<f64>();
        let (low, high) = self.range();
        value.clamp(low, high)
    }
}

/// The four nodes around a position from 0 to 1 along one axis, and their Catmull-Rom weights. Nodes beyond the ends are
/// extrapolated linearly.
fn weights(place: f64, nodes: usize) -> ([usize; 4], [f64; 4]) {
    if nodes == 1 {
        return ([0; 4], [1.0, 0.0, 0.0, 0.0]);
    }
    let x = place.clamp(0.0, 1.0) * (nodes - 1) as f64;
    let cell = (x.floor() as usize).min(nodes - 2);
    let t = x - cell as f64;
    let mut w = [
        -0.5 * t * (1.0 - t) * (1.0 - t),
        1.0 + t * t * (1.5 * t - 2.5),
        t * (0.5 + t * (2.0 - 1.5 * t)),
        -0.5 * t * t * (1.0 - t),
    ];
    let mut at = [cell, cell, cell + 1, cell + 1];
    if cell > 0 {
        at[0] = cell - 1;
    } else {
        (w[1], w[2], w[0]) = (w[1] + 2.0 * w[0], w[2] - w[0], 0.0);
    }
    if cell + 2 < nodes {
        at[3] = cell + 2;
    } else {
        (w[2], w[1], w[3]) = (w[2] + 2.0 * w[3], w[1] - w[3], 0.0);
    }
    (at, w)
}

/// A mass or disc fixed to the sheet, which scatters waves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatterer {
    /// Position of the centre, in metres.
    pub at: Point,
    /// Point mass or disc, with its constants.
    pub kind: ScattererKind,
}

/// The kinds of scatterers: a point mass or a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScattererKind {
    /// A mass at a point, in kg.
    Mass(f64),
    /// A disc glued to the sheet: it adds mass, and stiffness as a laminate with the sheet.
    Disc {
        /// Radius of the disc, in metres.
        radius: f64,
        /// Thickness of the disc, in metres.
        thickness: f64,
        /// Young's modulus of the disc, in Pa.
        young: f64,
        /// Density of the disc, in kg/m³.
        density: f64,
        /// Poisson's ratio of the disc.
        poisson: f64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_is_interpolated_exactly() {
        let rows: Vec<Vec<f64>> =
            (0..4).map(|y| (0..5).map(|x| 1.0 + f64::from(x) + 10.0 * f64::from(y)).collect()).collect();
        let profile = Profile::new(&rows).unwrap();
        for (x, y) in [(0.0, 0.0), (0.13, 0.7), (0.5, 0.5), (0.99, 0.01), (1.0, 1.0)] {
            let value = profile.at(Point::new(2.0 * x, 3.0 * y), (2.0, 3.0));
            assert!((value - (1.0 + 4.0 * x + 30.0 * y)).abs() < 1e-12);
        }
        assert_eq!(profile.at(Point::new(-1.0, 9.0), (2.0, 3.0)), 31.0);
    }

    #[test]
    fn ragged_rows_make_no_profile() {
        assert!(Profile::new(&[]).is_none());
        assert!(Profile::new(&[vec![1.0, 2.0], vec![1.0]]).is_none());
        assert!(Profile::new(&[vec![f64::NAN]]).is_none());
        assert_eq!(Profile::new(&[vec![3.0]]).unwrap().at(Point::new(0.2, 0.1), (1.0, 1.0)), 3.0);
    }
}
