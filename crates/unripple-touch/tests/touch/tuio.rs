//! TUIO 1.1.

use crate::told;
use crate::wire::{Arg, Rig, bundle, cursors, message, profile};
use unripple_core::Phase::{Down, Move, Up};

/// A frame as it stands in the specification, byte for byte: cursor 12 at (0.4, 0.25), frame 3.
const FRAME: &[u8] = b"#bundle\0\x00\x00\x00\x00\x00\x00\x00\x01\
    \x00\x00\x00\x1c/tuio/2Dcur\0,si\0alive\0\0\0\x00\x00\x00\x0c\
    \x00\x00\x00\x34/tuio/2Dcur\0,sifffff\0\0\0\0set\0\x00\x00\x00\x0c\x3e\xcc\xcc\xcd\x3e\x80\x00\x00\
    \x3f\x80\x00\x00\x3f\x80\x00\x00\x00\x00\x00\x00\
    \x00\x00\x00\x1c/tuio/2Dcur\0,si\0fseq\0\0\0\0\x00\x00\x00\x03";

#[test]
fn reads_a_frame_byte_for_byte() {
    let mut rig = Rig::new();
    // 0.4 of 150 mm from the left, 0.25 of 100 mm from the top.
    assert_eq!(told(&rig.send(5000, FRAME)), [(1, Down, 60.0, 75.0)]);
    assert_eq!((rig.counts().errors(), rig.counts().packets, rig.counts().senders), (0, 1, 1));
}

#[test]
fn cursors_come_move_rest_and_leave() {
    let mut rig = Rig::new();
    let both = [(4, 0.1, 0.5), (5, 0.9, 0.5)];
    assert_eq!(
        told(&rig.send(1, &cursors("a", &[4, 5], &both, 1))),
        [(1, Down, 15.0, 50.0), (2, Down, 135.0, 50.0)]
    );
    assert_eq!(told(&rig.send(1, &cursors("a", &[4, 5], &[(5, 0.8, 0.5)], 2))), [(2, Move, 120.0, 50.0)]);
    assert!(rig.send(1, &cursors("a", &[4, 5], &[], 3)).is_empty());
    assert!(rig.send(1, &cursors("a", &[4, 5], &[(5, 0.8, 0.5)], 4)).is_empty());
    assert_eq!(told(&rig.send(1, &cursors("a", &[5], &[], 5))), [(1, Up, 15.0, 50.0)]);
    // The number 4 again is another finger.
    assert_eq!(told(&rig.send(1, &cursors("a", &[5, 4], &[(4, 0.5, 0.5)], 6))), [(3, Down, 75.0, 50.0)]);
    assert_eq!(rig.counts().errors(), 0);
}

#[test]
fn objects_and_blobs_are_fingers_of_their_own() {
    let mut rig = Rig::new();
    for (i, address) in ["/tuio/2Dcur", "/tuio/2Dobj", "/tuio/2Dblb"].into_iter().enumerate() {
        let at = 0.2 * (i + 1) as f32;
        let touches = rig.send(1, &profile(address, "a", &[7], &[(7, at, 0.5)], 1));
        assert_eq!(told(&touches), [(i as u64 + 1, Down, 30.0 * (i + 1) as f64, 50.0)], "{address}");
    }
    assert_eq!(told(&rig.send(1, &profile("/tuio/2Dobj", "a", &[], &[], 2))), [(2, Up, 60.0, 50.0)]);
    rig.send(1, &message("/tuio/3Dcur", &[Arg::S("alive")]));
    assert_eq!((rig.counts().unknown, rig.counts().errors()), (1, 1));
}

#[test]
fn frames_out_of_order_are_dropped() {
    let mut rig = Rig::new();
    rig.send(1, &cursors("a", &[1], &[(1, 0.1, 0.5)], 10));
    rig.send(1, &cursors("a", &[1], &[(1, 0.3, 0.5)], 12));
    assert!(rig.send(1, &cursors("a", &[], &[], 11)).is_empty());
    assert!(rig.send(1, &cursors("a", &[1], &[(1, 0.2, 0.5)], 11)).is_empty());
    assert_eq!(rig.counts().late, 2);
    // A frame in several packets has one number, a frame sent again has -1.
    assert_eq!(told(&rig.send(1, &cursors("a", &[1, 2], &[(2, 0.5, 0.5)], 12))), [(2, Down, 75.0, 50.0)]);
    assert_eq!(told(&rig.send(1, &cursors("a", &[1, 2], &[(2, 0.6, 0.5)], -1))), [(2, Move, 90.0, 50.0)]);
    assert_eq!(rig.counts().errors(), 2);
}

