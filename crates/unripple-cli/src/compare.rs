//! `unripple compare`: compares focusing methods on the same targets, on one surface or several.

use crate::args::CompareOptions;
use crate::common::{Common, key_and_value};
use crate::error::CliError;
use crate::output;
use crate::targets::{self, seconds};
use unripple_tasks::SurfaceAsk;
use unripple_tasks::compare::{self, Ask};

/// Compares methods on the same targets, on each surface.
pub fn run(options: &CompareOptions, common: &Common) -> Result<(), CliError> {
    let (surfaces, labels) = surfaces(options, common)?;
    let mut surfaces = surfaces.into_iter();
    let ask = Ask {
        surface: surfaces.next().unwrap_or_default(),
        others: surfaces.collect(),
        labels,
        methods: options.method.iter().map(|name| name.method()).collect(),
        points: targets::points(&options.targets)?,
        shapes: targets::shapes(&options.targets)?,
        level: targets::level(&options.targets)?,
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
    let (key, values) = key_and_value(vary)
        .ok_or_else(|| refused("KEY=VALUE,VALUE, as in sheet.tension_n_per_m=200,300,400"))?;
    let (mut surfaces, mut labels) = (Vec::new(), Vec::new());
    for name in names {
        for value in separated(values) {
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

/// Values of a key, separated by commas; a comma within brackets or quotes is part of a value.
fn separated(values: &str) -> Vec<&str> {
    let (mut depth, mut quote) = (0, None);
    let parts = values.split(|c: char| {
        match (quote, c) {
            (Some(open), _) if open == c => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '[' | '{') => depth += 1,
            (None, ']' | '}') => depth -= 1,
            _ => {}
        }
        c == ',' && depth == 0 && quote.is_none()
    });
    parts.map(str::trim).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_separated_by_commas_of_their_own() {
        assert_eq!(separated("200, 300,400"), ["200", "300", "400"]);
        assert_eq!(separated("[12, 31],[40, 140]"), ["[12, 31]", "[40, 140]"]);
        assert_eq!(separated("'glass, thick',steel"), ["'glass, thick'", "steel"]);
        assert_eq!(separated(r#"{ a = "]" },2"#), [r#"{ a = "]" }"#, "2"]);
        assert_eq!(separated(",0.01"), ["", "0.01"]);
        assert_eq!(separated("BoPET"), ["BoPET"]);
    }
}
