//! From values in the file's form to impulse responses of velocity at the surface's sample rate, by way of their spectrum.

use super::measured::{Complex, Signal};
use super::units::Settled;
use super::{Kind, Quantity};
use crate::TaskError;
use std::f64::consts::PI;
use unripple::dsp::FourierPlanner;
use unripple_calibrate::measure::MOST_KEPT;

/// Share of a step by which an abscissa may be off, and share of its own value, which is the rounding of six digits.
pub(super) const OFF: f64 = 1e-3;
pub(super) const DIGITS: f64 = 5e-6;

/// Share by which rates may be off, which is the rounding of six digits and some.
const RATE: f64 = 1e-5;

/// Highest sample rate of a file in Hz: a higher one is taken for a mistake of unit.
const MOST_RATE: f64 = 1e9;

/// Most zeros that are appended so that samples at both rates end together.
const MOST_ZEROS: usize = 1 << 20;

/// Converts responses to one sample rate.
pub(super) struct Converter {
    /// Sample rate of the impulse responses, in Hz.
    rate: f64,
    /// Lowest and highest frequency that are kept, in Hz; all if `None`.
    band: Option<[f64; 2]>,
    planner: FourierPlanner,
}

/// An impulse response of velocity.
pub(super) struct Converted {
    /// Samples in m/s per unit of drive and second.
    pub values: Vec<f64>,
    /// Lowest and highest frequency in it, in Hz.
    pub band: [f64; 2],
}

/// Lines of a spectrum at multiples of the inverse of a duration.
struct Lines {
    /// Number of samples of the duration at the rate of the impulse responses.
    samples: usize,
    /// Number of the first line, and the lines.
    first: usize,
    values: Vec<Complex>,
}

impl Converter {
    /// A converter to a sample rate in Hz, within a band in Hz.
    pub fn new(rate: f64, band: Option<[f64; 2]>) -> Self {
        Self { rate, band, planner: FourierPlanner::new() }
    }

    /// Converts the values of a response; `sign` multiplies them, and `from` names them in messages.
    ///
    /// # Errors
    /// [`TaskError::Input`] of an abscissa that does not fit the sample rate, or a spectrum with no line in the band.
    pub fn convert(
        &mut self,
        signal: &Signal,
        settled: &Settled,
        sign: f64,
        from: &str,
    ) -> Result<Converted, TaskError> {
        let scale = sign * settled.scale;
        let lines = match signal {
            Signal::Time { start, step, values } => {
                let rate = whole_rate(*step, from)?;
                let values = from_zero(values, *start, *step, from)?;
                within(values.len() as f64 / rate, from)?;
                let is_filter = settled.kind == Kind::Filters;
                if rate == self.rate && settled.quantity == Quantity::Velocity && self.band.is_none() {
                    let scale = if is_filter { scale * rate } else { scale };
                    let values = values.into_iter().map(|value| scale * value).collect();
                    return Ok(Converted { values, band: [0.0, 0.5 * rate] });
                }
                let weight = if is_filter { 1.0 } else { 1.0 / rate };
                self.transformed(values, rate, weight, from)?
            }
            Signal::Frequency { start, step, values } => self.given(*start, *step, values, from)?,
        };
        self.inverse(&lines, settled.quantity, scale, from)
    }

    /// The spectrum of values in time, each times `weight`.
    fn transformed(
        &mut self,
        mut values: Vec<f64>,
        rate: f64,
        weight: f64,
        from: &str,
    ) -> Result<Lines, TaskError> {
        // Zeros make the duration a whole number of samples of both rates.
        let common = common_divisor(rate as u64, self.rate as u64).max(1);
        let (unit, out) = ((rate as u64 / common) as usize, (self.rate as u64 / common) as usize);
        let padded = values.len().next_multiple_of(unit.max(1));
        if padded - values.len() > MOST_ZEROS {
            return Err(refused(from, "a sample rate with a common divisor with the surface's", rate));
        }
        values.resize(padded, 0.0);
        values.iter_mut().for_each(|value| *value *= weight);
        let transform = self.planner.forward(padded);
        let mut lines = transform.make_output_vec();
        transform.process(&mut values, &mut lines).map_err(TaskError::work)?;
        let samples = padded / unit.max(1) * out;
        // The highest line of an even number of samples is both its own and that of the negative frequency.
        if let Some(last) = lines.last_mut().filter(|_| padded.is_multiple_of(2) && samples > padded) {
            *last *= 0.5;
        }
        Ok(Lines { samples, first: 0, values: lines })
    }

    /// The spectrum that a file holds, with its frequencies as multiples of a distance that divides the sample rate.
    fn given(&self, start: f64, step: f64, values: &[Complex], from: &str) -> Result<Lines, TaskError> {
        let samples = (self.rate / step).round();
        if (samples * step - self.rate).abs() > RATE * self.rate || samples < 2.0 {
            let expected = format!(
                "lines at a distance that divides the sample rate of the surface, {} Hz (`drive.sample_rate_hz`)",
                self.rate
            );
            return Err(refused(from, &expected, format!("{step} Hz")));
        }
        within(samples / self.rate, from)?;
        let first = (start / step).round();
        if first < 0.0 || (start - first * step).abs() > OFF * step + DIGITS * start.abs() {
            let expected = format!("a first line at a multiple of {step} Hz");
            return Err(refused(from, &expected, format!("{start} Hz")));
        }
        Ok(Lines { samples: samples as usize, first: first as usize, values: values.to_vec() })
    }

