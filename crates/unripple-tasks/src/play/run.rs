//! Plays a surface live, in response to touches.

use super::open::{self, Opened};
use super::report::Report;
use super::touches::Touches;
use super::{Ask, outputs};
use crate::numbers::above_zero;
use crate::record::Request;
use crate::window::of_window;
use crate::{Progress, TaskError, apart, judge, source};
use std::sync::Arc;
use unripple::act::{Note, lasting};
use unripple::core::{Drive, Responses, Surface};
use unripple::effects::EffectSet;
use unripple::physics::Medium;
use unripple_calibrate::{Ping, PingOptions};
use unripple_live::{
    Engine, FocusWorker, Follower, LONGEST_WINDOW, Level, LiveOptions, PlayState, Stage, Window,
};
use unripple_store::{load_effects, write_kept_wav};
use unripple_touch::Sources;

/// Longest part of a drive that is stored, in s: 92 MB in float32 for eight channels at 48 kHz.
const KEPT: f64 = 60.0;

/// Time over which the tension is estimated, in s: a ping, and its decay.
const FOLLOWED: f64 = 0.4;

/// Interval at which what fingers feel is reported, in s of played time: as fast as figures can be read.
pub(super) const TELL: f64 = 0.2;

/// Results of the computations that precede playing; they take seconds for a surface whose modes need a mesh.
pub(super) struct Prepared {
    pub(super) surface: Surface,
    responses: Arc<Responses>,
    set: EffectSet,
    maker: FocusWorker,
    settings: LiveOptions,
    pub(super) window: Window,
    level: Level,
    without_scale: bool,
    notes: Vec<Note>,
}

/// Computes responses, window and level, and checks the files that are to be written.
pub(super) fn prepare(ask: &Ask, progress: &mut dyn Progress) -> Result<Prepared, TaskError> {
    let source = source::open(&ask.surface, progress)?;
    let (surface, without_scale) = (source.surface.clone(), source.without_scale().is_some());
    let notes = source.stored.as_ref().map_or_else(Vec::new, |stored| stored.notes.clone());
    let set = load_effects(&ask.effect)?;
    outputs::check(ask)?;
    if let Some(window) = ask.window_s.filter(|window| *window > LONGEST_WINDOW) {
        return Err(TaskError::ask("window_s", format!("at most {LONGEST_WINDOW} s"), window));
    }
    progress.stage("responses");
    let responses = Arc::new(match source.stored {
        Some(stored) => Responses::Sampled(stored.responses),
        None => judge::model(&surface, None, &[])?,
    });
    progress.stage("window and level");
    let window = window(ask, &surface, &responses)?;
    let mut settings = LiveOptions::new(&surface, window.seconds);
    settings.focus.method = ask.method;
    let asked = ask.window_s.is_some();
    let maker = maker(&surface, &responses, &settings).map_err(|error| of_window(error, asked))?;
    let level = match without_scale {
        true => Level::without_scale(&surface, &maker)?,
        false => Level::of(&surface, &maker, ask.full_limit)?,
    };
    settings.full = level.full;
    Ok(Prepared { surface, responses, set, maker, settings, window, level, without_scale, notes })
}

/// Plays a surface in response to touches until the session is over or cancelled. Cancelling is no error
/// once playing has begun: the report covers what was played until then.
///
/// # Errors
/// [`TaskError::Ask`] of options that make no sense; those of surfaces, effects, devices, touches and files; [`TaskError::Cancelled`]
/// within 0.2 s if it is cancelled before it plays.
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let prepared = apart(ask.clone(), prepare, progress)?;
    let (touches, sources) = Touches::open(&ask.touch, &prepared.surface)?;
    let (mut engine, report) = join(ask, prepared, sources, progress)?;
    if let Some(listener) = touches.listener() {
        engine = engine.with_listener(listener);
    }
    progress.over();
    touches.told.iter().for_each(|line| progress.tell(line));
    let mut session = Session { ask, touches, report, told: 0.0, progress };
    let seconds = seconds_to_play(ask, session.touches.lasts)?;
    session.touches.begin();
    match ask.clock() {
        Some(_) => session.run(&mut engine, seconds)?,
        None => session.step(&mut engine, seconds)?,
    }
    session.touches.finish()?;
    Ok(session.report.finish(&mut engine))
}

/// Connects the prepared data to the sources of touches and to the device, which is opened here, and
/// reports window and level to `progress`. The returned report is still empty.
pub(super) fn join(
    ask: &Ask,
    prepared: Prepared,
    sources: Sources,
    progress: &mut dyn Progress,
) -> Result<(Engine, Report), TaskError> {
    let Prepared { surface, responses, set, maker, settings, window, level, without_scale, notes } = prepared;
    // A virtual surface computes its own modes.
    let asked = (ask.clone(), surface.clone());
    let Opened { device, feeler, latency } =
        apart(asked, |(ask, surface), _| open::open(ask, surface), progress)?;
    let mut engine = Engine::new(&surface, maker, &set, sources, device, &settings)?;
    if let Some(feeler) = feeler {
        engine = engine.with_feeler(feeler);
    }
    if ask.follow_tension {
        let (follower, ping) = follower(&surface, &responses, &settings, latency)?;
        engine = engine.with_follower(follower, &ping)?;
    }
    progress.tell(&window.to_string());
    progress.tell(&level.to_string());
    let mut report = Report::new(&surface, &window, &level);
    report.notes = notes;
    report.without_scale = without_scale;
    Ok((engine, report))
}

