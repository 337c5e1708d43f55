//! Sessions kept in files.

use crate::{Promise, sheet};
use unripple_core::{Outline, Shape};
use unripple_touch::{Heard, Playback, Recorder, Recording, Source, Synthetic, SyntheticOptions, Wish};

const HEAD: &str = r#"{"format":"unripple-touches","version":1}"#;

/// Five seconds of three fingers, and a wish now and then.
fn session() -> (Heard, String) {
    let options = SyntheticOptions { fingers: 3, seed: 7, ..SyntheticOptions::default() };
    let mut fingers = Synthetic::new(&sheet(), options).unwrap();
    let mut recorder = Recorder::new(Vec::new(), 100.0).unwrap();
    let mut all = Heard::default();
    for i in 0..1000 {
        let now = 100.0 + 0.005 * f64::from(i);
        let mut heard = Heard::default();
        fingers.poll(now, &mut heard);
        if i % 100 == 0 {
            heard.wishes.push(if i % 200 == 0 { Wish::Effect("click".into()) } else { Wish::Gain(-3.0) });
        }
        recorder.record(now, &heard).unwrap();
        all.touches.extend(heard.touches);
        all.wishes.extend(heard.wishes);
    }
    (all, String::from_utf8(recorder.finish().unwrap()).unwrap())
}

fn play(text: &str, step: f64) -> Heard {
    let mut playback = Playback::new(Recording::read(text).unwrap(), &sheet()).unwrap();
    let mut all = Heard::default();
    let mut promise = Promise::default();
    for i in 0.. {
        let mut heard = Heard::default();
        playback.poll(100.0 + step * f64::from(i), &mut heard);
        promise.hold(&heard.touches, &sheet());
        all.touches.extend(heard.touches);
        all.wishes.extend(heard.wishes);
        if playback.done() {
            break;
        }
    }
    all
}

#[test]
fn what_is_played_is_what_was_recorded() {
    let (heard, text) = session();
    let played = play(&text, 0.001);
    assert_eq!(played.wishes, heard.wishes);
    assert!(heard.touches.len() > 500);
    for (a, b) in heard.touches.iter().zip(&played.touches) {
        assert_eq!((a.finger, a.phase, a.force), (b.finger, b.phase, b.force));
        assert!(a.at.distance(b.at) < 1e-15 && (a.time - b.time).abs() < 1e-12, "{a:?} {b:?}");
    }
    // Those still down at the end leave.
    let (downs, ups) = played.touches.iter().fold((0, 0), |(d, u), t| match t.phase {
        unripple_core::Phase::Down => (d + 1, u),
        unripple_core::Phase::Up => (d, u + 1),
        unripple_core::Phase::Move => (d, u),
    });
    assert_eq!(downs, ups);
}

#[test]
fn played_twice_it_is_the_same_however_it_is_polled() {
    let (_, text) = session();
    assert_eq!(play(&text, 0.001), play(&text, 0.001));
    assert_eq!(play(&text, 0.001).touches, play(&text, 0.7).touches);
}

#[test]
fn a_bad_line_is_named() {
    let down = r#"{"at_ms":5,"finger":1,"phase":"down","at_mm":[62,90]}"#;
    for (line, expected) in [
        ("", "expected an object"),
        ("{", "EOF"),
        ("[5]", "expected an object"),
        (r#"{"at_ms":6}"#, "expected finger, phase and at_mm, or effect, or gain_db"),
        (r#"{"at_ms":6,"finger":1,"phase":"move"}"#, "expected finger, phase and at_mm"),
        (r#"{"at_ms":6,"finger":1,"phase":"move","at_mm":[1,2],"gain_db":1}"#, "expected finger, phase"),
        (r#"{"at_ms":6,"finger":1,"phase":"hop","at_mm":[1,2]}"#, "unknown variant `hop`"),
        (r#"{"at_ms":6,"finger":1,"phase":"move","at_mm":[1]}"#, "length"),
        (r#"{"at_ms":6,"finger":1,"phase":"move","at_mm":[1,1e999]}"#, "out of range"),
        (r#"{"at_ms":6,"finger":1,"phase":"move","at_mm":[1,1e7]}"#, "at_mm: expected at most"),
        (r#"{"at_ms":6,"finger":1,"phase":"move","at_mm":[1,2],"force_n":-1}"#, "force_n: expected 0 to 100"),
        (r#"{"at_ms":6,"finger":1,"phase":"move","at_mm":[1,2],"colour":1}"#, "unknown field `colour`"),
        (r#"{"at_ms":4,"finger":1,"phase":"move","at_mm":[1,2]}"#, "at_ms: expected at least 5"),
        (r#"{"at_ms":-4,"effect":"click"}"#, "at_ms: expected 0 to"),
        (r#"{"at_ms":6,"finger":1,"phase":"down","at_mm":[1,2]}"#, "expected one that is not down, found 1"),
        (r#"{"at_ms":6,"finger":2,"phase":"move","at_mm":[1,2]}"#, "expected one that is down, found 2"),
        (r#"{"at_ms":6,"finger":2,"phase":"up","at_mm":[1,2]}"#, "expected one that is down, found 2"),
        (r#"{"at_ms":6,"gain_db":99}"#, "gain_db: expected -120 to 40"),
        (&format!(r#"{{"at_ms":6,"effect":"{}"}}"#, "x".repeat(2000)), "at most 1024 bytes"),
    ] {
        let text = format!("{HEAD}\n{down}\n{line}\n");
        let error = Recording::read(&text).unwrap_err().to_string();
        assert!(error.starts_with("line 3: ") && error.contains(expected), "{error} has no {expected}");
    }
    for head in
        ["", "{}", r#"{"format":"other","version":1}"#, r#"{"format":"unripple-touches","version":2}"#]
    {
        assert!(Recording::read(head).unwrap_err().to_string().starts_with("line 1: "), "{head}");
    }
    let crowd: Vec<String> =
        (0..65).map(|i| down.replace(r#""finger":1"#, &format!(r#""finger":{i}"#))).collect();
    let error = Recording::read(&format!("{HEAD}\n{}", crowd.join("\n"))).unwrap_err().to_string();
    assert_eq!(error, "line 66: finger: expected at most 64 at once, found one more");
}

#[test]
fn a_touch_off_the_surface_is_named_with_the_nearest_place() {
    let (_, text) = session();
    let small = Outline::new(Shape::Circle { radius: 0.03 });
    let error = Playback::new(Recording::read(&text).unwrap(), &small).unwrap_err().to_string();
    assert!(error.starts_with("line ") && error.contains("nearest is ("), "{error}");
}

#[test]
fn files_are_read_and_missing_ones_named() {
    let path = std::env::temp_dir().join(format!("unripple-touch-{}.jsonl", std::process::id()));
    let (_, text) = session();
    std::fs::write(&path, &text).unwrap();
    assert_eq!(Recording::open(&path).unwrap(), Recording::read(&text).unwrap());
    std::fs::remove_file(&path).unwrap();
    assert!(Recording::open(&path).unwrap_err().to_string().contains("unripple-touch-"));
}
