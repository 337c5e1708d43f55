//! Whatever comes in, nothing panics, and what comes out holds to its promise.

use crate::wire::{Arg, Rig, bundle, message};
use proptest::prelude::*;
use unripple_touch::{Event, Message, Recording, Slots};

#[derive(Clone, Debug)]
enum Word {
    I(i32),
    F(f32),
    S(String),
}

fn word() -> impl Strategy<Value = Word> {
    prop_oneof![
        prop_oneof![0..4i32, any::<i32>()].prop_map(Word::I),
        prop_oneof![0.0f32..1.0, any::<f32>()].prop_map(Word::F),
        prop_oneof!["set|alive|fseq|source|click", "\\PC{0,5}"].prop_map(Word::S),
    ]
}

fn any_message() -> impl Strategy<Value = Vec<u8>> {
    let address = prop_oneof![
        "/tuio/2D(cur|obj|blb)",
        "/tuio2/(frm|ptr|tok|bnd|alv|sym)",
        "/unripple/(touch|lift|clear|effect|gain)",
        "/[a-z]{0,6}",
    ];
    let command = prop::option::of("set|alive|fseq|source");
    (address, command, prop::collection::vec(word(), 0..9)).prop_map(|(address, command, words)| {
        let words: Vec<Word> = command.map(Word::S).into_iter().chain(words).collect();
        let args: Vec<Arg> = words
            .iter()
            .map(|word| match word {
                Word::I(x) => Arg::I(*x),
                Word::F(x) => Arg::F(*x),
                Word::S(x) => Arg::S(x),
            })
            .collect();
        message(&address, &args)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_messages_keep_the_promise(packets in prop::collection::vec((0..3u16, prop::collection::vec(any_message(), 1..6)), 1..20)) {
        let mut rig = Rig::new();
        for (port, messages) in packets {
            rig.send(port, &bundle(&messages));
            prop_assert!(rig.receiver.tracked() <= 32 + 16 * 5);
        }
        rig.wait(2.5);
    }

    #[test]
    fn harmed_packets_keep_the_promise(
        messages in prop::collection::vec(any_message(), 1..6),
        harm in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        cut in any::<prop::sample::Index>(),
    ) {
        let mut packet = bundle(&messages);
        for (at, byte) in harm {
            let at = at.index(packet.len());
            packet[at] = byte;
        }
        let mut rig = Rig::new();
        rig.send(1, &packet);
        packet.truncate(cut.index(packet.len()));
        rig.send(1, &packet);
    }

    #[test]
    fn any_bytes_are_taken(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let mut rig = Rig::new();
        rig.send(1, &bytes);
        prop_assert_eq!(rig.counts().packets, 1);
    }

    #[test]
    fn any_text_is_a_message_or_a_short_mistake(text in prop_oneof!["\\PC{0,200}", "[\\[{\":,0-9a-z\\]}]{0,300}"]) {
        if let Err(what) = Message::read(&text) {
            prop_assert!(!what.is_empty() && what.chars().count() <= 200);
        }
        let _ = Recording::read(&text);
        let _ = Recording::read(&format!("{{\"format\":\"unripple-touches\",\"version\":1}}\n{text}"));
    }

    #[test]
    fn any_events_are_taken(events in prop::collection::vec((0..4u16, 0x2e..0x3cu16, -2..70i32), 0..200)) {
        let mut slots = Slots::new();
        for (kind, code, value) in events {
            let code = if kind == 0 { code % 4 } else { code };
            slots.push(Event { kind, code, value });
            prop_assert!(slots.contacts().count() <= 64);
        }
    }
}
