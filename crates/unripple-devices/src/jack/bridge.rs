//! A device that runs as a JACK client, so that a virtual surface can replace a sound card.

use super::library::{Client, Cycle, Process};
use crate::DevicesError;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use unripple_core::{Device, require};

/// A device that runs as a client of a JACK server: to other clients, a virtual surface then looks like a
/// sound card with the surface connected to it. For tests and experiments.
///
/// The client receives drive on ports `in_NAME`, one for each output of the device, and sends on `out_NAME`,
/// one for each input; [`Links::Client`](super::Links::Client) connects to them. The server's own thread
/// exchanges the blocks, so that a slow device delays the server: while the server freewheels nothing is
/// lost, otherwise cycles may be.
///
/// ```no_run
/// use unripple_devices::{Bridge, DevicesError, Virtual, VirtualOptions};
///
/// # fn run(surface: &unripple_core::Surface) -> Result<(), DevicesError> {
/// let device = Virtual::new(surface, &VirtualOptions { block: 256, ..Default::default() })?;
/// let bridge = Bridge::start(Box::new(device), "surface", None)?;
/// assert_eq!(bridge.faults(), 0);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Bridge {
    client: Client,
    faults: Arc<AtomicU64>,
}

impl Bridge {
    /// Runs a device as a client called `name` on the named server, or on the default one.
    ///
    /// # Errors
    /// [`DevicesError::Jack`] if there is no library or server or it refuses; [`DevicesError::Size`] if the device's block is not
    /// the server's period; [`DevicesError::Range`] if its rate is not the server's.
    pub fn start(device: Box<dyn Device>, name: &str, server: Option<&str>) -> Result<Self, DevicesError> {
        let layout = device.layout().clone();
        let mut client = Client::open(name, server)?;
        crate::error::same("samples of a block, against the server's period", layout.block, client.period())?;
        let rate = client.rate();
        let expected = format!("{rate}, the server's");
        require("sample rate in Hz", layout.rate == rate, expected, layout.rate)?;
        layout.outputs.iter().try_for_each(|name| client.add(&format!("in_{name}"), true))?;
        layout.inputs.iter().try_for_each(|name| client.add(&format!("out_{name}"), false))?;
        let faults = Arc::new(AtomicU64::new(0));
        let [drive, heard] =
            [&layout.outputs, &layout.inputs].map(|names| vec![0.0; names.len() * layout.block]);
        let inputs = layout.inputs.len();
        let worker = Worker { device, block: layout.block, inputs, drive, heard, faults: faults.clone() };
        client.start(Box::new(worker))?;
        Ok(Self { client, faults })
    }

    /// Number of cycles in which no block was exchanged, since the device was lost or the server's period
    /// had changed.
    pub fn faults(&self) -> u64 {
        self.faults.load(Ordering::Relaxed)
    }

    /// Name of the client, as assigned by the server.
    pub fn name(&self) -> String {
        self.client.name()
    }
}

/// The state of the server's thread.
struct Worker {
    device: Box<dyn Device>,
    block: usize,
    inputs: usize,
    drive: Vec<f32>,
    heard: Vec<f32>,
    faults: Arc<AtomicU64>,
}

impl Process for Worker {
    fn cycle(&mut self, cycle: &mut Cycle) {
        let fits = cycle.frames() == self.block;
        if fits {
            for (output, plane) in self.drive.chunks_exact_mut(self.block).enumerate() {
                plane.iter_mut().zip(cycle.input(output)).for_each(|(to, x)| *to = *x);
            }
        }
        let passed = fits && self.device.exchange(&self.drive, &mut self.heard).is_ok();
        if !passed {
            self.faults.fetch_add(1, Ordering::Relaxed);
            (0..self.inputs).for_each(|input| cycle.output(input).fill(0.0));
            return;
        }
        for (input, plane) in self.heard.chunks_exact(self.block).enumerate() {
            cycle.output(input).iter_mut().zip(plane).for_each(|(to, x)| *to = *x);
        }
    }
}
