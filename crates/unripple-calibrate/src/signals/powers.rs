//! Power of a signal in frequency bands.

use super::transform::Transform;
use std::f64::consts::PI;

/// Mean square of a signal in each of some bands, from a lower to an upper frequency (Hz), by a Hann window
/// whose loss of power is compensated; `rate` is in samples per second. A band narrower than a spectral line
/// gets a share of the nearest line's power in proportion to the part of the line's width that it covers.
///
/// ```
/// let tone: Vec<f64> = (0..4800).map(|i| (f64::from(i) * 0.1309).sin()).collect();
/// let powers = unripple_calibrate::signals::band_powers(&tone, 48e3, &[[450.0, 560.0], [900.0, 1120.0], [1800.0, 2240.0]]);
/// assert!((powers[1] - 0.5).abs() < 0.01 && powers[0] < 1e-4 && powers[2] < 1e-4);
/// ```
pub fn band_powers(signal: &[f64], rate: f64, bands: &[[f64; 2]]) -> Vec<f64> {
    let length = signal.len();
    if length < 2 {
        return vec![0.0; bands.len()];
    }
    let plan = Transform::smooth(length);
    let mut work = plan.work();
    let window = |i: usize| 1.0 - (2.0 * PI * (i as f64 + 0.5) / length as f64).cos();
    let power: f64 = (0..length).map(|i| window(i).powi(2)).sum();
    let seen: Vec<f64> = signal.iter().enumerate().map(|(i, x)| x * window(i)).collect();
    plan.forward(&seen, &mut work);
    let scale = 1.0 / (power * plan.size() as f64);
    let own = |line: usize| scale * plan.copies(line) * work.lines[line].norm_sqr();
    let width = rate / plan.size() as f64;
    bands
        .iter()
        .map(|band| {
            let [low, high] = band.map(|hz| hz / width);
            let last = work.lines.len() - 1;
            let [first, end] =
                [low - 0.5, high + 0.5].map(|x| x.max(0.0).round() as usize).map(|x| x.min(last));
            // A line represents the frequencies around it: the share of them within the band counts.
            let share = |k: usize| ((k as f64 + 0.5).min(high) - (k as f64 - 0.5).max(low)).clamp(0.0, 1.0);
            (first..=end).map(|k| share(k) * own(k)).sum()
        })
        .collect()
}
