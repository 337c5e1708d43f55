use realfft::RealFftPlanner;

/// Share of the energy of `channels` that lies above `hz`, from 0 to 1; 0 for silence.
///
/// Each channel (any length, `rate` samples per second) is one whole Fourier transform without a window, so by
/// Parseval's theorem the shares below and above add up to one. A line exactly at `hz` counts as below.
///
/// ```
/// let tone = |f: f64| (0..480).map(|i| (0.1 + f * f64::from(i) / 48e3 * 6.283185307179586).sin()).collect::<Vec<_>>();
/// let both: Vec<f64> = tone(1000.0).iter().zip(tone(5000.0)).map(|(a, b)| a + 2.0 * b).collect();
/// assert!((unripple_dsp::share_above(&[both], 48e3, 3000.0) - 0.8).abs() < 1e-9);
/// ```
pub fn share_above(channels: &[Vec<f64>], rate: f64, hz: f64) -> f64 {
    let mut planner = RealFftPlanner::<f64>::new();
    let (mut above, mut total) = (0.0, 0.0);
    for channel in channels.iter().filter(|c| !c.is_empty()) {
        let length = channel.len();
        let plan = planner.plan_fft_forward(length);
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
    fn nothing_is_above_in_silence() {
        assert_eq!(share_above(&[], 48e3, 1.0), 0.0);
        assert_eq!(share_above(&[vec![], vec![0.0; 7]], 48e3, 1.0), 0.0);
        assert_eq!(share_above(&[vec![1.0; 8]], 48e3, 1.0), 0.0);
    }
}
