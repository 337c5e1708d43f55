//! Any text is a recording that can be played and written again, or is refused with the line.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unripple_core::{Outline, Shape};
use unripple_touch::{Heard, Playback, Recorder, Recording, Source, TouchError};

fuzz_target!(|text: &str| {
    let recording = match Recording::read(text) {
        Ok(recording) => recording,
        Err(TouchError::Line { line, .. }) => {
            assert!(line >= 1 && line <= text.lines().count().max(1));
            return;
        }
        Err(other) => panic!("{other}"),
    };
    let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.1 });
    let (count, end) = (recording.len(), recording.duration());
    let Ok(mut playback) = Playback::new(recording, &sheet) else {
        return;
    };
    let mut recorder = Recorder::new(Vec::new(), 0.0).expect("memory takes what is written");
    let mut played = 0;
    let mut now = 0.0;
    while !playback.done() {
        let mut heard = Heard::default();
        playback.poll(now, &mut heard);
        now = end;
        played += heard.touches.len() + heard.wishes.len();
        heard.touches.iter().for_each(|touch| assert!(sheet.contains(touch.at)));
        recorder.record(now, &heard).expect("memory takes what is written");
    }
    assert!(played <= 2 * count + 64);
    let written = recorder.finish().expect("memory takes what is written");
    let again = Recording::read(std::str::from_utf8(&written).expect("JSON is UTF-8"));
    again.expect("what is written can be read");
});
