//! `unripple place`: where actuators should be, and how many.

use crate::args::PlaceOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::targets::{numbers, places, seconds};
use unripple_tasks::Place;
use unripple_tasks::place::{self, Ask};

/// Finds places for actuators.
pub fn run(options: &PlaceOptions, common: &Common) -> Result<(), CliError> {
    let (points_m, weights) = targets(&options.at)?;
    let ask = Ask {
        surface: common.surface(&options.surface),
        count: options.count,
        keep: options.keep.clone(),
        keep_all: options.keep_all,
        like: options.like.clone(),
        rim_m: options.rim_mm.as_deref().map(rim).transpose()?,
        within_m: polygons(&options.within, "--within")?,
        keep_out_m: polygons(&options.keep_out, "--keep-out")?,
        places_m: places(&options.place, "--place")?,
        pitch_m: options.grid_mm.map(|mm| mm / 1e3),
        apart_m: options.apart_mm.map(|mm| mm / 1e3),
        points_m,
        weights,
        targets_within_m: polygons(&options.screen, "--screen")?,
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

fn rim(text: &str) -> Result<[f64; 2], CliError> {
    let mm = numbers(text, "--rim-mm", "LEAST,MOST in mm", 2, 2)?;
    Ok([mm[0] / 1e3, mm[1] / 1e3])
}

/// Targets and their weights; no weights where none is given.
fn targets(typed: &[String]) -> Result<(Vec<Place>, Vec<f64>), CliError> {
    let read = |text: &String| numbers(text, "--at", "X,Y[,WEIGHT] in mm", 2, 3);
    let all = typed.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let weights = match all.iter().any(|values| values.len() == 3) {
        true => all.iter().map(|values| values.get(2).copied().unwrap_or(1.0)).collect(),
        false => Vec::new(),
    };
    Ok((all.iter().map(|values| [values[0] / 1e3, values[1] / 1e3]).collect(), weights))
}

/// Corners of a polygon at most: more numbers are taken for a mistake.
const CORNERS: usize = 1000;

/// Polygons as their corners, in m.
fn polygons(typed: &[String], option: &str) -> Result<Vec<Vec<Place>>, CliError> {
    let polygon = |text: &String| {
        let mm = numbers(text, option, "at least three corners X,Y in mm", 6, 2 * CORNERS)?;
        if mm.len() % 2 == 1 {
            let found = format!("{option} {text}: expected pairs X,Y in mm, found {} numbers", mm.len());
            return Err(CliError::Input(found));
        }
        Ok(mm.chunks_exact(2).map(|corner| [corner[0] / 1e3, corner[1] / 1e3]).collect())
    };
    typed.iter().map(polygon).collect()
}
