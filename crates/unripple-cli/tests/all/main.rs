//! Tests of unripple-cli that share one program: a file a kind of truth. What needs a process of its own is beside it.

mod accuracy;
mod any_command;
#[path = "../../../unripple-tasks/tests/any_surface/file.rs"]
mod any_file;
#[path = "../common/bench.rs"]
mod bench;
mod bounds;
mod cache;
mod calibrate;
mod calibrate_bands;
mod calibrate_hammer;
mod calibrate_taps;
mod chosen;
#[path = "../common/mod.rs"]
mod common;
mod compare;
mod config;
mod design_and_modes;
mod doubtful;
#[path = "../common/elsewhere.rs"]
mod elsewhere;
mod export;
mod figures;
mod fit;
mod frequencies;
mod import;
mod import_faults;
mod judged;
mod keys;
mod level;
mod library;
mod main_job;
mod memory;
mod no_figures;
mod optimise;
mod ownership;
mod place;
mod progress;
#[path = "../../../unripple-core/tests/shared/python.rs"]
mod python;
mod recordings;
mod refusal;
mod report_schema;
mod reproduce;
mod rerun;
mod sensors;
mod short_drives;
#[path = "../../../unripple-core/tests/shared/skip.rs"]
mod skip;
mod takes;
mod tape;
mod trusted;
mod until_input_ends;
mod verify;
mod waveforms;
mod window;
#[path = "../../../unripple/tests/window_common/mod.rs"]
#[allow(dead_code)] // Others hold the windows against simulation there.
mod window_common;
mod windows;
