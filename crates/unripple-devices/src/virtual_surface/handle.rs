//! A handle on a virtual surface: moves the probe, taps, puts fingers down.

use super::workings::{Workings, lock};
use crate::{DevicesError, Tap};
use std::sync::{Arc, Mutex};
use unripple_core::{Contact, Point, require};
use unripple_physics::stepper::{FingerMotion, History, Plant};

/// A handle on a virtual surface, for use while another part of the program has its device: moves the probe, taps, and puts fingers
/// on it. Its calls take effect with the next block.
#[derive(Clone, Debug)]
pub struct Handle {
    workings: Arc<Mutex<Workings>>,
}

impl Handle {
    pub(super) fn new(workings: Arc<Mutex<Workings>>) -> Self {
        Self { workings }
    }

    /// Number of samples that the surface has been driven with.
    pub fn samples(&self) -> u64 {
        lock(&self.workings).surface.surface().samples()
    }

    /// Resets the surface: at rest as it was made, at time 0, without taps or fingers, the probe at its first place. The noise of the
    /// interface is another for each seed and the same for one.
    pub fn rest(&self, seed: u64) {
        lock(&self.workings).rest(seed);
    }

    /// Puts the probe at another place, in metres.
    ///
    /// # Errors
    /// [`DevicesError::Physics`] for a place that is not finite.
    pub fn move_probe(&self, at: Point) -> Result<(), DevicesError> {
        lock(&self.workings).move_probe(at)
    }

    /// Watches displacement (m) at some places instead of any before, every `stride`-th sample from the next block on;
    /// [`Handle::watched`] returns it. It has neither noise nor latency.
    ///
    /// # Errors
    /// [`DevicesError::Physics`] for a place that is not finite.
    pub fn watch(&self, places: &[Point], stride: usize) -> Result<(), DevicesError> {
        lock(&self.workings).watch(places, stride)
    }

    /// Moves the watched places (in m), as many as there are: their traces go on, and places that stay cost nothing. A move takes
    /// effect at the next block.
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

    /// Displacement (m) watched since this was last called, one trace for each place; the newest 65536 samples at
    /// most.
    pub fn watched(&self) -> Vec<Vec<f32>> {
        lock(&self.workings).watch.take()
    }

    /// Records from now on the state of all modes after every `stride`-th sample, and keeps the newest `states` of them;
    /// [`Handle::history`] reads them. [`Handle::rest`] discards them.
    ///
    /// # Errors
    /// [`DevicesError::Physics`], as [`remember`](unripple_physics::VirtualSurface::remember).
    pub fn remember(&self, stride: usize, states: usize) -> Result<(), DevicesError> {
        Ok(lock(&self.workings).surface.surface_mut().remember(stride, states)?)
    }

    /// Calls `look` with the recorded states, while the surface waits; `None` if nothing is recorded.
    pub fn history<R>(&self, look: impl FnOnce(&History) -> R) -> Option<R> {
        lock(&self.workings).surface.surface().history().map(look)
    }

    /// The modal model of the sheet, to evaluate its modes at any place.
    pub fn plant(&self) -> Plant {
        lock(&self.workings).surface.surface().plant().clone()
    }

    /// Taps at a place (m); the force begins `after` seconds after the start of the next block. It acts like that of an actuator, on
    /// the sheet with all its loads.
    ///
    /// # Errors
    /// [`DevicesError::Taps`] if more taps would fall into one block than the device was made for, [`DevicesError::Range`]
    /// for a time that is negative or beyond a day, [`DevicesError::Physics`] for a place that is not finite.
    pub fn tap(&self, tap: &Tap, at: Point, after: f64) -> Result<(), DevicesError> {
        require("time until a tap in s", (0.0..=86_400.0).contains(&after), "between 0 and 86400", after)?;
        let mut workings = lock(&self.workings);
        let surface = workings.surface.surface();
        let footing = surface.plant().footing(at, 0.0)?;
        let start = surface.samples() + (after * surface.rate()).round() as u64;
        workings.add(start, tap.force().to_vec(), footing)
    }

    /// Puts a finger down, known as `id` from now on; `contact` says where (m) and how it presses.
    ///
    /// # Errors
    /// [`DevicesError::Physics`], as [`touch`](unripple_physics::VirtualSurface::touch).
    pub fn touch(&self, id: u64, contact: &Contact) -> Result<(), DevicesError> {
        Ok(lock(&self.workings).surface.surface_mut().touch(id, contact)?)
    }

    /// Moves a finger to a place in metres.
    ///
    /// # Errors
    /// [`DevicesError::Physics`], as [`move_to`](unripple_physics::VirtualSurface::move_to).
    pub fn move_finger(&self, id: u64, to: Point) -> Result<(), DevicesError> {
        Ok(lock(&self.workings).surface.surface_mut().move_to(id, to)?)
    }

    /// Lifts the finger of this number.
    ///
    /// # Errors
    /// [`DevicesError::Physics`], as [`lift`](unripple_physics::VirtualSurface::lift).
    pub fn lift(&self, id: u64) -> Result<(), DevicesError> {
        Ok(lock(&self.workings).surface.surface_mut().lift(id)?)
    }

    /// Displacement, velocity and force of a finger, in m, m/s and N; `None` for one that is not down.
    pub fn finger_motion(&self, id: u64) -> Option<FingerMotion> {
        lock(&self.workings).surface.surface().finger_motion(id)
    }
}
