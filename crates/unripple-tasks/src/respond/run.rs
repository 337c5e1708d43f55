//! Computes the responses of a surface at the points of a grid, and stores them in a library.

use super::{Ask, Report};
use crate::numbers::above_zero;
use crate::{Progress, Record, TaskError, filling, go_on, grid, judge, record};
use unripple::act::{self, carries, unit};
use unripple::core::{ModalResponses, Responses, Surface, window_samples};
use unripple::physics::{SAMPLING_ERROR, left_out, response_error, sample};
use unripple_calibrate::measure::MOST_KEPT;
use unripple_store::{Library, LibraryPlan};

/// Largest product of the number of samples of a response and the number of modes: tables of that size take
/// up to 6 GiB. With twice this value, it takes twice the memory.
pub const MOST_VALUES: usize = 1 << 29;

/// Computes the responses of a surface at the points of a grid, and stores them in a library. A cancelled run can be continued.
///
/// # Errors
/// Those of [`SurfaceAsk::load`](crate::SurfaceAsk::load); [`TaskError::Ask`] of a pitch or length that makes no sense;
/// [`TaskError::Work`] where modes cannot be had or files not be written; [`TaskError::Cancelled`].
///
/// ```
/// use unripple_tasks::{Silent, respond};
///
/// let folder = std::env::temp_dir().join(format!("unripple-respond-{}", std::process::id()));
/// let ask = respond::Ask { pitch_m: 0.05, length_s: Some(0.01), output: folder.clone(), ..respond::Ask::default() };
/// assert_eq!(respond::run(&ask, &mut Silent)?.points, 4);
/// # std::fs::remove_dir_all(folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let surface = ask.surface.load()?;
    let record = Record::of(ask)?;
    above_zero(ask.pitch_m, "pitch_m", "m")?;
    if let Some(length) = ask.length_s {
        above_zero(length, "length_s", "s")?;
        if length > MOST_KEPT {
            return Err(TaskError::ask("length_s", format!("at most {MOST_KEPT} s"), format!("{length} s")));
        }
    }
    Library::may_be_at(&ask.output)?;
    go_on(progress)?;
    progress.stage("modes");
    let Responses::Modal(modal) = judge::model(&surface, None, &[])? else {
        return Err(TaskError::Work("expected a model with modes, found samples".into()));
    };
    go_on(progress)?;
    if ask.length_s.is_none() {
        progress.stage("length");
    }
    let plan = plan(ask, &surface, &modal)?;
    go_on(progress)?;
    let mut library = Library::create(&ask.output, &plan)?;
    record.log(&mut library)?;
    let before = library.done().len();
    let samples = plan.samples;
    let length = samples as f64 / plan.conditions.rate;
    let response_error = response_error(&modal, length).map(|error| error + SAMPLING_ERROR);
    let left_out = left_out(&surface, &modal, length);
    filling::fill(&mut library, &[], progress, &mut |places| Ok(sample(&modal, places, samples)))?;
    Ok(Report {
        program: "unripple",
        version: env!("CARGO_PKG_VERSION"),
        command: "respond",
        surface: surface.name,
        library: ask.output.display().to_string(),
        points: plan.points.len(),
        points_found_done: before,
        pitch_m: ask.pitch_m,
        actuators: plan.ports.len(),
        samples: plan.samples,
        sample_rate_hz: plan.conditions.rate,
        lambda_min_m: plan.conditions.lambda_min,
        response_error,
        left_out,
    })
}

fn plan(ask: &Ask, surface: &Surface, modal: &ModalResponses) -> Result<LibraryPlan, TaskError> {
    let recommended = || act::windows(surface, &Responses::Modal(modal.clone())).recommended().seconds;
    let length = ask.length_s.unwrap_or_else(|| 2.0 * recommended());
    carries(&modal.conditions, length).map_err(|error| TaskError::Work(format!("`length_s`: {error}")))?;
    let points = grid::points(&surface.outline, ask.pitch_m)?;
    let conditions = modal.conditions.clone();
    let samples = window_samples(length, conditions.rate) + 1;
    let most = MOST_VALUES / modal.poles.len().max(1);
    if samples > most {
        let longest = most as f64 / conditions.rate;
        let expected = format!("at most {longest:.3} s, for {} modes", modal.poles.len());
        return Err(TaskError::ask("length_s", expected, format!("{length} s")));
    }
    let about = [
        ("device", "model".to_owned()),
        ("stimulus", "impulse".to_owned()),
        ("modes", modal.poles.len().to_string()),
        ("software", format!("unripple {}", env!("CARGO_PKG_VERSION"))),
        ("created", record::now()),
    ];
    Ok(LibraryPlan {
        drive_units: surface.actuators.iter().map(|a| unit(&a.kind).to_owned()).collect(),
        surface: Some(surface.clone()),
        provenance: about.into_iter().map(|(key, text)| (key.to_owned(), text)).collect(),
        ..LibraryPlan::new(modal.ports.clone(), points, conditions, samples)
    })
}
