//! Scores in files of effects.

use super::curve::envelope;
use super::path::place;
use super::range;
use crate::surface::reader::{Entry, Faults, Section};
use unripple_effects::{Event, Score, Sound, Start, limits};

/// Triggers of a score, by their names in files.
pub(super) const STARTS: [(&str, Start); 3] =
    [("touch", Start::Touch), ("zero", Start::Zero), ("name", Start::Name)];

/// Keys that an event of a score may have.
pub(super) const EVENT_KEYS: [&str; 5] = ["at_ms", "gain", "at_mm", "amplitude", "frequency_hz"];

/// A score and its events.
pub(super) fn read(section: &Section, faults: &mut Faults) -> Option<Score> {
    let start = section.choice_or("start", Start::Touch, &STARTS, faults);
    let period = match section.get("period_ms") {
        Some(entry) => entry.number(&range::PERIOD, faults).map(|period| Some((entry, period))),
        None => Some(None),
    };
    let events = events(section, faults);
    let (period, events) = (period?, events?);
    let last = events.iter().map(|event| event.at).fold(0.0, f64::max);
    if let Some((entry, _)) = period.as_ref().filter(|(_, period)| *period < last) {
        entry.refuse(
            "a period no shorter than the time of the last event",
            range::PERIOD.nearest(1e3 * last),
            faults,
        );
        return None;
    }
    Some(Score { start: start?, period: period.map(|(_, period)| period), events })
}

fn events(section: &Section, faults: &mut Faults) -> Option<Vec<Event>> {
    let most = limits::MOST_EVENTS;
    let expected = format!("1 to {most} tables headed [[effect.event]]");
    let entry = section.require("event", &expected, faults)?;
    let Some(items) = entry.items().filter(|items| (1..=most).contains(&items.len())) else {
        entry.refuse(expected, None, faults);
        return None;
    };
    let read: Vec<Option<Event>> = items.iter().map(|item| event(item, faults)).collect();
    read.into_iter().collect()
}

fn event(item: &Entry, faults: &mut Faults) -> Option<Event> {
    let section = item.section(faults)?;
    section.check_keys(&EVENT_KEYS, |_| None, faults);
    let at = section.number("at_ms", &range::TIME, faults);
    let gain = section.number_or("gain", 1.0, &range::SHARE, faults);
    let spot = match section.get("at_mm") {
        Some(entry) => place(&entry, faults).map(Some),
        None => Some(None),
    };
    let sound = match (section.get("amplitude"), section.get("frequency_hz")) {
        (None, None) => Some(Sound::Pulse),
        (Some(amplitude), Some(frequency)) => envelope(&amplitude, &frequency, faults).map(Sound::Wave),
        (Some(entry), None) => {
            entry.refuse("frequency_hz beside amplitude", None, faults);
            None
        }
        (None, Some(entry)) => {
            entry.refuse("amplitude, [[ms, 0 to 1], …], beside frequency_hz", None, faults);
            None
        }
    };
    Some(Event { at: at?, gain: gain?, place: spot?, sound: sound? })
}
