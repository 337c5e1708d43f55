//! Any packets from any addresses: whatever comes out holds to its promise, and memory stays as it is.
#![no_main]

use libfuzzer_sys::fuzz_target;
use std::collections::BTreeSet;
use std::net::SocketAddr;
use unripple_core::{Outline, Phase, Shape};
use unripple_touch::{Heard, Options, OscReceiver};

fuzz_target!(|bytes: &[u8]| {
    let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.1 });
    let mut receiver = OscReceiver::new(Options::new(&sheet)).expect("the options are sound");
    let (mut heard, mut now) = (Heard::default(), 0.0);
    let (mut down, mut gone) = (BTreeSet::new(), BTreeSet::new());
    // Each packet after its length, its port and how long it took to come.
    let mut rest = bytes;
    while let [high, low, port, wait, tail @ ..] = rest {
        let length = usize::from(u16::from_be_bytes([*high, *low])).min(tail.len());
        let (packet, next) = tail.split_at(length);
        now += f64::from(*wait) / 100.0;
        receiver.begin(now);
        receiver.packet(SocketAddr::from(([127, 0, 0, 1], u16::from(*port))), packet, &mut heard);
        receiver.end(&mut heard);
        rest = next;
        for touch in heard.touches.drain(..) {
            assert!(sheet.contains(touch.at) && !gone.contains(&touch.finger));
            match touch.phase {
                Phase::Down => assert!(down.insert(touch.finger)),
                Phase::Move => assert!(down.contains(&touch.finger)),
                Phase::Up => assert!(down.remove(&touch.finger) && gone.insert(touch.finger)),
            }
        }
        heard.clear();
        assert!(receiver.tracked() <= 32 + 16 * 5);
    }
});