#[test]
fn a_sender_that_restarts_begins_with_new_fingers() {
    let mut rig = Rig::new();
    rig.send(1, &cursors("a", &[1], &[(1, 0.1, 0.5)], 5000));
    // It counts from 1 again, and so do its cursors.
    let touches = rig.send(1, &cursors("a", &[1], &[(1, 0.9, 0.5)], 1));
    assert_eq!(told(&touches), [(1, Up, 15.0, 50.0), (2, Down, 135.0, 50.0)]);
    // After few frames, restarting takes it longer than a late frame could be.
    rig.wait(1.1);
    let touches = rig.send(1, &cursors("a", &[1], &[(1, 0.5, 0.5)], 0));
    assert_eq!(told(&touches), [(2, Up, 135.0, 50.0), (3, Down, 75.0, 50.0)]);
    assert_eq!(rig.counts().errors(), 0);
    // The count wraps round without that.
    rig.send(1, &cursors("a", &[1], &[(1, 0.6, 0.5)], i32::MAX));
    rig.send(1, &cursors("a", &[1], &[(1, 0.6, 0.5)], i32::MAX));
    assert_eq!(told(&rig.send(1, &cursors("a", &[1], &[(1, 0.7, 0.5)], 0)))[0].1, Move);
}

#[test]
fn lost_bundles_do_no_harm() {
    let mut rig = Rig::new();
    // The bundle in which cursor 1 came is lost: it is alive, but nobody knows where.
    assert!(rig.send(1, &cursors("a", &[1], &[], 2)).is_empty());
    assert_eq!(told(&rig.send(1, &cursors("a", &[1], &[(1, 0.2, 0.5)], 3))), [(1, Down, 30.0, 50.0)]);
    // The bundle in which it left is lost: the next one does not list it.
    assert_eq!(
        told(&rig.send(1, &cursors("a", &[2], &[(2, 0.4, 0.5)], 5))),
        [(1, Up, 30.0, 50.0), (2, Down, 60.0, 50.0)]
    );
}

#[test]
fn a_dead_cursor_is_lifted_and_its_sender_may_come_back() {
    let mut rig = Rig::new();
    rig.send(1, &cursors("a", &[1], &[(1, 0.2, 0.5)], 1));
    // Renewed once a second it rests for as long as it likes.
    for fseq in 2..6 {
        assert!(rig.wait(1.0).is_empty());
        assert!(rig.send(1, &cursors("a", &[1], &[], fseq)).is_empty());
    }
    assert!(rig.wait(1.9).is_empty());
    assert_eq!(told(&rig.wait(0.2)), [(1, Up, 30.0, 50.0)]);
    assert_eq!(rig.counts().expired, 1);
    assert_eq!(told(&rig.send(1, &cursors("a", &[1], &[(1, 0.2, 0.5)], 7))), [(2, Down, 30.0, 50.0)]);
    rig.wait(5.0);
    assert_eq!(rig.receiver.tracked(), 0);
}

#[test]
fn sources_are_kept_apart_by_address_and_by_name() {
    let mut rig = Rig::new();
    for (port, name, x) in [(1, "a", 0.1), (2, "a", 0.2), (1, "b", 0.3)] {
        rig.send(port, &cursors(name, &[1], &[(1, x, 0.5)], 100));
    }
    assert_eq!(told(&rig.send(2, &cursors("a", &[], &[], 101))), [(2, Up, 30.0, 50.0)]);
    assert_eq!(told(&rig.send(1, &cursors("b", &[1], &[(1, 0.4, 0.5)], 101))), [(3, Move, 60.0, 50.0)]);
    assert_eq!(told(&rig.send(1, &cursors("a", &[], &[], 101))), [(1, Up, 15.0, 50.0)]);
    assert_eq!((rig.counts().senders, rig.counts().errors()), (2, 0));
}

