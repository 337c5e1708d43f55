//! Screens, from lists of events as the kernel documents them.

use crate::{Promise, options, sheet, told};
use std::collections::VecDeque;
use std::io;
use std::sync::{Arc, Mutex};
use unripple_core::Phase::{Down, Move, Up};
use unripple_core::Touch;
use unripple_touch::{Axis, Contacts, Event, Heard, Screen, Source};

const SLOT: u16 = 0x2f;
const X: u16 = 0x35;
const Y: u16 = 0x36;
const ID: u16 = 0x39;
const PRESSURE: u16 = 0x3a;

#[derive(Default)]
struct Script {
    events: VecDeque<Event>,
    slot: usize,
    unplugged: bool,
}

#[derive(Clone, Default)]
struct Tape(Arc<Mutex<Script>>);

impl Contacts for Tape {
    fn read(&mut self, events: &mut Vec<Event>) -> io::Result<()> {
        let mut script = self.0.lock().unwrap();
        let count = script.events.len().min(32);
        events.extend(script.events.drain(..count));
        if script.unplugged { Err(io::Error::other("no such device")) } else { Ok(()) }
    }

    fn slot(&mut self) -> io::Result<usize> {
        Ok(self.0.lock().unwrap().slot)
    }

    fn reopen(&mut self) -> io::Result<()> {
        if self.0.lock().unwrap().unplugged { Err(io::Error::other("no such device")) } else { Ok(()) }
    }
}

struct Rig {
    tape: Tape,
    screen: Screen,
    now: f64,
    promise: Promise,
}

impl Rig {
    fn new() -> Self {
        let tape = Tape::default();
        let (x, y) = (Axis { minimum: 0, maximum: 1500 }, Axis { minimum: 100, maximum: 1100 });
        let force = unripple_touch::Options { full_force: Some(2.0), ..options() };
        let pressure = Some(Axis { minimum: 0, maximum: 200 });
        let screen = Screen::new("tape", Box::new(tape.clone()), (x, y), pressure, force).unwrap();
        Self { tape, screen, now: 0.0, promise: Promise::default() }
    }

    fn play(&mut self, events: &[(u16, i32)]) -> Vec<Touch> {
        let mut all: Vec<Event> =
            events.iter().map(|&(code, value)| Event { kind: 3, code, value }).collect();
        all.push(Event { kind: 0, code: 0, value: 0 });
        self.raw(&all)
    }

    fn raw(&mut self, events: &[Event]) -> Vec<Touch> {
        self.tape.0.lock().unwrap().events.extend(events);
        self.now += 0.01;
        let mut heard = Heard::default();
        self.screen.poll(self.now, &mut heard);
        self.promise.hold(&heard.touches, &sheet());
        heard.touches
    }
}

#[test]
fn the_example_of_the_kernel_s_documentation() {
    let mut rig = Rig::new();
    let two = rig.play(&[(SLOT, 0), (ID, 45), (X, 300), (Y, 200), (SLOT, 1), (ID, 46), (X, 600), (Y, 600)]);
    assert_eq!(told(&two), [(1, Down, 30.0, 90.0), (2, Down, 60.0, 50.0)]);
    assert_eq!(told(&rig.play(&[(SLOT, 0), (X, 310)])), [(1, Move, 31.0, 90.0)]);
    assert_eq!(told(&rig.play(&[(ID, -1)])), [(1, Up, 31.0, 90.0)]);
    // Slot 1 has not been spoken of, and rests for as long as it likes.
    for _ in 0..1000 {
        assert!(rig.play(&[]).is_empty());
    }
    // A new contact in slot 0 keeps the coordinate that did not change.
    assert_eq!(told(&rig.play(&[(ID, 47), (X, 320)])), [(3, Down, 32.0, 90.0)]);
    // A contact replaced by another without leaving.
    assert_eq!(told(&rig.play(&[(SLOT, 1), (ID, 48)])), [(2, Up, 60.0, 50.0), (4, Down, 60.0, 50.0)]);
    assert_eq!(rig.screen.counts().errors(), 0);
}

