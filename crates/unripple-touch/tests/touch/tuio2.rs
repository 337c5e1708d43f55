//! TUIO 2.0.

use crate::wire::{Arg, Rig, bundle, message};
use crate::{options, told};
use Arg::{F, I, S, T};
use unripple_core::Phase::{Down, Move, Up};

fn frame(id: i32, source: &str, components: &[Vec<u8>], alive: &[i32]) -> Vec<u8> {
    let mut elements = vec![message("/tuio2/frm", &[I(id), T, I(0x0400_0300), S(source)])];
    elements.extend_from_slice(components);
    elements.push(message("/tuio2/alv", &alive.iter().map(|s| I(*s)).collect::<Vec<_>>()));
    bundle(&elements)
}

fn pointer(session: i32, x: f32, y: f32, press: f32) -> Vec<u8> {
    message("/tuio2/ptr", &[I(session), I(0), I(0), F(x), F(y), F(0.0), F(0.0), F(0.01), F(press)])
}

fn token(session: i32, x: f32, y: f32) -> Vec<u8> {
    message(
        "/tuio2/tok",
        &[I(session), I(1), I(82), F(x), F(y), F(0.3), F(1.0), F(1.0), F(0.0), F(0.0), F(0.0)],
    )
}

fn bounds(session: i32, x: f32, y: f32) -> Vec<u8> {
    message("/tuio2/bnd", &[I(session), F(x), F(y), F(0.0), F(0.1), F(0.1), F(0.01)])
}

#[test]
fn reads_a_frame_byte_for_byte() {
    let bytes = b"#bundle\0\x00\x00\x00\x00\x00\x00\x00\x01\
        \x00\x00\x00\x28/tuio2/frm\0\0,itis\0\0\0\x00\x00\x00\x07\xd1\x00\x00\x00\x00\x00\x00\x00\x02\x80\x01\xe0a\0\0\0\
        \x00\x00\x00\x3c/tuio2/ptr\0\0,iiiffffff\0\0\x00\x00\x02\x19\x00\x02\x00\x05\x00\x00\x00\x00\
        \x3e\x80\x00\x00\x3f\x00\x00\x00\x3f\x80\x00\x00\x00\x00\x00\x00\x3c\x23\xd7\x0a\x00\x00\x00\x00\
        \x00\x00\x00\x14/tuio2/alv\0\0,i\0\0\x00\x00\x02\x19";
    let mut rig = Rig::new();
    assert_eq!(told(&rig.send(1, bytes)), [(1, Down, 37.5, 50.0)]);
    assert_eq!(rig.counts().errors(), 0);
}

#[test]
fn pointers_tokens_and_bounds_are_fingers() {
    let mut rig = Rig::new();
    let parts = [pointer(1, 0.1, 0.5, 0.0), token(2, 0.2, 0.5), bounds(3, 0.3, 0.5)];
    let touches = rig.send(1, &frame(1, "a", &parts, &[1, 2, 3]));
    assert_eq!(told(&touches), [(1, Down, 15.0, 50.0), (2, Down, 30.0, 50.0), (3, Down, 45.0, 50.0)]);
    // Bounds that go with a pointer or a token are no further finger, and do not say where it is.
    let parts = [bounds(1, 0.12, 0.5), pointer(1, 0.11, 0.5, 0.0), token(2, 0.2, 0.5), bounds(2, 0.7, 0.5)];
    assert_eq!(told(&rig.send(1, &frame(2, "a", &parts, &[1, 2, 3]))), [(1, Move, 16.5, 50.0)]);
    let symbol = message("/tuio2/sym", &[I(1), I(0), I(0), S("t"), S("x")]);
    assert_eq!(
        told(&rig.send(1, &frame(3, "a", &[symbol], &[1]))),
        [(2, Up, 30.0, 50.0), (3, Up, 45.0, 50.0)]
    );
    assert_eq!(rig.counts().errors(), 0);
    rig.send(1, &message("/tuio2/nil", &[]));
    assert_eq!((rig.counts().unknown, rig.counts().errors()), (1, 1));
}

