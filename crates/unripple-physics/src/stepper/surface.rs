//! A surface simulated in the time domain: channels, fingers, probes.

use super::engine::Engine;
use super::field::Probes;
use super::history::History;
use super::options::StepperOptions;
use super::plant::{Channel, ContactWeights, Plant};
use super::run::{Block, Drive, Out, Planes};
use crate::{Modes, PhysicsError};
use std::sync::Arc;
use unripple_core::{Contact, Finger, Point, Pole, Surface, require};

/// The quantity that a probe reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// Velocity, in m/s.
    Velocity,
    /// Displacement, in m.
    Displacement,
}

/// The displacement and velocity of a running surface at one instant, at a list of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Displacement at each point, in m.
    pub displacement: Vec<f64>,
    /// Velocity at each point, in m/s.
    pub velocity: Vec<f64>,
}

/// Motion of a finger on a running surface, with the force on it and the power into it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FingerMotion {
    /// Factor of the finger's coupling to the sheet, which rises smoothly from 0 when the finger is put
    /// down to 1 in full contact.
    pub grip: f64,
    /// Force on the finger over the next time step, in N.
    pub force: f64,
    /// Velocity of the sheet under the finger, in m/s, times `grip`.
    pub velocity: f64,
    /// Displacement of the finger since it was put down (the extension of its spring), in m.
    pub displacement: f64,
    /// Mean power into the finger over the last block, dissipated and stored together, in W: the exact work
    /// of the contact force, divided by the block's duration.
    pub power: f64,
}

/// A surface simulated in the time domain: it takes drive samples, returns sensor and probe samples, and
/// can be touched by fingers. The [module](crate::stepper) describes the numerical scheme.
#[derive(Clone, Debug)]
pub struct VirtualSurface {
    /// State of modes, loads and fingers.
    pub(super) engine: Engine,
    plant: Plant,
    rate: f64,
    tension: f64,
    last: usize,
    history: Option<History>,
}

impl VirtualSurface {
    /// A simulated surface at rest, with the modes of `plant` and the given channels, at `rate` samples per second.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a value out of its range; [`PhysicsError::Unsupported`] for a channel driven by a voltage
    /// without a coil.
    pub fn new(
        plant: &Plant,
        channels: &[Channel],
        rate: f64,
        options: &StepperOptions,
    ) -> Result<Self, PhysicsError> {
        require("sample rate in Hz", rate > 0.0, "a positive number", rate)?;
        require("time a finger takes to come in s", options.fade >= 0.0, "0 or more", options.fade)?;
        require("time a finger takes to move in s", options.glide >= 0.0, "0 or more", options.glide)?;
        let (steps, fingers) = (options.substeps as f64, options.max_fingers as f64);
        require("steps per sample", (1.0..=1e6).contains(&steps), "between 1 and 1000000", steps)?;
        require("fingers at once", fingers <= 64.0, "at most 64", fingers)?;
        let engine = Engine::new(plant, channels, rate, options)?;
        Ok(Self { engine, plant: plant.clone(), rate, tension: 1.0, last: 0, history: None })
    }

    /// A simulated surface with the actuators and the sample rate of a [`Surface`], and with the given modes.
    ///
    /// # Errors
    /// Those of [`VirtualSurface::new`] and [`Channel::all`].
    pub fn of(surface: &Surface, modes: Arc<Modes>, options: &StepperOptions) -> Result<Self, PhysicsError> {
        let plant = Plant::of(surface, modes)?;
        Self::new(&plant, &Channel::all(surface)?, surface.emission.rate, options)
    }

    /// The sheet (poles, shapes and outline), with which another thread can compute
    /// [`ContactWeights`].
    pub fn plant(&self) -> &Plant {
        &self.plant
    }

    /// Sample rate, in samples per second.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Number of channels; each has a drive and a sensor signal.
    pub fn channels(&self) -> usize {
        self.engine.leads.len()
    }

    /// Number of probes set by [`VirtualSurface::set_probes`].
    pub fn probes(&self) -> usize {
        self.engine.probes.heard.len()
    }

    /// Number of samples processed so far.
    pub fn samples(&self) -> u64 {
        self.engine.samples
    }

