//! `unripple compare`: compares focusing methods on the same targets, on one surface or several.

use crate::args::CompareOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::typed::seconds;
use unripple_tasks::compare::{self, Ask};
use unripple_tasks::{SurfaceAsk, text_forms};

/// Compares methods on the same targets, on each surface.
pub fn run(options: &CompareOptions, common: &Common) -> Result<(), CliError> {
    let (surfaces, labels) = surfaces(options, common)?;
    let mut surfaces = surfaces.into_iter();
    let ask = Ask {
        surface: surfaces.next().unwrap_or_default(),
        others: surfaces.collect(),
        labels,
        methods: options.method.iter().map(|name| name.method()).collect(),
        points: options.targets.points()?,
        shapes: options.targets.shapes()?,
        level: options.targets.level()?,
        window_s: seconds(options.window_ms, "--window-ms")?,
        judge_hz: options.judge_hz,
        // They take half of the time, and no table shows them.
        no_tradeoffs: !(common.json || options.output.is_some()),
        no_figures: options.no_figures,
        columns: options.columns,
        output: options.output.clone(),
    };
    output::perform(common.json, &ask, compare::run)
}

/// The surfaces in the order typed, with `--vary` each of them once for each value; and what they are called then.
fn surfaces(options: &CompareOptions, common: &Common) -> Result<(Vec<SurfaceAsk>, Vec<String>), CliError> {
    let names = &options.surface;
    let Some(vary) = &options.vary else {
        return Ok((names.iter().map(|name| common.surface(name)).collect(), Vec::new()));
    };
    let refused = |expected: &str| CliError::Input(format!("--vary {vary}: expected {expected}"));
    let (key, values) = text_forms::key_and_value(vary)
        .ok_or_else(|| refused("KEY=VALUE,VALUE, as in sheet.tension_n_per_m=200,300,400"))?;
    let (mut surfaces, mut labels) = (Vec::new(), Vec::new());
    for name in names {
        for value in text_forms::values(values) {
            let surface = common.surface_with(name, key, value);
            surfaces.push(surface.ok_or_else(|| refused("a key that --set does not set"))?);
            labels.push(match names.len() {
                1 => format!("{key}={value}"),
                _ => format!("{name}, {key}={value}"),
            });
        }
    }
    Ok((surfaces, labels))
}
