//! Who asks for designs: the optimisers of the Python package, as a process that lives as long as the search.

use super::question::Question;
use crate::TaskError;
use serde_json::Value;
use std::cell::RefCell;
use std::env;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::thread::{Builder, JoinHandle};

/// What asks for the designs of a generation: it writes `asked/G.toml` in the folder of a search, the plan of a sweep over these designs,
/// unless it has nothing more to ask for. A function of that folder and the number G finds the question in `asked/G.json`.
pub trait Asker {
    /// Asks for the designs of a generation.
    ///
    /// # Errors
    /// Whatever keeps it from asking.
    fn ask(&self, question: &Question<'_>) -> Result<Answer, TaskError>;
}

/// What came of a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Designs were asked for.
    Asked,
    /// There is nothing more to ask for, and why.
    Over(String),
}

impl<F: Fn(&Path, usize) -> Result<(), TaskError>> Asker for F {
    fn ask(&self, question: &Question<'_>) -> Result<Answer, TaskError> {
        question.put()?;
        self(question.folder(), question.generation())?;
        Ok(Answer::Asked)
    }
}

/// The variable that names the Python whose package asks.
const PYTHON: &str = "UNRIPPLE_PYTHON";

/// The optimisers of the Python package: `python3 -m unripple ask FOLDER`, or the Python that the variable `UNRIPPLE_PYTHON` names. The
/// process begins with the first question, is told each generation once, and ends when this is dropped.
#[derive(Default)]
pub struct ByPython {
    talk: RefCell<Option<Talk>>,
}

impl Asker for ByPython {
    /// # Errors
    /// [`TaskError::Work`] if there is no such Python, package or optimiser, or it ends with an error of its own; the question is then in
    /// the folder, for whoever asks in another way.
    fn ask(&self, question: &Question<'_>) -> Result<Answer, TaskError> {
        let mut talk = self.talk.borrow_mut();
        let line = question.json(talk.as_ref().map_or(0, |talk| talk.since))?;
        let begun = match talk.take() {
            Some(talk) => Ok(talk),
            None => Talk::begin(question.folder()),
        };
        let found = match begun.and_then(|begun| begun.exchanged(&line)) {
            Ok((answer, mut went)) => {
                went.since = question.generation();
                *talk = Some(went);
                return Ok(answer);
            }
            Err(found) => found,
        };
        question.put()?;
        let (python, generation) = (python().to_string_lossy().into_owned(), question.generation());
        Err(TaskError::Work(format!(
            "generation {generation} has to be asked for by the Python package: expected `{python} -m unripple` with its optimisers, found: {found}. \
             `pip install 'unripple[optimise]'` brings them, {PYTHON} names another Python, and with `no_ask` only designs that have been asked \
             for are computed"
        )))
    }
}

/// The Python whose package asks.
fn python() -> std::ffi::OsString {
    env::var_os(PYTHON).filter(|name| !name.is_empty()).unwrap_or_else(|| "python3".into())
}

/// A process that is asked questions, a line of JSON each, and answers each with a line of JSON.
struct Talk {
    child: Child,
    answers: BufReader<ChildStdout>,
    /// What it says besides, read all along so that it is never kept waiting.
    errors: Option<JoinHandle<String>>,
    /// Number of generations that it has been told.
    since: usize,
}

impl Talk {
    /// Starts the process for the search in a folder; otherwise says why it cannot.
    fn begin(folder: &Path) -> Result<Self, String> {
        let mut command = Command::new(python());
        command.args(["-m", "unripple", "ask"]).arg(folder);
        // A folder called `unripple` where somebody works is not the package.
        command.env("PYTHONSAFEPATH", "1");
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().map_err(|error| error.to_string())?;
        let answers = child.stdout.take().map(BufReader::new);
        let errors = child.stderr.take().and_then(|mut from| {
            let read = move || {
                let mut said = Vec::new();
                // What was read before it broke off is what there is to say.
                let _ = from.read_to_end(&mut said);
                String::from_utf8_lossy(&said).into_owned()
            };
            Builder::new().name("asked".into()).spawn(read).ok()
        });
        let answers = answers.ok_or("a process without output")?;
        Ok(Self { child, answers, errors, since: 0 })
    }

    /// Asks a question; otherwise says why there is no answer, and the process is over.
    fn exchanged(mut self, line: &str) -> Result<(Answer, Self), String> {
        if let Some(to) = self.child.stdin.as_mut() {
            // A process that has ended says why.
            let _ = writeln!(to, "{line}").and_then(|()| to.flush());
        }
        let mut answer = String::new();
        let read = self.answers.read_line(&mut answer).unwrap_or_default();
        if read == 0 {
            return Err(self.ended());
        }
        let answer: Value =
            serde_json::from_str(&answer).map_err(|_| format!("the answer `{}`", answer.trim()))?;
        match (answer["over"].as_str(), answer["error"].as_str()) {
            (_, Some(error)) => Err(error.to_owned()),
            (Some(why), None) => Ok((Answer::Over(why.to_owned()), self)),
            (None, None) => Ok((Answer::Asked, self)),
        }
    }

    /// Why the process ended.
    fn ended(&mut self) -> String {
        let status = self.child.wait().map_or_else(|error| error.to_string(), |status| status.to_string());
        let errors = self.errors.take().and_then(|errors| errors.join().ok()).unwrap_or_default();
        said(&errors, &status)
    }
}

impl Drop for Talk {
    fn drop(&mut self) {
        // Its input ends first, and so does it.
        let _ = self.child.wait();
    }
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
