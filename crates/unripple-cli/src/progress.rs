//! How far a task is, on a terminal; elsewhere only what people should read.

use crate::options;
use indicatif::{ProgressBar, ProgressStyle};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use unripple_tasks::Progress;

/// Steps of a bar, more than a terminal has columns.
const STEPS: u64 = 1000;

/// The bar on a terminal, if there is one now, for whoever has to speak to people meanwhile.
#[derive(Clone, Debug, Default)]
pub struct Bar(Arc<Mutex<Option<ProgressBar>>>);

impl Bar {
    fn get(&self) -> MutexGuard<'_, Option<ProgressBar>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Does something with the bar out of the way, such as asking people and waiting for them.
    pub fn aside<T>(&self, work: impl FnOnce() -> T) -> T {
        match &*self.get() {
            Some(bar) => bar.suspend(work),
            None => work(),
        }
    }
}

/// A moving sign that work goes on, then a bar once it is known how far it is; lines on standard error.
#[derive(Debug, Default)]
pub struct Terminal {
    bar: Bar,
    /// Whether the bar shows a share rather than that something moves.
    measured: bool,
    wished: Option<Arc<AtomicBool>>,
}

impl Terminal {
    /// For a task that ends by itself when somebody wants to stop, so that it is asked before the program is ended.
    pub fn that_stops() -> Self {
        Self { bar: Bar::default(), measured: false, wished: Some(crate::interrupt::wished()) }
    }

    /// The bar on the terminal.
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
        let bar = ProgressBar::new_spinner().with_message(what.to_owned());
        bar.enable_steady_tick(Duration::from_millis(120));
        *self.bar.get() = Some(bar);
    }

    fn done(&mut self, share: f64) {
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
