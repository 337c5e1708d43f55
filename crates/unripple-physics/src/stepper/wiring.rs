//! The ports of all channels in the time-domain simulation and of the sheet's resonators, with the housings among them.
//!
//! A housing is a coordinate behind the modes, like a mode of frequency 0, with the weight -1/√M at the port of its spring, damper and
//! coil. So that port has the velocity of the contact relative to the housing, and its force acts on both.
//!
//! The sensor of an exciter records what the motion of the sheet causes, but its drive moves the housing on a sheet that is held still as
//! well. That part is simulated by a twin, the same housing with the same coil, drive and loads, on nothing, and subtracted. Both are
//! stepped alike, so that reciprocity holds to rounding.

use super::bank::Burden;
use super::lead::Lead;
use super::{Channel, Plant};
use crate::{Load, PhysicsError};
use unripple_core::Pole;

/// The ports of all channels, with their loads.
#[derive(Default)]
pub(super) struct Wiring {
    /// Modal weights of the ports, ports without load first; elements missing at the end of a row are zero.
    pub(super) rows: Vec<Vec<f64>>,
    /// Number of ports without load.
    pub(super) plain: usize,
    /// The loads of the ports that have one, in the order of the ports.
    pub(super) burdens: Vec<Burden>,
    /// The port of each channel and its factors for drive and sensor, in channel order.
    pub(super) leads: Vec<Lead>,
    /// Number of housings, those of resonators last; those of exciters have a twin each.
    pub(super) housings: usize,
    /// Poles of the modes, then of the housings, then of the housings' twins.
    pub(super) poles: Vec<Pole>,
}

/// Coordinates of a housing and of its twin, if it has one, by their indices, and the weight of both at their ports.
struct Place {
    housing: usize,
    twin: Option<usize>,
    weight: f64,
}

impl Wiring {
    /// Assigns ports to channels: those without load first, then those of each load; those of resonators last.
    ///
    /// # Errors
    /// Those of [`Channel::check`], and [`PhysicsError::Range`] for a footprint whose weights are not finite.
    pub(super) fn of(plant: &Plant, channels: &[Channel], rate: f64, dt: f64) -> Result<Self, PhysicsError> {
        channels.iter().try_for_each(Channel::check)?;
        let channels: Vec<Channel> = channels.iter().map(|channel| channel.settled(rate)).collect();
        let housing = |channel: &Channel| channel.load.as_ref().and_then(|load| load.housing);
        let twins = channels.iter().filter_map(housing).count();
        let all = twins + plant.loads.iter().filter(|load| load.acts() && load.housing.is_some()).count();
        let mut wiring = Self { plain: channels.iter().filter(|c| struck(c)).count(), ..Self::default() };
        let mut loaded = Vec::new();
        for channel in &channels {
            let mut lead = Lead::of(channel, wiring.rows.len(), rate, dt);
            if struck(channel) {
                wiring.rows.push(plant.weights(&channel.footprint)?);
            }
            if let Some(load) = &channel.load {
                let place = load.housing.map(|housing| {
                    let number = plant.modes() + wiring.housings;
                    Place { housing: number, twin: Some(number + all), weight: housing.weight() }
                });
                wiring.housings += usize::from(place.is_some());
                let weights = plant.weights(&load.footprint)?;
                let port = wiring.hang(load, place.as_ref(), weights, &mut loaded);
                if !struck(channel) {
                    (lead.port, lead.twin) = (port, place.map(|_| port + 1));
                }
            }
            wiring.leads.push(lead);
        }
        for load in plant.loads.iter().filter(|load| load.acts()) {
            let number = plant.modes() + wiring.housings;
            let place =
                load.housing.map(|housing| Place { housing: number, twin: None, weight: housing.weight() });
            wiring.housings += usize::from(place.is_some());
            wiring.hang(load, place.as_ref(), plant.weights(&load.footprint)?, &mut loaded);
        }
        wiring.rows.append(&mut loaded);
        let rigid = std::iter::repeat_n(Pole::new(0.0, 0.0), all + twins);
        wiring.poles = plant.poles.iter().copied().chain(rigid).collect();
        Ok(wiring)
    }

    /// Appends the ports of a load to the rows of `loaded` ports, given the weights of the load's
    /// footprint, one per mode. Returns the port on which a coil acts; the port of the housing's twin, if
    /// any, is the next.
    fn hang(
        &mut self,
        load: &Load,
        place: Option<&Place>,
        weights: Vec<f64>,
        loaded: &mut Vec<Vec<f64>>,
    ) -> usize {
        let [ground, tied] = load.split();
        if let Some(ground) = ground {
            loaded.push(weights.clone());
            self.burdens.push(burden(&ground));
        }
        if let Some((tied, Place { housing, twin, weight })) = tied.zip(place) {
            loaded.push(with(weights, *housing, *weight));
            self.burdens.push(burden(&tied));
            let port = self.plain + loaded.len() - 1;
            if let Some(twin) = twin {
                loaded.push(with(Vec::new(), *twin, *weight));
                self.burdens.push(Burden { twin: true, ..burden(&tied) });
            }
            return port;
        }
        self.plain + loaded.len() - 1
    }
}

/// Whether the drive of a channel acts at a port without load: as a force, where the channel has no load,
/// or a load with another footprint.
fn struck(channel: &Channel) -> bool {
    let apart = |load: &Load| load.housing.is_none() && load.footprint != channel.footprint;
    !channel.voltage && channel.load.as_ref().is_none_or(apart)
}

fn burden(load: &Load) -> Burden {
    let Load { mass, damping, stiffness, circuit, .. } = *load;
    Burden { mass, damping, stiffness, circuit, twin: false }
}

/// A row of weights extended by zeros up to the index `coordinate`, where `weight` is added.
fn with(mut row: Vec<f64>, coordinate: usize, weight: f64) -> Vec<f64> {
    row.resize(coordinate, 0.0);
    row.push(weight);
    row
}
