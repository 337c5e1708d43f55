//! Deconvolution: impulse responses from a stimulus and its recording, with Tikhonov regularisation.

use super::comb::{Comb, CombWork};
use super::transform::Transform;
use super::{Band, Stimulus, same};
use rayon::prelude::*;
use std::f64::consts::TAU;
use unripple_core::OutOfRange;
use unripple_dsp::{Complex, DspError};

/// Options of a deconvolution: band, regularisation, latency, lead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inversion {
    /// Band to which the responses are limited; if `None`, that of the stimulus.
    pub band: Option<Band>,
    /// Regularisation ε, added to the power of the stimulus at each spectral line before dividing by it, relative to
    /// the largest power in the band. The response at a line of power P is too small by about the share ε/P.
    pub regularisation: f64,
    /// Latency of the recording in samples, which may be fractional; it is removed from the responses.
    pub latency: f64,
    /// Number of samples before time 0 with which a response begins.
    pub lead: usize,
}

impl Default for Inversion {
    /// The stimulus's band, 1e-9 (−90 dB), no latency, no lead.
    fn default() -> Self {
        Self { band: None, regularisation: 1e-9, latency: 0.0, lead: 0 }
    }
}

/// A plan for deconvolving recordings of one stimulus into responses.
///
/// With the recording `v[i] = Σ_j h[i-j] d[j] / rate`, spectra V, D of n lines, and the band's weight W, the response
/// is the inverse transform of `rate · W · V D* / (|D|² + ε)`: the band-limited h, without the spectrum of the
/// stimulus. A periodic stimulus is divided over exactly one period, any other over the whole recording, zero after its
/// end; harmonics of a sweep then lie before time 0, at the end of the periodic response.
///
/// Source: A. Farina, AES Convention 122, paper 7121 (2007), section 4 (Kirkeby's regularised inverse); the division is
/// exact where ε is negligible.
///
/// The plan is immutable and can be shared between threads.
///
/// ```
/// use unripple_calibrate::signals::{Deconvolver, Inversion, Sweep};
/// use unripple_dsp::convolve;
///
/// let stimulus = Sweep { seconds: 0.2, ..Sweep::default() }.stimulus()?;
/// let heard = convolve(stimulus.samples(), &[0.0, 0.0, 0.5]); // 0.5 is rate times what one sample answers to another
/// let plan = Deconvolver::new(&stimulus, heard.len(), &Inversion { lead: 10, ..Inversion::default() })?;
/// let mut response = vec![0.0; 20];
/// plan.deconvolve(&heard, &mut response, &mut plan.workspace())?;
/// let largest = (0..20).max_by(|&a, &b| response[a].total_cmp(&response[b]));
/// assert_eq!(largest, Some(12));
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Deconvolver {
    plan: Comb,
    heard: usize,
    rate: f64,
    /// Factors on the spectral lines within the band.
    factors: Vec<Complex<f64>>,
}

/// Workspace of a [`Deconvolver`]; each thread needs its own.
pub struct Workspace(CombWork);

impl Deconvolver {
    /// A plan for deconvolving recordings of `heard` samples.
    ///
    /// # Errors
    /// [`DspError::Size`] if `heard` is not one period of a periodic stimulus, or is shorter than another one;
    /// [`DspError::Range`] for a field of `inversion` out of its range, or a stimulus that is silent in the band.
    pub fn new(stimulus: &Stimulus, heard: usize, inversion: &Inversion) -> Result<Self, DspError> {
        let length = stimulus.samples.len();
        if stimulus.periodic || heard < length {
            same("recorded samples of a stimulus", length, heard)?;
        }
        let plan = if stimulus.periodic { Transform::exact(heard) } else { Transform::smooth(heard) };
        let mut work = plan.work();
        plan.forward(&stimulus.samples, &mut work);
        Self::dividing(&plan, heard, stimulus.rate, &work.lines, inversion, stimulus.band)
    }