#[test]
fn pressure_is_a_share_of_the_known_force() {
    let mut rig = Rig::new();
    assert_eq!(rig.play(&[(ID, 1), (X, 300), (Y, 200)])[0].force, None);
    assert_eq!(rig.play(&[(PRESSURE, 50)])[0].force, Some(0.5));
    assert_eq!(rig.play(&[(PRESSURE, 400)])[0].force, Some(2.0));
}

#[test]
fn contacts_come_back_after_events_were_lost() {
    let mut rig = Rig::new();
    rig.play(&[(SLOT, 0), (ID, 1), (X, 300), (Y, 200), (SLOT, 1), (ID, 2), (X, 600), (Y, 600)]);
    rig.tape.0.lock().unwrap().slot = 1;
    let lost = [
        Event { kind: 0, code: 3, value: 0 },
        // Part of a report whose beginning is lost: not to be believed.
        Event { kind: 3, code: ID, value: 9 },
        Event { kind: 3, code: X, value: 1400 },
        Event { kind: 0, code: 0, value: 0 },
    ];
    assert_eq!(told(&rig.raw(&lost)), [(1, Up, 30.0, 90.0), (2, Up, 60.0, 50.0)]);
    // The kernel's next event is of slot 1, and does not say so. One coordinate is not enough to know where it is.
    assert!(rig.play(&[(X, 610)]).is_empty());
    assert_eq!(told(&rig.play(&[(Y, 610)])), [(3, Down, 61.0, 49.0)]);
    assert_eq!(told(&rig.play(&[(X, 620)])), [(3, Move, 62.0, 49.0)]);
    assert_eq!(told(&rig.play(&[(ID, -1)])), [(3, Up, 62.0, 49.0)]);
    // Slot 0 left meanwhile.
    assert!(rig.play(&[(SLOT, 0), (ID, -1), (X, 10), (Y, 500)]).is_empty());
    assert_eq!(told(&rig.play(&[(ID, 5)])), [(4, Down, 1.0, 60.0)]);
}

#[test]
fn an_unplugged_screen_lets_go_and_comes_back() {
    let mut rig = Rig::new();
    rig.play(&[(ID, 1), (X, 300), (Y, 200)]);
    rig.tape.0.lock().unwrap().unplugged = true;
    assert_eq!(told(&rig.play(&[])), [(1, Up, 30.0, 90.0)]);
    for _ in 0..300 {
        assert!(rig.play(&[]).is_empty());
    }
    assert_eq!(rig.screen.counts().failed, 1);
    rig.tape.0.lock().unwrap().events.clear();
    rig.tape.0.lock().unwrap().unplugged = false;
    rig.now += 1.0;
    assert_eq!(told(&rig.play(&[(ID, 2), (X, 300), (Y, 300)])), [(2, Down, 30.0, 80.0)]);
}

#[test]
fn impossible_events_do_no_harm() {
    let mut rig = Rig::new();
    assert!(rig.play(&[(SLOT, -1), (ID, 1), (X, 300), (Y, 200)]).is_empty());
    assert!(rig.play(&[(SLOT, i32::MAX), (ID, 1), (X, 300), (Y, 200)]).is_empty());
    assert!(rig.play(&[(SLOT, 0), (ID, 1), (X, i32::MAX), (Y, i32::MIN)]).is_empty());
    assert_eq!(rig.screen.counts().outside, 1);
    assert_eq!(told(&rig.play(&[(X, 300), (Y, 200)])), [(1, Down, 30.0, 90.0)]);
    let flat = Axis { minimum: 5, maximum: 5 };
    assert!(Screen::new("flat", Box::new(Tape::default()), (flat, flat), None, options()).is_err());
}

#[test]
fn what_is_no_screen_is_refused() {
    for path in ["/dev/null", "/no/such/device"] {
        let error = Screen::open(path.as_ref(), options()).err().unwrap().to_string();
        assert!(error.contains(path), "{error}");
    }
    let _ = Screen::list();
}
