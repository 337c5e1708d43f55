//! `unripple play`: a surface that answers fingers, live.

mod open;
mod outputs;
mod report;
mod touches;

use crate::args::PlayOptions;
use crate::error::CliError;
use crate::targets::{of_window, positive, seconds};
use crate::{input, interrupt, judge, output};
use open::Opened;
pub use open::{late, opener};
use report::Report;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use touches::Touches;
use unripple::act::lasting;
use unripple::core::{Drive, Responses, Surface};
use unripple::physics::Medium;
use unripple_calibrate::{Ping, PingOptions};
use unripple_live::{Engine, Follower, Level, LiveError, LiveOptions, Maker, Pulse, Stage, Window};
use unripple_store::{load_effects, write_kept_wav};

/// Most of a drive that is kept, in s.
const KEPT: f64 = 60.0;

/// Time over which tension is observed, in s: a ping, and until it is over.
const FOLLOWED: f64 = 0.4;

/// How often fingers are told of, in s of played time.
const TELL: f64 = 0.2;

impl From<LiveError> for CliError {
    fn from(error: LiveError) -> Self {
        match error {
            LiveError::Device(_) | LiveError::Gone { .. } => Self::work(error),
            error => Self::input(error),
        }
    }
}

pub fn run(options: &PlayOptions, as_json: bool) -> Result<(), CliError> {
    let source = input::source(&options.surface)?;
    let (surface, without_scale) = (source.surface.clone(), source.without_scale().is_some());
    let notes = source.stored.as_ref().map_or_else(Vec::new, |stored| stored.notes.clone());
    let set = load_effects(&options.effect)?;
    outputs::check(options)?;
    let responses = Arc::new(match source.stored {
        Some(stored) => Responses::Sampled(stored.responses),
        None => judge::model(&surface, None, &[])?,
    });
    let window = window(options, &surface, &responses)?;
    let mut settings = LiveOptions::new(&surface, window.seconds);
    settings.focus.method = options.method.method();
    let asked = options.window_ms.is_some();
    let maker = maker(&surface, &responses, &settings).map_err(|error| of_window(error, asked))?;
    let level = match without_scale {
        true => Level::without_scale(&surface, &maker)?,
        false => Level::of(&surface, &maker, options.full_limit)?,
    };
    settings.full = level.full;
    let (touches, sources) = Touches::open(&options.touch, &surface)?;
    let Opened { device, feeler, latency } = open::open(options, &surface)?;
    let engine = Engine::new(&surface, maker, &set, sources, device, &settings)?;
    let mut engine = match feeler {
        Some(feeler) => engine.with_feeler(feeler),
        None => engine,
    };
    if let Some(listener) = touches.listener() {
        engine = engine.with_listener(listener);
    }
    if options.follow_tension {
        let (follower, ping) = follower(&surface, &responses, &settings, latency)?;
        engine = engine.with_follower(follower, &ping)?;
    }
    for line in [window.to_string(), level.to_string()].iter().chain(&touches.told) {
        eprintln!("{line}");
    }
    let mut report = Report::new(&surface, &window, &level);
    report.notes = notes;
    report.without_scale = without_scale;
    let mut session = Session { options, touches, report, told: 0.0 };
    let stop = interrupted()?;
    let seconds = seconds_to_play(options, session.touches.lasts)?;
    session.touches.begin();
    match options.clock() {
        Some(_) => session.run(&mut engine, seconds, &stop)?,
        None => session.step(&mut engine, seconds, &stop)?,
    }
    session.touches.finish()?;
    let report = session.report.finish(&mut engine);
    output::answer(as_json, &report, &report.text())
}

/// What makes drives: of a library, at places between its points.
fn maker(surface: &Surface, responses: &Arc<Responses>, settings: &LiveOptions) -> Result<Maker, CliError> {
    match responses.as_ref() {
        Responses::Sampled(stored) if settings.focus.method.reverses() => {
            let medium = Medium::of(&surface.sheet).with_air(surface.sheet.air);
            Ok(Maker::between(Arc::new(stored.clone()), medium, &settings.focus)?)
        }
        _ => Ok(Maker::new(responses.clone(), &settings.focus)?),
    }
}

