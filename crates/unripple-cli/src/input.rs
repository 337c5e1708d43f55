//! Surfaces and drives as named on the command line.

use crate::error::CliError;
use unripple::core::Surface;
use unripple_store::{StoreError, load_surface};

impl From<StoreError> for CliError {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::Surface(faults) => Self::Faults(Box::new(faults)),
            error if error.is_bad_input() => Self::input(error),
            error => Self::work(error),
        }
    }
}

/// A built-in surface or a surface file.
pub fn surface(name: &str) -> Result<Surface, CliError> {
    Ok(load_surface(name)?)
}
