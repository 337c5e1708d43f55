//! All tasks by their names, with requests and reports as JSON: for other languages, and for runs that are
//! repeated.

mod by_name;
mod done;
mod list;

pub use crate::record::asked;
pub use by_name::{COMMANDS, default_ask, run, unknown};
pub(crate) use done::Names;
pub use done::{Done, again, default_of, perform};
pub(crate) use list::{Command, TASKS, find};
