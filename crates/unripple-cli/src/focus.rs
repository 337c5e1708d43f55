//! `unripple focus`: a drive, its report and its figures.

use crate::args::{FocusOptions, LossName, MethodName};
use crate::aware::Aware;
use crate::error::CliError;
use crate::figures::{self, Scene};
use crate::fingers::{self, Felt};
use crate::judge::{self, CELLS, Judged, Note};
use crate::level::felt_gain;
use crate::report::{self, Report};
use crate::targets::{self, positive, seconds};
use crate::{input, output, played, waveforms};
use unripple::core::{ActuatorKind, Contact, Decay, Drive, Point, Responses, Surface};
use unripple::field::{Aim, Field};
use unripple::focus::{Focused, LossCorrection, Options, Target};
use unripple::physics::Medium;
use unripple::physics::design::recommended_window;
use unripple_store::{OutputDir, write_wav};

pub fn run(options: &FocusOptions, as_json: bool) -> Result<(), CliError> {
    waveforms::check(options)?;
    if !options.targets.waveform.is_empty() || options.targets.path.is_some() {
        return played::run(options, as_json);
    }
    let source = input::source(&options.surface)?;
    source.allows(&needing_modes(options))?;
    let plant = options.on.as_deref().map(input::surface).transpose()?;
    let out = OutputDir::create(&options.output)?;
    let known = source.lambda_min();
    let lambda_min = known
        .unwrap_or_else(|| Medium::of(&source.surface.sheet).lambda_min(source.surface.emission.band[1]));
    let targets = targets::all(&options.targets, lambda_min)?;
    let places: Vec<Point> = targets.iter().flat_map(|target| target.points.iter().copied()).collect();
    let (surface, responses, stored) = source.respond(&places, options.between.interpolation())?;
    let settings = settings(options, &surface, &responses)?;
    let aware = Aware::of(options, &surface)?;
    let focused = aware.focus(&responses, &targets, &settings)?;

    let judged_surface = plant.as_ref().unwrap_or(&surface);
    let other = plant.is_some() || options.judge_hz.is_some();
    let free = other.then(|| judge::model(judged_surface, options.judge_hz, &[])).transpose()?;
    let free = free.as_ref().unwrap_or(&responses);
    let contacts = fingers::contacts(&options.finger, judged_surface)?;
    let touched = !contacts.is_empty();
    let under = touched.then(|| judge::model(judged_surface, options.judge_hz, &contacts)).transpose()?;
    let judging = under.as_ref().unwrap_or(free);
    let (judged, drive) = levelled(options, &focused, &targets, judged_surface, judging)?;
    let felt = felt(&contacts, judged_surface, [judging, free], &drive, &judged)?;

    let mut report = Report::new("focus", &surface, &drive, &judged);
    report.fingers = felt;
    report.notes.extend(aware.note(&responses, &targets, &settings, &focused)?);
    report.judged_on = other.then(|| judged_on(judged_surface, options.judge_hz));
    if let Some((told, notes)) = stored {
        report.notes.extend(notes.into_iter().chain(nearby(&focused, &targets)));
        report.judged_on.get_or_insert(told);
    }
    report.method = Some(focused.method.name());
    report.window_s = Some(settings.window);
    report.period_s = focused.period.map(|samples| samples as f64 / drive.rate());
    write(&out, &mut report, judged_surface, &drive, &judged, &focused)?;
    finish(out)?;
    output::answer(as_json, &report, &report.text())
}

