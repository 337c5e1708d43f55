//! The picture of a modal state: one matrix product.

use unripple::core::{Outline, Point};
use unripple::physics::stepper::Plant;

/// Points whose modes are read at once, which bounds memory while a picture is laid out.
const BATCH: usize = 1024;

/// Sums that run side by side in a product, so that the processor adds several at once.
const LANES: usize = 16;

/// Square cells over a surface's bounding box, row by row from the bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cells {
    /// Number of cells along x.
    pub columns: usize,
    /// Number of cells along y.
    pub rows: usize,
    /// Distance from each cell to the next along x and y, in m.
    pub pitch: [f64; 2],
}

impl Cells {
    /// Cells of a picture with `longest` of them along the longer side.
    pub fn of(outline: &Outline, longest: usize) -> Self {
        let (width, height) = outline.extent();
        let cell = width.max(height) / longest as f64;
        let count = |side: f64| ((side / cell).round() as usize).clamp(2, longest);
        let (columns, rows) = (count(width), count(height));
        Self { columns, rows, pitch: [width / columns as f64, height / rows as f64] }
    }

    /// Centres of all cells, in m, row by row from the bottom.
    pub fn centres(&self) -> impl Iterator<Item = Point> {
        let Self { columns, rows, pitch: [dx, dy] } = *self;
        (0..columns * rows).map(move |cell| {
            let (column, row) = (cell % columns, cell / columns);
            Point::new((column as f64 + 0.5) * dx, (row as f64 + 0.5) * dy)
        })
    }
}

/// The map from a surface's modes to cells over it: the field as a picture.
#[derive(Clone, Debug)]
pub struct Lens {
    /// The cells of the picture.
    pub cells: Cells,
    /// Whether the centre of each lies on the surface.
    inside: Vec<bool>,
    modes: usize,
    /// Readout weights of the modes at each cell inside, cell after cell.
    weights: Vec<f32>,
}

impl Lens {
    /// The map from modes to a picture of a sheet within an outline, with `longest` cells along the longer
    /// side.
    pub fn new(plant: &Plant, outline: &Outline, longest: usize) -> Self {
        let cells = Cells::of(outline, longest);
        let inside: Vec<bool> = cells.centres().map(|at| outline.contains(at)).collect();
        let held: Vec<Point> = cells.centres().filter(|at| outline.contains(*at)).collect();
        Self { cells, inside, modes: plant.modes(), weights: weights(plant, &held) }
    }

    /// The field of a modal state (one value per mode) at every cell, row by row, in m or m/s; 0 outside the surface.
    pub fn look(&self, state: &[f32]) -> Vec<f32> {
        let mut readings = self.weights.chunks_exact(self.modes.max(1)).map(|row| product(row, state));
        let cell = |inside: &bool| if *inside { readings.next().unwrap_or(0.0) } else { 0.0 };
        self.inside.iter().map(cell).collect()
    }
}

/// Readout weights of all modes at some places (m), places x modes.
pub fn weights(plant: &Plant, places: &[Point]) -> Vec<f32> {
    let mut weights = Vec::with_capacity(places.len() * plant.modes());
    for batch in places.chunks(BATCH) {
        let read = plant.readout(batch);
        for row in 0..read.nrows() {
            weights.extend((0..read.ncols()).map(|mode| read[(row, mode)] as f32));
        }
    }
    weights
}

/// Scalar product of two vectors of equal length.
pub fn product(one: &[f32], other: &[f32]) -> f32 {
    let (ones, others) = (one.chunks_exact(LANES), other.chunks_exact(LANES));
    let rest: f32 = ones.remainder().iter().zip(others.remainder()).map(|(a, b)| a * b).sum();
    let mut sums = [0.0; LANES];
    for (one, other) in ones.zip(others) {
        for lane in 0..LANES {
            sums[lane] += one[lane] * other[lane];
        }
    }
    rest + sums.iter().sum::<f32>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use unripple::physics::Modes;
    use unripple::physics::design::papers_surface;

    #[test]
    fn the_picture_is_the_field_that_the_modes_have_there() {
        let mut film = papers_surface();
        film.emission.band[1] = 700.0;
        let modes = Arc::new(Modes::solve(&film, 700.0, 1e-3).unwrap());
        let plant = Plant::of(&film, modes).unwrap();
        let lens = Lens::new(&plant, &film.outline, 16);
        assert_eq!(
            (lens.cells.columns, lens.cells.rows, lens.inside.iter().all(|inside| *inside)),
            (16, 16, true)
        );
        let state: Vec<f32> = (0..plant.modes()).map(|m| ((m * m) as f32).sin()).collect();
        let picture = lens.look(&state);
        let place = Point::new(5.5 * 0.15 / 16.0, 9.5 * 0.15 / 16.0);
        let row = plant.readout(&[place]);
        let expected: f64 = state.iter().enumerate().map(|(m, x)| row[(0, m)] * f64::from(*x)).sum();
        let largest = picture.iter().fold(0.0, |m: f32, x| m.max(x.abs()));
        assert!((f64::from(picture[9 * 16 + 5]) - expected).abs() < 1e-5 * f64::from(largest));
    }
}
