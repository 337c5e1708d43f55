//! The tasks of Unripple, each with plain options and a report.
//!
//! There is a module for each task. In each, `Ask` is the request: a plain struct of options in SI units, with defaults and serde;
//! `run` does the work, reports to a [`Progress`] how far it is, and asks it whether the task has been cancelled;
//! `Report` holds the results, with serde and as text. The command line, the page and other languages call the same
//! functions, and `--json` prints the report. No task prints or reads arguments, and none computes waves: they join the
//! crates below to what a user asks for, and put results in files.
//!
//! # In reading order
//!
//! [`modes`] is the shortest task, [`focus`] the one that most others resemble. [`SurfaceAsk`] is a surface by its
//! name, its file or its text, and [`source`] opens it, or a library of responses. [`Progress`] connects a running task
//! with its caller, [`Report`] is what all reports have in common, a [`Record`] says how a report was made, and
//! [`folder`] puts results in their place. [`commands`] has all tasks by their names. [`TaskError`] is the error of all tasks.
//! [`text_forms`] reads targets, waveforms and the like from texts, as people type them.
//!
//! ```
//! use unripple_tasks::{Report, Silent, modes};
//!
//! let ask = modes::Ask { surface: "hudin-2012".into(), top_hz: Some(500.0), ..modes::Ask::default() };
//! let report = modes::run(&ask, &mut Silent)?;
//! assert_eq!(report.frequencies_hz.len(), report.count);
//! assert!(report.text().contains("modes up to 500 Hz"));
//! # Ok::<(), unripple_tasks::TaskError>(())
//! ```

mod apart;
mod areas;
pub mod between;
pub mod cache;
pub mod calibrate;
pub mod check;
pub mod commands;
pub mod compare;
pub mod cost;
mod curves;
pub mod design;
pub mod device;
pub mod devices;
pub mod doctor;
pub mod drift;
mod error;
pub mod export;
pub mod field;
pub mod figures;
mod filling;
pub mod fingers;
pub mod fit;
pub mod fit_modes;
pub mod focus;
pub mod folder;
pub mod grid;
pub mod import;
pub mod judge;
pub mod late;
mod lines;
pub mod listen;
pub mod machine;
pub mod materials;
pub mod modes;
mod names;
mod numbers;
pub mod optimise;
pub mod own;
pub mod place;
pub mod play;
mod played;
mod position;
mod progress;
pub mod record;
mod report;
pub mod rerun;
pub mod respond;
pub mod sensors;
mod several;
mod solved;
pub mod source;
pub mod stroke;
mod surface;
pub mod sweep;
pub mod target;
pub mod text_forms;
mod thinned;
pub mod verify;
pub mod waveform;
mod wavelength;
mod window;

pub use apart::{Lane, apart};
pub use device::{DeviceAsk, DeviceKind};
pub use error::TaskError;
pub use lines::Lines;
pub use names::{interpolation, method};
pub use numbers::above_zero;
pub use position::{Place, point};
pub use progress::{Progress, Silent, go_on, observed, part_of};
pub use record::Record;
pub use report::{REPORT_SCHEMA, Report};
pub use solved::Solved;
pub use source::Source;
pub use surface::SurfaceAsk;
