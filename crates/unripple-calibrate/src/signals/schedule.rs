//! Multiple exponential sweeps, interleaved and overlapping (Majdak et al. 2007).

use super::cut::cut;
use super::{Stimulus, Sweep, same};
use unripple_core::OutOfRange;
use unripple_dsp::DspError;

/// Start times of the actuators' stimuli, such that one deconvolution of the recording separates the responses of all
/// actuators.
///
/// Actuators play equal stimuli, each later than the one before. A response occupies `window` samples of the
/// deconvolution, which no other response overlaps.
///
/// ```
/// use unripple_calibrate::signals::{Schedule, Sweep};
///
/// let sweep = Sweep { seconds: 0.5, ..Sweep::default() };
/// let window = 16_000;
/// let one_by_one = Schedule::sequential(sweep.stimulus()?, 8, window)?;
/// let together = Schedule::interleaved(&sweep, 8, window, 3)?;
/// assert!(together.samples() < 3 * one_by_one.samples() / 4);
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    stimulus: Stimulus,
    starts: Vec<usize>,
    window: usize,
}

impl Schedule {
    /// A schedule of one actuator after another: each stimulus starts when the response to the one before
    /// has ended.
    ///
    /// # Errors
    /// [`DspError::Size`] without actuators or with a window of 0; [`DspError::Range`] for a periodic stimulus.
    pub fn sequential(stimulus: Stimulus, actuators: usize, window: usize) -> Result<Self, DspError> {
        if stimulus.periodic {
            let expected = "a stimulus that ends";
            return Err(DspError::Range(OutOfRange::new("periods of the stimulus", expected, f64::INFINITY)));
        }
        let step = stimulus.samples.len() + window;
        Self::made(stimulus, (0..actuators).map(|a| a * step).collect(), window)
    }

    /// A schedule of overlapping and interleaved exponential sweeps: no actuator's response overlaps
    /// another's, or a harmonic of another's of orders 2 to `highest_order`, each as long as `window`;
    /// harmonics may overlap one another. With `highest_order` 1 the surface is assumed to be linear.
    ///
    /// Source: P. Majdak, P. Balazs, B. Laback, "Multiple exponential sweep method", J. Audio Eng. Soc. 55 (2007). Where
    /// they fix the pattern (groups interleaved, groups overlapped), each sweep here begins as early as it can, or all
    /// at the same distance where that ends earlier.
    ///
    /// # Errors
    /// As [`Sweep::stimulus`]; [`DspError::Size`] without actuators or with a window of 0; [`DspError::Range`] for an
    /// order of 0 or one that the sweep does not reach.
    pub fn interleaved(
        sweep: &Sweep,
        actuators: usize,
        window: usize,
        highest_order: usize,
    ) -> Result<Self, DspError> {
        let stimulus = sweep.stimulus()?;
        let most = (sweep.to / sweep.from).floor();
        if highest_order == 0 || highest_order as f64 > most {
            return Err(DspError::Range(OutOfRange::new(
                "highest order of harmonics",
                format!("1 to {most}"),
                highest_order as f64,
            )));
        }
        // Distances from an earlier start, between the two numbers exclusively, at which a response and a
        // harmonic would overlap.
        let forbidden: Vec<[usize; 2]> = (2..=highest_order)
            .map(|order| {
                let lead = sweep.lead(order) * sweep.rate;
                [(lead.floor() as usize).saturating_sub(window), lead.ceil() as usize + window]
            })
            .collect();
        let [greedy, even] = [earliest(actuators, window, &forbidden), evenly(actuators, window, &forbidden)];
        let starts = if even.last() < greedy.last() { even } else { greedy };
        Self::made(stimulus, starts, window)
    }

    /// A schedule of all actuators at the same time: each plays one periodic stimulus, shifted cyclically by
    /// an equal share of the period, which is the window. One period is recorded after the surface has
    /// reached the steady state.
    ///
    /// # Errors
    /// [`DspError::Size`] without actuators, or for a period shorter than their number; [`DspError::Range`] for a
    /// stimulus that is not periodic.
    pub fn simultaneous(stimulus: Stimulus, actuators: usize) -> Result<Self, DspError> {
        if !stimulus.periodic {
            let expected = "a stimulus that goes round";
            return Err(DspError::Range(OutOfRange::new("periods of the stimulus", expected, 1.0)));
        }
        let window = stimulus.samples.len() / actuators.max(1);
        Self::made(stimulus, (0..actuators).map(|a| a * window).collect(), window)
    }

