//! Progress of tasks: a bar on a terminal, lines elsewhere.

use crate::lines::{Lines, Talk, talk};
use crate::options;
use indicatif::{ProgressBar, ProgressStyle};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use unripple_tasks::Progress;

/// Steps of a bar, more than a terminal has columns.
const STEPS: u64 = 1000;

/// Handle of the progress bar, if one is drawn, for code that has to print something meanwhile.
#[derive(Clone, Debug, Default)]
pub struct Bar(Arc<Mutex<Option<ProgressBar>>>);

impl Bar {
    fn get(&self) -> MutexGuard<'_, Option<ProgressBar>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Runs `work` while the bar is hidden, such as asking people something and waiting for the answer.
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
    bar: Bar,
    lines: Option<Lines>,
    /// Whether the bar shows a share rather than that something moves.
    measured: bool,
    wished: Option<Arc<AtomicBool>>,
}

impl Default for Terminal {
    fn default() -> Self {
        Self { bar: Bar::default(), lines: Lines::wanted(), measured: false, wished: None }
    }
}

impl Terminal {
    /// Progress for a task that stops by itself: the first signal cancels the task instead of ending the program.
    pub fn that_stops() -> Self {
        let mut terminal = Self::default();
        terminal.wished = Some(crate::interrupt::wished());
        terminal
    }

    /// Handle of the progress bar.
    pub fn bar(&self) -> Bar {
        self.bar.clone()
    }

    fn clear(&mut self) {
        if let Some(bar) = self.bar.get().take() {
            bar.finish_and_clear();
        }
        self.measured = false;
    }
}

impl Progress for Terminal {
    fn stage(&mut self, what: &str) {
        self.clear();
        if let Some(lines) = &mut self.lines {
            return lines.stage(what);
        }
        if talk() == Talk::Quiet {
            return;
        }
        let bar = ProgressBar::new_spinner().with_message(what.to_owned());
        bar.enable_steady_tick(Duration::from_millis(120));
        *self.bar.get() = Some(bar);
    }

    fn done(&mut self, share: f64) {
        if let Some(lines) = &mut self.lines {
            return lines.done(share);
        }
        let bar = self.bar.get();
        let Some(bar) = &*bar else { return };
        if !self.measured
            && let Ok(style) = ProgressStyle::with_template("{msg} {bar:40} {percent} %, {eta} left")
        {
            bar.set_style(style);
            bar.set_length(STEPS);
            self.measured = true;
        }
        bar.set_position((share.clamp(0.0, 1.0) * STEPS as f64) as u64);
    }

    fn tell(&mut self, line: &str) {
        let line = options::spoken(line);
        self.bar.aside(|| eprintln!("{line}"));
    }

    fn cancelled(&self) -> bool {
        self.wished.as_ref().is_some_and(|wished| wished.load(Ordering::Relaxed))
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        self.clear();
    }
}
