//! Processing of a block of samples in the time-domain simulation.

use super::couplings::Part;
use super::engine::Engine;
use super::field::PortForces;
use super::lanes::total;
use super::small::{OCT, add};
use pulp::{Simd, WithSimd};

/// Number of samples between searches for values so small that they are set to zero: 21 ms at 48 kHz, so
/// that the search costs little. With twice this value, denormal numbers that slow the processor stay up to
/// twice as long.
const SILENCE: u64 = 1024;

/// The inputs and outputs of a number of samples: arrays that hold all samples of one channel or probe,
/// then those of the next, of which a range of samples is processed.
pub(super) struct Planes<'a> {
    /// Number of samples.
    pub(super) frames: usize,
    /// The drive samples of all channels.
    pub(super) drive: Drive<'a>,
    /// The layout in which sensor and probe samples are written.
    pub(super) out: Out,
    /// Samples of all sensors, one sensor after another; empty if not wanted.
    pub(super) sensors: &'a mut [f64],
    /// Samples of all probes, one probe after another; empty if not wanted.
    pub(super) probes: &'a mut [f64],
}

/// The drive samples, one channel after another.
#[derive(Clone, Copy)]
pub(super) struct Drive<'a> {
    /// Samples of all channels, one channel after another.
    pub(super) values: &'a [f64],
    /// Distance in samples from one channel to the next.
    pub(super) stride: usize,
    /// Index, within a channel, of the first sample to process.
    pub(super) first: usize,
}

/// The layout of the sensor and probe samples.
#[derive(Clone, Copy)]
pub(super) struct Out {
    /// Distance in samples from one channel or probe to the next.
    pub(super) stride: usize,
    /// Index, within a channel or probe, of the first sample to process.
    pub(super) first: usize,
}

/// The processing of a block, compiled for the processor's SIMD instructions.
pub(super) struct Block<'a, 'b> {
    /// The state that is advanced.
    pub(super) engine: &'a mut Engine,
    /// Inputs and outputs.
    pub(super) planes: Planes<'b>,
}

impl WithSimd for Block<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Block { engine, mut planes } = self;
        if engine.stale {
            engine.field.look(simd, &engine.tiles, &mut engine.felt);
            engine.sense(simd);
            engine.solve(simd, false);
            engine.stale = false;
        }
        for frame in 0..planes.frames {
            for substep in 0..if engine.samples > 0 { engine.substeps } else { 0 } {
                // Probes read a sample during the next sweep over the modes.
                let heard = (frame > 0 && substep == 0).then(|| frame - 1);
                engine.advance(simd, &mut planes, heard);
                if substep + 1 < engine.substeps {
                    engine.impulse.fill([0.0; OCT]);
                    engine.instant(simd, engine.sharing);
                }
            }
            engine.drive(&planes.drive, frame);
            engine.instant(simd, engine.felt.striking);
            engine.reduce(&mut planes, frame);
            engine.samples += 1;
            if engine.samples % SILENCE == 0 {
                engine.field.silence();
                engine.bank.silence();
            }
        }
        engine.settle(simd, &mut planes);
    }
}

impl Engine {
    /// Advances modes, loads and fingers by one step. Reads the probes for the sample with index `heard`;
    /// with `None`, probes are not read.
    #[inline(always)]
    fn advance<S: Simd>(&mut self, simd: S, planes: &mut Planes, heard: Option<usize>) {
        let columns = self.tiles.columns();
        lay(&self.couplings.parts, self.fixed, self.bank.forces(), &mut self.forces);
        let impulses = if self.pending { &self.impulses[..columns] } else { &[] };
        let laid = PortForces { impulses, forces: &self.forces[self.felt.plain..columns] };
        let heard = heard.filter(|_| !planes.probes.is_empty());
        let probes = heard.is_some().then_some(&mut self.probes);
        self.field.sweep(simd, &self.tiles, &laid, &mut self.felt, probes);
        self.pending = false;
        if let Some(frame) = heard {
            self.write(simd, planes, frame);
        }
        self.bank.advance(simd);
        if self.touches.iter().any(|touch| touch.changes()) {
            self.change(simd);
        }
        self.sense(simd);
    }

    /// Applies pending impulses to the modes after the last sample of a block, and reads the probes for it.
    #[inline(always)]
    fn settle<S: Simd>(&mut self, simd: S, planes: &mut Planes) {
        let listened = !planes.probes.is_empty();
        let impulses = if self.pending { &self.impulses[..self.tiles.columns()] } else { &[] };
        self.field.settle(simd, &self.tiles, impulses, listened.then_some(&mut self.probes));
        self.pending = false;
        if listened {
            self.write(simd, planes, planes.frames - 1);
        }
    }

    /// Writes the readings of the probes for one sample.
    #[inline(always)]
    fn write<S: Simd>(&mut self, simd: S, planes: &mut Planes, frame: usize) {
        let Out { stride, first } = planes.out;
        let heard = self.probes.reduce(simd);
        for (plane, heard) in planes.probes.chunks_exact_mut(stride).zip(heard) {
            plane[first + frame] = *heard;
        }
    }

