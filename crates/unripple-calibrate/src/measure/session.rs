//! Responses at one place to all actuators, measured by overlapping sweeps with the probe or the sensors.

use super::channel::Noise;
use super::law::Law;
use super::take::{Judge, Verdict};
use super::{Channel, Hearing, MeasureOptions, Rig, Wires, latency, record};
use crate::CalibrateError;
use crate::fit::Measured;
use crate::signals::{Band, Deconvolver, Delay, Inversion, Schedule, Sweep, shift};
use crate::verify;
use unripple_core::{Layout, ModalResponses, PROBE, Point, Surface};

/// Longest latency that is searched, in s. Longer than any sound system's buffers; each second of it is a second more of every
/// recording.
const LATEST: f64 = 0.25;

/// Number of samples before time 0 with which deconvolved responses begin, for latency and noise: 5 ms at 48
/// kHz.
pub(super) const LEAD: usize = 240;

/// Signal-to-noise ratio of a sensor's whole recording, in dB, above which noise cannot be the reason for
/// unrecognised sweeps.
const CLEAR_DB: f64 = 15.0;

/// Largest number of samples of the drive of all actuators and of all recordings of a place: 4 GiB. Twice as many take twice the memory.
const MOST_VALUES: usize = 1 << 29;

/// Largest uncertainty of the latency, in samples, at which no model is fitted: the latency is needed to a
/// twentieth of a sample, and the fit takes ten seconds. At half of it, a model would be fitted to surfaces
/// whose housings are so strongly damped that its latency is wrong by 0.15 samples.
const AGREE: f64 = 0.05;

/// Largest number of sensors from which clock, gaps and tension are found: with more, the result is the same
/// and takes longer.
const TELLING: usize = 8;

/// A plan for measuring at any number of places, with all actuators driven one after the other.
///
/// Sweeps overlap: the next actuator begins while the last still sounds, as soon as their responses, and harmonics up to
/// [`MeasureOptions::highest_order`], stay apart after one deconvolution of all. Where actuators have sensors, these are
/// recorded in every take: errors of clock, gaps and changes of tension found from them are corrected in the measured responses
/// ([`Account`](super::Account)).
#[derive(Clone, Debug)]
pub struct Session {
    surface: Surface,
    pub(super) options: MeasureOptions,
    pub(super) wires: Wires,
    pub(super) sweep: Sweep,
    pub(super) schedule: Schedule,
    pub(super) plan: Deconvolver,
    drive: Vec<Vec<f64>>,
    pub(super) heard: usize,
    pub(super) band: Band,
    pub(super) law: Law,
    /// Indices of the actuators from whose sensors clock, gaps and tension are found.
    telling: Vec<usize>,
    /// Responses at these sensors in the first take, `[sensor][actuator][sample]`.
    known: Option<Vec<Vec<Vec<f64>>>>,
}

/// Which inputs are recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Listen {
    /// The input of the probe.
    Probe,
    /// The inputs of all actuators' sensors.
    Sensors,
}

/// One recording of some inputs, corrected for clock, delay and gaps.
pub(super) struct Take {
    /// The recordings, `[input][sample]`.
    pub lines: Vec<Vec<f64>>,
    /// Findings about the recording, and the corrections that follow from them.
    pub verdict: Verdict,
}

