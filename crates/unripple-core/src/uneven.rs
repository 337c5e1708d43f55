//! What makes a sheet non-uniform or orthotropic.

use crate::Point;

/// What makes a sheet other than uniform and isotropic. The default is nothing: a uniform, isotropic sheet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Uneven {
    /// Orthotropy: another stiffness across the grain than along it.
    pub grain: Option<Grain>,
    /// Thickness over the surface, as a factor of the sheet's.
    pub thickness: Option<Profile>,
    /// Tension over the surface, as a factor of the sheet's.
    pub tension: Option<Profile>,
    /// Mass that lies on the sheet without stiffening it, in kg/m².
    pub added_mass: Option<Profile>,
    /// What is fixed to the sheet.
    pub scatterers: Vec<Scatterer>,
}

impl Uneven {
    /// Whether the sheet is uniform and isotropic after all.
    pub fn is_nothing(&self) -> bool {
        *self == Self::default()
    }
}

/// An orthotropic sheet: the sheet's Young's modulus holds along the grain, its Poisson's ratio for stress along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Direction of the grain (of a film, the machine direction), in radians from x.
    pub direction: f64,
    /// Young's modulus across the grain, in Pa.
    pub young_across: f64,
    /// Shear modulus G, in Pa.
    pub shear: f64,
}

/// A quantity over the surface: values at the nodes of a regular grid over the outline's bounding box, its borders
/// included, with smooth (Catmull-Rom) interpolation between.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    columns: usize,
    values: Vec<f64>,
}

impl Profile {
    /// A profile from rows of values (factors, or kg/m² of added mass), the lowest row first, each from left
    /// to right.
    ///
    /// Returns `None` without values, or if rows differ in length, or a value is not finite.
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

    /// Least and greatest of the nodes' values, in the unit of the profile.
    pub fn range(&self) -> (f64, f64) {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        self.values.iter().fold(ends, |(low, high), v| (low.min(*v), high.max(*v)))
    }

    /// The value, in the profile's unit, at a point (m) of an outline of that extent (width and height, m);
    /// places outside take the nearest border's. Held within the range of the nodes.
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

/// The four nodes around a place between 0 and 1, and their Catmull-Rom weights. Beyond both ends the line goes on
/// straight.
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

/// Something fixed to the sheet that scatters waves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatterer {
    /// Where its centre is, in metres.
    pub at: Point,
    /// What kind of thing it is, with its mass and stiffness.
    pub kind: ScattererKind,
}

/// What is fixed to a sheet: a mass at a point or a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScattererKind {
    /// A mass at a point, in kg.
    Mass(f64),
    /// A disc glued on: mass, and stiffness as a laminate with the sheet.
    Disc {
        /// Its radius, in metres.
        radius: f64,
        /// Its thickness, in metres.
        thickness: f64,
        /// Its Young's modulus, in Pa.
        young: f64,
        /// Its density, in kg/m³.
        density: f64,
        /// Its Poisson's ratio.
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
