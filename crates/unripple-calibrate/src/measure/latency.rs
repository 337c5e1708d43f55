use crate::CalibrateError;
use unripple_dsp::{Band, Delay, Gate};

/// Seconds after the strike in which a point answers as if the surface had no rim, whatever the tension's last per cent.
const ALONE: f64 = 1.5e-3;

/// Samples by which what is heard comes late: from what actuators hear of themselves (`found`) and what a model says
/// they hear without latency, both one per actuator, `found` with `lead` samples before time 0.
///
/// The median over actuators of the delay at which both correlate best, over the first 1.5 ms. It depends little on the
/// model: what comes back from the rim comes later. The second number is the spread, as half the range of the middle half.
///
/// # Errors
/// [`CalibrateError::Recording`] if there is none; [`CalibrateError::Dsp`] for a band out of range, or silence.
pub fn latency(
    found: &[Vec<f64>],
    model: &[Vec<f64>],
    lead: usize,
    rate: f64,
    band: Band,
) -> Result<[f64; 2], CalibrateError> {
    let mut delays = Vec::with_capacity(found.len());
    for (found, model) in found.iter().zip(model) {
        // Both go through the same, so that what a band does before time 0 is alike.
        let mut model: Vec<f64> = std::iter::repeat_n(0.0, lead).chain(model.iter().copied()).collect();
        let mut found = found.clone();
        band.limit(&mut model, rate)?;
        band.limit(&mut found, rate)?;
        gated(&mut model, lead as f64, rate);
        // Coarse first, over all there is, then gated where it was found.
        let coarse = Delay::between(&found, &model, rate, band)?.samples;
        gated(&mut found, lead as f64 + coarse, rate);
        delays.push(Delay::between(&found, &model, rate, band)?.samples);
    }
    delays.sort_unstable_by(f64::total_cmp);
    let quantile = |share: f64| delays.get(((delays.len() as f64 - 1.0) * share).round() as usize).copied();
    match (quantile(0.5), quantile(0.25), quantile(0.75)) {
        (Some(median), Some(low), Some(high)) => Ok([median, (high - low) / 2.0]),
        _ => Err(CalibrateError::Recording {
            what: "latency".into(),
            expected: "actuators that hear themselves".into(),
            found: "none".into(),
        }),
    }
}

fn gated(signal: &mut [f64], from: f64, rate: f64) {
    let length = ALONE * rate;
    Gate { begin: from - length, rise: length / 2.0, end: from + length, fall: length / 2.0 }.apply(signal);
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_dsp::shift;

    #[test]
    fn is_found_whatever_comes_back_from_the_rim() {
        let rate = 48e3;
        let band = Band::within(30.0, 3600.0);
        let ring = |hz: f64, t: f64| (-t / 0.07).exp() * (std::f64::consts::TAU * hz * t).cos();
        let made = |stretch: f64| -> Vec<f64> {
            let sum = |t: f64| (1..150).map(|m| ring(20.0 * f64::from(m) * stretch, t)).sum::<f64>();
            (0..4000).map(|i| if i < 200 { 0.0 } else { sum((i as f64 - 200.0) / rate) }).collect()
        };
        let model = made(1.0)[200..].to_vec();
        let found = [1.003, 0.997, 1.001].map(|stretch| shift(&made(stretch), 37.37)).to_vec();
        let [late, spread] = latency(&found, &vec![model; 3], 200, rate, band).unwrap();
        assert!((late - 37.37).abs() < 0.05 && spread < 0.05, "{late} {spread}");
    }
}
