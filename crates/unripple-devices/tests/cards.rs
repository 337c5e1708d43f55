//! Sound cards, as far as they can be tried without one: ALSA's `null` device hears silence, and has no clock: its two sides run
//! as fast as their threads do, each at a pace of its own.
#![cfg(feature = "cards")]

#[path = "../../unripple-core/tests/shared/skip.rs"]
mod skip;

use skip::skip;
use unripple_core::{Device, DeviceError, State};
use unripple_devices::DevicesError;
use unripple_devices::cards::{Card, CardOptions, found};

fn names(count: usize) -> Vec<String> {
    (1..=count).map(|i| format!("a{i}")).collect()
}

/// Options for the null device, if the system has one.
fn null() -> Option<CardOptions> {
    if !found().iter().any(|card| card.id == "null") {
        skip("the sound system has no null device (Debian: apt install libasound2-data)");
        return None;
    }
    let null = Some("null".to_owned());
    Some(CardOptions { playback: null, outputs: names(8), inputs: names(9), ..Default::default() })
}

#[test]
fn the_null_device_takes_drive_and_hears_silence() {
    let Some(options) = null() else { return };
    let offer = found().into_iter().find(|card| card.id == "null").and_then(|card| card.playback).unwrap();
    assert!(offer.channels[1] >= 8 && offer.rates[0] <= 48e3 && offer.rates[1] >= 48e3, "{offer:?}");
    let mut card = Card::open(&CardOptions { strict: false, ..options }).unwrap();
    assert_eq!((card.layout().outputs.len(), card.layout().inputs.len(), card.layout().block), (8, 9, 256));
    let mut heard = vec![1.0; 9 * 256];
    for _ in 0..50 {
        card.exchange(&vec![0.1; 8 * 256], &mut heard).unwrap();
        assert!(heard.iter().all(|x| *x == 0.0));
    }
    assert_eq!((card.status().state, card.status().blocks), (State::Running, 50));
    assert!(card.exchange(&[0.0; 3], &mut heard).is_err());
}

#[test]
fn sides_without_a_common_clock_are_called_so() {
    let Some(options) = null() else { return };
    // How fast its two sides run is a matter of luck. They may keep together for so long, but nobody waits for them in vain.
    let mut card = Card::open(&CardOptions { strict: true, ..options }).unwrap();
    let mut heard = vec![1.0; 9 * 256];
    let error = (0..2000).find_map(|_| card.exchange(&vec![0.1; 8 * 256], &mut heard).err());
    match error {
        None => assert_eq!(card.status().state, State::Running),
        Some(DeviceError::Lost { why, .. }) => assert!(why.contains("two clocks"), "{why}"),
        Some(error) => panic!("{error}"),
    }
}

#[test]
fn what_a_card_has_not_is_refused_with_what_to_do() {
    let none = CardOptions { playback: Some("nowhere".into()), outputs: names(1), ..Default::default() };
    let error = Card::open(&none).unwrap_err();
    assert!(matches!(error, DevicesError::Card { .. }) && error.to_string().contains("`nowhere`"), "{error}");
    let refused = |options: CardOptions| Card::open(&options).unwrap_err().to_string();
    assert!(refused(CardOptions { outputs: vec![], ..none.clone() }).contains("outputs of a card"));
    assert!(refused(CardOptions { rate: 44_100.5, ..none.clone() }).contains("whole number"));
    assert!(refused(CardOptions { block: 0, ..none.clone() }).contains("samples of a block"));
    assert!(refused(CardOptions { lead: 0, ..none }).contains("blocks of lead"));

    let Some(options) = null() else { return };
    let offer = found().into_iter().find(|card| card.id == "null").and_then(|card| card.playback).unwrap();
    let many = CardOptions { outputs: names(offer.channels[1] + 1), ..options };
    let error = Card::open(&many).unwrap_err();
    assert!(matches!(error, DevicesError::Channels { .. }), "{error}");
    assert!(error.to_string().contains("unripple devices"), "{error}");
}
