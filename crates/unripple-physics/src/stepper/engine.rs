//! The time-stepper: modes advanced by their exact propagator, loads solved implicitly.

use super::bank::Bank;
use super::couplings::{Couplings, Part};
use super::field::{Field, PortSums, Probes};
use super::lanes::{LANES, Rows, Tiles};
use super::lead::Lead;
use super::small::{OCT, Oct, octs};
use super::touch::Touch;
use super::wiring::Wiring;
use super::{Channel, Plant, StepperOptions};
use crate::PhysicsError;
use pulp::{Arch, Simd, WithSimd};
use std::ops::Range;
use unripple_core::{Finger, Pole};

/// The state of modes, loads and fingers, with the tables for stepping them.
///
/// A port is a footprint on the sheet with a row of modal weights. Ports of channels never change and have one row each; fingers
/// have two rows each, for the place they move from and the place they move to.
#[derive(Clone, Debug)]
pub(super) struct Engine {
    /// Displacement and velocity of all modes, followed by those of the housings and of their twins.
    pub(super) field: Field,
    /// Number of modes and housings; the coordinates after them belong to the housings' twins, which are
    /// not part of the surface.
    pub(super) own: usize,
    /// The loads at all ports.
    pub(super) bank: Bank,
    /// The port of each channel and its factors for drive and sensor, in channel order.
    pub(super) leads: Vec<Lead>,
    /// The fingers on the surface, including those being put down or lifted.
    pub(super) touches: Vec<Touch>,
    /// The effect of ports on each other over a step.
    pub(super) couplings: Couplings,
    /// Modal weights of all ports, rows x modes.
    pub(super) weights: Rows,
    /// A copy of the rows of weights in use, in the memory layout for the loop over modes: those of the
    /// fixed ports, then one or two for each finger.
    pub(super) tiles: Tiles,
    /// Forces on the columns of the tiles, in N.
    pub(super) forces: Vec<f64>,
    /// Impulses on the columns of the tiles, in N·s.
    pub(super) impulses: Vec<f64>,
    /// Whether the impulses have still to be applied to the modes.
    pub(super) pending: bool,
    /// Motion of the ports summed over modes, with the number of ports without load, and whether any drive
    /// acts on the sheet as an impulse.
    pub(super) felt: PortSums,
    /// Number of ports that never change; those without load come first.
    pub(super) fixed: usize,
    /// Whether the velocity of any mass changes instantly with an impulse.
    pub(super) sharing: bool,
    free_slots: Vec<usize>,
    fingers: usize,
    /// Length of a step, in s.
    pub(super) dt: f64,
    /// Number of steps per sample.
    pub(super) substeps: usize,
    /// Share of the fade-in or fade-out of a finger's load that passes in one step.
    pub(super) fade: f64,
    /// Share of a finger's movement from one contact to the next that passes in one step.
    pub(super) glide: f64,
    /// Velocity of the ports, in m/s.
    pub(super) velocity: Vec<Oct>,
    /// Displacement of the ports over the next step without forces and impulses, in m.
    pub(super) motion: Vec<Oct>,
    /// Impulses on the ports, in N·s.
    pub(super) impulse: Vec<Oct>,
    /// Scratch: the change of the ports' velocity (m/s) or displacement (m) by impulses.
    pub(super) change: Vec<Oct>,
    /// Displacement of the ports over the next step with impulses but without forces, in m.
    pub(super) free: Vec<Oct>,
    /// The probes, which read velocity or displacement at points.
    pub(super) probes: Probes,
    /// Number of samples processed so far.
    pub(super) samples: u64,
    /// Whether weights or poles have changed since the forces were computed.
    pub(super) stale: bool,
    /// The SIMD instruction set of the processor.
    pub(super) arch: Arch,
}

impl Engine {
    /// An engine at rest for a plant and its channels at `rate` samples per second.
    ///
    /// # Errors
    /// [`PhysicsError::Unsupported`] for a channel driven by a voltage without a coil.
    pub(super) fn new(
        plant: &Plant,
        channels: &[Channel],
        rate: f64,
        options: &StepperOptions,
    ) -> Result<Self, PhysicsError> {
        let dt = 1.0 / (rate * options.substeps as f64);
        let wiring = Wiring::of(plant, channels, rate, dt)?;
        let (fixed, fingers) = (wiring.rows.len(), options.max_fingers);
        let (ports, columns) = (fixed + fingers, fixed + 2 * fingers);
        let striking = wiring.leads.iter().any(Lead::strikes);
        let mut weights = Rows::zeros(fixed + 2 * fingers, wiring.poles.len());
        wiring.rows.iter().enumerate().for_each(|(row, values)| weights.fill(row, values));
        let parts: Vec<Part> =
            (0..fixed).map(|row| Part { rows: [row; 2], columns: [row; 2], shares: [0.0, 1.0] }).collect();
        let mut bank = Bank::new(ports, dt, striking);
        for (i, burden) in wiring.burdens.iter().enumerate() {
            bank.set(wiring.plain + i, burden);
        }
        let share = |time: f64| if time > dt { dt / time } else { 1.0 };
        let zeros = vec![[0.0; OCT]; octs(ports)];
        let mut engine = Self {
            field: Field::new(&wiring.poles, dt),
            own: plant.modes() + wiring.housings,
            sharing: bank.shares(),
            bank,
            leads: wiring.leads,
            touches: Vec::with_capacity(fingers),
            couplings: Couplings::new(fixed + 2 * fingers, ports, &parts),
            weights,
            fixed,
            tiles: Tiles::zeros(columns, wiring.poles.len()),
            forces: vec![0.0; columns],
            impulses: vec![0.0; columns],
            pending: false,
            felt: PortSums {
                motion: vec![[0.0; LANES]; columns],
                velocity: vec![[0.0; LANES]; columns],
                plain: wiring.plain,
                striking,
            },
            free_slots: (0..fingers).rev().collect(),
            fingers,
            dt,
            substeps: options.substeps,
            fade: share(options.fade),
            glide: share(options.glide),
            velocity: zeros.clone(),
            motion: zeros.clone(),
            impulse: zeros.clone(),
            change: zeros.clone(),
            free: zeros,
            probes: Probes::new(&[], Vec::new(), wiring.poles.len()),
            samples: 0,
            stale: true,
            arch: Arch::new(),
        };
        engine.measure(0..fixed);
        Ok(engine)
    }

