//! Assignment of channels to actuators and sensors by normalised correlation.

use super::take::{ABOVE_NOISE, Takes};
use std::collections::HashMap;
use unripple_core::Layout;
use unripple_dsp::{Convolver, rms};

/// Smallest level of a channel with a signal, relative to the loudest channel: -40 dB.
const ABOVE_OTHERS: f64 = 0.01;

/// Smallest mean increase of the correlation, over the recordings concerned, at which an exchange of wires
/// is accepted. Without it noise would exchange channels that are nearly alike.
const WORTH: f64 = 0.05;

/// The actuator to which each output is wired, and the sensor to which each input is wired.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Routes {
    pub(super) outputs: Vec<usize>,
    pub(super) inputs: Vec<usize>,
}

/// Normalised correlations of recordings with predictions, each computed when it is first needed.
#[derive(Debug)]
pub(super) struct Likeness<'a> {
    takes: &'a Takes,
    predicted: &'a [Vec<f64>],
    pub(super) latency: usize,
    pub(super) silent_outputs: Vec<bool>,
    pub(super) silent_inputs: Vec<bool>,
    known: HashMap<(usize, usize), f64>,
}

/// The latency, in samples, at which recordings correlate best with their predictions, over all pairs.
pub(super) fn latency(takes: &Takes, predicted: &[Vec<f64>]) -> usize {
    let plan = Convolver::new(takes.window + takes.most + takes.window);
    let mut sum = vec![0.0; takes.most + 1];
    for (heard, predicted) in takes.heard.iter().zip(predicted) {
        let power = (rms(heard) * rms(predicted)).powi(2);
        if power == 0.0 {
            continue;
        }
        let mut product = plan.spectrum(heard.iter().copied());
        let backwards = plan.spectrum(predicted.iter().rev().copied());
        product.iter_mut().zip(backwards).for_each(|(a, b)| *a *= b);
        let correlation = plan.signal(product);
        // Reversed, the prediction's first sample is its last.
        let aligned = correlation.iter().skip(predicted.len().saturating_sub(1));
        sum.iter_mut().zip(aligned).for_each(|(sum, c)| *sum += c * c / power);
    }
    (0..sum.len()).max_by(|a, b| sum[*a].total_cmp(&sum[*b])).unwrap_or(0)
}

impl<'a> Likeness<'a> {
    pub(super) fn new(takes: &'a Takes, predicted: &'a [Vec<f64>], latency: usize) -> Self {
        let Takes { outputs, inputs, .. } = *takes;
        let part = |pair: usize| {
            let heard = &takes.heard[pair];
            let from = latency.min(heard.len());
            &heard[from..(latency + takes.window).min(heard.len())]
        };
        let level = |pair: usize| rms(part(pair));
        let loud = |pair: &usize| level(*pair) > ABOVE_NOISE * takes.noise[*pair];
        let loudest = (0..outputs * inputs).map(level).fold(0.0, f64::max);
        let alive = |pairs: Vec<usize>| {
            let share = |pair: &usize| {
                // A probe may have another unit than sensors: its predictions determine how loud it should
                // be.
                let expected = rms(&predicted[*pair]);
                let most = predicted.iter().map(|p| rms(p)).fold(0.0, f64::max);
                if most > 0.0 { ABOVE_OTHERS * loudest * expected / most } else { 0.0 }
            };
            pairs.iter().any(|pair| loud(pair) && level(*pair) > share(pair))
        };
        let silent_outputs =
            (0..outputs).map(|o| !alive((0..inputs).map(|i| o * inputs + i).collect())).collect();
        let silent_inputs =
            (0..inputs).map(|i| !alive((0..outputs).map(|o| o * inputs + i).collect())).collect();
        Self { takes, predicted, latency, silent_outputs, silent_inputs, known: HashMap::new() }
    }