/// Options that a library cannot serve, and whether they were given.
fn needing_modes(options: &FocusOptions) -> [(&'static str, bool); 7] {
    let on_surface = options.on.is_some();
    [
        ("--finger-aware", options.finger_aware),
        ("--bear-tension-percent", options.bear_tension_percent.is_some()),
        ("--bear-finger", !options.bear_finger.is_empty()),
        ("--judge-hz without --on", options.judge_hz.is_some() && !on_surface),
        ("--finger without --on", !options.finger.is_empty() && !on_surface),
        ("--method robust", options.method == MethodName::Robust),
        ("--method felt", options.method == MethodName::Felt),
    ]
}

/// Where stored points stand for the places asked for.
fn nearby(focused: &Focused, targets: &[Target]) -> Vec<Note> {
    let places = targets.iter().zip(&focused.points).filter_map(|(target, used)| {
        let (asked, stored) = (*target.points.first()?, *used.first()?);
        let apart = asked.distance(stored);
        (apart > 1e-9).then(|| Note {
            topic: "library",
            text: format!(
                "{stored} stands for {asked}, {:.2} mm away: the nearest finished point",
                apart * 1e3
            ),
        })
    });
    places.collect()
}

/// What every finger feels of a drive, from the responses under the fingers and without them.
fn felt(
    contacts: &[Contact],
    surface: &Surface,
    [under, without]: [&Responses; 2],
    drive: &Drive,
    judged: &Judged,
) -> Result<Vec<Felt>, CliError> {
    if contacts.is_empty() {
        return Ok(Vec::new());
    }
    let field = |responses| Field::new(responses, drive, 1.0).map_err(CliError::input);
    fingers::felt(contacts, surface, &field(under)?, &field(without)?, judged.until)
}

fn settings(options: &FocusOptions, surface: &Surface, responses: &Responses) -> Result<Options, CliError> {
    let window = seconds(options.window_ms, "--window-ms")?
        .unwrap_or_else(|| recommended_window(surface, responses_count(responses)).min(longest(responses)));
    let loss = match (options.losses, &surface.sheet.decay) {
        (LossName::None, _) => LossCorrection::None,
        (LossName::PerMode, _) => LossCorrection::PerMode,
        (LossName::Uniform, Decay::Time(tau)) => LossCorrection::Uniform(*tau),
        (LossName::Uniform, _) => {
            let text = "--losses uniform: expected a surface with one decay time, found one that varies with frequency \
                        (nearest: --losses per-mode)";
            return Err(CliError::Input(text.into()));
        }
    };
    Ok(Options {
        method: options.method.method(),
        strength: options.strength,
        push: options.push,
        spread: options.spread_percent / 100.0,
        rest: options.rest,
        worst: options.worst.unwrap_or(Options::default().worst),
        economy: options.economy.unwrap_or(Options::default().economy),
        window,
        limit: surface.emission.limit,
        rms_limit: surface.emission.rms_limit,
        total_rms: options.total_rms,
        loss,
        duration: seconds(options.duration_ms, "--duration-ms")?,
        ..Options::default()
    })
}

/// Modes of the band, as counted.
fn responses_count(responses: &Responses) -> Option<usize> {
    match responses {
        Responses::Modal(modal) => Some(modal.poles.len()),
        Responses::Sampled(_) => None,
    }
}

/// The longest window that responses are long enough for, in seconds.
fn longest(responses: &Responses) -> f64 {
    match responses {
        Responses::Modal(_) => f64::INFINITY,
        Responses::Sampled(sampled) => sampled.samples().saturating_sub(1) as f64 / sampled.conditions.rate,
    }
}

/// The drive at the level asked for, as float32 samples, and what it does.
fn levelled(
    options: &FocusOptions,
    focused: &Focused,
    targets: &[Target],
    surface: &Surface,
    responses: &Responses,
) -> Result<(Judged, Drive), CliError> {
    let rate = focused.drive.rate();
    let seconds = |samples: usize| samples as f64 / rate;
    let aims: Vec<Aim> = targets
        .iter()
        .zip(&focused.timing)
        .map(|(target, timing)| Aim { points: target.points.clone(), instant: seconds(timing.instant) })
        .collect();
    let period = focused.period.map(seconds);
    let last = focused.timing.iter().map(|timing| timing.instant).max().unwrap_or(0);
    let until = if period.is_some() { seconds(focused.drive.samples() - 1) } else { 2.0 * seconds(last) };
    let judge = |drive: &Drive| {
        let field = Field::new(responses, drive, CELLS).map_err(CliError::input)?;
        judge::judge(surface, &field, &aims, period, until)
    };
    let drive = focused.drive.clone().as_emitted();
    if let Some(level) = options.targets.felt_db {
        let gain = felt_gain(level, responses, &drive, &aims, period)?;
        let drive = focused.drive.clone().scaled(gain).as_emitted();
        return Ok((judge(&drive)?, drive));
    }
    let Some(um) = options.targets.peak_um else { return Ok((judge(&drive)?, drive)) };

    let wanted = positive(um, "--peak-um", "µm")?;
    let most = largest(responses, &drive, &aims, focused.period, until)? * 1e6;
    if wanted > most {
        return Err(CliError::Input(format!(
            "--peak-um: expected at most {most:.4} µm, which the drive limit gives, found {wanted}"
        )));
    }
    let drive = focused.drive.clone().scaled(wanted / most).as_emitted();
    Ok((judge(&drive)?, drive))
}

/// Largest displacement of the first target's mean over the time measured, in metres.
fn largest(
    responses: &Responses,
    drive: &Drive,
    aims: &[Aim],
    period: Option<usize>,
    until: f64,
) -> Result<f64, CliError> {
    let field = Field::new(responses, drive, 1.0).map_err(CliError::input)?;
    let points = aims.first().map_or(&[][..], |aim| &aim.points);
    let traces = field.traces(points, until.min(judge::known(&field))).map_err(CliError::input)?;
    let first = period.map_or(0, |period| drive.samples().saturating_sub(period));
    let samples = traces.first().map_or(0, |trace| trace.displacement.len());
    let mean = |i: usize| traces.iter().map(|t| t.displacement[i]).sum::<f64>() / traces.len() as f64;
    Ok((first..samples).map(|i| mean(i).abs()).fold(0.0, f64::max))
}

fn judged_on(surface: &Surface, hz: Option<f64>) -> String {
    let modes = hz.map_or(String::new(), |hz| format!(", modes to {hz} Hz"));
    format!("{}{modes}", surface.name)
}

fn write(
    out: &OutputDir,
    report: &mut Report,
    surface: &Surface,
    drive: &Drive,
    judged: &Judged,
    focused: &Focused,
) -> Result<(), CliError> {
    let measured = &judged.measured;
    let scene = Scene::new(surface, &focused.points, measured.focal_radius_m);
    let unit = report::unit(&surface.actuators.first().map_or(ActuatorKind::Force, |a| a.kind));
    let mut figures = vec![
        ("traces", figures::traces(&measured.targets, &judged.traces, drive.rate())),
        ("drive", figures::channels(drive, unit)),
    ];
    figures.extend(figures::snapshots(&scene, measured).map(|figure| ("focus", figure)));
    figures.extend(figures::peaks(&scene, measured).map(|figure| ("peaks", figure)));
    figures.extend(figures::felt(&scene, measured).map(|figure| ("felt", figure)));
    write_wav(out.path().join("drive.wav"), drive)?;
    report.files = vec!["drive.wav".into()];
    report.files.extend(figures::write(out, &figures)?);
    out.write("report.json", output::json(report)?.as_bytes())?;
    out.write("report.md", report.markdown().as_bytes())?;
    Ok(())
}

/// Puts an output folder in its place, and says on standard error if it replaced an earlier run's.
pub fn finish(out: OutputDir) -> Result<(), CliError> {
    let committed = out.commit()?;
    if committed.replaced {
        eprintln!("replaced the earlier run in {}", committed.path.display());
    }
    eprintln!("wrote {}", committed.path.display());
    Ok(())
}
