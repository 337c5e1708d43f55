//! The folder of a field: report, figures and animation.

use super::{Ask, Made};
use crate::figures::{self, Columns, Scene};
use crate::{Progress, Record, TaskError, folder, go_on};
use unripple::act::Judged;
use unripple::core::{Point, Surface};
use unripple::field::{Aim, Field};
use unripple_plot::Figure;
use unripple_store::OutputDir;

/// What the animation shows before the instant of the first figure, and after it, in s.
const AROUND: [f64; 2] = [6e-3, 3e-3];

/// Writes report, figures and animation, names the files in the report, and puts the folder in its place.
pub(super) fn write(
    ask: &Ask,
    (out, record): (OutputDir, Record),
    made: &mut Made,
    movie: Option<Vec<u8>>,
    progress: &mut dyn Progress,
) -> Result<(), TaskError> {
    go_on(progress)?;
    progress.stage("figures");
    let pictures = if ask.no_figures { Vec::new() } else { Columns::of(ask.columns)?.fit(pictures(made)) };
    made.report.files = figures::write(&out, &pictures)?;
    if let Some(movie) = movie {
        out.write("animation.png", &movie)?;
        made.report.files.push("animation.png".into());
    }
    record.write(&out, &made.report)?;
    out.write("report.md", made.report.markdown().as_bytes())?;
    folder::finish(out, progress)
}

/// The figures in the folder of a field, as SVG text by their names.
///
/// # Errors
/// [`TaskError::Work`] of a figure that cannot be drawn.
pub fn figures(made: &Made, columns: Columns) -> Result<Vec<(String, String)>, TaskError> {
    figures::svgs(&columns.fit(pictures(made)))
}

fn pictures(made: &Made) -> Vec<(&'static str, Figure)> {
    // They are drawn in m/s and µm, which nobody knows without a scale.
    if !made.scaled {
        return Vec::new();
    }
    let (measured, rate, when) = (&made.judged.measured, made.drive.rate(), made.when);
    let scene = scene(&made.surface, &made.aims, &made.judged);
    let mut figures = vec![("traces", figures::traces(&measured.targets, &made.judged.traces, rate, when))];
    figures.extend(figures::snapshots(&scene, measured, when).map(|figure| ("snapshot", figure)));
    figures.push(("peaks", figures::peaks(&scene, measured)));
    figures.extend(figures::felt(&scene, measured).map(|figure| ("felt", figure)));
    figures
}

/// The animation, if there are to be frames.
pub(super) fn movie(
    ask: &Ask,
    surface: &Surface,
    field: &Field,
    aims: &[Aim],
    judged: &Judged,
    progress: &mut dyn Progress,
) -> Result<Option<Vec<u8>>, TaskError> {
    go_on(progress)?;
    if ask.frames == 0 {
        return Ok(None);
    }
    progress.stage("animation");
    let instant = aims.first().map_or(0.0, |aim| aim.instant);
    let span = ask.movie_s.unwrap_or([(instant - AROUND[0]).max(0.0), instant + AROUND[1]]);
    figures::movie(field, &scene(surface, aims, judged), span, ask.frames)
}

/// What every map shows besides the field.
fn scene(surface: &Surface, aims: &[Aim], judged: &Judged) -> Scene {
    let points: Vec<Vec<Point>> = aims.iter().map(|aim| aim.points.clone()).collect();
    Scene::new(surface, &points, judged.measured.focal_radius_m)
}
