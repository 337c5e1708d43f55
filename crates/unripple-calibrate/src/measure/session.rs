use super::{Hearing, MeasureOptions, Rig, Wires, latency, record};
use crate::CalibrateError;
use unripple_core::{Layout, ModalResponses, PROBE, Point, Surface};
use unripple_dsp::{
    Average, Band, Deconvolver, Delay, Harmonics, Inversion, Outliers, Quality, Schedule, Split, Sweep,
};

/// Longest latency that is looked for, in s.
const LATEST: f64 = 0.25;

/// Samples before time 0 that deconvolved responses begin with, for latency and noise: 5 ms at 48 kHz.
const LEAD: usize = 240;

/// A plan for measuring at any number of places, with all actuators driven one after the other.
///
/// Sweeps overlap: the next actuator begins while the last still sounds, as soon as their responses, and harmonics up to
/// [`MeasureOptions::highest_order`], stay apart after one deconvolution of all.
#[derive(Clone, Debug)]
pub struct Session {
    surface: Surface,
    options: MeasureOptions,
    wires: Wires,
    sweep: Sweep,
    schedule: Schedule,
    plan: Deconvolver,
    drive: Vec<Vec<f64>>,
    heard: usize,
    band: Band,
}

/// What an input heard of every actuator.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Responses, `[actuator][sample]` from time 0, in the input's unit per unit impulse of drive.
    pub responses: Vec<Vec<f64>>,
    /// How good each is.
    pub quality: Vec<Quality>,
}

/// Who listens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Listen {
    /// The probe.
    Probe,
    /// Each actuator's own sensor.
    Sensors,
}

impl Session {
    /// A plan for a surface's actuators on a device with these wires.
    ///
    /// # Errors
    /// [`CalibrateError::Recording`] for a device of another rate; [`CalibrateError::Range`] and [`CalibrateError::Dsp`] for
    /// options out of range; [`CalibrateError::Wire`] without a probe and without sensors.
    pub fn new(
        surface: &Surface,
        layout: &Layout,
        wires: Wires,
        options: &MeasureOptions,
    ) -> Result<Self, CalibrateError> {
        let sweep = options.sweep(surface, layout)?;
        let window = (options.ringing * sweep.rate).round() as usize + LEAD;
        let actuators = wires.drives.len();
        let schedule = Schedule::interleaved(&sweep, actuators, window, options.highest_order)?;
        let whole = schedule.samples();
        let mut drive = vec![vec![0.0; whole]; actuators];
        for (actuator, signal) in drive.iter_mut().enumerate() {
            schedule.drive(actuator, signal)?;
        }
        let late = options.latency.max(LATEST * sweep.rate).ceil() as usize;
        let heard = (whole + late).div_ceil(layout.block) * layout.block;
        let band = Band::within(sweep.from, sweep.to);
        let inversion =
            Inversion { band: Some(band), latency: options.latency, lead: LEAD, ..Inversion::default() };
        let plan = Deconvolver::new(schedule.stimulus(), heard, &inversion)?;
        Ok(Self {
            surface: surface.clone(),
            options: options.clone(),
            wires,
            sweep,
            schedule,
            plan,
            drive,
            heard,
            band,
        })
    }

    /// The band in which responses are measured.
    pub fn band(&self) -> Band {
        self.band
    }

    /// The wires it was planned for.
    pub fn wires(&self) -> &Wires {
        &self.wires
    }

    /// Seconds that a place takes, its repeats included, without what the surface needs to come to rest.
    pub fn seconds(&self) -> f64 {
        self.options.repeats as f64 * self.heard as f64 / self.sweep.rate
    }

