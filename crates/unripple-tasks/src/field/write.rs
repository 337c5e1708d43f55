//! The folder of a field: report, figures and animation.

use super::{Ask, Made};
use crate::figures::{self, Scene};
use crate::judge::CELLS;
use crate::{Progress, TaskError, folder, go_on};
use unripple::core::Point;
use unripple::field::Field;
use unripple_store::OutputDir;

/// What the animation shows before the instant of the first figure, and after it, in s.
const AROUND: [f64; 2] = [6e-3, 3e-3];

/// Writes all of it, names the files in the report, and puts the folder in its place.
pub(super) fn write(
    ask: &Ask,
    out: OutputDir,
    made: &mut Made,
    progress: &mut dyn Progress,
) -> Result<(), TaskError> {
    go_on(progress)?;
    progress.stage("figures");
    let measured = &made.judged.measured;
    let points: Vec<Vec<Point>> = made.aims.iter().map(|aim| aim.points.clone()).collect();
    let scene = Scene::new(&made.surface, &points, measured.focal_radius_m);
    let mut figures = Vec::new();
    // They are drawn in m/s and µm, which nobody knows without a scale.
    if made.scaled {
        let rate = made.drive.rate();
        figures.push(("traces", figures::traces(&measured.targets, &made.judged.traces, rate)));
        figures.extend(figures::snapshots(&scene, measured).map(|figure| ("snapshot", figure)));
        figures.extend(figures::peaks(&scene, measured).map(|figure| ("peaks", figure)));
        figures.extend(figures::felt(&scene, measured).map(|figure| ("felt", figure)));
    }
    made.report.files = figures::write(&out, &figures)?;
    let span = span(ask, made)?;
    go_on(progress)?;
    if ask.frames > 0 {
        progress.stage("animation");
        let field = Field::new(&made.responses, &made.drive, CELLS).map_err(TaskError::input)?;
        if let Some(movie) = figures::movie(&field, &scene, span, ask.frames)? {
            out.write("animation.png", &movie)?;
            made.report.files.push("animation.png".into());
        }
    }
    out.write("report.json", folder::json(&made.report)?.as_bytes())?;
    out.write("report.md", made.report.markdown().as_bytes())?;
    folder::finish(out, progress)
}

/// Start and end of the animation, in seconds.
fn span(ask: &Ask, made: &Made) -> Result<[f64; 2], TaskError> {
    let instant = made.aims.first().map_or(0.0, |aim| aim.instant);
    match ask.movie_s {
        None => Ok([(instant - AROUND[0]).max(0.0), instant + AROUND[1]]),
        Some([from, to]) if from >= 0.0 && to > from => Ok([from, to]),
        Some([from, to]) => {
            Err(TaskError::ask("movie_s", "a start from 0 and an end after it", format!("{from} to {to}")))
        }
    }
}