    /// Replaces all probes by probes of the given quantities at the given points (m). Allocates.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a point that is not finite.
    pub fn set_probes(&mut self, probes: &[(Point, Reading)]) -> Result<(), PhysicsError> {
        let rows = probes.iter().map(|(at, _)| Ok(self.plant.contact_weights(*at, 0.0)?.per_mode));
        let rows: Vec<Vec<f64>> = rows.collect::<Result<_, PhysicsError>>()?;
        let displaced = probes.iter().map(|(_, reading)| *reading == Reading::Displacement).collect();
        let modes = self.engine.field.displacement().len();
        self.engine.probes = Probes::new(&rows, displaced, modes);
        Ok(())
    }

    /// Moves some probes, given by their indices, to other points (m); the others are not affected. Allocates.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for an index out of range or a point that is not finite; then no probe is moved.
    pub fn move_probes(&mut self, moved: &[(usize, Point)]) -> Result<(), PhysicsError> {
        let count = self.probes();
        let row = |(probe, at): &(usize, Point)| {
            let expected = format!("less than {count}, the number of probes");
            require("probe to be moved", *probe < count, expected, *probe as f64)?;
            Ok((*probe, self.plant.contact_weights(*at, 0.0)?))
        };
        let rows = moved.iter().map(row).collect::<Result<Vec<_>, PhysicsError>>()?;
        rows.iter().for_each(|(probe, weights)| self.engine.probes.place(*probe, &weights.per_mode));
        Ok(())
    }

    /// Moves a channel without load to another contact, from the next sample on: for example, its drive can
    /// then tap the surface at any place. Allocates only if it fails.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for an index out of range or contact weights of another sheet,
    /// [`PhysicsError::Unsupported`] for a loaded channel.
    pub fn move_channel(&mut self, channel: usize, weights: &ContactWeights) -> Result<(), PhysicsError> {
        self.check_weights(weights)?;
        let lead = self.engine.leads.get(channel).copied();
        let Some(lead) = lead else {
            let expected = format!("less than {}, the number of channels", self.channels());
            return Ok(require("channel to be moved", false, expected, channel as f64)?);
        };
        if lead.port >= self.engine.felt.plain {
            return Err(PhysicsError::Unsupported {
                what: "channel to be moved",
                expected: "one on which nothing hangs",
                found: format!("channel {channel}, with a load"),
            });
        }
        self.engine.move_port(lead.port, &weights.per_mode);
        Ok(())
    }

    /// Processes a block of `frames` samples: reads the drive samples of all channels and writes all sensor
    /// and probe samples. Never allocates.
    ///
    /// All three are planar: the samples of channel 0, then those of channel 1, and so on. Sample i of a sensor or probe
    /// contains the effect of drive sample i. `sensors` and `probes` may be empty. Results do not depend on the lengths of
    /// blocks. Drive that is not finite counts as 0.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] if a slice has another length; then no sample is processed.
    pub fn process(
        &mut self,
        frames: usize,
        drive: &[f64],
        sensors: &mut [f64],
        probes: &mut [f64],
    ) -> Result<(), PhysicsError> {
        let (channels, listeners) = (self.channels(), self.probes());
        size("drive", drive.len(), channels * frames, false)?;
        size("sensors", sensors.len(), channels * frames, true)?;
        size("probes", probes.len(), listeners * frames, true)?;
        if frames > 0 {
            self.engine.bank.reset_work();
            self.last = frames;
        }
        let (mut first, whole) = (0, frames);
        while first < whole {
            let frames = self.history.as_ref().map_or(whole, |history| history.wait()).min(whole - first);
            let (drive, out) = (Drive { values: drive, stride: whole, first }, Out { stride: whole, first });
            self.run(Planes { frames, drive, out, sensors: &mut *sensors, probes: &mut *probes });
            first += frames;
            if let Some(history) = &mut self.history {
                let (field, modes) = (&self.engine.field, self.plant.modes());
                history.take(frames, &field.displacement()[..modes], &field.velocity()[..modes]);
            }
        }
        Ok(())
    }

