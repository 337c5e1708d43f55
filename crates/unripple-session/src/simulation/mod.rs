//! The surface in use: touched, stepped through time, with its past stored, and shown.

mod instrument;
mod lens;
mod look;
mod messages;
mod page_fingers;
mod page_touches;
mod past;
mod playback;
mod pressing;
mod real_device;
mod replay;
mod tape;
mod transport;

#[cfg(test)]
pub(crate) mod tests;

pub use instrument::{CELLS, Follow, Instrument, PULSES, Spec, check_effect};
pub use lens::Cells;
pub use real_device::RealDevice;
pub use replay::Replay;
pub use transport::Transport;

use crate::outbox::Outbox;
use crate::wire;
use page_fingers::PageFingers;
use playback::{Known, Playback, step};
use serde_json::Value;
use std::collections::BTreeMap;
use unripple::core::Point;

/// Interval of the messages on the state of the surface, and of the measurement of its pace, in s: five times a second, as fast as figures
/// can be read.
const TOLD: f64 = 0.2;
const PACED: f64 = 1.0;

/// Longest step of the page's time that the surface takes at once, in s: after a sleep of this machine it goes on from where it was.
const STEP: f64 = 0.25;

/// Probes at once; with two fingers they fill the traces of a picture.
const MOST_PROBES: usize = 6;

/// A request to the simulation.
pub enum Order {
    /// A touch of a finger: the numbers of its page and of the finger on that page, the phase, and the place
    /// (m).
    Touch((u64, u32), wire::Phase, Point),
    /// A page was closed: its fingers are lifted.
    Leave(u64),
    /// Sets how time passes.
    Transport(wire::Transport),
    /// Shows velocity if true, else displacement.
    Velocity(bool),
    /// Level of all effects, in dB relative to their own.
    Gain(f64),
    /// Adds or removes a place whose motion is followed.
    Probe(wire::Probe),
    /// Plays another instrument; the message is sent to pages after that.
    Play(Box<Instrument>, Value),
    /// Shows two recorded simulations side by side; with `None` the live surface again.
    Replay(Option<Box<Replay>>),
    /// A page was opened, and must be sent a picture.
    Look,
}

/// A place whose motion is followed.
struct Probe {
    id: u32,
    at: Point,
    weights: Vec<f32>,
}

/// A surface that is played, its clock, and what pages see of it.
pub struct Simulation {
    instrument: Instrument,
    /// The instrument that is played when time goes on, and the message that is sent then: what is shown while time stands still stays.
    next: Option<(Box<Instrument>, Value)>,
    transport: Transport,
    velocity: bool,
    gain_db: f64,
    probes: Vec<Probe>,
    given: u32,
    replay: Option<Box<Replay>>,
    known: Known,
    /// Fingers of pages that are down; the next instrument gets them too.
    fingers: PageFingers,
    /// Places focused on last, and what they read of the modes.
    targets: BTreeMap<u64, (Point, Vec<f32>)>,
    /// Number of the newest picture, and of the first of this clock.
    frame: u64,
    first: u64,
    /// The moment of the frame before, and whether something has changed since.
    before: f64,
    changed: bool,
    /// Pages that look.
    viewers: usize,
    /// Seconds of the page since the last report of how the surface fares.
    untold: f64,
    /// Seconds of the page since the pace was last taken, the surface's clock then, and the pace.
    pace: (f64, f64, f64),
    wrong: Option<String>,
}

impl Drop for Simulation {
    fn drop(&mut self) {
        // An instrument that is still being built must not keep it open.
        if let Some(device) = &self.instrument.spec.device {
            device.close();
        }
    }
}

impl Simulation {
    /// A simulation that plays an instrument.
    pub fn new(instrument: Instrument) -> Self {
        let mut fingers = PageFingers::default();
        fingers.renew(instrument.hold());
        Self {
            instrument,
            next: None,
            transport: Transport::default(),
            velocity: false,
            gain_db: 0.0,
            probes: Vec::new(),
            given: 0,
            replay: None,
            known: Known::default(),
            fingers,
            targets: BTreeMap::new(),
            frame: 0,
            first: 1,
            before: 0.0,
            changed: true,
            viewers: 0,
            untold: 0.0,
            pace: (0.0, 0.0, 1.0),
            wrong: None,
        }
    }

