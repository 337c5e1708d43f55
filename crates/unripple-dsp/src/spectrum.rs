//! Energy of signals in frequency bands.

use crate::FourierPlanner;

/// Share of the total energy of `channels` that lies above the frequency `hz` (Hz), from 0 to 1; 0 if all
/// samples are zero.
///
/// Each channel (of any length, at `rate` samples per second) is transformed as a whole, without a window, so that by
/// Parseval's theorem the shares below and above add up to one. A bin exactly at `hz` counts as below.
///
/// ```
/// let tone = |f: f64| (0..480).map(|i| (0.1 + f * f64::from(i) / 48e3 * 6.283185307179586).sin()).collect::<Vec<_>>();
/// let both: Vec<f64> = tone(1000.0).iter().zip(tone(5000.0)).map(|(a, b)| a + 2.0 * b).collect();
/// assert!((unripple_dsp::share_above(&[both], 48e3, 3000.0) - 0.8).abs() < 1e-9);
/// ```
pub fn share_above(channels: &[Vec<f64>], rate: f64, hz: f64) -> f64 {
    let mut planner = FourierPlanner::new();
    let (mut above, mut total) = (0.0, 0.0);
    for channel in channels.iter().filter(|c| !c.is_empty()) {
        let length = channel.len();
        let plan = planner.forward(length);
        let mut signal = channel.clone();
        let mut spectrum = plan.make_output_vec();
        if plan.process(&mut signal, &mut spectrum).is_err() {
            continue; // Sizes come from the plan itself.
        }
        for (line, value) in spectrum.iter().enumerate() {
            let alone = line == 0 || 2 * line == length;
            let energy = value.norm_sqr() * if alone { 1.0 } else { 2.0 } / length as f64;
            total += energy;
            if line as f64 * rate / length as f64 > hz {
                above += energy;
            }
        }
    }
    if total > 0.0 { above / total } else { 0.0 }
}

/// Energy of a signal in each of `bands` frequency bands of equal width from 0 to `top` Hz, in the signal's unit squared. Energy
/// above `top` is left out.
///
/// The signal (at `rate` samples per second) is transformed as a whole, without a window; the energies of all bins add up to
/// the sum of the squared samples (Parseval). A bin belongs to the band that contains its frequency, so that bands narrower than
/// the spacing of bins may be empty.
///
/// ```
/// let tone: Vec<f64> = (0..480).map(|i| (f64::from(i) / 48e3 * 1050.0 * 6.283185307179586).sin()).collect();
/// let bands = unripple_dsp::band_energies(&tone, 48e3, 3000.0, 10);
/// let all: f64 = tone.iter().map(|x| x * x).sum();
/// assert!(bands[3] > 0.8 * all && bands.iter().sum::<f64>() <= all * (1.0 + 1e-12));
/// ```
pub fn band_energies(signal: &[f64], rate: f64, top: f64, bands: usize) -> Vec<f64> {
    let mut energies = vec![0.0; bands];
    if signal.is_empty() || bands == 0 {
        return energies;
    }
    let length = signal.len();
    let plan = FourierPlanner::new().forward(length);
    let (mut signal, mut spectrum) = (signal.to_vec(), plan.make_output_vec());
    if plan.process(&mut signal, &mut spectrum).is_err() {
        return energies; // Sizes come from the plan itself.
    }
    for (line, value) in spectrum.iter().enumerate() {
        let alone = line == 0 || 2 * line == length;
        let energy = value.norm_sqr() * if alone { 1.0 } else { 2.0 } / length as f64;
        let band = line as f64 * rate / length as f64 / top * bands as f64;
        if let Some(sum) = energies.get_mut(band as usize) {
            *sum += energy;
        }
    }
    energies
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_impulse_is_white() {
        for length in [64, 63] {
            let mut impulse = vec![0.0; length];
            impulse[3] = -2.0;
            let lines =
                (0..length).filter(|&k| k.min(length - k) as f64 * 100.0 / length as f64 > 20.0).count();
            let share = share_above(&[impulse], 100.0, 20.0);
            assert!((share - lines as f64 / length as f64).abs() < 1e-12, "{length}: {share}");
        }
    }

    #[test]
    fn bands_hold_all_the_energy_below_the_top() {
        let signal: Vec<f64> = (0..97).map(|i| ((i * i) as f64).sin()).collect();
        let below = 1.0 - share_above(std::slice::from_ref(&signal), 100.0, 20.0);
        let all: f64 = signal.iter().map(|x| x * x).sum();
        let bands = band_energies(&signal, 100.0, 20.0, 7);
        assert!((bands.iter().sum::<f64>() / all - below).abs() < 1e-12);
    }

    #[test]
    fn nothing_is_above_in_silence() {
        assert_eq!(share_above(&[], 48e3, 1.0), 0.0);
        assert_eq!(share_above(&[vec![], vec![0.0; 7]], 48e3, 1.0), 0.0);
        assert_eq!(share_above(&[vec![1.0; 8]], 48e3, 1.0), 0.0);
    }
}