    /// Starts to record the modal state after every `stride`-th sample; a ring buffer holds the newest
    /// states, at most `states` of them. Allocates.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a stride or number of states of 0, or more states than 2^20.
    pub fn remember(&mut self, stride: usize, states: usize) -> Result<(), PhysicsError> {
        self.history = Some(History::new(self.plant.modes(), stride, states, self.engine.samples)?);
        Ok(())
    }

    /// The recorded states; `None` unless [`VirtualSurface::remember`] was called.
    pub fn history(&self) -> Option<&History> {
        self.history.as_ref()
    }

    /// Processes samples whose slices have been checked.
    pub(super) fn run(&mut self, planes: Planes) {
        let arch = self.engine.arch;
        arch.dispatch(Block { engine: &mut self.engine, planes });
    }

    /// Puts a finger down; `id` identifies it from now on. Its load is faded in over
    /// [`StepperOptions::fade`], with its spring relaxed at first. Evaluates mode shapes over the contact
    /// disc and allocates; [`VirtualSurface::touch_on`] does not.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a value out of its range, or if there are too many fingers; [`PhysicsError::Unsupported`] if
    /// a finger of this number is down.
    pub fn touch(&mut self, id: u64, contact: &Contact) -> Result<(), PhysicsError> {
        let weights = self.plant.contact_weights(contact.at, contact.finger.contact_radius)?;
        self.touch_on(id, &contact.finger, &weights)
    }

    /// Puts a finger down on a contact whose modal weights [`Plant::contact_weights`] has computed before (one
    /// weight per mode). Allocates only if it fails.
    ///
    /// # Errors
    /// Those of [`VirtualSurface::touch`].
    pub fn touch_on(
        &mut self,
        id: u64,
        finger: &Finger,
        weights: &ContactWeights,
    ) -> Result<(), PhysicsError> {
        require("mass of a finger in kg", finger.mass >= 0.0, "0 or more", finger.mass)?;
        require("damping of a finger in N·s/m", finger.damping >= 0.0, "0 or more", finger.damping)?;
        require("stiffness of a finger in N/m", finger.stiffness >= 0.0, "0 or more", finger.stiffness)?;
        self.check_weights(weights)?;
        if self.find(id).is_some() {
            return Err(PhysicsError::Unsupported {
                what: "name of a finger put down",
                expected: "one that is not down",
                found: id.to_string(),
            });
        }
        if self.engine.put(id, *finger, &weights.per_mode) {
            return Ok(());
        }
        let found = self.engine.touches.len();
        let expected = format!("at most {found}, those that are being lifted included");
        Ok(require("fingers at once", false, expected, found as f64 + 1.0)?)
    }

    /// Moves a finger to a place (m). Its load is cross-faded from the present to the new contact over
    /// [`StepperOptions::glide`]. Allocates; [`VirtualSurface::move_onto`] does not.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a place that is not finite, [`PhysicsError::Unsupported`] if no finger of this number is down.
    pub fn move_to(&mut self, id: u64, at: Point) -> Result<(), PhysicsError> {
        let finger = self.down(id)?;
        let weights = self.plant.contact_weights(at, self.engine.touches[finger].finger.contact_radius)?;
        self.move_onto(id, &weights)
    }

    /// Moves a finger to a contact whose modal weights [`Plant::contact_weights`] has computed before (one weight
    /// per mode). Allocates only if it fails.
    ///
    /// # Errors
    /// Those of [`VirtualSurface::move_to`].
    pub fn move_onto(&mut self, id: u64, weights: &ContactWeights) -> Result<(), PhysicsError> {
        self.check_weights(weights)?;
        let finger = self.down(id)?;
        self.engine.shift(finger, &weights.per_mode);
        Ok(())
    }

    /// Lifts a finger: its load is faded out over [`StepperOptions::fade`]; `id` can be used for another
    /// finger at once. Allocates only if it fails.
    ///
    /// # Errors
    /// [`PhysicsError::Unsupported`] if no finger of this number is down.
    pub fn lift(&mut self, id: u64) -> Result<(), PhysicsError> {
        let finger = self.down(id)?;
        self.engine.touches[finger].lifted = true;
        Ok(())
    }