    /// Sends the first messages to pages.
    pub fn begin(&mut self, out: &mut Outbox) {
        self.tell_anew(out);
    }

    /// Advances by `seconds` of real time, as people at the pages experience it, and shows the result. The surface is stepped as long as
    /// `more` returns true; `viewers` is the number of open pages.
    pub fn advance(
        &mut self,
        seconds: f64,
        viewers: usize,
        more: &mut dyn FnMut() -> bool,
        out: &mut Outbox,
    ) {
        self.viewers = viewers;
        self.untold += seconds;
        self.pace.0 += seconds;
        self.fingers.wait(seconds.min(STEP));
        self.pass(seconds.min(STEP), more);
        self.show(out);
        if self.untold >= TOLD {
            self.tell(out);
        }
    }

    /// Whether the real device has been taken from the instrument that is played.
    pub fn rests(&self) -> bool {
        matches!(&self.instrument.playback, Playback::Away(away) if away.player.is_ended())
    }

    /// Carries out a request.
    pub fn obey(&mut self, order: Order, out: &mut Outbox) {
        self.changed = true;
        match order {
            Order::Touch(finger, phase, at) => {
                if phase == wire::Phase::Down {
                    self.hasten();
                }
                let now = self.present();
                self.fingers.touch(finger, phase, at, now);
                self.press();
            }
            Order::Leave(page) => {
                self.fingers.leave(page);
                self.press();
            }
            Order::Transport(asked) => {
                let (oldest, state) = self.remembered();
                match &self.replay {
                    Some(replay) => self.transport.wind(&asked, [oldest, replay.to()], state),
                    None => self.transport.obey(&asked, oldest, state),
                }
                self.tell_transport(out);
                self.go_on(out);
            }
            Order::Velocity(velocity) => {
                self.velocity = velocity;
                self.tell_transport(out);
            }
            Order::Gain(db) => {
                self.gain_db = db;
                self.tell_gain();
                self.tell_transport(out);
            }
            Order::Probe(asked) => {
                self.probe(&asked);
                self.tell_transport(out);
            }
            Order::Play(instrument, told) => {
                let alike = instrument.spec.surface == self.instrument.spec.surface;
                let here = matches!(self.instrument.playback, Playback::Here(_)) && self.replay.is_none();
                self.next = Some((instrument, told));
                if !(alike && here && self.transport.paused) {
                    self.take_next(out);
                }
            }
            Order::Replay(replay) => {
                let Transport { speed, .. } = self.transport;
                self.transport = match &replay {
                    Some(replay) => Transport { speed: speed.min(replay.speed()), ..replay.start() },
                    None => Transport { now: self.head(), speed, ..Transport::default() },
                };
                self.replay = replay;
                self.tell_anew(out);
                self.go_on(out);
            }
            Order::Look => {}
        }
    }

    /// Plays the instrument that waits for time to go on, if it does.
    fn go_on(&mut self, out: &mut Outbox) {
        if !self.transport.paused && self.replay.is_none() {
            self.take_next(out);
        }
    }

    fn take_next(&mut self, out: &mut Outbox) {
        if let Some((instrument, told)) = self.next.take() {
            self.play(*instrument, out);
            out.tell("settings", &told);
        }
    }

