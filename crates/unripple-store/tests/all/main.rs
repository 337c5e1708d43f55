//! Tests of unripple-store that share one program: a file a kind of truth. What needs a process of its own is beside it.

mod curves;
mod drawings;
mod guide;
#[path = "../guide_common/mod.rs"]
mod guide_common;
mod library_bands;
#[path = "../library_common/mod.rs"]
mod library_common;
mod library_damage;
mod library_python;
mod library_record;
mod library_roundtrip;
mod plans;
mod property;
#[path = "../../../unripple-core/tests/shared/python.rs"]
mod python;
#[path = "../../../unripple-core/tests/shared/skip.rs"]
mod skip;
mod wavs;
