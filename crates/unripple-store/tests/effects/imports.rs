//! Effects imported from other formats.

use unripple_effects::{Event, Score, Sound};
use unripple_store::{StoreError, import_haptic};

pub const EXAMPLES: [(&str, &str); 3] = [("thud.haptic", HAPTIC), ("thud.ahap", AHAP), ("thud.hjif", HJIF)];

const HAPTIC: &str = r#"{
  "version": { "major": 1, "minor": 0, "patch": 0 },
  "metadata": { "author": "nobody", "tags": ["thud"] },
  "signals": { "continuous": { "envelopes": {
    "amplitude": [
      { "time": 0.0, "amplitude": 0.0 },
      { "time": 0.2, "amplitude": 0.8, "emphasis": { "amplitude": 0.9, "frequency": 0.4 } },
      { "time": 0.6, "amplitude": 0.0 }
    ],
    "frequency": [ { "time": 0.0, "frequency": 0.0 }, { "time": 0.6, "frequency": 1.0 } ]
  } } }
}"#;

const AHAP: &str = r#"{
  "Version": 1.0,
  "Metadata": { "Project": "thud" },
  "Pattern": [
    { "Event": { "Time": 0.25, "EventType": "HapticTransient", "EventParameters": [
        { "ParameterID": "HapticIntensity", "ParameterValue": 0.8 },
        { "ParameterID": "HapticSharpness", "ParameterValue": 1.0 } ] } },
    { "Event": { "Time": 0.5, "EventType": "HapticContinuous", "EventDuration": 1.0, "EventParameters": [
        { "ParameterID": "HapticIntensity", "ParameterValue": 0.6 },
        { "ParameterID": "HapticSharpness", "ParameterValue": 0.5 } ] } },
    { "Event": { "Time": 0.0, "EventType": "AudioCustom", "EventWaveformPath": "thud.caf" } },
    { "ParameterCurve": { "ParameterID": "HapticIntensityControl", "Time": 0.0, "ParameterCurveControlPoints": [
        { "Time": 0.0, "ParameterValue": 0.0 }, { "Time": 1.0, "ParameterValue": 1.0 } ] } },
    { "ParameterCurve": { "ParameterID": "HapticSharpnessControl", "Time": 1.0, "ParameterCurveControlPoints": [
        { "Time": 0.0, "ParameterValue": 0.5 } ] } }
  ]
}"#;

const HJIF: &str = r#"{
  "version": "2023", "profile": "Main", "level": 1, "date": "2024-01-01", "description": "thud", "timescale": 1000,
  "avatars": [], "syncs": [],
  "perceptions": [ {
    "id": 0, "avatar_id": 0, "description": "", "perception_modality": "Vibrotactile",
    "effect_library": [ { "id": 7, "effect_type": "Basis", "keyframes": [
      { "relative_position": 0, "amplitude_modulation": 0.3, "frequency_modulation": 90 } ] } ],
    "channels": [ { "id": 0, "description": "", "gain": 2.0, "mixing_coefficient": 1, "body_part_mask": 0, "bands": [
      { "band_type": "Transient", "lower_frequency_limit": 65, "upper_frequency_limit": 300, "effects": [
        { "effect_type": "Basis", "position": 100, "keyframes": [
          { "relative_position": 0, "amplitude_modulation": 1.0, "frequency_modulation": 90 },
          { "relative_position": 50, "amplitude_modulation": -0.5 } ] },
        { "effect_type": "Reference", "id": 7, "position": 400 } ] },
      { "band_type": "VectorialWave", "lower_frequency_limit": 60, "upper_frequency_limit": 200, "effects": [
        { "effect_type": "Basis", "position": 200, "phase": 0, "base_signal": "Sine", "keyframes": [
          { "relative_position": 0, "amplitude_modulation": 0.2, "frequency_modulation": 100 },
          { "relative_position": 300, "amplitude_modulation": 0.8 },
          { "relative_position": 500, "frequency_modulation": 400 } ] } ] }
    ] } ]
  } ]
}"#;

