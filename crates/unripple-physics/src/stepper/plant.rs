//! The sheet for the time-domain simulation (poles, mode shapes, outline), and its channels.

use crate::{
    Entry, Footprint, Load, Loaded, Medium, Modes, PhysicsError, Transducer, resonators, transducers,
};
use std::f64::consts::PI;
use std::sync::Arc;
use unripple_core::{ModalResponses, Onset, Outline, Point, Pole, Shapes, Surface, require};
use unripple_linalg::Mat;
use unripple_plates::decay_rate;

/// Highest frequency of the modes that [`Plant::with_residual_compliance`] adds, relative to half the sample rate: faster
/// modes would alias. At 1, they would alternate from sample to sample.
const FASTEST: f64 = 0.9;

/// The sheet for the time-domain simulation: poles and shapes of its modes, its outline, and the resonators on it. It is cheap to
/// clone, so that another thread can compute [`ContactWeights`].
#[derive(Clone, Debug)]
pub struct Plant {
    /// The pole of each mode.
    pub(super) poles: Arc<[Pole]>,
    /// Share of bending in each mode's elastic energy, 0 to 1.
    pub(super) bending_shares: Arc<[f64]>,
    /// Mode shapes at any point, in 1/√kg.
    pub(super) shapes: Arc<dyn Shapes>,
    /// The outline of the sheet; contact discs are cut off at its boundary.
    pub(super) outline: Arc<Outline>,
    /// Loads that belong to the sheet and to no channel: resonators.
    pub(super) loads: Arc<[Load]>,
}

/// A channel of the simulation: one drive and one sensor signal at a contact on the sheet, with its load.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// The contact over which the channel acts on the sheet and senses its motion.
    pub footprint: Footprint,
    /// Force per unit of drive (N per unit), or volts per unit of drive if [`Channel::voltage`] is set. The
    /// sensor signal is multiplied by the same factor.
    pub gain: f64,
    /// Load on the sheet that belongs to the channel; `None` for none.
    pub load: Option<Load>,
    /// Whether the drive is the voltage of the load's coil. If so, the sensor signal is the current j that
    /// only the motion drives through the coil, L dj/dt + R j = bl·v, in A, without the current that the
    /// drive causes in a coil at rest. If not, it is the sheet's velocity v times the gain. With a housing,
    /// v is the velocity relative to the housing, without the part that the drive causes on a sheet that is
    /// held still.
    pub voltage: bool,
}

/// The values of all modes averaged over a contact disc on the sheet, computed by [`Plant::contact_weights`]:
/// another thread can compute them, so that the real-time thread need not.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactWeights {
    /// One average per mode, in 1/√kg.
    pub(super) per_mode: Vec<f64>,
}

impl Plant {
    /// A sheet with these poles (for unit modal mass) and mode shapes, within an outline.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] if a frequency or decay rate is negative or not finite, or if the numbers of poles and shapes differ;
    /// [`PhysicsError::Unsupported`] for poles whose onset is not [`Onset::Velocity`].
    pub fn new(poles: &[Pole], shapes: Arc<dyn Shapes>, outline: Outline) -> Result<Self, PhysicsError> {
        let (count, found) = (poles.len() as f64, shapes.modes() as f64);
        require("shapes of the modes", found == count, format!("{count}, one for each pole"), found)?;
        for pole in poles {
            require("frequency of a mode in rad/s", pole.omega >= 0.0, "0 or more", pole.omega)?;
            require("decay rate of a mode in 1/s", pole.sigma >= 0.0, "0 or more", pole.sigma)?;
            if pole.onset != Onset::Velocity {
                return Err(PhysicsError::Unsupported {
                    what: "modes to step through time",
                    expected: "those of a sheet without loads, which impulses strike",
                    found: format!("one of {} rad/s that impulses move", pole.omega),
                });
            }
        }
        Ok(Self {
            poles: poles.into(),
            bending_shares: vec![0.0; poles.len()].into(),
            shapes,
            outline: Arc::new(outline),
            loads: Arc::new([]),
        })
    }

    /// A sheet with the given modes of a surface, with its resonators and without other loads.
    ///
    /// # Errors
    /// Those of [`Plant::new`] and [`resonators`].
    pub fn of(surface: &Surface, modes: Arc<Modes>) -> Result<Self, PhysicsError> {
        let (poles, shares) = (modes.poles().to_vec(), modes.bending_shares().to_vec());
        let plant = Self::new(&poles, modes, surface.outline.clone())?.with_bending_shares(&shares)?;
        Ok(Self { loads: resonators(surface)?.into(), ..plant })
    }