    fn made(stimulus: Stimulus, starts: Vec<usize>, window: usize) -> Result<Self, DspError> {
        for (what, found) in [("actuators of a schedule", starts.len()), ("samples of a window", window)] {
            if found == 0 {
                return Err(DspError::Size { what, expected: 1, found });
            }
        }
        Ok(Self { stimulus, starts, window })
    }

    /// The stimulus that each actuator plays, from which the [`super::Deconvolver`] of this schedule is
    /// made.
    pub fn stimulus(&self) -> &Stimulus {
        &self.stimulus
    }

    /// Sample at which each actuator's stimulus starts.
    pub fn starts(&self) -> &[usize] {
        &self.starts
    }

    /// Number of samples of the deconvolution that belong to one response.
    pub fn window(&self) -> usize {
        self.window
    }

    /// Number of samples to record: until the last response has ended, or one period of a periodic stimulus.
    /// The latter must have been played for at least one window before.
    pub fn samples(&self) -> usize {
        if self.stimulus.periodic {
            return self.stimulus.samples.len();
        }
        self.starts.last().map_or(0, |last| last + self.stimulus.samples.len() + self.window)
    }

    /// Writes the signal that an actuator plays to `drive`; a periodic stimulus fills it entirely.
    ///
    /// # Errors
    /// [`DspError::Size`] if there is no such actuator.
    pub fn drive(&self, actuator: usize, drive: &mut [f64]) -> Result<(), DspError> {
        let (start, samples) = (self.start(actuator)?, &self.stimulus.samples);
        if self.stimulus.periodic {
            cut(samples, -start, drive);
            return Ok(());
        }
        drive.fill(0.0);
        let after = drive.iter_mut().skip(self.starts[actuator]);
        after.zip(samples).for_each(|(to, from)| *to = *from);
        Ok(())
    }

    /// Copies an actuator's response from the whole deconvolution to `response`, of at most
    /// [`Schedule::window`] samples. If the deconvolution has a lead, the response begins that many samples
    /// before time 0.
    ///
    /// # Errors
    /// [`DspError::Size`] if there is no such actuator, or `response` is longer than the window.
    pub fn cut(&self, deconvolved: &[f64], actuator: usize, response: &mut [f64]) -> Result<(), DspError> {
        if response.len() > self.window {
            same("samples of a response in its window", self.window, response.len())?;
        }
        cut(deconvolved, self.start(actuator)?, response);
        Ok(())
    }

    fn start(&self, actuator: usize) -> Result<i64, DspError> {
        let size =
            DspError::Size { what: "actuators of a schedule", expected: self.starts.len(), found: actuator };
        self.starts.get(actuator).and_then(|start| i64::try_from(*start).ok()).ok_or(size)
    }
}

/// Start times, each as early as the starts before allow.
fn earliest(actuators: usize, window: usize, forbidden: &[[usize; 2]]) -> Vec<usize> {
    let mut starts: Vec<usize> = Vec::with_capacity(actuators);
    for _ in 0..actuators {
        let mut start = starts.last().map_or(0, |last| last + window);
        // Every step passes one forbidden interval for good, so that the loop ends.
        while let Some(end) = starts.iter().find_map(|before| {
            let behind = start - before;
            forbidden
                .iter()
                .find(|[low, high]| behind > *low && behind < *high)
                .map(|[_, high]| before + high)
        }) {
            start = end;
        }
        starts.push(start);
    }
    starts
}

/// Start times at equal distances, the smallest possible.
fn evenly(actuators: usize, window: usize, forbidden: &[[usize; 2]]) -> Vec<usize> {
    let fits = |step: usize| {
        let clear = |behind: usize| forbidden.iter().all(|[low, high]| behind <= *low || behind >= *high);
        (1..actuators).all(|count| clear(count * step))
    };
    let ends = forbidden.iter().flat_map(|[_, high]| (1..actuators).map(|count| high.div_ceil(count)));
    let step = ends.chain([window]).filter(|step| *step >= window && fits(*step)).min();
    let step = step.unwrap_or_else(|| forbidden.iter().map(|[_, high]| *high).max().unwrap_or(window));
    (0..actuators).map(|a| a * step).collect()
}
