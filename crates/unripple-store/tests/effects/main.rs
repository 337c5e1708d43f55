//! Files of effects: read, refused, written back, held against their schema, imported.

mod faults;
mod files;
mod guide;
#[path = "../guide_common/mod.rs"]
mod guide_common;
mod imports;
mod property;
mod schema;
