//! The surface, places and targets that tests share.

use unripple_core::{Actuator, Edge, Edges, Point, Surface};
use unripple_physics::design::papers_surface;
use unripple_placement::{Aim, Plant, Rules, spread};

/// Window of all tests, in seconds.
pub const WINDOW: f64 = 30e-3;

/// The paper's film with supported edges, without actuators, up to `top` Hz, and an ideal force.
pub fn film(top: f64) -> (Surface, Actuator) {
    let mut film = papers_surface();
    film.emission.band = [0.0, top];
    film.outline = film.outline.with_edges(Edges::All(Edge::Supported));
    let force = film.actuators[0].clone();
    film.actuators.clear();
    (film, force)
}

pub fn plant(top: f64) -> Plant {
    let (film, force) = film(top);
    Plant::new(film, &force).unwrap()
}

/// Places 6 to 12 mm from the rim.
pub fn places(pitch: f64) -> Vec<Point> {
    let rules = Rules { from_rim: [6e-3, 12e-3], ..Rules::default() };
    rules.grid(&film(1e3).0.outline, pitch).unwrap()
}

/// Targets at least 15 mm from the rim.
pub fn aims(skip: usize, count: usize) -> Vec<Aim> {
    let rules = Rules { from_rim: [15e-3, f64::INFINITY], ..Rules::default() };
    spread(&film(1e3).0.outline, &rules, skip, count).into_iter().map(|at| Aim { at, weight: 1.0 }).collect()
}
