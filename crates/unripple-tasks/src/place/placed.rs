//! Results of a search for places, as they stand in the report.

use serde::Serialize;
use unripple::core::Actuator;
use unripple_placement::{Aim, Found, Objective, Reached, figure};

/// An actuator in a layout.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Placed {
    /// Name of the actuator.
    pub name: String,
    /// Where it is, in m.
    pub at_m: [f64; 2],
}

/// A layout, and the contrast of time reversal from it at the evaluation targets.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Layout {
    /// The actuators, in the order of channels.
    pub actuators: Vec<Placed>,
    /// Mean of the contrasts, with the weights of the targets.
    pub mean_contrast: f64,
    /// Median of the contrasts.
    pub median_contrast: f64,
    /// The least contrast.
    pub worst_contrast: f64,
    /// Target with the least contrast, in m.
    pub worst_at_m: [f64; 2],
    /// Mean energy of the drive for a peak velocity of 1 m/s, in squared units of drive times seconds.
    pub energy_for_peak: f64,
}

/// Random layouts, for comparison, at places from which the search could choose.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Random {
    /// Number of random layouts.
    pub layouts: usize,
    /// Mean of their mean contrasts.
    pub mean_contrast: f64,
    /// Standard deviation of their mean contrasts.
    pub deviation: f64,
    /// Mean of their least contrasts.
    pub worst_contrast: f64,
    /// Mean of their energies for a peak velocity of 1 m/s, in squared units of drive times seconds.
    pub energy_for_peak: f64,
}

/// Values of the objective that the search reached from each of its starting layouts.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Restarts {
    /// The objective on the targets that layouts are optimised for, from the greedy layout and from each random one, before the
    /// actuators are moved off the grid.
    pub reached: Vec<f64>,
    /// The best of them.
    pub best: f64,
    /// The objective of the final layout, whose actuators were moved off the grid.
    pub polished: f64,
}

/// The best of all layouts on the grid, if there were few enough to compare all.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Best {
    /// Number of layouts.
    pub layouts: f64,
    /// The objective of the best of all layouts, on the targets that layouts are optimised for; absent if
    /// there were too many layouts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub objective: Option<f64>,
    /// How the layout that was found compares with the best of all, in words.
    pub certificate: String,
}

/// A number of actuators, and the contrast of the layout found for it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Number {
    /// Number of actuators, the kept ones included.
    pub actuators: usize,
    /// The objective on the targets that layouts are optimised for.
    pub objective: f64,
    /// Mean contrast at the evaluation targets.
    pub mean_contrast: f64,
    /// Least contrast at the evaluation targets.
    pub worst_contrast: f64,
}

/// Contrast with random errors of the actuators' places.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Build {
    /// Largest error along each axis, in m.
    pub error_m: f64,
    /// Mean contrast of layouts with such errors, each driven by its own responses.
    pub mean_contrast: f64,
    /// Standard deviation of their mean contrasts.
    pub deviation: f64,
    /// Number of layouts with random errors.
    pub builds: usize,
}

/// The place where one more actuator would improve the objective most.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct More {
    /// Name of the actuator of a library; absent where a place was chosen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The place, in m.
    pub at_m: [f64; 2],
    /// The objective with an actuator there, on the targets that layouts are optimised for.
    pub objective: f64,
}

impl Placed {
    /// Names and places of all actuators of a surface.
    pub(super) fn all(actuators: &[Actuator]) -> Vec<Self> {
        let one = |a: &Actuator| Self { name: a.name.clone(), at_m: [a.at.x, a.at.y] };
        actuators.iter().map(one).collect()
    }
}

impl Number {
    /// The contrasts of the layout that was found for a number of actuators, at `aims`.
    pub(super) fn of(found: &Found, reached: &[Reached], aims: &[Aim]) -> Self {
        Self {
            actuators: found.actuators.len(),
            objective: found.score,
            mean_contrast: figure(reached, aims, Objective::Mean),
            worst_contrast: figure(reached, aims, Objective::Worst),
        }
    }
}

impl Layout {
    /// The contrasts of a layout at `aims`.
    pub(super) fn of(actuators: Vec<Placed>, reached: &[Reached], aims: &[Aim]) -> Self {
        let least = (0..aims.len()).min_by(|a, b| reached[*a].least.total_cmp(&reached[*b].least));
        let worst_at = least.map_or([0.0; 2], |i| [aims[i].at.x, aims[i].at.y]);
        Self {
            actuators,
            mean_contrast: figure(reached, aims, Objective::Mean),
            median_contrast: figure(reached, aims, Objective::Quantile(0.5)),
            worst_contrast: figure(reached, aims, Objective::Worst),
            worst_at_m: worst_at,
            energy_for_peak: reached.iter().map(|r| r.energy).sum::<f64>() / reached.len().max(1) as f64,
        }
    }
}

impl Random {
    /// The contrasts of random layouts at `aims`.
    pub(super) fn of(reached: &[Vec<Reached>], aims: &[Aim]) -> Self {
        let (mean_contrast, deviation) = mean_and_deviation(reached, aims);
        let mean =
            |of: &dyn Fn(&Vec<Reached>) -> f64| reached.iter().map(of).sum::<f64>() / reached.len() as f64;
        Self {
            layouts: reached.len(),
            mean_contrast,
            deviation,
            worst_contrast: mean(&|r| figure(r, aims, Objective::Worst)),
            energy_for_peak: mean(&|r| r.iter().map(|r| r.energy).sum::<f64>() / r.len() as f64),
        }
    }
}

impl Build {
    /// The contrasts of layouts with random errors at `aims`.
    pub(super) fn of(error_m: f64, reached: &[Vec<Reached>], aims: &[Aim]) -> Self {
        let (mean_contrast, deviation) = mean_and_deviation(reached, aims);
        Self { error_m, mean_contrast, deviation, builds: reached.len() }
    }
}

/// Mean and standard deviation of the mean contrasts of several layouts.
fn mean_and_deviation(reached: &[Vec<Reached>], aims: &[Aim]) -> (f64, f64) {
    let means: Vec<f64> = reached.iter().map(|r| figure(r, aims, Objective::Mean)).collect();
    let mean = means.iter().sum::<f64>() / means.len() as f64;
    let squares: f64 = means.iter().map(|m| (m - mean).powi(2)).sum();
    (mean, (squares / (means.len() as f64 - 1.0).max(1.0)).sqrt())
}
