//! Plans sensors or taps, and says what a fit to what they measure would know.

use super::planned::{Certificate, Number, Unknown, deviations, even, worst, worst_pair};
use super::setting::{Setting, refused};
use super::{Ask, Report, SensingAsk, figure};
use crate::figures::Columns;
use crate::{Progress, TaskError, figures, folder, go_on};
use unripple::act::Note;
use unripple::core::Point;
use unripple_calibrate::Parameter;
use unripple_placement::{Approximate, Picked, Picking, PlacementError, spread};

/// Random choices that the planned one is compared with.
const RANDOM: usize = 20;

/// Beginnings of the search between two questions whether to go on.
const AT_ONCE: usize = 8;

/// Deviation relative to the prior from which on an unknown counts as hardly told.
const HARDLY: f64 = 0.9;

/// Finds the places of sensors, or of taps, that tell a fit most about a surface, with a certificate of how good they are, and writes a report
/// to a folder if the request names one.
///
/// ```
/// use unripple_tasks::{Silent, SurfaceAsk, sensors};
///
/// // Three places on the paper's film, in a tenth of its band.
/// let surface = SurfaceAsk::Set {
///     name: "hudin-2012".into(),
///     set: [("drive.band_hz".to_owned(), "[0, 400]".to_owned())].into(),
/// };
/// let ask = sensors::Ask { surface, count: 3, profile: 0, pitch_m: Some(0.02), ..sensors::Ask::default() };
/// let report = sensors::run(&ask, &mut Silent)?;
/// let certificate = report.certificate;
/// assert!(certificate.certified && certificate.random.is_some_and(|random| random < certificate.efficiency));
/// let tension = &report.unknowns[0];
/// assert!(tension.name == "tension" && tension.planned < tension.prior);
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// [`TaskError::Ask`] of options that make no sense; those of reading the surface, of its model and of writing the folder;
/// [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let columns = Columns::of(ask.columns)?;
    let out = folder::begin(ask.output.as_deref(), ask)?;
    let setting = Setting::of(ask, progress)?;
    let (mut report, best) = found(ask, &setting, progress)?;
    if let Some((out, record)) = out {
        if !ask.no_figures {
            progress.stage("figures");
            report.files = figures::write(&out, &columns.fit(figure::all(&report, &setting, &best)))?;
        }
        record.write(&out, &report)?;
        out.write("report.md", report.markdown().as_bytes())?;
        folder::finish(out, progress)?;
    }
    Ok(report)
}

/// The search, and the best shares of as many measurements.
fn found(
    ask: &Ask,
    setting: &Setting,
    progress: &mut dyn Progress,
) -> Result<(Report, Approximate), TaskError> {
    let picking = setting.picking(ask);
    let (each, starts) = searched(ask, &picking, progress)?;
    let bounds = bounds(setting, each.len(), progress)?;
    let bound = &bounds[ask.count - 1];
    let planned =
        starts.iter().fold(&starts[0], |best, found| if found.log_det > best.log_det { found } else { best });
    go_on(progress)?;
    progress.stage("comparison");
    let efficiency = |log_det: f64| bound.efficiency(&setting.informations, log_det);
    let others = Others::of(ask, setting, &picking);
    let of_places = |places: &[usize]| efficiency(setting.informations.log_det(places));
    let certificate = Certificate {
        random: mean(&others.random.iter().map(|places| of_places(places)).collect::<Vec<_>>()),
        even: others.even.as_deref().map(of_places),
        ..Certificate::of(setting, bound, ask.count, planned.log_det)
    };
    let covariance = setting.informations.covariance(&planned.places).ok_or_else(nothing)?;
    let unknowns = unknowns(setting, &planned.places, &others)?;
    let report = Report {
        program: "unripple",
        version: env!("CARGO_PKG_VERSION"),
        command: "sensors",
        surface: setting.surface.name.clone(),
        count: ask.count,
        sensing: ask.sensing,
        kept_m: setting.kept.iter().map(|at| [at.x, at.y]).collect(),
        places: setting.places.len(),
        pitch_m: setting.pitch,
        band_hz: ends(&setting.found.frequencies_hz),
        lines: setting.found.frequencies_hz.len(),
        snr_db: ask.snr_db,
        at_m: in_order(setting, planned),
        untold: setting.found.untold.clone(),
        worst_pair: worst_pair(&covariance, &setting.found.unknowns),
        reached: starts.iter().map(|found| efficiency(found.log_det)).collect(),
        certificate,
        each_number: numbers(setting, &each, &bounds)?,
        notes: notes(ask, &unknowns),
        unknowns,
        files: Vec::new(),
    };
    Ok((report, bounds[ask.count - 1].clone()))
}

/// Choices of every number of places, and those of the requested number from each beginning, the greedy one first.
fn searched(
    ask: &Ask,
    picking: &Picking<'_>,
    progress: &mut dyn Progress,
) -> Result<(Vec<Picked>, Vec<Picked>), TaskError> {
    go_on(progress)?;
    progress.stage("each number of places");
    let up_to = ask.up_to.unwrap_or(2 * ask.count).max(ask.count).min(picking.at.len());
    let each = match picking.each_number(up_to) {
        // Distances may leave fewer places than there are.
        Err(PlacementError::Few { found, .. }) if found >= ask.count => picking.each_number(found),
        Err(PlacementError::Few { found, .. }) => Err(PlacementError::Few { expected: ask.count, found }),
        other => other,
    };
    let each = each.map_err(refused)?;
    progress.stage("search");
    let mut starts = vec![each[ask.count - 1].clone()];
    for first in (0..ask.restarts).step_by(AT_ONCE) {
        go_on(progress)?;
        let some = AT_ONCE.min(ask.restarts - first);
        // Where distances leave room for hardly any choice, random ones may not be found; the greedy one was.
        let seed = ask.seed.wrapping_add(first as u64);
        starts.extend(picking.restarts(ask.count, some, seed).unwrap_or_default());
        progress.done((first + some) as f64 / ask.restarts as f64);
    }
    Ok((each, starts))
}

