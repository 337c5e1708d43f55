//! A sheet, touches on it, and the cues that an effect gives for them.
#![allow(dead_code)]

use unripple_core::{Outline, Phase, Point, Shape, Touch};
use unripple_effects::{Act, Cue, Curve, Effect, EffectSet, Effects, Kind, Level, Region, Texture};

pub const RATE: f64 = 8000.0;

pub fn sheet() -> Outline {
    Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 })
}

pub fn effect(kind: Kind) -> Effect {
    Effect { name: "it".into(), region: Region::Everywhere, level: Level::Share(1.0), kind }
}

pub fn set(effects: Vec<Effect>) -> EffectSet {
    EffectSet { name: "test".into(), about: String::new(), effects }
}

pub fn effects(one: Effect) -> Effects {
    Effects::new(&set(vec![one]), sheet(), RATE).unwrap()
}

pub fn touch(phase: Phase, x: f64, y: f64, time: f64) -> Touch {
    Touch { finger: 1, phase, at: Point::from_mm(x, y), time, force: None }
}

/// The cues of one effect for a list of touches.
pub fn played(one: Effect, touches: &[Touch]) -> Vec<Cue> {
    let (mut effects, mut cues) = (effects(one), Vec::new());
    touches.iter().for_each(|touch| effects.touch(touch, &mut cues));
    cues
}

/// Times (s), places (mm) and levels (shares) of the pulses among cues.
pub fn pulses(cues: &[Cue]) -> Vec<(f64, f64, f64, f64)> {
    let pulse = |cue: &Cue| match cue.act {
        Act::Pulse { place, gain: Level::Share(gain) } => Some((cue.at, place.x * 1e3, place.y * 1e3, gain)),
        _ => None,
    };
    cues.iter().filter_map(pulse).collect()
}

pub fn texture(pitch: f64, grain: f64) -> Texture {
    Texture { pitch, grain, seed: 7, speed_gain: Curve::constant(1.0) }
}

/// The cues that a player plays from a list: each stop of a voice cancels earlier cues of that voice for later times.
pub fn heard(cues: &[Cue]) -> Vec<Cue> {
    let mut heard: Vec<Cue> = Vec::new();
    for cue in cues {
        if matches!(cue.act, Act::Stop { .. }) {
            heard.retain(|before| before.voice != cue.voice || before.at <= cue.at);
        }
        heard.push(cue.clone());
    }
    heard.sort_by(|a, b| a.at.total_cmp(&b.at).then(a.voice.cmp(&b.voice)));
    heard
}