impl Session {
    /// A plan for measuring a surface whose actuators are connected to a device by `wires`.
    ///
    /// # Errors
    /// [`CalibrateError::Recording`] for a device of another rate; [`CalibrateError::Range`] and [`CalibrateError::Dsp`] for
    /// options out of range; [`CalibrateError::Count`] for more samples than memory is to hold; [`CalibrateError::Wire`] without a
    /// probe and without sensors.
    pub fn new(
        surface: &Surface,
        layout: &Layout,
        wires: Wires,
        options: &MeasureOptions,
    ) -> Result<Self, CalibrateError> {
        let sweep = options.sweep(surface, layout)?;
        let window = options.apart(sweep.rate) + LEAD;
        let actuators = wires.drives.len();
        let schedule = Schedule::interleaved(&sweep, actuators, window, options.highest_order)?;
        let whole = schedule.samples();
        let late = options.latency.max(LATEST * sweep.rate).ceil() as usize;
        let heard = (whole + late).div_ceil(layout.block) * layout.block;
        let lines = actuators + options.repeats * wires.sensors.len().max(1);
        if heard.saturating_mul(lines) > MOST_VALUES {
            return Err(CalibrateError::Count {
                what: "samples that are played and recorded at a place",
                expected: format!("at most {MOST_VALUES}: fewer repeats, shorter sweeps or responses"),
                found: heard.saturating_mul(lines),
            });
        }
        let mut drive = vec![vec![0.0; whole]; actuators];
        for (actuator, signal) in drive.iter_mut().enumerate() {
            schedule.drive(actuator, signal)?;
        }
        let band = Band::within(sweep.from, sweep.to);
        let inversion =
            Inversion { band: Some(band), latency: options.latency, lead: LEAD, ..Inversion::default() };
        let plan = Deconvolver::new(schedule.stimulus(), heard, &inversion)?;
        let sensors = wires.sensors.len();
        let telling = (0..sensors.min(TELLING)).map(|i| i * sensors / sensors.clamp(1, TELLING)).collect();
        let law = Law::of(&surface.sheet, 1.1 * sweep.to);
        let (surface, options) = (surface.clone(), options.clone());
        Ok(Self {
            surface,
            options,
            wires,
            sweep,
            schedule,
            plan,
            drive,
            heard,
            band,
            law,
            telling,
            known: None,
        })
    }

    /// Sets the reference for all later takes: responses between actuators, measured with
    /// [`Listen::Sensors`] or read from a library. Later takes are corrected to the clock, latency and
    /// tension of this reference. Responses that are all zeros, of dead actuators and bad sensors, are left
    /// out.
    ///
    /// # Errors
    /// [`CalibrateError::Count`] for another number of sensors or responses than actuators.
    pub fn set_reference(&mut self, sensors: &[Channel]) -> Result<(), CalibrateError> {
        let count = self.wires.drives.len();
        let counts = sensors.iter().map(|channel| channel.responses.len()).chain([sensors.len()]);
        if let Some(found) = counts.into_iter().find(|found| *found != count) {
            let expected = count.to_string();
            return Err(CalibrateError::Count { what: "responses between actuators", expected, found });
        }
        // Rounded as libraries store them, so that a resumed run has the same values.
        let kept = |channel: &Channel| -> Vec<Vec<f64>> {
            let rounded = |response: &Vec<f64>| response.iter().map(|h| f64::from(*h as f32)).collect();
            channel.responses.iter().map(rounded).collect()
        };
        self.known = Some(self.telling.iter().map(|sensor| kept(&sensors[*sensor])).collect());
        Ok(())
    }

    /// The band in which responses are measured.
    pub fn band(&self) -> Band {
        self.band
    }

    /// The channels of the device that this plan uses.
    pub fn wires(&self) -> &Wires {
        &self.wires
    }

    /// Duration of all recordings of one place including repeats, in s, without the time before them in
    /// which the surface comes to rest.
    pub fn seconds(&self) -> f64 {
        self.options.repeats as f64 * self.heard as f64 / self.sweep.rate
    }

