//! The film that most tests of fields use.

use crate::common::Film;
use unripple_core::Point;

/// A small film: quick, and with room outside the focal disc.
pub fn small() -> Film {
    Film {
        width: 0.10,
        height: 0.08,
        top_hz: 1500.0,
        rate: 12e3,
        decay_time: 20e-3,
        ports: vec![Point::new(0.013, 0.021), Point::new(0.081, 0.034), Point::new(0.046, 0.071)],
        ..Film::paper()
    }
}