/// The worker that computes drives; with a library of responses, also at places between its points.
fn maker(
    surface: &Surface,
    responses: &Arc<Responses>,
    settings: &LiveOptions,
) -> Result<FocusWorker, TaskError> {
    match responses.as_ref() {
        Responses::Sampled(stored) if settings.focus.method.reverses() => {
            let medium = Medium::of(&surface.sheet).with_air(surface.sheet.air);
            Ok(FocusWorker::between(Arc::new(stored.clone()), medium, &settings.focus)?)
        }
        _ => Ok(FocusWorker::new(responses.clone(), &settings.focus)?),
    }
}

fn window(ask: &Ask, surface: &Surface, responses: &Responses) -> Result<Window, TaskError> {
    Ok(match ask.window_s.map(|window| above_zero(window, "window_s", "s")).transpose()? {
        Some(asked) => Window::of(surface, asked),
        None => Window::prompt_within(surface, lasting(responses)),
    })
}

fn seconds_to_play(ask: &Ask, lasts: Option<f64>) -> Result<Option<f64>, TaskError> {
    let asked = ask.seconds.map(|s| above_zero(s, "seconds", "s")).transpose()?;
    Ok(asked.or(lasts))
}

/// Prepares to follow the tension of a surface: returns the follower, and the ping (test signal) that it
/// plays. Needs modal responses; `latency` is the number of samples from drive to input.
///
/// # Errors
/// [`TaskError::Input`] for sampled responses; those of the tracker and the ping.
pub fn follower(
    surface: &Surface,
    responses: &Responses,
    settings: &LiveOptions,
    latency: usize,
) -> Result<(Follower, Ping), TaskError> {
    let Responses::Modal(modal) = responses else {
        let text = "`follow_tension`: expected a surface, whose modes it needs, found a library (fit a model to it first)";
        return Err(TaskError::Input(text.into()));
    };
    let tracker = open::tracker(surface, modal)?;
    let channels = surface.actuators.len();
    let options = PingOptions { limit: surface.emission.limit, ..PingOptions::default() };
    let ping = Ping::design(modal, &options)?;
    Ok((Follower::new(tracker, &settings.focus, channels, surface.emission.rate, FOLLOWED, latency), ping))
}

/// One session of play, from opening to report.
struct Session<'a> {
    ask: &'a Ask,
    touches: Touches,
    report: Report,
    told: f64,
    progress: &'a mut dyn Progress,
}

impl Session<'_> {
    /// Plays in virtual time, as fast as possible, on the calling thread.
    fn step(&mut self, engine: &mut Engine, seconds: Option<f64>) -> Result<(), TaskError> {
        let mut kept = Vec::new();
        while !self.progress.cancelled() && seconds.is_none_or(|end| engine.stage().time() < end) {
            engine.step()?;
            if self.ask.keep_drive.is_some() && engine.stage().time() <= KEPT {
                kept.extend_from_slice(engine.heart().drive());
            }
            let stage = engine.stage();
            if stage.time() - self.told >= TELL {
                self.tell(stage, None);
            }
        }
        match &self.ask.keep_drive {
            Some(path) => {
                let drive = drive(&kept, engine)?;
                if write_kept_wav(path, &self.ask.reads(), &drive)?.replaced {
                    self.progress.tell(&format!("replaced the earlier drive in {}", path.display()));
                }
                Ok(())
            }
            None => Ok(()),
        }
    }

    /// Plays by the device's clock, on a separate thread.
    fn run(&mut self, engine: &mut Engine, seconds: Option<f64>) -> Result<(), TaskError> {
        engine.run(seconds, |stage, play_state| {
            self.tell(stage, Some(play_state));
            !self.progress.cancelled()
        })?;
        Ok(())
    }

    fn tell(&mut self, stage: &mut Stage, play_state: Option<&PlayState>) {
        self.told = stage.time();
        let line = self.report.look(stage, play_state);
        if !line.is_empty() {
            self.progress.tell(&line);
        }
    }
}

/// Assembles the drive from its blocks.
fn drive(kept: &[f32], engine: &Engine) -> Result<Drive, TaskError> {
    let layout = engine.heart().device().layout();
    let outputs = layout.outputs.len();
    let mut channels = vec![Vec::new(); outputs];
    for block in kept.chunks_exact(outputs * layout.block) {
        for (channel, plane) in channels.iter_mut().zip(block.chunks_exact(layout.block)) {
            channel.extend(plane.iter().map(|x| f64::from(*x)));
        }
    }
    Drive::new(layout.rate, layout.outputs.clone(), channels).map_err(TaskError::work)
}
