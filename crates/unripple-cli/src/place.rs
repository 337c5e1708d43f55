//! `unripple place`: where actuators should be, and how many.

use crate::args::PlaceOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::typed::{each, of, places, seconds};
use unripple_tasks::place::{self, Ask};
use unripple_tasks::text_forms::{distances, polygon, weighted};

/// Finds places for actuators.
pub fn run(options: &PlaceOptions, common: &Common) -> Result<(), CliError> {
    let (points_m, weights) = of("--at", weighted(&options.at))?;
    let ask = Ask {
        surface: common.surface(&options.surface),
        count: options.count,
        keep: options.keep.clone(),
        keep_all: options.keep_all,
        like: options.like.clone(),
        rim_m: of("--rim-mm", options.rim_mm.as_deref().map(distances).transpose())?,
        within_m: each(&options.within, "--within", polygon)?,
        keep_out_m: each(&options.keep_out, "--keep-out", polygon)?,
        places_m: places(&options.place, "--place")?,
        pitch_m: options.grid_mm.map(|mm| mm / 1e3),
        apart_m: options.apart_mm.map(|mm| mm / 1e3),
        points_m,
        weights,
        targets_within_m: each(&options.screen, "--screen", polygon)?,
        targets: options.targets,
        objective: options.objective.objective(),
        share: options.share_percent / 100.0,
        mounting_m: options.mounting_mm / 1e3,
        tension: options.tension_percent / 100.0,
        window_s: seconds(options.window_ms, "--window-ms")?,
        restarts: options.restarts,
        seed: options.seed,
        up_to: options.up_to,
        methods: options.method.iter().map(|name| name.method()).collect(),
        output: options.output.clone(),
        no_figures: options.no_figures,
        columns: options.columns,
    };
    output::perform(common.json, &ask, place::run)
}