fn read(i: usize) -> Score {
    import_haptic(EXAMPLES[i].1, EXAMPLES[i].0).unwrap()
}

/// Times and gains of pulses.
fn pulses(score: &Score) -> Vec<(f64, f64)> {
    let is_pulse = |event: &&Event| event.sound == Sound::Pulse;
    score.events.iter().filter(is_pulse).map(|event| (event.at, event.gain)).collect()
}

/// The start, and amplitude and frequency at some times after it, of the only waveform.
fn wave(score: &Score, times: &[f64]) -> (f64, f64, Vec<(f64, f64)>) {
    let waves = score.events.iter().filter_map(|event| match &event.sound {
        Sound::Wave(envelope) => Some((event.at, envelope)),
        Sound::Pulse => None,
    });
    let [(at, envelope)] = waves.collect::<Vec<_>>()[..] else { panic!("{score:?}") };
    let values = times.iter().map(|t| (envelope.amplitude().at(*t), envelope.frequency().at(*t)));
    (at, envelope.duration(), values.collect())
}

fn near(found: &[(f64, f64)], expected: &[(f64, f64)]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    let close = |(a, b): (&(f64, f64), &(f64, f64))| (a.0 - b.0).abs() < 1e-9 && (a.1 - b.1).abs() < 1e-9;
    assert!(found.iter().zip(expected).all(close), "{found:?} {expected:?}");
}

#[test]
fn haptic_envelope_and_emphasis() {
    let score = read(0);
    near(&pulses(&score), &[(0.2, 0.9)]);
    let (at, duration, values) = wave(&score, &[0.1, 0.4]);
    assert_eq!((at, duration), (0.0, 0.6));
    near(&values, &[(0.4, 65.0 + 235.0 / 6.0), (0.4, 65.0 + 235.0 * 4.0 / 6.0)]);
}

#[test]
fn ahap_events_and_curves() {
    let score = read(1);
    // Intensity rises from 0 to 1 in the first second.
    near(&pulses(&score), &[(0.25, 0.2)]);
    let (at, duration, values) = wave(&score, &[0.0, 0.25, 0.49, 0.5, 0.9]);
    assert_eq!((at, duration), (0.5, 1.0));
    // From half to full intensity until a second after the start; sharpness goes up by a step there.
    let middle = 65.0 + 0.5 * 235.0;
    near(&values, &[(0.3, middle), (0.45, middle), (0.594, middle), (0.6, 300.0), (0.6, 300.0)]);
}

#[test]
fn hjif_bands_and_references() {
    let score = read(2);
    // The channel's gain makes the strongest 2; all is scaled so that it is 1.
    near(&pulses(&score), &[(0.1, 1.0), (0.15, 0.5), (0.4, 0.3)]);
    let (at, duration, values) = wave(&score, &[0.0, 0.15, 0.4, 0.25]);
    assert_eq!((at, duration), (0.2, 0.5));
    // 400 Hz is beyond the band, which ends at 200 Hz.
    near(&values, &[(0.2, 100.0), (0.5, 130.0), (0.8, 180.0), (0.7, 150.0)]);
}

