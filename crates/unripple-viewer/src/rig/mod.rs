//! The surface at work: touched, stepped through time, remembered and looked at.

mod instrument;
mod lens;
mod look;
mod pad;
mod past;
mod replay;
mod tape;
mod told;
mod transport;
mod works;

#[cfg(test)]
mod tests;

pub use instrument::{CELLS, Follow, Instrument, Opener, PULSES, Spec, check_effect};
pub use lens::Cells;
pub use replay::Replay;
pub use transport::Transport;

use crate::board::Board;
use crate::wire;
use serde_json::Value;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};
use unripple::core::Point;
use works::{Known, Works, step};

/// Frames a second, and how often the rest is told, in s.
const FRAMES: f64 = 30.0;
const TOLD: f64 = 0.2;

/// Most of a frame's time that the surface may take to catch up.
const BUSY: f64 = 0.8;

/// Probes at once.
const MOST_PROBES: usize = 6;

/// What the rig is asked for.
pub enum Order {
    /// A page's finger, by its number over all pages.
    Touch(u64, wire::Phase, Point),
    /// How time passes.
    Transport(wire::Transport),
    /// `displacement` or `velocity`.
    Velocity(bool),
    /// A place whose motion is followed.
    Probe(wire::Probe),
    /// Another surface, or the same played otherwise; and what pages are told once it is.
    Play(Box<Instrument>, Value),
    /// Two recorded acts side by side; or back to the live surface.
    Replay(Option<Box<Replay>>),
    /// A page came: it must be shown something.
    Look,
    /// Ends the rig.
    Stop,
}

/// A place whose motion is followed.
struct Probe {
    id: u32,
    at: Point,
    weights: Vec<f32>,
}

/// The thread's own.
pub struct Rig {
    board: Arc<Board>,
    instrument: Instrument,
    transport: Transport,
    velocity: bool,
    probes: Vec<Probe>,
    given: u32,
    replay: Option<Box<Replay>>,
    known: Known,
    /// Fingers of pages that are down: what is played next has them too.
    pressed: BTreeMap<u64, Point>,
    /// Those that the instrument knows of.
    told_of: BTreeMap<u64, Point>,
    /// Places focused on last, and what they read of the modes.
    targets: BTreeMap<u64, (Point, Vec<f32>)>,
    frame: u64,
    /// The moment of the frame before, and whether something has changed since.
    before: f64,
    changed: bool,
    told: Instant,
    /// Clock and surface when the pace was last taken, and the pace.
    pace: (Instant, f64, f64),
    wrong: Option<String>,
}

impl Rig {
    /// A rig for a surface.
    pub fn new(board: Arc<Board>, instrument: Instrument) -> Self {
        Self {
            board,
            instrument,
            transport: Transport::default(),
            velocity: false,
            probes: Vec::new(),
            given: 0,
            replay: None,
            known: Known::default(),
            pressed: BTreeMap::new(),
            told_of: BTreeMap::new(),
            targets: BTreeMap::new(),
            frame: 0,
            before: 0.0,
            changed: true,
            told: Instant::now(),
            pace: (Instant::now(), 0.0, 1.0),
            wrong: None,
        }
    }

