//! Options of the task `sensors`.

use crate::record::Request;
use crate::{Place, SurfaceAsk};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// How many sensors or taps to plan, and where they may be.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
    /// Number of places.
    pub count: usize,
    /// What is measured at each place.
    pub sensing: SensingAsk,
    /// Places that are measured in any case, in m, beside `count` others.
    pub keep_m: Vec<Place>,
    /// Least and greatest distance of the places from the rim, in m; by default anywhere.
    pub rim_m: Option<[f64; 2]>,
    /// Polygons in one of which places must lie, each as its corners in m; by default the whole surface.
    pub within_m: Vec<Vec<Place>>,
    /// Polygons in which no place may lie, each as its corners in m.
    pub keep_out_m: Vec<Vec<Place>>,
    /// Places to choose from, in m, instead of those of a grid.
    pub places_m: Vec<Place>,
    /// Spacing of the grid of places to choose from, in m; by default a quarter of the shortest wavelength.
    pub pitch_m: Option<f64>,
    /// Least distance between any two places, in m.
    pub apart_m: f64,
    /// Signal-to-noise ratio of the measured spectra, the mean over all places, in dB.
    pub snr_db: f64,
    /// Largest number of half waves, both directions together, in the variation of tension over the sheet that is fitted; 0 for uniform
    /// tension.
    pub profile: usize,
    /// Number of random choices that the search begins from, beside the greedy one.
    pub restarts: usize,
    /// Seed of the random choices.
    pub seed: u64,
    /// Largest number of places of the table of deviations against their number; by default twice `count`.
    pub up_to: Option<usize>,
    /// Folder for report and figures; by default no file is written.
    pub output: Option<PathBuf>,
    /// Write no figures.
    pub no_figures: bool,
    /// Width of all figures in columns of a printed page: 1 (86 mm) or 2 (178 mm); by default each figure
    /// has its own width.
    pub columns: Option<usize>,
}

/// What is measured at a place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SensingAsk {
    /// A sensor records a sweep of each actuator.
    #[default]
    Sweeps,
    /// The sensors of all actuators record a tap.
    Taps,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            surface: SurfaceAsk::default(),
            count: 4,
            sensing: SensingAsk::Sweeps,
            keep_m: Vec::new(),
            rim_m: None,
            within_m: Vec::new(),
            keep_out_m: Vec::new(),
            places_m: Vec::new(),
            pitch_m: None,
            apart_m: 0.0,
            snr_db: 50.0,
            profile: 3,
            restarts: 10,
            seed: 1,
            up_to: None,
            output: None,
            no_figures: false,
            columns: None,
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "sensors";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
