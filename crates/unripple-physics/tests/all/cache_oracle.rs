//! Truth: modes and responses that come from a cache are those computed, to the last bit.

use std::collections::HashMap;
use std::sync::{Arc, Mutex};
use std::time::Duration;
use unripple_core::*;
use unripple_physics::design::{Windows, papers_surface};
use unripple_physics::{ResponseOptions, responses};

/// Keeps everything, and counts what it gave.
#[derive(Default)]
struct Memory {
    entries: Mutex<HashMap<String, Vec<u8>>>,
    given: Mutex<usize>,
}

impl Cache for Memory {
    fn read(&self, key: &str) -> Option<Vec<u8>> {
        let found = self.entries.lock().unwrap().get(key).cloned();
        *self.given.lock().unwrap() += usize::from(found.is_some());
        found
    }

    fn write(&self, key: &str, bytes: &[u8]) {
        self.entries.lock().unwrap().insert(key.into(), bytes.into());
    }

    fn least(&self) -> Duration {
        Duration::ZERO
    }
}

fn film(shape: Shape) -> Surface {
    let mut film = papers_surface();
    film.outline = Outline::new(shape).with_edges(Edges::All(Edge::Clamped));
    film.emission.band = [0.0, 1000.0];
    film.actuators.truncate(4);
    let (width, height) = film.outline.extent();
    for (actuator, (x, y)) in
        film.actuators.iter_mut().zip([(0.3, 0.35), (0.62, 0.4), (0.45, 0.6), (0.5, 0.25)])
    {
        actuator.at = Point::new(x * width, y * height);
    }
    film
}

/// Magnets instead of ideal forces.
fn loaded(mut surface: Surface) -> Surface {
    for actuator in &mut surface.actuators {
        actuator.contact_radius = 2e-3;
        actuator.kind = ActuatorKind::MovingMagnet {
            force_constant: 0.2,
            resistance: 8.0,
            inductance: 1e-4,
            moving_mass: 1e-4,
            driven_by: CoilDrive::Voltage,
        };
    }
    surface
}

/// Poles, input weights and shapes at some points.
fn figures(surface: &Surface, options: &ResponseOptions) -> (Vec<Pole>, Vec<u64>) {
    let Responses::Modal(modal) = responses(surface, options).unwrap() else { panic!("modes") };
    let points: Vec<Point> =
        [(62.0, 40.0), (31.0, 77.0), (80.0, 60.0)].map(|(x, y)| Point::from_mm(x, y)).into();
    let shapes = modal.shapes.at_all(&points);
    let numbers = shapes.col_iter().chain(modal.input.col_iter());
    let bits = numbers.flat_map(|column| column.iter().map(|x| x.to_bits())).collect();
    (modal.poles, bits)
}

#[test]
fn responses_from_the_cache_are_those_computed_to_the_last_bit() {
    let rectangle = || film(Shape::Rectangle { width: 0.15, height: 0.11 });
    let mut scattering = film(Shape::Stadium { straight: 0.04, radius: 0.06 });
    scattering.sheet.uneven.scatterers =
        vec![Scatterer { at: Point::from_mm(90.0, 50.0), kind: ScattererKind::Mass(2e-4) }];
    let mut free_hole = film(Shape::Rectangle { width: 0.15, height: 0.12 });
    free_hole.sheet.tension = 0.0;
    let hole = Hole::new(&Shape::Rectangle { width: 0.02, height: 0.02 }, Point::from_mm(100.0, 80.0));
    free_hole.outline = free_hole.outline.with_hole(hole);
    let supported =
        vec![(0.0, 0.0), (0.15, 0.0), (0.09, 0.13)].into_iter().map(|(x, y)| Point::new(x, y)).collect();
    let mut triangle = film(Shape::Polygon(supported));
    triangle.outline = triangle.outline.with_edges(Edges::All(Edge::Supported));
    let finger = vec![Contact { at: Point::from_mm(70.0, 50.0), finger: Finger::default() }];
    let free = ResponseOptions { accuracy: 1e-3.into(), ..ResponseOptions::default() };
    let under = ResponseOptions { contacts: finger, ..free.clone() };
    for surface in
        [rectangle(), loaded(rectangle()), scattering.clone(), loaded(scattering), free_hole, triangle]
    {
        let cache = Arc::new(Memory::default());
        for options in [&free, &under] {
            let exact = figures(&surface, options);
            let cached = Cached::by(Some(cache.clone()));
            let before = *cache.given.lock().unwrap();
            let [first, second] = [0, 1].map(|_| cached.during(|| figures(&surface, options)));
            assert!(first == exact && second == exact, "{:?}", surface.outline);
            assert!(*cache.given.lock().unwrap() > before, "nothing came from the cache");
        }
        // Another surface is another question.
        let mut other = surface.clone();
        other.sheet.thickness *= 1.0 + 1e-15;
        let entries = cache.entries.lock().unwrap().len();
        Cached::by(Some(cache.clone())).during(|| figures(&other, &free));
        assert!(cache.entries.lock().unwrap().len() > entries);
    }
}

#[test]
fn windows_from_the_cache_are_those_computed() {
    let surface = loaded(film(Shape::Rectangle { width: 0.15, height: 0.11 }));
    let exact = Windows::of(&surface);
    let cache = Arc::new(Memory::default());
    for _ in 0..2 {
        Cached::by(Some(cache.clone())).during(|| assert_eq!(Windows::of(&surface), exact));
    }
    // Modes, modes with loads, windows.
    assert_eq!(*cache.given.lock().unwrap(), 3);
    let mut fewer = surface.clone();
    fewer.actuators.truncate(2);
    Cached::by(Some(cache.clone())).during(|| assert_ne!(Windows::of(&fewer), exact));
}