    /// Plays the sweeps, records, and computes the responses: one [`Channel`] for the probe, or one for each
    /// sensor. `number`, `at` and `attempt` are those of [`Rig::ready`].
    ///
    /// # Errors
    /// [`CalibrateError::Recording`] without an input for the probe, for clocks too far apart, or for samples lost at a place
    /// that cannot be found; those of the rig and of [`record`].
    pub fn measure(
        &self,
        rig: &mut dyn Rig,
        number: usize,
        at: Point,
        attempt: u64,
        listen: Listen,
    ) -> Result<Vec<Channel>, CalibrateError> {
        let inputs = match (listen, self.wires.probe) {
            (Listen::Probe, Some(probe)) => vec![probe],
            (Listen::Sensors, _) => self.wires.sensors.clone(),
            (Listen::Probe, None) => {
                return Err(CalibrateError::Recording {
                    what: "inputs of the device".into(),
                    expected: format!("one named `{}`, which records the probe", PROBE),
                    found: "none".into(),
                });
            }
        };
        let mut takes = Vec::with_capacity(self.options.repeats);
        for repeat in 0..self.options.repeats as u64 {
            rig.ready(number, at, attempt * self.options.repeats as u64 + repeat)?;
            let mut take = self.take(rig, &inputs)?;
            if listen == Listen::Probe {
                let delay = self.options.probe_delay.unwrap_or(0.0) * self.sweep.rate;
                take.lines.iter_mut().filter(|_| delay != 0.0).for_each(|line| *line = shift(line, -delay));
            }
            takes.push(take);
        }
        (0..inputs.len()).map(|input| self.channel(&takes, input, LEAD)).collect()
    }

    /// Records some inputs, and those from which clock, gaps and tension are found.
    fn take(&self, rig: &mut dyn Rig, inputs: &[usize]) -> Result<Take, CalibrateError> {
        let mut asked = inputs.to_vec();
        let own: Vec<usize> = self.telling.iter().map(|actuator| self.wires.sensors[*actuator]).collect();
        asked.extend(own.iter().chain(&self.wires.reference).filter(|input| !inputs.contains(input)));
        let heard = record(rig.device(), &self.wires.drives, &self.drive, &asked, self.heard)?;
        let line = |input: &usize| {
            let place = asked.iter().position(|one| one == input)?;
            heard.get(place).filter(|line| line.iter().any(|x| *x != 0.0)).map(Vec::as_slice)
        };
        let known = self.known.as_deref();
        let telling: Vec<usize> = (0..own.len()).filter(|i| line(&own[*i]).is_some()).collect();
        let mut lines: Vec<&[f64]> = telling.iter().filter_map(|i| line(&own[*i])).collect();
        let sensors: Vec<usize> = telling.iter().map(|i| self.telling[*i]).collect();
        let known: Option<Vec<Vec<Vec<f64>>>> =
            known.map(|known| telling.iter().map(|i| known[*i].clone()).collect());
        // Rows of zeros belong to dead actuators and bad sensors.
        let sounds = |known: &Vec<Vec<Vec<f64>>>| known.iter().flatten().flatten().any(|h| *h != 0.0);
        let known = known.filter(sounds);
        if lines.is_empty() {
            lines.extend(self.wires.reference.as_ref().and_then(line));
        }
        let verdict = self.judge(&lines, &sensors, known.as_deref())?;
        let mend = |line: &Vec<f64>| match verdict.mend.is_needed(line.len()) {
            true => verdict.mend.of(line),
            false => line.clone(),
        };
        Ok(Take { lines: heard.iter().take(inputs.len()).map(mend).collect(), verdict })
    }

    fn judge(
        &self,
        lines: &[&[f64]],
        sensors: &[usize],
        known: Option<&[Vec<Vec<f64>>]>,
    ) -> Result<Verdict, CalibrateError> {
        let judge = Judge {
            sensors,
            known,
            starts: self.schedule.starts(),
            sounding: self.schedule.stimulus().samples().len(),
            drive: &self.drive,
            lead: LEAD,
            length: LEAD + self.options.samples(self.sweep.rate),
            latency: self.options.latency,
            rate: self.sweep.rate,
            band: self.band,
            law: &self.law,
            deconvolve: &|line| self.whole(line),
            clear: &|whole| Noise::of(whole, &self.sweep, LEAD, self.band).snr_db(whole) > CLEAR_DB,
        };
        judge.judge(lines)
    }

