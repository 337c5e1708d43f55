//! Touches by every way in, good and hostile.

mod fingers;
mod hostile;
mod own;
mod properties;
mod pushed;
mod recording;
mod schema;
mod screen;
mod sources;
mod synthetic;
mod tuio;
mod tuio2;
mod websocket;
mod wire;

use unripple_core::{Outline, Phase, Point, Shape, Touch};
use unripple_touch::Options;

/// A sheet of 150 mm by 100 mm.
fn sheet() -> Outline {
    Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 })
}

fn options() -> Options {
    Options::new(&sheet())
}

/// Finger, phase, place in mm to a thousandth.
fn told(touches: &[Touch]) -> Vec<(u64, Phase, f64, f64)> {
    let round = |x: f64| (x * 1e6).round() / 1e3;
    touches.iter().map(|t| (t.finger, t.phase, round(t.at.x), round(t.at.y))).collect()
}

/// Checks what every source promises of its touches: a finger comes first, leaves once, is then never heard of again;
/// times never run back; places are finite.
#[derive(Default)]
struct Promise {
    down: std::collections::BTreeSet<u64>,
    gone: std::collections::BTreeSet<u64>,
    last: f64,
}

impl Promise {
    fn hold(&mut self, touches: &[Touch], surface: &Outline) {
        for touch in touches {
            let finger = touch.finger;
            assert!(!self.gone.contains(&finger), "{touch:?}");
            match touch.phase {
                Phase::Down => assert!(self.down.insert(finger), "{touch:?}"),
                Phase::Move => assert!(self.down.contains(&finger), "{touch:?}"),
                Phase::Up => {
                    assert!(self.down.remove(&finger), "{touch:?}");
                    self.gone.insert(finger);
                }
            }
            assert!(touch.time >= self.last, "{touch:?} after {}", self.last);
            self.last = touch.time;
            assert!(surface.contains(touch.at), "{touch:?}");
            assert!(touch.force.is_none_or(|f| (0.0..=100.0).contains(&f)), "{touch:?}");
        }
    }
}

#[test]
fn the_sheet_is_what_the_tests_take_it_for() {
    assert!(sheet().contains(Point::from_mm(150.0, 100.0)) && !sheet().contains(Point::from_mm(150.1, 50.0)));
}