    /// Takes the motion of the ports from the last pass over the modes: velocity, and displacement over the
    /// next step without forces.
    #[inline(always)]
    fn sense<S: Simd>(&mut self, simd: S) {
        let columns = self.tiles.columns();
        let motion = &self.felt.motion[self.felt.plain..columns];
        total(simd, motion, &mut self.forces[self.felt.plain..]);
        fold(&self.couplings.parts, self.fixed, &self.forces, self.motion.as_flattened_mut());
        if self.felt.striking {
            total(simd, &self.felt.velocity[..columns], &mut self.impulses);
            fold(&self.couplings.parts, self.fixed, &self.impulses, self.velocity.as_flattened_mut());
        }
    }

    /// Applies one drive sample of all channels: impulses on ports and steps of coil currents.
    #[inline(always)]
    fn drive(&mut self, drive: &Drive, frame: usize) {
        self.impulse.fill([0.0; OCT]);
        for (lead, channel) in self.leads.iter().zip(drive.values.chunks_exact(drive.stride)) {
            let value = channel[drive.first + frame];
            let of = |factor: f64| {
                let value = value * factor;
                if value.is_finite() { value } else { 0.0 }
            };
            for port in lead.ports() {
                self.impulse.as_flattened_mut()[port] += of(lead.strike);
                if lead.jump != 0.0 {
                    self.bank.induce(port, of(lead.jump));
                }
            }
        }
    }

    /// Does what happens at one instant: applies impulses, which masses share, then computes the forces of
    /// the next step.
    #[inline(always)]
    fn instant<S: Simd>(&mut self, simd: S, struck: bool) {
        let ports = self.couplings.ports();
        if struck {
            let [momentum, ..] = self.couplings.between();
            momentum.product(simd, &self.impulse.as_flattened()[..ports], &mut self.change);
            add(simd, &mut self.velocity, &self.change);
            if self.sharing {
                let by = (self.couplings.impulses(), momentum);
                let (impulse, change) = self.bank.share(simd, &self.velocity, by, ports);
                add(simd, &mut self.velocity, change);
                add(simd, &mut self.impulse, impulse);
            }
            lay(&self.couplings.parts, self.fixed, self.impulse.as_flattened(), &mut self.impulses);
            self.pending = true;
        }
        self.solve(simd, struck);
    }

    /// Computes the forces of the loads over the next step.
    #[inline(always)]
    fn solve<S: Simd>(&mut self, simd: S, struck: bool) {
        let ports = self.couplings.ports();
        let [_, displaced, push] = self.couplings.between();
        self.free.copy_from_slice(&self.motion);
        if struck {
            displaced.product(simd, &self.impulse.as_flattened()[..ports], &mut self.change);
            add(simd, &mut self.free, &self.change);
        }
        self.bank.solve(simd, &self.free, (self.couplings.forces(), push), ports);
    }

    /// Writes one sample of all sensors.
    #[inline(always)]
    fn reduce(&mut self, planes: &mut Planes, frame: usize) {
        let Out { stride, first } = planes.out;
        for (lead, sensor) in self.leads.iter().zip(planes.sensors.chunks_exact_mut(stride)) {
            let heard = |port: usize| lead.hears(self.velocity.as_flattened()[port], self.bank.driven(port));
            sensor[first + frame] = heard(lead.port) - lead.twin.map_or(0.0, heard);
        }
    }

    /// Advances fingers that are being put down, moved or lifted.
    #[inline(always)]
    fn change<S: Simd>(&mut self, simd: S) {
        let (mut finger, mut other) = (0, false);
        while finger < self.touches.len() {
            let (touch, port) = (&mut self.touches[finger], self.fixed + finger);
            if touch.changes() {
                let moving = touch.moving < 1.0;
                touch.go_on(self.fade, self.glide);
                other |= touch.gone() || (moving && touch.moving >= 1.0);
                if touch.gone() {
                    self.drop_finger(finger);
                    continue;
                }
                self.couplings.parts[port].shares = touch.shares();
                self.couplings.couple(port);
            }
            finger += 1;
        }
        if other {
            self.renew_now(simd);
            self.field.look(simd, &self.tiles, &mut self.felt);
        } else {
            self.couplings.follow(simd, &self.bank);
        }
    }
}

/// Distributes forces or impulses on ports to the columns of the tiles; for the first `fixed` ports, port
/// and column are equal.
#[inline(always)]
fn lay(parts: &[Part], fixed: usize, ports: &[f64], columns: &mut [f64]) {
    columns[..fixed].copy_from_slice(&ports[..fixed]);
    for (part, amount) in parts.iter().zip(ports).skip(fixed) {
        // If both columns are the same, the second share counts.
        for (column, share) in part.columns.iter().zip(part.shares) {
            columns[*column] = share * amount;
        }
    }
}

/// Combines the motion of columns into that of ports.
#[inline(always)]
fn fold(parts: &[Part], fixed: usize, columns: &[f64], ports: &mut [f64]) {
    ports[..fixed].copy_from_slice(&columns[..fixed]);
    for (part, port) in parts.iter().zip(ports).skip(fixed) {
        let [from, to] = part.columns.map(|column| columns[column]);
        *port = part.shares[0] * from + part.shares[1] * to;
    }
}
