//! Truth: stretches of time counted one by one, and the plant that was put in.

use crate::signals_bench;

use signals_bench::{Noise, Plant, RATE, error, hear, limited};
use unripple_calibrate::signals::{Deconvolver, Inversion, Schedule, Sweep};

/// What is heard of all actuators at once.
fn heard(schedule: &Schedule, responses: &[Vec<f64>], periods: usize) -> Vec<f64> {
    let samples = schedule.samples();
    let mut sum = vec![0.0; samples];
    for (actuator, response) in responses.iter().enumerate() {
        let mut drive = vec![0.0; samples * periods];
        schedule.drive(actuator, &mut drive).unwrap();
        let all = hear(response, &drive, samples * periods);
        sum.iter_mut().zip(&all[samples * (periods - 1)..]).for_each(|(a, b)| *a += b);
    }
    sum
}

/// Errors of every actuator's response over the window.
fn errors(schedule: &Schedule, responses: &[Vec<f64>], heard: &[f64], lead: usize) -> Vec<f64> {
    let inversion = Inversion { lead, ..Inversion::default() };
    let plan = Deconvolver::new(schedule.stimulus(), heard.len(), &inversion).unwrap();
    let mut whole = vec![0.0; plan.size()];
    plan.deconvolve(heard, &mut whole, &mut plan.workspace()).unwrap();
    let one = |(actuator, response): (usize, &Vec<f64>)| {
        let mut found = vec![0.0; schedule.window()];
        schedule.cut(&whole, actuator, &mut found).unwrap();
        let mut truth = limited(response, schedule.stimulus().band(), lead);
        truth.resize(found.len(), 0.0);
        error(&found, &truth)
    };
    responses.iter().enumerate().map(one).collect()
}

#[test]
fn responses_and_harmonics_of_interleaved_sweeps_do_not_meet() {
    for (seconds, actuators, window, order) in [
        (1.0, 8, 16_000, 3),
        (0.3, 8, 24_000, 2),
        (3.0, 8, 16_000, 5),
        (3.0, 3, 2_000, 4),
        (1.0, 8, 16_000, 1),
        (2.0, 1, 9, 2),
    ] {
        let sweep = Sweep { seconds, ..Sweep::default() };
        let schedule = Schedule::interleaved(&sweep, actuators, window, order).unwrap();
        let starts = schedule.starts();
        assert_eq!(starts.len(), actuators);
        for (a, start) in starts.iter().enumerate() {
            for (b, other) in starts.iter().enumerate() {
                for m in 1..=order {
                    if a == b && m == 1 {
                        continue;
                    }
                    let begin = *other as f64 - sweep.lead(m) * RATE;
                    let clear = begin >= (start + window) as f64 - 1e-6
                        || begin + window as f64 <= *start as f64 + 1e-6;
                    // An actuator's own harmonics lie where the sweep's growth puts them.
                    assert!(clear || a == b, "{seconds} s, {actuators}: {a} meets order {m} of {b}");
                }
            }
        }
        let sequential = Schedule::sequential(sweep.stimulus().unwrap(), actuators, window).unwrap();
        assert!(schedule.samples() <= sequential.samples());
    }
    let sweep = Sweep::default();
    assert!(Schedule::interleaved(&sweep, 8, 100, 0).is_err());
    assert!(Schedule::interleaved(&sweep, 8, 100, 121).is_err());
    assert!(Schedule::interleaved(&sweep, 0, 100, 2).is_err());
    assert!(Schedule::interleaved(&sweep, 8, 0, 2).is_err());
}

#[test]
fn every_plan_gives_back_what_was_put_in() {
    let (lead, window) = (2_000, 18_000);
    let responses: Vec<Vec<f64>> = (0..4).map(|a| Plant::new(a, 120, 0.03).response(window - lead)).collect();
    let sweep = Sweep { seconds: 0.4, ..Sweep::default() };
    let stimulus = sweep.stimulus().unwrap();
    let period = Sweep { silence: 4.0 * window as f64 / RATE - sweep.sounding() - 1.0 / RATE, ..sweep };
    for (schedule, periods, limit) in [
        (Schedule::sequential(stimulus.clone(), 4, window).unwrap(), 1, 2e-3),
        (Schedule::interleaved(&sweep, 4, window, 1).unwrap(), 1, 2e-3),
        (Schedule::interleaved(&sweep, 4, window, 3).unwrap(), 1, 2e-3),
        (Schedule::simultaneous(period.stimulus().unwrap().repeated(), 4).unwrap(), 2, 2e-3),
    ] {
        let heard = heard(&schedule, &responses, periods);
        let errors = errors(&schedule, &responses, &heard, lead);
        assert!(errors.iter().all(|error| *error < limit), "{errors:?} of {limit}");
    }
    assert!(Schedule::sequential(stimulus.clone().repeated(), 4, window).is_err());
    assert!(Schedule::simultaneous(stimulus, 4).is_err());
}

#[test]
fn distortion_does_not_reach_the_interleaved_responses() {
    let (lead, window) = (3_000, 12_000);
    let responses: Vec<Vec<f64>> =
        (0..4).map(|a| Plant::new(a + 9, 120, 0.02).response(window - lead)).collect();
    let sweep = Sweep { seconds: 1.0, ..Sweep::default() };
    let run = |order: usize| {
        let schedule = Schedule::interleaved(&sweep, 4, window, order).unwrap();
        let samples = schedule.samples();
        let mut sum = vec![0.0; samples];
        for (actuator, response) in responses.iter().enumerate() {
            let mut drive = vec![0.0; samples];
            schedule.drive(actuator, &mut drive).unwrap();
            // A second harmonic of 5 %, whose mean is outside the band.
            drive.iter_mut().for_each(|x| *x += 0.1 * *x * *x);
            sum.iter_mut().zip(hear(response, &drive, samples)).for_each(|(a, b)| *a += b);
        }
        errors(&schedule, &responses, &sum, lead).into_iter().fold(0.0, f64::max)
    };
    let [apart, together] = [run(2), run(1)];
    assert!(apart < 5e-3 && together > 3.0 * apart, "{apart} {together}");
}

#[test]
fn eight_actuators_are_measured_to_a_hundredth_at_fifty_db() {
    let window = 18_000;
    let responses: Vec<Vec<f64>> = (0..8).map(|a| Plant::new(a + 20, 306, 0.07).response(24_000)).collect();
    let sweep = Sweep { seconds: 0.5, from: 60.0, ..Sweep::default() };
    let schedule = Schedule::interleaved(&sweep, 8, window, 1).unwrap();
    let mut heard = heard(&schedule, &responses, 1);
    Noise(30).spoil(&mut heard, 50.0);
    let truths: Vec<Vec<f64>> = responses.iter().map(|r| r[..window - 1_000].to_vec()).collect();
    let errors = errors(&schedule, &truths, &heard, 1_000);
    assert!(errors.iter().all(|error| *error < 0.012), "{errors:?}");
}
