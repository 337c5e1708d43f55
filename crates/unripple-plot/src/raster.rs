//! A grid's values interpolated to pixels.

use crate::grid::{Grid, Ring, inside};

/// How the pixels of a picture follow from the cells of a grid: bicubic in both directions, planned once for many frames.
#[derive(Clone, Debug)]
pub(crate) struct Raster {
    columns: usize,
    across: Vec<Taps>,
    down: Vec<Taps>,
    /// Cells without a value, each with the neighbours whose mean stands in for it, in the order to be filled.
    fills: Vec<(usize, Vec<usize>)>,
    /// Whether a cell shows.
    shown: Vec<bool>,
}

/// Four cells along one direction and their weights, and the nearest cell.
#[derive(Clone, Copy, Debug)]
struct Taps {
    cells: [usize; 4],
    weights: [f32; 4],
    nearest: usize,
}

impl Raster {
    /// Plans a picture of the whole grid, `width` by `height` pixels, row 0 of the grid at its foot.
    ///
    /// Cells without a value (by the grid's own values) outside the rings take their neighbours' so that a clipped
    /// picture reaches the rim; those inside stay clear.
    pub fn new(grid: &Grid, rings: &[Ring], width: usize, height: usize) -> Self {
        let across = (0..width).map(|i| taps(i, width, grid.columns)).collect();
        let down = (0..height).rev().map(|i| taps(i, height, grid.rows)).collect();
        let finite: Vec<bool> = grid.values.iter().map(|value| value.is_finite()).collect();
        let fills = fills(&finite, grid.columns);
        let mut shown = finite;
        for (cell, _) in &fills {
            let centre = grid.centre(cell % grid.columns, cell / grid.columns);
            shown[*cell] = !rings.is_empty() && !inside(rings, centre);
        }
        Self { columns: grid.columns, across, down, fills, shown }
    }

    /// Values of the pixels, row by row from the top; not-a-number where no value is shown.
    pub fn pixels(&self, values: &[f64]) -> Vec<f32> {
        let mut cells: Vec<f32> = values.iter().map(|value| *value as f32).collect();
        for (cell, neighbours) in &self.fills {
            let sum: f32 = neighbours.iter().map(|n| cells[*n]).sum();
            cells[*cell] = sum / neighbours.len() as f32;
        }
        cells
            .iter_mut()
            .zip(&self.shown)
            .filter(|(v, shown)| !v.is_finite() && !**shown)
            .for_each(|(v, _)| *v = 0.0);
        let wide = self.widened(&cells);
        let width = self.across.len();
        let mut pixels = Vec::with_capacity(width * self.down.len());
        for taps in &self.down {
            let rows = taps.cells.map(|row| &wide[row * width..][..width]);
            let [a, b, c, d] = taps.weights;
            let shown = &self.shown[taps.nearest * self.columns..][..self.columns];
            pixels.extend(self.across.iter().enumerate().map(|(x, column)| {
                let value = a * rows[0][x] + b * rows[1][x] + c * rows[2][x] + d * rows[3][x];
                if shown[column.nearest] { value } else { f32::NAN }
            }));
        }
        pixels
    }

    /// Every row of cells interpolated across.
    fn widened(&self, cells: &[f32]) -> Vec<f32> {
        let row_of = |row: &[f32]| -> Vec<f32> {
            let tap = |taps: &Taps| (0..4).map(|i| taps.weights[i] * row[taps.cells[i]]).sum();
            self.across.iter().map(tap).collect()
        };
        cells.chunks_exact(self.columns.max(1)).flat_map(row_of).collect()
    }
}

/// Catmull and Rom's cubic through four cells for pixel `i` of `pixels` over `cells` cells, held at the ends.
fn taps(i: usize, pixels: usize, cells: usize) -> Taps {
    let place = (i as f64 + 0.5) / pixels as f64 * cells as f64 - 0.5;
    let base = place.floor();
    let t = (place - base) as f32;
    let last = cells.saturating_sub(1);
    let cell = |offset: f64| (base + offset).clamp(0.0, last as f64) as usize;
    let weights = [
        ((2.0 - t) * t - 1.0) * t / 2.0,
        ((3.0 * t - 5.0) * t * t + 2.0) / 2.0,
        ((4.0 - 3.0 * t) * t + 1.0) * t / 2.0,
        (t - 1.0) * t * t / 2.0,
    ];
    let nearest = place.round().clamp(0.0, last as f64) as usize;
    Taps { cells: [cell(-1.0), cell(0.0), cell(1.0), cell(2.0)], weights, nearest }
}

