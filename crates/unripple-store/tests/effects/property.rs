//! Any effects come back from their file and satisfy the schema; no text makes a reader panic.

use crate::schema::{json, refused};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use unripple_core::{Outline, Point, Shape};
use unripple_effects::{
    Anchor, Button, Curve, Edge, Effect, EffectSet, Effects, Envelope, Event, Hum, Kind, Level, Line, Notch,
    Region, Score, Sound, Start, Texture, Tone, Trace, Traced, Train, limits,
};
use unripple_store::{effects_to_toml, import_haptic, parse_effects};

fn within([least, greatest]: [f64; 2]) -> std::ops::RangeInclusive<f64> {
    least..=greatest
}

fn point() -> impl Strategy<Value = Point> {
    (within(limits::PLACE), within(limits::PLACE)).prop_map(|(x, y)| Point::new(x, y))
}

fn rows(along: [f64; 2], values: [f64; 2]) -> impl Strategy<Value = Vec<(f64, f64)>> {
    vec((within(along), within(values)), 1..6).prop_map(|mut rows| {
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        rows
    })
}

fn curve(along: [f64; 2]) -> impl Strategy<Value = Curve> {
    rows(along, limits::SHARE).prop_map(move |rows| Curve::new("x", rows, along, limits::SHARE).unwrap())
}

fn envelope() -> impl Strategy<Value = Envelope> {
    let time = [0.0, 0.5];
    (rows(time, limits::SHARE), rows(time, limits::FREQUENCY), 0.6..1.0_f64).prop_map(|(mut a, f, end)| {
        a.push((end, 0.3));
        Envelope::new(a, f).unwrap()
    })
}

fn region() -> impl Strategy<Value = Region> {
    let length = || within(limits::LENGTH);
    prop_oneof![
        (point(), length(), length()).prop_map(|(corner, width, height)| Region::Rectangle {
            corner,
            width,
            height
        }),
        (point(), length()).prop_map(|(centre, radius)| Region::Circle { centre, radius }),
        vec(point(), 3..9).prop_map(Region::Polygon),
    ]
}

fn texture() -> impl Strategy<Value = Kind> {
    (within(limits::PITCH), within(limits::SHARE), 0..1_u64 << 53, curve(limits::SPEED)).prop_map(
        |(pitch, grain, seed, speed_gain)| Kind::Texture(Texture { pitch, grain, seed, speed_gain }),
    )
}

fn edge() -> impl Strategy<Value = Kind> {
    let line = (point(), point()).prop_filter("long enough", |(a, b)| a.distance(*b) > 1e-3);
    option::of(line.prop_map(|(from, to)| Line { from, to })).prop_map(|line| Kind::Edge(Edge { line }))
}

fn notch() -> impl Strategy<Value = Kind> {
    (within(limits::PITCH), -12.5..12.5_f64, point(), within(limits::HYSTERESIS))
        .prop_map(|(pitch, axis, origin, hysteresis)| Kind::Notch(Notch { pitch, axis, origin, hysteresis }))
}

fn train() -> impl Strategy<Value = Kind> {
    let envelope = option::of(curve(limits::TIME));
    let chance = (within(limits::SHARE), within(limits::SCATTER), 0..1_u64 << 53);
    (within(limits::RATE), option::of(1..=limits::MOST_COUNT), envelope, chance).prop_map(
        |(rate, count, envelope, (jitter, scatter, seed))| {
            Kind::Train(Train { rate, count, envelope, jitter, scatter, seed })
        },
    )
}

fn shape() -> impl Strategy<Value = Kind> {
    let corner = (-0.05..0.05_f64, -0.05..0.05_f64).prop_map(|(x, y)| Point::new(x, y));
    let trace =
        prop_oneof![within(limits::SPEED).prop_map(Trace::Moving), (0.01..1.0_f64).prop_map(Trace::AtOnce),];
    let anchor = prop_oneof![Just(Anchor::Finger), Just(Anchor::Surface)];
    (vec(corner, 3..8), any::<bool>(), anchor, trace, within(limits::RATE)).prop_map(
        |(path, closed, anchor, trace, rate)| Kind::Shape(Traced { path, closed, anchor, trace, rate }),
    )
}

