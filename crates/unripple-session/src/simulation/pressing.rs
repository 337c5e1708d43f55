//! Fingers of pages on the surface that is played, and the level of what they set off.

use super::Simulation;
use super::page_fingers::FINGERS;
use super::page_touches::News;
use super::playback::Playback;
use unripple::core::Point;

impl Simulation {
    /// Sends the instrument the fingers that are down, if they have changed; not while time is paused.
    pub(super) fn press(&mut self) {
        let hears = match &mut self.instrument.playback {
            Playback::Here(_) if self.transport.paused => return,
            Playback::Here(engine) => engine.stage().time(),
            // A real surface hears of every lift at once.
            Playback::Away(_) => f64::NEG_INFINITY,
        };
        if let Some(pressed) = self.fingers.take(hears) {
            // An instrument at its end needs to know no more.
            let _ = self.instrument.page_touches.send(News::Pressed(pressed));
        }
    }

    /// Shows the present, for a press, and in slow motion goes on to the block in which the surface hears of it: the rest of the block
    /// before would take seconds.
    pub(super) fn hasten(&mut self) {
        if self.transport.paused || self.replay.is_some() {
            return;
        }
        if let Playback::Here(engine) = &mut self.instrument.playback {
            self.transport.hasten(engine.stage().time());
        }
    }

    /// Present time of the live surface, in s.
    pub(super) fn present(&self) -> f64 {
        // What is recorded has a clock of its own.
        if self.replay.is_some() { self.head() } else { self.transport.now }
    }

    /// Tells the instrument the level of effects.
    pub(super) fn tell_gain(&self) {
        let _ = self.instrument.page_touches.send(News::Gain(self.gain_db));
    }

    /// Fingers of pages that are on the sheet.
    pub(super) fn resting(&self) -> Vec<(u64, Point)> {
        let outline = &self.instrument.spec.surface.outline;
        let here = self.fingers.places().filter(|(_, at)| outline.contains(*at));
        here.map(|((page, finger), at)| (page * FINGERS + u64::from(finger), at)).collect()
    }
}
