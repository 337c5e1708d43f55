//! Progress of tasks: a bar on a terminal, lines elsewhere.

use crate::options;
use crate::talk::{self, Talk};
use indicatif::{ProgressBar, ProgressStyle};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::{Duration, Instant};
use unripple::core::{Cache, Observer};
use unripple_tasks::{Lines, Progress, part_of};

/// Steps of a bar, more than a terminal has columns.
const STEPS: u64 = 1000;

/// Interval at which is checked whether a line is due: a fraction of the seconds between lines.
const LOOK: Duration = Duration::from_millis(250);

/// Handle of the progress bar, if one is drawn, for code that has to print something meanwhile.
#[derive(Clone, Debug, Default)]
pub struct Bar(Arc<Mutex<Option<ProgressBar>>>);

impl Bar {
    fn get(&self) -> MutexGuard<'_, Option<ProgressBar>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Runs `work`, such as a question to the user, while the bar is hidden.
    pub fn aside<T>(&self, work: impl FnOnce() -> T) -> T {
        match &*self.get() {
            Some(bar) => bar.suspend(work),
            None => work(),
        }
    }
}

/// Progress on a terminal: a spinner, then a bar once the share of the work that is done is known; messages go to
/// standard error.
#[derive(Debug)]
pub struct Terminal {
    shown: Arc<Shown>,
    wished: Option<Arc<AtomicBool>>,
}

impl Default for Terminal {
    fn default() -> Self {
        let terminal = Self::quiet_between();
        if terminal.shown.state().lines.is_some() {
            keep_telling(Arc::downgrade(&terminal.shown));
        }
        terminal
    }
}

/// Prints the lines that are due, even while a task reports nothing, until the progress is no longer shown.
fn keep_telling(shown: Weak<Shown>) {
    let tell = move || {
        loop {
            std::thread::sleep(LOOK);
            let Some(shown) = shown.upgrade() else { return };
            // Nothing is told while people are asked something.
            if shown.bar.0.try_lock().is_ok() {
                shown.tell(|lines, now| lines.beat(now));
            }
        }
    };
    // Without the thread, lines come when the task tells something.
    let _ = std::thread::Builder::new().name("progress".into()).spawn(tell);
}

impl Terminal {
    /// Progress for a task that runs until it is stopped: the first signal cancels the task instead of ending the program. Only the task's
    /// own messages are printed, since its last stage has no expected end.
    pub fn that_stops() -> Self {
        let mut terminal = Self::quiet_between();
        terminal.wished = Some(crate::interrupt::wished());
        terminal
    }

    /// Progress that prints nothing between the messages of a task.
    fn quiet_between() -> Self {
        let state = State { lines: talk::lines(), stage: String::new(), measured: false };
        let shown = Arc::new(Shown { bar: Bar::default(), state: Mutex::new(state) });
        Self { shown, wished: None }
    }

    /// Handle of the progress bar.
    pub fn bar(&self) -> Bar {
        self.shown.bar.clone()
    }
}

/// What is shown of a task's progress, from any thread.
#[derive(Debug)]
struct Shown {
    bar: Bar,
    state: Mutex<State>,
}

/// The stage that is shown.
#[derive(Debug)]
struct State {
    lines: Option<Lines>,
    stage: String,
    /// Whether the bar shows a share rather than that something moves.
    measured: bool,
}

impl Shown {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Prints the line that is due; returns whether lines are shown rather than a bar.
    fn tell(&self, due: impl FnOnce(&mut Lines, Instant) -> Option<String>) -> bool {
        let mut state = self.state();
        let Some(lines) = &mut state.lines else { return false };
        if let Some(line) = due(lines, Instant::now()) {
            eprintln!("{line}");
        }
        true
    }

    /// Shows a spinner with a text in place of what was shown.
    fn spin(&self, what: String) {
        self.clear();
        if talk::talk() == Talk::Quiet {
            return;
        }
        let bar = ProgressBar::new_spinner().with_message(what);
        bar.enable_steady_tick(Duration::from_millis(120));
        *self.bar.get() = Some(bar);
    }

    fn clear(&self) {
        if let Some(bar) = self.bar.get().take() {
            bar.finish_and_clear();
        }
        self.state().measured = false;
    }

    fn over(&self) {
        self.state().stage.clear();
        if !self.tell(|lines, _| lines.over()) {
            self.clear();
        }
    }

    fn stage(&self, what: &str) {
        what.clone_into(&mut self.state().stage);
        if !self.tell(|lines, now| lines.stage(what, now)) {
            self.spin(what.to_owned());
        }
    }
}

impl Observer for Shown {
    fn part(&self, what: &str) {
        if self.tell(|lines, now| lines.part(what, now)) {
            return;
        }
        let mut state = self.state();
        state.measured = false;
        // Parts may follow each other a hundred times a second: the spinner stays.
        if let Some(bar) = &*self.bar.get() {
            bar.set_style(ProgressStyle::default_spinner());
            bar.set_message(part_of(&state.stage, what));
        }
    }

    fn done(&self, share: f64) {
        if self.tell(|lines, now| lines.done(share, now)) {
            return;
        }
        let (mut state, bar) = (self.state(), self.bar.get());
        let Some(bar) = &*bar else { return };
        if !state.measured
            && let Ok(style) = ProgressStyle::with_template("{msg} {bar:40} {percent} %, {eta} left")
        {
            bar.set_style(style);
            bar.set_length(STEPS);
            state.measured = true;
        }
        bar.set_position((share.clamp(0.0, 1.0) * STEPS as f64) as u64);
    }
}

impl Progress for Terminal {
    fn stage(&mut self, what: &str) {
        self.shown.stage(what);
    }

    fn done(&mut self, share: f64) {
        self.shown.done(share);
    }

    fn over(&mut self) {
        self.shown.over();
    }

    fn tell(&mut self, line: &str) {
        let line = options::spoken(line);
        self.shown.bar.aside(|| eprintln!("{line}"));
    }

    fn observer(&self) -> Option<Arc<dyn Observer>> {
        Some(self.shown.clone())
    }

    fn cache(&self) -> Option<Arc<dyn Cache>> {
        unripple_tasks::cache::disk()
    }

    fn cancelled(&self) -> bool {
        self.wished.as_ref().is_some_and(|wished| wished.load(Ordering::Relaxed))
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        self.shown.clear();
    }
}
