//! Who asks for designs: the optimisers of the Python package, as a process.

use crate::TaskError;
use std::env;
use std::path::Path;
use std::process::{Command, Stdio};

/// What asks for the designs of a generation: it reads `asked/G.json` in the folder of a search, and writes `asked/G.toml`, the plan of a
/// sweep over these designs.
pub type Asker<'a> = dyn Fn(&Path, usize) -> Result<(), TaskError> + 'a;

/// The variable that names the Python whose package asks.
const PYTHON: &str = "UNRIPPLE_PYTHON";

/// Asks for the designs of a generation by the optimisers of the Python package: `python3 -m unripple ask FOLDER G`, or the Python that the
/// variable `UNRIPPLE_PYTHON` names.
///
/// # Errors
/// [`TaskError::Work`] if there is no such Python, package or optimiser, or it ends with an error of its own.
pub fn by_python(folder: &Path, generation: usize) -> Result<(), TaskError> {
    let python = env::var_os(PYTHON).filter(|name| !name.is_empty()).unwrap_or_else(|| "python3".into());
    let mut command = Command::new(&python);
    command.args(["-m", "unripple", "ask"]).arg(folder).arg(generation.to_string());
    // A folder called `unripple` where somebody works is not the package.
    command.env("PYTHONSAFEPATH", "1").stdin(Stdio::null()).stdout(Stdio::null());
    let found = match command.output() {
        Err(error) => error.to_string(),
        Ok(output) if output.status.success() => return Ok(()),
        Ok(output) => said(&String::from_utf8_lossy(&output.stderr), &output.status.to_string()),
    };
    let python = python.to_string_lossy();
    Err(TaskError::Work(format!(
        "generation {generation} has to be asked for by the Python package: expected `{python} -m unripple` with its optimisers, found: {found}. \
         `pip install 'unripple[optimise]'` brings them, {PYTHON} names another Python, and with `no_ask` only designs that have been asked \
         for are computed"
    )))
}

/// The last line that a process said, or else how it ended.
fn said(errors: &str, status: &str) -> String {
    let last = errors.lines().map(str::trim).rfind(|line| !line.is_empty());
    last.map_or_else(|| status.to_owned(), |line| line.trim_start_matches("error: ").to_owned())
}

#[cfg(test)]
mod tests {
    use super::said;

    #[test]
    fn the_last_line_says_why() {
        assert_eq!(said("Traceback\n\nerror: no cmaes\n\n", "exit status: 1"), "no cmaes");
        assert_eq!(said(" \n", "exit status: 1"), "exit status: 1");
    }
}