    /// Normalised correlation of a recording with a prediction, -1 to 1; 0 where a channel is silent.
    pub(super) fn of(&mut self, (output, input): (usize, usize), (actuator, sensor): (usize, usize)) -> f64 {
        if self.silent_outputs[output] || self.silent_inputs[input] {
            return 0.0;
        }
        let inputs = self.takes.inputs;
        let key = (output * inputs + input, actuator * inputs + sensor);
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let heard = &self.takes.heard[key.0][self.latency.min(self.takes.heard[key.0].len())..];
        let (mut both, mut power) = (0.0, 0.0);
        let predicted = &self.predicted[key.1];
        for (x, p) in heard.iter().zip(predicted) {
            both += x * p;
            power += x * x;
        }
        let other: f64 = predicted.iter().map(|p| p * p).sum();
        let value = if power * other > 0.0 { both / (power * other).sqrt() } else { 0.0 };
        self.known.insert(key, value);
        value
    }

    /// Sum of the correlations of all recordings with their predictions, by magnitude.
    fn all(&mut self, routes: &Routes) -> f64 {
        let pairs = pairs(self.takes.outputs, self.takes.inputs);
        pairs.map(|(o, i)| self.of((o, i), (routes.outputs[o], routes.inputs[i])).abs()).sum()
    }
}

fn pairs(outputs: usize, inputs: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..outputs).flat_map(move |o| (0..inputs).map(move |i| (o, i)))
}

/// The routes that explain the recordings best: exchanges of wires, as long as they raise the sum of correlations.
pub(super) fn routes(likeness: &mut Likeness, layout: &Layout) -> Routes {
    let Takes { outputs, inputs, .. } = *likeness.takes;
    let mut routes = Routes { outputs: (0..outputs).collect(), inputs: (0..inputs).collect() };
    let twin: Vec<Option<usize>> =
        layout.outputs.iter().map(|name| layout.inputs.iter().position(|other| other == name)).collect();
    let mut score = likeness.all(&routes);
    // Each exchange raises the score by a minimum amount, so that the loop ends.
    loop {
        let mut best: Option<(f64, f64, Routes)> = None;
        let mut attempt = |next: Routes, touched: usize, likeness: &mut Likeness| {
            let found = likeness.all(&next);
            let worth = found - score - WORTH * touched as f64;
            if worth > 0.0 && best.as_ref().is_none_or(|(most, ..)| found > *most) {
                best = Some((found, worth, next));
            }
        };
        for (a, b) in pairs(outputs, outputs).filter(|(a, b)| a < b) {
            let mut next = routes.clone();
            next.outputs.swap(a, b);
            attempt(next.clone(), 2 * inputs, likeness);
            if let (Some(c), Some(d)) = (twin[a], twin[b]) {
                next.inputs.swap(c, d);
                attempt(next, 2 * inputs, likeness);
            }
        }
        for (a, b) in pairs(inputs, inputs).filter(|(a, b)| a < b) {
            let mut next = routes.clone();
            next.inputs.swap(a, b);
            attempt(next, 2 * outputs, likeness);
        }
        match best {
            Some((found, _, next)) => (score, routes) = (found, next),
            None => return routes,
        }
    }
}

/// Signs of outputs and inputs whose products are the signs of the correlations, with as few negative ones as
/// possible.
pub(super) fn signs(likeness: &mut Likeness, routes: &Routes) -> (Vec<f64>, Vec<f64>) {
    let Takes { outputs, inputs, .. } = *likeness.takes;
    let (mut sent, mut heard) = (vec![1.0; outputs], vec![1.0; inputs]);
    for _ in 0..outputs + inputs {
        let mut of = |o: usize, i: usize| likeness.of((o, i), (routes.outputs[o], routes.inputs[i]));
        let sign = |sum: f64| if sum < 0.0 { -1.0 } else { 1.0 };
        let next: Vec<f64> =
            (0..inputs).map(|i| sign((0..outputs).map(|o| sent[o] * of(o, i)).sum())).collect();
        let back: Vec<f64> =
            (0..outputs).map(|o| sign((0..inputs).map(|i| next[i] * of(o, i)).sum())).collect();
        if (&next, &back) == (&heard, &sent) {
            break;
        }
        (heard, sent) = (next, back);
    }
    let negative = sent.iter().chain(&heard).filter(|sign| **sign < 0.0).count();
    if 2 * negative > outputs + inputs {
        sent.iter_mut().chain(&mut heard).for_each(|sign| *sign = -*sign);
    }
    (sent, heard)
}
