//! The parts of a plan against the sums that define them.

#[path = "../../tests/common/mod.rs"]
mod common;

use super::{FeltOptions, FeltPlan};
use crate::Target;
use common::Membrane;
use faer::Mat;
use unripple_core::{Drive, ModalResponses, Point, Responses};
use unripple_dsp::Weighting;

/// Weighed displacement at a point, at every sample of the drive and twice as long again.
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