    /// Motion of a finger (m, m/s), force on it (N) and power into it (W); `None` if no finger with this
    /// `id` is down.
    pub fn finger_motion(&self, id: u64) -> Option<FingerMotion> {
        let finger = self.find(id)?;
        let (engine, port) = (&self.engine, self.engine.fixed + finger);
        let part = engine.couplings.parts[port];
        let felt =
            |row: usize| engine.weights.row(row).iter().zip(engine.field.velocity()).map(|(w, v)| w * v);
        let velocity =
            part.rows.iter().zip(part.shares).map(|(row, share)| share * felt(*row).sum::<f64>()).sum();
        let time = self.last as f64 / self.rate;
        Some(FingerMotion {
            grip: engine.touches[finger].grip(),
            force: -engine.bank.forces()[port],
            velocity,
            displacement: engine.bank.extension(port),
            power: if self.last > 0 { engine.bank.work(port) / time } else { 0.0 },
        })
    }

    /// Sets the tension from the next sample on, to `factor` times the tension for which the modes were
    /// computed.
    ///
    /// To first order: `ω² = ω0² (1 + (factor - 1)(1 - share))`, with `share` the share of bending in the mode's elastic energy.
    /// Shapes and decay do not change; it is exact where tension does not change shapes. Displacement and velocity are
    /// continuous, so that small changes from block to block give a smooth drift. Allocates only if it fails.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] unless the factor is 0 or more.
    pub fn set_tension(&mut self, factor: f64) -> Result<(), PhysicsError> {
        require("tension as a share of the nominal one", factor >= 0.0, "0 or more", factor)?;
        if factor != self.tension {
            let changed = |(pole, share): (&Pole, &f64)| Pole {
                omega: pole.omega * (1.0 + (factor - 1.0) * (1.0 - share)).max(0.0).sqrt(),
                ..*pole
            };
            self.engine.tune(self.plant.poles.iter().zip(&*self.plant.bending_shares).map(changed));
            self.tension = factor;
        }
        Ok(())
    }

    /// Modal displacements (m·√kg) and velocities (√J) of all modes just after the impulses of the last sample.
    pub fn state(&self) -> (&[f64], &[f64]) {
        let modes = self.plant.modes();
        let field = &self.engine.field;
        (&field.displacement()[..modes], &field.velocity()[..modes])
    }

    /// Displacement and velocity at any points (m) just after the impulses of the last sample. Allocates.
    pub fn snapshot(&self, points: &[Point]) -> Snapshot {
        let weights = self.plant.shapes.at_all(points);
        let (displacement, velocity) = self.state();
        let read = |state: &[f64]| {
            let value = |p| state.iter().enumerate().map(|(m, x)| weights[(p, m)] * x).sum();
            (0..points.len()).map(value).collect()
        };
        Snapshot { displacement: read(displacement), velocity: read(velocity) }
    }

    /// Energy of the sheet, its loads and their housings, in J: kinetic, elastic and magnetic. Without
    /// drive it can grow only when the tension is changed.
    pub fn energy(&self) -> f64 {
        self.engine.field.energy(self.engine.own) + self.engine.bank.energy()
    }

    fn check_weights(&self, weights: &ContactWeights) -> Result<(), PhysicsError> {
        let (found, modes) = (weights.per_mode.len(), self.plant.modes());
        if found == modes {
            return Ok(());
        }
        Ok(require("modes of a footing", false, format!("{modes}, those of the sheet"), found as f64)?)
    }

    fn find(&self, id: u64) -> Option<usize> {
        self.engine.touches.iter().position(|touch| touch.id == id && !touch.lifted)
    }

    fn down(&self, id: u64) -> Result<usize, PhysicsError> {
        self.find(id).ok_or_else(|| PhysicsError::Unsupported {
            what: "finger to move or lift",
            expected: "one that is down",
            found: id.to_string(),
        })
    }
}

/// Refuses a slice that does not have the expected length; an empty slice is accepted if `or_none` is true.
pub(super) fn size(what: &str, found: usize, expected: usize, or_none: bool) -> Result<(), PhysicsError> {
    if found == expected || (or_none && found == 0) {
        return Ok(());
    }
    let or_none = if or_none { " or 0" } else { "" };
    Ok(require(format!("values of the {what}"), false, format!("{expected}{or_none}"), found as f64)?)
}
