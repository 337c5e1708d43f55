//! Places between those of the grid: every actuator is moved in ever smaller steps while that gains.

use crate::{Aim, Forms, Objective, PlacementError, Plant, Rules, Search};
use std::f64::consts::TAU;
use unripple_core::Point;

/// Directions in which an actuator may move. With half as many, it could not move along a rim that is oblique to the axes.
const DIRECTIONS: usize = 8;

/// Number of sizes of steps: from half the pitch of the grid, each half the one before, to a thirty-second.
const HALVINGS: usize = 5;

/// Largest number of moves with one size of step. A place that is still better after that is found with the next size, or is a
/// long way off.
const MOVES: usize = 4;

/// Settings for moving actuators to better places between those of the grid: models of the surface, targets,
/// window, rules.
#[derive(Clone, Copy, Debug)]
pub struct Polish<'a> {
    /// The models of the surface.
    pub plants: &'a [Plant],
    /// The targets, each with its weight.
    pub aims: &'a [Aim],
    /// Window T, in seconds.
    pub window: f64,
    /// Largest error of each place along each axis, in metres.
    pub mounting: f64,
    /// Where actuators may be.
    pub rules: &'a Rules,
    /// Least distance between any two actuators, in metres.
    pub apart: f64,
    /// The objective that is maximised.
    pub objective: Objective,
}

impl Polish<'_> {
    /// Moves the actuators from their places (m) on a grid with the given pitch (m) to better ones nearby; returns the new places and the
    /// value of the objective, a contrast (ratio).
    ///
    /// # Errors
    /// Those of [`Forms::new`].
    pub fn polished(&self, mut places: Vec<Point>, pitch: f64) -> Result<(Vec<Point>, f64), PlacementError> {
        let mut score = 0.0;
        let mut step = 0.5 * pitch;
        for _ in 0..HALVINGS {
            for _ in 0..MOVES {
                let (moved, found) = self.moved(&places, step)?;
                score = found;
                if moved == places {
                    break;
                }
                places = moved;
            }
            step *= 0.5;
        }
        Ok((places, score))
    }

    /// The places after every actuator has moved by a step, or not at all.
    fn moved(&self, places: &[Point], step: f64) -> Result<(Vec<Point>, f64), PlacementError> {
        let plant = &self.plants[0];
        let kept = plant.kept();
        let outline = &plant.surface().outline;
        let (mut tried, mut whose): (Vec<Point>, Vec<usize>) = (places.to_vec(), (0..places.len()).collect());
        for (i, place) in places.iter().enumerate() {
            let around = (0..DIRECTIONS).map(|d| TAU * d as f64 / DIRECTIONS as f64);
            let around =
                around.map(|angle| Point::new(place.x + step * angle.cos(), place.y + step * angle.sin()));
            for point in around.filter(|point| self.rules.allow(outline, *point) && plant.holds(*point)) {
                tried.push(point);
                whose.push(i);
            }
        }
        let forms = Forms::new(self.plants, &tried, self.aims, self.window, self.mounting)?;
        let at: Vec<Point> =
            plant.surface().actuators.iter().map(|a| a.at).chain(tried.iter().copied()).collect();
        let search = Search { forms: &forms, at: &at, kept, apart: self.apart, objective: self.objective };
        let now = (0..kept + places.len()).collect();
        let found = search.exchanged_among(now, |position, b| whose[b - kept] == position - kept);
        Ok((found.actuators[kept..].iter().map(|a| at[*a]).collect(), found.score))
    }
}
