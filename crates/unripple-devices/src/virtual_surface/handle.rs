//! A handle for manipulating a virtual surface: moves the probe, taps, puts fingers down.

use super::workings::{Workings, lock};
use crate::{DevicesError, Tap};
use std::sync::{Arc, Mutex};
use unripple_core::{Contact, Point, require};
use unripple_physics::stepper::{FingerMotion, History, Plant};

/// A handle for manipulating a virtual surface while another part of the program owns its device: moves the
/// probe, taps, and puts fingers on the surface. Its calls take effect with the next block.
#[derive(Clone, Debug)]
pub struct Handle {
    workings: Arc<Mutex<Workings>>,
}

impl Handle {
    pub(super) fn new(workings: Arc<Mutex<Workings>>) -> Self {
        Self { workings }
    }

    /// Number of samples that have been simulated since the start or the last [`Handle::rest`].
    pub fn samples(&self) -> u64 {
        lock(&self.workings).surface.surface().samples()
    }

    /// Resets the surface to its initial state: at rest, at time 0, without taps or fingers, the probe at
    /// its initial place. The noise of the interface restarts; equal seeds give equal noise.
    pub fn rest(&self, seed: u64) {
        lock(&self.workings).rest(seed);
    }

    /// Moves the probe to another place, in metres.
    ///
    /// # Errors
    /// [`DevicesError::Physics`] for a place that is not finite.
    pub fn move_probe(&self, at: Point) -> Result<(), DevicesError> {
        lock(&self.workings).move_probe(at)
    }

    /// Records the displacement (m) at these places, and no longer at earlier ones, at every `stride`-th
    /// sample from the next block on; [`Handle::watched`] returns the recording, which has neither noise nor
    /// latency.
    ///
    /// # Errors
    /// [`DevicesError::Physics`] for a place that is not finite.
    pub fn watch(&self, places: &[Point], stride: usize) -> Result<(), DevicesError> {
        lock(&self.workings).watch(places, stride)
    }

    /// Moves the places at which displacement is recorded (in m), without changing their number: the
    /// recordings continue, and unchanged places cost nothing. A move takes effect at the next block.
    ///
    /// # Errors
    /// [`DevicesError::Range`] for another number of places, [`DevicesError::Physics`] for one that is not finite; nothing has moved
    /// then.
    pub fn move_watched(&self, places: &[Point]) -> Result<(), DevicesError> {
        let mut workings = lock(&self.workings);
        let (most, found) = (workings.watch.places(), places.len());
        require("places that are watched", found == most, format!("{most}, as before"), found as f64)?;
        workings.move_watched(places)
    }

    /// Returns the displacement (m) recorded since the last call, one trace for each place, and at most the
    /// newest 65536 samples.
    pub fn watched(&self) -> Vec<Vec<f32>> {
        lock(&self.workings).watch.take()
    }

    /// Starts recording the state of all modes after every `stride`-th sample, of which the newest `states`
    /// are stored; [`Handle::history`] reads them, [`Handle::rest`] discards them.
    ///
    /// # Errors
    /// [`DevicesError::Physics`], as [`remember`](unripple_physics::VirtualSurface::remember).
    pub fn remember(&self, stride: usize, states: usize) -> Result<(), DevicesError> {
        Ok(lock(&self.workings).surface.surface_mut().remember(stride, states)?)
    }

    /// Calls `look` with the states recorded by [`Handle::remember`], while the simulation waits; `None` if
    /// nothing is recorded.
    pub fn history<R>(&self, look: impl FnOnce(&History) -> R) -> Option<R> {
        lock(&self.workings).surface.surface().history().map(look)
    }

    /// The modal model of the sheet, to evaluate its modes at any place.
    pub fn plant(&self) -> Plant {
        lock(&self.workings).surface.surface().plant().clone()
    }

    /// Taps at a place (m); the force begins `after` seconds after the start of the next block. The force
    /// acts like that of an actuator, on the sheet with all its loads.
    ///
    /// # Errors
    /// [`DevicesError::Taps`] if more taps would fall into one block than the device was made for, [`DevicesError::Range`]
    /// for a time that is negative or beyond a day, [`DevicesError::Physics`] for a place that is not finite.
    pub fn tap(&self, tap: &Tap, at: Point, after: f64) -> Result<(), DevicesError> {
        require("time until a tap in s", (0.0..=86_400.0).contains(&after), "between 0 and 86400", after)?;
        let mut workings = lock(&self.workings);
        let surface = workings.surface.surface();
        let contact_weights = surface.plant().contact_weights(at, 0.0)?;
        let start = surface.samples() + (after * surface.rate()).round() as u64;
        workings.add(start, tap.force().to_vec(), contact_weights)
    }

    /// Puts a finger with the number `id` on the surface; `contact` specifies its place (m) and its
    /// mechanical load.
    ///
    /// # Errors
    /// [`DevicesError::Physics`], as [`touch`](unripple_physics::VirtualSurface::touch).
    pub fn touch(&self, id: u64, contact: &Contact) -> Result<(), DevicesError> {
        Ok(lock(&self.workings).surface.surface_mut().touch(id, contact)?)
    }

    /// Moves the finger with the number `id` to a place, in metres.
    ///
    /// # Errors
    /// [`DevicesError::Physics`], as [`move_to`](unripple_physics::VirtualSurface::move_to).
    pub fn move_finger(&self, id: u64, to: Point) -> Result<(), DevicesError> {
        Ok(lock(&self.workings).surface.surface_mut().move_to(id, to)?)
    }

    /// Lifts the finger with the number `id`.
    ///
    /// # Errors
    /// [`DevicesError::Physics`], as [`lift`](unripple_physics::VirtualSurface::lift).
    pub fn lift(&self, id: u64) -> Result<(), DevicesError> {
        Ok(lock(&self.workings).surface.surface_mut().lift(id)?)
    }

    /// Displacement, velocity and force of the finger with the number `id`, in m, m/s and N; `None` if it is
    /// not on the surface.
    pub fn finger_motion(&self, id: u64) -> Option<FingerMotion> {
        lock(&self.workings).surface.surface().finger_motion(id)
    }
}
