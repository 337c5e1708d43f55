//! What is removed when the interpreter ends: outputs that tasks which were given up have not finished.

use pyo3::prelude::*;
use std::sync::OnceLock;

/// Number of the process that imported the module. One that was forked from it knows the same unfinished outputs, which are not its own.
static PROCESS: OnceLock<u32> = OnceLock::new();

/// Has unfinished outputs removed when the interpreter ends, as the command line removes them on Ctrl+C.
pub(crate) fn watch(module: &Bound<'_, PyModule>) -> PyResult<()> {
    PROCESS.get_or_init(std::process::id);
    let leave = wrap_pyfunction!(leave, module)?;
    module.py().import("atexit")?.call_method1("register", (leave,))?;
    Ok(())
}

/// Removes what tasks of this process have begun to write and not finished.
#[pyfunction]
fn leave(py: Python<'_>) {
    if PROCESS.get() == Some(&std::process::id()) {
        // The lock is given back: what is called after this may still write files.
        py.detach(|| drop(unripple_store::abandon_all()));
    }
}
