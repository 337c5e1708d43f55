//! OSC written out by hand, from the specification of OSC 1.0, and a receiver to put it into.

use crate::{Promise, options, sheet};
use std::net::SocketAddr;
use unripple_core::Touch;
use unripple_touch::{Counts, Heard, OscReceiver, Wish};

/// An argument of a message.
#[derive(Clone, Copy)]
pub enum Arg<'a> {
    I(i32),
    F(f32),
    S(&'a str),
    /// A time.
    T,
}

fn padded(text: &str) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    bytes.push(0);
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    bytes
}

pub fn message(address: &str, args: &[Arg]) -> Vec<u8> {
    let mut tags = String::from(",");
    let mut values = Vec::new();
    for arg in args {
        match arg {
            Arg::I(x) => (tags.push('i'), values.extend(x.to_be_bytes())),
            Arg::F(x) => (tags.push('f'), values.extend(x.to_be_bytes())),
            Arg::S(x) => (tags.push('s'), values.extend(padded(x))),
            Arg::T => (tags.push('t'), values.extend([0, 0, 0, 0, 0, 0, 0, 1])),
        };
    }
    [padded(address), padded(&tags), values].concat()
}

pub fn bundle(elements: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = b"#bundle\0\0\0\0\0\0\0\0\x01".to_vec();
    for element in elements {
        bytes.extend((element.len() as u32).to_be_bytes());
        bytes.extend(element);
    }
    bytes
}

/// A frame of `/tuio/2Dcur`: source, everyone alive, those that moved, and the frame's number.
pub fn cursors(source: &str, alive: &[i32], sets: &[(i32, f32, f32)], fseq: i32) -> Vec<u8> {
    profile("/tuio/2Dcur", source, alive, sets, fseq)
}

pub fn profile(address: &str, source: &str, alive: &[i32], sets: &[(i32, f32, f32)], fseq: i32) -> Vec<u8> {
    let list: Vec<Arg> = std::iter::once(Arg::S("alive")).chain(alive.iter().map(|s| Arg::I(*s))).collect();
    let set = |&(s, x, y): &(i32, f32, f32)| {
        let zeros = |n: usize| std::iter::repeat_n(Arg::F(0.0), n);
        let mut args = vec![Arg::S("set"), Arg::I(s)];
        if address.ends_with("obj") {
            args.push(Arg::I(17));
        }
        args.extend([Arg::F(x), Arg::F(y)]);
        args.extend(zeros(if address.ends_with("cur") { 3 } else { 6 }));
        message(address, &args)
    };
    let mut elements = vec![message(address, &[Arg::S("source"), Arg::S(source)]), message(address, &list)];
    elements.extend(sets.iter().map(set));
    elements.push(message(address, &[Arg::S("fseq"), Arg::I(fseq)]));
    bundle(&elements)
}

/// A receiver that checks what it promises at every packet.
pub struct Rig {
    pub receiver: OscReceiver,
    pub now: f64,
    promise: Promise,
    pub wishes: Vec<Wish>,
}

impl Rig {
    pub fn new() -> Self {
        Self::with(options())
    }

    pub fn with(options: unripple_touch::Options) -> Self {
        let receiver = OscReceiver::new(options).unwrap();
        Self { receiver, now: 0.0, promise: Promise::default(), wishes: Vec::new() }
    }

    /// A packet from a port of this machine, 10 ms after the last.
    pub fn send(&mut self, port: u16, packet: &[u8]) -> Vec<Touch> {
        self.now += 0.01;
        let mut heard = Heard::default();
        self.receiver.begin(self.now);
        self.receiver.packet(SocketAddr::from(([127, 0, 0, 1], port)), packet, &mut heard);
        self.receiver.end(&mut heard);
        self.promise.hold(&heard.touches, &sheet());
        self.wishes.extend(heard.wishes);
        heard.touches
    }

    /// Nothing for some time, polled every 10 ms.
    pub fn wait(&mut self, seconds: f64) -> Vec<Touch> {
        let mut heard = Heard::default();
        for _ in 0..(seconds / 0.01).round() as usize {
            self.now += 0.01;
            self.receiver.begin(self.now);
            self.receiver.end(&mut heard);
        }
        self.promise.hold(&heard.touches, &sheet());
        heard.touches
    }

    pub fn counts(&self) -> Counts {
        self.receiver.counts()
    }
}
