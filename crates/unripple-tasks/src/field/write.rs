//! The folder of a field: report, figures and animation.

use super::run::animated;
use super::{Ask, Made};
use crate::figures::{self, Columns, Scene};
use crate::judge::CELLS;
use crate::{Progress, Record, TaskError, folder, go_on};
use unripple::act::Judged;
use unripple::core::{Point, Surface};
use unripple::field::{Aim, Field};
use unripple_plot::Figure;
use unripple_store::OutputDir;

/// Default span of the animation before and after the instant at the first point, in s.
const AROUND: [f64; 2] = [6e-3, 3e-3];

/// Writes report, figures and animation, lists the files in the report, and moves the folder to its final
/// place.
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

/// Draws the figures that the task writes to its folder, and returns their names and SVG texts.
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

/// Draws the animation, unless the request is for 0 frames.
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
    figures::movie(field, &scene(surface, aims, judged), around(aims, ask.movie_s), ask.frames)
}

/// Draws the displacement as an animated PNG of `frames` frames over `span` (start and end, in s), by
/// default from 6 ms before the instant at the first point to 3 ms after it; `None` for a library of
/// responses, which has no regular grid.
///
/// # Errors
/// [`TaskError::Ask`] of no frame or too many, and of a span that makes no sense or ends after the field is known.
pub fn animation(made: &Made, span: Option<[f64; 2]>, frames: usize) -> Result<Option<Vec<u8>>, TaskError> {
    animated(frames, span)?;
    if frames == 0 {
        return Err(TaskError::ask("frames", "at least 1", frames));
    }
    let field = Field::new(&made.responses, &made.drive, CELLS).map_err(TaskError::input)?;
    figures::check_animation(&field, frames, span)?;
    let scene = scene(&made.surface, &made.aims, &made.judged);
    figures::movie(&field, &scene, around(&made.aims, span), frames)
}

/// Start and end of an animation in s: as requested, or around the instant at the first point.
fn around(aims: &[Aim], asked: Option<[f64; 2]>) -> [f64; 2] {
    let instant = aims.first().map_or(0.0, |aim| aim.instant);
    asked.unwrap_or([(instant - AROUND[0]).max(0.0), instant + AROUND[1]])
}

/// What every map shows besides the field: the surface, the points and the focal radius.
fn scene(surface: &Surface, aims: &[Aim], judged: &Judged) -> Scene {
    let points: Vec<Vec<Point>> = aims.iter().map(|aim| aim.points.clone()).collect();
    Scene::new(surface, &points, judged.measured.focal_radius_m)
}
