//! The contrast of time reversal at every point of a surface, computed for all at once.

mod reversal;

use crate::act::ActError;
use crate::core::{Conditions, ModalResponses, Point, Responses, window_samples};
use crate::field::Grid;
use rayon::prelude::*;
use unripple_core::OutOfRange;
use unripple_linalg::{Accum, Mat, MatRef, Par, multiply, product};

/// Number of points of the field that are evaluated at once: their values fit a cache.
const POINTS: usize = 128;

/// Readout weight, relative to the largest anywhere, below which it counts as rounding error rather than
/// motion.
const REST: f64 = 1e-9;

/// Largest number of cells of a map along its longer side. A million cells bound memory, and no screen shows more.
const MOST_ACROSS: usize = 1024;

/// Largest number of samples of a window: past it a window is taken for a mistake of unit, being minutes long at any usual rate.
const MOST_SAMPLES: usize = 20_000_000;

/// Options of a map of contrast: window, cells, grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapOptions {
    /// Window T, in seconds.
    pub window: f64,
    /// Number of cells along the longer side of the surface, each with a target at its centre.
    pub across: usize,
    /// Number of cells per shortest wavelength of the grid on which the field outside the focal discs is
    /// evaluated; [`act`](crate::act) uses 8.
    pub cells: f64,
}

impl Default for MapOptions {
    /// 24 cells across, a window of 30 ms, and a field on 4 cells per wavelength: contrasts within 2 % rms of those on
    /// 8.
    fn default() -> Self {
        Self { window: 30e-3, across: 24, cells: 4.0 }
    }
}

/// Contrast of time reversal at the cells of a grid over a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct ContrastMap {
    /// The cells, row by row from the bottom; targets are their centres.
    pub grid: Grid,
    /// Peak velocity over the rms outside the focal disc at the focal instant, per cell: `None` outside the outline, where no
    /// actuator moves the surface, and where nothing is outside the disc.
    pub contrast: Vec<Option<f64>>,
}

/// Computes the contrast of time reversal from all actuators at every cell of a surface: the `contrast` of a focus at
/// its centre, without computing a drive.
///
/// Time reversal to a target x leaves the modes at the focal instant with the velocities `G φ(x)`, φ(x) the shape
/// weights at x, `G = (BᵀB) ∘ Σ_i p(i) p(i)ᵀ`, B the input weights and p the impulse response of every mode, summed
/// over the samples of the window. The field at the focal instant is `Φ G φ(x)`, Φ the shape weights at its points, for
/// all targets in two matrix products. The level of the drive and its rounding to single precision do not change a
/// ratio.
///
/// # Errors
/// [`ActError::NeedsModes`] for sampled responses; [`ActError::Range`] for a window of no sample or of too many, and
/// for a number of cells that is not 1 to 1024; [`ActError::Field`] for a grid that [`Grid::new`] refuses.
///
/// ```
/// use unripple::act::model;
/// use unripple::contrast_map::{MapOptions, contrast_map};
///
/// let responses = model(&unripple::physics::design::papers_surface(), None, &[])?;
/// let map = contrast_map(&responses, &MapOptions { across: 9, ..MapOptions::default() })?;
/// let inner = map.contrast[4 * 9 + 4].unwrap_or(0.0);
/// assert!(inner > 15.0 && inner < 40.0, "{inner}");
/// # Ok::<(), unripple::act::ActError>(())
/// ```
pub fn contrast_map(responses: &Responses, options: &MapOptions) -> Result<ContrastMap, ActError> {
    let Responses::Modal(modal) = responses else {
        return Err(ActError::NeedsModes { what: "a map of contrast" });
    };
    let most = MOST_SAMPLES as f64 / modal.conditions.rate;
    let window = options.window;
    check("window (s)", window > 0.0 && window <= most, "a positive number, of a moderate size", window)?;
    let samples = window_samples(window, modal.conditions.rate);
    check("samples of the window after the first", samples > 0, "at least 1", samples as f64)?;
    let across = options.across;
    check("cells across", (1..=MOST_ACROSS).contains(&across), "1 to 1024", across as f64)?;
    let around = Grid::new(&modal.conditions, options.cells)?.points();
    let grid = cells(&modal.conditions, across);
    let found = contrasts(modal, &grid.points(), &around, samples + 1);
    let mut contrast = vec![None; grid.columns * grid.rows];
    grid.inside.iter().zip(found).for_each(|(cell, found)| contrast[*cell] = found);
    Ok(ContrastMap { grid, contrast })
}

