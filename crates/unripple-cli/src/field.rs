//! `unripple field`: what any drive does to a surface.

use crate::args::FieldOptions;
use crate::error::CliError;
use crate::figures::{self, Scene};
use crate::fingers;
use crate::focus::finish;
use crate::judge::{self, CELLS, Judged};
use crate::reads::Reads;
use crate::targets::{numbers, place, seconds};
use crate::{input, output};
use unripple::act::{self, Report};
use unripple::core::{Drive, Point, Surface};
use unripple::field::{Aim, Field};
use unripple_store::{OutputDir, read_wav};

pub fn run(options: &FieldOptions, as_json: bool) -> Result<(), CliError> {
    let source = input::source(&options.surface)?;
    source.allows(&[("--finger", !options.finger.is_empty()), ("--judge-hz", options.judge_hz.is_some())])?;
    let names: Vec<String> = source.surface.actuators.iter().map(|a| a.name.clone()).collect();
    let drive = read_wav(&options.drive)?.into_drive(&names, &options.drive.display().to_string())?;
    let out = options.output.as_ref();
    let out = out.map(|place| OutputDir::create_beside(place, &options.reads())).transpose()?;
    let contacts = fingers::contacts(&options.finger, &source.surface)?;
    let places = options.at.iter().map(|text| place(text, "--at")).collect::<Result<Vec<_>, _>>()?;
    let unscaled = source.without_scale().is_some();
    let (surface, responses, stored) = match source.stored {
        Some(_) => source.respond(&places, options.between.interpolation())?,
        None => {
            let responses = judge::model(&source.surface, options.judge_hz, &contacts)?;
            (source.surface, responses, None)
        }
    };
    let period = seconds(options.period_ms, "--period-ms")?;
    let field = Field::new(&responses, &drive, CELLS).map_err(CliError::input)?;
    let aims = aims(options, places, &field, &drive, period)?;
    let last = aims.iter().map(|aim| aim.instant).fold(0.0, f64::max);
    let until = if period.is_some() { drive.duration() - 1.0 / drive.rate() } else { 2.0 * last };
    let judged = judge::judge(&surface, &field, &aims, period, until)?;

    let mut report = Report::new("field", &surface, &drive, &judged);
    report.period_s = period;
    if let Some((told, notes)) = stored {
        report.notes.extend(notes);
        report.judged_on = Some(told);
    }
    if !contacts.is_empty() {
        let without = judge::model(&surface, options.judge_hz, &[])?;
        report.fingers = act::felt(&contacts, &surface, [&responses, &without], &drive, until)?;
    }
    if unscaled {
        report = report.without_scale();
    }
    if let Some(out) = out {
        let shown =
            Shown { options, surface: &surface, drive: &drive, aims: &aims, judged: &judged, unscaled };
        shown.write(&out, &mut report, &field)?;
        finish(out)?;
    }
    output::answer(as_json, &report, &report.text())
}

/// Where and when to measure: as asked, or at the strongest place and at each place's own peak.
fn aims(
    options: &FieldOptions,
    mut points: Vec<Point>,
    field: &Field,
    drive: &Drive,
    period: Option<f64>,
) -> Result<Vec<Aim>, CliError> {
    if points.is_empty() {
        points.push(strongest(field, drive, period)?);
    }
    let instants = match (options.at_ms.as_slice(), points.len()) {
        ([], _) => own_peaks(field, drive, period, &points)?,
        ([one], n) => vec![one / 1e3; n],
        (many, n) if many.len() == n => many.iter().map(|ms| ms / 1e3).collect(),
        (many, n) => {
            let text = format!("--at-ms: expected one, or one per --at ({n}), found {}", many.len());
            return Err(CliError::Input(text));
        }
    };
    Ok(points.into_iter().zip(instants).map(|(point, instant)| Aim::at(point, instant)).collect())
}

/// The place whose velocity is largest while the drive lasts.
fn strongest(field: &Field, drive: &Drive, period: Option<f64>) -> Result<Point, CliError> {
    let last =
        Aim::at(field.points().first().copied().unwrap_or_default(), drive.duration() - 1.0 / drive.rate());
    let maps = field.measure(&[last], period).map_err(CliError::input)?.maps;
    let peaks = maps.peak_velocity.iter().zip(&maps.points);
    let best = peaks.max_by(|a, b| a.0.total_cmp(b.0)).map(|(_, point)| *point);
    best.ok_or_else(|| CliError::Input("the surface has no point to measure at".into()))
}

/// When the velocity of each place is largest while the drive lasts, or in its last full period.
fn own_peaks(
    field: &Field,
    drive: &Drive,
    period: Option<f64>,
    points: &[Point],
) -> Result<Vec<f64>, CliError> {
    let end = drive.duration() - 1.0 / drive.rate();
    let first =
        period.map_or(0, |period| ((drive.duration() - period).max(0.0) * drive.rate()).round() as usize);
    let traces = field.traces(points, end).map_err(CliError::input)?;
    let largest = |values: &[f64]| {
        let tail = values.iter().enumerate().skip(first);
        tail.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).map_or(0, |(i, _)| i)
    };
    Ok(traces.iter().map(|trace| largest(&trace.velocity) as f64 / drive.rate()).collect())
}

/// Everything that goes into an output folder.
struct Shown<'a> {
    options: &'a FieldOptions,
    surface: &'a Surface,
    drive: &'a Drive,
    aims: &'a [Aim],
    judged: &'a Judged,
    /// Whether nobody knows how many m/s and µm it is, in which figures are drawn.
    unscaled: bool,
}

impl Shown<'_> {
    fn write(&self, out: &OutputDir, report: &mut Report, field: &Field) -> Result<(), CliError> {
        let measured = &self.judged.measured;
        let points: Vec<Vec<Point>> = self.aims.iter().map(|aim| aim.points.clone()).collect();
        let scene = Scene::new(self.surface, &points, measured.focal_radius_m);
        let mut figures = Vec::new();
        if !self.unscaled {
            let rate = self.drive.rate();
            figures.push(("traces", figures::traces(&measured.targets, &self.judged.traces, rate)));
            figures.extend(figures::snapshots(&scene, measured).map(|figure| ("snapshot", figure)));
            figures.extend(figures::peaks(&scene, measured).map(|figure| ("peaks", figure)));
            figures.extend(figures::felt(&scene, measured).map(|figure| ("felt", figure)));
        }
        report.files = figures::write(out, &figures)?;
        if self.options.frames > 0
            && let Some(movie) = figures::movie(field, &scene, self.span()?, self.options.frames)?
        {
            out.write("animation.png", &movie)?;
            report.files.push("animation.png".into());
        }
        out.write("report.json", output::json(report)?.as_bytes())?;
        out.write("report.md", report.markdown().as_bytes())?;
        Ok(())
    }

    /// Start and end of the animation, in seconds.
    fn span(&self) -> Result<[f64; 2], CliError> {
        let instant = self.aims.first().map_or(0.0, |aim| aim.instant);
        let Some(text) = &self.options.movie_ms else {
            return Ok([(instant - 6e-3).max(0.0), instant + 3e-3]);
        };
        let values = numbers(text, "--movie-ms", "FROM,TO in ms", 2, 2)?;
        if !(values[0] >= 0.0 && values[1] > values[0]) {
            return Err(CliError::Input(format!(
                "--movie-ms {text}: expected 0 <= FROM < TO, found otherwise"
            )));
        }
        Ok([values[0] / 1e3, values[1] / 1e3])
    }
}
