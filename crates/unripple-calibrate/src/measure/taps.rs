//! Responses at a place from taps of unknown force: actuators are the sensors, and reciprocity gives their responses as
//! drives.

use super::{Channel, MeasureOptions, Rig, TapOptions, Wires, record, tapped};
use crate::CalibrateError;
use crate::fit::Fitted;
use crate::signals::{Band, Quality, shift, snr_db};
use unripple_core::{Layout, ModalResponses, Point, Surface};
use unripple_physics::sample;

/// A plan for tapping places with all actuators as sensors: responses by reciprocity, with no probe.
#[derive(Clone, Debug)]
pub struct TapSession {
    options: MeasureOptions,
    tap: TapOptions,
    sensors: Vec<usize>,
    model: ModalResponses,
    /// Gain of each actuator's sensor over that of its drive, as far as it is known.
    gains: Vec<f64>,
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
            tap: TapOptions::for_unfitted(),
            sensors: wires.sensors.clone(),
            model,
            gains: vec![1.0; surface.actuators.len()],
            band: Band::within(sweep.from, sweep.to),
            rate: sweep.rate,
            heard: samples.div_ceil(layout.block) * layout.block,
        })
    }

    /// The same plan with a model that was fitted to the responses between actuators. It knows masses on the sheet, holds for longer, so
    /// that the bounces of taps are found, and tells the gains of sensors from those of drives.
    #[must_use]
    pub fn by_fitted(self, fitted: &Fitted) -> Self {
        let gains = fitted.actuators.iter().map(|actuator| actuator.sense.value / actuator.drive.value);
        let (model, gains) = (fitted.beyond().clone(), gains.collect());
        Self { model, gains, tap: TapOptions::default(), ..self }
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
            let as_drive = |(sound, gain): (&Vec<f64>, &f64)| {
                let mut sound = shift(sound, -self.options.latency);
                sound.iter_mut().for_each(|x| *x /= gain);
                sound
            };
            taps.push(heard.iter().zip(&self.gains).map(as_drive).collect::<Vec<_>>());
        }
        let samples = self.options.samples(self.rate);
        let early = ((self.tap.span() + self.tap.early) * self.rate) as usize;
        let known = sample(&self.model, &[at], early.max(1));
        let model: Vec<Vec<f64>> = (0..self.sensors.len())
            .map(|actuator| known.response(actuator, 0).iter().map(|h| f64::from(*h)).collect())
            .collect();
        let found = tapped(&taps, &model, samples, self.rate, self.band, &self.tap)?;
        let quality = found.responses.iter().enumerate().map(|(sensor, response)| {
            let own = Quality::of(response, &[], self.rate)?;
            let mut best = f64::NEG_INFINITY;
            for tap in &taps {
                best = best.max(self.snr_db(&tap[sensor], samples)?);
            }
            Ok(Quality { snr_db: best, coherence: Some(1.0 - found.unexplained), ..own })
        });
        let quality = quality.collect::<Result<Vec<_>, CalibrateError>>()?;
        Ok(Channel { responses: found.responses, quality, ..Channel::default() })
    }

    /// Signal to noise of a recorded tap within the band, as of a response of `samples`. Noise is what the end of the recording holds.
    fn snr_db(&self, sound: &[f64], samples: usize) -> Result<f64, CalibrateError> {
        let mut sound = sound.to_vec();
        self.band.limit(&mut sound, self.rate)?;
        let peak = sound.iter().map(|x| x.abs()).fold(0.0, f64::max);
        let start = sound.iter().position(|x| x.abs() >= 0.1 * peak).unwrap_or(0);
        let loud = &sound[start..(start + samples).min(sound.len())];
        Ok(snr_db(loud, &sound[sound.len() - sound.len() / 20..]))
    }

    /// Why a channel is bad, in words: its first response with too little signal; `None` if it is good.
    pub fn fault(&self, channel: &Channel) -> Option<String> {
        self.options.fault(channel, "sensor")
    }
}
