//! The addresses under `/unripple/`.

use crate::told;
use crate::wire::{Arg, Rig, bundle, message};
use Arg::{F, I, S};
use unripple_core::Phase::{Down, Move, Up};
use unripple_touch::Wish;

#[test]
fn touches_move_lift_and_clear() {
    let mut rig = Rig::new();
    let touch = |finger, x, y| message("/unripple/touch", &[I(finger), F(x), F(y)]);
    assert_eq!(told(&rig.send(1, &touch(1, 62.0, 90.0))), [(1, Down, 62.0, 90.0)]);
    // Command-line tools use another port for every message.
    assert_eq!(told(&rig.send(2, &touch(1, 63.0, 90.0))), [(1, Move, 63.0, 90.0)]);
    assert_eq!(told(&rig.send(3, &touch(2, 20.0, 20.0))), [(2, Down, 20.0, 20.0)]);
    assert_eq!(told(&rig.send(4, &message("/unripple/lift", &[I(1)]))), [(1, Up, 63.0, 90.0)]);
    rig.send(4, &touch(7, 30.0, 20.0));
    assert_eq!(
        told(&rig.send(5, &message("/unripple/clear", &[]))),
        [(2, Up, 20.0, 20.0), (3, Up, 30.0, 20.0)]
    );
    assert_eq!((rig.counts().errors(), rig.counts().senders), (0, 1));
    // A resting finger must be repeated.
    rig.send(1, &touch(1, 62.0, 90.0));
    assert!(rig.wait(1.5).is_empty());
    assert!(rig.send(1, &touch(1, 62.0, 90.0)).is_empty());
    assert!(rig.wait(1.5).is_empty());
    assert_eq!(rig.wait(1.0).len(), 1);
}

#[test]
fn forces_in_newtons() {
    let mut rig = Rig::new();
    let touch = |force| message("/unripple/touch", &[I(1), I(62), I(90), force]);
    assert_eq!(rig.send(1, &touch(F(0.5)))[0].force, Some(0.5));
    assert_eq!(rig.send(1, &touch(I(2)))[0].force, Some(2.0));
    for bad in [-0.1, f32::NAN, 1e9] {
        assert!(rig.send(1, &touch(F(bad))).is_empty());
    }
    assert_eq!((rig.counts().numbers, rig.counts().errors()), (3, 3));
}

#[test]
fn wishes_are_handed_on() {
    let mut rig = Rig::new();
    rig.send(
        1,
        &bundle(&[message("/unripple/effect", &[S("click")]), message("/unripple/gain", &[F(-6.0)])]),
    );
    assert_eq!(rig.wishes, [Wish::Effect("click".into()), Wish::Gain(-6.0)]);
    let long = "x".repeat(65);
    let refused = [S(""), S(&long), S("a\nb")].map(|name| message("/unripple/effect", &[name]));
    let levels = [F(f32::NAN), F(1e9), F(-121.0)].map(|db| message("/unripple/gain", &[db]));
    for packet in refused.iter().chain(&levels) {
        rig.send(1, packet);
    }
    assert_eq!((rig.wishes.len(), rig.counts().wishes, rig.counts().numbers), (2, 2, 6));
    // A flood of wishes is cut.
    rig.send(1, &bundle(&vec![message("/unripple/effect", &[S("click")]); 200]));
    assert_eq!((rig.wishes.len(), rig.counts().crowded), (66, 136));
}

#[test]
fn wrong_messages_are_counted() {
    let mut rig = Rig::new();
    for (address, args) in [
        ("/unripple/touch", &[I(1), F(1.0)][..]),
        ("/unripple/touch", &[F(1.0), F(1.0), F(1.0)]),
        ("/unripple/touch", &[I(1), F(1.0), F(1.0), S("hard")]),
        ("/unripple/lift", &[]),
        ("/unripple/lift", &[S("1")]),
        ("/unripple/effect", &[I(1)]),
        ("/unripple/gain", &[S("loud")]),
    ] {
        assert!(rig.send(1, &message(address, args)).is_empty(), "{address}");
    }
    assert_eq!(rig.counts().malformed, 7);
    rig.send(1, &message("/unripple/lift", &[I(1)]));
    rig.send(1, &message("/unripple/what", &[I(1)]));
    rig.send(1, &message("/mixer/volume", &[F(0.5)]));
    assert_eq!((rig.counts().unknown, rig.counts().errors()), (3, 10));
    rig.send(1, &message("/unripple/touch", &[I(1), F(151.0), F(50.0)]));
    assert_eq!(rig.counts().outside, 1);
}
