//! Whatever comes in, work and cues are bounded, voices end, and the same calls give the same cues.

use crate::common;

use common::{effect, heard, set, sheet, texture};
use proptest::prelude::*;
use std::collections::HashMap;
use unripple_core::{Phase, Point, Touch};
use unripple_effects::{
    Act, Anchor, Button, Cue, Curve, Edge, Effect, Effects, Envelope, Event, Hum, Kind, Level, Notch, Region,
    Score, Sound, Start, Tone, Trace, Traced, Train, limits,
};

/// One effect of every kind.
fn all() -> Vec<Effect> {
    let envelope = Envelope::new(vec![(0.0, 0.0), (0.02, 1.0), (0.05, 0.0)], vec![(0.0, 100.0)]).unwrap();
    let ramp = Curve::new("speed", vec![(0.0, 0.1), (0.2, 1.0)], [0.0, 1.0], [0.0, 1.0]).unwrap();
    let event = |at, sound| Event { at, gain: 0.7, place: None, sound };
    let events = vec![event(0.0, Sound::Pulse), event(0.03, Sound::Wave(envelope.clone()))];
    let score = |start| Kind::Score(Score { start, period: Some(0.07), events: events.clone() });
    let path = vec![Point::default(), Point::new(0.01, 0.0), Point::new(0.0, 0.01)];
    let shape = |trace| {
        Kind::Shape(Traced { path: path.clone(), closed: true, anchor: Anchor::Finger, trace, rate: 300.0 })
    };
    let train = |count, jitter| {
        Kind::Train(Train { rate: 90.0, count, envelope: None, jitter, scatter: 0.005, seed: 3 })
    };
    let half = Region::Rectangle { corner: Point::default(), width: 0.1, height: 0.1 };
    let kinds = [
        Kind::Button(Button { press_force: None, release: 0.5 }),
        Kind::Button(Button { press_force: Some(1.0), release: 0.5 }),
        Kind::Texture(texture(1e-3, 0.4)),
        Kind::Edge(Edge { line: None }),
        Kind::Notch(Notch { pitch: 1e-3, axis: 0.3, origin: Point::default(), hysteresis: 0.1 }),
        train(None, 0.5),
        train(Some(5), 0.0),
        Kind::Train(Train { rate: 90.0, count: None, envelope: None, jitter: 0.0, scatter: 0.0, seed: 3 }),
        shape(Trace::Moving(0.2)),
        shape(Trace::AtOnce(0.004)),
        Kind::Hum(Hum { tone: Tone::Sine(150.0), speed_gain: ramp.clone(), fade: 0.01 }),
        Kind::Hum(Hum { tone: Tone::Looped(envelope), speed_gain: ramp, fade: 0.01 }),
        score(Start::Touch),
        score(Start::Zero),
    ];
    let named = |(i, kind)| Effect { name: format!("e{i}"), region: half.clone(), ..effect(kind) };
    kinds.into_iter().enumerate().map(named).collect()
}

fn phase() -> impl Strategy<Value = Phase> {
    prop_oneof![Just(Phase::Down), Just(Phase::Move), Just(Phase::Move), Just(Phase::Up)]
}

/// Touches of a few fingers in order, some of them where they should not be.
fn lively() -> impl Strategy<Value = Vec<Touch>> {
    let one =
        (0_u64..4, phase(), 0.0..0.11_f64, 0.0..0.11_f64, 0.0..0.03_f64, proptest::option::of(0.0..3.0_f64));
    proptest::collection::vec(one, 1..80).prop_map(|list| {
        let mut time = 0.0;
        let touch = |(finger, phase, x, y, after, force)| {
            time += after;
            Touch { finger, phase, at: Point::new(x, y), time, force }
        };
        list.into_iter().map(touch).collect()
    })
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![proptest::num::f64::ANY, -1.0..1.0_f64, Just(f64::NAN), Just(1e300), Just(-1e12), Just(1e12)]
}

/// Anything at all.
fn hostile() -> impl Strategy<Value = Vec<Touch>> {
    let one =
        (any::<u64>(), any::<bool>(), phase(), number(), number(), number(), proptest::option::of(number()));
    proptest::collection::vec(one, 1..200).prop_map(|list| {
        let touch = |(finger, few, phase, x, y, time, force)| {
            let finger = if few { finger % 3 } else { finger };
            Touch { finger, phase, at: Point::new(x, y), time, force }
        };
        list.into_iter().map(touch).collect()
    })
}

fn play(touches: &[Touch], ticks: &[f64]) -> (Vec<Cue>, Effects) {
    let mut effects = Effects::new(&set(all()), sheet(), 4e3).unwrap();
    let mut cues = Vec::new();
    // Time zero.
    effects.tick(0.0, &mut cues);
    let mut ticks = ticks.iter().peekable();
    for touch in touches {
        while let Some(tick) = ticks.next_if(|tick| **tick <= touch.time) {
            effects.tick(*tick, &mut cues);
        }
        effects.touch(touch, &mut cues);
    }
    (cues, effects)
}

