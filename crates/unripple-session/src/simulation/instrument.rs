//! The instrument that plays a surface: device, engine, and the modes from which pictures are computed.

use super::lens::Lens;
use super::page_fingers::SHOWN;
use super::page_touches::{News, PageTouches};
use super::past::{room, stride};
use super::playback::{Away, Playback};
use super::real_device::RealDevice;
use super::tape::Tape;
use crate::ViewError;
use crate::stop::wanted;
use std::sync::Arc;
use std::sync::mpsc::Sender;
use unripple::act::model;
use unripple::core::{Device, Responses, SampledResponses, Surface};
use unripple::focus::Method;
use unripple::physics::stepper::{Plant, StepperOptions};
use unripple::physics::{Medium, Modes};
use unripple_calibrate::Ping;
use unripple_devices::{Feeler, Handle, Virtual, VirtualOptions};
use unripple_effects::EffectSet;
use unripple_live::{Engine, FocusWorker, Follower, Level, LiveOptions, Window};
use unripple_store::{builtin_effect, builtin_effects, parse_effects};
use unripple_tasks::Progress;
use unripple_touch::Sources;

/// Number of cells along the longer side of the picture, which then takes 32 kB. With twice this value, a
/// picture takes four times the memory and four times the multiplications.
pub const CELLS: usize = 128;

/// Largest number of fingers whose sensations are computed, and of fingers that load the sheet, those being lifted
/// included.
const FINGERS: usize = 10;
const BORNE: usize = 24;

/// Samples per block of a simulated surface. 1.3 ms at 48 kHz: a touch is answered no later, and the fixed work of a
/// block stays small.
const BLOCK: usize = 64;

/// Duration of the past states that are stored, in s. Longer than waves ring on the paper's film.
const REMEMBERED: f64 = 1.0;

/// Pulses a second under a resting finger, at first. Apart enough to be felt one by one, and often enough to be found
/// at once.
const RATE: f64 = 10.0;

/// Name of the default effect: pulses at the finger while it rests.
pub const PULSES: &str = "pulses";

/// Function that makes the follower of a surface's tension and its ping, from the surface, the options of live play and
/// the samples per block; an error says in words why it cannot.
pub type Follow =
    Arc<dyn Fn(&Surface, &LiveOptions, usize) -> Result<(Follower, Ping), String> + Send + Sync>;

/// Specification of an instrument: surface, responses, method, effect and device.
#[derive(Clone)]
pub struct Spec {
    /// The surface that is played.
    pub surface: Surface,
    /// Measured responses of the surface; computed ones are used where `None`.
    pub stored: Option<Arc<SampledResponses>>,
    /// Whether the scale of the measured responses is unknown.
    pub without_scale: bool,
    /// Focusing method by which drives are computed.
    pub method: Method,
    /// Name of the effect that a touch triggers: [`PULSES`] or a built-in one.
    pub effect: String,
    /// The window in s; the one that suits live play where `None`.
    pub window: Option<f64>,
    /// Pulses per second of the effect [`PULSES`].
    pub rate: f64,
    /// Whether resting fingers load the simulated surface.
    pub load: bool,
    /// The real device; the surface is simulated where `None`.
    pub device: Option<RealDevice>,
    /// Function that makes the follower of the sheet's tension, if it is to be followed.
    pub follow: Option<Follow>,
}

impl Spec {
    /// A surface that is simulated, with computed responses, as it is played at first.
    pub fn simulated(surface: Surface) -> Self {
        Self {
            surface,
            stored: None,
            without_scale: false,
            method: Method::default(),
            effect: PULSES.into(),
            window: None,
            rate: RATE,
            load: false,
            device: None,
            follow: None,
        }
    }
}

