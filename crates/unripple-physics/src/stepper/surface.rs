//! A virtual surface in the time domain: channels, fingers, options.

use super::engine::Engine;
use super::field::Probes;
use super::history::History;
use super::plant::{Channel, Footing, Plant};
use super::run::{Block, Drive, Out, Planes};
use crate::{Modes, PhysicsError};
use std::sync::Arc;
use unripple_core::{Contact, Finger, Point, Pole, Surface, require};

/// How a virtual surface is stepped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepperOptions {
    /// Fingers at once, those that are being lifted included.
    pub max_fingers: usize,
    /// Time that a finger takes to come and to go, in s.
    pub fade: f64,
    /// Time that a finger takes to its next place, in s.
    pub glide: f64,
    /// Steps per sample. Their number matters to loads only: without, one is exact.
    pub substeps: usize,
}

impl Default for StepperOptions {
    fn default() -> Self {
        Self { max_fingers: 4, fade: 8e-3, glide: 5e-3, substeps: 1 }
    }
}

/// The quantity that a probe reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// Velocity, in m/s.
    Velocity,
    /// Displacement, in m.
    Displacement,
}

/// The field at an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Displacement at each point, in m.
    pub displacement: Vec<f64>,
    /// Velocity at each point, in m/s.
    pub velocity: Vec<f64>,
}

/// How a finger moves and what it gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FingerMotion {
    /// How much of it is felt: 0 when just put down, 1 when there.
    pub grip: f64,
    /// Force on the finger over the next step, in N.
    pub force: f64,
    /// Velocity of the sheet under it, in m/s, times its grip.
    pub velocity: f64,
    /// What it has moved by since it came, in m.
    pub displacement: f64,
    /// Power that went into it over the last block, in W: the exact work of its force, dissipated and stored.
    pub power: f64,
}

/// A surface that runs: drive in, sensors and probes out, with fingers on it. See [the module](crate::stepper) for the scheme.
#[derive(Clone, Debug)]
pub struct VirtualSurface {
    /// Modes, loads and fingers in time.
    pub(super) engine: Engine,
    plant: Plant,
    rate: f64,
    tension: f64,
    last: usize,
    history: Option<History>,
}

impl VirtualSurface {
    /// A surface at rest, at `rate` samples per second.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for values that cannot be; [`PhysicsError::Unsupported`] for a channel driven by a voltage
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

    /// A surface with its own actuators, at its own rate, with all of these modes.
    ///
    /// # Errors
    /// Those of [`VirtualSurface::new`] and [`Channel::all`].
    pub fn of(surface: &Surface, modes: Arc<Modes>, options: &StepperOptions) -> Result<Self, PhysicsError> {
        let plant = Plant::of(surface, modes)?;
        Self::new(&plant, &Channel::all(surface)?, surface.emission.rate, options)
    }

    /// The sheet, for another thread to prepare footings with.
    pub fn plant(&self) -> &Plant {
        &self.plant
    }

    /// Sample rate, in samples per second.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Number of channels, each a drive and a sensor.
    pub fn channels(&self) -> usize {
        self.engine.leads.len()
    }

    /// Number of probes, in the order they were set.
    pub fn probes(&self) -> usize {
        self.engine.probes.heard.len()
    }

    /// Number of samples taken in so far.
    pub fn samples(&self) -> u64 {
        self.engine.samples
    }

    /// Listens at these points (m) from now on, instead of any before. Allocates.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a point that is not finite.
    pub fn set_probes(&mut self, probes: &[(Point, Reading)]) -> Result<(), PhysicsError> {
        let rows = probes.iter().map(|(at, _)| Ok(self.plant.footing(*at, 0.0)?.weights));
        let rows: Vec<Vec<f64>> = rows.collect::<Result<_, PhysicsError>>()?;
        let displaced = probes.iter().map(|(_, reading)| *reading == Reading::Displacement).collect();
        self.engine.probes = Probes::new(&rows, displaced);
        Ok(())
    }

