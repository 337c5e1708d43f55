//! Evaluation of drives for waveforms and strokes, over their whole length.

use super::Made;
use crate::judge::{self, Judging, Reached};
use crate::{Progress, Source, SurfaceAsk, TaskError, go_on};
use unripple::act::{DecidedBy, Followed, Report, Strength, Stroked};
use unripple::core::{Drive, Responses, Surface};
use unripple::field::{Aim, Field, SilenceFigures};
use unripple::focus::Options;

/// Cells of the grid per shortest wavelength for the evaluation of a long drive. Fewer than the eight of a
/// single focus: the time of a long drive counts, and rms figures change little.
const CELLS: f64 = 3.0;

/// Relative distance from the drive limit within which the limit counts as having decided the drive's
/// level: rounding to float32 is smaller.
const HELD: f64 = 1e-6;

/// A drive of waveforms or of a stroke, and metrics of how accurately the targets follow.
pub(crate) struct Played {
    /// The drive, float32 samples in the actuators' unit.
    pub drive: Drive,
    /// Places and instants at which the drive is evaluated.
    pub aims: Vec<Aim>,
    /// Time by which the traces continue after the drive, in s: half a window, in which the last waves
    /// pass.
    pub after: f64,
    /// Name of the method that made the drive.
    pub method: &'static str,
    /// Metrics of how accurately each target follows its waveform; empty for a stroke.
    pub waveforms: Vec<Followed>,
    /// Metrics of the remaining motion at the places that are to stay still.
    pub silent: Vec<SilenceFigures>,
    /// Metrics of a stroke, such as how evenly it keeps its level; `None` for waveforms.
    pub stroke: Option<Stroked>,
}

/// Options that the tasks `waveform` and `stroke` have in common.
pub(crate) struct Common<'a> {
    /// Surface that the drive is evaluated on, if it is not the one that the drive is computed for.
    pub on: Option<&'a SurfaceAsk>,
    /// Highest frequency of the modes that the drive is evaluated on, in Hz.
    pub judge_hz: Option<f64>,
    /// Fields that need a surface, as named in the error if the source is a library.
    pub needs: &'static str,
    /// Multiples of the top of the band up to which modes are used: to plan the drive, and by default to
    /// evaluate it. Each list is tried in its order until the modes can be computed, and the band itself
    /// comes last; no multiple exceeds 0.45 of the sample rate.
    pub bands: [&'a [f64]; 2],
}

/// Computes a drive with `play` and evaluates it. `plan` is called first, before any response is computed,
/// and refuses what makes no sense; `play` receives its result, the surface, and the responses for planning
/// and for evaluation.
pub(crate) fn judge<T>(
    common: Common<'_>,
    source: Source,
    progress: &mut dyn Progress,
    plan: impl FnOnce(&Surface) -> Result<T, TaskError>,
    play: impl FnOnce(T, &Surface, [&Responses; 2]) -> Result<Played, TaskError>,
) -> Result<Made, TaskError> {
    source.allows(&[(common.needs, true)])?;
    let Source { surface, computed, solved, .. } = source;
    let other = common.on.map(|on| on.load()).transpose()?;
    let plant = other.as_ref().unwrap_or(&surface);
    go_on(progress)?;
    judge::reaches(plant, common.judge_hz)?;
    let plan = plan(&surface)?;
    progress.stage("responses");
    let [planned, judged] = common.bands;
    let Reached { found: model, hz: planned_hz, missed } =
        judge::reached(&surface, None, planned, |hz| match &computed {
            // Responses that are given stand for those of the band.
            Some(computed) if hz == surface.emission.band[1] => Ok(computed.clone()),
            _ => solved.model(&surface, Some(hz), &[]),
        })?;
    go_on(progress)?;
    progress.stage(judge::RESPONSES);
    let on = Judging::among(plant, common.judge_hz, judged, |hz| solved.model(plant, Some(hz), &[]));
    let (judging, on) = on?;
    go_on(progress)?;
    progress.stage("drive");
    let played = play(plan, &surface, [&model, &judging])?;
    crate::window::carries(model.conditions(), played.drive.duration(), "window_s")?;
    go_on(progress)?;
    progress.stage("evaluation");
    let field = Field::new(&judging, &played.drive, CELLS).map_err(TaskError::input)?;
    let until = played.drive.duration() - 1.0 / played.drive.rate() + played.after;
    let period = Some(played.drive.duration());
    let judged = judge::judge(plant, &field, &played.aims, period, until, progress)?;
    drop(field);
    let mut report = Report::new("focus", &surface, &played.drive, &judged);
    report.method = Some(played.method);
    // An image of the whole time says little of waveforms, and the grid is another than that of foci.
    report.ssim = None;
    let emission = &surface.emission;
    let limits = Options { limit: emission.limit, rms_limit: emission.rms_limit, ..Options::default() };
    let asked = Strength::of(&played.drive, &limits, DecidedBy::Asked);
    let by = if asked.below_limit > 1.0 + HELD { DecidedBy::Asked } else { DecidedBy::Limit };
    report.level = Some(Strength { decided_by: by, ..asked });
    on.told_of(plant, &judging).tell(plant, &mut report);
    report.notes.extend(missed.map(|missed| missed.on_planning(&surface, planned_hz)));
    report.waveforms = played.waveforms;
    report.silent = played.silent;
    report.stroke = played.stroke;
    let surface = plant.clone();
    Ok(Made { report, drive: played.drive, judged, surface })
}