fn hum() -> impl Strategy<Value = Kind> {
    let tone = prop_oneof![
        within(limits::FREQUENCY).prop_map(Tone::Sine),
        envelope().prop_map(Tone::Once),
        envelope().prop_map(Tone::Looped),
    ];
    (tone, curve(limits::SPEED), within(limits::FADE))
        .prop_map(|(tone, speed_gain, fade)| Kind::Hum(Hum { tone, speed_gain, fade }))
}

fn score() -> impl Strategy<Value = Kind> {
    let sound = prop_oneof![Just(Sound::Pulse), envelope().prop_map(Sound::Wave)];
    let event = (0.0..1.0_f64, within(limits::SHARE), option::of(point()), sound)
        .prop_map(|(at, gain, place, sound)| Event { at, gain, place, sound });
    let start = prop_oneof![Just(Start::Touch), Just(Start::Zero), Just(Start::Name)];
    (start, option::of(1.0..100.0_f64), vec(event, 1..6))
        .prop_map(|(start, period, events)| Kind::Score(Score { start, period, events }))
}

fn sets() -> impl Strategy<Value = EffectSet> {
    let button = (option::of(within(limits::FORCE)), within(limits::SHARE))
        .prop_map(|(press_force, release)| Kind::Button(Button { press_force, release }));
    let kind = prop_oneof![button, texture(), edge(), notch(), train(), shape(), hum(), score()];
    let level = prop_oneof![
        within(limits::SHARE).prop_map(Level::Share),
        within(limits::FELT).prop_map(Level::Felt),
    ];
    let effect = (region(), any::<bool>(), level, kind);
    let line = || "[a-zA-Zäß\"\\\\' ]{0,20}x";
    (line(), option::of(line()), vec(effect, 1..6)).prop_map(|(name, about, effects)| {
        let one = |(i, (region, is_everywhere, level, kind)): (usize, (Region, bool, Level, Kind))| {
            let nowhere = matches!(&kind, Kind::Edge(edge) if edge.line.is_none());
            let region = if is_everywhere && !nowhere { Region::Everywhere } else { region };
            Effect { name: format!("e\"{i}"), region, level, kind }
        };
        let effects = effects.into_iter().enumerate().map(one).collect();
        let trim = |text: String| text.trim().to_owned();
        EffectSet { name: trim(name), about: about.map(trim).unwrap_or_default(), effects }
    })
}

/// Keys of files, and one that is none.
const KEYS: &[&str] = &[
    "kind",
    "name",
    "gain",
    "felt_db",
    "region",
    "every_mm",
    "seed",
    "speed_gain",
    "line_mm",
    "axis_deg",
    "rate_hz",
    "count",
    "envelope",
    "polygon_mm",
    "path_mm",
    "speed_mm_per_s",
    "spacing_mm",
    "frequency_hz",
    "amplitude",
    "play",
    "start",
    "period_ms",
    "at_ms",
    "at_mm",
    "zzz",
];

/// Values of files, right for some key or for none.
const VALUES: &[&str] = &[
    "\"button\"",
    "\"texture\"",
    "\"edge\"",
    "\"pulse-train\"",
    "\"shape\"",
    "\"hum\"",
    "\"score\"",
    "\"once\"",
    "1",
    "0.5",
    "-3",
    "nan",
    "1e999",
    "0x7fffffffffffffff",
    "[]",
    "[[]]",
    "[[0, 1], [90, 0]]",
    "[[0, 0], [9, 0], [0, 9]]",
    "[[1, 1], [0, 1]]",
    "[1, 2]",
    "{}",
    "true",
    "{ circle_mm = 5, centre_mm = [9, 9] }",
    "{ polygon_mm = [[0,0],[1,0],[0,1]] }",
    "[",
];

/// Files of such lines, some of them right.
fn text() -> impl Strategy<Value = String> {
    let (key, value) = (proptest::sample::select(KEYS), proptest::sample::select(VALUES));
    let line = prop_oneof![
        6 => (key, value).prop_map(|(key, value)| format!("{key} = {value}")),
        2 => Just("[[effect]]".to_owned()),
        1 => Just("[[effect.event]]".to_owned()),
        1 => "\\PC{0,20}",
    ];
    vec(line, 0..20).prop_map(|lines| format!("format = 1\n[[effect]]\n{}\n", lines.join("\n")))
}