    /// Listens elsewhere with some probes, by their number, from now on; the others stay where they are, and cost nothing. Allocates.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a probe that there is not or a point that is not finite; nothing has moved then.
    pub fn move_probes(&mut self, moved: &[(usize, Point)]) -> Result<(), PhysicsError> {
        let count = self.probes();
        let row = |(probe, at): &(usize, Point)| {
            let expected = format!("less than {count}, the number of probes");
            require("probe to be moved", *probe < count, expected, *probe as f64)?;
            Ok((*probe, self.plant.footing(*at, 0.0)?))
        };
        let rows = moved.iter().map(row).collect::<Result<Vec<_>, PhysicsError>>()?;
        rows.iter().for_each(|(probe, footing)| self.engine.probes.place(*probe, &footing.weights));
        Ok(())
    }

    /// Moves a channel on which nothing hangs to another footing, from the next sample on: a tap comes anywhere as drive of
    /// such a channel. Allocates nothing unless it fails.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a channel that there is not or a footing of another sheet; [`PhysicsError::Unsupported`]
    /// for a channel with a load.
    pub fn seat(&mut self, channel: usize, footing: &Footing) -> Result<(), PhysicsError> {
        self.check_footing(footing)?;
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
        self.engine.reseat(lead.port, &footing.weights);
        Ok(())
    }

    /// Takes in so many samples of all channels and gives as many of all sensors and probes. Never allocates.
    ///
    /// All three are planar: the samples of channel 0, then those of channel 1, and so on. A sensor or probe at sample i
    /// already feels the impulse of drive i. `sensors` and `probes` may be empty. How a stretch of time is cut into blocks
    /// changes no result. Drive that is not finite counts as 0.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] if a slice has another length; nothing has happened then.
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

    /// Remembers from now on the state after every `stride`-th sample, the newest so many of them. Allocates.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a stride or number of states of 0, or more states than 2^20.
    pub fn remember(&mut self, stride: usize, states: usize) -> Result<(), PhysicsError> {
        self.history = Some(History::new(self.plant.modes(), stride, states, self.engine.samples)?);
        Ok(())
    }

    /// The states that are remembered, if any are.
    pub fn history(&self) -> Option<&History> {
        self.history.as_ref()
    }

    /// Runs the samples of some planes, checked before.
    pub(super) fn run(&mut self, planes: Planes) {
        let arch = self.engine.arch;
        arch.dispatch(Block { engine: &mut self.engine, planes });
    }

    /// Puts a finger down. It comes within [`StepperOptions::fade`], its spring relaxed at first. Evaluates shapes over its
    /// disc and allocates; [`VirtualSurface::touch_on`] does not.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for values that cannot be, or if there are too many fingers; [`PhysicsError::Unsupported`] if
    /// a finger of that name is down.
    pub fn touch(&mut self, id: u64, contact: &Contact) -> Result<(), PhysicsError> {
        let footing = self.plant.footing(contact.at, contact.finger.contact_radius)?;
        self.touch_on(id, &contact.finger, &footing)
    }

    /// Puts a finger down on a footing made before (one weight per mode). Allocates nothing unless it fails.
    ///
    /// # Errors
    /// Those of [`VirtualSurface::touch`].
    pub fn touch_on(&mut self, id: u64, finger: &Finger, footing: &Footing) -> Result<(), PhysicsError> {
        require("mass of a finger in kg", finger.mass >= 0.0, "0 or more", finger.mass)?;
        require("damping of a finger in N·s/m", finger.damping >= 0.0, "0 or more", finger.damping)?;
        require("stiffness of a finger in N/m", finger.stiffness >= 0.0, "0 or more", finger.stiffness)?;
        self.check_footing(footing)?;
        if self.find(id).is_some() {
            return Err(PhysicsError::Unsupported {
                what: "name of a finger put down",
                expected: "one that is not down",
                found: id.to_string(),
            });
        }
        if self.engine.put(id, *finger, &footing.weights) {
            return Ok(());
        }
        let found = self.engine.touches.len();
        let expected = format!("at most {found}, those that are being lifted included");
        Ok(require("fingers at once", false, expected, found as f64 + 1.0)?)
    }

