//! Files: surfaces as TOML, drives as WAV, shapes as SVG, and folders of results.
//!
//! Only this crate knows file formats, except for recorded touches, which are read in `unripple-touch`. Files use
//! millimetres, milliseconds and gigapascals, in keys that carry their unit; the types of this crate are in SI units.
//! Whatever is written appears completely or not at all. What the files describe is computed elsewhere.
//!
//! # In reading order
//!
//! - [`load_surface`] reads a built-in surface or a surface file, and reports all faults of a file at once;
//!   [`to_toml`] writes one.
//! - [`write_wav`] and [`read_wav`] write and read drives, one channel per actuator.
//! - [`Drawing`] reads the shapes of an SVG document as polylines, in metres; [`read_curves`] keeps them as curves.
//! - [`Library`] stores responses, measured or modelled, as a Zarr v3 folder that survives being killed, and exports
//!   them as WAV and SOFA.
//! - [`load_plan`] reads the plan of a sweep, [`load_search`] that of a search.
//! - [`read_weights`] reads a table of how much each part of a surface counts.
//! - [`ConfigFile`] is the user's file of options.
//! - [`load_effects`] reads built-in effects, a file of effects, or one for phones; [`effects_to_toml`] writes one.
//! - [`OutputDir`] collects what a run writes and puts it in place in one step, replacing only the output of an
//!   earlier run; [`abandon_all`] removes what is under construction before a program ends early.
//!
//! ```
//! let surface = unripple_store::load_surface("hudin-2012")?;
//! assert_eq!(surface.actuators.len(), 8);
//! # Ok::<(), unripple_store::StoreError>(())
//! ```

mod building;
mod builtin;
mod cache;
mod config;
mod decimal;
mod degrees;
mod document;
mod effects;
mod error;
mod fault;
mod file;
mod kept;
mod library;
mod lines;
mod listing;
mod load;
mod names;
mod output;
mod plans;
mod set;
mod sofa;
mod surface;
mod svg;
mod swap;
mod underway;
mod wav;
mod weights;
mod wide;

pub use building::remove_left;
pub use builtin::{BUILTINS, Builtin};
pub use cache::{DiskCache, Usage};
pub use config::{ConfigFile, Setting, Takes};
pub use effects::{
    BuiltinEffects, EFFECTS_SCHEMA, builtin_effect, builtin_effects, effect_files, effects_to_toml,
    import_haptic, load_effects, parse_effects,
};
pub use error::StoreError;
pub use fault::{Fault, FileFaults};
pub use file::{LARGEST_TEXT, check_new_file, new_file, write_durably, write_file};
pub use kept::{check_kept_wav, write_kept_wav};
pub use library::{BandQuality, Damage, Doubt, Library, LibraryPlan, MAY_DIFFER, PointState, Quality, Take};
pub use listing::MARKER;
pub use load::{load_surface, load_surface_with, read_drawing, surface_files};
pub use names::nearest;
pub use output::{Committed, OutputDir};
pub use plans::{
    Axis, AxisValues, Bound, Designs, MOST_DESIGNS, Objective, PlanFile, PlanTask, SearchFile, Varied, Want,
    load_plan, load_search, parse_plan, parse_search, plan_surface,
};
pub use set::set_keys;
pub use sofa::{SofaAbout, date};
pub use surface::{parse_surface, parse_surface_with, to_toml};
pub use svg::{Curve, Drawing, FillRule, Polyline, SvgShape, read_curves};
pub use underway::{Abandoned, Underway, abandon_all};
pub use wav::{Wav, decode_wav, encode_wav, read_wav, write_wav};
pub use weights::read_weights;
