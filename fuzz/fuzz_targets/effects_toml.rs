//! Any text is effects that come back from their own file and can be played, or faults that say where they are.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unripple_core::{Outline, Phase, Point, Shape, Touch};
use unripple_effects::{EffectSet, Effects, limits};
use unripple_store::{effects_to_toml, parse_effects};

/// A finger that strokes across the sheet and back.
fn play(set: &EffectSet) {
    let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
    let Ok(mut effects) = Effects::new(set, sheet, 4e3) else { panic!("a legal set is refused") };
    let mut cues = Vec::new();
    for i in 0..20 {
        let phase = if i == 0 { Phase::Down } else { Phase::Move };
        let time = 0.02 * f64::from(i);
        let at = Point::from_mm(75.0 + 60.0 * (0.4 * f64::from(i)).sin(), 75.0);
        effects.touch(&Touch { finger: 1, phase, at, time, force: Some(0.2 * f64::from(i)) }, &mut cues);
        effects.tick(time + 0.03, &mut cues);
    }
    effects.touch(&Touch { finger: 1, phase: Phase::Up, at: Point::default(), time: 0.4, force: None }, &mut cues);
    assert!(effects.fingers() == 0 && cues.len() <= 43 * (limits::MOST_CUES + 256 * limits::MOST_EFFECTS));
}

fuzz_target!(|text: &str| {
    match parse_effects(text, "fuzz.toml") {
        Ok(set) => {
            // Long waveforms would only make it slow.
            if !text.contains("amplitude") || text.len() < 2000 {
                play(&set);
            }
            match parse_effects(&effects_to_toml(&set), "copy.toml") {
                Ok(copy) => assert_eq!(copy, set),
                Err(faults) => panic!("{faults:#}"),
            }
        }
        Err(faults) => {
            assert!(!faults.faults().is_empty());
            for fault in faults.faults() {
                assert!(fault.line >= 1 && fault.column >= 1 && fault.span.end <= text.len());
            }
        }
    }
});
