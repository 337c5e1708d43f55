//! Reproduces the paper that this project is based on: Hudin, Lozada, Wiertlewski and Hayward, EuroHaptics 2012.
//!
//! [`reproduce`] computes the paper's table and figures and puts them beside the printed ones, on one page; [`study`]
//! simulates contrast over many placements of actuators and targets, and compares it with the closed forms.

pub mod reproduce;
pub mod study;
