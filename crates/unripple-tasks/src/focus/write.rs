//! The folder of a focus: drive, report and figures.

use super::Made;
use crate::figures::{self, Columns, Scene, When};
use crate::{Record, TaskError};
use unripple::act;
use unripple::core::ActuatorKind;
use unripple_plot::Figure;
use unripple_store::{OutputDir, write_wav};

/// Writes drive, report and (with `drawn`, their width in columns) figures, and lists the files in the
/// report.
pub(super) fn write(
    out: &OutputDir,
    made: &mut Made,
    record: &Record,
    drawn: Option<Columns>,
) -> Result<(), TaskError> {
    write_wav(out.path().join("drive.wav"), &made.drive)?;
    made.report.files = vec!["drive.wav".into()];
    if let Some(columns) = drawn {
        made.report.files.extend(figures::write(out, &columns.fit(pictures(made)))?);
    }
    record.write(out, &made.report)?;
    out.write("report.md", made.report.markdown().as_bytes())?;
    Ok(())
}

/// Draws the figures that the task writes to its folder, and returns their names and SVG texts.
///
/// # Errors
/// [`TaskError::Work`] of a figure that cannot be drawn.
pub fn figures(made: &Made, columns: Columns) -> Result<Vec<(String, String)>, TaskError> {
    figures::svgs(&columns.fit(pictures(made)))
}

fn pictures(made: &Made) -> Vec<(&'static str, Figure)> {
    let (measured, surface) = (&made.judged.measured, &made.surface);
    let scene = Scene::new(surface, &made.focused.points, measured.focal_radius_m);
    let unit = act::unit(&surface.actuators.first().map_or(ActuatorKind::Force, |a| a.kind));
    let mut figures = vec![("drive", figures::channels(&made.drive, unit))];
    // The others are drawn in m/s and µm, which nobody knows without a scale.
    if made.scaled {
        let (rate, when) = (made.drive.rate(), When::Focus);
        figures.insert(0, ("traces", figures::traces(&measured.targets, &made.judged.traces, rate, when)));
        figures.extend(figures::snapshots(&scene, measured, when).map(|figure| ("focus", figure)));
        figures.push(("peaks", figures::peaks(&scene, measured)));
        figures.extend(figures::felt(&scene, measured).map(|figure| ("felt", figure)));
    }
    figures
}