/// A surface that is ready to be played and shown.
pub struct Instrument {
    /// The specification from which the instrument was built.
    pub spec: Spec,
    /// The engine, with the device or the simulated surface that it plays.
    pub playback: Playback,
    /// Handle of the simulated surface, which with a real device is computed along with it.
    pub handle: Handle,
    /// Modal model of the surface, from which the readout weights of any place follow.
    pub plant: Plant,
    /// Linear map from states of the modes to pictures.
    pub lens: Lens,
    /// Channel to which the fingers of pages, and the level of effects, are sent.
    pub page_touches: Sender<News>,
    /// The drive of the last second.
    pub tape: Tape,
    /// The window in use, with the contrast expected of it.
    pub window: Window,
    /// The window that suits live play, used where none is requested.
    pub suggested: Window,
    /// The level that a gain of 1 stands for.
    pub level: Level,
}

impl Instrument {
    /// Builds the instrument. This takes some tenths of a second, or seconds for a sheet that needs a mesh. A real device is taken from
    /// the instrument that plays it when all else is ready.
    ///
    /// # Errors
    /// Those of building the model, the device, the engine and the other parts; [`ViewError::Stopped`] if `progress` reports a
    /// cancellation.
    pub fn build(spec: Spec, progress: &mut dyn Progress) -> Result<Self, ViewError> {
        let surface = &spec.surface;
        let accuracy = unripple::act::accuracy(surface);
        let lasting =
            |stored: &SampledResponses| stored.samples().saturating_sub(1) as f64 / stored.conditions.rate;
        let longest = spec.stored.as_deref().map_or(f64::INFINITY, lasting);
        let (suggested, window) = Window::prompt_and(surface, longest, spec.window);
        let mut options = LiveOptions::new(surface, window.seconds);
        options.focus.method = spec.method;
        wanted(progress)?;
        let maker = maker(&spec, &options)?;
        let level = match spec.without_scale {
            true => Level::without_scale(surface, &maker)?,
            false => Level::of(surface, &maker, false)?,
        };
        options.full = level.full;
        wanted(progress)?;
        let modes = Arc::new(Modes::solve(surface, surface.emission.band[1], accuracy)?);
        wanted(progress)?;

        let block = spec.device.as_ref().map_or(Ok(BLOCK), |real| ready(real, surface, progress))?;
        let stepper = StepperOptions { max_fingers: BORNE, ..StepperOptions::default() };
        let made = VirtualOptions { block, stepper, accuracy, ..VirtualOptions::default() };
        let shadow = Virtual::with_modes(surface, modes, &made)?;
        let handle = shadow.handle();
        let plant = handle.plant();
        remember(&handle, surface, plant.modes())?;

        let (page_touches, source) = PageTouches::new(&surface.outline)?;
        let mut sources = Sources::new(&surface.outline);
        sources.push(Box::new(source));
        let feeler = Feeler::new(handle.clone(), surface, FINGERS)?;
        let feeler = if spec.load { feeler } else { feeler.weightless() };
        let lens = Lens::new(&plant, &surface.outline, CELLS);
        let tape = Tape::new(surface.actuators.len(), (REMEMBERED * surface.emission.rate) as usize);
        let parts = Parts { options, maker, set: effect(&spec)?, sources, shadow, feeler };
        let playback = parts.join(&spec, block, progress)?;
        Ok(Self { playback, handle, plant, lens, page_touches, tape, window, suggested, level, spec })
    }

    /// Samples per second.
    pub fn rate(&self) -> f64 {
        self.spec.surface.emission.rate
    }

    /// How long a press stays on the surface at least, in s of its clock: until its focus has been shown. A real surface does not wait.
    pub fn hold(&self) -> f64 {
        match self.playback {
            Playback::Here(_) => self.window.seconds + SHOWN,
            Playback::Away(_) => 0.0,
        }
    }
}

/// What an instrument consists of but for its device.
struct Parts {
    options: LiveOptions,
    maker: FocusWorker,
    set: EffectSet,
    sources: Sources,
    /// The simulated surface.
    shadow: Virtual,
    feeler: Feeler,
}

