//! Time-reversed focusing of touch on reverberant surfaces.
//!
//! A few actuators at the rim of a stretched film or a plate send waves that reverberate and meet again under a
//! fingertip, and nowhere else. From a surface to a focus:
//!
//! ```
//! use unripple::core::Point;
//! use unripple::field::{Aim, MeasureOptions, measure};
//! use unripple::focus::{Options, Target, focus};
//! use unripple::physics::design::papers_surface;
//! use unripple::physics::{ResponseOptions, responses};
//!
//! // What the surface does: the membrane of Hudin et al. (2012), mode by mode.
//! let responses = responses(&papers_surface(), &ResponseOptions::default())?;
//! // What to send so that waves meet at (62, 90) mm after 30 ms.
//! let place = Point::from_mm(62.0, 90.0);
//! let focused = focus(&responses, &[Target::at(place)], &Options { window: 0.03, ..Options::default() })?;
//! // What the drive does to the surface.
//! let measured = measure(&responses, &focused.drive, &[Aim::at(place, 0.03)], &MeasureOptions::default())?;
//! let contrast = measured.targets[0].contrast.unwrap();
//! assert!((contrast - 25.07).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! From a surface file to a drive on disk, at a level within linear theory, with a report:
//!
//! ```
//! use unripple::act::{Act, Level, chosen_window, model};
//! use unripple::core::Point;
//! use unripple::focus::{Method, Options, Target};
//! use unripple::store::{parse_surface, write_wav};
//!
//! let film = parse_surface(
//!     r#"
//!     format = 1
//!     [outline]
//!     rectangle_mm = [120, 80]
//!     [sheet]
//!     material = "BoPET"
//!     thickness_mm = 0.1
//!     tension_n_per_m = 150
//!     decay_time_ms = 60
//!     [drive]
//!     band_hz = [0, 2000]
//!     [[actuator]]
//!     at_mm = [9, 22]
//!     [[actuator]]
//!     at_mm = [31, 71]
//!     [[actuator]]
//!     at_mm = [112, 35]
//!     "#,
//!     "film.toml",
//! )?;
//! let responses = model(&film, None, &[])?;
//! let targets = [Target::at(Point::from_mm(50.0, 40.0))];
//! let window = chosen_window(&film, &responses).seconds;
//! let options = Options { method: Method::Concentrate, window, limit: film.emission.limit, ..Options::default() };
//! let level = Level::Linear;
//! let acted = Act { surface: &film, responses: &responses, targets: &targets, options: &options, level }.run()?;
//! // Evaluated by other code than the code that computed it.
//! assert!(acted.judged.measured.targets[0].contrast.is_some_and(|contrast| contrast > 10.0));
//! println!("{}", acted.report(&film, &options).text());
//! let file = std::env::temp_dir().join(format!("unripple-drive-{}.wav", std::process::id()));
//! write_wav(&file, &acted.drive)?;
//! # std::fs::remove_file(file)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # In reading order
//!
//! [`core`] holds the types and the conventions (axes, signs, units, samples) that all modules keep to. [`physics`],
//! [`focus`] and [`field`] are the three steps of the first example; [`act`] joins them and [`store`] reads and writes
//! files, as in the second. Read the others as you need them: [`drafting`] and [`contrast_map`] to design a surface,
//! [`calibrate`] to measure one, [`devices`] and [`player`] to play drives, [`mod@touch`] and [`effects`] to answer
//! fingers, [`plot`] for figures; beneath them are [`plates`], [`dsp`] and [`linalg`]. Playing a surface live is in the
//! crate `unripple-live`, whole tasks with files and figures are in `unripple-tasks`.

pub use unripple_calibrate as calibrate;
pub use unripple_core as core;
pub use unripple_devices as devices;
pub use unripple_dsp as dsp;
pub use unripple_effects as effects;
pub use unripple_field as field;
pub use unripple_focus as focus;
pub use unripple_linalg as linalg;
pub use unripple_physics as physics;
pub use unripple_placement as placement;
pub use unripple_plates as plates;
pub use unripple_player as player;
pub use unripple_plot as plot;
pub use unripple_store as store;
pub use unripple_touch as touch;

pub mod act;
mod contact;
pub mod contrast_map;
pub mod drafting;

pub use contact::{Touch, touch};
