//! `unripple focus` with waveforms or a stroke: the drive, and what it was measured to do.

use crate::args::FocusOptions;
use crate::error::CliError;
use crate::figures::{self, Scene};
use crate::focus::finish;
use crate::judge::{self, Judged};
use crate::reads::Reads;
use crate::targets::{carries, seconds};
use crate::{input, output, waveforms};
use unripple::act::{DecidedBy, Followed, Report, Strength, Stroked, unit};
use unripple::core::{ActuatorKind, Drive, Point, Responses, Surface};
use unripple::field::{Aim, Field, SilenceFigures, Wanted};
use unripple::focus::{Options, PlayOptions, PulseOptions, Stroke, play, strike};
use unripple_store::{OutputDir, write_wav};

/// Waveforms are planned and judged on modes up to these multiples of the band, the second if not told otherwise: at low
/// frequencies a sheet yields by modes far above.
const WAVEFORMS: [f64; 2] = [2.0, 3.0];

/// Strokes likewise: pulses are all band.
const STROKES: [f64; 2] = [1.0, 2.0];

/// Cells of the grid per shortest wavelength, where the whole of a long drive is measured.
const CELLS: f64 = 3.0;

/// Places of a stroke measured at once.
const AT_ONCE: usize = 256;

/// Places measured for each pulse of a stroke.
const BETWEEN: usize = 2;

/// A drive nearer to its limit than this was held by it: float32 rounds by less.
const HELD: f64 = 1e-6;

/// A drive, what is known of it, and how it was judged.
struct Work {
    drive: Drive,
    aims: Vec<Aim>,
    method: &'static str,
    waveforms: Vec<Followed>,
    silent: Vec<SilenceFigures>,
    stroke: Option<Stroked>,
}

pub fn run(options: &FocusOptions, as_json: bool) -> Result<(), CliError> {
    let source = input::source(&options.surface)?;
    source.allows(&[("--waveform and --path", true)])?;
    let surface = source.surface;
    let plant = options.on.as_deref().map(input::surface).transpose()?;
    let plant = plant.as_ref().unwrap_or(&surface);
    let out = OutputDir::create_beside(&options.output, &options.reads())?;
    let stroke = waveforms::stroke(&options.targets)?;
    let [planned, judged] = if stroke.is_some() { STROKES } else { WAVEFORMS };
    let model = judge::model(&surface, Some(planned * surface.emission.band[1]), &[])?;
    let judge_hz = options.judge_hz.unwrap_or(judged * plant.emission.band[1]);
    let judging = judge::model(plant, Some(judge_hz), &[])?;
    let work = match stroke {
        Some(stroke) => stroked(options, &surface, &stroke, [&model, &judging])?,
        None => followed(options, &surface, [&model, &judging])?,
    };
    carries(model.conditions(), work.drive.duration(), "--window-ms")?;
    let field = Field::new(&judging, &work.drive, CELLS).map_err(CliError::input)?;
    let until = work.drive.duration() - 1.0 / work.drive.rate();
    let judged = judge::judge(plant, &field, &work.aims, Some(work.drive.duration()), until)?;
    let mut report = Report::new("focus", &surface, &work.drive, &judged);
    report.method = Some(work.method);
    let emission = &surface.emission;
    let limits = Options { limit: emission.limit, rms_limit: emission.rms_limit, ..Options::default() };
    let asked = Strength::of(&work.drive, &limits, DecidedBy::Asked);
    let by = if asked.below_limit > 1.0 + HELD { DecidedBy::Asked } else { DecidedBy::Limit };
    report.level = Some(Strength { decided_by: by, ..asked });
    report.judged_on = Some(format!("{}, modes to {judge_hz} Hz", plant.name));
    report.waveforms = work.waveforms;
    report.silent = work.silent;
    report.stroke = work.stroke;
    write(&out, &mut report, plant, &work.drive, &judged)?;
    finish(out)?;
    output::answer(as_json, &report, &report.text())
}

fn followed(
    options: &FocusOptions,
    surface: &Surface,
    [model, judging]: [&Responses; 2],
) -> Result<Work, CliError> {
    let emission = &surface.emission;
    let waves = waveforms::waveforms(&options.targets, emission.rate)?;
    let silent = waveforms::silent(&options.targets)?;
    let window = seconds(options.window_ms, "--window-ms")?;
    let defaults = PlayOptions::default();
    let settings = PlayOptions {
        lead: window.map_or(defaults.lead, |window| [window; 2]),
        limit: emission.limit,
        rms_limit: emission.rms_limit,
        ..defaults
    };
    let played = play(model, &waves, &silent, &settings).map_err(CliError::input)?;
    let drive = played.drive.as_emitted();
    let rate = drive.rate();
    let targets = played.points.iter().zip(&played.asked);
    let wanted: Vec<Wanted> =
        targets.map(|(points, asked)| Wanted { points: points.clone(), samples: asked.clone() }).collect();
    let field = Field::new(judging, &drive, 1.0).map_err(CliError::input)?;
    let until = 2.0 * drive.duration();
    let (figures, silent) =
        field.followed(&wanted, &silent, until, |t| &t.displacement).map_err(CliError::input)?;
    drop(field);
    let largest = |asked: &[f64]| {
        let by_size = asked.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        by_size.map_or((0, 0.0), |(i, x)| (i, x.abs()))
    };
    let aims =
        wanted.iter().map(|w| Aim { points: w.points.clone(), instant: largest(&w.samples).0 as f64 / rate });
    let aims = aims.collect();
    let told = figures.into_iter().enumerate().map(|(i, figures)| Followed {
        figures,
        start_s: played.starts[i] as f64 / rate,
        asked_peak_m: largest(&wanted[i].samples).1,
        lost: played.lost[i],
    });
    let waveforms = told.collect();
    Ok(Work { drive, aims, method: "waveforms", waveforms, silent, stroke: None })
}

