//! The virtual surface in real time: `cargo bench -p unripple --bench stepper`.

mod common;

use common::machine::{introduce, load, product_rate};
use common::table::{Table, number};
use common::times::Times;
use common::{Fault, Outcome, modal, place, surface};
use std::hint::black_box;
use unripple::core::{Contact, Finger, ModalResponses, Point};
use unripple::physics::stepper::{Channel, Plant, Reading, StepperOptions, VirtualSurface};
use unripple::physics::{Circuit, Footprint, Load};
use unripple_linalg::Par;

/// Modes stepped.
const MODES: usize = 300;

/// Samples of a block.
const BLOCK: usize = 64;

/// Blocks timed.
const BLOCKS: usize = 3000;

fn main() -> Outcome {
    // One core.
    rayon::ThreadPoolBuilder::new().num_threads(1).build()?.install(run)
}

/// What hangs on the sheet.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Force,
    Current,
    Voltage,
}

fn run() -> Outcome {
    let responses = modal(&surface())?;
    introduce(&format!("stepper: {MODES} modes, 8 actuators, 48 kHz, blocks of {BLOCK}"), 1);
    let plant = plant(&responses)?;
    let period = BLOCK as f64 / responses.conditions.rate;
    let peak = product_rate([512, 512, 512], Par::Seq, 1.0_f64);
    let mut table =
        Table::new(["", "fingers", "median µs", "p99 µs", "worst µs", "times real time", "of the product"]);
    let mut row = |name: &str, fingers: u64, times: &Times, flops: f64| {
        table.row([
            name.into(),
            fingers.to_string(),
            number(times.median() * 1e6, 1),
            number(times.quantile(0.99) * 1e6, 1),
            number(times.worst() * 1e6, 1),
            number(period / times.median(), 1),
            format!("{:.0} %", 100.0 * flops / times.median() / peak),
        ]);
    };
    row("ideal forces, plain loops", 0, &plain(&responses)?, arithmetic(Kind::Force, 0.0));
    for (name, kind, fingers, moving, substeps) in [
        ("ideal forces", Kind::Force, 0, false, 1),
        ("ideal forces", Kind::Force, 2, false, 1),
        ("coils, current", Kind::Current, 2, false, 1),
        ("coils, voltage", Kind::Voltage, 0, false, 1),
        ("coils, voltage", Kind::Voltage, 2, false, 1),
        ("  fingers moving all the time", Kind::Voltage, 2, true, 1),
        ("  4 steps a sample", Kind::Voltage, 2, false, 4),
    ] {
        let times = blocks(&plant, &channels(&responses, kind), fingers, moving, substeps)?;
        let columns = fingers as f64 * if moving { 2.0 } else { 1.0 };
        row(name, fingers, &times, arithmetic(kind, columns) * substeps as f64);
    }
    table.print();
    println!("  product: f64, one thread, {:.1} Gflop/s; load after {}", peak / 1e9, load());
    Ok(())
}

/// Operations of a block on the modes alone, with so many columns of weights for fingers.
fn arithmetic(kind: Kind, fingers: f64) -> f64 {
    let loaded = fingers + if kind == Kind::Force { 0.0 } else { 8.0 };
    let struck = if kind == Kind::Voltage { 0.0 } else { 8.0 + fingers };
    let each = 4.0 * loaded + 4.0 * struck + 14.0 + 2.0;
    each * (MODES * BLOCK) as f64
}

