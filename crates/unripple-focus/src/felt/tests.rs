//! The parts of a plan against the sums that define them.

#[path = "../../tests/common/mod.rs"]
mod common;

use super::{FeltOptions, FeltPlan};
use crate::Target;
use common::Membrane;
use unripple_core::{Drive, ModalResponses, Point, Responses};
use unripple_dsp::Weighting;
use unripple_linalg::{Lu, Mat, product};

/// Displacement at a point weighted by the threshold of touch, at every sample from the start of the drive
/// until twice its length after its end.
pub fn felt(modal: &ModalResponses, drive: &Drive, at: Point, options: &FeltOptions) -> Vec<f64> {
    let (length, rate) = (3 * drive.samples(), drive.rate());
    let mut row = vec![0.0; modal.poles.len()];
    modal.shapes.at(at, &mut row);
    let mut displacement = vec![0.0; length];
    for (m, pole) in modal.poles.iter().enumerate() {
        let ringing: Vec<f64> = (0..length).map(|i| pole.displacement(i as f64 / rate) / rate).collect();
        let force: Vec<f64> = (0..drive.samples())
            .map(|j| (0..modal.ports.len()).map(|a| modal.input[(a, m)] * drive.channels()[a][j]).sum())
            .collect();
        let motion = unripple_dsp::convolve(&force, &ringing);
        displacement.iter_mut().zip(motion).for_each(|(u, q)| *u += row[m] * q);
    }
    Weighting::padded(&options.threshold, rate, length, length).weigh(&displacement)
}

#[test]
fn what_is_watched_is_what_is_felt() {
    let membrane = Membrane { top_hz: 3000.0, ..Membrane::small() };
    let modal = membrane.modal();
    let responses = Responses::Modal(modal.clone());
    let options = FeltOptions { window: 12e-3, lead: 3e-3, ..FeltOptions::default() };
    let plan = FeltPlan::new(&responses, &options).unwrap();
    let targets = [Target::at(Point::new(0.041, 0.052))];
    let coefficients = plan.coefficients(&targets).unwrap();
    let names = modal.ports.iter().map(|port| port.name.clone()).collect();
    let drive = Drive::new(membrane.rate, names, plan.channels(&coefficients)).unwrap();
    let chosen = plan.outside(&targets);
    let shapes = &plan.control.shapes;
    let shapes = Mat::from_fn(shapes.nrows(), chosen.len(), |m, p| shapes[(m, chosen[p])]);
    let found = plan.watch.field(&coefficients, &shapes);
    let level = felt(&modal, &drive, targets[0].points[0], &options)[plan.focal];
    assert!((level - 1.0).abs() < 0.02, "{level}");
    let mut worst = 0.0_f64;
    for p in (0..chosen.len()).step_by(7) {
        let own = felt(&modal, &drive, plan.control.points[chosen[p]], &options);
        for (t, time) in
            plan.watch.times.iter().enumerate().filter(|(_, time)| plan.focal as i64 + **time >= 0)
        {
            let at = (plan.focal as i64 + time) as usize;
            worst = worst.max((f64::from(found[(t, p)]) - own[at]).abs());
        }
    }
    // Modes above 0.8 of the highest frequency felt are left out of the watch: as much as its slack.
    assert!(worst < 0.03, "{worst} of the target's level");
}

/// The form of the mean and of the energy, and what is felt at a point at the focal instant, from sums over time.
struct Sums {
    form: Mat<f64>,
    level: Vec<f64>,
}

impl Sums {
    fn of(plan: &FeltPlan<'_>, modal: &ModalResponses, membrane: &Membrane, at: Point) -> Self {
        let (rate, count, ports) = (membrane.rate, plan.splines.count(), modal.ports.len());
        let (before, length) = (plan.splines.samples, 12 * plan.splines.samples);
        let weighting = Weighting::padded(&plan.options.threshold, rate, length, before);
        let mut row = vec![0.0; modal.poles.len()];
        modal.shapes.at(at, &mut row);
        let size = ports * count;
        let (mut form, mut level) = (Mat::<f64>::zeros(size, size), vec![0.0; size]);
        for (m, pole) in modal.poles.iter().enumerate() {
            let ringing: Vec<f64> = (0..length).map(|i| pole.displacement(i as f64 / rate) / rate).collect();
            // As if each spline began a window later, so that what is felt beforehand counts as well.
            let mut motion = Mat::<f64>::zeros(length, count);
            for k in 0..count {
                let mut force = vec![0.0; before];
                force.extend(plan.splines.signal(k));
                let whole = unripple_dsp::convolve(&force, &ringing);
                let felt = weighting.weigh(&whole[..length]);
                motion.col_as_slice_mut(k).copy_from_slice(&felt[..length]);
            }
            let squares = product(motion.transpose(), motion.as_ref());
            for i in 0..size {
                let weight = |i: usize| modal.input[(i / count, m)];
                level[i] += row[m] * weight(i) * motion[(before + plan.focal, i % count)];
                for j in 0..size {
                    form[(i, j)] += weight(i) * weight(j) * squares[(i % count, j % count)];
                }
            }
        }
        // Over the surface, the product of two shapes is 1/(ρ A) on average, or nothing.
        let mass = membrane.areal_density * membrane.width * membrane.height;
        let mean = 1.0 / (mass * 2.0 * (plan.splines.samples - 1) as f64);
        let products = plan.splines.products();
        let trace = |of: &dyn Fn(usize) -> f64| (0..size).map(of).sum::<f64>();
        let energy = plan.options.economy * mean * trace(&|i| form[(i, i)])
            / trace(&|i| products[(i % count, i % count)]);
        let form = Mat::from_fn(size, size, |i, j| {
            let own = if i / count == j / count { products[(i % count, j % count)] } else { 0.0 };
            mean * form[(i, j)] + energy * own
        });
        Self { form, level }
    }

    fn cost(&self, coefficients: &[f64]) -> f64 {
        let n = coefficients.len();
        (0..n)
            .map(|i| (0..n).map(|j| coefficients[i] * self.form[(i, j)] * coefficients[j]).sum::<f64>())
            .sum()
    }
}

#[test]
fn no_drive_is_felt_less_on_average() {
    let membrane = Membrane { top_hz: 2000.0, ..Membrane::small() };
    let modal = membrane.modal();
    let responses = Responses::Modal(modal.clone());
    for economy in [0.01, 0.1, 1.0] {
        let options =
            FeltOptions { window: 12e-3, lead: 3e-3, worst: 0.0, economy, ..FeltOptions::default() };
        let plan = FeltPlan::new(&responses, &options).unwrap();
        let at = Point::new(0.041, 0.052);
        let found = plan.coefficients(&[Target::at(at)]).unwrap();
        let sums = Sums::of(&plan, &modal, &membrane, at);
        let right = Mat::from_fn(found.len(), 1, |i, _| sums.level[i]);
        let mut best = right.clone();
        Lu::new(sums.form.as_ref()).solve(best.as_mut());
        let level = |c: &[f64]| c.iter().zip(&sums.level).map(|(c, g)| c * g).sum::<f64>();
        let price = |c: &[f64]| sums.cost(c) / level(c).powi(2);
        let (ours, least) = (price(&found), price(best.col_as_slice(0)));
        assert!((level(&found) - 1.0).abs() < 0.01, "{}", level(&found));
        assert!(ours < 1.01 * least, "economy {economy}: {ours} {least}");
    }
}
