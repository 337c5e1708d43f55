//! The paper that all of this follows, done again: Hudin, Lozada, Wiertlewski and Hayward, EuroHaptics 2012.
//!
//! [`reproduce`] makes the paper's table and figures beside ours, as one page; [`study`] simulates contrast over many placements and
//! targets, and compares it with the closed forms.

pub mod reproduce;
pub mod study;
