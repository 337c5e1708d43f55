//! Harmonic distortion from a synchronized exponential sweep (Novak et al. 2015).

use super::cut::cut;
use super::transform::Transform;
use super::{Band, Gate, Sweep, positive, same, shift};
use unripple_core::OutOfRange;
use unripple_dsp::DspError;

/// Settings for separating the harmonics of a sweep in a deconvolved recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// Sample of the recording from which the linear response is taken, `lead` samples before its time 0: 0, or
    /// the actuator's start in a schedule.
    pub start: usize,
    /// Number of samples before time 0 with which every response begins.
    pub lead: usize,
    /// Length of every response, in samples; those of harmonics are shorter if the next lower order follows
    /// sooner.
    pub window: usize,
    /// Highest order of harmonics that is separated.
    pub highest_order: usize,
    /// The band to which the deconvolution was limited; if `None`, that of the sweep.
    pub band: Option<Band>,
}

/// The response of a channel at one harmonic of the drive.
#[derive(Clone, Debug, PartialEq)]
pub struct Harmonic {
    /// Order of the harmonic, from 2.
    pub order: usize,
    /// Response at the harmonic, aligned with the linear response.
    pub response: Vec<f64>,
    /// Amplitude relative to the linear response, rms over the drive's frequencies whose harmonic lies in the band too.
    pub ratio: f64,
}

impl Harmonic {
    /// Level of the harmonic relative to the linear response, in dB.
    pub fn level_db(&self) -> f64 {
        20.0 * self.ratio.log10()
    }
}

/// The linear response of a channel and those at harmonics of the drive, separated by their times.
///
/// The m-th harmonic of an exponential sweep is the sweep itself, earlier by `L ln m` with L the sweep's
/// [growth](Sweep::growth): its response precedes the linear one by that time. Noise counts as distortion
/// where it is stronger. If windows are longer than the time between orders, the tail of a higher order is
/// counted as part of the next lower one; a slower sweep separates them.
///
/// Source: A. Farina, AES Convention 108, paper 5093 (2000), section 3; A. Novak et al., J. Audio Eng. Soc. 63 (2015),
/// eq. 26-33.
///
/// ```
/// use unripple_calibrate::signals::{Deconvolver, Harmonics, Inversion, Split, Sweep};
///
/// let sweep = Sweep { seconds: 0.4, silence: 0.1, rate: 24e3, ..Sweep::default() };
/// let stimulus = sweep.stimulus()?;
/// let cubic: Vec<f64> = stimulus.samples().iter().map(|x| x + 0.04 * x * x * x).collect();
/// let plan = Deconvolver::new(&stimulus, cubic.len(), &Inversion { lead: 300, ..Inversion::default() })?;
/// let mut whole = vec![0.0; plan.size()];
/// plan.deconvolve(&cubic, &mut whole, &mut plan.workspace())?;
/// let split = Split { start: 0, lead: 300, window: 1000, highest_order: 3, band: None };
/// let harmonics = Harmonics::of(&whole, &sweep, &split)?;
/// assert!((harmonics.orders[1].ratio - 0.01 / 1.03).abs() < 1e-4); // x³ holds a quarter of the third harmonic
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Harmonics {
    /// The linear response, from `lead` samples before time 0 on.
    pub linear: Vec<f64>,
    /// The harmonics in ascending order, from the second on.
    pub orders: Vec<Harmonic>,
}

impl Harmonics {
    /// Separates the responses in `deconvolved`, all samples of the deconvolved recording of `sweep`.
    ///
    /// # Errors
    /// [`DspError::Size`] if the window is empty or longer than the deconvolution; [`DspError::Range`] if the highest order
    /// is below 2 or none of it lies in the band, the band's edges do not ascend, or the linear response is silent.
    pub fn of(deconvolved: &[f64], sweep: &Sweep, split: &Split) -> Result<Self, DspError> {
        let band = split.band.unwrap_or(Band::within(sweep.from, sweep.to));
        band.check()?;
        positive("samples per second", sweep.rate)?;
        positive("seconds in which the sweep grows", sweep.growth())?;
        if split.window == 0 || split.window > deconvolved.len() {
            same("samples of a response", deconvolved.len(), split.window)?;
        }
        let flat = [band.low[1].max(sweep.from * EDGE), band.high[0].min(sweep.to / EDGE)];
        let most = (flat[1] / flat[0]).ceil() - 1.0;
        if split.highest_order < 2 || split.highest_order as f64 > most {
            return Err(DspError::Range(OutOfRange::new(
                "highest order of harmonics",
                format!("2 to {most}"),
                split.highest_order as f64,
            )));
        }
        let response = |order: usize| Self::response(deconvolved, sweep, split, order);
        let power =
            |signal: &[f64], low: f64, high: f64| power(signal, split.window, sweep.rate, [low, high]);
        let linear = response(1);
        let orders = (2..=split.highest_order).map(|order| {
            let (response, times) = (response(order), order as f64);
            let reference = power(&linear, flat[0], flat[1] / times);
            positive("power of the linear response", reference)?;
            // The harmonic's lines are spread over a band as many times as wide as its order.
            let ratio = (power(&response, flat[0] * times, flat[1]) / (times * reference)).sqrt();
            Ok(Harmonic { order, response, ratio })
        });
        let orders = orders.collect::<Result<Vec<_>, DspError>>()?;
        Ok(Self { linear, orders })
    }

