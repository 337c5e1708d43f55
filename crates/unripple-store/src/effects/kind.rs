//! Keys of each kind of effect.

use super::curve::{envelope, gains, said};
use super::path::{corners, place};
use super::{range, score};
use crate::surface::range::Limits;
use crate::surface::reader::{Entry, Faults, Section};
use unripple_core::Point;
use unripple_effects::{
    Anchor, Button, Curve, Edge, Hum, Kind, Line, Notch, Texture, Tone, Trace, Traced, Train, limits,
};

/// Every kind of effect, by its name in files.
pub(super) const NAMES: [&str; 8] =
    ["button", "texture", "edge", "notch", "pulse-train", "shape", "hum", "score"];

/// Origins that the corners of a shape may count from, by their names in files.
pub(super) const ANCHORS: [(&str, Anchor); 2] = [("finger", Anchor::Finger), ("surface", Anchor::Surface)];
/// How an envelope may play, and whether it starts over.
pub(super) const PLAYS: [(&str, bool); 2] = [("looped", true), ("once", false)];

/// The default gain of the second click of a button. Half of the first: lifting is the softer of the two.
const RELEASE: f64 = 0.5;
/// The default seed of what is left to chance. Any other gives another pattern of the same kind.
const SEED: f64 = 1.0;
/// The default of how much farther than midway a finger must go for the next notch to take it, as a share of the
/// pitch: with half as much a smaller tremor of the finger switches back and forth, with twice as much notches take
/// it later.
const HYSTERESIS: f64 = 0.1;
/// How often a shape is drawn where a file does not say, in Hz.
const SHAPE_RATE: f64 = 100.0;
/// The default rise and fall of a hum in s: much shorter, and its start is felt as a click of its own.
const FADE: f64 = 0.02;

/// Keys of a kind, beside those of every effect.
pub(super) fn keys(kind: &str) -> &'static [&'static str] {
    match kind {
        "button" => &["press_n", "release"],
        "texture" => &["every_mm", "grain", "seed", "speed_gain"],
        "edge" => &["line_mm"],
        "notch" => &["every_mm", "axis_deg", "origin_mm", "hysteresis"],
        "pulse-train" => &["rate_hz", "count", "envelope", "jitter", "scatter_mm", "seed"],
        "shape" => &["polygon_mm", "path_mm", "around", "speed_mm_per_s", "spacing_mm", "rate_hz"],
        "hum" => &["frequency_hz", "amplitude", "play", "speed_gain", "fade_ms"],
        "score" => &["start", "period_ms", "event"],
        _ => &[],
    }
}

/// An effect of a kind, read from its keys; nothing if any is at fault.
pub(super) fn read(kind: &str, section: &Section, faults: &mut Faults) -> Option<Kind> {
    match kind {
        "button" => button(section, faults).map(Kind::Button),
        "texture" => texture(section, faults).map(Kind::Texture),
        "edge" => edge(section, faults).map(Kind::Edge),
        "notch" => notch(section, faults).map(Kind::Notch),
        "pulse-train" => train(section, faults).map(Kind::Train),
        "shape" => shape(section, faults).map(Kind::Shape),
        "hum" => hum(section, faults).map(Kind::Hum),
        "score" => score::read(section, faults).map(Kind::Score),
        _ => None,
    }
}

/// A value that may be missing: `Some(None)` then, and `None` if it is at fault.
fn maybe<T>(entry: Option<Entry>, read: impl FnOnce(&Entry) -> Option<T>) -> Option<Option<T>> {
    match &entry {
        Some(entry) => read(entry).map(Some),
        None => Some(None),
    }
}

/// A whole number with a default.
fn whole(section: &Section, key: &str, default: f64, limits: &Limits, faults: &mut Faults) -> Option<f64> {
    let Some(entry) = section.get(key) else { return Some(default) };
    let value = entry.number(limits, faults)?;
    if value.fract() != 0.0 {
        entry.refuse("a whole number", Some(value.round().to_string()), faults);
        return None;
    }
    Some(value)
}

fn speed_gain(section: &Section, faults: &mut Faults) -> Option<Curve> {
    match section.get("speed_gain") {
        Some(entry) => gains(&entry, &range::SPEED, limits::SPEED, faults),
        None => Some(Curve::constant(1.0)),
    }
}

fn button(section: &Section, faults: &mut Faults) -> Option<Button> {
    let press_force = maybe(section.get("press_n"), |entry| entry.number(&range::FORCE, faults));
    let release = section.number_or("release", RELEASE, &range::SHARE, faults);
    Some(Button { press_force: press_force?, release: release? })
}

fn texture(section: &Section, faults: &mut Faults) -> Option<Texture> {
    let pitch = section.number("every_mm", &range::PITCH, faults);
    let grain = section.number_or("grain", 0.0, &range::SHARE, faults);
    let seed = whole(section, "seed", SEED, &range::SEED, faults);
    let speed_gain = speed_gain(section, faults);
    Some(Texture { pitch: pitch?, grain: grain?, seed: seed? as u64, speed_gain: speed_gain? })
}

