//! Plane geometry: vectors, bounding boxes, pieces of curves, and the check that boundary curves enclose a valid sheet.

mod check;
mod faults;
mod flattened;
mod meeting;
mod piece;
mod rims;
mod tree;
mod vector;

pub use faults::OutlineFault;
pub use meeting::{Met, within};
pub use piece::{Piece, pieces};
pub use rims::{Rims, tangent};
pub use tree::{Bounds, Node, Tree};
pub use vector::{
    along, angle, between_segments, circumcircle, cross, dot, doubled, from_segment, middle, minus, norm,
    sharpness, turned,
};