#[test]
fn messages_without_a_bundle_are_taken_one_by_one() {
    let mut rig = Rig::new();
    let cur = |args: &[Arg]| message("/tuio/2Dcur", args);
    rig.send(1, &cur(&[Arg::S("alive"), Arg::I(1)]));
    let touches = rig.send(
        1,
        &cur(&[Arg::S("set"), Arg::I(1), Arg::F(0.2), Arg::F(0.5), Arg::F(0.0), Arg::F(0.0), Arg::F(0.0)]),
    );
    assert_eq!(told(&touches), [(1, Down, 30.0, 50.0)]);
    assert!(rig.send(1, &cur(&[Arg::S("fseq"), Arg::I(1)])).is_empty());
    assert_eq!(told(&rig.send(1, &cur(&[Arg::S("alive")]))), [(1, Up, 30.0, 50.0)]);
    assert_eq!(rig.counts().errors(), 0);
}

#[test]
fn impossible_places_are_refused_and_counted() {
    let mut rig = Rig::new();
    rig.send(1, &cursors("a", &[1], &[(1, 0.2, 0.5)], 1));
    for (i, x) in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY].into_iter().enumerate() {
        assert!(rig.send(1, &cursors("a", &[1, 2], &[(1, x, 0.5), (2, 0.5, x)], 2 + i as i32)).is_empty());
    }
    assert_eq!(rig.counts().numbers, 6);
    // One that slides off the surface leaves, and comes back as another.
    assert_eq!(told(&rig.send(1, &cursors("a", &[1], &[(1, 1.01, 0.5)], 6))), [(1, Up, 30.0, 50.0)]);
    assert_eq!(told(&rig.send(1, &cursors("a", &[1], &[(1, 1.0, 0.5)], 7))), [(2, Down, 150.0, 50.0)]);
    assert_eq!((rig.counts().outside, rig.counts().errors()), (1, 7));
}

#[test]
fn wrong_messages_are_counted_and_harm_no_other() {
    let mut rig = Rig::new();
    let cur = |args: &[Arg]| message("/tuio/2Dcur", args);
    let wrong = [
        cur(&[]),
        cur(&[Arg::I(1)]),
        cur(&[Arg::S("set")]),
        cur(&[Arg::S("set"), Arg::I(1), Arg::F(0.5)]),
        cur(&[Arg::S("set"), Arg::S("1"), Arg::F(0.5), Arg::F(0.5)]),
        cur(&[Arg::S("set"), Arg::I(1), Arg::S("0.5"), Arg::F(0.5)]),
        cur(&[Arg::S("alive"), Arg::I(1), Arg::F(1.0)]),
        cur(&[Arg::S("fseq")]),
        cur(&[Arg::S("fseq"), Arg::F(1.0)]),
        cur(&[Arg::S("source"), Arg::I(1)]),
        cur(&[Arg::S("what")]),
        b"/tuio/2Dcur\0,[[[[]]]]\0\0\0".to_vec(),
    ];
    let count = wrong.len() as u64;
    let mut all = wrong.to_vec();
    all.extend([
        cur(&[Arg::S("alive"), Arg::I(9)]),
        cur(&[Arg::S("set"), Arg::I(9), Arg::F(0.5), Arg::F(0.5)]),
    ]);
    assert_eq!(told(&rig.send(1, &bundle(&all))), [(1, Down, 75.0, 50.0)]);
    assert_eq!((rig.counts().malformed, rig.counts().errors()), (count, count));
    // Whatever a frame is cut to is refused, but where its elements end.
    let whole = cursors("a", &[9], &[(9, 0.5, 0.5)], 1);
    let mut ends = vec![16];
    while let Some(size) = whole.get(ends[ends.len() - 1]..ends[ends.len() - 1] + 4) {
        ends.push(ends[ends.len() - 1] + 4 + u32::from_be_bytes(size.try_into().unwrap()) as usize);
    }
    assert_eq!(ends.len(), 5);
    for length in 0..whole.len() {
        let before = rig.counts().malformed;
        rig.send(2, &whole[..length]);
        assert_eq!(rig.counts().malformed - before, u64::from(!ends.contains(&length)), "{length}");
    }
}
