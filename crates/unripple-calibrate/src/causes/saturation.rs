//! Amplifiers that saturate: what a louder recording has less than a quieter one, and the level at which the drive was clipped.

use super::agreement::Agreement;
use super::lines::Spectrum;
use super::model::Model;
use unripple_dsp::Complex;

/// Number of clipping levels that are tried, from the peak of the drive down to a twentieth of it. The level is known to half
/// a step; more would cost more.
const STEPS: usize = 20;

/// Amplitude of the difference between a recording and a quieter one scaled up to it, as a share of the recording's;
/// `level` is the quieter level over the louder one.
pub(super) fn nonlinearity(full: &[Spectrum], quiet: &[Spectrum], level: f64) -> f64 {
    let (mut off, mut total) = (0.0, 0.0);
    for (full, quiet) in full.iter().flatten().zip(quiet.iter().flatten()) {
        off += (full - quiet / level).norm_sqr();
        total += full.norm_sqr();
    }
    if total > 0.0 { f64::sqrt(off / total) } else { 0.0 }
}

/// The largest magnitude to which the drive was clipped, in its unit, that explains the recordings best, and the agreement;
/// at the peak of the drive nothing is clipped.
pub(super) fn search(model: &Model, heard: &[Spectrum], drive: &[Vec<f64>]) -> (f64, Agreement) {
    let peak = drive.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let at = |n: usize| {
        let most = peak * n as f64 / STEPS as f64;
        let clipped = |line: &Vec<f64>| {
            let clipped: Vec<f64> = line.iter().map(|x| x.clamp(-most, most)).collect();
            model.lines().plain(&clipped)
        };
        let sent: Vec<Vec<Complex<f64>>> = drive.iter().map(clipped).collect();
        (most, Agreement::of(model.lines(), heard, &model.predict(&sent, 1.0)))
    };
    let tried = (1..=STEPS).rev().map(at);
    tried.min_by(|a, b| a.1.left.total_cmp(&b.1.left)).unwrap_or((peak, Agreement::default()))
}
