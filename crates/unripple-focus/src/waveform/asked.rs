//! Requested waveforms, limited to the band, as spectra on the time axis of the drive.

use super::Waveform;
use super::plan::Plan;
use unripple_dsp::Complex;

/// Prescribed motion of the targets: the waveforms limited to the band, as spectra on the time axis of the
/// drive.
#[derive(Debug)]
pub(crate) struct Asked {
    /// Spectrum of each waveform on the time axis of the drive, over the lines of the band.
    spectra: Vec<Vec<Complex<f64>>>,
    /// Share of each waveform's energy, 0 to 1, that lies outside the band.
    pub lost: Vec<f64>,
}

impl Asked {
    /// Computes the spectra of waveforms within the plan's band.
    pub fn new(waveforms: &[Waveform], plan: &Plan) -> Self {
        let (spectra, lost) =
            waveforms.iter().zip(&plan.starts).map(|(w, start)| within(w, *start, plan)).unzip();
        Self { spectra, lost }
    }

    /// Prescribed spectra as `[line][row]`: one row per point of every waveform, then a row of zeros for
    /// each of the `silent` points.
    pub fn rows(&self, waveforms: &[Waveform], silent: usize) -> Vec<Complex<f64>> {
        let sources: Vec<&Vec<Complex<f64>>> = waveforms
            .iter()
            .zip(&self.spectra)
            .flat_map(|(w, own)| w.points.iter().map(move |_| own))
            .collect();
        let lines = self.spectra.first().map_or(0, Vec::len);
        let mut rows = Vec::with_capacity(lines * (sources.len() + silent));
        for line in 0..lines {
            rows.extend(sources.iter().map(|own| own[line]));
            rows.extend((0..silent).map(|_| Complex::default()));
        }
        rows
    }

    /// The band-limited waveforms as signals, times `scale`: targets x samples of the drive.
    pub fn signals(&self, plan: &Plan, scale: f64) -> Vec<Vec<f64>> {
        let signal = |own: &Vec<Complex<f64>>| {
            let mut spectrum = vec![Complex::default(); plan.convolver.size() / 2 + 1];
            spectrum[plan.lines.clone()].copy_from_slice(own);
            let mut signal = plan.convolver.signal(spectrum);
            signal.truncate(plan.taper.len());
            signal.iter_mut().for_each(|x| *x *= scale);
            signal
        };
        self.spectra.iter().map(signal).collect()
    }
}

/// The spectrum of one waveform within the band, and the share of its energy outside the band.
fn within(waveform: &Waveform, start: usize, plan: &Plan) -> (Vec<Complex<f64>>, f64) {
    let silence = std::iter::repeat_n(0.0, start);
    let all = plan.convolver.spectrum(silence.chain(waveform.samples.iter().copied()));
    let kept: Vec<_> = all[plan.lines.clone()].iter().zip(&plan.fade).map(|(x, fade)| x * *fade).collect();
    let energy: f64 = kept.iter().enumerate().map(|(line, x)| plan.multiplicity(line) * x.norm_sqr()).sum();
    let whole = waveform.samples.iter().map(|x| x * x).sum::<f64>() * plan.convolver.size() as f64;
    (kept, if whole > 0.0 { (1.0 - energy / whole).max(0.0) } else { 0.0 })
}
