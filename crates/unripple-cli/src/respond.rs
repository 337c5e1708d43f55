//! `unripple respond`: responses from the model, as a library.

use crate::args::RespondOptions;
use crate::error::CliError;
use crate::targets::{carries, positive, seconds};
use crate::{grid, input, judge, output};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;
use std::time::{SystemTime, UNIX_EPOCH};
use unripple::act::unit;
use unripple::core::{ModalResponses, Responses, Surface, window_samples};
use unripple::physics::design::Windows;
use unripple::physics::sample;
use unripple_store::{Library, LibraryPlan, PointState, Quality, Take};

/// Points computed and stored at once.
const BATCH: usize = 64;

pub fn run(options: &RespondOptions, as_json: bool) -> Result<(), CliError> {
    let surface = input::surface(&options.surface)?;
    let pitch = positive(options.grid_mm, "--grid-mm", "mm")? / 1e3;
    Library::may_be_at(&options.output)?;
    let Responses::Modal(modal) = judge::model(&surface, None, &[])? else {
        return Err(CliError::Work("expected a model with modes, found samples".into()));
    };
    let plan = plan(options, &surface, &modal, pitch)?;
    let mut library = Library::create(&options.output, &plan)?;
    let before = library.done().len();
    fill(&mut library, &modal)?;
    let (points, samples) = (plan.points.len(), plan.samples);
    let report = json!({
        "program": "unripple",
        "version": env!("CARGO_PKG_VERSION"),
        "command": "respond",
        "surface": surface.name,
        "library": options.output.display().to_string(),
        "points": points,
        "points_found_done": before,
        "pitch_m": pitch,
        "actuators": plan.ports.len(),
        "samples": samples,
        "sample_rate_hz": plan.conditions.rate,
        "lambda_min_m": plan.conditions.lambda_min,
    });
    let taken_up = if before > 0 { format!(", {before} of them done before") } else { String::new() };
    let text = format!(
        "{}: responses of {} actuators at {points} points, {} mm apart{taken_up}\n{samples} samples each, {:.3} ms at {} Hz\nwrote {}\n",
        surface.name,
        plan.ports.len(),
        options.grid_mm,
        (samples - 1) as f64 / plan.conditions.rate * 1e3,
        plan.conditions.rate,
        options.output.display()
    );
    output::answer(as_json, &report, &text)
}

fn plan(
    options: &RespondOptions,
    surface: &Surface,
    modal: &ModalResponses,
    pitch: f64,
) -> Result<LibraryPlan, CliError> {
    let length = seconds(options.length_ms, "--length-ms")?
        .unwrap_or_else(|| 2.0 * Windows::of(surface).recommended().seconds);
    carries(&modal.conditions, length, "--length-ms")?;
    let points = grid::points(&surface.outline, pitch)?;
    let conditions = modal.conditions.clone();
    let samples = window_samples(length, conditions.rate) + 1;
    let now = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let about = [
        ("device", "model".to_owned()),
        ("stimulus", "impulse".to_owned()),
        ("modes", modal.poles.len().to_string()),
        ("software", format!("unripple {}", env!("CARGO_PKG_VERSION"))),
        ("created", format!("{now} s after 1970-01-01 00:00 UTC")),
    ];
    Ok(LibraryPlan {
        drive_units: surface.actuators.iter().map(|a| unit(&a.kind).to_owned()).collect(),
        surface: Some(surface.clone()),
        provenance: about.into_iter().map(|(key, text)| (key.to_owned(), text)).collect(),
        ..LibraryPlan::new(modal.ports.clone(), points, conditions, samples)
    })
}

/// Computes and stores the points that are not there yet.
fn fill(library: &mut Library, modal: &ModalResponses) -> Result<(), CliError> {
    let missing = library.in_state(PointState::Missing);
    let style = ProgressStyle::with_template("{msg} {bar:40} {pos}/{len}, {eta} left");
    let bar = ProgressBar::new(missing.len() as u64).with_message("points");
    bar.set_style(style.map_err(CliError::work)?);
    let (samples, ports) = (library.plan().samples, modal.ports.len());
    let quality = vec![Quality::UNKNOWN; ports];
    for batch in missing.chunks(BATCH) {
        let places: Vec<_> = batch.iter().map(|point| library.points()[*point]).collect();
        let sampled = sample(modal, &places, samples);
        let values: Vec<Vec<f32>> = (0..batch.len())
            .map(|point| (0..ports).flat_map(|port| sampled.response(port, point)).copied().collect())
            .collect();
        let pairs = batch.iter().zip(&values);
        let takes: Vec<Take<'_>> = pairs
            .map(|(point, samples)| Take {
                point: *point,
                samples,
                quality: &quality,
                bands: &[],
                state: PointState::Measured,
            })
            .collect();
        library.put_all(&takes)?;
        bar.inc(batch.len() as u64);
    }
    bar.finish_and_clear();
    Ok(())
}
