//! Responses at a place from taps of unknown force: actuators are the sensors, and reciprocity gives their responses as
//! drives.

use super::{Channel, MeasureOptions, Rig, TapOptions, Wires, record, tapped};
use crate::CalibrateError;
use crate::signals::{Band, Quality, shift};
use unripple_core::{Layout, ModalResponses, Point, Surface};
use unripple_physics::sample;

/// A plan for tapping places with all actuators as sensors: responses by reciprocity, with no probe.
#[derive(Clone, Debug)]
pub struct TapSession {
    options: MeasureOptions,
    tap: TapOptions,
    sensors: Vec<usize>,
    model: ModalResponses,
    band: Band,
    rate: f64,
    heard: usize,
}

impl TapSession {
    /// A plan for a surface whose sensors have these wires. `model` holds the expected responses of the surface; [`tapped`]
    /// says how little is taken from it.
    ///
    /// # Errors
    /// [`CalibrateError::Recording`] without sensors or for a device of another rate; [`CalibrateError::Range`] for options
    /// out of range.
    pub fn new(
        surface: &Surface,
        layout: &Layout,
        wires: &Wires,
        model: ModalResponses,
        options: &MeasureOptions,
        tap: TapOptions,
    ) -> Result<Self, CalibrateError> {
        let sweep = options.sweep(surface, layout)?;
        if wires.sensors.len() != surface.actuators.len() {
            return Err(CalibrateError::Recording {
                what: format!("inputs of `{}`", layout.device),
                expected: "a sensor for each actuator, under its name".into(),
                found: layout.inputs.join(", "),
            });
        }
        // A tap may come late in the recording: its length is twice the settle time.
        let samples = (2.0 * options.settle_time * sweep.rate) as usize;
        Ok(Self {
            options: options.clone(),
            tap,
            sensors: wires.sensors.clone(),
            model,
            band: Band::within(sweep.from, sweep.to),
            rate: sweep.rate,
            heard: samples.div_ceil(layout.block) * layout.block,
        })
    }

    /// Has a place tapped, as often as there are repeats, and finds the responses. `at` is in m, `attempt` counts the
    /// recordings at this place from 0.
    ///
    /// # Errors
    /// Those of the rig, of [`record`] and of [`tapped`].
    pub fn measure(
        &self,
        rig: &mut dyn Rig,
        number: usize,
        at: Point,
        attempt: u64,
    ) -> Result<Channel, CalibrateError> {
        let mut taps = Vec::with_capacity(self.options.repeats);
        for repeat in 0..self.options.repeats as u64 {
            let attempt = attempt * self.options.repeats as u64 + repeat;
            rig.ready(number, at, attempt)?;
            rig.tap(number, at, attempt)?;
            let heard = record(rig.device(), &[], &[], &self.sensors, self.heard)?;
            taps.push(heard.iter().map(|sound| shift(sound, -self.options.latency)).collect::<Vec<_>>());
        }
        let samples = self.options.samples(self.rate);
        let early = (self.tap.early * self.rate) as usize + (2.0 * self.tap.length * self.rate) as usize;
        let known = sample(&self.model, &[at], early.max(1));
        let model: Vec<Vec<f64>> = (0..self.sensors.len())
            .map(|actuator| known.response(actuator, 0).iter().map(|h| f64::from(*h)).collect())
            .collect();
        let found = tapped(&taps, &model, samples, self.rate, self.band, &self.tap)?;
        let noise = |sound: &[f64]| {
            let tail = sound.len() / 20;
            sound[sound.len() - tail..].to_vec()
        };
        let quality = found.responses.iter().zip(&taps[0]).map(|(response, sound)| {
            let own = Quality::of(response, &[], self.rate)?;
            let peak = sound.iter().map(|x| x.abs()).fold(0.0, f64::max);
            let start = sound.iter().position(|x| x.abs() >= 0.1 * peak).unwrap_or(0);
            let loud = &sound[start..(start + samples).min(sound.len())];
            let snr_db = crate::signals::snr_db(loud, &noise(sound));
            Ok(Quality { snr_db, coherence: Some(1.0 - found.unexplained), ..own })
        });
        let quality = quality.collect::<Result<Vec<_>, CalibrateError>>()?;
        Ok(Channel { responses: found.responses, quality, ..Channel::default() })
    }

    /// Why a channel is bad, in words: its first response with too little signal; `None` if it is good.
    pub fn fault(&self, channel: &Channel) -> Option<String> {
        self.options.fault(channel, "sensor")
    }
}
