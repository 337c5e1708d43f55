//! Report of the task `devices`.

#[cfg(not(feature = "cards"))]
use crate::device::HOW_TO_GET_CARDS;
use serde::Serialize;
use serde_json::{Value, json};
use std::fmt::Write;
use unripple_devices::{Found, Stream};

/// The devices through which drives can be played.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// One JSON object for each device: `device` is its kind, `available` says whether it can be played through; the other keys say what it
    /// offers.
    pub devices: Vec<Value>,
    #[serde(skip)]
    text: String,
}

impl crate::Report for Report {
    fn text(&self) -> String {
        self.text.clone()
    }
}

impl Report {
    /// Makes the report from the devices that were found, and adds the sound cards if this build supports
    /// them.
    pub(super) fn of(found: &[Found]) -> Self {
        let mut devices: Vec<Value> = found.iter().map(entry).collect();
        let mut text: String = found.iter().map(told).collect();
        cards(&mut devices, &mut text);
        Self { devices, text }
    }
}

/// Adds the sound cards that can be opened.
#[cfg(feature = "cards")]
fn cards(entries: &mut Vec<Value>, text: &mut String) {
    use unripple_devices::cards::{Offer, found};
    let told = |offer: &Offer| {
        let [few, many] = offer.channels;
        let [low, high] = offer.rates;
        let blocks =
            offer.blocks.map_or_else(String::new, |[small, large]| format!(", blocks {small} to {large}"));
        format!("{few} to {many} channels, {low} to {high} Hz{blocks}")
    };
    let entry = |offer: &Offer| json!({ "channels": offer.channels, "sample_rates_hz": offer.rates, "blocks": offer.blocks });
    let found = found();
    if found.is_empty() {
        let _ = writeln!(text, "card      none that can play or record");
    }
    for card in found {
        let _ = writeln!(text, "card      {}: {}", card.id, card.name.replace('\n', ", "));
        for (way, offer) in [("playback", &card.playback), ("capture", &card.capture)] {
            if let Some(offer) = offer {
                let _ = writeln!(text, "            {way:8} {}", told(offer));
            }
        }
        entries.push(json!({
            "device": "card",
            "available": true,
            "id": card.id,
            "name": card.name,
            "playback": card.playback.as_ref().map(entry),
            "capture": card.capture.as_ref().map(entry),
        }));
    }
}

/// Adds that this build has no sound cards, and how to get one that does.
#[cfg(not(feature = "cards"))]
fn cards(entries: &mut Vec<Value>, text: &mut String) {
    entries.push(json!({ "device": "card", "available": false, "why": HOW_TO_GET_CARDS }));
    let _ = writeln!(text, "card      not in this build: {HOW_TO_GET_CARDS}");
}

fn entry(found: &Found) -> Value {
    match found {
        Found::Virtual => json!({ "device": "virtual", "available": true }),
        Found::Tape => json!({ "device": "tape", "available": true }),
        Found::Jack(server) => json!({
            "device": "jack",
            "available": true,
            "sample_rate_hz": server.rate,
            "block": server.block,
            "playback": server.playback,
            "capture": server.capture,
        }),
        Found::NoJack(why) => json!({ "device": "jack", "available": false, "why": why }),
        Found::Card { index, name, streams } => json!({
            "device": "alsa",
            "card": index,
            "name": name,
            "streams": streams.iter().map(stream).collect::<Vec<_>>(),
        }),
    }
}

fn stream(stream: &Stream) -> Value {
    json!({
        "device": stream.device,
        "direction": direction(stream),
        "channels": stream.channels,
        "sample_rates_hz": stream.rates,
    })
}

fn direction(stream: &Stream) -> &'static str {
    if stream.playback { "playback" } else { "capture" }
}

fn told(found: &Found) -> String {
    let mut text = String::new();
    let _ = match found {
        Found::Virtual => {
            writeln!(text, "virtual   the surface itself, simulated: a channel for each actuator")
        }
        Found::Tape => {
            writeln!(text, "tape      WAV files: write one to play elsewhere, read the recordings of it")
        }
        Found::NoJack(why) => writeln!(text, "jack      not available. {why}"),
        Found::Jack(server) => {
            let _ = writeln!(
                text,
                "jack      {} Hz, {} samples a block, {} playback ports, {} capture ports",
                server.rate,
                server.block,
                server.playback.len(),
                server.capture.len()
            );
            let ports = server.playback.iter().map(|port| ("to", port));
            let ports = ports.chain(server.capture.iter().map(|port| ("from", port)));
            ports.into_iter().try_for_each(|(way, port)| writeln!(text, "            {way:4} {port}"))
        }
        Found::Card { index, name, streams } => {
            let _ = writeln!(text, "card {index}    {name}, as the kernel lists it");
            streams.iter().try_for_each(|stream| {
                writeln!(text, "            {:8} {:8} {}", stream.device, direction(stream), offers(stream))
            })
        }
    };
    text
}

/// Text on channel counts and sample rates, as far as the kernel knows them.
fn offers(stream: &Stream) -> String {
    let listed = |values: Vec<String>| values.join(", ");
    if stream.channels.is_empty() && stream.rates.is_empty() {
        return "channels and rates are known only once it is opened".into();
    }
    let channels = listed(stream.channels.iter().map(usize::to_string).collect());
    let rates = listed(stream.rates.iter().map(f64::to_string).collect());
    format!("channels {channels}; rates {rates} Hz")
}
