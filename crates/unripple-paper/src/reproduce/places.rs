//! Places on the film, in captions and as crosses.

use unripple::core::Point;
use unripple_plot::{Marker, Symbol};

/// A place in whole millimetres.
pub(super) fn place(at: Point) -> String {
    format!("({:.0}, {:.0}) mm", at.x * 1e3, at.y * 1e3)
}

/// A named cross.
pub(super) fn named(at: Point, name: &str) -> Marker {
    Marker { at: [at.x, at.y], symbol: Symbol::Target, name: name.into() }
}
