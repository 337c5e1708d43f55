//! Progress of tasks as lines, for logs and wherever no bar can be drawn.

use crate::part_of;
use std::time::Duration;
use unripple::core::clock::Instant;

/// Time after which a task's stages are reported if there is no terminal: shorter tasks end before a line is read.
const LONG: Duration = Duration::from_secs(2);

/// Least and most time between lines on the same stage. A task that takes seconds is not silent for longer than people wait without doubt,
/// and a log of an hour has some two hundred lines.
const BETWEEN: [Duration; 2] = [Duration::from_secs(3), Duration::from_secs(20)];

/// Share of the time since the beginning that passes between lines on the same stage, within [`BETWEEN`]. With twice this value, there are
/// half as many.
const RARER: f64 = 0.05;

/// Progress of a task that is reported in lines. Every method returns the line that the caller should print, if there is one.
///
/// ```
/// use std::time::{Duration, Instant};
/// use unripple_tasks::Lines;
///
/// let began = Instant::now();
/// let mut lines = Lines::new(began, false);
/// assert_eq!(lines.stage("responses", began), None);
/// let due = lines.beat(began + Duration::from_secs(3));
/// assert_eq!(due.as_deref(), Some("responses … for 3 s"));
/// ```
#[derive(Debug)]
pub struct Lines {
    began: Instant,
    told: Instant,
    stage: String,
    /// The part of the stage that is under way, if it has parts.
    part: String,
    /// When the stage or part began.
    since: Instant,
    share: Option<f64>,
    /// Whether a line has named the stage.
    named: bool,
    /// Whether all stages and parts are reported, with their times.
    all: bool,
}

impl Lines {
    /// Lines of a task that began at the time `began`: on stages that take long, or, if `all` is set, on every stage and part, with the time
    /// since the beginning.
    pub fn new(began: Instant, all: bool) -> Self {
        let (stage, part) = (String::new(), String::new());
        Self { began, told: began, stage, part, since: began, share: None, named: false, all }
    }

    /// Records that a stage begins, at the time `now`.
    pub fn stage(&mut self, what: &str, now: Instant) -> Option<String> {
        what.clone_into(&mut self.stage);
        (self.part, self.share, self.since) = (String::new(), None, now);
        let long = now - self.began >= LONG;
        self.named = self.all || long;
        self.told = now;
        match self.all {
            true => Some(self.timed(what, now)),
            false => long.then(|| format!("{what} …")),
        }
    }

    /// Records that a part of the stage begins. Since many parts take no time, it gives a line only if all parts are reported, or
    /// when a line is due.
    pub fn part(&mut self, what: &str, now: Instant) -> Option<String> {
        what.clone_into(&mut self.part);
        (self.share, self.since) = (None, now);
        if !self.all {
            return self.beat(now);
        }
        self.told = now;
        Some(self.timed(&part_of(&self.stage, what), now))
    }

    /// Records that a share (0 to 1) of the stage or part is done.
    pub fn done(&mut self, share: f64, now: Instant) -> Option<String> {
        self.share = Some(share);
        self.beat(now)
    }

    /// Records that the last stage has ended.
    pub fn over(&mut self) -> Option<String> {
        (self.stage, self.part, self.share) = (String::new(), String::new(), None);
        None
    }

    /// The line that is due at the time `now`, if one is. To be called at short intervals, since a long
    /// computation may report nothing itself.
    pub fn beat(&mut self, now: Instant) -> Option<String> {
        let since = now - self.told;
        let due = match self.named {
            true => since >= (now - self.began).mul_f64(RARER).clamp(BETWEEN[0], BETWEEN[1]),
            false => now - self.began >= LONG && since >= LONG,
        };
        if !due || self.stage.is_empty() && self.part.is_empty() {
            return None;
        }
        (self.told, self.named) = (now, true);
        let what = if self.part.is_empty() { self.stage.clone() } else { part_of(&self.stage, &self.part) };
        let line = match self.share {
            Some(share) => format!("{what}: {:.0} %", 100.0 * share),
            // How much is left is not known; that it goes on is.
            None => format!("{what} … for {:.0} s", (now - self.since).as_secs_f64()),
        };
        Some(if self.all { self.timed(&line, now) } else { line })
    }

    fn timed(&self, what: &str, now: Instant) -> String {
        format!("{:8.1} s  {what}", (now - self.began).as_secs_f64())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is told of a stage with parts, at times in seconds.
    struct Told {
        lines: Lines,
        began: Instant,
        all: Vec<String>,
    }

    impl Told {
        fn new(all: bool) -> Self {
            let began = Instant::now();
            Self { lines: Lines::new(began, all), began, all: Vec::new() }
        }

        fn at(&mut self, seconds: f64, tell: impl FnOnce(&mut Lines, Instant) -> Option<String>) {
            let now = self.began + Duration::from_secs_f64(seconds);
            self.all.extend(tell(&mut self.lines, now));
        }

        /// Asks for the line that is due ten times a second, from one time to another.
        fn wait(&mut self, from: f64, to: f64) {
            let times = (0..).map(|i| from + 0.1 * f64::from(i)).take_while(|t| *t < to);
            times.for_each(|t| self.at(t, Lines::beat));
        }
    }

    #[test]
    fn a_stage_that_tells_nothing_is_told_every_few_seconds() {
        let mut told = Told::new(false);
        told.at(0.0, |lines, now| lines.stage("responses", now));
        told.wait(0.1, 9.0);
        assert_eq!(told.all, ["responses … for 2 s", "responses … for 5 s", "responses … for 8 s"]);
        told.all.clear();
        told.wait(9.0, 3600.0);
        assert!((150..300).contains(&told.all.len()), "{} lines in an hour", told.all.len());
    }

    #[test]
    fn what_is_over_soon_is_not_told() {
        let mut told = Told::new(false);
        told.at(0.0, |lines, now| lines.stage("responses", now));
        told.at(0.5, |lines, now| lines.part("mesh 1", now));
        told.at(1.0, |lines, now| lines.done(0.5, now));
        told.at(1.5, |lines, now| lines.stage("drive", now));
        told.wait(1.5, 2.0);
        assert!(told.all.is_empty(), "{:?}", told.all);
    }

    #[test]
    fn parts_and_shares_are_told_with_their_stage() {
        let mut told = Told::new(false);
        told.at(0.0, |lines, now| lines.stage("responses", now));
        told.at(0.1, |lines, now| lines.part("mesh 1", now));
        told.at(2.5, |lines, now| lines.done(0.25, now));
        told.at(3.2, |lines, now| lines.part("mesh 2", now));
        told.wait(3.2, 6.0);
        told.at(7.0, |lines, now| lines.stage("drive", now));
        assert_eq!(told.all, ["responses: mesh 1: 25 %", "responses: mesh 2 … for 2 s", "drive …"]);
        let mut told = Told::new(true);
        told.at(0.0, |lines, now| lines.stage("responses", now));
        told.at(0.5, |lines, now| lines.part("mesh 1", now));
        assert_eq!(told.all, ["     0.0 s  responses", "     0.5 s  responses: mesh 1"]);
    }
}
