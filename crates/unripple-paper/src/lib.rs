//! Reproduces the paper that this project is based on: Hudin, Lozada, Wiertlewski and Hayward, EuroHaptics 2012.
//!
//! [`reproduce`] computes the paper's table and figures and puts them beside the printed ones, on one page; [`study`]
//! simulates contrast over many placements of actuators and targets, and compares it with the closed forms.
//!
//! It applies what other crates define: the model and the closed forms are those of `unripple-physics`, the methods of
//! focusing those of `unripple-focus`, the metrics those of `unripple-field`.
//!
//! # In reading order
//!
//! A [`study::ContrastModel`] holds the data that many foci on one surface share, a [`study::Sampling`] draws
//! random placements, and [`study::against_window()`] is the first of the functions that compare simulated
//! contrast with its closed form. [`reproduce::Ask`], [`reproduce::run()`] and [`reproduce::Report`] are
//! the options, the work and the results of `unripple reproduce`. [`commands`] has that command and those
//! of all tasks by their names.
//!
//! ```
//! use unripple_paper::study::{ContrastModel, CELLS, Sampling, against_window};
//! use unripple_physics::design::papers_surface;
//!
//! // The paper's membrane in half its band.
//! let mut film = papers_surface();
//! film.emission.band = [0.0, 1500.0];
//! let model = ContrastModel::of(&film, CELLS)?;
//! // Contrast of time reversal with 1 and with 8 actuators and a window of 30 ms, averaged over random places.
//! let rows = against_window(&model, &film, &[0.030], &[1, 8], &Sampling::default());
//! assert!((rows[1].simulated / rows[1].predicted - 1.0).abs() < 0.2);
//! assert!(rows[1].simulated > 1.5 * rows[0].simulated);
//! # Ok::<(), unripple_paper::study::StudyError>(())
//! ```

pub mod commands;
pub mod reproduce;
pub mod study;