#[test]
fn pressure_is_a_force_where_the_sensor_is_known() {
    let mut known = options();
    known.full_force = Some(4.0);
    let mut rig = Rig::with(known);
    let press = |rig: &mut Rig, id, press| rig.send(1, &frame(id, "a", &[pointer(1, 0.5, 0.5, press)], &[1]));
    assert_eq!(press(&mut rig, 1, 0.25)[0].force, Some(1.0));
    assert_eq!(press(&mut rig, 2, 0.5)[0].force, Some(2.0));
    assert_eq!(press(&mut rig, 3, 7.0)[0].force, Some(4.0));
    // A negative pressure is a finger above the surface.
    assert_eq!(told(&press(&mut rig, 4, -0.1)), [(1, Up, 75.0, 50.0)]);
    assert!(press(&mut rig, 5, -0.2).is_empty());
    assert!(press(&mut rig, 6, f32::NAN).is_empty());
    assert_eq!((rig.counts().numbers, rig.counts().errors()), (1, 1));
    let mut rig = Rig::new();
    assert_eq!(press(&mut rig, 1, 0.25)[0].force, None);
}

#[test]
fn late_frames_are_dropped_and_restarts_noticed() {
    let mut rig = Rig::new();
    let at =
        |rig: &mut Rig, id, x: f32| told(&rig.send(1, &frame(id, "a", &[pointer(1, x, 0.5, 0.0)], &[1])));
    assert_eq!(at(&mut rig, 1000, 0.1), [(1, Down, 15.0, 50.0)]);
    assert_eq!(at(&mut rig, 999, 0.2), []);
    // The number 0 stands outside the count.
    assert_eq!(at(&mut rig, 0, 0.3), [(1, Move, 45.0, 50.0)]);
    assert_eq!(at(&mut rig, 998, 0.2), []);
    assert_eq!(rig.counts().late, 2);
    assert_eq!(at(&mut rig, 1, 0.4), [(1, Up, 45.0, 50.0), (2, Down, 60.0, 50.0)]);
    // All ones is the last number before it wraps round.
    assert_eq!(at(&mut rig, -1, 0.5), []);
    assert_eq!(rig.counts().late, 3);
}

#[test]
fn names_and_generations_are_kept_apart() {
    let mut rig = Rig::new();
    rig.send(1, &frame(5, "a", &[pointer(1, 0.1, 0.5, 0.0)], &[1]));
    rig.send(1, &frame(5, "b", &[pointer(1, 0.2, 0.5, 0.0)], &[1]));
    rig.send(1, &crate::wire::cursors("a", &[1], &[(1, 0.3, 0.5)], 5));
    assert_eq!(told(&rig.send(1, &frame(6, "a", &[], &[]))), [(1, Up, 15.0, 50.0)]);
    assert_eq!(told(&rig.send(1, &frame(6, "b", &[], &[]))), [(2, Up, 30.0, 50.0)]);
    assert_eq!(told(&rig.send(1, &crate::wire::cursors("a", &[], &[], 6))), [(3, Up, 45.0, 50.0)]);
    assert_eq!(rig.counts().errors(), 0);
}

#[test]
fn wrong_messages_are_counted() {
    let mut rig = Rig::new();
    let wrong = [
        message("/tuio2/frm", &[]),
        message("/tuio2/frm", &[S("1"), T, I(0), S("a")]),
        message("/tuio2/frm", &[I(1), T, I(0), I(0)]),
        message("/tuio2/ptr", &[I(1), I(0), I(0), F(0.5), F(0.5)]),
        message("/tuio2/tok", &[I(1), I(0), I(0), F(0.5)]),
        message("/tuio2/bnd", &[F(1.0), F(0.5), F(0.5)]),
        message("/tuio2/alv", &[S("1")]),
    ];
    for packet in &wrong {
        assert!(rig.send(1, packet).is_empty());
    }
    assert_eq!((rig.counts().malformed, rig.counts().errors()), (7, 7));
}
