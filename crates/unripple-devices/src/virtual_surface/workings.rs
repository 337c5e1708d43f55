//! The parts of a virtual device: simulation, taps, converters.

use super::watch::{self, Watch};
use crate::DevicesError;
use crate::interface::Converter;
use std::sync::{Mutex, MutexGuard};
use unripple_core::{Layout, Point};
use unripple_physics::stepper::{ContactWeights, FaultySurface};

/// The parts of a virtual device.
#[derive(Debug)]
pub(super) struct Workings {
    pub(super) surface: FaultySurface,
    pub(super) watch: Watch,
    /// Initial place of the probe.
    first_probe: Point,
    converter: Converter,
    /// Initial state of surface and converter.
    first: (FaultySurface, Converter),
    block: usize,
    outputs: usize,
    slots: Vec<Slot>,
    /// Buffers of one block, a plane for each channel: drives, with those of taps last; sensors, with those of taps last;
    /// the probe and the watched places; the device's inputs.
    drive: Vec<f64>,
    sensors: Vec<f64>,
    probes: Vec<f64>,
    heard: Vec<f64>,
}

/// A spare channel of the simulation, for taps that do not overlap in time.
#[derive(Clone, Debug, Default)]
struct Slot {
    /// Taps under way or to come, by their start.
    strikes: Vec<Strike>,
}

/// A tap at its place and time.
#[derive(Clone, Debug)]
struct Strike {
    start: u64,
    force: Vec<f64>,
    contact_weights: ContactWeights,
    placed: bool,
}

impl Strike {
    fn end(&self) -> u64 {
        self.start + self.force.len() as u64
    }
}

impl Workings {
    pub(super) fn new(
        surface: FaultySurface,
        converter: Converter,
        layout: &Layout,
        taps: usize,
        probe: Point,
    ) -> Self {
        let (block, outputs) = (layout.block, layout.outputs.len());
        let planes = vec![0.0; (outputs + taps) * block];
        let heard = vec![0.0; layout.inputs.len() * block];
        let slots = vec![Slot::default(); taps];
        let first = (surface.clone(), converter.clone());
        Self {
            surface,
            watch: Watch::default(),
            first_probe: probe,
            converter,
            first,
            block,
            outputs,
            slots,
            drive: planes.clone(),
            sensors: planes,
            probes: vec![0.0; block],
            heard,
        }
    }

    /// Resets surface and interface; equal seeds give equal noise.
    pub(super) fn rest(&mut self, seed: u64) {
        (self.surface, self.converter) = self.first.clone();
        self.converter.reseed(seed);
        self.slots.fill(Slot::default());
        self.watch = Watch::default();
        self.probes.resize(self.block, 0.0);
    }

    /// Puts the probe at a place.
    pub(super) fn move_probe(&mut self, at: Point) -> Result<(), DevicesError> {
        self.surface.surface_mut().move_probes(&[(watch::PROBE, at)])?;
        self.watch.set_probe(at);
        Ok(())
    }

    /// Records the displacement at these places, and no longer at earlier ones, at every `stride`-th sample.
    pub(super) fn watch(&mut self, places: &[Point], stride: usize) -> Result<(), DevicesError> {
        let probe = self.watch.probe();
        let watch = Watch::new(places, stride, probe);
        let probes = watch.probes(probe.unwrap_or(self.first_probe));
        self.surface.surface_mut().set_probes(&probes)?;
        self.probes.resize(probes.len() * self.block, 0.0);
        self.watch = watch;
        Ok(())
    }

    /// Moves the recorded places without changing their number. Unchanged places cost nothing.
    pub(super) fn move_watched(&mut self, places: &[Point]) -> Result<(), DevicesError> {
        self.surface.surface_mut().move_probes(&self.watch.moves(places))?;
        self.watch.set_places(places);
        Ok(())
    }

    /// Blocks lost so far.
    pub(super) fn lost(&self) -> u64 {
        self.surface.lost() as u64
    }

    /// Passes one block through converters, faults and surface; an error is the reason why no more blocks
    /// can pass.
    pub(super) fn exchange(
        &mut self,
        layout: &Layout,
        blocks: u64,
        drive: &[f32],
        heard: &mut [f32],
    ) -> Result<(), String> {
        if self.converter.vanished(blocks) {
            return Err(format!("it vanished after {blocks} blocks"));
        }
        let wired = self.outputs * self.block;
        self.converter.send(layout, drive, &mut self.drive[..wired]);
        self.strike().map_err(|error| error.to_string())?;
        let lost = self.surface.lost();
        self.surface
            .process(self.block, &self.drive, &mut self.sensors, &mut self.probes)
            .map_err(|error| error.to_string())?;
        let (probe, watched) = self.probes.split_at(self.block);
        self.watch.keep(watched, self.block);
        let (to_probe, to_force) = self.heard[wired..].split_at_mut(self.block);
        to_force.fill(0.0);
        match self.surface.lost() > lost {
            true => to_probe.fill(0.0),
            false => {
                to_probe.copy_from_slice(probe);
                // The planes of all taps, if there is an input for their force.
                for plane in self.drive[wired..].chunks_exact(self.block) {
                    to_force.iter_mut().zip(plane).for_each(|(to, force)| *to += force);
                }
            }
        }
        self.heard[..wired].copy_from_slice(&self.sensors[..wired]);
        self.converter.hear(self.block, &mut self.heard);
        heard.iter_mut().zip(&self.heard).for_each(|(to, from)| *to = *from as f32);
        Ok(())
    }

    /// Puts the forces of the taps in this block on the spare channels.
    fn strike(&mut self) -> Result<(), DevicesError> {
        let (now, block) = (self.surface.surface().samples(), self.block as u64);
        let planes = self.drive[self.outputs * self.block..].chunks_exact_mut(self.block);
        for (index, (slot, plane)) in self.slots.iter_mut().zip(planes).enumerate() {
            plane.fill(0.0);
            slot.strikes.retain(|strike| strike.end() > now);
            let Some(strike) = slot.strikes.first_mut().filter(|s| s.start < now + block) else { continue };
            if !strike.placed {
                self.surface.surface_mut().move_channel(self.outputs + index, &strike.contact_weights)?;
                strike.placed = true;
            }
            for (i, to) in plane.iter_mut().enumerate() {
                let from = (now + i as u64).checked_sub(strike.start);
                *to = from.and_then(|at| strike.force.get(at as usize)).copied().unwrap_or(0.0);
            }
        }
        Ok(())
    }

    /// Adds a tap that starts at a sample to a slot that is free at that time.
    pub(super) fn add(
        &mut self,
        start: u64,
        force: Vec<f64>,
        contact_weights: ContactWeights,
    ) -> Result<(), DevicesError> {
        let strike = Strike { start, force, contact_weights, placed: false };
        let block = self.block as u64;
        // A slot has one place within a block.
        let span = |s: &Strike| s.start / block..=s.end() / block;
        let (first, last) = (*span(&strike).start(), *span(&strike).end());
        let apart = |other: &Strike| *span(other).end() < first || last < *span(other).start();
        let most = self.slots.len();
        let free = self.slots.iter_mut().find(|slot| slot.strikes.iter().all(apart));
        let slot = free.ok_or(DevicesError::Taps { most })?;
        slot.strikes.push(strike);
        slot.strikes.sort_by_key(|strike| strike.start);
        Ok(())
    }
}

/// The surface behind its lock, even if another thread panicked while it held it.
pub(super) fn lock(workings: &Mutex<Workings>) -> MutexGuard<'_, Workings> {
    workings.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}
