//! A recorded session played again as a source.

use super::line::Item;
use super::session::Recording;
use crate::{Counts, Heard, Source, TouchError};
use unripple_core::{Outline, Phase, Touch};

/// Largest number of touches and requests that are played in one poll, so that a poll does bounded work.
const MOST: usize = 1024;

/// A source that plays a [`Recording`]. Touches have their recorded times, counted from the first poll, at whatever
/// rate it is polled.
///
/// ```
/// use unripple_core::{Outline, Shape};
/// use unripple_touch::{Heard, Playback, Recording, Source};
///
/// let text = r#"{"format":"unripple-touches","version":1}
/// {"at_ms":5,"finger":1,"phase":"down","at_mm":[62,90]}"#;
/// let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
/// let mut playback = Playback::new(Recording::read(text)?, &sheet)?;
/// let mut heard = Heard::default();
/// playback.poll(100.0, &mut heard);
/// playback.poll(100.01, &mut heard);
/// // Whoever is down when a recording ends leaves then.
/// assert_eq!(heard.touches.len(), 2);
/// assert_eq!(heard.touches[0].time, 100.005);
/// assert!(playback.done());
/// # Ok::<(), unripple_touch::TouchError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Playback {
    recording: Recording,
    next: usize,
    start: Option<f64>,
    down: Vec<Touch>,
    counts: Counts,
}

impl Playback {
    /// Plays a recording on a surface; a touch that is not on it is an error that names the line.
    pub fn new(recording: Recording, surface: &Outline) -> Result<Self, TouchError> {
        let off = |item: &Item| matches!(item, Item::Touch(touch) if !surface.contains(touch.at));
        if let Some((i, Item::Touch(touch))) =
            recording.items().iter().enumerate().find(|(_, item)| off(item))
        {
            let near = surface.nearest(touch.at);
            let what =
                format!("at_mm: expected a place on the surface, found {}; nearest is {near}", touch.at);
            return Err(TouchError::Line { line: i + 2, what });
        }
        Ok(Self { recording, next: 0, start: None, down: Vec::new(), counts: Counts::default() })
    }

    /// Whether the whole recording was played.
    pub fn done(&self) -> bool {
        self.next == self.recording.len() && self.down.is_empty()
    }

    fn play(&mut self, item: Item, start: f64, heard: &mut Heard) {
        self.counts.packets += 1;
        match item {
            Item::Wish(_, wish) => {
                let room = heard.wish(wish);
                self.counts.wishes += u64::from(room);
                self.counts.crowded += u64::from(!room);
            }
            Item::Touch(touch) => {
                let touch = Touch { time: start + touch.time, ..touch };
                self.down.retain(|other| other.finger != touch.finger);
                if touch.phase != Phase::Up {
                    self.down.push(touch);
                }
                heard.touches.push(touch);
                self.counts.touches += 1;
                self.counts.downs += u64::from(touch.phase == Phase::Down);
            }
        }
    }
}

impl Source for Playback {
    fn name(&self) -> &str {
        "recording"
    }

    fn poll(&mut self, now: f64, heard: &mut Heard) {
        let start = *self.start.get_or_insert(now);
        for _ in 0..MOST {
            match self.recording.items().get(self.next) {
                Some(item) if start + item.time() <= now => {
                    let item = item.clone();
                    self.next += 1;
                    self.play(item, start, heard);
                }
                Some(_) => return,
                None => break,
            }
        }
        if self.next == self.recording.len() {
            let end = start + self.recording.duration();
            let left = self.down.drain(..).map(|touch| Touch { phase: Phase::Up, time: end, ..touch });
            let before = heard.touches.len();
            heard.touches.extend(left);
            self.counts.touches += (heard.touches.len() - before) as u64;
        }
    }

    fn due(&self, now: f64) -> Option<f64> {
        let Some(start) = self.start else { return Some(now) };
        let end = || start + self.recording.duration();
        match self.recording.items().get(self.next) {
            Some(item) => Some(start + item.time()),
            None => (!self.down.is_empty()).then(end),
        }
    }

    fn counts(&self) -> Counts {
        self.counts
    }
}