    /// A sheet with the given modes of a surface, its resonators and, if these or actuators load it, the residual
    /// compliance of higher modes at these loads ([`Loaded::with_rest`]), so that the compliance at the loads is
    /// accurate even with few modes. If an added mode would be too fast for `rate` samples per second, none is
    /// added.
    ///
    /// # Errors
    /// Those of [`Plant::new`] and [`transducers`].
    pub fn with_residual_compliance(
        surface: &Surface,
        modes: Arc<Modes>,
        rate: f64,
    ) -> Result<Self, PhysicsError> {
        let transducers = transducers(surface)?;
        let bare = Self::of(surface, modes.clone())?;
        let top = modes.poles().iter().map(|pole| pole.omega).fold(0.0, f64::max);
        let (sheet, medium) = (&surface.sheet, Medium::of(&surface.sheet));
        let poles = modes.poles().to_vec();
        let loaded = Loaded::new(modes.clone(), &poles, &transducers, &bare.loads)?.with_rest(
            medium,
            medium.wavenumber(top),
            sheet.thickness,
            |omega, k| decay_rate(&sheet.decay, omega, medium.bending_share(k)),
        )?;
        let (poles, shapes) = loaded.sheet();
        let added = &poles[modes.poles().len()..];
        if added.iter().any(|pole| pole.omega > FASTEST * PI * rate) {
            return Ok(bare);
        }
        let still = Medium { air_sides: 0.0, ..medium };
        let share = |pole: &Pole| medium.bending_share(still.wavenumber(pole.omega)).clamp(0.0, 1.0);
        let shares: Vec<f64> =
            modes.bending_shares().iter().copied().chain(added.iter().map(share)).collect();
        let plant =
            Self::new(poles, shapes.clone(), surface.outline.clone())?.with_bending_shares(&shares)?;
        Ok(Self { loads: bare.loads, ..plant })
    }

    /// A sheet with the poles and shapes of modal responses.
    ///
    /// # Errors
    /// Those of [`Plant::new`].
    pub fn of_responses(responses: &ModalResponses) -> Result<Self, PhysicsError> {
        Self::new(&responses.poles, responses.shapes.clone(), responses.conditions.outline.clone())
    }

    /// Sets the share of bending in each mode's elastic energy (0 to 1), by default 0: changes of tension
    /// act on the remaining share only.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a share outside 0 to 1, or if there is not one for each mode.
    pub fn with_bending_shares(self, shares: &[f64]) -> Result<Self, PhysicsError> {
        let (found, count) = (shares.len() as f64, self.poles.len() as f64);
        require("bending shares of the modes", found == count, format!("{count}, one for each pole"), found)?;
        for share in shares {
            require("bending share of a mode", (0.0..=1.0).contains(share), "between 0 and 1", *share)?;
        }
        Ok(Self { bending_shares: shares.into(), ..self })
    }

    /// The values of all modes averaged over a contact disc of some radius (m) at a place (m), or at the
    /// nearest point of the sheet. Takes the time of about eighty evaluations of the shapes and allocates,
    /// so it must not be called on the real-time thread.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] if the place or the radius is not finite, or the radius negative.
    pub fn contact_weights(&self, at: Point, radius: f64) -> Result<ContactWeights, PhysicsError> {
        require("x of a contact in m", true, "a finite number", at.x)?;
        require("y of a contact in m", true, "a finite number", at.y)?;
        require("radius of a contact in m", radius >= 0.0, "0 or more", radius)?;
        let at = if self.outline.contains(at) { at } else { self.outline.nearest(at) };
        Ok(ContactWeights { per_mode: self.weights(&Footprint::disc(at, radius, &self.outline))? })
    }

    /// Mode shapes at points (m), in 1/√kg: points x modes.
    pub fn readout(&self, points: &[Point]) -> Mat<f64> {
        self.shapes.at_all(points)
    }

    /// Number of modes of the sheet.
    pub fn modes(&self) -> usize {
        self.poles.len()
    }

    /// Mode shapes averaged over a footprint, one value per mode, in 1/√kg; an error if one is not finite.
    pub(super) fn weights(&self, footprint: &Footprint) -> Result<Vec<f64>, PhysicsError> {
        let weights = footprint.weights(&*self.shapes);
        for weight in &weights {
            require("weight of a mode in 1/√kg", true, "a finite number", *weight)?;
        }
        Ok(weights)
    }
}

impl From<Transducer> for Channel {
    fn from(transducer: Transducer) -> Self {
        let Transducer { footprint, gain, entry, load, .. } = transducer;
        match entry {
            Entry::Force => Self { footprint, gain, load, voltage: false },
            // The force per ampere is in the load's coil already.
            Entry::Voltage => Self { footprint, gain: 1.0, load, voltage: true },
        }
    }
}

impl Channel {
    /// A channel whose drive is a force (in N) over a footprint and whose sensor signal is the velocity there (m/s).
    pub fn force(footprint: Footprint) -> Self {
        Self { footprint, gain: 1.0, load: None, voltage: false }
    }

    /// The channels of all actuators of a surface, in the order of the actuators.
    ///
    /// # Errors
    /// Those of [`transducers`].
    pub fn all(surface: &Surface) -> Result<Vec<Self>, PhysicsError> {
        Ok(transducers(surface)?.into_iter().map(Self::from).collect())
    }

    /// Returns this channel, with its coil's inductance set to zero if the current follows the voltage
    /// within far less than a sample.
    pub(super) fn settled(&self, rate: f64) -> Self {
        let mut channel = self.clone();
        if let Some(coil) = channel.load.as_mut().and_then(|load| load.circuit.as_mut())
            && coil.resistance > 1e12 * coil.inductance * rate
        {
            coil.inductance = 0.0;
        }
        channel
    }

    /// Refuses a gain that is not finite, a load that is not passive, and a voltage without a coil.
    pub(super) fn check(&self) -> Result<(), PhysicsError> {
        require("gain of a channel", true, "a finite number", self.gain)?;
        if let Some(load) = &self.load {
            load.check()?;
        }
        if self.voltage && self.load.as_ref().is_none_or(|load| load.circuit.is_none()) {
            return Err(PhysicsError::Unsupported {
                what: "load of a channel driven by a voltage",
                expected: "a coil",
                found: "none".into(),
            });
        }
        Ok(())
    }
}
