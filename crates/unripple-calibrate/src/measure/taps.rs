//! Responses at a place from taps of unknown force: actuators are the sensors, and reciprocity gives their responses as
//! drives.

use super::{Channel, MeasureOptions, Rig, TapOptions, Wires, record, tapped};
use crate::CalibrateError;
use crate::fit::Fitted;
use crate::signals::{Band, Quality, shift, snr_db};
use unripple_core::{Layout, ModalResponses, Point, Surface};
use unripple_physics::sample;

/// A plan for measuring by taps at places, with all actuators as sensors: responses follow by reciprocity,
/// without a probe.
#[derive(Clone, Debug)]
pub struct TapSession {
    options: MeasureOptions,
    tap: TapOptions,
    sensors: Vec<usize>,
    model: ModalResponses,
    fitted: Option<Box<Fitted>>,
    /// Factor on each sensor's signal.
    scales: Vec<f64>,
    band: Band,
    rate: f64,
    heard: usize,
}

impl TapSession {
    /// A plan for a surface whose sensors have these wires. `model` holds the expected responses of the
    /// surface; [`tapped`] uses it only to estimate the forces of taps.
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
            fitted: None,
            scales: vec![1.0; surface.actuators.len()],
            band: Band::within(sweep.from, sweep.to),
            rate: sweep.rate,
            heard: samples.div_ceil(layout.block) * layout.block,
        })
    }

    /// This plan with a factor on the signal of each sensor, negative for a sensor of reversed sign.
    #[must_use]
    pub fn by_scales(self, scales: Vec<f64>) -> Self {
        Self { scales, ..self }
    }

    /// This plan with a model that was fitted to the responses between actuators. Such a model includes
    /// masses on the sheet, is accurate for longer, so that the bounces of taps are found, and separates the
    /// gains of sensors from those of drives, except for one factor common to all.
    #[must_use]
    pub fn by_fitted(self, fitted: &Fitted) -> Self {
        Self { fitted: Some(Box::new(fitted.clone())), tap: TapOptions::default(), ..self }
    }

    /// Gain of an actuator's sensor relative to that of its drive, from the fitted model; 1 without one.
    fn gain(&self, actuator: usize) -> f64 {
        let fitted = self.fitted.as_ref().and_then(|fitted| fitted.actuators.get(actuator));
        fitted.map_or(1.0, |actuator| actuator.sense.value / actuator.drive.value)
    }

    /// Modelled signal of each sensor for an impulse at a place.
    fn expected(&self, at: Point) -> Vec<Vec<f64>> {
        // The band's filter is as long as a period of its lowest frequency, and a model that ends sooner ends differently.
        let seconds = self.tap.span() + self.tap.early + 1.0 / self.band.low[0].max(1.0);
        let model = self.fitted.as_ref().map_or(&self.model, |fitted| fitted.sampleable());
        let known = sample(model, &[at], (seconds * self.rate) as usize + 1);
        let one = |actuator: usize| {
            let gain = self.gain(actuator);
            let response: Vec<f64> =
                known.response(actuator, 0).iter().map(|h| gain * f64::from(*h)).collect();
            let coil = self.fitted.as_ref().and_then(|fitted| fitted.coil(actuator));
            coil.map_or_else(|| response.clone(), |coil| coil.filtered(&response, self.rate))
        };
        (0..self.sensors.len()).map(one).collect()
    }

    /// Records taps at a place, one for each repeat, and computes the responses from them. `at` is in m,
    /// `attempt` counts the recordings at this place from 0.
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
            taps.push(record(rig.device(), &[], &[], &self.sensors, self.heard)?);
        }
        self.responses(&taps, at)
    }

    /// The responses at a place (m) from recordings of taps there by the sensors, `[tap][sensor][sample]` in the device's units.
    ///
    /// # Errors
    /// Those of [`tapped`].
    pub fn responses(&self, taps: &[Vec<Vec<f64>>], at: Point) -> Result<Channel, CalibrateError> {
        let scaled = |(sound, scale): (&Vec<f64>, &f64)| {
            let mut sound = shift(sound, -self.options.latency);
            sound.iter_mut().for_each(|x| *x *= scale);
            sound
        };
        let scale = |heard: &Vec<Vec<f64>>| heard.iter().zip(&self.scales).map(scaled).collect::<Vec<_>>();
        let taps: Vec<Vec<Vec<f64>>> = taps.iter().map(scale).collect();
        let samples = self.options.samples(self.rate);
        let known = (&self.expected(at)[..], &self.options.without[..]);
        let mut found = tapped(&taps, known, samples, (self.rate, self.band), &self.tap)?;
        let used = || (0..taps.len()).filter(|tap| !found.forces[*tap].is_empty());
        let quality = (0..self.sensors.len()).map(|sensor| {
            let own = Quality::of(&found.responses[sensor], &[], self.rate)?;
            let mut best = f64::NEG_INFINITY;
            for tap in used() {
                best = best.max(self.snr_db(&taps[tap][sensor], found.begins[tap], samples)?);
            }
            Ok(Quality { snr_db: best, coherence: Some(1.0 - found.unexplained), ..own })
        });
        let quality = quality.collect::<Result<Vec<_>, CalibrateError>>()?;
        for (sensor, response) in found.responses.iter_mut().enumerate() {
            let gain = self.gain(sensor);
            response.iter_mut().for_each(|h| *h /= gain);
        }
        Ok(Channel { responses: found.responses, quality, ..Channel::default() })
    }

    /// Signal-to-noise ratio, within the band, of a recorded tap's `samples` samples from the sample `begin`
    /// on. The end of the recording counts as noise.
    fn snr_db(&self, sound: &[f64], begin: usize, samples: usize) -> Result<f64, CalibrateError> {
        let mut sound = sound.to_vec();
        self.band.limit(&mut sound, self.rate)?;
        let loud = &sound[begin.min(sound.len())..(begin + samples).min(sound.len())];
        Ok(snr_db(loud, &sound[sound.len() - sound.len() / 20..]))
    }

    /// The reason why a channel is bad, in words: its first response with too little signal; `None` if it is
    /// good.
    pub fn fault(&self, channel: &Channel) -> Option<String> {
        self.options.fault(channel, "sensor")
    }
}