/// The best shares of every number of measurements, each begun with those of one less.
fn bounds(
    setting: &Setting,
    most: usize,
    progress: &mut dyn Progress,
) -> Result<Vec<Approximate>, TaskError> {
    progress.stage("certificates");
    let mut all: Vec<Approximate> = Vec::with_capacity(most);
    for count in 1..=most {
        go_on(progress)?;
        let from = all.last().map(|before| before.weights.as_slice());
        all.push(setting.informations.approximate(count, from).map_err(refused)?);
        progress.done(count as f64 / most as f64);
    }
    Ok(all)
}

/// Choices that the planned one is compared with.
struct Others {
    random: Vec<Vec<usize>>,
    even: Option<Vec<usize>>,
}

impl Others {
    fn of(ask: &Ask, setting: &Setting, picking: &Picking<'_>) -> Self {
        let points: Vec<Point> = spread(&setting.surface.outline, &setting.rules, 0, ask.count);
        let whole = points.len() == ask.count;
        let nearest = || even(setting, &points, |chosen, b| picking.is_free(chosen, b));
        Self {
            // Distances may be such that only a search finds room.
            random: picking.random(ask.count, RANDOM, ask.seed ^ 0x5eed).unwrap_or_default(),
            even: whole.then(nearest).flatten(),
        }
    }
}

/// What a fit would know of each unknown.
fn unknowns(setting: &Setting, planned: &[usize], others: &Others) -> Result<Vec<Unknown>, TaskError> {
    let of = |places: &[usize]| {
        let covariance = setting.informations.covariance(places).ok_or_else(nothing)?;
        Ok::<_, TaskError>(deviations(&covariance))
    };
    let planned = of(planned)?;
    let random = others.random.iter().map(|places| of(places)).collect::<Result<Vec<_>, _>>()?;
    let even = others.even.as_deref().map(of).transpose()?;
    let one = |(u, unknown): (usize, &Parameter)| Unknown {
        name: unknown.name.clone(),
        unit: unknown.unit,
        prior: unknown.prior,
        planned: unknown.prior * planned[u],
        random: mean(&random.iter().map(|of| unknown.prior * of[u]).collect::<Vec<_>>()),
        even: even.as_ref().map(|of| unknown.prior * of[u]),
    };
    Ok(setting.found.unknowns.iter().enumerate().map(one).collect())
}

fn numbers(setting: &Setting, each: &[Picked], bounds: &[Approximate]) -> Result<Vec<Number>, TaskError> {
    let one = |(found, bound): (&Picked, &Approximate)| -> Result<Number, TaskError> {
        let covariance = setting.informations.covariance(&found.places).ok_or_else(nothing)?;
        let (worst, worst_deviation) = worst(&deviations(&covariance), &setting.found.unknowns);
        let unknowns = setting.found.unknowns.len() as f64;
        Ok(Number {
            places: found.places.len(),
            efficiency: bound.efficiency(&setting.informations, found.log_det),
            mean_deviation: (-0.5 * found.log_det / unknowns).exp(),
            worst_deviation,
            worst,
        })
    };
    each.iter().zip(bounds).map(one).collect()
}

/// The planned places, each the one that adds most to those before.
fn in_order(setting: &Setting, planned: &Picked) -> Vec<[f64; 2]> {
    let mut left = planned.places.clone();
    let mut chosen: Vec<usize> = Vec::with_capacity(left.len());
    while !left.is_empty() {
        let with = |place: usize| {
            setting.informations.log_det(&chosen.iter().copied().chain([place]).collect::<Vec<_>>())
        };
        let reached: Vec<f64> = left.iter().map(|place| with(*place)).collect();
        let best = (0..left.len()).reduce(|best, i| if reached[i] > reached[best] { i } else { best });
        chosen.push(left.remove(best.unwrap_or(0)));
    }
    chosen.iter().map(|place| [setting.places[*place].x, setting.places[*place].y]).collect()
}

/// What is assumed, and what is hardly told.
fn notes(ask: &Ask, unknowns: &[Unknown]) -> Vec<Note> {
    let mut notes = Vec::new();
    let hardly: Vec<&str> = unknowns
        .iter()
        .filter(|unknown| unknown.planned > HARDLY * unknown.prior)
        .map(|unknown| unknown.name.as_str())
        .collect();
    if !hardly.is_empty() {
        let text = format!(
            "measurements at these places hardly tell of: {} (the deviation stays above {HARDLY} of that of the prior)",
            hardly.join(", ")
        );
        notes.push(Note { topic: "unknowns", text });
    }
    if ask.sensing == SensingAsk::Taps {
        let text = "taps are taken to push equally strongly at all frequencies of the band";
        notes.push(Note { topic: "taps", text: text.into() });
    }
    notes
}

fn ends(frequencies: &[f64]) -> [f64; 2] {
    [frequencies.first(), frequencies.last()].map(|hz| hz.copied().unwrap_or(0.0))
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The error where rounding leaves a covariance that is none.
fn nothing() -> TaskError {
    TaskError::work("covariance of the unknowns: expected a positive definite matrix, found one that is not")
}