/// JSON of the words of the formats for phones.
fn words() -> impl Strategy<Value = serde_json::Value> {
    let word = proptest::sample::select(vec![
        "version",
        "major",
        "signals",
        "continuous",
        "envelopes",
        "amplitude",
        "frequency",
        "time",
        "emphasis",
        "Pattern",
        "Event",
        "ParameterCurve",
        "Parameter",
        "EventType",
        "HapticTransient",
        "HapticContinuous",
        "Time",
        "EventDuration",
        "EventParameters",
        "ParameterID",
        "ParameterValue",
        "HapticIntensity",
        "HapticIntensityControl",
        "ParameterCurveControlPoints",
        "perceptions",
        "channels",
        "bands",
        "band_type",
        "Transient",
        "VectorialWave",
        "effects",
        "effect_type",
        "Basis",
        "Reference",
        "position",
        "keyframes",
        "relative_position",
        "amplitude_modulation",
        "frequency_modulation",
        "timescale",
        "gain",
        "effect_library",
        "id",
    ]);
    let leaf = prop_oneof![
        Just(serde_json::Value::Null),
        any::<bool>().prop_map(Into::into),
        prop_oneof![Just(1.0), 0.0..2.0_f64, proptest::num::f64::ANY].prop_map(Into::into),
        word.clone().prop_map(Into::into),
    ];
    leaf.prop_recursive(8, 128, 6, move |inner| {
        prop_oneof![
            vec(inner.clone(), 0..6).prop_map(Into::into),
            proptest::collection::hash_map(word.clone().prop_map(str::to_owned), inner, 0..6)
                .prop_map(|map| map.into_iter().collect::<serde_json::Map<_, _>>().into()),
        ]
    })
}

/// Whatever is read can be played.
fn playable(kind: Kind) {
    let effect = Effect { name: "it".into(), region: Region::Everywhere, level: Level::Share(1.0), kind };
    let set = EffectSet { name: "it".into(), about: String::new(), effects: vec![effect] };
    let sheet = Outline::new(Shape::Rectangle { width: 0.1, height: 0.1 });
    assert!(Effects::new(&set, sheet, 4e3).is_ok());
}

proptest! {
    #[test]
    fn effects_come_back(set in sets()) {
        prop_assert_eq!(set.check(), Ok(()));
        let text = effects_to_toml(&set);
        match parse_effects(&text, "copy.toml") {
            Ok(copy) => prop_assert_eq!(copy, set),
            Err(faults) => panic!("{faults:#}\n{text}"),
        }
        prop_assert_eq!(refused(&json(&text)), None, "{}", text);
    }

    #[test]
    fn any_text_is_read_or_refused(text in text()) {
        match parse_effects(&text, "any.toml") {
            Ok(set) => {
                prop_assert_eq!(set.check(), Ok(()));
                prop_assert_eq!(parse_effects(&effects_to_toml(&set), "copy.toml").ok(), Some(set));
            }
            Err(faults) => {
                prop_assert!(!faults.faults().is_empty());
                prop_assert!(faults.faults().iter().all(|f| f.line >= 1 && f.column >= 1 && f.span.end <= text.len()));
            }
        }
    }

    #[test]
    fn any_json_is_imported_or_refused(value in words(), ending in 0..3_usize) {
        let file = ["any.haptic", "any.ahap", "any.hjif"][ending];
        if let Ok(score) = import_haptic(&value.to_string(), file) {
            playable(Kind::Score(score));
        }
    }

    /// A good import with one piece of it replaced.
    #[test]
    fn imports_with_a_fault_are_refused(at in any::<prop::sample::Index>(), with in words(), which in 0..3_usize) {
        let (file, text) = crate::imports::EXAMPLES[which];
        let mut value: serde_json::Value = serde_json::from_str(text).unwrap();
        let mut places = Vec::new();
        collect(&value, String::new(), &mut places);
        *value.pointer_mut(at.get(&places).as_str()).unwrap() = with;
        match import_haptic(&value.to_string(), file) {
            Ok(score) => playable(Kind::Score(score)),
            Err(error) => prop_assert!(error.to_string().contains("expected"), "{}", error),
        }
    }
}

/// Pointers to everything in a value.
fn collect(value: &serde_json::Value, at: String, places: &mut Vec<String>) {
    match value {
        serde_json::Value::Object(map) => {
            map.iter().for_each(|(k, v)| collect(v, format!("{at}/{k}"), places))
        }
        serde_json::Value::Array(list) => {
            list.iter().enumerate().for_each(|(i, v)| collect(v, format!("{at}/{i}"), places));
        }
        _ => {}
    }
    places.push(at);
}
