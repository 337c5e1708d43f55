//! Resonators on the sheet: masses on springs, one by one and in lattices.

use crate::{Outline, Point, Random};

/// Largest deviation of a resonator's frequency in a lattice, in standard deviations: what is made is measured, and what is farther off is
/// thrown away. Larger, a few of many resonators would be far from the others.
const SORTED: f64 = 3.0;

/// A mass on a spring and a damper that stand on the sheet at a point, and that is otherwise free to move across the sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resonator {
    /// Place on the sheet, in metres.
    pub at: Point,
    /// Mass that moves on the spring, in kg.
    pub mass: f64,
    /// Natural frequency of the mass on its spring where the sheet is held still, in Hz.
    pub frequency: f64,
    /// Quality factor Q of that resonance, dimensionless.
    pub quality_factor: f64,
}

/// Equal cells in rows and columns that fill a rectangle, with a resonator at the centre of each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Lower left and upper right corner of the rectangle, in metres.
    pub corners: [Point; 2],
    /// Number of cells along x and along y.
    pub cells: [usize; 2],
    /// Mass of each resonator, in kg.
    pub mass: f64,
    /// Natural frequency of the resonators on a sheet that is held still, in Hz.
    pub frequency: f64,
    /// Quality factor of the resonators, dimensionless.
    pub quality_factor: f64,
    /// Standard deviation of the resonators' frequencies relative to their mean, a ratio; normally distributed, cut off at three standard
    /// deviations. Masses are equal, so that springs vary.
    pub scatter: f64,
    /// Seed from which the frequencies are drawn.
    pub seed: u64,
}

impl Lattice {
    /// Distance of neighbours along x and along y, in metres.
    pub fn pitch(&self) -> [f64; 2] {
        let [from, to] = self.corners;
        [(to.x - from.x) / self.cells[0] as f64, (to.y - from.y) / self.cells[1] as f64]
    }

    /// Mass of the resonators per area of the lattice, in kg/m².
    pub fn areal_density(&self) -> f64 {
        let [x, y] = self.pitch();
        self.mass / (x * y)
    }

    /// The resonators that stand on a sheet with this outline, row by row from the lowest. Cells whose centres are not on the sheet have
    /// none; the frequencies of the others do not depend on that.
    pub fn resonators(&self, outline: &Outline) -> Vec<Resonator> {
        let ([x, y], [from, _]) = (self.pitch(), self.corners);
        let mut random = Random::seeded(self.seed);
        let cells = (0..self.cells[1]).flat_map(|row| (0..self.cells[0]).map(move |column| (column, row)));
        let one = |(column, row): (usize, usize)| {
            let deviation = random.normal().clamp(-SORTED, SORTED);
            let at = Point::new(from.x + (column as f64 + 0.5) * x, from.y + (row as f64 + 0.5) * y);
            outline.contains(at).then_some(Resonator {
                at,
                mass: self.mass,
                frequency: self.frequency * (1.0 + self.scatter * deviation),
                quality_factor: self.quality_factor,
            })
        };
        cells.filter_map(one).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Shape;

    fn lattice(scatter: f64) -> Lattice {
        Lattice {
            corners: [Point::new(0.0, 0.0), Point::new(0.3, 0.2)],
            cells: [30, 20],
            mass: 1e-4,
            frequency: 250.0,
            quality_factor: 50.0,
            scatter,
            seed: 7,
        }
    }

    #[test]
    fn resonators_stand_at_the_centres_of_cells() {
        let outline = Outline::new(Shape::Rectangle { width: 0.3, height: 0.2 });
        let all = lattice(0.0).resonators(&outline);
        assert_eq!(all.len(), 600);
        assert!(all[31].at.distance(Point::new(0.015, 0.015)) < 1e-15);
        assert!(all.iter().all(|r| r.frequency == 250.0 && r.mass == 1e-4 && r.quality_factor == 50.0));
        assert!((lattice(0.0).areal_density() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn frequencies_scatter_as_stated_and_do_not_depend_on_the_outline() {
        let whole = Outline::new(Shape::Rectangle { width: 0.3, height: 0.2 });
        let all = lattice(0.01).resonators(&whole);
        let deviations: Vec<f64> = all.iter().map(|r| r.frequency / 250.0 - 1.0).collect();
        let mean = deviations.iter().sum::<f64>() / 600.0;
        let spread = (deviations.iter().map(|d| d * d).sum::<f64>() / 600.0).sqrt();
        assert!(mean.abs() < 2e-3 && (spread - 0.01).abs() < 1.5e-3, "{mean} {spread}");
        assert!(deviations.iter().all(|d| d.abs() <= 0.03 + 1e-12));
        // Of a round sheet the cells outside are empty, and the others the same.
        let round = lattice(0.01).resonators(&Outline::new(Shape::Circle { radius: 0.1 }));
        assert!(round.len() < 400 && round.iter().all(|r| all.contains(r)));
    }
}