fn window(options: &PlayOptions, surface: &Surface, responses: &Responses) -> Result<Window, CliError> {
    Ok(match seconds(options.window_ms, "--window-ms")? {
        Some(asked) => Window::of(surface, asked),
        None => Window::prompt_within(surface, lasting(responses)),
    })
}

fn seconds_to_play(options: &PlayOptions, lasts: Option<f64>) -> Result<Option<f64>, CliError> {
    let asked = options.seconds.map(|s| positive(s, "--seconds", "s")).transpose()?;
    Ok(asked.or(lasts))
}

/// Becomes true when somebody wants to stop.
pub fn interrupted() -> Result<Arc<AtomicBool>, CliError> {
    Ok(interrupt::wished())
}

/// What follows the tension of a surface that is known by its modes.
pub fn follower(
    surface: &Surface,
    responses: &Responses,
    settings: &LiveOptions,
    latency: usize,
) -> Result<(Follower, Ping), CliError> {
    let Responses::Modal(modal) = responses else {
        let text = "--follow-tension: expected a surface, whose modes it needs, found a library (fit a model to it first)";
        return Err(CliError::Input(text.into()));
    };
    let tracker = open::tracker(surface, modal)?;
    let channels = surface.actuators.len();
    let options = PingOptions { limit: surface.emission.limit, ..PingOptions::default() };
    let ping = Ping::design(modal, &options)?;
    Ok((Follower::new(tracker, &settings.focus, channels, surface.emission.rate, FOLLOWED, latency), ping))
}

/// One sitting.
struct Session<'a> {
    options: &'a PlayOptions,
    touches: Touches,
    report: Report,
    told: f64,
}

impl Session<'_> {
    /// Plays as fast as it goes, all on this thread.
    fn step(&mut self, engine: &mut Engine, seconds: Option<f64>, stop: &AtomicBool) -> Result<(), CliError> {
        let mut kept = Vec::new();
        while !stop.load(Ordering::Relaxed) && seconds.is_none_or(|end| engine.stage().time() < end) {
            engine.step()?;
            if self.options.keep_drive.is_some() && engine.stage().time() <= KEPT {
                kept.extend_from_slice(engine.heart().drive());
            }
            let stage = engine.stage();
            if stage.time() - self.told >= TELL {
                self.tell(stage, None);
            }
        }
        match &self.options.keep_drive {
            Some(path) => {
                let drive = drive(&kept, engine)?;
                if write_kept_wav(path, &self.options.reads(), &drive)?.replaced {
                    eprintln!("replaced the earlier drive in {}", path.display());
                }
                Ok(())
            }
            None => Ok(()),
        }
    }

    /// Plays by the device's clock, on a thread of its own.
    fn run(&mut self, engine: &mut Engine, seconds: Option<f64>, stop: &AtomicBool) -> Result<(), CliError> {
        engine.run(seconds, |stage, pulse| {
            self.tell(stage, Some(pulse));
            !stop.load(Ordering::Relaxed)
        })?;
        Ok(())
    }

    fn tell(&mut self, stage: &mut Stage, pulse: Option<&Pulse>) {
        self.told = stage.time();
        let line = self.report.look(stage, pulse);
        if !line.is_empty() {
            eprintln!("{line}");
        }
    }
}

/// What was driven, from blocks.
fn drive(kept: &[f32], engine: &Engine) -> Result<Drive, CliError> {
    let layout = engine.heart().device().layout();
    let outputs = layout.outputs.len();
    let mut channels = vec![Vec::new(); outputs];
    for block in kept.chunks_exact(outputs * layout.block) {
        for (channel, plane) in channels.iter_mut().zip(block.chunks_exact(layout.block)) {
            channel.extend(plane.iter().map(|x| f64::from(*x)));
        }
    }
    Drive::new(layout.rate, layout.outputs.clone(), channels).map_err(CliError::work)
}