fn check(what: &'static str, legal: bool, expected: &'static str, found: f64) -> Result<(), ActError> {
    if legal { Ok(()) } else { Err(ActError::Range(OutOfRange::new(what, expected, found))) }
}

/// A grid of nearly square cells, `across` of them along the longer side.
fn cells(conditions: &Conditions, across: usize) -> Grid {
    let (width, height) = conditions.outline.extent();
    let pitch = width.max(height) / across as f64;
    let count = |side: f64| ((side / pitch).round() as usize).clamp(1, across);
    let (columns, rows) = (count(width), count(height));
    let (width, height) = (width / columns as f64, height / rows as f64);
    let mut grid = Grid { columns, rows, width, height, inside: Vec::new() };
    grid.inside = (0..columns * rows).filter(|c| conditions.outline.contains(grid.centre(*c))).collect();
    grid
}

/// The contrast of each target, the field taken at the points `around`.
fn contrasts(
    modal: &ModalResponses,
    targets: &[Point],
    around: &[Point],
    samples: usize,
) -> Vec<Option<f64>> {
    let readout = modal.shapes.at_all(targets);
    let state = product(reversal::map(modal, samples).as_ref(), readout.transpose());
    let largest = readout.col_iter().flat_map(|c| c.iter()).fold(0.0, |m: f64, w| m.max(w.abs()));
    let radius = modal.conditions.focal_radius();
    let single = Mat::from_fn(state.nrows(), state.ncols(), |m, t| state[(m, t)] as f32);
    let sums =
        around.par_chunks(POINTS).map(|points| outside(modal, points, targets, single.as_ref(), radius));
    let none = || vec![(0usize, 0.0f64); targets.len()];
    let sums = sums.reduce(none, |mut all, part| {
        all.iter_mut().zip(part).for_each(|(all, part)| *all = (all.0 + part.0, all.1 + part.1));
        all
    });
    let contrast = |(t, (count, squares)): (usize, (usize, f64))| {
        let weights = readout.row(t);
        let moves = weights.iter().any(|w| w.abs() > REST * largest);
        let peak: f64 = weights.iter().zip(state.col(t).iter()).map(|(w, v)| w * v).sum();
        let rms = (squares / count.max(1) as f64).sqrt();
        let ratio = peak.abs() / rms;
        (moves && rms > 0.0 && ratio.is_finite()).then_some(ratio)
    };
    sums.into_iter().enumerate().map(contrast).collect()
}

/// For every target, how many of the points are outside its disc, and the sum of the squared velocities there.
fn outside(
    modal: &ModalResponses,
    points: &[Point],
    targets: &[Point],
    state: MatRef<'_, f32>,
    radius: f64,
) -> Vec<(usize, f64)> {
    let exact = modal.shapes.at_all(points);
    let weights = Mat::from_fn(exact.nrows(), exact.ncols(), |p, m| exact[(p, m)] as f32);
    let mut field = Mat::<f32>::zeros(points.len(), targets.len());
    multiply(field.as_mut(), Accum::Replace, weights.as_ref(), state, 1.0, Par::Seq);
    let one = |(target, field): (&Point, &[f32])| {
        let outside = points.iter().zip(field).filter(|(point, _)| {
            let (x, y) = (point.x - target.x, point.y - target.y);
            x * x + y * y > radius * radius
        });
        outside.fold((0, 0.0), |(count, sum), (_, v)| (count + 1, sum + f64::from(*v).powi(2)))
    };
    targets.iter().enumerate().map(|(t, target)| one((target, field.col_as_slice(t)))).collect()
}