    /// The impulse response of velocity of a spectrum of another quantity.
    fn inverse(
        &mut self,
        lines: &Lines,
        quantity: Quantity,
        scale: f64,
        from: &str,
    ) -> Result<Converted, TaskError> {
        let step = self.rate / lines.samples as f64;
        let half = lines.samples / 2;
        let mut spectrum = vec![Complex::new(0.0, 0.0); half + 1];
        let mut band: Option<[f64; 2]> = None;
        for (line, value) in (lines.first..=half).zip(&lines.values) {
            let hz = line as f64 * step;
            let omega = 2.0 * PI * hz;
            let outside =
                self.band.is_some_and(|[low, high]| hz < low - OFF * step || hz > high + OFF * step);
            let factor = match quantity {
                _ if outside => continue,
                // The mean of an acceleration says nothing of a velocity.
                Quantity::Acceleration if line == 0 => continue,
                Quantity::Velocity => Complex::new(scale, 0.0),
                Quantity::Displacement => Complex::new(0.0, scale * omega),
                Quantity::Acceleration => Complex::new(0.0, -scale / omega),
            };
            spectrum[line] = *value * factor;
            band = Some(band.map_or([hz, hz], |[low, _]| [low, hz]));
        }
        let Some(band) = band else {
            let [low, high] = self.band.unwrap_or([0.0, 0.5 * self.rate]);
            return Err(refused(from, &format!("frequencies from {low} to {high} Hz"), "none there"));
        };
        // The spectrum of real samples is real at both ends.
        spectrum[0].im = 0.0;
        if lines.samples.is_multiple_of(2) {
            spectrum[half].im = 0.0;
        }
        let transform = self.planner.inverse(lines.samples);
        let mut values = transform.make_output_vec();
        transform.process(&mut spectrum, &mut values).map_err(TaskError::work)?;
        values.iter_mut().for_each(|value| *value *= step);
        Ok(Converted { values, band })
    }
}

/// The sample rate of values at a distance in s, in Hz: a whole number, but for the rounding of the distance.
fn whole_rate(step: f64, from: &str) -> Result<f64, TaskError> {
    let rate = (1.0 / step).round();
    match (1.0..=MOST_RATE).contains(&rate) && (rate * step - 1.0).abs() <= RATE {
        true => Ok(rate),
        false => Err(refused(from, "a whole sample rate from 1 Hz to 1 GHz", format!("{} Hz", 1.0 / step))),
    }
}

/// Values from time 0 on: what is before it is cut off, what is missing after it is zero.
fn from_zero(values: &[f64], start: f64, step: f64, from: &str) -> Result<Vec<f64>, TaskError> {
    let first = (start / step).round();
    let off = (start - first * step).abs() > OFF * step + DIGITS * start.abs();
    if off || first.abs() >= values.len() as f64 || values.len() < 2 {
        let expected = "values at multiples of the inverse sample rate, around time 0";
        return Err(refused(from, expected, format!("{} values from {start} s", values.len())));
    }
    let shift = first.abs() as usize;
    match first < 0.0 {
        true => Ok(values[shift..].to_vec()),
        false => Ok(std::iter::repeat_n(0.0, shift).chain(values.iter().copied()).collect()),
    }
}

/// Refuses a duration in s that no library keeps.
fn within(seconds: f64, from: &str) -> Result<(), TaskError> {
    match seconds <= MOST_KEPT {
        true => Ok(()),
        false => Err(refused(from, &format!("a duration of at most {MOST_KEPT} s"), format!("{seconds} s"))),
    }
}

fn refused(from: &str, expected: &str, found: impl std::fmt::Display) -> TaskError {
    TaskError::Input(format!("{from}: expected {expected}, found {found}"))
}

