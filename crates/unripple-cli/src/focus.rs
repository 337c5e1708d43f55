//! `unripple focus`: a drive, its report and its figures.

use crate::args::{FocusOptions, LossName, MethodName};
use crate::aware::aware;
use crate::error::CliError;
use crate::figures::{self, Scene};
use crate::judge::{self, Judged};
use crate::reads::Reads;
use crate::targets::{self, of_window, seconds};
use crate::{fingers, input, output, played, waveforms};
use unripple::act::{self, Act, Note, Report, chosen_window};
use unripple::core::{ActuatorKind, Decay, Drive, Point, Surface};
use unripple::focus::{Focused, LossCorrection, Options};
use unripple::physics::Medium;
use unripple_store::{OutputDir, write_wav};

pub fn run(options: &FocusOptions, as_json: bool) -> Result<(), CliError> {
    waveforms::check(options)?;
    if !options.targets.waveform.is_empty() || options.targets.path.is_some() {
        return played::run(options, as_json);
    }
    let source = input::source(&options.surface)?;
    source.allows(&needing_modes(options))?;
    let plant = options.on.as_deref().map(input::surface).transpose()?;
    let out = OutputDir::create_beside(&options.output, &options.reads())?;
    let unscaled = source.without_scale().filter(|_| plant.is_none());
    let known = source.lambda_min();
    let lambda_min = known
        .unwrap_or_else(|| Medium::of(&source.surface.sheet).lambda_min(source.surface.emission.band[1]));
    let targets = targets::all(&options.targets, lambda_min)?;
    let places: Vec<Point> = targets.iter().flat_map(|target| target.points.iter().copied()).collect();
    let (surface, responses, stored) = source.respond(&places, options.between.interpolation())?;
    let asked = seconds(options.window_ms, "--window-ms")?;
    let chosen = asked.is_none().then(|| chosen_window(&surface, &responses));
    let window = asked.or(chosen.as_ref().map(|chosen| chosen.seconds)).unwrap_or_default();
    targets::carries(responses.conditions(), window, "--window-ms")?;
    let settings = settings(options, &surface, window)?;
    let aware = aware(options, &surface)?;
    let focuser = aware.focuser(&responses, &settings)?;
    let focused = focuser.focus(&targets).map_err(act::ActError::from);
    let focused = focused.map_err(|error| of_window(error.into(), asked.is_some()))?;
    let restored = aware.note(&responses, &targets, &settings, &focused)?;

    let judged_surface = plant.as_ref().unwrap_or(&surface);
    let other = plant.is_some() || options.judge_hz.is_some();
    let free = other.then(|| judge::model(judged_surface, options.judge_hz, &[])).transpose()?;
    let free = free.as_ref().unwrap_or(&responses);
    let contacts = fingers::contacts(&options.finger, judged_surface)?;
    let touched = !contacts.is_empty();
    let under = touched.then(|| judge::model(judged_surface, options.judge_hz, &contacts)).transpose()?;
    let judging = under.as_ref().unwrap_or(free);
    let level = targets::level_on(&options.targets, unscaled.as_deref())?;
    let act =
        Act { surface: judged_surface, responses: judging, targets: &targets, options: &settings, level };
    let sent = act.send(&focuser, focused)?;
    let judged = judge::seen(sent.until, || act.judge(&sent))?;
    let (focused, drive) = (sent.focused, sent.drive);
    let mut report = Report::of_focus(&surface, &focused, settings.window, &drive, &judged);
    report.level = Some(sent.strength);
    report.fingers = act::felt(&contacts, judged_surface, [judging, free], &drive, judged.until)?;
    report.notes.extend(chosen.map(|chosen| Note { topic: "window", text: chosen.text() }));
    report.notes.extend(restored);
    report.judged_on = other.then(|| judged_on(judged_surface, options.judge_hz));
    if let Some((told, notes)) = stored {
        report.notes.extend(notes.into_iter().chain(act::nearby(&focused, &targets)));
        report.judged_on.get_or_insert(told);
    }
    if unscaled.is_some() {
        report = report.without_scale();
    }
    write(&out, &mut report, judged_surface, &drive, &judged, &focused, unscaled.is_none())?;
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

fn settings(options: &FocusOptions, surface: &Surface, window: f64) -> Result<Options, CliError> {
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
    scaled: bool,
) -> Result<(), CliError> {
    let measured = &judged.measured;
    let scene = Scene::new(surface, &focused.points, measured.focal_radius_m);
    let unit = act::unit(&surface.actuators.first().map_or(ActuatorKind::Force, |a| a.kind));
    let mut figures = vec![("drive", figures::channels(drive, unit))];
    // The others are drawn in m/s and µm, which nobody knows without a scale.
    if scaled {
        figures.insert(0, ("traces", figures::traces(&measured.targets, &judged.traces, drive.rate())));
        figures.extend(figures::snapshots(&scene, measured).map(|figure| ("focus", figure)));
        figures.extend(figures::peaks(&scene, measured).map(|figure| ("peaks", figure)));
        figures.extend(figures::felt(&scene, measured).map(|figure| ("felt", figure)));
    }
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