fn stroked(
    options: &FocusOptions,
    surface: &Surface,
    stroke: &Stroke,
    [model, judging]: [&Responses; 2],
) -> Result<Work, CliError> {
    let defaults = PulseOptions::default();
    let settings = PulseOptions {
        window: seconds(options.window_ms, "--window-ms")?.unwrap_or(defaults.window),
        limit: surface.emission.limit,
        rms_limit: surface.emission.rms_limit,
        ..defaults
    };
    carries(model.conditions(), settings.window, "--window-ms")?;
    let pulses = stroke.pulses(model).map_err(CliError::input)?;
    let struck = strike(model, &pulses, &settings).map_err(CliError::input)?;
    let drive = struck.drive.as_emitted();
    let asked = stroke.level * struck.scale;
    let [level, peak] =
        evenness(stroke, &struck.instants, &drive, judging)?.map(|range| range.map(|v| decibels(v / asked)));
    let start = struck.instants[0] as f64 / drive.rate();
    let stroked = Stroked {
        pulses: pulses.len(),
        duration_s: stroke.duration(),
        start_s: start,
        asked_m_s: asked,
        level_range_db: level,
        peak_range_db: peak,
    };
    let middle = pulses.len() / 2;
    let instant = struck.instants[middle] as f64 / drive.rate();
    let aims = vec![Aim { points: struck.points[middle].clone(), instant }];
    Ok(Work {
        drive,
        aims,
        method: "stroke",
        waveforms: Vec::new(),
        silent: Vec::new(),
        stroke: Some(stroked),
    })
}

/// Least and greatest velocity along a path: at the pulse nearest to each place's own instant, and at most within half an
/// interval of it; in m/s.
fn evenness(
    stroke: &Stroke,
    instants: &[usize],
    drive: &Drive,
    responses: &Responses,
) -> Result<[[f64; 2]; 2], CliError> {
    let field = Field::new(responses, drive, 1.0).map_err(CliError::input)?;
    let steps = BETWEEN * instants.len().saturating_sub(1).max(1);
    let (first, last) = (instants[0], instants[instants.len() - 1]);
    let sample = |i: usize| first + (last - first) * i / steps;
    let place = |i: usize| stroke.place((sample(i) - first) as f64 / drive.rate());
    let half = (last - first).div_ceil(2 * instants.len().saturating_sub(1).max(1));
    let mut found = [[f64::INFINITY, 0.0]; 2];
    for batch in (0..=steps).collect::<Vec<_>>().chunks(AT_ONCE) {
        let places: Vec<Point> = batch.iter().map(|i| place(*i)).collect();
        let until = drive.duration() - 1.0 / drive.rate();
        let traces = field.traces(&places, until).map_err(CliError::input)?;
        for (i, trace) in batch.iter().zip(traces) {
            let v = |i: usize| trace.velocity[i].abs();
            let pulse = instants[(i + BETWEEN / 2).min(steps) / BETWEEN];
            let near = sample(*i).saturating_sub(half)..(sample(*i) + half + 1).min(trace.velocity.len());
            for ([least, most], level) in found.iter_mut().zip([v(pulse), near.map(v).fold(0.0, f64::max)]) {
                (*least, *most) = (least.min(level), most.max(level));
            }
        }
    }
    Ok(found)
}

fn decibels(ratio: f64) -> f64 {
    20.0 * ratio.max(1e-20).log10()
}

fn write(
    out: &OutputDir,
    report: &mut Report,
    surface: &Surface,
    drive: &Drive,
    judged: &Judged,
) -> Result<(), CliError> {
    let measured = &judged.measured;
    let points: Vec<Vec<Point>> =
        measured.targets.iter().map(|t| vec![Point::new(t.at_m[0], t.at_m[1])]).collect();
    let scene = Scene::new(surface, &points, measured.focal_radius_m);
    let unit = unit(&surface.actuators.first().map_or(ActuatorKind::Force, |a| a.kind));
    let mut figures = vec![
        ("traces", figures::traces(&measured.targets, &judged.traces, drive.rate())),
        ("drive", figures::channels(drive, unit)),
    ];
    figures.extend(figures::peaks(&scene, measured).map(|figure| ("peaks", figure)));
    write_wav(out.path().join("drive.wav"), drive)?;
    report.files = vec!["drive.wav".into()];
    report.files.extend(figures::write(out, &figures)?);
    out.write("report.json", output::json(report)?.as_bytes())?;
    out.write("report.md", report.markdown().as_bytes())?;
    Ok(())
}
