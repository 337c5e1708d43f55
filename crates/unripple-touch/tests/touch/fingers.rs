//! How many fingers there may be, and whose.

use crate::wire::{Rig, cursors};
use crate::{options, told};
use unripple_core::{Phase, Point};
use unripple_touch::{Fingers, Heard, Key, Refusal};

#[test]
fn a_million_cursors_leave_memory_as_it_is() {
    let mut rig = Rig::new();
    let per_packet = 200;
    let mut downs = 0;
    for packet in 0..5000 {
        let ids: Vec<i32> = (0..per_packet).map(|i| packet * per_packet + i).collect();
        let sets: Vec<(i32, f32, f32)> =
            ids.iter().map(|id| (*id, (*id % 100) as f32 / 100.0, 0.5)).collect();
        let touches = rig.send(1, &cursors("flood", &ids, &sets, packet));
        downs += touches.iter().filter(|touch| touch.phase == Phase::Down).count();
        assert!(rig.receiver.tracked() <= 16 + 3, "{}", rig.receiver.tracked());
    }
    assert_eq!(downs, 5000 * 16);
    assert_eq!(rig.counts().crowded, 1_000_000 - 5000 * 16);
}

#[test]
fn no_sender_takes_the_place_of_another() {
    let mut rig = Rig::new();
    let many: Vec<(i32, f32, f32)> = (0..40).map(|i| (i, 0.5, i as f32 / 40.0)).collect();
    let ids: Vec<i32> = (0..40).collect();
    assert_eq!(rig.send(1, &cursors("greedy", &ids, &many, 1)).len(), 16);
    // Another name does not help.
    assert!(rig.send(1, &cursors("greedy too", &ids, &many, 1)).is_empty());
    assert_eq!(
        told(&rig.send(2, &cursors("modest", &[1], &[(1, 0.2, 0.5)], 1))),
        [(17, Phase::Down, 30.0, 50.0)]
    );
    // Names and addresses are bounded.
    for i in 0..40 {
        rig.send(1, &cursors(&format!("name {i}"), &[1], &[(1, 0.2, 0.5)], 1));
        rig.send(1000 + i, &cursors("a", &[], &[], 1));
    }
    // One address with four names, one and fourteen with two, one of them empty, and 17 fingers.
    assert_eq!(rig.receiver.tracked(), 5 + 15 * 3 + 17);
    assert_eq!(rig.counts().crowded, 24 + 40 + 1 + 39 + 26);
    // Those that were there are not disturbed, and the others go when they are silent.
    assert_eq!(told(&rig.send(2, &cursors("modest", &[1], &[(1, 0.3, 0.5)], 2)))[0].1, Phase::Move);
    rig.wait(5.0);
    assert_eq!(rig.receiver.tracked(), 0);
}

#[test]
fn senders_that_came_first_do_not_keep_others_out() {
    let mut rig = Rig::new();
    let many: Vec<(i32, f32, f32)> = (0..16).map(|i| (i, 0.5, i as f32 / 20.0)).collect();
    let ids: Vec<i32> = (0..16).collect();
    for sender in [1, 2] {
        assert_eq!(rig.send(sender, &cursors("greedy", &ids, &many, 1)).len(), 16);
    }
    // All 32 are taken; one of the two gives up its latest finger, then the other.
    for (id, gone) in [(1, 32), (2, 16)] {
        let ids: Vec<i32> = (1..=id).collect();
        let sets: Vec<(i32, f32, f32)> = ids.iter().map(|id| (*id, 0.2, 0.5)).collect();
        let heard = told(&rig.send(3, &cursors("modest", &ids, &sets, id)));
        let phases: Vec<(u64, Phase)> = heard.iter().map(|touch| (touch.0, touch.1)).collect();
        assert_eq!(phases, [(gone, Phase::Up), (32 + id as u64, Phase::Down)]);
    }
    // Those who have as many as anybody get no more, and nobody is disturbed for them.
    assert!(rig.send(1, &cursors("greedy", &ids, &many, 2)).is_empty());
    assert_eq!(rig.counts().crowded, 1);
}

#[test]
fn time_stands_still_while_nobody_polls() {
    let mut fingers = Fingers::new(options()).unwrap();
    let mut heard = Heard::default();
    let key = Key { peer: 0, stream: 0, session: 1 };
    fingers.begin(0.0);
    fingers.put(key, Point::from_mm(62.0, 90.0), None, &mut heard).unwrap();
    // A pause of an hour is not the sender's.
    fingers.begin(3600.0);
    fingers.expire(&mut heard);
    assert_eq!((heard.touches.len(), fingers.count()), (1, 1));
    // A clock that runs back is not believed.
    fingers.begin(10.0);
    assert_eq!(fingers.now(), 3600.0);
}

#[test]
fn only_the_last_place_within_a_poll_is_told() {
    let mut fingers = Fingers::new(options()).unwrap();
    let mut heard = Heard::default();
    let key = Key { peer: 0, stream: 0, session: 1 };
    fingers.begin(0.0);
    for i in 0..100 {
        fingers.put(key, Point::from_mm(f64::from(i), 90.0), None, &mut heard).unwrap();
    }
    let told = told(&heard.touches);
    assert_eq!(told, [(1, Phase::Down, 0.0, 90.0), (1, Phase::Move, 99.0, 90.0)]);
    assert_eq!(fingers.put(key, Point::new(f64::NAN, 0.0), None, &mut heard), Err(Refusal::Number));
    // However often fingers come and go within a poll, that is bounded too.
    for session in 0..1000 {
        let key = Key { session, ..key };
        let _ = fingers.put(key, Point::from_mm(50.0, 50.0), None, &mut heard);
        fingers.lift(key, &mut heard);
    }
    assert!(heard.touches.len() <= 2 * 256 + 3, "{}", heard.touches.len());
}

#[test]
fn options_that_cannot_be_are_refused() {
    for wrong in [
        unripple_touch::Options { timeout: f64::NAN, ..options() },
        unripple_touch::Options { timeout: 0.0, ..options() },
        unripple_touch::Options { most: 0, ..options() },
        unripple_touch::Options { most_per_sender: 100_000, ..options() },
        unripple_touch::Options { full_force: Some(-1.0), ..options() },
    ] {
        assert!(Fingers::new(wrong).is_err());
    }
}
