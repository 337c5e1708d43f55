//! One line of a recorded session.

use crate::Wish;
use crate::options::MOST_FORCE;
use serde::{Deserialize, Serialize};
use unripple_core::{Phase, Point, Touch};

/// What the first line says.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Head {
    pub(super) format: String,
    pub(super) version: u64,
}

/// What the first line of a recorded session says: its format and version. Anything else is refused.
pub(super) const FORMAT: &str = "unripple-touches";
pub(super) const VERSION: u64 = 1;

/// The largest coordinate, in mm, and time, in ms, that are accepted: a kilometre, a month.
const FARTHEST: f64 = 1e6;
const LATEST: f64 = 2.7e9;

/// Something that happened, at a time in s.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Item {
    Touch(Touch),
    Wish(f64, Wish),
}

impl Item {
    pub(super) fn time(&self) -> f64 {
        match self {
            Self::Touch(touch) => touch.time,
            Self::Wish(time, _) => *time,
        }
    }
}

/// Every other line: a touch, an effect or a level.
#[derive(Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Line {
    at_ms: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    finger: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    phase: Option<LinePhase>,
    #[serde(skip_serializing_if = "Option::is_none")]
    at_mm: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    force_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    effect: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gain_db: Option<f64>,
}

#[derive(Clone, Copy, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
enum LinePhase {
    Down,
    Move,
    Up,
}

/// Reads a line.
pub(super) fn read(text: &str) -> Result<Item, String> {
    // An array would be taken for the values in order.
    if !text.starts_with('{') {
        return Err("expected an object".to_owned());
    }
    let line: Line = serde_json::from_str(text).map_err(|error| error.to_string())?;
    if !(0.0..=LATEST).contains(&line.at_ms) {
        return Err(format!("at_ms: expected 0 to {LATEST}, found {}", line.at_ms));
    }
    let time = line.at_ms / 1e3;
    match line {
        Line {
            finger: Some(finger),
            phase: Some(phase),
            at_mm: Some(at),
            force_n,
            effect: None,
            gain_db: None,
            ..
        } => touch(time, finger, phase, at, force_n).map(Item::Touch),
        Line {
            effect: Some(name),
            finger: None,
            phase: None,
            at_mm: None,
            force_n: None,
            gain_db: None,
            ..
        } => {
            let wish =
                Wish::effect(&name).ok_or("effect: expected 1 to 64 bytes without control characters")?;
            Ok(Item::Wish(time, wish))
        }
        Line {
            gain_db: Some(db),
            finger: None,
            phase: None,
            at_mm: None,
            force_n: None,
            effect: None,
            ..
        } => {
            let wish = Wish::gain(db).ok_or_else(|| format!("gain_db: expected -120 to 40, found {db}"))?;
            Ok(Item::Wish(time, wish))
        }
        _ => Err("expected finger, phase and at_mm, or effect, or gain_db".to_owned()),
    }
}

fn touch(
    time: f64,
    finger: u64,
    phase: LinePhase,
    at: [f64; 2],
    force: Option<f64>,
) -> Result<Touch, String> {
    let phase = match phase {
        LinePhase::Down => Phase::Down,
        LinePhase::Move => Phase::Move,
        LinePhase::Up => Phase::Up,
    };
    if at.iter().any(|x| x.abs() > FARTHEST) {
        return Err(format!("at_mm: expected at most {FARTHEST} either way, found {at:?}"));
    }
    if let Some(force) = force.filter(|force| !(0.0..=MOST_FORCE).contains(force)) {
        return Err(format!("force_n: expected 0 to {MOST_FORCE}, found {force}"));
    }
    Ok(Touch { finger, phase, at: Point::from_mm(at[0], at[1]), time, force })
}

/// Writes an item as a line, its time counted from a start in s.
pub(super) fn write(item: &Item, start: f64) -> serde_json::Result<String> {
    let at_ms = ((item.time() - start) * 1e3).max(0.0);
    let line = match item {
        Item::Touch(touch) => Line {
            at_ms,
            finger: Some(touch.finger),
            phase: Some(match touch.phase {
                Phase::Down => LinePhase::Down,
                Phase::Move => LinePhase::Move,
                Phase::Up => LinePhase::Up,
            }),
            at_mm: Some([touch.at.x * 1e3, touch.at.y * 1e3]),
            force_n: touch.force,
            ..Line::default()
        },
        Item::Wish(_, Wish::Effect(name)) => Line { at_ms, effect: Some(name.clone()), ..Line::default() },
        Item::Wish(_, Wish::Gain(db)) => Line { at_ms, gain_db: Some(*db), ..Line::default() },
    };
    serde_json::to_string(&line)
}