fn common_divisor(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::Per;

    fn settled(kind: Kind, quantity: Quantity) -> Settled {
        Settled { kind, quantity, per: Per::Newton, scale: 2.0 }
    }

    /// Displacement, velocity and acceleration of a decaying oscillation at 100 Hz that begins at rest, as t² does.
    fn motion(t: f64) -> [f64; 3] {
        let pole = Complex::new(-60.0, 2.0 * PI * 100.0);
        let at = Complex::new(0.0, -1e4) * (pole * t).exp();
        let velocity = pole * (t * t) + 2.0 * t;
        let acceleration = pole * pole * (t * t) + pole * (4.0 * t) + 2.0;
        [(at * (t * t)).re, (at * velocity).re, (at * acceleration).re]
    }

    fn converted(band: Option<[f64; 2]>, signal: &Signal, kind: Kind, quantity: Quantity) -> Converted {
        Converter::new(4000.0, band).convert(signal, &settled(kind, quantity), 1.0, "a").unwrap()
    }

    #[test]
    fn velocities_at_the_rate_are_what_they_were() {
        let signal = Signal::Time { start: 0.0, step: 1.0 / 4000.0, values: vec![1.0, -2.0, 3.0] };
        let of = |kind| converted(None, &signal, kind, Quantity::Velocity).values;
        assert_eq!(of(Kind::ImpulseResponses), [2.0, -4.0, 6.0]);
        assert_eq!(of(Kind::Filters), [8000.0, -16000.0, 24000.0]);
    }

    #[test]
    fn a_frequency_response_is_that_of_its_impulse_response() {
        let values: Vec<f64> = (0..400).map(|n| motion(f64::from(n) / 4000.0)[1]).collect();
        let signal = Signal::Time { start: 0.0, step: 1.0 / 4000.0, values: values.clone() };
        let mut converter = Converter::new(4000.0, None);
        let lines = converter.transformed(values.clone(), 4000.0, 1.0 / 4000.0, "a").unwrap();
        let spectrum = Signal::Frequency { start: 0.0, step: 10.0, values: lines.values };
        let again = converted(None, &spectrum, Kind::FrequencyResponses, Quantity::Velocity);
        let plain = converted(None, &signal, Kind::ImpulseResponses, Quantity::Velocity);
        assert_eq!((again.values.len(), again.band), (400, [0.0, 2000.0]));
        for (a, b) in again.values.iter().zip(&plain.values) {
            assert!((a - b).abs() < 1e-9, "{a} {b}");
        }
    }

    #[test]
    fn displacements_and_accelerations_become_the_same_velocities() {
        let quantities = [Quantity::Displacement, Quantity::Velocity, Quantity::Acceleration];
        let band = Some([50.0, 200.0]);
        let each = [0, 1, 2].map(|n: usize| {
            // Long enough to be over, and at four times the rate.
            let values = (0..16_000).map(|i| motion(f64::from(i) / 16e3)[n]).collect();
            let signal = Signal::Time { start: 0.0, step: 1.0 / 16e3, values };
            converted(band, &signal, Kind::ImpulseResponses, quantities[n])
        });
        let peak = each[1].values.iter().fold(0.0_f64, |peak, value| peak.max(value.abs()));
        assert!(each.iter().all(|one| one.values.len() == 4000 && one.band == [50.0, 200.0]));
        for one in [&each[0], &each[2]] {
            let worst =
                one.values.iter().zip(&each[1].values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-3 * peak, "{worst} of {peak}");
        }
    }

    #[test]
    fn samples_at_another_rate_are_those_of_the_same_wave() {
        // A whole number of periods, so that the wave is one line.
        let wave = |rate: f64, n: u32| (2.0 * PI * 100.0 * f64::from(n) / rate).sin();
        let values = (0..441).map(|n| wave(44_100.0, n)).collect();
        let signal = Signal::Time { start: 0.0, step: 2.26757e-5, values };
        let converted = converted(None, &signal, Kind::ImpulseResponses, Quantity::Velocity);
        assert_eq!(converted.values.len(), 40);
        for (n, value) in (0..40).zip(&converted.values) {
            assert!((value - 2.0 * wave(4000.0, n)).abs() < 1e-9, "{n}: {value}");
        }
    }

    #[test]
    fn time_zero_is_found() {
        let of = |start: f64| from_zero(&[1.0, 2.0, 3.0], start, 0.1, "a");
        assert_eq!(of(-0.1).unwrap(), [2.0, 3.0]);
        assert_eq!(of(0.2).unwrap(), [0.0, 0.0, 1.0, 2.0, 3.0]);
        assert!(of(0.05).is_err() && of(-0.3).is_err() && of(1e9).is_err());
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let mut converter = Converter::new(4000.0, Some([10.0, 20.0]));
        let mut refused = |signal: Signal| {
            let settled = match signal {
                Signal::Time { .. } => settled(Kind::ImpulseResponses, Quantity::Velocity),
                Signal::Frequency { .. } => settled(Kind::FrequencyResponses, Quantity::Velocity),
            };
            converter.convert(&signal, &settled, 1.0, "a").err().unwrap().to_string()
        };
        let lines = |start: f64, step: f64| Signal::Frequency {
            start,
            step,
            values: vec![Complex::new(1.0, 0.0); 9],
        };
        assert!(
            refused(lines(0.0, 7.0))
                .contains("a distance that divides the sample rate of the surface, 4000 Hz")
        );
        assert!(refused(lines(3.0, 8.0)).contains("a first line at a multiple of 8 Hz, found 3 Hz"));
        assert!(refused(lines(80.0, 8.0)).contains("frequencies from 10 to 20 Hz, found none there"));
        assert!(refused(lines(0.0, 0.01)).contains("at most 60 s, found 100 s"));
        let samples = |step: f64| Signal::Time { start: 0.0, step, values: vec![1.0; 9] };
        assert!(refused(samples(0.4)).contains("a whole sample rate"));
        assert!(refused(samples(10.0)).contains("a whole sample rate"));
    }
}
