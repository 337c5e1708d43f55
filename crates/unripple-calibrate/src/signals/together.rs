//! Deconvolution of recordings of several stimuli together.

use super::transform::Transform;
use super::{Band, positive, same};
use realfft::num_complex::Complex;
use unripple_core::OutOfRange;
use unripple_dsp::DspError;

/// A plan that turns recordings, one of each of several stimuli, into the response that explains them all best.
///
/// With spectra V_i of the recordings and D_i of the stimuli, and the band's weight W, the response is the inverse transform of
/// `rate · W · Σ V_i D_i* / (Σ |D_i|² + ε)`: least squares at each spectral line, so that what one stimulus excites little is taken from
/// the others. For a single stimulus that is what [`Deconvolver`](super::Deconvolver) does.
///
/// ```
/// use unripple_calibrate::signals::{Band, Together};
/// use unripple_dsp::convolve;
///
/// // Neither of two taps alone tells all: the spectrum of the first is zero at half the rate, that of the second at 0.
/// let taps = [vec![1.0, 1.0], vec![1.0, -1.0]];
/// let plan = Together::new(&taps, 8, 48e3, Band::ALL, 1e-9)?;
/// let heard = taps.each_ref().map(|tap| {
///     let mut heard = convolve(tap, &[0.5, -0.25]);
///     heard.resize(8, 0.0);
///     heard
/// });
/// let mut response = plan.deconvolve(&heard.each_ref().map(|heard| &heard[..]))?;
/// response.truncate(2);
/// let rate = 48e3; // what a sample answers to another is the response over the rate
/// assert!(response.iter().zip([0.5, -0.25]).all(|(found, h)| (found / rate - h).abs() < 1e-6));
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Together {
    plan: Transform,
    heard: usize,
    /// Factors of the spectral lines of each recording.
    factors: Vec<Vec<Complex<f64>>>,
}

impl Together {
    /// A plan for recordings of `heard` samples of these stimuli, at `rate` samples per second, limited to a band. `regularisation` is ε
    /// over the largest Σ |D_i|² in the band.
    ///
    /// # Errors
    /// [`DspError::Size`] if a stimulus is longer than `heard`; [`DspError::Range`] for a rate that is not positive, a regularisation that is
    /// negative or not finite, edges of the band that do not ascend, or stimuli that are silent in the band or not finite.
    pub fn new(
        stimuli: &[Vec<f64>],
        heard: usize,
        rate: f64,
        band: Band,
        regularisation: f64,
    ) -> Result<Self, DspError> {
        positive("samples per second", rate)?;
        band.check()?;
        if !(regularisation >= 0.0 && regularisation.is_finite()) {
            return Err(DspError::Range(OutOfRange::new(
                "regularisation",
                "finite, not negative",
                regularisation,
            )));
        }
        if let Some(long) = stimuli.iter().map(Vec::len).find(|length| *length > heard) {
            same("recorded samples of a stimulus", long, heard)?;
        }
        let plan = Transform::smooth(heard);
        let mut work = plan.work();
        let mut spectrum = |stimulus: &Vec<f64>| {
            plan.forward(stimulus, &mut work);
            work.lines.clone()
        };
        let mut factors: Vec<Vec<Complex<f64>>> = stimuli.iter().map(&mut spectrum).collect();
        let lines = plan.size() / 2 + 1;
        let weight = |line: usize| band.weight(plan.hz(line, rate));
        let powers: Vec<f64> =
            (0..lines).map(|line| factors.iter().map(|spectrum| spectrum[line].norm_sqr()).sum()).collect();
        let most = (0..lines).filter(|line| weight(*line) > 0.0).map(|line| powers[line]).fold(0.0, f64::max);
        positive("power of the stimuli in the band", most)?;
        for line in 0..lines {
            let power = powers[line] + regularisation * most;
            let scale = if power > 0.0 { rate * weight(line) / power / plan.size() as f64 } else { 0.0 };
            factors.iter_mut().for_each(|spectrum| spectrum[line] = spectrum[line].conj() * scale);
        }
        Ok(Self { plan, heard, factors })
    }

    /// The response, as long as a recording, that explains one recording of each stimulus best.
    ///
    /// # Errors
    /// [`DspError::Size`] for another number of recordings than stimuli, or recordings of another length than planned.
    pub fn deconvolve(&self, heard: &[&[f64]]) -> Result<Vec<f64>, DspError> {
        same("recordings of stimuli", self.factors.len(), heard.len())?;
        let mut work = self.plan.work();
        let mut sum = vec![Complex::default(); work.lines.len()];
        for (heard, factors) in heard.iter().zip(&self.factors) {
            same("recorded samples of a channel", self.heard, heard.len())?;
            self.plan.forward(heard, &mut work);
            let lines = work.lines.iter().zip(factors);
            sum.iter_mut().zip(lines).for_each(|(sum, (line, factor))| *sum += line * factor);
        }
        work.lines = sum;
        self.plan.inverse(&mut work);
        work.signal.truncate(self.heard);
        Ok(work.signal)
    }
}