    /// Latency of the device and its uncertainty, both in samples: from the reference channel if there is
    /// one (uncertainty 0), otherwise from responses between actuators, by [`latency`]; if that is uncertain
    /// because damping couples modes, also from a model that is fitted to these responses
    /// ([`verify::late`]), unless [`MeasureOptions::model`] is false. `None` if there is neither reference
    /// nor sensor.
    ///
    /// # Errors
    /// Those of the rig, of [`record`] and of [`latency`]; of [`Session::measure`] for clocks and samples lost.
    pub fn find_latency(
        &self,
        rig: &mut dyn Rig,
        number: usize,
        at: Point,
        model: &ModalResponses,
    ) -> Result<Option<[f64; 2]>, CalibrateError> {
        let inputs = match self.wires.reference {
            Some(reference) => vec![reference],
            None => self.wires.sensors.clone(),
        };
        if inputs.is_empty() {
            return Ok(None);
        }
        rig.ready(number, at, 0)?;
        let take = self.take(rig, &inputs)?;
        let mut windows = take.lines.iter().map(|line| self.windows(line)).collect::<Result<Vec<_>, _>>()?;
        let known = self.options.latency;
        if let (Some(_), [reference]) = (self.wires.reference, &windows[..]) {
            let power = |h: &&Vec<f64>| h.iter().map(|x| x * x).sum::<f64>();
            let loudest = reference.iter().max_by(|a, b| power(a).total_cmp(&power(b)));
            let found =
                Delay::of_impulse(loudest.map_or(&[][..], Vec::as_slice), self.sweep.rate, self.band)?;
            return Ok(Some([found.samples - LEAD as f64 + known, 0.0]));
        }
        // Actuators that are left out are not used.
        for actuator in &self.options.without {
            if let Some(window) = windows.get_mut(*actuator) {
                window.clear();
            }
        }
        let hearing = Hearing::of(&self.surface, model)?;
        let [mut late, spread] = latency(&windows, &hearing, LEAD, self.sweep.rate, self.band)?;
        if self.options.model && !hearing.in_step() && spread > AGREE {
            // The phases of coupled tones are corrected with the model of the surface file. A fitted model
            // gives a second estimate; the two are weighted by their uncertainties.
            if let Some([left, error]) = self.left(&windows, late) {
                late += left * spread.powi(2) / (spread.powi(2) + error.powi(2));
            }
        }
        Ok(Some([late + known, spread]))
    }

    /// Remaining delay of the responses between actuators after a latency is removed, and its uncertainty,
    /// in samples, from a model fitted to them; `None` if no good model is found.
    fn left(&self, windows: &[Vec<Vec<f64>>], latency: f64) -> Option<[f64; 2]> {
        let (count, rate) = (windows.len(), self.sweep.rate);
        let pair = |n: usize| match windows[n % count].get(n / count) {
            Some(window) => shift(window, -latency).split_off(LEAD),
            None => Vec::new(),
        };
        let pairs = (0..count * count).map(pair).collect();
        let measured = Measured::reciprocal(rate, pairs, [self.sweep.from, self.sweep.to]).ok()?;
        let left = verify::late(&self.surface, &measured.limited_to(self.band), &self.options.without)?;
        Some([left.value * rate, left.error * rate])
    }

    /// The responses to all actuators from the recording of one input, `[actuator][sample]`, each as long as
    /// their distance in the schedule, lead included.
    fn windows(&self, heard: &[f64]) -> Result<Vec<Vec<f64>>, CalibrateError> {
        let whole = self.whole(heard)?;
        let cut = |actuator: usize| {
            let mut cut = vec![0.0; self.schedule.window()];
            self.schedule.cut(&whole, actuator, &mut cut).map(|()| cut)
        };
        Ok((0..self.wires.drives.len()).map(cut).collect::<Result<Vec<_>, _>>()?)
    }

    /// The reason why a channel is bad, in words: a knock, unrecognised sweeps or the first response below
    /// the limits; `None` if it is good.
    pub fn fault(&self, channel: &Channel) -> Option<String> {
        self.options.fault(channel, "actuator")
    }
}
