//! Any text is a drawing with finite points, or a message.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unripple_store::Drawing;

fuzz_target!(|text: &str| {
    if let Ok(drawing) = Drawing::parse(text, "fuzz.svg", 1e-5) {
        let mut points = drawing.shapes.iter().flat_map(|s| &s.polylines).flat_map(|p| &p.points);
        assert!(points.all(|p| p.is_finite()));
        let _ = drawing.outline("fuzz.svg");
    }
});
