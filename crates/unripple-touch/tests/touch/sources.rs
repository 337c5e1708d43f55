//! Several sources at once.

use crate::wire::{Arg, cursors, message};
use crate::{Promise, options, sheet};
use std::net::UdpSocket;
use unripple_core::Phase;
use unripple_touch::{
    Heard, OscPort, Playback, Recording, Source, Sources, Synthetic, SyntheticOptions, TouchError, Wish,
};

#[test]
fn fingers_are_unique_over_all_sources_and_can_be_predicted() {
    let text =
        (0..200).fold(String::from("{\"format\":\"unripple-touches\",\"version\":1}"), |mut text, i| {
            let phase = if i == 0 { "down" } else { "move" };
            text += &format!(
                "\n{{\"at_ms\":{},\"finger\":1,\"phase\":\"{phase}\",\"at_mm\":[{},50]}}",
                5 * i,
                20.0 + 0.5 * f64::from(i)
            );
            text
        });
    let port = OscPort::local(0, options()).unwrap();
    let (address, sender) = (port.address(), UdpSocket::bind("127.0.0.1:0").unwrap());
    let mut sources = Sources::new(&sheet());
    sources.push(Box::new(port));
    sources.push(Box::new(Playback::new(Recording::read(&text).unwrap(), &sheet()).unwrap()));
    for seed in [1, 2] {
        let options = SyntheticOptions { fingers: 5, seed, ..SyntheticOptions::default() };
        sources.push(Box::new(Synthetic::new(&sheet(), options).unwrap()));
    }
    let (mut promise, mut most, mut slid, mut wishes) = (Promise::default(), 0, None, 0);
    for i in 0..400 {
        let now = 0.0025 * f64::from(i);
        sender.send_to(&cursors("a", &[1], &[(1, 0.5, 0.5)], i), address).unwrap();
        sender.send_to(&message("/unripple/effect", &[Arg::S("click")]), address).unwrap();
        let mut heard = Heard::default();
        sources.poll(now, &mut heard);
        promise.hold(&heard.touches, &sheet());
        wishes += heard.wishes.iter().filter(|wish| **wish == Wish::Effect("click".into())).count();
        most = most.max(sources.fingers().count());
        slid = slid.or(heard
            .touches
            .iter()
            .find(|t| t.phase == Phase::Down && (t.at.x - 0.02).abs() < 1e-12)
            .map(|t| t.finger));
        if let Some(place) = slid.filter(|_| i == 200).and_then(|finger| sources.predict(finger, now, 0.02)) {
            // At 100 mm/s from 20 mm, 520 ms after it came.
            assert!((place.x - 0.072).abs() < 1e-6 && (place.y - 0.05).abs() < 1e-9, "{place}");
            slid = Some(u64::MAX);
        }
    }
    assert_eq!((slid, wishes), (Some(u64::MAX), 400));
    assert!(most > 5, "{most}");
    assert_eq!(sources.predict(u64::MAX, 1.0, 0.01), None);
    assert_eq!(sources.each().count(), 4);
    assert_eq!(sources.counts().packets, 800 + 200);
    assert_eq!(sources.counts().errors(), 0);
}

#[test]
fn a_port_in_use_is_named_with_what_to_do() {
    let port = OscPort::local(0, options()).unwrap();
    assert!(port.address().ip().is_loopback() && port.name().starts_with("UDP 127.0.0.1:"));
    let error = OscPort::bind(port.address(), options()).err().unwrap();
    assert!(matches!(error, TouchError::Io { .. }));
    assert!(error.to_string().contains(&port.address().to_string()), "{error}");
}

#[test]
fn more_fingers_than_there_may_be_are_dropped_whole() {
    let mut sources = Sources::new(&sheet());
    for seed in 1..5 {
        let options = SyntheticOptions { fingers: 64, seed, ..SyntheticOptions::default() };
        sources.push(Box::new(Synthetic::new(&sheet(), options).unwrap()));
    }
    let (mut promise, mut most) = (Promise::default(), 0);
    for i in 0..400 {
        let mut heard = Heard::default();
        sources.poll(0.01 * f64::from(i), &mut heard);
        promise.hold(&heard.touches, &sheet());
        most = most.max(sources.fingers().count());
    }
    assert_eq!(most, 128);
    assert!(sources.counts().crowded > 0);
}
