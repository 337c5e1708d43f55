//! A button: a click when pressed, another when let go.

use crate::error::within;
use crate::play::{Maker, Moment, Out, Play};
use crate::{EffectsError, limits};

/// Force at which a button lets go again, as a share of that at which it was pressed: hysteresis, so that a
/// force that trembles clicks once. At 1 there would be none.
const LET_GO: f64 = 0.7;

/// Clicks at the finger: one when pressed, another when let go.
///
/// Pressed means put down in the region, or pressed harder than a force; let go means lifted or slid out of the region,
/// or pressed with less than 0.7 of that force. A finger whose force is not known never presses such a
/// button.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Button {
    /// Force at which it is pressed, in N; the touch itself without.
    pub press_force: Option<f64>,
    /// Gain of the second click, 0 for none.
    pub release: f64,
}

impl Button {
    /// Refuses a force or gain that is not legal.
    pub(super) fn check(&self) -> Result<(), EffectsError> {
        within("gain of the release", self.release, limits::SHARE)?;
        self.press_force.map_or(Ok(()), |force| within("force of a press", force, limits::FORCE))
    }

    /// What plays it under a finger.
    pub(super) fn maker(&self) -> Maker {
        let button = *self;
        Box::new(move |_| Box::new(Pressing { button, pressed: false }))
    }
}

struct Pressing {
    button: Button,
    pressed: bool,
}

impl Pressing {
    /// Presses or lets go as the force says.
    fn by_force(&mut self, now: &Moment, out: &mut Out) {
        let (Some(threshold), Some(force)) = (self.button.press_force, now.force) else { return };
        if !self.pressed && force >= threshold {
            self.press(now, out);
        } else if self.pressed && force < LET_GO * threshold {
            self.let_go(now, out);
        }
    }

    fn press(&mut self, now: &Moment, out: &mut Out) {
        self.pressed = true;
        out.pulse(now.time, now.at, 1.0);
    }

    fn let_go(&mut self, now: &Moment, out: &mut Out) {
        self.pressed = false;
        out.pulse(now.time, now.at, self.button.release);
    }
}

impl Play for Pressing {
    fn enter(&mut self, now: &Moment, touched: bool, out: &mut Out) {
        match self.button.press_force {
            None if touched => self.press(now, out),
            None => {}
            Some(_) => self.by_force(now, out),
        }
    }

    fn step(&mut self, _from: &Moment, to: &Moment, out: &mut Out) {
        self.by_force(to, out);
    }

    fn leave(&mut self, now: &Moment, out: &mut Out) {
        if self.pressed {
            self.let_go(now, out);
        }
    }
}
