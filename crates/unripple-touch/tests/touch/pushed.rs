//! Touches that a program pushes.

use crate::{Promise, sheet, told};
use unripple_core::{Phase, Point, Random, Touch};
use unripple_touch::{Counts, Heard, Source, Sources, TouchError, pushed};

fn touch(finger: u64, phase: Phase, x: f64, time: f64) -> Touch {
    Touch { finger, phase, at: Point::from_mm(x, 50.0), time, force: None }
}

#[test]
fn they_are_reported_at_their_times_in_order_of_time() {
    let (pusher, mut source) = pushed(&sheet());
    for (finger, from) in [(1, 0.010), (2, 0.005)] {
        pusher.push(touch(finger, Phase::Down, 10.0 * finger as f64, from)).unwrap();
        pusher.push(touch(finger, Phase::Move, 10.0 * finger as f64 + 1.0, from + 0.007)).unwrap();
        pusher.push(touch(finger, Phase::Up, 99.0, from + 0.007)).unwrap();
    }
    let mut heard = Heard::default();
    source.poll(0.004, &mut heard);
    assert!(heard.touches.is_empty());
    source.poll(0.012, &mut heard);
    // A finger is lifted where it was, and what comes at one moment comes as it was pushed.
    assert_eq!(told(&heard.touches[..2]), [(2, Phase::Down, 20.0, 50.0), (1, Phase::Down, 10.0, 50.0)]);
    assert_eq!(told(&heard.touches[2..]), [(2, Phase::Move, 21.0, 50.0), (2, Phase::Up, 21.0, 50.0)]);
    source.poll(1.0, &mut heard);
    assert_eq!(told(&heard.touches[4..]), [(1, Phase::Move, 11.0, 50.0), (1, Phase::Up, 11.0, 50.0)]);
    assert_eq!(heard.touches[5].time, 0.010 + 0.007);
    assert_eq!(source.counts(), Counts { packets: 6, touches: 6, downs: 2, ..Counts::default() });
}

#[test]
fn what_has_passed_comes_with_the_next_poll() {
    let (pusher, mut source) = pushed(&sheet());
    let mut heard = Heard::default();
    source.poll(2.0, &mut heard);
    pusher.push(touch(1, Phase::Down, 10.0, 0.5)).unwrap();
    source.poll(2.1, &mut heard);
    assert_eq!(heard.touches[0].time, 2.0);
}

#[test]
fn a_finger_has_one_number_until_it_is_lifted() {
    let (pusher, source) = pushed(&sheet());
    let mut sources = Sources::new(&sheet());
    sources.push(Box::new(source));
    let (mut heard, mut promise) = (Heard::default(), Promise::default());
    for step in 0..40 {
        let phase = [Phase::Down, Phase::Move, Phase::Move, Phase::Up][step % 4];
        pusher.push(touch(u64::MAX, phase, 10.0 + step as f64, 0.01 * step as f64)).unwrap();
        heard.clear();
        sources.poll(0.01 * step as f64, &mut heard);
        promise.hold(&heard.touches, &sheet());
        assert_eq!((heard.touches.len(), heard.touches[0].finger), (1, 1 + step as u64 / 4));
    }
    assert_eq!(sources.fingers().count(), 0);
}

#[test]
fn what_cannot_be_is_refused_and_counted() {
    let (pusher, source) = pushed(&sheet());
    let refused = |touch: Touch| match pusher.push(touch) {
        Err(TouchError::Pushed { what, .. }) => what,
        other => panic!("{other:?}"),
    };
    let down = touch(3, Phase::Down, 60.0, 1.0);
    assert_eq!(refused(Touch { phase: Phase::Move, ..down }), "finger");
    assert_eq!(refused(Touch { phase: Phase::Up, ..down }), "finger");
    for at in [Point::new(f64::NAN, 0.05), Point::new(0.05, f64::INFINITY), Point::from_mm(150.1, 50.0)] {
        assert_eq!(refused(Touch { at, ..down }), "at_m");
    }
    for force in [-0.1, 100.5, f64::NAN] {
        assert_eq!(refused(Touch { force: Some(force), ..down }), "force_n");
    }
    assert_eq!(refused(Touch { time: f64::NAN, ..down }), "time_s");
    pusher.push(down).unwrap();
    assert_eq!(refused(down), "finger");
    assert_eq!(refused(Touch { phase: Phase::Move, time: 0.9, ..down }), "time_s");
    assert_eq!(refused(Touch { phase: Phase::Up, time: 0.9, ..down }), "time_s");
    let text = pusher.push(touch(4, Phase::Down, 170.0, 1.0)).unwrap_err().to_string();
    let place = "(170.0000, 50.0000) mm; nearest is (150.0000, 50.0000) mm";
    assert_eq!(text, format!("at_m: expected a place on the surface, found {place}"));
    let counts = source.counts();
    assert_eq!((counts.packets, counts.errors()), (14, 13));
    assert_eq!((counts.unknown, counts.numbers, counts.outside, counts.late), (3, 6, 2, 2));
}

#[test]
fn there_is_a_bound_on_fingers_and_on_what_waits() {
    let (pusher, mut source) = pushed(&sheet());
    for finger in 0..128 {
        pusher.push(touch(finger, Phase::Down, 60.0, 1.0)).unwrap();
    }
    assert!(pusher.push(touch(128, Phase::Down, 60.0, 1.0)).is_err());
    let moves = (0..100_000).filter(|_| pusher.push(touch(0, Phase::Move, 61.0, 1.0)).is_ok()).count();
    assert_eq!(moves, 65536 - 128);
    // Bounded work: the rest comes with the next poll.
    let mut heard = Heard::default();
    source.poll(2.0, &mut heard);
    assert_eq!(heard.touches.len(), 1024);
    (0..100).for_each(|_| source.poll(2.0, &mut heard));
    assert_eq!(heard.touches.len(), 65536);
    pusher.push(touch(0, Phase::Up, 61.0, 2.0)).unwrap();
}

#[test]
fn whatever_is_pushed_the_source_keeps_its_promise() {
    let mut random = Random::seeded(11);
    let (pusher, mut source) = pushed(&sheet());
    let (mut heard, mut promise) = (Heard::default(), Promise::default());
    source.poll(0.0, &mut heard);
    for step in 0..20_000 {
        let phase = [Phase::Down, Phase::Move, Phase::Up][random.between(0.0, 3.0) as usize % 3];
        let at = Point::from_mm(random.between(-10.0, 160.0), random.between(-10.0, 110.0));
        let time = 0.001 * f64::from(step) + random.between(-0.05, 0.2);
        let force = (random.uniform() < 0.5).then(|| random.between(-1.0, 101.0));
        let _ = pusher.push(Touch { finger: random.between(0.0, 9.0) as u64, phase, at, time, force });
        heard.clear();
        source.poll(0.001 * f64::from(step), &mut heard);
        promise.hold(&heard.touches, &sheet());
    }
    assert!(source.counts().touches > 1000 && source.counts().errors() > 1000);
}
