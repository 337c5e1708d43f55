//! What is removed when the interpreter ends: outputs that tasks which were given up have not finished.

use crate::progress::settled;
use pyo3::prelude::*;
use std::sync::OnceLock;
use std::time::Duration;

/// How long the end of the interpreter waits for tasks that were given up: a task looks for that between its longest calls, most of which
/// take less, and people take a program for stuck that takes longer to end.
const PATIENCE: Duration = Duration::from_secs(1);

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
        py.detach(|| {
            // A task that ends removes what it has begun; one that is cut off while it makes a folder would leave that.
            settled(PATIENCE);
            // The lock is given back: what is called after this may still write files.
            drop(unripple_store::abandon_all());
        });
    }
}
