//! A film whose tension has changed while it is played.

mod common;

use common::*;
use std::sync::Arc;
use unripple_calibrate::{Tracker, Tracking};
use unripple_core::{Phase, Point, Responses};
use unripple_devices::{Virtual, VirtualOptions};
use unripple_live::{Engine, Follower, LiveOptions, Maker};
use unripple_physics::Modes;
use unripple_physics::stepper::Mishaps;

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
    Tracker::new(modal, modes.bending_shares(), &Tracking::default()).unwrap()
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

/// Largest displacement at the target from each tap to the next.
fn peaks(tension: f64, known: Known) -> Vec<f64> {
    let at = Point::from_mm(62.0, 90.0);
    let mishaps = Mishaps { tension: vec![(0.0, tension)], ..Mishaps::default() };
    let options = VirtualOptions { block: BLOCK, mishaps, ..VirtualOptions::default() };
    let device = Virtual::new(&FILM, &options).unwrap();
    let handle = device.handle();
    handle.watch(&[at], 1).unwrap();
    let taps = (0..6).flat_map(|i| {
        let time = 0.2 * f64::from(i);
        [touch(1, Phase::Down, 62.0, 90.0, time), touch(1, Phase::Up, 62.0, 90.0, time + 0.15)]
    });
    let script = Script::new(taps.collect());
    let options = LiveOptions::new(&FILM, WINDOW);
    let responses = match known {
        Known::True => Arc::new(under(tension)),
        _ => KNOWN.clone(),
    };
    let maker = Maker::new(responses, &options.focus).unwrap();
    let mut engine =
        Engine::new(&FILM, maker, &clicks(), sources(vec![Box::new(script)]), Box::new(device), &options)
            .unwrap();
    if known == Known::Followed {
        engine = engine.with_follower(Follower::new(tracker(), &options.focus, 8, RATE, 0.2, 0));
    }
    let blocks = (0.2 * RATE / BLOCK as f64) as usize;
    (0..6)
        .map(|_| {
            (0..blocks).for_each(|_| engine.step().unwrap());
            handle.watched()[0].iter().fold(0.0, |m: f64, u| m.max(f64::from(u.abs())))
        })
        .collect()
}

#[test]
fn drives_follow_the_tension() {
    let best = peaks(1.05, Known::True);
    let lost = peaks(1.05, Known::Nominal);
    let held = peaks(1.05, Known::Followed);
    println!("tension known {best:.6?}\nnot followed {lost:.6?}\nfollowed {held:.6?}");
    // The first is played before anything was heard.
    for i in 2..6 {
        assert!(lost[i] < 0.85 * best[i], "{i}");
        assert!(held[i] > 0.99 * best[i], "{i}");
    }
}