    fn dividing(
        plan: &Transform,
        heard: usize,
        rate: f64,
        lines: &[Complex<f64>],
        inversion: &Inversion,
        own: Band,
    ) -> Result<Self, DspError> {
        let band = inversion.band.unwrap_or(own);
        band.check()?;
        for (what, found) in
            [("regularisation", inversion.regularisation), ("latency in samples", inversion.latency.abs())]
        {
            if !(found >= 0.0 && found.is_finite()) {
                return Err(DspError::Range(OutOfRange::new(what, "finite, not negative", found)));
            }
        }
        let weights: Vec<f64> = (0..lines.len()).map(|line| band.weight(plan.hz(line, rate))).collect();
        let inside = || lines.iter().zip(&weights).filter(|(_, weight)| **weight > 0.0);
        let most = inside().map(|(x, _)| x.norm_sqr()).fold(0.0, f64::max);
        super::positive("power of the stimulus in the band", most)?;
        let floor = inversion.regularisation * most;
        let turn = TAU * (inversion.latency - inversion.lead as f64) / plan.size() as f64;
        let factor = |line: usize| {
            let power = lines[line].norm_sqr() + floor;
            let scale = if power > 0.0 { rate * weights[line] / power / plan.size() as f64 } else { 0.0 };
            lines[line].conj() * Complex::from_polar(scale, turn * line as f64)
        };
        let first = weights.iter().position(|w| *w > 0.0).unwrap_or(0);
        let end = weights.iter().rposition(|w| *w > 0.0).map_or(0, |last| last + 1);
        let factors: Vec<_> = (first..end).map(factor).collect();
        Ok(Self { plan: Comb::new(plan.size(), first, end), heard, rate, factors })
    }

    /// Number of samples that each recording must have.
    pub fn heard(&self) -> usize {
        self.heard
    }

    /// Number of samples of a whole response, which is periodic: samples before time 0 are at its end.
    pub fn size(&self) -> usize {
        self.plan.size()
    }

    /// Samples per second.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Creates a workspace for one thread.
    pub fn workspace(&self) -> Workspace {
        Workspace(self.plan.work())
    }

    /// Deconvolves one recording and fills `response` with the first samples of its response. Does not
    /// allocate.
    ///
    /// # Errors
    /// [`DspError::Size`] if `heard` has not the planned length, `response` is longer than [`Deconvolver::size`], or
    /// the workspace is another plan's.
    pub fn deconvolve(
        &self,
        heard: &[f64],
        response: &mut [f64],
        workspace: &mut Workspace,
    ) -> Result<(), DspError> {
        same("recorded samples of a channel", self.heard, heard.len())?;
        same("lines of a workspace", self.factors.len(), workspace.0.band.len())?;
        same("samples of a workspace", self.size(), workspace.0.size())?;
        if response.len() > self.size() {
            same("samples of a response", self.size(), response.len())?;
        }
        let work = &mut workspace.0;
        self.plan.forward(heard, work);
        work.band.iter_mut().zip(&self.factors).for_each(|(line, factor)| *line *= factor);
        self.plan.inverse(work, response);
        Ok(())
    }

    /// Deconvolves many recordings, stored one after another in `heard`, on all threads of the current pool;
    /// `samples` samples of each response are written one after another to `responses`.
    ///
    /// # Errors
    /// [`DspError::Size`] if the slices are not of the same number of whole recordings and responses, or `samples` is 0
    /// or more than [`Deconvolver::size`].
    pub fn deconvolve_all(
        &self,
        heard: &[f64],
        responses: &mut [f64],
        samples: usize,
    ) -> Result<(), DspError> {
        let channels = heard.len() / self.heard.max(1);
        same("recorded samples of all channels", channels * self.heard, heard.len())?;
        same("samples of all responses", channels * samples, responses.len())?;
        if samples == 0 || samples > self.size() {
            same("samples of a response", self.size(), samples)?;
        }
        let rows = responses.par_chunks_mut(samples).zip(heard.par_chunks(self.heard));
        rows.try_for_each_init(
            || self.workspace(),
            |workspace, (response, heard)| self.deconvolve(heard, response, workspace),
        )
    }
}
