//! A film whose tension has changed while it is played.

mod common;

use common::*;
use std::sync::Arc;
use unripple_calibrate::{Ping, PingOptions, Tracker, Tracking};
use unripple_core::{Phase, Responses};
use unripple_devices::{Feeler, Virtual, VirtualOptions};
use unripple_effects::{Button, Kind, Level};
use unripple_live::{Engine, FocusWorker, Follower, LiveOptions};
use unripple_physics::Modes;
use unripple_physics::stepper::InjectedFaults;

/// What is known of the tension.
#[derive(Clone, Copy, PartialEq)]
enum Known {
    Nominal,
    Followed,
    True,
}

fn tracker() -> Tracker {
    let Responses::Modal(modal) = KNOWN.as_ref() else { panic!() };
    let modes = Modes::solve(&FILM, 1500.0, 1e-6).unwrap();
    Tracker::new(modal, modes.bending_shares(), &Tracking { model: 0.02, ..Tracking::default() }).unwrap()
}

/// Responses of the film under another tension.
fn under(tension: f64) -> Responses {
    let Responses::Modal(mut modal) = KNOWN.as_ref().clone() else { panic!() };
    let modes = Modes::solve(&FILM, 1500.0, 1e-6).unwrap();
    for (pole, share) in modal.poles.iter_mut().zip(modes.bending_shares()) {
        pole.omega *= (1.0 + (tension - 1.0) * (1.0 - share)).sqrt();
    }
    Responses::Modal(modal)
}

/// What a finger feels of a click at each of four taps, in dB above threshold.
fn peaks(tension: f64, known: Known) -> Vec<f64> {
    let faults = InjectedFaults { tension: vec![(0.0, tension)], ..InjectedFaults::default() };
    let options = VirtualOptions { block: BLOCK, faults, ..VirtualOptions::default() };
    let device = Virtual::new(&FILM, &options).unwrap();
    let feeler = Feeler::new(device.handle(), &FILM, 2).unwrap();
    // A finger loads the sheet, and leaves it for most of two seconds.
    let taps = (0..3).flat_map(|i| {
        let time = 2.0 * f64::from(i);
        [touch(1, Phase::Down, 62.0, 90.0, time), touch(1, Phase::Up, 62.0, 90.0, time + 0.15)]
    });
    let script = Script::new(taps.collect());
    let options = LiveOptions::new(&FILM, WINDOW);
    let responses = match known {
        Known::True => Arc::new(under(tension)),
        _ => KNOWN.clone(),
    };
    // As strong as is felt well, so that a ping is not lost in what is left of it.
    let soft = one(Kind::Button(Button { press_force: None, release: 0.5 }), Level::Share(0.004));
    let maker = FocusWorker::new(responses, &options.focus).unwrap();
    let mut engine =
        Engine::new(&FILM, maker, &soft, sources(vec![Box::new(script)]), Box::new(device), &options)
            .unwrap();
    if known == Known::Followed {
        let Responses::Modal(modal) = KNOWN.as_ref() else { panic!() };
        let ping = Ping::design(modal, &PingOptions::default()).unwrap();
        let follower = Follower::new(tracker(), &options.focus, 8, RATE, 0.4, 0);
        engine = engine.with_follower(follower, &ping).unwrap();
    }
    engine = engine.with_feeler(feeler);
    let block = |seconds: f64| (seconds * RATE / BLOCK as f64) as usize;
    (0..3)
        .map(|_| {
            // Just before the finger leaves.
            (0..block(0.14)).for_each(|_| engine.step().unwrap());
            let level = engine.stage().feelings()[0].level_db.unwrap();
            (0..block(1.86)).for_each(|_| engine.step().unwrap());
            engine.stage().feelings();
            level
        })
        .collect()
}

#[test]
fn drives_follow_the_tension() {
    let best = peaks(1.05, Known::True);
    let lost = peaks(1.05, Known::Nominal);
    let held = peaks(1.05, Known::Followed);
    println!("felt, dB: tension known {best:.2?}, not followed {lost:.2?}, followed {held:.2?}");
    // The first is played before anything was heard.
    for i in 1..3 {
        assert!(lost[i] < best[i] - 0.3, "{i}");
        assert!((held[i] - best[i]).abs() < 0.1, "{i}");
    }
}
