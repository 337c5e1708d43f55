//! Files of effects: read, refused, written back, held against their schema, imported.

mod faults;
mod files;
mod guide;
mod imports;
mod property;
mod schema;
