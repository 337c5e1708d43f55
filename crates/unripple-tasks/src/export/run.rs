//! Writes a library of responses in another format.

use super::{Ask, Format, Report, foreign};
use crate::{Progress, TaskError, go_on, source};
use unripple::core::clock;
use unripple_store::{Library, PointState, SofaAbout};

/// Writes a library as WAV files, or as one SOFA, universal or MATLAB file.
///
/// # Errors
/// [`TaskError::Ask`] if no format is given and the output's name implies none, or if another format is to hold what only SOFA
/// holds; [`TaskError::Input`] of a library without a finished point; those of reading and writing files;
/// [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let format = format(ask)?;
    let library = Library::open(&ask.library)?;
    let notes = source::warn(&library, progress);
    let (done, all) = (library.done().len(), library.points().len());
    let name = ask.library.display().to_string();
    if done == 0 {
        return Err(TaskError::Input(format!(
            "{name}: expected a library with finished points, found 0 of {all}"
        )));
    }
    go_on(progress)?;
    progress.stage("points");
    let bad = library.in_state(PointState::Bad).len();
    let mut committed = None;
    progress.place(&mut || {
        committed = Some(match format {
            Format::Wav => library.export_wav(&ask.output)?,
            Format::Sofa => library.export_sofa(&ask.output, &about(ask))?,
            Format::Uff => foreign::uff(&library, &ask.output)?,
            Format::UffModes => foreign::modes(&library, &ask.output)?,
            Format::Mat => foreign::mat(&library, &ask.output)?,
        });
        Ok(())
    })?;
    if let Some(committed) = committed.filter(|committed| committed.replaced) {
        progress.tell(&format!("replaced the earlier export in {}", committed.path.display()));
    }
    let plan = library.plan();
    Ok(Report {
        program: "unripple",
        version: env!("CARGO_PKG_VERSION"),
        command: "export",
        library: name,
        format: format.name(),
        output: ask.output.display().to_string(),
        points: done,
        points_left_out: all - done,
        points_bad: bad,
        actuators: plan.ports.len(),
        samples: plan.samples,
        sample_rate_hz: plan.conditions.rate,
        notes,
    })
}

/// The requested format, or the one that the output's name implies.
fn format(ask: &Ask) -> Result<Format, TaskError> {
    let ending = ask.output.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let format = match (ask.format, ending.as_deref()) {
        (Some(format), _) => format,
        (None, Some("sofa")) => Format::Sofa,
        (None, Some("uff" | "unv")) => Format::Uff,
        (None, Some("mat")) => Format::Mat,
        (None, None) => Format::Wav,
        (None, Some(ending)) => {
            return Err(TaskError::ask(
                "output",
                "a name that ends in .sofa, .uff, .unv or .mat, a folder for WAV, or `format`",
                format!("the ending `.{ending}` in {}", ask.output.display()),
            ));
        }
    };
    let said = [&ask.author, &ask.organization, &ask.license];
    if format != Format::Sofa && said.iter().any(|text| text.is_some()) {
        return Err(TaskError::ask("author, organization, license", "SOFA, which holds them", format.told()));
    }
    Ok(format)
}

fn about(ask: &Ask) -> SofaAbout {
    SofaAbout {
        author: ask.author.clone(),
        organization: ask.organization.clone(),
        license: ask.license.clone(),
        created: clock::unix_seconds(),
    }
}
