//! What `stroke` found: the report of an act of focusing, shared with `focus`.

pub use unripple::act::Report;