    /// Plays the sweeps and finds the responses, of the probe or of each sensor in turn.
    ///
    /// # Errors
    /// [`CalibrateError::Recording`] without an input for the probe; those of the rig and of [`record`].
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
                    expected: format!("one that hears the probe, under the name `{}`", PROBE),
                    found: "none".into(),
                });
            }
        };
        let mut repeats = vec![Vec::with_capacity(self.options.repeats); inputs.len()];
        for repeat in 0..self.options.repeats as u64 {
            rig.ready(number, at, attempt * self.options.repeats as u64 + repeat)?;
            let heard = record(rig.device(), &self.wires.drives, &self.drive, &inputs, self.heard)?;
            repeats.iter_mut().zip(heard).for_each(|(repeats, heard)| repeats.push(heard));
        }
        repeats.iter().map(|repeats| self.channel(repeats, LEAD)).collect()
    }

    /// Samples by which what is heard comes late, and how far actuators disagree on it: by the reference channel if there is
    /// one, otherwise by what actuators hear of themselves. See [`latency`]. `None` if there is neither.
    ///
    /// # Errors
    /// Those of the rig, of [`record`] and of [`latency`].
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
        let heard = record(rig.device(), &self.wires.drives, &self.drive, &inputs, self.heard)?;
        let mut windows = heard.iter().map(|one| self.windows(one)).collect::<Result<Vec<_>, _>>()?;
        let known = self.options.latency;
        if let (Some(_), [reference]) = (self.wires.reference, &windows[..]) {
            let power = |h: &&Vec<f64>| h.iter().map(|x| x * x).sum::<f64>();
            let loudest = reference.iter().max_by(|a, b| power(a).total_cmp(&power(b)));
            let found =
                Delay::of_impulse(loudest.map_or(&[][..], Vec::as_slice), self.sweep.rate, self.band)?;
            return Ok(Some([found.samples - LEAD as f64 + known, 0.0]));
        }
        // What is left out has nothing to say.
        self.options.without.iter().filter_map(|a| windows.get_mut(*a)).for_each(Vec::clear);
        let hearing = Hearing::of(&self.surface, model)?;
        let [late, spread] = latency(&windows, &hearing, LEAD, self.sweep.rate, self.band)?;
        Ok(Some([late + known, spread]))
    }

    /// The responses to all actuators from what one input heard, as long as they are kept apart, with the lead.
    fn windows(&self, heard: &[f64]) -> Result<Vec<Vec<f64>>, CalibrateError> {
        let mut whole = vec![0.0; self.plan.size()];
        self.plan.deconvolve(
            &heard[..self.heard.min(heard.len())],
            &mut whole,
            &mut self.plan.workspace(),
        )?;
        let cut = |actuator: usize| {
            let mut cut = vec![0.0; self.schedule.window()];
            self.schedule.cut(&whole, actuator, &mut cut).map(|()| cut)
        };
        Ok((0..self.wires.drives.len()).map(cut).collect::<Result<Vec<_>, _>>()?)
    }

    /// Responses and their quality from what one input heard, repeat by repeat, without the first `from` samples of the lead.
    fn channel(&self, repeats: &[Vec<f64>], from: usize) -> Result<Channel, CalibrateError> {
        let size = self.plan.size();
        let mut whole = vec![vec![0.0; size]; repeats.len()];
        let mut workspace = self.plan.workspace();
        for (whole, heard) in whole.iter_mut().zip(repeats) {
            self.plan.deconvolve(&heard[..self.heard.min(heard.len())], whole, &mut workspace)?;
        }
        let mut channel = Channel { responses: Vec::new(), quality: Vec::new() };
        let samples = self.options.samples(self.sweep.rate);
        for actuator in 0..self.wires.drives.len() {
            let (response, quality) = self.response(&whole, actuator)?;
            channel.responses.push(response[from..].iter().take(samples + LEAD - from).copied().collect());
            channel.quality.push(quality);
        }
        Ok(channel)
    }

    fn response(&self, whole: &[Vec<f64>], actuator: usize) -> Result<(Vec<f64>, Quality), CalibrateError> {
        let window = self.schedule.window();
        let mut cuts = vec![vec![0.0; window]; whole.len()];
        for (cut, whole) in cuts.iter_mut().zip(whole) {
            self.schedule.cut(whole, actuator, cut)?;
        }
        let rows: Vec<&[f64]> = cuts.iter().map(Vec::as_slice).collect();
        let average = Average::of(&rows, Outliers::default())?;
        // The last tenth of a window holds what is left when the surface has come to rest: noise.
        let tail = &average.mean[window - window / 10..];
        let mut quality = Quality::of(&average.mean[LEAD..], tail, self.sweep.rate)?;
        if average.kept.iter().filter(|kept| **kept).count() > 1 {
            quality.snr_db = average.snr_db();
            quality.coherence = Some(average.coherence());
        }
        if self.options.highest_order >= 2 {
            quality.distortion_db = Some(self.distortion_db(&whole[0], actuator)?);
        }
        Ok((average.mean, quality))
    }

    fn distortion_db(&self, whole: &[f64], actuator: usize) -> Result<f64, CalibrateError> {
        let split = Split {
            start: self.schedule.starts()[actuator],
            lead: LEAD,
            window: self.schedule.window(),
            highest_order: self.options.highest_order,
            band: Some(self.band),
        };
        Ok(match Harmonics::of(whole, &self.sweep, &split) {
            Ok(harmonics) => harmonics.distortion_db(),
            // A silent channel has no distortion to speak of; its signal to noise says the rest.
            Err(_) => f64::NEG_INFINITY,
        })
    }

    /// Why a channel is bad, if it is: its worst response against the least that is asked.
    pub fn fault(&self, channel: &Channel) -> Option<String> {
        self.options.fault(channel, "actuator")
    }
}
