//! Contrast on the true surface of a focus made from known responses.

use unripple_core::{Point, Responses};
use unripple_field::Field;
use unripple_focus::{Focuser, Method, Options, Target};

/// Contrast at the end of the window (s): velocity at a place, relative to the rms velocity outside its focal disc.
pub fn contrast(known: &Responses, plant: &Responses, method: Method, at: Point, window: f64) -> f64 {
    let options = Options { method, window, ..Options::default() };
    let drive = Focuser::new(known, &options).unwrap().focus(&[Target::at(at)]).unwrap().drive.as_emitted();
    let field = Field::new(plant, &drive, 8.0).unwrap();
    let shot = &field.snapshots(&[window]).unwrap()[0];
    let peak = field.traces(&[at], window).unwrap()[0].velocity.last().copied().unwrap();
    let radius = 4.0 / 3.0 * plant.conditions().lambda_min;
    let outside: Vec<f64> = field
        .points()
        .iter()
        .zip(&shot.velocity)
        .filter(|(p, _)| p.distance(at) > radius)
        .map(|(_, v)| f64::from(*v).powi(2))
        .collect();
    peak / (outside.iter().sum::<f64>() / outside.len() as f64).sqrt()
}
