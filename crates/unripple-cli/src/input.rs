//! Surfaces and libraries as named on the command line.

use crate::error::CliError;
use crate::progress::Terminal;
use unripple::act::Note;
use unripple::core::Surface;
use unripple_store::{Library, StoreError, load_surface};
use unripple_tasks::{Source, SurfaceAsk, source};

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

/// A surface by name or file, or a library by its folder; what is wrong with that is said on standard error.
pub fn source(name: &str) -> Result<Source, CliError> {
    Ok(source::open(&SurfaceAsk::from(name), &mut Terminal::default())?)
}

/// The same without a word on standard error, for whoever asks again and again.
pub fn quiet_source(name: &str) -> Result<Source, CliError> {
    Ok(source::open_again(&SurfaceAsk::from(name))?)
}

/// Warns of a library on standard error.
pub fn warn(library: &Library) -> Vec<Note> {
    source::warn(library, &mut Terminal::default())
}
