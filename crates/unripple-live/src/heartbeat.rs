//! The audio thread's loop: samples from the player to the device.

use crate::beats::Beats;
use crate::{Percentiles, Timeline};
use std::sync::Arc;
use std::thread::Thread;
use std::time::Duration;
use unripple_core::clock::Instant;
use unripple_core::{Device, DeviceError, Work};
use unripple_player::Player;

pub(crate) use crate::beats::Overheard;

/// The audio thread's loop: takes blocks from the player and exchanges them with the device.
///
/// In a program whose allocator is `assert_no_alloc::AllocDisabler`, an allocation by the player ends the program.
pub struct Heartbeat {
    /// The player; none while a device that calls has it.
    beats: Option<Box<Beats>>,
    device: Box<dyn Device>,
    timeline: Arc<Timeline>,
    /// Drive, in the actuators' unit, of a sample of 1 of the device.
    scale: f32,
    drive: Vec<f32>,
    sent: Vec<f32>,
    heard: Vec<f32>,
    /// Processor times of the cycles, as far as they are known.
    work: Percentiles,
    heavy: u64,
}

impl Heartbeat {
    /// A loop for a player with blocks of `block` samples and the device that it plays through.
    pub fn new(player: Player, block: usize, device: Box<dyn Device>) -> Self {
        let layout = device.layout();
        let (outputs, inputs) = (layout.outputs.len() * layout.block, layout.inputs.len() * layout.block);
        let (rate, scale) = (layout.rate, layout.full_scale as f32);
        let timeline = Arc::new(Timeline::new(rate));
        let beats = Beats::new(player, (block, layout.outputs.len()), (rate, scale), timeline.clone());
        Self {
            beats: Some(Box::new(beats)),
            device,
            timeline,
            scale,
            drive: vec![0.0; outputs],
            sent: vec![0.0; outputs],
            heard: vec![0.0; inputs],
            work: Percentiles::default(),
            heavy: 0,
        }
    }

    /// Plays one block: the player computes it, the device exchanges it.
    ///
    /// # Errors
    /// Those of [`Device::exchange`]; [`DeviceError::Lost`] while the device itself calls the player.
    pub fn beat(&mut self) -> Result<(), DeviceError> {
        let (block, rate) = (self.device.layout().block, self.device.layout().rate);
        let Some(beats) = &mut self.beats else { return Err(away(self.device.as_ref())) };
        let drive = &mut self.drive;
        beats.fill(block, |output, at, samples| {
            drive[output * block + at..][..samples.len()].copy_from_slice(samples);
        });
        self.sent.iter_mut().zip(&self.drive).for_each(|(to, x)| *to = x / self.scale);
        self.device.exchange(&self.sent, &mut self.heard)?;
        // The next block leaves after the blocks that wait before it.
        let waiting = self.device.status().waiting;
        let leaves = Instant::now() + Duration::from_secs_f64(waiting as f64 / rate);
        beats.mark(beats.position(), leaves, block);
        Ok(())
    }

    /// Hands the player to the device, if it calls by itself ([`Device::install_work`]), with the thread to wake and the
    /// queue to the follower. Returns whether the device took it, and if not, the queue.
    pub(crate) fn lend(&mut self, bell: Thread, overheard: Option<Overheard>) -> (bool, Option<Overheard>) {
        let Some(mut beats) = self.beats.take() else { return (false, overheard) };
        beats.tell(Some(bell), overheard);
        match self.device.install_work(beats) {
            Ok(()) => (true, None),
            Err(work) => {
                self.beats = home(work);
                (false, self.beats.as_mut().and_then(|beats| beats.take_overheard()))
            }
        }
    }

    /// Takes the player back from a device that calls. A device that stands still does not return it; the processor
    /// times are unknown then.
    pub(crate) fn regain(&mut self) {
        if self.beats.is_none() {
            self.beats = self.device.remove_work().and_then(home);
        }
        if let Some(beats) = &mut self.beats {
            beats.tell(None, None);
            (self.work, self.heavy) = (beats.work().clone(), beats.heavy());
        }
    }

    pub(crate) fn device_mut(&mut self) -> &mut dyn Device {
        self.device.as_mut()
    }

    /// The times at which samples leave the device.
    pub(crate) fn timeline(&self) -> &Arc<Timeline> {
        &self.timeline
    }

    /// Drive of the last block, in the actuators' unit, one output after the other.
    pub fn drive(&self) -> &[f32] {
        &self.drive
    }

    /// Recording of the last block, one input after the other.
    pub fn heard(&self) -> &[f32] {
        &self.heard
    }

    /// The device that plays.
    pub fn device(&self) -> &dyn Device {
        self.device.as_ref()
    }

    /// Processor time, in s, that the player took in each cycle of the device.
    pub fn work(&self) -> &Percentiles {
        self.beats.as_ref().map_or(&self.work, |beats| beats.work())
    }

    /// Number of cycles in which the player's processor time exceeded 70 % of the cycle's duration.
    pub fn heavy(&self) -> u64 {
        self.beats.as_ref().map_or(self.heavy, |beats| beats.heavy())
    }
}

/// The player, out of what a device gave back.
fn home(work: Box<dyn Work>) -> Option<Box<Beats>> {
    (work as Box<dyn std::any::Any>).downcast().ok()
}

fn away(device: &dyn Device) -> DeviceError {
    DeviceError::Lost {
        device: device.layout().device.clone(),
        why: "it has not given the player back".into(),
    }
}
