//! Any text is a drawing with finite points and curves without gaps, or a message.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unripple_store::{Drawing, read_curves};

fuzz_target!(|text: &str| {
    if let Ok(drawing) = Drawing::parse(text, "fuzz.svg", 1e-5) {
        let mut points = drawing.shapes.iter().flat_map(|s| &s.polylines).flat_map(|p| &p.points);
        assert!(points.all(|p| p.is_finite()));
    }
    if let Ok(curves) = read_curves(text, "fuzz.svg") {
        for curve in curves {
            assert_eq!(curve.counts.iter().sum::<usize>(), curve.sides.len());
            assert!(curve.sides.windows(2).all(|pair| pair[0].at(1.0).distance(pair[1].at(0.0)) < 1e-12));
            let ends = curve.sides.first().zip(curve.sides.last());
            assert!(!curve.closed || ends.is_some_and(|(a, b)| b.at(1.0).distance(a.at(0.0)) < 1e-12));
        }
    }
});
