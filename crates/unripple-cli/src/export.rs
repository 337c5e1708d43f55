//! `unripple export`: a library in formats that others read.

use crate::args::{ExportOptions, FormatName};
use crate::error::CliError;
use crate::{input, output};
use serde_json::json;
use std::time::{SystemTime, UNIX_EPOCH};
use unripple_store::{Library, PointState, SofaAbout};

pub fn run(options: &ExportOptions, as_json: bool) -> Result<(), CliError> {
    let format = format(options)?;
    let library = Library::open(&options.library)?;
    let notes = input::warn(&library);
    let (done, all) = (library.done().len(), library.points().len());
    if done == 0 {
        return Err(CliError::Input(format!(
            "{}: expected a library with finished points, found 0 of {all}",
            options.library
        )));
    }
    let bad = library.in_state(PointState::Bad).len();
    let committed = match format {
        FormatName::Wav => library.export_wav(&options.output)?,
        FormatName::Sofa => library.export_sofa(&options.output, &about(options))?,
    };
    if committed.replaced {
        eprintln!("replaced the earlier export in {}", committed.path.display());
    }
    let plan = library.plan();
    let report = json!({
        "program": "unripple",
        "version": env!("CARGO_PKG_VERSION"),
        "command": "export",
        "library": options.library,
        "format": name(format),
        "output": options.output.display().to_string(),
        "points": done,
        "points_left_out": all - done,
        "points_bad": bad,
        "actuators": plan.ports.len(),
        "samples": plan.samples,
        "sample_rate_hz": plan.conditions.rate,
        "notes": notes,
    });
    let left = match all - done {
        0 => String::new(),
        left => format!(" ({left} left out: {bad} bad, {} missing)", left - bad),
    };
    let text = format!(
        "{}: {done} points of {} actuators, {} samples at {} Hz{left}\nwrote {}\n",
        options.library,
        plan.ports.len(),
        plan.samples,
        plan.conditions.rate,
        options.output.display()
    );
    output::answer(as_json, &report, &text)
}

fn name(format: FormatName) -> &'static str {
    match format {
        FormatName::Wav => "wav",
        FormatName::Sofa => "sofa",
    }
}

/// The format that was asked for, or that the output's name tells.
fn format(options: &ExportOptions) -> Result<FormatName, CliError> {
    let ending = options.output.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let format = match (options.format, ending.as_deref()) {
        (Some(format), _) => format,
        (None, Some("sofa")) => FormatName::Sofa,
        (None, None) => FormatName::Wav,
        (None, Some(ending)) => {
            return Err(CliError::Input(format!(
                "-o {}: expected a name that ends in .sofa, a folder for WAV, or --format, found the ending `.{ending}`",
                options.output.display()
            )));
        }
    };
    let said = [&options.author, &options.organization, &options.license];
    if format == FormatName::Wav && said.iter().any(|text| text.is_some()) {
        return Err(CliError::Input(
            "--author, --organization, --license: expected SOFA, which holds them, found WAV".into(),
        ));
    }
    Ok(format)
}

fn about(options: &ExportOptions) -> SofaAbout {
    SofaAbout {
        author: options.author.clone(),
        organization: options.organization.clone(),
        license: options.license.clone(),
        created: SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs()),
    }
}
