//! Drives scaled to their peak and rms limits.

use crate::magnitude::{energy, peak};

/// Scales all channels (actuators x samples) down by one factor, so that their peak and the rms of each stay
/// within limits in the drive's unit. Returns the factor, 1 if no limit was exceeded.
pub(crate) fn hold(channels: &mut [Vec<f64>], limit: f64, rms_limit: Option<f64>) -> f64 {
    let highest = channels.iter().map(|channel| peak(channel)).fold(0.0, f64::max);
    let rms = |channel: &Vec<f64>| (energy(channel) / channel.len().max(1) as f64).sqrt();
    let strongest = channels.iter().map(rms).fold(0.0, f64::max);
    let scale = |most: f64, found: f64| if found > most { most / found } else { 1.0 };
    let scale = rms_limit.map_or(1.0, |most| scale(most, strongest)).min(scale(limit, highest));
    if scale < 1.0 {
        channels.iter_mut().flatten().for_each(|d| *d *= scale);
    }
    scale
}
