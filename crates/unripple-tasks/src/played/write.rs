//! The folder of what is played: drive, report and figures.

use crate::TaskError;
use crate::figures::{self, Columns, Scene, When};
use unripple::act::{Judged, Report, unit};
use unripple::core::{ActuatorKind, Drive, Point, Surface};
use unripple_plot::Figure;
use unripple_store::{OutputDir, write_wav};

/// Writes all of it but the report as JSON, and names the files in the report; figures are of a surface and
/// a width, where these are given.
pub(super) fn write(
    out: &OutputDir,
    report: &mut Report,
    drawn: Option<(&Surface, Columns)>,
    drive: &Drive,
    judged: &Judged,
) -> Result<(), TaskError> {
    write_wav(out.path().join("drive.wav"), drive)?;
    report.files = vec!["drive.wav".into()];
    if let Some((surface, columns)) = drawn {
        let when = if report.stroke.is_some() { When::Stroke } else { When::Waveform };
        report.files.extend(figures::write(out, &columns.fit(figures(surface, drive, judged, when)))?);
    }
    out.write("report.md", report.markdown().as_bytes())?;
    Ok(())
}

fn figures(surface: &Surface, drive: &Drive, judged: &Judged, when: When) -> Vec<(&'static str, Figure)> {
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
