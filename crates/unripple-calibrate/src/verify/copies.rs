//! Points whose responses are copies of one recording.

use super::verdict::{Doubted, VerifyOptions};
use unripple_core::SampledResponses;

/// Distance, in shortest wavelengths, beyond which the responses of two places must differ.
const APART: f64 = 0.25;

/// Smallest correlation at which two responses count as one recording: two true repeats, each with noise 30
/// dB below the signal, correlate that well.
const ONE: f64 = 0.999;

/// Number of actuators whose responses are compared first, and (`SAMPLES`) number of samples of each: the
/// other actuators are compared only if these agree.
const ACTUATORS: usize = 4;
const SAMPLES: usize = 1024;

/// Points whose responses equal those of another point, except for a gain.
pub(super) fn doubts(probed: &SampledResponses, options: &VerifyOptions) -> Vec<Doubted> {
    let samples = probed.samples().min(SAMPLES);
    let signature = |p: usize, count: usize| {
        let all = (0..count).flat_map(|a| probed.response(a, p)[..samples].iter());
        let mut values: Vec<f32> = all.copied().collect();
        let norm = values.iter().map(|x| x * x).sum::<f32>().sqrt();
        values.iter_mut().for_each(|x| *x /= norm.max(f32::MIN_POSITIVE));
        values
    };
    let likeness = |a: &[f32], b: &[f32]| f64::from(a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>().abs());
    let all: Vec<Vec<f32>> =
        (0..probed.points.len()).map(|p| signature(p, probed.ports.len().min(ACTUATORS))).collect();
    let far = APART * probed.conditions.lambda_min;
    let mut doubts = Vec::new();
    for (p, one) in all.iter().enumerate() {
        // An actuator on an axis of symmetry has the same responses at points that mirror each other: all actuators
        // have to agree.
        let whole = |q: usize| {
            let [a, b] = [p, q].map(|point| signature(point, probed.ports.len()));
            likeness(&a, &b) > ONE
        };
        let alike = |q: &usize| {
            likeness(one, &all[*q]) > ONE && probed.points[p].distance(probed.points[*q]) > far && whole(*q)
        };
        if let Some(q) = (0..p).find(alike) {
            doubts.push(Doubted {
                what: format!(
                    "points {} and {}: expected two recordings, found the same responses at both (is one file a copy of the \
                     other? measure both again)",
                    options.number(q),
                    options.number(p)
                ),
                points: vec![q, p],
            });
        }
    }
    doubts
}