    /// Updates the tiles, couplings and inverses after a change of ports or of couplings of rows, with SIMD instructions.
    #[inline(always)]
    pub(super) fn renew_now<S: Simd>(&mut self, simd: S) {
        let used = |touch: &Touch| if touch.moving < 1.0 { 2 } else { 1 };
        self.tiles.resize(self.fixed + self.touches.iter().map(used).sum::<usize>());
        (0..self.fixed).for_each(|row| self.tiles.set(row, self.weights.row(row)));
        let mut column = self.fixed;
        for (touch, part) in self.touches.iter().zip(&mut self.couplings.parts[self.fixed..]) {
            part.columns = [column, column + used(touch) - 1];
            for (row, column) in part.rows.into_iter().zip(part.columns) {
                self.tiles.set(column, self.weights.row(row));
            }
            column += used(touch);
        }
        self.couplings.renew(simd, &self.bank);
        self.sharing = self.bank.shares();
    }

    /// Computes the couplings of the given rows of weights with all rows, and updates everything that
    /// depends on these couplings.
    fn measure(&mut self, rows: Range<usize>) {
        let arch = self.arch;
        arch.dispatch(Measure { engine: self, rows });
    }

    /// Replaces the poles of the modes; their displacement and velocity stay as they are.
    pub(super) fn tune(&mut self, poles: impl Iterator<Item = Pole>) {
        self.field.tune(poles, self.dt);
        self.measure(0..self.fixed + 2 * self.fingers);
        self.stale = true;
    }

    /// Puts a finger down, given the weights of its contact, one per mode; returns `false` if the largest
    /// number of fingers is reached.
    pub(super) fn put(&mut self, id: u64, finger: Finger, weights: &[f64]) -> bool {
        let Some(slot) = self.free_slots.pop() else { return false };
        let touch = Touch::new(id, finger, slot);
        let [from, to] = self.ends(slot);
        self.weights.fill(from, &[]);
        self.weights.fill(to, weights);
        let port = self.couplings.ports();
        self.bank.set(port, &touch.burden());
        self.couplings.parts.push(Part { rows: [from, to], columns: [0; 2], shares: [0.0; 2] });
        self.touches.push(touch);
        self.measure(from..to + 1);
        self.stale = true;
        true
    }

    /// Starts the movement of the finger with this index from its present contact to a contact with other
    /// weights, one per mode.
    pub(super) fn shift(&mut self, finger: usize, weights: &[f64]) {
        let touch = self.touches[finger];
        let [from, to] = self.ends(touch.slot);
        for m in 0..weights.len() {
            let end = self.weights.row(to)[m];
            let start = &mut self.weights.row_mut(from)[m];
            *start += touch.moving * (end - *start);
        }
        self.weights.fill(to, weights);
        self.touches[finger].moving = 0.0;
        self.couplings.parts[self.fixed + finger].shares = self.touches[finger].shares();
        self.measure(from..to + 1);
        self.stale = true;
    }

    /// Replaces the weights, one per mode, of the port with this index, which has no load.
    pub(super) fn move_port(&mut self, port: usize, weights: &[f64]) {
        self.weights.fill(port, weights);
        self.measure(port..port + 1);
        self.stale = true;
    }

    /// Removes the finger with this index; [`Engine::renew_now`] must be called afterwards.
    #[cold]
    pub(super) fn drop_finger(&mut self, finger: usize) {
        let port = self.fixed + finger;
        self.bank.remove(port, self.couplings.ports());
        self.couplings.parts.remove(port);
        let touch = self.touches.remove(finger);
        self.free_slots.push(touch.slot);
    }

    /// Indices of the two rows of weights of a finger: for the place it moves from and the place it moves
    /// to.
    pub(super) fn ends(&self, slot: usize) -> [usize; 2] {
        [self.fixed + 2 * slot, self.fixed + 2 * slot + 1]
    }
}

/// The work of [`Engine::measure`], compiled for the processor's SIMD instructions.
struct Measure<'a> {
    engine: &'a mut Engine,
    rows: Range<usize>,
}

impl WithSimd for Measure<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Engine { couplings, weights, field, fixed, fingers, .. } = self.engine;
        // Rows are coupled both ways at once.
        let all = self.rows.len() == *fixed + 2 * *fingers;
        for row in self.rows {
            let others = if all { row + 1 } else { *fixed + 2 * *fingers };
            couplings.measure(simd, row, others, weights, &field.factors);
        }
        self.engine.renew_now(simd);
    }
}