    /// Moves a finger within [`StepperOptions::glide`]: its contact fades from where it is felt to the new place. Allocates;
    /// [`VirtualSurface::move_onto`] does not.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a place that is not finite, [`PhysicsError::Unsupported`] if no such finger is down.
    pub fn move_to(&mut self, id: u64, at: Point) -> Result<(), PhysicsError> {
        let finger = self.down(id)?;
        let footing = self.plant.footing(at, self.engine.touches[finger].finger.contact_radius)?;
        self.move_onto(id, &footing)
    }

    /// Moves a finger onto a footing made before (one weight per mode). Allocates nothing unless it fails.
    ///
    /// # Errors
    /// Those of [`VirtualSurface::move_to`].
    pub fn move_onto(&mut self, id: u64, footing: &Footing) -> Result<(), PhysicsError> {
        self.check_footing(footing)?;
        let finger = self.down(id)?;
        self.engine.shift(finger, &footing.weights);
        Ok(())
    }

    /// Lifts a finger, which goes within [`StepperOptions::fade`]; its name is free at once. Errors alone allocate.
    ///
    /// # Errors
    /// [`PhysicsError::Unsupported`] if no such finger is down.
    pub fn lift(&mut self, id: u64) -> Result<(), PhysicsError> {
        let finger = self.down(id)?;
        self.engine.touches[finger].lifted = true;
        Ok(())
    }

    /// How a finger that is down moves, and what it gets: force in N, motion in m and m/s, power in W.
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

    /// The tension as a share of the one that the modes were computed for, from the next sample on.
    ///
    /// To first order: `ω² = ω0² (1 + (factor - 1)(1 - share))`, the shapes and decay kept, exact where tension does not
    /// change shapes. Displacement and velocity go on without a jump; small changes from block to block make a smooth
    /// drift. Allocates nothing unless it fails.
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

    /// Displacement and velocity of every mode just after the impulses of the last sample, in m·√kg and √J.
    pub fn state(&self) -> (&[f64], &[f64]) {
        let modes = self.plant.modes();
        let field = &self.engine.field;
        (&field.displacement()[..modes], &field.velocity()[..modes])
    }

    /// The field at any points just after the impulses of the last sample. Allocates.
    pub fn snapshot(&self, points: &[Point]) -> Snapshot {
        let weights = self.plant.shapes.at_all(points);
        let (displacement, velocity) = self.state();
        let read = |state: &[f64]| {
            let value = |p| state.iter().enumerate().map(|(m, x)| weights[(p, m)] * x).sum();
            (0..points.len()).map(value).collect()
        };
        Snapshot { displacement: read(displacement), velocity: read(velocity) }
    }

    /// Energy of the sheet and its loads, in J: kinetic, elastic, magnetic. Without drive only tension lets it grow.
    pub fn energy(&self) -> f64 {
        self.engine.field.energy() + self.engine.bank.energy()
    }

    fn check_footing(&self, footing: &Footing) -> Result<(), PhysicsError> {
        let (found, modes) = (footing.weights.len(), self.plant.modes());
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

/// A typed error unless a slice has the length expected, or is empty where that will do.
pub(super) fn size(what: &str, found: usize, expected: usize, or_none: bool) -> Result<(), PhysicsError> {
    if found == expected || (or_none && found == 0) {
        return Ok(());
    }
    let or_none = if or_none { " or 0" } else { "" };
    Ok(require(format!("values of the {what}"), false, format!("{expected}{or_none}"), found as f64)?)
}