/// Cells within two of one that has a value, each with the neighbours that have one by then.
fn fills(finite: &[bool], columns: usize) -> Vec<(usize, Vec<usize>)> {
    let rows = finite.len() / columns.max(1);
    let mut known = finite.to_vec();
    let mut fills = Vec::new();
    for _ in 0..3 {
        let ring: Vec<(usize, Vec<usize>)> = (0..known.len())
            .filter(|cell| !known[*cell])
            .map(|cell| (cell, neighbours(cell, columns, rows).filter(|n| known[*n]).collect::<Vec<_>>()))
            .filter(|(_, neighbours)| !neighbours.is_empty())
            .collect();
        ring.iter().for_each(|(cell, _)| known[*cell] = true);
        fills.extend(ring);
    }
    fills
}

fn neighbours(cell: usize, columns: usize, rows: usize) -> impl Iterator<Item = usize> {
    let (column, row) = (cell % columns, cell / columns);
    (row.saturating_sub(1)..(row + 2).min(rows)).flat_map(move |r| {
        (column.saturating_sub(1)..(column + 2).min(columns)).map(move |c| r * columns + c)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(columns: usize, rows: usize, value: impl Fn(f64, f64) -> f64) -> Grid {
        let mut grid = Grid { columns, rows, first: [0.5, 0.5], pitch: [1.0, 1.0], ..Grid::default() };
        grid.values = (0..columns * rows)
            .map(|i| {
                let [x, y] = grid.centre(i % columns, i / columns);
                value(x, y)
            })
            .collect();
        grid
    }

    #[test]
    fn a_plane_is_reproduced_and_stands_the_right_way_up() {
        let grid = grid(9, 7, |x, y| 2.0 * x - 3.0 * y);
        let (width, height) = (54, 42);
        let pixels = Raster::new(&grid, &[], width, height).pixels(&grid.values);
        for py in 12..30 {
            for px in 12..42 {
                let (x, y) = ((px as f64 + 0.5) / 6.0, 7.0 - (py as f64 + 0.5) / 6.0);
                let found = f64::from(pixels[py * width + px]);
                assert!((found - (2.0 * x - 3.0 * y)).abs() < 1e-4, "{px} {py}");
            }
        }
    }

    #[test]
    fn a_wave_of_eight_cells_is_interpolated_well() {
        let wave = |x: f64, y: f64| (x * 0.785).sin() * (y * 0.785).cos();
        let grid = grid(24, 24, wave);
        let pixels = Raster::new(&grid, &[], 240, 240).pixels(&grid.values);
        for (i, found) in pixels.iter().enumerate() {
            let (x, y) = ((i % 240) as f64 / 10.0 + 0.05, 24.0 - (i / 240) as f64 / 10.0 - 0.05);
            if (2.0..22.0).contains(&x) && (2.0..22.0).contains(&y) {
                assert!((f64::from(*found) - wave(x, y)).abs() < 0.03);
            }
        }
    }

    #[test]
    fn holes_stay_clear_and_cells_beyond_the_rim_are_filled() {
        let ring = vec![[1.0, 1.0], [7.0, 1.0], [7.0, 7.0], [1.0, 7.0]];
        let mut grid =
            grid(
                8,
                8,
                |x, y| if (1.0..7.0).contains(&x) && (1.0..7.0).contains(&y) { 5.0 } else { f64::NAN },
            );
        grid.values[3 * 8 + 3] = f64::NAN;
        let open = Raster::new(&grid, &[], 8, 8).pixels(&grid.values);
        let clipped = Raster::new(&grid, &[ring], 8, 8).pixels(&grid.values);
        assert!(open[0].is_nan() && (clipped[0] - 5.0).abs() < 1e-5);
        for pixels in [&open, &clipped] {
            assert!(pixels[4 * 8 + 3].is_nan());
            assert!((pixels[4 * 8 + 4] - 5.0).abs() < 1e-5);
        }
    }
}
