//! Files of effects, and what they make felt.

use unripple_core::{Outline, Phase, Point, Shape, Touch};
use unripple_effects::{Act, Cue, Effects, Kind, Level, Region};
use unripple_store::{StoreError, builtin_effect, builtin_effects, load_effects, parse_effects};

fn sheet() -> Outline {
    Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 })
}

/// A finger that comes down in the middle, strokes to the right and back over 60 mm within 2 s, and leaves.
fn stroked(effects: &mut Effects) -> Vec<Cue> {
    let mut cues = Vec::new();
    let mut touch = |phase, x, time, force| {
        let at = Point::from_mm(x, 75.0);
        effects.touch(&Touch { finger: 1, phase, at, time, force: Some(force) }, &mut cues);
    };
    touch(Phase::Down, 60.0, 0.0, 0.3);
    for i in 1..=200 {
        let share = f64::from(i) / 200.0;
        touch(Phase::Move, 60.0 + 60.0 * (1.0 - (2.0 * share - 1.0).abs()), 2.0 * share, 3.0 * share);
    }
    touch(Phase::Up, 60.0, 2.01, 0.0);
    cues
}

#[test]
fn every_builtin_is_felt() {
    assert!(builtin_effects().len() >= 10);
    for builtin in builtin_effects() {
        let set = match parse_effects(builtin.text, builtin.name) {
            Ok(set) => set,
            Err(faults) => panic!("{faults:#}"),
        };
        assert_eq!(Some(&set), builtin_effect(builtin.name).as_ref());
        // What the list says is what the file says.
        assert_eq!(set.about, builtin.about);
        let mut effects = Effects::new(&set, sheet(), 48e3).unwrap();
        let cues = stroked(&mut effects);
        let sounds = cues.iter().filter(|cue| !matches!(cue.act, Act::Stop { .. } | Act::Move { .. }));
        assert!(sounds.count() > 0, "{}", builtin.name);
        assert_eq!((effects.dropped(), effects.refused(), effects.fingers()), (0, 0, 0));
    }
}

/// Pulses of a built-in effect under the stroke.
fn pulses(name: &str) -> Vec<(f64, Point, Level)> {
    let mut effects = Effects::new(&builtin_effect(name).unwrap(), sheet(), 48e3).unwrap();
    let pulse = |cue: Cue| match cue.act {
        Act::Pulse { place, gain } => Some((cue.at, place, gain)),
        _ => None,
    };
    stroked(&mut effects).into_iter().filter_map(pulse).collect()
}

#[test]
fn builtins_do_what_they_say() {
    let levels = |name: &str| pulses(name).into_iter().map(|(_, _, gain)| gain).collect::<Vec<_>>();
    assert_eq!(levels("click-button"), [Level::Share(0.8), Level::Share(0.4)]);
    // Touched, pressed at 1.5 N, let go of both.
    let stages = levels("two-stage-button");
    let expected = [Level::Share(0.35), Level::Share(1.0), Level::Share(0.105), Level::Share(0.6)];
    assert_eq!(stages, expected);
    // 120 mm of ribs.
    assert!((59..=61).contains(&pulses("corduroy").len()));
    // Out of the square at 100 mm, and in again.
    let rim = pulses("edge");
    assert!(rim.len() == 2 && rim.iter().all(|(_, at, _)| (at.x - 0.1).abs() < 1e-9), "{rim:?}");
    // Small detents at 65 to 120 mm and back, a large one at 100 mm and back.
    let notches = levels("ruler-notches");
    assert_eq!(notches.iter().filter(|gain| **gain == Level::Share(0.7)).count(), 2);
    assert!((22..=24).contains(&notches.iter().filter(|gain| **gain == Level::Share(0.3)).count()));
    // 12 a second in 2.01 s, the first at once.
    assert_eq!(pulses("rain").len(), 25);
    // 100 a second; the last falls on the lift itself.
    assert!((201..=202).contains(&pulses("drawn-triangle").len()));
}

/// A newcomer's first effect.
#[test]
fn five_lines_are_enough() {
    let text = "format = 1\n[[effect]]\nkind = \"texture\"\nevery_mm = 2\nfelt_db = 20\n";
    assert_eq!(text.lines().count(), 5);
    let set = parse_effects(text, "ribs.toml").unwrap();
    assert_eq!((set.name.as_str(), set.effects[0].name.as_str()), ("ribs", "texture-1"));
    assert_eq!((set.effects[0].level, &set.effects[0].region), (Level::Felt(20.0), &Region::Everywhere));
    assert!(matches!(&set.effects[0].kind, Kind::Texture(texture) if texture.pitch == 2e-3));
    assert!(stroked(&mut Effects::new(&set, sheet(), 48e3).unwrap()).len() > 50);
}

#[test]
fn files_are_found_by_name_and_by_ending() {
    let folder = std::env::temp_dir().join(format!("unripple-effects-{}", std::process::id()));
    std::fs::create_dir(&folder).unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).unwrap();
        path.display().to_string()
    };
    let ribs = write("ribs.toml", "format = 1\n[[effect]]\nkind = \"texture\"\nevery_mm = 2\n");
    assert_eq!(load_effects(&ribs).unwrap().name, "ribs");
    let tap = r#"{"Pattern": [{"Event": {"Time": 0, "EventType": "HapticTransient"}}]}"#;
    let tap = load_effects(&write("Tap.AHAP", tap)).unwrap();
    assert_eq!((tap.name.as_str(), tap.effects[0].kind.name()), ("Tap", "score"));
    let bad = load_effects(&write("bad.toml", "format = 2\n")).unwrap_err();
    assert!(matches!(bad, StoreError::Surface(_)), "{bad}");
    let huge = load_effects(&write("huge.haptic", &" ".repeat(2 << 20))).unwrap_err();
    assert!(huge.to_string().contains("at most 1048576 bytes"), "{huge}");
    let none = load_effects("purrr").unwrap_err();
    assert!(
        none.is_bad_input() && none.to_string().contains("(nearest: purr), found no such file"),
        "{none}"
    );
    std::fs::remove_dir_all(folder).unwrap();
}
