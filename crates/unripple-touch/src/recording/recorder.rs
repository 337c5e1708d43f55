//! Touches written to a file while they happen.

use super::line::{self, FORMAT, Head, Item, VERSION};
use crate::{Heard, TouchError};
use std::io::{self, Write};

/// Writes touches and requests as a [`Recording`](crate::Recording), line by line, so that the file is valid after
/// any interruption.
///
/// ```
/// use unripple_core::{Phase, Point, Touch};
/// use unripple_touch::{Heard, Recorder, Recording};
///
/// let mut heard = Heard::default();
/// let touch = Touch { finger: 3, phase: Phase::Down, at: Point::from_mm(62.0, 90.0), time: 10.5, force: None };
/// heard.touches.push(touch);
/// let mut recorder = Recorder::new(Vec::new(), 10.0)?;
/// recorder.record(10.5, &heard)?;
/// let text = String::from_utf8(recorder.finish()?).unwrap();
/// assert!(text.ends_with("{\"at_ms\":500.0,\"finger\":3,\"phase\":\"down\",\"at_mm\":[62.0,90.0]}\n"));
/// assert_eq!(Recording::read(&text)?.len(), 1);
/// # Ok::<(), unripple_touch::TouchError>(())
/// ```
#[derive(Debug)]
pub struct Recorder<W: Write> {
    to: W,
    start: f64,
    last: f64,
}

impl<W: Write> Recorder<W> {
    /// Begins a recording, at a time in s of the caller's clock.
    pub fn new(mut to: W, start: f64) -> Result<Self, TouchError> {
        let head = Head { format: FORMAT.to_owned(), version: VERSION };
        put(&mut to, serde_json::to_string(&head))?;
        to.flush().map_err(error)?;
        Ok(Self { to, start, last: start })
    }

    /// Appends touches with their times, and requests with the time `now`, in s.
    pub fn record(&mut self, now: f64, heard: &Heard) -> Result<(), TouchError> {
        let touches = heard.touches.iter().map(|touch| Item::Touch(*touch));
        let wishes = heard.wishes.iter().map(|wish| Item::Wish(now, wish.clone()));
        for mut item in touches.chain(wishes) {
            self.last = self.last.max(item.time());
            match &mut item {
                Item::Touch(touch) => touch.time = self.last,
                Item::Wish(time, _) => *time = self.last,
            }
            put(&mut self.to, line::write(&item, self.start))?;
        }
        // Flushed at once, so that a program that is killed loses no touch.
        if heard.touches.is_empty() && heard.wishes.is_empty() {
            Ok(())
        } else {
            self.to.flush().map_err(error)
        }
    }

    /// Ends the recording, and returns the writer.
    pub fn finish(mut self) -> Result<W, TouchError> {
        self.to.flush().map_err(error)?;
        Ok(self.to)
    }
}

fn put(to: &mut impl Write, line: serde_json::Result<String>) -> Result<(), TouchError> {
    let mut line = line.map_err(|fault| error(io::Error::from(fault)))?;
    line.push('\n');
    to.write_all(line.as_bytes()).map_err(error)
}

fn error(error: io::Error) -> TouchError {
    TouchError::io("writing a recording", error, "see that there is room, and that the file may be written")
}
