//! What fits in memory is solved, what does not is refused before anything is solved; costs grow with what is asked.

use crate::modes_common::film;
use unripple_core::{Edge, Edges, Memory, Outline, Point, Shape, Surface};
use unripple_plates::{Accuracy, Modes, PhysicsError};

/// A film that needs a mesh.
fn stadium() -> Surface {
    let outline = Outline::new(Shape::Stadium { straight: 0.08, radius: 0.05 });
    Surface { outline, ..film(Edges::All(Edge::Clamped)) }
}

fn refused(surface: &Surface, top: f64) -> [f64; 3] {
    let solved = Modes::solve(surface, top, 1e-6).map(|modes| modes.frequencies_hz().len());
    let Err(PhysicsError::TooLarge { needed_gib, limit_gib, nearest_hz, .. }) = solved else {
        panic!("{solved:?}")
    };
    // What is known before says the same.
    assert_eq!(Modes::cost(surface, top, 1e-6).map(|cost| cost.bytes), solved.map(|_| 0.0));
    [needed_gib, limit_gib, nearest_hz]
}

#[test]
fn less_memory_refuses_more() {
    // A plate, whose wavenumber is no multiple of the frequency.
    let mut plate = stadium();
    plate.sheet.tension = 0.0;
    // A polygon that is solved as a membrane.
    let mut hexagon = plate.clone();
    let corner = |i: u32| {
        let angle = f64::from(i) * std::f64::consts::FRAC_PI_3;
        Point::new(0.05 + 0.05 * angle.cos(), 0.0433 + 0.05 * angle.sin())
    };
    hexagon.outline = Outline::new(Shape::Polygon((0..6).map(corner).collect()));
    for (surface, top) in
        [(film(Edges::All(Edge::Clamped)), 3000.0), (stadium(), 3000.0), (plate, 2000.0), (hexagon, 2000.0)]
    {
        let needed = Modes::cost(&surface, top, 1e-6).unwrap().bytes;
        Memory::of(1.01 * needed).during(|| assert!(Modes::cost(&surface, top, 1e-6).is_ok()));
        Memory::of(0.3 * needed).during(|| {
            let [needed_gib, limit_gib, nearest_hz] = refused(&surface, top);
            let gib = (1u64 << 30) as f64;
            assert!((needed_gib * gib / needed - 1.0).abs() < 1e-9 && limit_gib < needed_gib);
            // What is said to fit does.
            assert!(nearest_hz > 300.0 && nearest_hz < top, "{nearest_hz}");
            assert!(Modes::cost(&surface, 0.95 * nearest_hz, 1e-6).is_ok());
        });
    }
}

#[test]
fn what_is_solved_does_not_depend_on_the_memory() {
    // Where a coarser accuracy is accepted, less memory than usual is no reason for one.
    for surface in [film(Edges::All(Edge::Clamped)), stadium()] {
        let top = 1500.0;
        let accuracy = Accuracy::or_best(1e-6);
        let needed = Modes::cost(&surface, top, accuracy).unwrap().bytes;
        let solve = || Modes::solve(&surface, top, accuracy);
        assert!(matches!(Memory::of(0.6 * needed).during(solve), Err(PhysicsError::TooLarge { .. })));
        let [usual, more] = [Memory::default(), Memory::of(64e9)].map(|memory| memory.during(solve).unwrap());
        assert_eq!(usual.frequencies_hz(), more.frequencies_hz());
    }
}

#[test]
fn costs_grow_with_the_band_and_the_accuracy() {
    for surface in [film(Edges::All(Edge::Clamped)), stadium()] {
        let cost = |top: f64, accuracy: f64| Modes::cost(&surface, top, accuracy).unwrap();
        let [low, high, fine] = [cost(1000.0, 1e-4), cost(4000.0, 1e-4), cost(4000.0, 1e-7)];
        assert!(high.seconds > 4.0 * low.seconds && high.bytes > 2.0 * low.bytes, "{low:?} {high:?}");
        assert!(fine.seconds > high.seconds && fine.bytes > high.bytes, "{high:?} {fine:?}");
    }
}