/// The same steps without loads, written as one would at first.
fn plain(responses: &ModalResponses) -> Result<Times, Fault> {
    let dt = 1.0 / responses.conditions.rate;
    let row = |at: Point| {
        let mut row = vec![0.0; responses.poles.len()];
        responses.shapes.at(at, &mut row);
        row.truncate(MODES);
        row
    };
    let ports: Vec<Vec<f64>> = responses.ports.iter().map(|port| row(port.at)).collect();
    let (probe, mut u, mut v) = (row(place(7)), vec![0.0; MODES], vec![0.0; MODES]);
    let steps: Vec<[[f64; 2]; 2]> = responses.poles[..MODES].iter().map(|pole| pole.step(dt)).collect();
    let drive: Vec<f64> = (0..8 * BLOCK).map(|i| ((i * 7919) % 101) as f64 / 50.0 - 1.0).collect();
    let (mut sensors, mut probes) = (vec![0.0; 8 * BLOCK], vec![0.0; BLOCK]);
    Ok(Times::of(BLOCKS, |_| {
        for frame in 0..BLOCK {
            for ((u, v), [a, b]) in u.iter_mut().zip(&mut v).zip(&steps) {
                (*u, *v) = (a[0] * *u + a[1] * *v, b[0] * *u + b[1] * *v);
            }
            for (channel, weights) in ports.iter().enumerate() {
                sensors[channel * BLOCK + frame] = weights.iter().zip(&v).map(|(w, v)| w * v).sum();
            }
            for (channel, weights) in ports.iter().enumerate() {
                let impulse = drive[channel * BLOCK + frame] * dt;
                v.iter_mut().zip(weights).for_each(|(v, w)| *v += w * impulse);
            }
            probes[frame] = probe.iter().zip(&v).map(|(w, v)| w * v).sum();
        }
        black_box((&sensors, &probes));
    }))
}

fn plant(responses: &ModalResponses) -> Result<Plant, Fault> {
    #[derive(Debug)]
    struct First(std::sync::Arc<dyn unripple::core::Shapes>);
    impl unripple::core::Shapes for First {
        fn modes(&self) -> usize {
            MODES
        }
        fn at(&self, point: Point, row: &mut [f64]) {
            let mut all = vec![0.0; self.0.modes()];
            self.0.at(point, &mut all);
            row.copy_from_slice(&all[..MODES]);
        }
    }
    let shapes = std::sync::Arc::new(First(responses.shapes.clone()));
    Ok(Plant::new(&responses.poles[..MODES], shapes, responses.conditions.outline.clone())?)
}

fn channels(responses: &ModalResponses, kind: Kind) -> Vec<Channel> {
    let channel = |at: Point| {
        let footprint = Footprint::point(at);
        let coil = Circuit { force_constant: 6.0, resistance: 6.2, inductance: 1.9e-3 };
        let circuit = (kind == Kind::Voltage).then_some(coil);
        let load = Load {
            footprint: footprint.clone(),
            mass: 1e-4,
            damping: 0.0,
            stiffness: 0.0,
            circuit,
            housing: None,
        };
        let gain = if kind == Kind::Current { 6.0 } else { 1.0 };
        Channel {
            footprint,
            gain,
            load: (kind != Kind::Force).then_some(load),
            voltage: kind == Kind::Voltage,
        }
    };
    responses.ports.iter().map(|port| channel(port.at)).collect()
}

fn blocks(
    plant: &Plant,
    channels: &[Channel],
    fingers: u64,
    moving: bool,
    substeps: usize,
) -> Result<Times, Fault> {
    let options = StepperOptions { substeps, ..StepperOptions::default() };
    let mut surface = VirtualSurface::new(plant, channels, 48e3, &options)?;
    surface.set_probes(&[(place(7), Reading::Velocity)])?;
    let drive: Vec<f64> = (0..8 * BLOCK).map(|i| ((i * 7919) % 101) as f64 / 50.0 - 1.0).collect();
    let (mut sensors, mut probes) = (vec![0.0; 8 * BLOCK], vec![0.0; BLOCK]);
    for id in 0..fingers {
        surface.touch(id, &Contact { at: place(id as usize), finger: Finger::default() })?;
    }
    for _ in 0..20 {
        surface.process(BLOCK, &drive, &mut sensors, &mut probes)?;
    }
    let contacts = [plant.contact_weights(place(20), 5e-3)?, plant.contact_weights(place(21), 5e-3)?];
    Ok(Times::of(BLOCKS, |i| {
        if moving {
            for id in 0..fingers {
                black_box(surface.move_onto(id, &contacts[(i + id as usize) % 2]).is_ok());
            }
        }
        black_box(surface.process(BLOCK, black_box(&drive), &mut sensors, &mut probes).is_ok());
        black_box((&sensors, &probes));
    }))
}
