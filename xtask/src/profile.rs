//! The profile of cargo in which tests and the programs beside them are built.

/// The profile in which everything is built that tests, the page and the documentation's commands use.
pub const PROFILE: &str = "checked";
