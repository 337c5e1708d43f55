//! `unripple doctor`: each stage between a touch and what is felt, checked in turn.

mod check;
mod device;
mod felt;
mod touch;

use crate::args::DoctorOptions;
use crate::error::CliError;
use crate::{input, judge, output};
use check::{Check, Verdict};
use serde::Serialize;
use std::fmt::Write;
use std::sync::Arc;
use unripple::core::Surface;
use unripple_live::Window;

/// What was found, and what it means for the fingertip.
#[derive(Debug, Serialize)]
struct Report {
    surface: String,
    checks: Vec<Check>,
    /// Why nothing may be felt, the likeliest first; empty where there is no reason.
    why_you_may_feel_nothing: Vec<String>,
}

pub fn run(options: &DoctorOptions, as_json: bool) -> Result<(), CliError> {
    let surface = input::surface(&options.surface)?;
    let mut checks = vec![Check::good("surface", told(&surface))];
    let window = Window::prompt(&surface);
    match judge::model(&surface, None, &[]) {
        Err(error) => checks.push(Check::failed(
            "model",
            format!("{error:?}"),
            "the surface file describes something whose modes cannot be computed: `unripple modes` says more",
        )),
        Ok(model) => {
            let model = Arc::new(model);
            checks.push(Check::good("model", format!("{} responses are ready", surface.actuators.len())));
            checks.extend(felt::checks(&surface, &model, window)?);
            checks.extend(device::checks(&options.device, &surface, &model)?);
        }
    }
    checks.extend(touch::checks(options));
    checks.push(device::priority());
    let why = reasons(&checks);
    let report = Report { surface: surface.name.clone(), checks, why_you_may_feel_nothing: why };
    output::answer(as_json, &report, &report.text())?;
    let failed = report.checks.iter().filter(|check| check.verdict == Verdict::Failed);
    let failed: Vec<&str> = failed.map(|check| check.name).collect();
    match failed.is_empty() {
        true => Ok(()),
        false => {
            let (count, all) = (failed.len(), report.checks.len());
            Err(CliError::Work(format!("{count} of {all} checks failed: {}", failed.join(", "))))
        }
    }
}

fn told(surface: &Surface) -> String {
    let (width, height) = surface.outline.extent();
    format!(
        "{}: {:.0} x {:.0} mm, {} actuators, {:.0} to {:.0} Hz",
        surface.name,
        width * 1e3,
        height * 1e3,
        surface.actuators.len(),
        surface.emission.band[0],
        surface.emission.band[1]
    )
}

/// What failed first, then what is doubtful.
fn reasons(checks: &[Check]) -> Vec<String> {
    let of = |verdict: Verdict| {
        let all = checks.iter().filter(move |check| check.verdict == verdict);
        all.map(|check| format!("{}: {}{}", check.name, check.found, check.advice()))
    };
    of(Verdict::Failed).chain(of(Verdict::Doubtful)).collect()
}

impl Report {
    fn text(&self) -> String {
        let mut text = String::new();
        for check in &self.checks {
            let _ = writeln!(text, "{:9} {:<11} {}", check.verdict.word(), check.name, check.found);
        }
        text += "\nwhy you may feel nothing\n";
        if self.why_you_may_feel_nothing.is_empty() {
            text += "  nothing here stands in the way. Threshold differs by 6 dB between persons; rest the finger lightly: a hard \
                     press stills the sheet under it.\n";
        }
        for (n, why) in self.why_you_may_feel_nothing.iter().enumerate() {
            let _ = writeln!(text, "  {}. {why}", n + 1);
        }
        text
    }
}
