//! What `check` and `modes` say of supported polygons of many sides.

use std::f64::consts::TAU;
use unripple_tasks::{Silent, SurfaceAsk, check, modes};

/// A surface file of a plate on a regular polygon.
fn polygon(sides: u32, edge: &str) -> SurfaceAsk {
    let corner = |i: u32| {
        let angle = TAU * f64::from(i) / f64::from(sides);
        [100.0 + 100.0 * angle.cos(), 100.0 + 100.0 * angle.sin()]
    };
    let corners: Vec<[f64; 2]> = (0..sides).map(corner).collect();
    let least = |axis: usize| corners.iter().map(|c| c[axis]).fold(f64::INFINITY, f64::min);
    let listed: Vec<String> =
        corners.iter().map(|c| format!("[{:.6}, {:.6}]", c[0] - least(0), c[1] - least(1))).collect();
    let toml = format!(
        "format = 1\n[outline]\npolygon_mm = [{}]\nedge = \"{edge}\"\n[sheet]\nmaterial = \"glass\"\nthickness_mm = 1\n\
         decay_time_ms = 20\n[drive]\nband_hz = [0, 1500]\n[[actuator]]\nat_mm = [80, 60]\n",
        listed.join(", ")
    );
    SurfaceAsk::Text { toml, name: None }
}

#[test]
fn a_supported_polygon_of_many_sides_is_remarked_on() {
    for (sides, edge, remarks) in [(24, "supported", 1), (24, "clamped", 0), (6, "supported", 0)] {
        let surface = polygon(sides, edge);
        let checked = check::run(&check::Ask { surface: surface.clone() }, &mut Silent).unwrap();
        assert!(checked.ok, "{sides} {edge}: {:?}", checked.faults);
        let found =
            modes::run(&modes::Ask { surface, accuracy: Some(1e-3), ..modes::Ask::default() }, &mut Silent)
                .unwrap();
        for notes in [&checked.notes, &found.notes] {
            assert_eq!(notes.len(), remarks, "{sides} {edge}: {notes:?}");
            assert!(
                notes.iter().all(|note| note.text.contains("24 corners") && note.text.contains("path_mm"))
            );
        }
    }
}