/// Voices that sound at the end, if every cue is played.
fn sounding(cues: &[Cue]) -> HashMap<u64, f64> {
    let mut on = HashMap::new();
    for cue in cues {
        match &cue.act {
            Act::Comb { .. } => drop(on.insert(cue.voice, f64::INFINITY)),
            Act::Wave { looped: true, .. } => drop(on.insert(cue.voice, f64::INFINITY)),
            Act::Wave { wave, .. } => drop(on.insert(cue.voice, cue.at + wave.duration())),
            Act::Stop { .. } => drop(on.remove(&cue.voice)),
            _ => {}
        }
    }
    on
}

fn is_sound(cue: &Cue) -> bool {
    let level = |gain: &Level| match gain {
        Level::Share(share) => (0.0..=1.0).contains(share),
        Level::Felt(db) => db.is_finite(),
    };
    let place = |p: &Point| sheet().contains(*p);
    cue.at.is_finite()
        && match &cue.act {
            Act::Pulse { place: p, gain }
            | Act::Comb { place: p, gain, .. }
            | Act::Wave { place: p, gain, .. } => place(p) && level(gain),
            Act::Shape { points, gain } => points.iter().all(place) && level(gain) && !points.is_empty(),
            Act::Move { place: p } => place(p),
            Act::Gain { gain } => level(gain),
            Act::Stop { fade } => *fade >= 0.0,
        }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// How finely time is told does not matter to what is heard, nor do further ticks in between.
    #[test]
    fn ticks_do_not_matter(touches in lively(), mut ticks in proptest::collection::vec(0.0..2.0_f64, 0..60)) {
        ticks.sort_by(f64::total_cmp);
        let (plain, _) = play(&touches, &[]);
        let (ticked, _) = play(&touches, &ticks);
        prop_assert_eq!(heard(&plain), heard(&ticked));
        let (again, _) = play(&touches, &ticks);
        prop_assert_eq!(ticked, again);
    }

    /// When all fingers have left, only the score without a finger sounds on.
    #[test]
    fn voices_end(touches in lively()) {
        let mut touches = touches;
        let last = touches[touches.len() - 1];
        touches.extend((0..4).map(|finger| Touch { finger, phase: Phase::Up, ..last }));
        let (mut cues, mut effects) = play(&touches, &[]);
        prop_assert_eq!(effects.fingers(), 0);
        let before = cues.len();
        effects.tick(last.time + 0.2, &mut cues);
        prop_assert!(cues.iter().all(is_sound));
        let own = cues[before..].iter().map(|cue| cue.voice >> 16).collect::<std::collections::HashSet<_>>();
        prop_assert!(own.len() <= 1);
        for (voice, end) in sounding(&cues) {
            prop_assert!(end <= last.time || own.contains(&(voice >> 16)) || end < last.time + 0.1 && voice >> 16 == 1);
        }
    }

    #[test]
    fn hostile_touches_are_bounded(touches in hostile(), ticks in proptest::collection::vec(number(), 0..10)) {
        let mut effects = Effects::new(&set(all()), sheet(), 4e3).unwrap();
        for (i, touch) in touches.iter().enumerate() {
            let mut cues = Vec::new();
            effects.touch(touch, &mut cues);
            ticks.get(i % 16).into_iter().for_each(|tick| effects.tick(*tick, &mut cues));
            let stops = cues.iter().filter(|cue| matches!(cue.act, Act::Stop { .. })).count();
            prop_assert!(cues.len() - stops <= 2 * limits::MOST_CUES);
            prop_assert!(cues.iter().all(is_sound));
            prop_assert!(effects.fingers() <= limits::MOST_FINGERS);
        }
        // Whoever they are, they can leave.
        let mut cues = Vec::new();
        for touch in &touches {
            effects.touch(&Touch { phase: Phase::Up, time: f64::NAN, at: Point::new(f64::NAN, 0.0), ..*touch }, &mut cues);
        }
        prop_assert_eq!(effects.fingers(), 0);
    }
}

#[test]
fn a_hundred_thousand_fingers_are_refused() {
    let mut effects = Effects::new(&set(all()), sheet(), 4e3).unwrap();
    let mut cues = Vec::new();
    for finger in 0..100_000 {
        cues.clear();
        let at = Point::from_mm(50.0, 50.0);
        effects.touch(&Touch { finger, phase: Phase::Down, at, time: 0.0, force: None }, &mut cues);
    }
    assert_eq!((effects.fingers(), effects.refused()), (limits::MOST_FINGERS, 100_000 - 64));
}
