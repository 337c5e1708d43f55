use super::Sheet;
use super::quality::Progress;
use crate::board::Board;
use crate::lock::lock;
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock};
use std::thread::Thread;
use std::time::{Duration, Instant};

/// Lines that are shown, how long each may be, and most bytes of a result.
const LINES: usize = 12;
const LONGEST: usize = 400;
const RESULT: u64 = 8 << 20;

/// What the surface's file is called when people save it.
const SAVED: &str = "surface.toml";

/// How often a job is looked at, and one that has been asked to end.
const LOOKED: Duration = Duration::from_millis(400);
const ENDING: Duration = Duration::from_millis(20);

/// How long a job that has been asked to end may take to put away what it has begun.
const GRACE: Duration = Duration::from_secs(2);

/// A program at work beside this one.
pub struct Running {
    /// Its number.
    pub id: u64,
    kind: String,
    command: String,
    stopped: AtomicBool,
    over: AtomicBool,
    /// The thread that looks after it.
    watching: OnceLock<Thread>,
    lines: Mutex<VecDeque<String>>,
}

impl Running {
    /// Starts this program with other arguments; what it writes on standard error is shown, and the JSON on standard output at its end.
    ///
    /// # Errors
    /// Why it cannot be started.
    pub fn start(
        id: u64,
        program: &Path,
        arguments: Vec<String>,
        library: Option<PathBuf>,
        surface: Sheet,
        board: Arc<Board>,
    ) -> Result<Arc<Self>, String> {
        let mut command = Command::new(program);
        command.args(&arguments).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let child = command.spawn().map_err(|error| format!("starting {}: {error}", program.display()))?;
        let kind = arguments.first().cloned().unwrap_or_default();
        let own = surface.path().display().to_string();
        let named = |word: &String| if *word == own { SAVED.to_owned() } else { word.clone() };
        let shown: Vec<String> = arguments.iter().filter(|word| *word != "--json").map(named).collect();
        let running = Arc::new(Self {
            id,
            kind,
            command: format!("unripple {}", shown.join(" ")),
            stopped: AtomicBool::new(false),
            over: AtomicBool::new(false),
            watching: OnceLock::new(),
            lines: Mutex::new(VecDeque::new()),
        });
        let own = running.clone();
        let watch = move || own.watch(child, library, surface, &board);
        let watching = std::thread::Builder::new().name("job".into()).spawn(watch);
        // It is set nowhere else.
        let _ = running.watching.set(watching.map_err(|error| error.to_string())?.thread().clone());
        Ok(running)
    }

    /// Has it ended.
    pub fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
        if let Some(watching) = self.watching.get() {
            watching.unpark();
        }
    }

    /// Whether it has ended.
    pub fn is_over(&self) -> bool {
        self.over.load(Ordering::Relaxed)
    }

    fn watch(self: Arc<Self>, mut child: Child, library: Option<PathBuf>, surface: Sheet, board: &Board) {
        let said = self.clone();
        let errors = child.stderr.take().map(|errors| std::thread::spawn(move || said.listen(errors)));
        let output = child.stdout.take().map(|output| {
            std::thread::spawn(move || {
                let mut text = String::new();
                // What is no text is no JSON.
                let _ = output.take(RESULT).read_to_string(&mut text);
                text
            })
        });
        let mut progress = library.map(Progress::of);
        let ended =
            self.accompany(&mut child, || self.tell(board, "running", Value::Null, progress.as_mut()));
        let text = output.and_then(|output| output.join().ok()).unwrap_or_default();
        if let Some(errors) = errors {
            // A reader that panicked has read enough.
            let _ = errors.join();
        }
        drop(surface);
        let result: Value = serde_json::from_str(&text).unwrap_or_default();
        // The doctor finds faults and says so with its exit status: what it found is an answer all the same.
        let state = match (self.stopped.load(Ordering::Relaxed), ended || !result.is_null()) {
            (true, _) => "stopped",
            (false, true) => "done",
            (false, false) => "failed",
        };
        self.over.store(true, Ordering::Relaxed);
        self.tell(board, state, result, progress.as_mut());
    }

    /// Waits until it has ended, by itself or because it was asked to; whether all went well.
    fn accompany(&self, child: &mut Child, mut look: impl FnMut()) -> bool {
        let mut asked = None;
        loop {
            if self.stopped.load(Ordering::Relaxed) {
                let since = *asked.get_or_insert_with(|| {
                    ask_to_end(child);
                    Instant::now()
                });
                if since.elapsed() > GRACE {
                    // One that has ended already cannot be ended.
                    let _ = child.kill();
                }
            }
            match child.try_wait() {
                Ok(None) => {}
                Ok(Some(status)) => return status.success(),
                Err(_) => return false,
            }
            if asked.is_none() {
                look();
            }
            std::thread::park_timeout(if asked.is_some() { ENDING } else { LOOKED });
        }
    }

    fn listen(&self, errors: impl Read) {
        for line in BufReader::new(errors).split(b'\n').map_while(Result::ok) {
            let line = String::from_utf8_lossy(&line).chars().take(LONGEST).collect();
            let mut lines = lock(&self.lines);
            if lines.len() == LINES {
                lines.pop_front();
            }
            lines.push_back(line);
        }
    }

    fn tell(&self, board: &Board, state: &str, result: Value, progress: Option<&mut Progress>) {
        let quality = progress.map(Progress::look);
        let (share, quality) = match quality {
            Some((share, quality)) => (share, quality),
            None => (None, Value::Null),
        };
        let message = json!({
            "is": "job",
            "id": self.id,
            "kind": self.kind,
            "command": self.command,
            "state": state,
            "progress": share,
            "lines": &*lock(&self.lines),
            "result": result,
            "quality": quality,
        });
        board.tell(&format!("job {}", self.kind), &message);
    }
}

/// Asks a program to end, so that it can put away what it has begun.
#[cfg(unix)]
fn ask_to_end(child: &mut Child) {
    use rustix::process::{Pid, Signal, kill_process};
    // One that has ended and was not waited for keeps its number, so nobody else is asked.
    let _ = Pid::from_raw(child.id() as i32).map(|pid| kill_process(pid, Signal::TERM));
}

/// Ends a program, where it cannot be asked.
#[cfg(not(unix))]
fn ask_to_end(child: &mut Child) {
    let _ = child.kill();
}
