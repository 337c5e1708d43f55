//! A million samples of the paper's film, simulated in blocks of 64: `cargo run --release -p unripple-devices --example stepping --
//! [SAMPLES] [BLOCK]`. Prints the processor time in seconds, beside which `python/benches/stepping.py` puts that of the same from Python.

use rustix::time::{ClockId, clock_gettime};
use std::hint::black_box;
use unripple_core::{Device, Random};
use unripple_devices::{Virtual, VirtualOptions};
use unripple_physics::design::papers_surface;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |usual: usize| arguments.next().map_or(Ok(usual), |text| text.parse());
    let (samples, block) = (number(1_000_000)?, number(64)?);
    let film = papers_surface();
    let options = VirtualOptions { block, ..VirtualOptions::to_be_measured(&film)? };
    let mut device = Virtual::new(&film, &options)?;
    let (outputs, inputs) = (device.layout().outputs.len(), device.layout().inputs.len());
    let mut random = Random::seeded(1);
    let drive: Vec<f32> = (0..outputs * block).map(|_| random.between(-1.0, 1.0) as f32).collect();
    let mut heard = vec![0.0; inputs * block];
    let began = now();
    for _ in 0..samples / block {
        device.exchange(black_box(&drive), &mut heard)?;
        black_box(&heard);
    }
    println!("{}", now() - began);
    Ok(())
}

/// Processor seconds of this thread.
fn now() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}
