//! Responses from taps of unknown force: estimate of the force, then deconvolution by it.

use crate::CalibrateError;
use crate::signals::{Band, Deconvolver, Inversion, Stimulus};
use unripple_linalg::{Cholesky, Mat, product, squared_norm};

/// Assumptions about taps before they are recorded: length, and how far the model is trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TapOptions {
    /// Longest time a tap takes, bounces included, in s.
    pub length: f64,
    /// Time after a tap, in s, in which the model is trusted: that of the first reflections, which a small error of
    /// tension hardly moves.
    pub early: f64,
    /// Regularisation of the deconvolution: power added to the tap's spectrum, relative to its strongest line in the
    /// band.
    pub floor: f64,
}

impl Default for TapOptions {
    fn default() -> Self {
        Self { length: 2.5e-3, early: 6e-3, floor: 1e-3 }
    }
}

/// Responses found from taps at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Tapped {
    /// Response of each actuator at the place, by reciprocity, in m/s per unit impulse; time 0 is the start of the tap.
    pub responses: Vec<Vec<f64>>,
    /// Force of each tap in N, at the rate of the recording.
    pub forces: Vec<Vec<f64>>,
    /// Share of the power of the early signals that force and model do not explain.
    pub unexplained: f64,
}

/// Responses of actuators at a place from taps there, of any shape and strength, recorded by the actuators as sensors.
///
/// The signal of sensor a is `s_a = h_a * f`, with the same force f for all. First f is estimated, as the smooth force
/// of at most [`TapOptions::length`] that, with the model's responses, best explains the first [`TapOptions::early`]
/// seconds of all sensors in the least-squares sense; then each h_a is s_a deconvolved by f. The model thus determines
/// the strength and fine shape of a pulse of a few milliseconds, and nothing of the responses themselves.
///
/// `heard` is `[tap][sensor][sample]`, latency removed; `model` is `[sensor][sample]` at the same place and rate.
///
/// # Errors
/// [`CalibrateError::Recording`] if no sensor has a signal; [`CalibrateError::Count`] if sensors and model disagree;
/// [`CalibrateError::Dsp`] from deconvolution.
pub fn tapped(
    heard: &[Vec<Vec<f64>>],
    model: &[Vec<f64>],
    samples: usize,
    rate: f64,
    band: Band,
    options: &TapOptions,
) -> Result<Tapped, CalibrateError> {
    let model: Vec<Vec<f64>> = model
        .iter()
        .map(|response| {
            let mut limited = response.clone();
            band.limit(&mut limited, rate).map(|()| limited)
        })
        .collect::<Result<_, _>>()?;
    let mut total = vec![vec![0.0; samples]; model.len()];
    let (mut weight, mut forces, mut unexplained) = (0.0, Vec::new(), 0.0);
    for (tap, sensors) in heard.iter().enumerate() {
        if sensors.len() != model.len() {
            let expected = format!("{}, one per actuator", model.len());
            return Err(CalibrateError::Count {
                what: "sensors that recorded a tap",
                expected,
                found: sensors.len(),
            });
        }
        let Some(begin) = begin(sensors, rate, options) else {
            return Err(CalibrateError::Recording {
                what: format!("tap {}", tap + 1),
                expected: "a tap that the sensors record".into(),
                found: "nothing above the noise".into(),
            });
        };
        let cut = |s: &Vec<f64>| {
            let mut cut = s[begin.min(s.len())..].to_vec();
            band.limit(&mut cut, rate).map(|()| cut)
        };
        let cut = sensors.iter().map(cut).collect::<Result<Vec<_>, _>>()?;
        let (force, left) = force(&cut, &model, rate, band, options)?;
        let energy: f64 = force.iter().map(|f| f * f).sum();
        for (sum, response) in total.iter_mut().zip(divided(&cut, &force, samples, rate, band, options)?) {
            sum.iter_mut().zip(response).for_each(|(sum, h)| *sum += energy * h);
        }
        weight += energy;
        unexplained += energy * left;
        forces.push(force);
    }
    let scale = if weight > 0.0 { 1.0 / weight } else { 0.0 };
    total.iter_mut().flatten().for_each(|h| *h *= scale);
    Ok(Tapped { responses: total, forces, unexplained: unexplained * scale })
}