    /// Plays another instrument, at the same pace and with the same fingers.
    fn play(&mut self, instrument: Instrument, out: &mut Outbox) {
        self.instrument = instrument;
        self.replay = None;
        let Transport { speed, paused, .. } = self.transport;
        // A block of it is played at once, so that there is something to look at while time stands still.
        let now = 1.0 / self.instrument.rate();
        self.transport = Transport { speed, paused, now, ..Transport::default() };
        self.pace = (0.0, 0.0, speed);
        self.before = 0.0;
        self.wrong = None;
        self.targets.clear();
        self.tell_gain();
        self.fingers.renew(self.instrument.hold());
        self.press();
        let plant = &self.instrument.plant;
        for probe in &mut self.probes {
            probe.at = self.instrument.spec.surface.outline.nearest(probe.at);
            probe.weights = lens::weights(plant, &[probe.at]);
        }
        self.tell_anew(out);
    }

    fn probe(&mut self, asked: &wire::Probe) {
        if let Some(id) = asked.remove {
            self.probes.retain(|probe| probe.id != id);
        }
        let Some([x, y]) = asked.add else { return };
        let outline = &self.instrument.spec.surface.outline;
        let at = outline.nearest(Point::from_mm(x, y));
        if self.probes.len() == MOST_PROBES {
            self.probes.remove(0);
        }
        self.given += 1;
        let weights = lens::weights(&self.instrument.plant, &[at]);
        self.probes.push(Probe { id: self.given, at, weights });
    }

    /// Lets time pass.
    fn pass(&mut self, seconds: f64, more: &mut dyn FnMut() -> bool) {
        self.fingers.settle(self.present());
        self.press();
        let (oldest, _) = self.remembered();
        if let Some(replay) = &self.replay {
            self.transport.pass(seconds, oldest);
            self.transport.now = replay.wrapped(self.transport.now);
            return;
        }
        if matches!(self.instrument.playback, Playback::Away(_)) {
            self.mirror(more);
            let head = self.head();
            self.transport.follow(head, seconds, oldest);
        } else {
            self.transport.pass(seconds, oldest);
            self.catch_up(more);
        }
        self.known.fingers = match (&self.instrument.playback, self.transport.paused) {
            // The surface hears of fingers when it goes on; who looks sees them at once.
            (Playback::Here(_), true) => self.resting(),
            _ => self.instrument.playback.fingers(),
        };
    }

    /// Steps the surface up to the present of its clock; if there is not enough time for that, the clock falls behind.
    fn catch_up(&mut self, more: &mut dyn FnMut() -> bool) {
        let Instrument { playback, tape, spec, .. } = &mut self.instrument;
        let Playback::Here(engine) = playback else { return };
        let limit = spec.surface.emission.limit as f32;
        while self.wrong.is_none() && engine.stage().time() < self.transport.now {
            match step(engine) {
                Ok(drive) => tape.keep(drive, limit),
                Err(error) => self.wrong = Some(error.to_string()),
            }
            if !more() {
                self.transport.now = self.transport.now.min(engine.stage().time());
                return;
            }
        }
    }

    /// Steps the simulated surface by the drive that the real device was sent.
    fn mirror(&mut self, more: &mut dyn FnMut() -> bool) {
        let Instrument { playback, tape, .. } = &mut self.instrument;
        let Playback::Away(away) = playback else { return };
        while self.wrong.is_none() && more() {
            match away.step() {
                Ok(Some(drive)) => tape.keep(drive, 1.0),
                Ok(None) => return,
                Err(error) => self.wrong = Some(error.to_string()),
            }
        }
    }

    /// Time up to which the live surface has been computed, in s.
    fn head(&self) -> f64 {
        let newest = self.instrument.handle.history(|history| history.newest()).unwrap_or(0);
        newest as f64 / self.instrument.rate()
    }

    /// The oldest instant whose state is stored, and the interval of the states, in s.
    fn remembered(&self) -> (f64, f64) {
        if let Some(replay) = &self.replay {
            return (replay.from(), replay.state());
        }
        let rate = self.instrument.rate();
        let span = self.instrument.handle.history(|history| {
            let oldest =
                history.newest() as f64 - (history.stride() * history.len().saturating_sub(1)) as f64;
            (oldest / rate, history.stride() as f64 / rate)
        });
        span.unwrap_or((0.0, 1.0 / rate))
    }
}
