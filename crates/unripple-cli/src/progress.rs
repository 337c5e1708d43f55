//! How far a task is, on a terminal; elsewhere only what people should read.

use crate::options;
use indicatif::{ProgressBar, ProgressStyle};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use unripple_tasks::Progress;

/// Steps of a bar.
const STEPS: u64 = 1000;

/// A moving sign that work goes on, then a bar once it is known how far it is; lines on standard error.
#[derive(Debug, Default)]
pub struct Terminal {
    bar: Option<ProgressBar>,
    /// Whether the bar shows a share rather than that something moves.
    measured: bool,
    wished: Option<Arc<AtomicBool>>,
}

impl Terminal {
    /// For a task that ends by itself when somebody wants to stop, so that it is asked before the program is ended.
    pub fn that_stops() -> Self {
        Self { bar: None, measured: false, wished: Some(crate::interrupt::wished()) }
    }

    fn clear(&mut self) {
        if let Some(bar) = self.bar.take() {
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
        self.bar = Some(bar);
    }

    fn done(&mut self, share: f64) {
        let Some(bar) = &self.bar else { return };
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
        match &self.bar {
            Some(bar) => bar.suspend(|| eprintln!("{line}")),
            None => eprintln!("{line}"),
        }
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
