//! Tests of the search for places.

mod bench;

mod contrast;
mod exhaustive;
mod mounting;
mod picking;
mod refine;
mod sampled;
mod search;
