//! Places on the film, as text in captions and as crosses on maps.

use unripple::core::Point;
use unripple_plot::{Marker, Symbol};

/// A place as text, in whole millimetres.
pub(super) fn place(at: Point) -> String {
    format!("({:.0}, {:.0}) mm", at.x * 1e3, at.y * 1e3)
}

/// A cross with a name, for a map.
pub(super) fn named(at: Point, name: &str) -> Marker {
    Marker { at: [at.x, at.y], symbol: Symbol::Target, name: name.into() }
}