    /// The response of an order (1 for the linear response), aligned with the linear response.
    fn response(deconvolved: &[f64], sweep: &Sweep, split: &Split, order: usize) -> Vec<f64> {
        let lead = sweep.lead(order) * sweep.rate;
        let gap = if order > 1 { lead - sweep.lead(order - 1) * sweep.rate } else { f64::INFINITY };
        let length = (gap.floor() as usize).clamp(1, split.window);
        let (whole, begin) = (lead.ceil(), split.start as f64);
        let mut response = vec![0.0; length];
        cut(deconvolved, (begin - whole) as i64, &mut response);
        if order > 1 {
            let edge = split.lead.min(length / 2) as f64;
            let gate = Gate {
                begin: 0.0,
                rise: edge / 2.0,
                end: length as f64,
                fall: (length as f64 / 16.0).min(edge),
            };
            gate.apply(&mut response);
            response = shift(&response, lead - whole);
        }
        response
    }

    /// Amplitude of each harmonic of the drive, from the second, relative to the drive, if the drive alone
    /// is nonlinear: its harmonics then have the linear response at their own frequencies. `None` for a
    /// harmonic that does not exceed noise and earlier ringing. `noise` is an interval, of any length, of
    /// the deconvolved recording without any response; `decay` is the amplitude decay time of the ringing,
    /// in s.
    pub fn of_drive(
        &self,
        deconvolved: &[f64],
        sweep: &Sweep,
        split: &Split,
        noise: &[f64],
        decay: f64,
    ) -> Vec<Option<f64>> {
        let band = split.band.unwrap_or(Band::within(sweep.from, sweep.to));
        let flat = [band.low[1].max(sweep.from * EDGE), band.high[0].min(sweep.to / EDGE)];
        let one = |harmonic: &Harmonic| {
            let within = [flat[0] * harmonic.order as f64, flat[1]];
            let lead = (sweep.lead(harmonic.order) * sweep.rate).ceil() as i64;
            let gap = lead as f64 - sweep.lead(harmonic.order - 1) * sweep.rate;
            // The end of the gap holds the beginning of the next order, which the band begins early.
            let length = ((SHARE * gap) as usize).clamp(1, split.window);
            let power = |first: i64| {
                let mut signal = vec![0.0; length];
                cut(deconvolved, first, &mut signal);
                gated(&mut signal, split.lead);
                power(&signal, split.window, sweep.rate, within)
            };
            let begin = split.start as i64;
            let [linear, own, before] = [begin, begin - lead, begin - lead - length as i64].map(power);
            let mut noise = noise.to_vec();
            noise.truncate(split.window);
            let stretch = noise.len() as f64;
            gated(&mut noise, split.lead);
            let noise = self::power(&noise, split.window, sweep.rate, within) * length as f64 / stretch;
            let left = (-2.0 * length as f64 / sweep.rate / decay).exp();
            let known = noise + left * (before - noise).max(0.0);
            // Relative scatter of the two powers, from their numbers of independent values.
            let width = (within[1] - within[0]).max(0.0) / sweep.rate;
            let scatter = (1.0 / (width * length as f64) + 1.0 / (width * stretch)).sqrt();
            let told = own > known * (1.0 + SURE * scatter).max(TOLD);
            (told && linear > 0.0).then(|| ((own - known) / linear).sqrt())
        };
        self.orders.iter().map(one).collect()
    }

    /// Total harmonic distortion, as a ratio of amplitudes: the root of all harmonics' power over that of
    /// the linear response.
    pub fn distortion(&self) -> f64 {
        self.orders.iter().map(|harmonic| harmonic.ratio.powi(2)).sum::<f64>().sqrt()
    }

    /// The total harmonic distortion in dB.
    pub fn distortion_db(&self) -> f64 {
        20.0 * self.distortion().log10()
    }
}

/// Smallest power of a harmonic, relative to its background, at which it counts as present.
const TOLD: f64 = 2.0;

/// Number of standard deviations by which a harmonic has to stand out of its background.
const SURE: f64 = 6.0;

/// Share of the time from one order to the next that is used. The remainder holds the beginning of the next
/// order, which the band limit makes earlier.
const SHARE: f64 = 0.75;

/// Fades a signal in and out over the lead, so that its cut ends do not spread in frequency.
fn gated(signal: &mut [f64], lead: usize) {
    let (length, edge) = (signal.len() as f64, lead.min(signal.len() / 2) as f64);
    Gate { begin: 0.0, rise: edge / 2.0, end: length, fall: edge }.apply(signal);
}

/// Ratio of frequencies over which a sweep fades in and out at its ends, where amplitudes are smaller than
/// elsewhere.
const EDGE: f64 = 1.1;

/// Sum of squares of the spectrum between two frequencies, of transforms all of one size.
fn power(signal: &[f64], window: usize, rate: f64, [low, high]: [f64; 2]) -> f64 {
    let plan = Transform::smooth(window.max(signal.len()));
    let mut work = plan.work();
    plan.forward(signal, &mut work);
    let lines = work.lines.iter().enumerate();
    lines.filter(|(line, _)| (low..=high).contains(&plan.hz(*line, rate))).map(|(_, x)| x.norm_sqr()).sum()
}
