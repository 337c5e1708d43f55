//! Search for the place and the delay at which a response fits the model best.

use super::checker::{Checker, Match, Projected};
use std::f64::consts::TAU;
use unripple_core::{Outline, Point};
use unripple_linalg::{Mat, product};

/// Number of places per shortest wavelength compared: half a step from the best place, the correlation has
/// fallen to 0.9.
const DENSE: f64 = 7.0;

/// Largest number of places along a side: 8100 in all, which bounds time and memory; a longer sheet is searched less
/// finely.
const MOST: f64 = 90.0;

/// Number of delays tried per shortest period compared: an eighth of it apart, where a correlation has
/// fallen to 0.92 at most.
const DELAYS: f64 = 8.0;

/// Finest step of a search, in metres and (`FINE_PERIOD`) in periods of the highest frequency. Finer than any error
/// of place that matters; with a coarser one the correlation of a good point would suffer.
const FINE: f64 = 2e-5;
const FINE_PERIOD: f64 = 1e-3;

/// Places all over a sheet, with the mode shapes and the power of the model's responses there.
pub(super) struct Sheet<'a> {
    /// The model with which responses are compared.
    pub checker: &'a Checker<'a>,
    outline: &'a Outline,
    places: Vec<Point>,
    shapes: Mat<f64>,
    powers: Vec<f64>,
    pitch: f64,
    period: f64,
}

/// A place and a delay, and how well a response fits the model there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    /// A place on the sheet, in m.
    pub at: Point,
    /// Delay of the response, in s.
    pub late: f64,
    /// Agreement of the response with the model at this place and delay.
    pub found: Match,
}

impl<'a> Sheet<'a> {
    /// Places all over the sheet, `DENSE` per wavelength of `wavenumber` (rad/m), for frequencies up to `top_hz`.
    pub fn new(checker: &'a Checker<'a>, outline: &'a Outline, wavenumber: f64, top_hz: f64) -> Self {
        let pitch = TAU / wavenumber / DENSE;
        let (width, height) = outline.extent();
        let count = |side: f64| (side / pitch).ceil().clamp(4.0, MOST);
        let (columns, rows) = (count(width), count(height));
        let places: Vec<Point> = (0..(columns * rows) as usize)
            .map(|n| ((n % columns as usize) as f64 + 0.5, (n / columns as usize) as f64 + 0.5))
            .map(|(x, y)| Point::new(x * width / columns, y * height / rows))
            .filter(|p| outline.contains(*p))
            .collect();
        let shapes = checker.shapes(&places);
        let powers = checker.powers(&shapes);
        Self { checker, outline, places, shapes, powers, pitch, period: 1.0 / top_hz }
    }

    /// Delays from `from` to `to` (s), in steps fine enough for a search.
    pub fn delays(&self, from: f64, to: f64) -> Vec<f64> {
        let step = self.period / DELAYS;
        let count = ((to - from) / step).ceil().max(0.0) as usize;
        (0..=count).map(|n| from + n as f64 * step).collect()
    }

    /// For each assumed delay (s), the largest squared correlation with the model over all places, 0 to 1.
    pub fn largest_correlations(&self, heard: &Projected, delays: &[f64]) -> Vec<f64> {
        let products = product(self.shapes.as_ref(), self.checker.products(heard, delays).as_ref());
        (0..delays.len())
            .map(|d| {
                let all = (0..self.places.len()).map(|p| {
                    self.checker.matched(products[(p, d)], self.powers[p], heard, 0.0).likeness.powi(2)
                });
                all.fold(0.0, f64::max)
            })
            .collect()
    }

    /// The place on the whole sheet at which measured responses fit the model best, for an assumed delay
    /// (s).
    pub fn anywhere(&self, heard: &Projected, late: f64) -> Option<Spot> {
        let products = product(self.shapes.as_ref(), self.checker.products(heard, &[late]).as_ref());
        let spot = |p: usize| Spot {
            at: self.places[p],
            late,
            found: self.checker.matched(products[(p, 0)], self.powers[p], heard, late),
        };
        let best = (0..self.places.len())
            .map(spot)
            .max_by(|a, b| a.found.likeness.abs().total_cmp(&b.found.likeness.abs()))?;
        Some(self.nearby(heard, best.at, late, self.pitch / 2.0))
    }

    /// The place near `at` and the delay near `late` (s) at which measured responses fit the model best, by
    /// a search with ever smaller steps, from `reach` (m) on.
    pub fn nearby(&self, heard: &Projected, at: Point, late: f64, reach: f64) -> Spot {
        let mut best = Spot { at, late, found: self.checker.at(heard, at, late) };
        let (mut step, mut turn) = (reach, self.period / DELAYS);
        while step > FINE || turn > FINE_PERIOD * self.period {
            let mut moved = false;
            for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
                let at = Point::new(best.at.x + x * step, best.at.y + y * step);
                if self.outline.contains(at) {
                    moved |= best.better(at, best.late, self.checker.at(heard, at, best.late));
                }
            }
            let times = [best.late - turn, best.late + turn];
            for (late, found) in times.iter().zip(self.checker.late(heard, best.at, &times)) {
                moved |= best.better(best.at, *late, found);
            }
            if !moved {
                (step, turn) = (step / 2.0, turn / 2.0);
            }
        }
        best
    }

    /// The delay, among `delays` (s), at which measured responses fit the model at the place `at` (m) best.
    pub fn best_delay(&self, heard: &Projected, at: Point, delays: &[f64]) -> Option<Spot> {
        let found = self.checker.late(heard, at, delays);
        let spots = delays.iter().zip(found).map(|(late, found)| Spot { at, late: *late, found });
        spots.max_by(|a, b| a.found.likeness.abs().total_cmp(&b.found.likeness.abs()))
    }
}

impl Spot {
    /// Takes another place and delay if the correlation is larger there, and returns whether it is.
    fn better(&mut self, at: Point, late: f64, found: Match) -> bool {
        let better = found.likeness.abs() > self.found.likeness.abs() * (1.0 + 1e-12);
        if better {
            *self = Self { at, late, found };
        }
        better
    }
}
