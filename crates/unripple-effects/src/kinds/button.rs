//! Button: a pulse when pressed, another when released.

use crate::error::within;
use crate::play::{Maker, Moment, Out, Play};
use crate::{EffectsError, limits};

/// Force at which a button is released, as a share of the force at which it is pressed: hysteresis, so that a
/// fluctuating force gives one click. At 1 there would be none.
const LET_GO: f64 = 0.7;

/// A button: one pulse (click) at the finger when it is pressed, another when it is released.
///
/// Without a force, a finger presses the button when it is put down in the region. With a force, it presses the button when its
/// force reaches that value, and releases it below 0.7 of the value; a finger whose force is not known never presses it. In both
/// cases, lifting the finger or sliding it out of the region releases the button.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Button {
    /// Force at which the button is pressed, in N; `None` if the touch itself presses it.
    pub press_force: Option<f64>,
    /// Gain of the pulse at the release, 0 to 1; 0 for no pulse.
    pub release: f64,
}

impl Button {
    /// Refuses a force or gain that is out of range.
    pub(super) fn check(&self) -> Result<(), EffectsError> {
        within("gain of the release", self.release, limits::SHARE)?;
        self.press_force.map_or(Ok(()), |force| within("force of a press", force, limits::FORCE))
    }

    /// The function that starts it under a finger.
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
    /// Presses or releases the button according to the finger's force.
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