fn edge(section: &Section, faults: &mut Faults) -> Option<Edge> {
    let line = maybe(section.get("line_mm"), |entry| {
        let ends = corners(entry, 2, 2, faults)?;
        let line = Line { from: *ends.first()?, to: *ends.last()? };
        if line.from.distance(line.to) < limits::LENGTH[0] {
            entry.refuse("two points at least 0.1 mm apart", None, faults);
            return None;
        }
        Some(line)
    });
    Some(Edge { line: line? })
}

fn notch(section: &Section, faults: &mut Faults) -> Option<Notch> {
    let pitch = section.number("every_mm", &range::PITCH, faults);
    let axis = section.number_or("axis_deg", 0.0, &range::ANGLE, faults);
    let origin = maybe(section.get("origin_mm"), |entry| place(entry, faults));
    let hysteresis = section.number_or("hysteresis", HYSTERESIS, &range::HYSTERESIS, faults);
    let origin = origin?.unwrap_or(Point::default());
    Some(Notch { pitch: pitch?, axis: axis?, origin, hysteresis: hysteresis? })
}

fn train(section: &Section, faults: &mut Faults) -> Option<Train> {
    let rate = section.number("rate_hz", &range::RATE, faults);
    let count = match section.get("count") {
        Some(_) => whole(section, "count", 1.0, &range::COUNT, faults).map(|count| Some(count as u32)),
        None => Some(None),
    };
    let envelope = maybe(section.get("envelope"), |entry| gains(entry, &range::TIME, limits::TIME, faults));
    let jitter = section.number_or("jitter", 0.0, &range::SHARE, faults);
    let scatter = section.number_or("scatter_mm", 0.0, &range::SCATTER, faults);
    let seed = whole(section, "seed", SEED, &range::SEED, faults)? as u64;
    Some(Train { rate: rate?, count: count?, envelope: envelope?, jitter: jitter?, scatter: scatter?, seed })
}

/// Of two keys, the one that is there.
fn either<'a>(section: &Section<'a>, keys: [&str; 2], faults: &mut Faults) -> Option<(Entry<'a>, bool)> {
    let expected = format!("exactly one of {} and {}", keys[0], keys[1]);
    match (section.get(keys[0]), section.get(keys[1])) {
        (Some(entry), None) => Some((entry, true)),
        (None, Some(entry)) => Some((entry, false)),
        (None, None) => {
            faults.add(&section.key, section.span.clone(), "neither", expected, None);
            None
        }
        (Some(_), Some(entry)) => {
            entry.refuse(expected, None, faults);
            None
        }
    }
}

fn shape(section: &Section, faults: &mut Faults) -> Option<Traced> {
    let path = either(section, ["polygon_mm", "path_mm"], faults).and_then(|(entry, closed)| {
        let path = corners(&entry, if closed { 3 } else { 2 }, limits::MOST_CORNERS, faults)?;
        Some((entry, path, closed))
    });
    let anchor = section.choice_or("around", Anchor::Finger, &ANCHORS, faults);
    let trace = either(section, ["speed_mm_per_s", "spacing_mm"], faults).and_then(|(entry, moving)| {
        if moving {
            entry.number(&range::SPEED, faults).map(Trace::Moving)
        } else {
            entry.number(&range::PITCH, faults).map(Trace::AtOnce)
        }
    });
    let rate = section.number_or("rate_hz", SHAPE_RATE, &range::RATE, faults);
    let (entry, path, closed) = path?;
    let shape = Traced { path, closed, anchor: anchor?, trace: trace?, rate: rate? };
    said(&entry, shape.check().map(|()| shape), faults)
}

fn hum(section: &Section, faults: &mut Faults) -> Option<Hum> {
    let expected = range::FREQUENCY.expected();
    let frequency = section.require("frequency_hz", &expected, faults);
    let looped = section.choice_or("play", true, &PLAYS, faults);
    let tone = match (section.get("amplitude"), frequency) {
        (Some(amplitude), Some(frequency)) => envelope(&amplitude, &frequency, faults)
            .zip(looped)
            .map(|(envelope, looped)| if looped { Tone::Looped(envelope) } else { Tone::Once(envelope) }),
        (None, Some(frequency)) => {
            if let Some(entry) = section.get("play") {
                entry.refuse("this key only beside amplitude", None, faults);
            }
            frequency.number(&range::FREQUENCY, faults).map(Tone::Sine)
        }
        (_, None) => None,
    };
    let speed_gain = speed_gain(section, faults);
    let fade = section.number_or("fade_ms", FADE, &range::FADE, faults);
    Some(Hum { tone: tone?, speed_gain: speed_gain?, fade: fade? })
}
