use crate::Percentiles;
use assert_no_alloc::assert_no_alloc;
use rustix::time::{ClockId, clock_gettime};
use std::sync::Arc;
use unripple_core::{Device, DeviceError};
use unripple_player::{Meters, Player};

/// The share of a block's time from which on the load is too high to be safe.
const HEAVY: f32 = 0.7;

/// The audio thread's work: one block out of the player and through the device.
///
/// In a program whose allocator is `assert_no_alloc::AllocDisabler`, an allocation by the player ends the program.
pub struct Heartbeat {
    player: Player,
    device: Box<dyn Device>,
    meters: Arc<Meters>,
    /// One sample of the device is so much drive.
    scale: f32,
    drive: Vec<f32>,
    sent: Vec<f32>,
    heard: Vec<f32>,
    work: Percentiles,
    heavy: u64,
}

impl Heartbeat {
    /// A player before a device.
    pub fn new(player: Player, device: Box<dyn Device>, meters: Arc<Meters>) -> Self {
        let layout = device.layout();
        let (outputs, inputs) = (layout.outputs.len() * layout.block, layout.inputs.len() * layout.block);
        let scale = layout.full_scale as f32;
        Self {
            player,
            device,
            meters,
            scale,
            drive: vec![0.0; outputs],
            sent: vec![0.0; outputs],
            heard: vec![0.0; inputs],
            work: Percentiles::default(),
            heavy: 0,
        }
    }

    /// One block: the player's, then the device's.
    ///
    /// # Errors
    /// Those of [`Device::exchange`].
    pub fn beat(&mut self) -> Result<(), DeviceError> {
        let before = thread_time();
        assert_no_alloc(|| self.player.process(&mut self.drive));
        let taken = thread_time() - before;
        self.work.add(taken);
        let layout = self.device.layout();
        let load = (taken * layout.rate / layout.block as f64) as f32;
        self.meters.set_load(load);
        self.heavy += u64::from(load > HEAVY);
        self.sent.iter_mut().zip(&self.drive).for_each(|(to, x)| *to = x / self.scale);
        self.device.exchange(&self.sent, &mut self.heard)
    }

    /// What was driven in the last block, in the actuators' unit, one output after the other.
    pub fn drive(&self) -> &[f32] {
        &self.drive
    }

    /// What was heard in the last block.
    pub fn heard(&self) -> &[f32] {
        &self.heard
    }

    /// What plays.
    pub fn device(&self) -> &dyn Device {
        self.device.as_ref()
    }

    /// Processor time of the player's part of each block, in s.
    pub fn work(&self) -> &Percentiles {
        &self.work
    }

    /// Blocks that took more than 70 % of their time.
    pub fn heavy(&self) -> u64 {
        self.heavy
    }
}

/// Processor time of this thread, in s.
fn thread_time() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
