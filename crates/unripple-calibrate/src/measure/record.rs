//! Signals played and recorded through a device, block by block.

use crate::CalibrateError;
use unripple_core::Device;

/// Number of blocks of silence played before a recording, by whose end a device has counted the blocks that
/// it lost in a pause.
pub const SILENCE: usize = 8;

/// Plays signals on some outputs of a device and returns the recordings of some inputs.
///
/// [`SILENCE`] blocks come first and are not returned, for devices that count blocks lost in a pause only
/// when they run again. `drive[i]` is sent to output `outputs[i]`, in the unit of the actuators' drive, and
/// silence to all other outputs; after its end, silence is sent until `samples` have passed. The result is
/// `[input][sample]`, of `samples` samples or a few more, to the end of a block.
///
/// # Errors
/// [`CalibrateError::Device`] from the device; [`CalibrateError::Gap`] if it lost blocks meanwhile, so that the recording
/// has a gap.
pub fn record(
    device: &mut dyn Device,
    outputs: &[usize],
    drive: &[Vec<f64>],
    inputs: &[usize],
    samples: usize,
) -> Result<Vec<Vec<f64>>, CalibrateError> {
    let layout = device.layout().clone();
    let (block, scale) = (layout.block, layout.full_scale);
    let mut sent = vec![0.0_f32; layout.outputs.len() * block];
    let mut heard = vec![0.0_f32; layout.inputs.len() * block];
    for _ in 0..SILENCE {
        device.exchange(&sent, &mut heard)?;
    }
    let before = device.status().lost;
    let mut answer = vec![Vec::with_capacity(samples + block); inputs.len()];
    for first in (0..samples).step_by(block.max(1)) {
        for (signal, output) in drive.iter().zip(outputs) {
            for (i, sample) in sent[output * block..][..block].iter_mut().enumerate() {
                *sample = signal.get(first + i).map_or(0.0, |x| (x / scale) as f32);
            }
        }
        device.exchange(&sent, &mut heard)?;
        for (answer, input) in answer.iter_mut().zip(inputs) {
            answer.extend(heard[input * block..][..block].iter().map(|x| f64::from(*x)));
        }
    }
    let lost = device.status().lost - before;
    if lost > 0 { Err(CalibrateError::Gap { device: layout.device, lost }) } else { Ok(answer) }
}