impl Parts {
    /// Joins the parts to the simulated surface, or to the real device, whose blocks have `block` samples.
    fn join(self, spec: &Spec, block: usize, progress: &mut dyn Progress) -> Result<Playback, ViewError> {
        let Self { options, maker, set, sources, shadow, feeler } = self;
        let surface = &spec.surface;
        let Some(real) = &spec.device else {
            let engine = Engine::new(surface, maker, &set, sources, Box::new(shadow), &options)?;
            return Ok(Playback::Here(Box::new(engine.with_feeler(feeler))));
        };
        let follower = spec.follow.as_ref().map(|follow| follow(surface, &options, block)).transpose();
        let follower = follower.map_err(|why| ViewError::Device { why })?;
        once(progress, || {
            let lent = real.take(surface)?;
            let found = lent.layout().block;
            if found != block {
                let why = format!("expected blocks of {block} samples, found {found}");
                return Err(ViewError::Device { why });
            }
            let (device, drive) = Away::listen(Box::new(lent));
            let mut engine = Engine::new(surface, maker, &set, sources, device, &options)?;
            if let Some((follower, ping)) = follower {
                engine = engine.with_follower(follower, &ping)?;
            }
            let away = Away::start(engine.with_feeler(feeler), shadow, drive)?;
            real.played_by(away.player.clone());
            Ok(Playback::Away(Box::new(away)))
        })
    }
}

/// Samples per block of the real device, which is opened for the surface unless it is open for it.
fn ready(real: &RealDevice, surface: &Surface, progress: &mut dyn Progress) -> Result<usize, ViewError> {
    match real.block(surface) {
        Some(block) => Ok(block),
        None => once(progress, || real.take(surface).map(|lent| lent.layout().block)),
    }
}

/// Does something to the real device unless the build has been given up; one that is given up later is waited for.
fn once<T>(progress: &mut dyn Progress, act: impl FnOnce() -> Result<T, ViewError>) -> Result<T, ViewError> {
    let (mut act, mut done) = (Some(act), Err(ViewError::Stopped));
    let placed = progress.place(&mut || {
        if let Some(act) = act.take() {
            done = act();
        }
        Ok(())
    });
    placed.map_err(|_| ViewError::Stopped).and(done)
}

/// The worker that computes drives; from a library, also at places between its points.
fn maker(spec: &Spec, options: &LiveOptions) -> Result<FocusWorker, ViewError> {
    let surface = &spec.surface;
    match &spec.stored {
        Some(stored) if spec.method.reverses() => {
            let medium = Medium::of(&surface.sheet).with_air(surface.sheet.air);
            Ok(FocusWorker::between(stored.clone(), medium, &options.focus)?)
        }
        Some(stored) => {
            Ok(FocusWorker::new(Arc::new(Responses::Sampled(stored.as_ref().clone())), &options.focus)?)
        }
        // As for the commands, which name the next mode where the band has none.
        None => Ok(FocusWorker::new(Arc::new(model(surface, None, &[])?), &options.focus)?),
    }
}

fn remember(handle: &Handle, surface: &Surface, modes: usize) -> Result<(), ViewError> {
    let rate = surface.emission.rate;
    let stride = stride(surface);
    let states = ((REMEMBERED * rate) as usize / stride).min(room(modes)).max(1);
    Ok(handle.remember(stride, states)?)
}

/// The effects that a touch sets off.
fn effect(spec: &Spec) -> Result<EffectSet, ViewError> {
    if spec.effect == PULSES {
        let text = format!("format = 1\n[[effect]]\nkind = \"pulse-train\"\nrate_hz = {}\n", spec.rate);
        return parse_effects(&text, PULSES).map_err(|faults| ViewError::Store(faults.into()));
    }
    builtin_effect(&spec.effect).ok_or_else(|| no_such_effect(&spec.effect))
}

/// Checks that an effect of this name exists.
///
/// # Errors
/// [`ViewError::Range`] if there is none.
pub fn check_effect(name: &str) -> Result<(), ViewError> {
    if name == PULSES || builtin_effect(name).is_some() { Ok(()) } else { Err(no_such_effect(name)) }
}

fn no_such_effect(name: &str) -> ViewError {
    let names = builtin_effects().iter().map(|effect| effect.name);
    let expected = std::iter::once(PULSES).chain(names).collect::<Vec<_>>().join(", ");
    ViewError::Range { what: "effect", expected, found: name.into() }
}