/// The message about an example with a piece replaced.
fn refused(i: usize, from: &str, to: &str) -> String {
    let (file, text) = EXAMPLES[i];
    assert!(text.contains(from), "{from}");
    match import_haptic(&text.replacen(from, to, 1), file) {
        Err(error @ StoreError::Content { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn faults_say_where_and_what() {
    let says = [
        (
            0,
            "\"major\": 1",
            "\"major\": 2",
            "thud.haptic: version.major: expected a number from 1 to 1, found 2",
        ),
        (
            0,
            "\"amplitude\": 0.8",
            "\"amplitude\": 8",
            "thud.haptic: signals.continuous.envelopes.amplitude[1].amplitude: expected a number from 0 to 1, found 8",
        ),
        (0, "\"time\": 0.6, \"a", "\"time\": 0.1, \"a", "`time` no earlier than 0.2 before it, found 0.1"),
        (0, "\"signals\"", "\"signal\"", "expected `signals`, an object, found no such key"),
        (1, "HapticTransient", "HapticTransent", "(nearest: HapticTransient), found \"HapticTransent\""),
        (
            1,
            "\"EventDuration\": 1.0",
            "\"EventDuration\": 1e9",
            "Pattern[1].Event.EventDuration: expected a number",
        ),
        (1, "{ \"ParameterCurve\"", "{ \"Parameter\"", "expected a ParameterCurve in place of a Parameter"),
        (2, "VectorialWave", "WaveletWave", "bands[1].band_type: expected one of VectorialWave, Transient"),
        (2, "VectorialWave", "Curve", "found \"Curve\""),
        (
            2,
            "\"id\": 7, \"position\"",
            "\"id\": 8, \"position\"",
            "an effect whose id, 8, is in effect_library",
        ),
        (2, "\"Reference\"", "\"Composite\"", "expected one of Basis, Reference, found \"Composite\""),
        (2, "\"Sine\"", "\"Square\"", "base_signal: expected one of Sine, found \"Square\""),
        (2, "Vibrotactile", "Temperature", "found \"Temperature\""),
    ];
    for (i, from, to, message) in says {
        let found = refused(i, from, to);
        assert!(found.contains(message), "{found}\n{message}");
    }
    let other = import_haptic("{}", "thud.wav").unwrap_err();
    assert!(other.to_string().contains("expected a .haptic, .ahap or .hjif file"));
    assert!(import_haptic("{", "thud.ahap").is_err_and(|e| e.to_string().contains("expected JSON")));
}

#[test]
fn sizes_are_bounded() {
    let event = r#"{"Event": {"Time": 0, "EventType": "HapticTransient"}}"#;
    let many = |count: usize| format!(r#"{{"Pattern": [{}]}}"#, vec![event; count].join(","));
    assert_eq!(import_haptic(&many(4096), "m.ahap").unwrap().events.len(), 4096);
    assert!(import_haptic(&many(4097), "m.ahap").unwrap_err().to_string().contains("at most 4096 events"));
    let long = r#"{"Event": {"Time": 0, "EventType": "HapticContinuous", "EventDuration": 70}}"#;
    let long = format!(r#"{{"Pattern": [{long}, {long}]}}"#);
    assert!(
        import_haptic(&long, "l.ahap")
            .unwrap_err()
            .to_string()
            .contains("at most 120 s together, found 140.0 s")
    );
    assert!(import_haptic(&" ".repeat(2 << 20), "l.ahap").unwrap_err().to_string().contains("bytes"));
    assert!(
        import_haptic(r#"{"Pattern": []}"#, "n.ahap").unwrap_err().to_string().contains("something to feel")
    );
    // An effect of many keyframes, referred to many times.
    let frame = r#"{"relative_position": 9, "amplitude_modulation": 0.5}"#;
    let basis =
        format!(r#"{{"id": 1, "effect_type": "Basis", "keyframes": [{}]}}"#, vec![frame; 5000].join(","));
    let uses = vec![r#"{"id": 1, "effect_type": "Reference"}"#; 5000].join(",");
    let band = format!(r#"{{"band_type": "VectorialWave", "effects": [{uses}]}}"#);
    let perception = format!(r#"{{"effect_library": [{basis}], "channels": [{{"bands": [{band}]}}]}}"#);
    let error = import_haptic(&format!(r#"{{"perceptions": [{perception}]}}"#), "r.hjif").unwrap_err();
    assert!(error.to_string().contains("at most 65536 keyframes"), "{error}");
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(import_haptic(&deep, "d.hjif").is_err());
}