/// The sample one tap's length before that at which any sensor first reaches a tenth of its own peak.
fn begin(sensors: &[Vec<f64>], rate: f64, options: &TapOptions) -> Option<usize> {
    let first = |s: &Vec<f64>| {
        let peak = s.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        s.iter().position(|x| peak > 0.0 && x.abs() >= 0.1 * peak)
    };
    let first = sensors.iter().filter_map(first).min()?;
    Some(first.saturating_sub((options.length * rate) as usize))
}

/// The force of a tap, and the share of the power of the early signals that it leaves unexplained.
fn force(
    heard: &[Vec<f64>],
    model: &[Vec<f64>],
    rate: f64,
    band: Band,
    options: &TapOptions,
) -> Result<(Vec<f64>, f64), CalibrateError> {
    // Knots as close as the band's top asks for; the force may begin a tap's length before it is heard, and end as late.
    let step = (rate / (3.0 * band.high[1].min(rate / 3.0))).round().max(1.0) as usize;
    let span = (2.0 * options.length * rate) as usize;
    let early = span + (options.early * rate) as usize;
    let knots = span / step + 1;
    // Response to a triangular force at a knot; triangles add up to straight lines between knots.
    let hat: Vec<f64> =
        (0..2 * step - 1).map(|i| 1.0 - (i as f64 + 1.0 - step as f64).abs() / step as f64).collect();
    let rows = heard.len() * early;
    let mut design = Mat::<f64>::zeros(rows, knots);
    let mut sound = Mat::<f64>::zeros(rows, 1);
    for (a, (heard, model)) in heard.iter().zip(model).enumerate() {
        let moved: Vec<f64> = (0..early)
            .map(|i| {
                let reach = hat.iter().enumerate().filter(|(j, _)| *j <= i);
                reach.map(|(j, f)| f * model.get(i - j).copied().unwrap_or(0.0)).sum::<f64>() / rate
            })
            .collect();
        for i in 0..early {
            sound[(a * early + i, 0)] = heard.get(i).copied().unwrap_or(0.0);
            (0..knots)
                .filter(|k| k * step <= i)
                .for_each(|k| design[(a * early + i, k)] = moved[i - k * step]);
        }
    }
    let mut normal = product(design.transpose(), design.as_ref());
    let ridge = 1e-4 * (0..knots).map(|k| normal[(k, k)]).sum::<f64>() / knots as f64;
    (0..knots).for_each(|k| normal[(k, k)] += ridge);
    let unsolvable = || CalibrateError::Recording {
        what: "force of a tap".into(),
        expected: "a model that moves at the place".into(),
        found: "one at rest".into(),
    };
    let factor = Cholesky::new(normal.as_ref()).ok_or_else(unsolvable)?;
    let mut found = product(design.transpose(), sound.as_ref());
    factor.solve(found.as_mut());
    let left = squared_norm((&sound - product(design.as_ref(), found.as_ref())).as_ref())
        / squared_norm(sound.as_ref()).max(f64::MIN_POSITIVE);
    let mut force = vec![0.0; span + 2 * step];
    for k in 0..knots {
        hat.iter().enumerate().for_each(|(j, f)| force[k * step + j] += f * found[(k, 0)]);
    }
    Ok((force, left))
}

/// Each sensor's signal deconvolved by the force.
fn divided(
    heard: &[Vec<f64>],
    force: &[f64],
    samples: usize,
    rate: f64,
    band: Band,
    options: &TapOptions,
) -> Result<Vec<Vec<f64>>, CalibrateError> {
    let stimulus = Stimulus::new(force.to_vec(), rate)?.in_band(band)?;
    let length = heard.iter().map(Vec::len).min().unwrap_or(0).max(force.len());
    let inversion = Inversion { regularisation: options.floor, ..Inversion::default() };
    let plan = Deconvolver::new(&stimulus, length, &inversion)?;
    let mut workspace = plan.workspace();
    heard
        .iter()
        .map(|sound| {
            let mut sound = sound.clone();
            sound.resize(length, 0.0);
            let mut response = vec![0.0; samples.min(plan.size())];
            plan.deconvolve(&sound, &mut response, &mut workspace)?;
            response.resize(samples, 0.0);
            Ok(response)
        })
        .collect()
}
