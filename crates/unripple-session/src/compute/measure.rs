//! Computation and evaluation of a focus, with every figure that the command line has.

use super::{ComputeWorker, Found, Hear, Unfinished, given, method, options, places};
use crate::edition::Edition;
use crate::outbox::{Measured, Out};
use crate::spectrum::spectrum;
use crate::wire::Measure;
use serde_json::{Value, json};
use std::sync::Arc;
use unripple::act::{Act, Acted, Level, response_error};
use unripple::core::clock::Instant;
use unripple::core::{Drive, Surface};
use unripple::field::Trace;
use unripple::focus::{Method, Target};
use unripple_store::{Library, encode_wav, to_toml};
use unripple_tasks::target::{LevelAsk, PointAsk};
use unripple_tasks::{Progress, Record, SurfaceAsk, TaskError, focus, folder};

/// Points of a drive or trace that are drawn. One for each pixel of a panel.
const DRAWN: usize = 480;

impl ComputeWorker {
    /// Computes and evaluates a focus, and sends all figures of it to the page that requested it.
    pub(super) fn measure(
        &mut self,
        (measure, page): (&Measure, u64),
        of: &Arc<Edition>,
        progress: &mut dyn Progress,
        hear: &mut Hear,
    ) -> Result<(), Unfinished> {
        let began = Instant::now();
        let places = places(&measure.at);
        let (surface, responses) = (&of.surface, self.known(of, &places, progress)?);
        let method = measure.method.as_deref().map_or(Ok(Method::default()), method)?;
        let asked = given(measure.window_ms).map(|ms| ms * 1e-3);
        let (window, note) = self.window(of, &responses, asked, progress)?;
        let options = options(surface, method, window);
        let targets: Vec<Target> = places.into_iter().map(Target::at).collect();
        let level = level(given(measure.peak_um), self.unscaled(of))?;
        let judged = self.judged(of, progress)?;
        let on = judged.as_ref().map_or(&responses, |(judged, _)| judged).clone();
        let error = response_error(&on, options.window);
        let (edition, settings) = (of.clone(), options.clone());
        let acted = self.aside(progress, move |_| {
            let (surface, options) = (&edition.surface, &settings);
            let act = Act { surface, responses: &on, targets: &targets, options, level };
            act.run_from(&responses, &act.readouts()).map_err(TaskError::work)
        })?;
        let mut report = self.known_of(acted.report(surface, &options), of);
        report.response_error = error;
        report.notes.extend(note);
        judged.iter().for_each(|(_, judging)| judging.tell(surface, &mut report));
        let value = serde_json::to_value(&report).map_err(|error| error.to_string())?;
        let message = json!({
            "is": "measured",
            "id": measure.id,
            "edit": of.edit,
            "command": command(self.source(of), measure, method),
            "report": value,
            // What moves is drawn in µm.
            "traces": if self.unscaled(of).is_some() { Vec::new() } else { traces(&acted) },
            "spectrum": spectrum(&acted, surface.emission.band[1]),
            "drive": drive(&acted.drive, surface),
            "seconds": began.elapsed().as_secs_f64(),
        });
        let ask = ask(self.source(of), surface, measure, method);
        // A library that cannot be read any more, of which all is in memory, leaves the report without a record.
        let json = match Record::of(&ask) {
            Ok(record) => record.json(&report),
            Err(_) if Library::is_at(self.source(of)) => folder::json(&report),
            Err(error) => Err(error),
        };
        let json = json.map_err(|error| error.to_string())?;
        let wav = encode_wav(&acted.drive).map_err(|error| error.to_string())?;
        let files = Measured { page, id: measure.id, drive: wav, json, markdown: report.markdown() };
        hear(Found::Out(Out::Measured(Box::new(files))));
        hear(Found::Out(Out::Answer(page, message.to_string())));
        Ok(())
    }
}

/// The level of the drive, from the peak in µm that is asked for and the reason why the scale is unknown, if it is.
fn level(peak: Option<f64>, unscaled: Option<&str>) -> Result<Level, String> {
    match (peak, unscaled) {
        (Some(_), Some(why)) => {
            Err(format!("peak in µm: expected a library whose scale is known, found one without: {why}"))
        }
        (Some(um), None) => Ok(Level::Peak(um * 1e-6)),
        (None, Some(_)) => Ok(Level::Limit),
        (None, None) => Ok(Level::default()),
    }
}

/// The ask that computes the same focus: of a library by its name, of a surface by its text as it is now.
fn ask(source: &str, surface: &Surface, measure: &Measure, method: Method) -> focus::Ask {
    let surface = match Library::is_at(source) {
        true => SurfaceAsk::Name(source.into()),
        false => SurfaceAsk::Text { toml: to_toml(surface), name: Some(source.into()) },
    };
    focus::Ask {
        surface,
        points: measure.at.iter().map(|[x, y]| PointAsk::at(x * 1e-3, y * 1e-3)).collect(),
        method,
        window_s: given(measure.window_ms).map(|ms| ms * 1e-3),
        level: given(measure.peak_um).map_or(LevelAsk::default(), |um| LevelAsk::PeakM(um * 1e-6)),
        ..focus::Ask::default()
    }
}

/// The command line that computes the same focus.
fn command(source: &str, measure: &Measure, method: Method) -> String {
    let mut command = format!("unripple focus {source}");
    for [x, y] in &measure.at {
        command += &format!(" --at {x},{y}");
    }
    if method != Method::default() {
        command += &format!(" --method {method}");
    }
    if let Some(ms) = given(measure.window_ms) {
        command += &format!(" --window-ms {ms}");
    }
    if let Some(um) = given(measure.peak_um) {
        command += &format!(" --peak-um {um}");
    }
    command + " -o out"
}

fn traces(acted: &Acted) -> Vec<Value> {
    let rate = acted.drive.rate();
    let trace = |(number, trace): (usize, &Trace)| {
        let scaled =
            |values: &[f64], factor: f64| values.iter().map(|x| round(x * factor)).collect::<Vec<f64>>();
        json!({
            "name": format!("target {number}"),
            "rate": rate,
            "start_s": 0.0,
            "displacement_um": scaled(&trace.displacement, 1e6),
            "velocity_m_s": scaled(&trace.velocity, 1.0),
        })
    };
    (1..).zip(&acted.judged.traces).map(trace).collect()
}

fn drive(drive: &Drive, surface: &Surface) -> Value {
    let channels = drive.channels();
    let peak = |channel: &Vec<f64>| channel.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let square =
        |channel: &Vec<f64>| channel.iter().map(|x| x * x).sum::<f64>() / channel.len().max(1) as f64;
    json!({
        "rate": drive.rate(),
        "seconds": drive.duration(),
        "peak": channels.iter().map(peak).collect::<Vec<_>>(),
        "rms": channels.iter().map(|channel| square(channel).sqrt()).collect::<Vec<_>>(),
        "limit": vec![surface.emission.limit; channels.len()],
        "rms_limit": surface.emission.rms_limit,
        "preview": channels.iter().map(|channel| preview(channel)).collect::<Vec<_>>(),
    })
}

/// A channel in few points: of each stretch the value farthest from 0.
fn preview(channel: &[f64]) -> Vec<f64> {
    let stretch = channel.len().div_ceil(DRAWN).max(1);
    let farthest = |part: &[f64]| part.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()));
    channel.chunks(stretch).filter_map(farthest).map(round).collect()
}

/// Seven digits are more than a picture can show.
fn round(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}
