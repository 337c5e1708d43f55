//! A screen as a source: events read, lost devices reopened.

use super::axis::Axis;
use super::contacts::Contacts;
use super::slots::{Event, Report, Slots};
use crate::{Counts, Fingers, Heard, Key, Options, Source, TouchError};
#[cfg(unix)]
use std::os::fd::BorrowedFd;

/// Batches of events read in one poll, so that a poll does bounded work: the rest is read by the next.
const BATCHES: usize = 16;
/// Interval at which a screen without a file to wait for is polled, in s. Twice as long delays a touch by as much
/// more.
const PACE: f64 = 0.002;
/// How long to wait before a lost screen is opened again, in s. Opening a device that is not there costs little, so
/// that a second is not missed.
const RETRY: f64 = 1.0;

/// A multi-touch screen as a source of touches.
///
/// A resting finger stays down until the screen reports that it has left: there is no time-out. When the screen is
/// unplugged its fingers are lifted; it is opened again when it comes back.
pub struct Screen {
    name: String,
    contacts: Box<dyn Contacts>,
    axes: (Axis, Axis),
    pressure: Option<Axis>,
    slots: Slots,
    fingers: Fingers,
    events: Vec<Event>,
    lost: Option<f64>,
}

impl Screen {
    /// A screen whose events are read from `contacts`. `axes` are the ranges of x, to the right, and of y,
    /// downwards; `pressure` is that of the pressure, if the screen measures it. All are in the screen's own
    /// units. Fails if a range is empty or an option out of range.
    pub fn new(
        name: impl Into<String>,
        contacts: Box<dyn Contacts>,
        axes: (Axis, Axis),
        pressure: Option<Axis>,
        options: Options,
    ) -> Result<Self, TouchError> {
        axes.0.check("range of a screen's x")?;
        axes.1.check("range of a screen's y")?;
        pressure.map_or(Ok(()), |axis| axis.check("range of a screen's pressure"))?;
        let (slots, fingers, name) = (Slots::new(), Fingers::new(options)?, name.into());
        Ok(Self { name, contacts, axes, pressure, slots, fingers, events: Vec::new(), lost: None })
    }

    /// Opens a device file such as `/dev/input/event5`, which the user must be allowed to read.
    #[cfg(target_os = "linux")]
    pub fn open(path: &std::path::Path, options: Options) -> Result<Self, TouchError> {
        let found = super::linux::Kernel::open(path)?;
        Self::new(found.name, Box::new(found.kernel), found.axes, found.pressure, options)
    }

    /// Returns an error: touch screens can be read on Linux only.
    #[cfg(not(target_os = "linux"))]
    pub fn open(path: &std::path::Path, _: Options) -> Result<Self, TouchError> {
        let what = "screens are read on Linux alone; send its touches over TUIO, OSC or WebSocket".to_owned();
        Err(TouchError::Screen { device: path.display().to_string(), what })
    }

    /// The multi-touch screens that this user may read: device files and names.
    #[cfg(target_os = "linux")]
    pub fn list() -> Vec<(std::path::PathBuf, String)> {
        super::linux::list()
    }

    /// An empty list: touch screens can be read on Linux only.
    #[cfg(not(target_os = "linux"))]
    pub fn list() -> Vec<(std::path::PathBuf, String)> {
        Vec::new()
    }

    fn take(&mut self, heard: &mut Heard) {
        let events = std::mem::take(&mut self.events);
        for event in &events {
            match self.slots.push(*event) {
                Report::Open => {}
                Report::Whole => self.report(heard),
                Report::Lost => {
                    self.fingers.counts.malformed += 1;
                    self.fingers.lift_where(|_| true, heard);
                    match self.contacts.slot() {
                        Ok(slot) => self.slots.resume(slot),
                        Err(_) => self.lose(heard),
                    }
                }
            }
        }
        self.fingers.counts.packets += events.len() as u64;
        self.events = events;
        self.events.clear();
    }

    fn report(&mut self, heard: &mut Heard) {
        let Self { slots, fingers, axes, pressure, .. } = self;
        let key = |slot: usize, contact: i64| Key { peer: 0, stream: slot as u32, session: contact };
        let there = |k: &Key| slots.contacts().any(|(slot, contact, ..)| key(slot, contact) == *k);
        fingers.lift_where(|k| !there(k), heard);
        for (slot, contact, (x, y), pressed) in slots.contacts() {
            let place = (axes.0.share(x), axes.1.share(y));
            let pressed = pressure.zip(pressed).map(|(axis, value)| axis.share(value));
            // A refusal is counted where it is made.
            let _ = fingers.put_sensed(key(slot, contact), place, pressed, heard);
        }
    }

    fn lose(&mut self, heard: &mut Heard) {
        self.fingers.counts.failed += 1;
        self.fingers.lift_where(|_| true, heard);
        self.lost = Some(self.fingers.now());
    }
}

impl Source for Screen {
    fn name(&self) -> &str {
        &self.name
    }

    fn poll(&mut self, now: f64, heard: &mut Heard) {
        self.fingers.begin(now);
        if let Some(since) = self.lost {
            if self.fingers.now() - since < RETRY {
                return;
            }
            if self.contacts.reopen().is_err() {
                self.lost = Some(self.fingers.now());
                return;
            }
            (self.lost, self.slots) = (None, Slots::new());
        }
        for _ in 0..BATCHES {
            let read = self.contacts.read(&mut self.events);
            let more = !self.events.is_empty();
            self.take(heard);
            if read.is_err() {
                self.lose(heard);
            }
            if !more || self.lost.is_some() {
                break;
            }
        }
    }

    fn due(&self, now: f64) -> Option<f64> {
        if let Some(since) = self.lost {
            return Some(since + RETRY);
        }
        #[cfg(unix)]
        if self.contacts.file().is_some() {
            return self.fingers.due(now);
        }
        Some(now + PACE)
    }

    #[cfg(unix)]
    fn files<'a>(&'a self, files: &mut Vec<BorrowedFd<'a>>) {
        // The file of an unplugged screen is always readable but gives no events, so it is not waited for.
        files.extend(self.contacts.file().filter(|_| self.lost.is_none()));
    }

    fn counts(&self) -> Counts {
        self.fingers.counts
    }
}