    /// Works until told to stop, or until nobody is there any more to tell.
    pub fn run(mut self, orders: Receiver<Order>) {
        self.tell_anew();
        let mut due = Instant::now();
        let mut passed = Instant::now();
        loop {
            match orders.recv_timeout(due.saturating_duration_since(Instant::now())) {
                Ok(Order::Stop) | Err(RecvTimeoutError::Disconnected) => return,
                Ok(order) => {
                    self.obey(order);
                    // Orders that come faster than frames must not keep them waiting.
                    if Instant::now() < due {
                        continue;
                    }
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
            let seconds = passed.elapsed().as_secs_f64().min(0.25);
            passed = Instant::now();
            due = passed.max(due) + Duration::from_secs_f64(1.0 / FRAMES);
            due = due.max(passed + Duration::from_millis(2));
            self.pass(seconds);
            self.show();
            if self.told.elapsed().as_secs_f64() >= TOLD {
                self.tell();
            }
        }
    }

    fn obey(&mut self, order: Order) {
        self.changed = true;
        match order {
            Order::Touch(finger, phase, at) => {
                match phase {
                    wire::Phase::Up => drop(self.pressed.remove(&finger)),
                    wire::Phase::Down | wire::Phase::Move => drop(self.pressed.insert(finger, at)),
                }
                self.press();
            }
            Order::Transport(asked) => {
                let (oldest, state) = self.remembered();
                match &self.replay {
                    Some(replay) => self.transport.wind(&asked, [oldest, replay.to()], state),
                    None => self.transport.obey(&asked, oldest, state),
                }
                self.tell_transport();
            }
            Order::Velocity(velocity) => {
                self.velocity = velocity;
                self.tell_transport();
            }
            Order::Probe(asked) => {
                self.probe(&asked);
                self.tell_transport();
            }
            Order::Play(instrument, told) => {
                self.play(*instrument);
                self.board.tell("settings", &told);
            }
            Order::Replay(replay) => {
                let Transport { speed, .. } = self.transport;
                self.transport = match &replay {
                    Some(replay) => Transport { speed: speed.min(replay.speed()), ..replay.start() },
                    None => Transport { now: self.head(), speed, ..Transport::default() },
                };
                self.replay = replay;
                self.tell_anew();
            }
            Order::Look | Order::Stop => {}
        }
    }

    /// Tells the instrument what fingers have done since it was told last; while time stands still it hears nothing.
    fn press(&mut self) {
        if self.transport.paused && matches!(self.instrument.works, Works::Here(_)) {
            return;
        }
        let before = std::mem::replace(&mut self.told_of, self.pressed.clone());
        let left = before.iter().filter(|(finger, _)| !self.pressed.contains_key(finger));
        let left = left.map(|(finger, at)| (*finger, wire::Phase::Up, *at));
        let here = self.pressed.iter().filter(|(finger, at)| before.get(finger) != Some(at));
        let here = here.map(|(finger, at)| match before.contains_key(finger) {
            true => (*finger, wire::Phase::Move, *at),
            false => (*finger, wire::Phase::Down, *at),
        });
        // An instrument at its end needs to know no more.
        left.chain(here).for_each(|pressed| self.instrument.pad.send(pressed).unwrap_or(()));
    }

    /// Goes over to another instrument, at the same pace and under the same fingers.
    fn play(&mut self, instrument: Instrument) {
        self.instrument = instrument;
        self.replay = None;
        let Transport { speed, paused, .. } = self.transport;
        // A block of it is played at once, so that there is something to look at even while time stands still.
        let now = 1.0 / self.instrument.rate();
        self.transport = Transport { speed, paused: paused && speed < 1.0, now, ..Transport::default() };
        self.pace = (Instant::now(), 0.0, speed);
        self.before = 0.0;
        self.wrong = None;
        self.targets.clear();
        self.told_of.clear();
        self.press();
        let plant = &self.instrument.plant;
        for probe in &mut self.probes {
            probe.at = self.instrument.spec.surface.outline.nearest(probe.at);
            probe.weights = lens::weights(plant, &[probe.at]);
        }
        self.tell_anew();
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
    fn pass(&mut self, seconds: f64) {
        self.press();
        let (oldest, _) = self.remembered();
        if let Some(replay) = &self.replay {
            self.transport.pass(seconds, oldest);
            self.transport.now = replay.wrapped(self.transport.now);
            return;
        }
        if matches!(self.instrument.works, Works::Away(_)) {
            self.mirror();
            let head = self.head();
            self.transport.follow(head, seconds, oldest);
        } else {
            self.transport.pass(seconds, oldest);
            self.catch_up();
        }
        self.known.fingers = match (&self.instrument.works, self.transport.paused) {
            // The surface hears of fingers when it goes on; who looks sees them at once.
            (Works::Here(_), true) => self.resting(),
            _ => self.instrument.works.fingers(),
        };
    }

    /// Fingers of pages that are on the sheet.
    fn resting(&self) -> Vec<(u64, Point)> {
        let outline = &self.instrument.spec.surface.outline;
        let here = self.pressed.iter().filter(|(_, at)| outline.contains(**at));
        here.map(|(finger, at)| (*finger, *at)).collect()
    }

    /// Steps the surface to where it should be; what cannot be done in time is let go, so that it runs slower.
    fn catch_up(&mut self) {
        let Instrument { works, tape, spec, .. } = &mut self.instrument;
        let Works::Here(engine) = works else { return };
        let (began, limit) = (Instant::now(), spec.surface.emission.limit as f32);
        while self.wrong.is_none() && engine.stage().time() < self.transport.now {
            match step(engine) {
                Ok(drive) => tape.keep(drive, limit),
                Err(error) => self.wrong = Some(error.to_string()),
            }
            if began.elapsed().as_secs_f64() > BUSY / FRAMES {
                self.transport.now = self.transport.now.min(engine.stage().time());
                return;
            }
        }
    }

    /// Lets the computed surface follow the one out there.
    fn mirror(&mut self) {
        let Instrument { works, tape, .. } = &mut self.instrument;
        let Works::Away(away) = works else { return };
        let began = Instant::now();
        while self.wrong.is_none() && began.elapsed().as_secs_f64() < BUSY / FRAMES {
            match away.step() {
                Ok(Some(drive)) => tape.keep(drive, 1.0),
                Ok(None) => return,
                Err(error) => self.wrong = Some(error.to_string()),
            }
        }
    }

    /// Where the live surface has got to, in s.
    fn head(&self) -> f64 {
        let newest = self.instrument.handle.history(|history| history.newest()).unwrap_or(0);
        newest as f64 / self.instrument.rate()
    }

    /// The oldest moment that is remembered, and the time from one to the next, in s.
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
