//! A drive that plays something, evaluated as a whole.

use super::write;
use crate::{Progress, SurfaceAsk, TaskError, folder, go_on, judge, source};
use std::path::PathBuf;
use unripple::act::{DecidedBy, Followed, Report, Strength, Stroked};
use unripple::core::{Drive, Responses, Surface};
use unripple::field::{Aim, Field, SilenceFigures};
use unripple::focus::Options;
use unripple_store::OutputDir;

/// Cells of the grid per shortest wavelength, where the whole of a long drive is measured. Fewer than the eight of a
/// single focus: the time of a long drive counts, and rms figures change little.
const CELLS: f64 = 3.0;

/// A drive nearer to its limit than this was held by it: float32 rounds by less.
const HELD: f64 = 1e-6;

/// A drive, what is known of it, and how well it does.
pub(crate) struct Played {
    /// The drive, float32 samples in the actuators' unit.
    pub drive: Drive,
    /// Places and instants at which the drive is evaluated.
    pub aims: Vec<Aim>,
    /// Name of the method that made it.
    pub method: &'static str,
    /// How the targets followed their waveforms.
    pub waveforms: Vec<Followed>,
    /// What is left at the silent places.
    pub silent: Vec<SilenceFigures>,
    /// How a stroke kept its level, if it is one.
    pub stroke: Option<Stroked>,
}

/// What a waveform and a stroke are asked alike.
pub(crate) struct Common<'a> {
    /// The surface that the drive is made for.
    pub surface: &'a SurfaceAsk,
    /// Another surface that the drive is evaluated on.
    pub on: Option<&'a SurfaceAsk>,
    /// Highest frequency of the modes that the drive is evaluated on, in Hz.
    pub judge_hz: Option<f64>,
    /// Where the results are to go.
    pub output: Option<&'a PathBuf>,
    /// Files that are read, which no output may replace.
    pub reads: Vec<PathBuf>,
    /// Name of the field that a library does not serve.
    pub needs: &'static str,
    /// Multiples of the band up to which modes are planned with, and evaluated on by default.
    pub bands: [f64; 2],
}

/// Makes a drive by `play`, from the surface and the models it is planned and evaluated with, evaluates it, and
/// writes it where a folder is given.
pub(crate) fn judge(
    common: &Common<'_>,
    progress: &mut dyn Progress,
    play: impl FnOnce(&Surface, [&Responses; 2]) -> Result<Played, TaskError>,
) -> Result<(Report, Drive), TaskError> {
    let source = source::open(common.surface, progress)?;
    source.allows(&[(common.needs, true)])?;
    let surface = source.surface;
    let plant = common.on.map(|on| on.load()).transpose()?;
    let plant = plant.as_ref().unwrap_or(&surface);
    let out = common.output.map(|place| OutputDir::create_beside(place, &common.reads)).transpose()?;
    go_on(progress)?;
    progress.stage("responses");
    let [planned, judged] = common.bands;
    let model = judge::model(&surface, Some(planned * surface.emission.band[1]), &[])?;
    let judge_hz = common.judge_hz.unwrap_or(judged * plant.emission.band[1]);
    let judging = judge::model(plant, Some(judge_hz), &[])?;
    go_on(progress)?;
    progress.stage("drive");
    let played = play(&surface, [&model, &judging])?;
    crate::window::carries(model.conditions(), played.drive.duration(), "window_s")?;
    go_on(progress)?;
    let field = Field::new(&judging, &played.drive, CELLS).map_err(TaskError::input)?;
    let until = played.drive.duration() - 1.0 / played.drive.rate();
    let period = Some(played.drive.duration());
    let judged = judge::judge(plant, &field, &played.aims, period, until, progress)?;
    drop(field);
    let mut report = Report::new("focus", &surface, &played.drive, &judged);
    report.method = Some(played.method);
    let emission = &surface.emission;
    let limits = Options { limit: emission.limit, rms_limit: emission.rms_limit, ..Options::default() };
    let asked = Strength::of(&played.drive, &limits, DecidedBy::Asked);
    let by = if asked.below_limit > 1.0 + HELD { DecidedBy::Asked } else { DecidedBy::Limit };
    report.level = Some(Strength { decided_by: by, ..asked });
    report.judged_on = Some(format!("{}, modes up to {judge_hz} Hz", plant.name));
    report.waveforms = played.waveforms;
    report.silent = played.silent;
    report.stroke = played.stroke;
    if let Some(out) = out {
        write::write(&out, &mut report, plant, &played.drive, &judged)?;
        folder::finish(out, progress)?;
    }
    Ok((report, played.drive))
}
