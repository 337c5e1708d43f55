//! The output folder of a drive for waveforms or a stroke: drive, report and figures.

use super::Made;
use crate::figures::{self, Columns, Scene, When};
use crate::{Progress, Record, TaskError, folder};
use unripple::act::{Report, unit};
use unripple::core::{ActuatorKind, Point};
use unripple_plot::Figure;
use unripple_store::{OutputDir, write_wav};

/// Writes drive, report and (with `drawn`, their width in columns) figures to the folder if there is one,
/// lists the files in the report, and returns the report.
pub(crate) fn keep(
    mut made: Made,
    out: Option<(OutputDir, Record)>,
    drawn: Option<Columns>,
    progress: &mut dyn Progress,
) -> Result<Report, TaskError> {
    let Some((out, record)) = out else { return Ok(made.report) };
    write_wav(out.path().join("drive.wav"), &made.drive)?;
    made.report.files = vec!["drive.wav".into()];
    progress.stage("figures");
    if let Some(columns) = drawn {
        made.report.files.extend(figures::write(&out, &columns.fit(pictures(&made)))?);
    }
    out.write("report.md", made.report.markdown().as_bytes())?;
    record.write(&out, &made.report)?;
    folder::finish(out, progress)?;
    Ok(made.report)
}

/// Draws the figures of a drive for waveforms or a stroke, and returns their names and SVG texts.
///
/// # Errors
/// [`TaskError::Work`] of a figure that cannot be drawn.
pub fn figures(made: &Made, columns: Columns) -> Result<Vec<(String, String)>, TaskError> {
    figures::svgs(&columns.fit(pictures(made)))
}

fn pictures(made: &Made) -> Vec<(&'static str, Figure)> {
    let Made { report, drive, judged, surface } = made;
    let when = if report.stroke.is_some() { When::Stroke } else { When::Waveform };
    let measured = &judged.measured;
    let points: Vec<Vec<Point>> =
        measured.targets.iter().map(|t| vec![Point::new(t.at_m[0], t.at_m[1])]).collect();
    let scene = Scene::new(surface, &points, measured.focal_radius_m);
    let unit = unit(&surface.actuators.first().map_or(ActuatorKind::Force, |a| a.kind));
    vec![
        ("traces", figures::traces(&measured.targets, &judged.traces, drive.rate(), when)),
        ("drive", figures::channels(drive, unit)),
        ("peaks", figures::peaks(&scene, measured)),
    ]
}
