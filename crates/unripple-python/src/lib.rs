//! `_unripple`: the part in Rust of the Python package, below the typed classes of `python/unripple`.
//!
//! Places are in metres and times in seconds throughout; the package converts. Long work is done with the GIL released, on a thread of its
//! own ([`progress`]), and its errors are raised as the classes of `unripple._errors` ([`error`]).

mod arguments;
mod arrays;
mod commands;
mod drive;
mod error;
mod field;
mod focused;
mod leaving;
mod player;
mod progress;
mod responses;
mod search;
mod surface;
mod threads;
mod virtual_surface;

/// What the package `unripple` is built on, in Rust. Private: use `unripple`. Places are in metres, times in seconds, frequencies in hertz.
#[pyo3::pymodule]
mod _unripple {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::commands::{Done, builtin, command_line, default_ask, effects, names, run, version};
    #[pymodule_export]
    use crate::drive::{Drive, read_wav};
    #[pymodule_export]
    use crate::field::Field;
    #[pymodule_export]
    use crate::focused::{Focused, png};
    #[pymodule_export]
    use crate::player::Player;
    #[pymodule_export]
    use crate::responses::Responses;
    #[pymodule_export]
    use crate::search::Search;
    #[pymodule_export]
    use crate::surface::Surface;
    #[pymodule_export]
    use crate::virtual_surface::VirtualSurface;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        unripple_tasks::record::built_from(unripple_cli::COMMIT, unripple_cli::SOURCES);
        crate::leaving::watch(module)
    }
}
