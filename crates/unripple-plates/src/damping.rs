//! Damping laws: decay rate of a mode as a function of its frequency (quality factor Q = ω/2σ).

use unripple_core::Decay;

/// Amplitude decay rate σ = 1/τ of a mode, in 1/s, due to the damping of the sheet.
///
/// `omega` is the mode's angular frequency (rad/s), `bending_share` the share of bending in its elastic energy. With a loss
/// factor η only bending dissipates: σ = η · share · ω/2. Tables of decay times are interpolated linearly in frequency.
pub fn decay_rate(decay: &Decay, omega: f64, bending_share: f64) -> f64 {
    match decay {
        Decay::Time(time) => 1.0 / time,
        Decay::Table(table) => 1.0 / interpolate(table, omega / std::f64::consts::TAU),
        Decay::LossFactor(eta) => eta * bending_share * omega / 2.0,
    }
}

/// The decay time (s) from a table at a frequency (Hz): linear between entries, constant below the first
/// and above the last; infinite for an empty table.
fn interpolate(table: &[(f64, f64)], hz: f64) -> f64 {
    let above = table.partition_point(|(f, _)| *f <= hz);
    match (above.checked_sub(1).and_then(|i| table.get(i)), table.get(above)) {
        (Some((f0, t0)), Some((f1, t1))) => t0 + (t1 - t0) * (hz - f0) / (f1 - f0),
        (Some((_, t)), None) | (None, Some((_, t))) => *t,
        (None, None) => f64::INFINITY,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn reads_tables_between_and_beyond() {
        let table = Decay::Table(vec![(100.0, 0.1), (300.0, 0.05)]);
        for (hz, time) in [(10.0, 0.1), (100.0, 0.1), (200.0, 0.075), (300.0, 0.05), (9e3, 0.05)] {
            assert!((decay_rate(&table, TAU * hz, 1.0) * time - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_plate_of_loss_factor_eta_has_quality_one_over_eta() {
        let sigma = decay_rate(&Decay::LossFactor(0.02), 1000.0, 1.0);
        // Q = ω/2σ.
        assert!((1000.0 / (2.0 * sigma) - 50.0).abs() < 1e-12);
    }
}
