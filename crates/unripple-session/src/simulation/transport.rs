//! The clock of the surface as pages control it: speed, pause, and going back to stored states.

use crate::wire::Transport as Asked;

/// Speed, in s of the surface per second of the page, from which a picture shows the strongest instant since the last picture.
const STROBED: f64 = 0.05;

/// The surface's clock: how time passes, and which instant is shown; in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transport {
    /// Speed, in s of the surface per second of the page.
    pub speed: f64,
    /// Whether time is paused.
    pub paused: bool,
    /// Present time of the surface, in s.
    pub now: f64,
    /// The past instant that is shown, in s; `None` for the present.
    pub back: Option<f64>,
}

impl Default for Transport {
    fn default() -> Self {
        Self { speed: 1.0, paused: false, now: 0.0, back: None }
    }
}

impl Transport {
    /// The instant that is shown, in s of the surface's clock.
    pub fn shown(&self) -> f64 {
        self.back.unwrap_or(self.now)
    }

    /// Whether a picture shows the strongest instant since the last picture, rather than the present one.
    pub fn strobes(&self) -> bool {
        self.back.is_none() && !self.paused && self.speed >= STROBED
    }

    /// Applies a request of a page. States are stored from `oldest` (s) on, `state` seconds apart.
    pub fn obey(&mut self, asked: &Asked, oldest: f64, state: f64) {
        self.speed = asked.speed.unwrap_or(self.speed);
        self.paused = asked.paused.unwrap_or(self.paused);
        if let Some(shown) = asked.shown_s {
            self.paused = true;
            self.back = Some(shown);
        }
        if let Some(step) = asked.step {
            self.paused = true;
            let shown = self.shown() + step as f64 * state;
            // A step beyond what has been is a step of the surface.
            self.now = self.now.max(shown);
            self.back = Some(shown);
        }
        if asked.live == Some(true) {
            self.back = None;
            self.paused = asked.paused.unwrap_or(false);
        }
        self.settle(oldest);
    }

    /// Applies a request of a page to a recording that reaches from one instant to another (s), with states `state` seconds apart.
    pub fn wind(&mut self, asked: &Asked, [from, to]: [f64; 2], state: f64) {
        self.speed = asked.speed.unwrap_or(self.speed);
        self.paused = asked.paused.unwrap_or(self.paused || asked.shown_s.is_some() || asked.step.is_some());
        let shown = asked.shown_s.unwrap_or(self.now) + asked.step.unwrap_or(0) as f64 * state;
        (self.now, self.back) = (shown.clamp(from, to.max(from)), None);
    }

    /// Lets `seconds` of the page's time pass; `oldest` is the oldest stored instant (s).
    pub fn pass(&mut self, seconds: f64, oldest: f64) {
        if self.paused {
            return;
        }
        match &mut self.back {
            Some(back) => *back += seconds * self.speed,
            None => self.now += seconds * self.speed,
        }
        self.settle(oldest);
    }

    /// Shows the present again, and in slow motion goes on to a later instant (s) at once.
    pub fn hasten(&mut self, to: f64) {
        self.back = None;
        if self.speed < 1.0 {
            self.now = self.now.max(to);
        }
    }

    /// Sets the present to the clock (s) of a real device, which cannot be slowed, while `seconds` of the page's time pass. In slow motion
    /// the instant that is shown falls behind, at most to `oldest` (s).
    pub fn follow(&mut self, clock: f64, seconds: f64, oldest: f64) {
        let slow = self.paused || self.speed < 1.0;
        if slow && self.back.is_none() {
            self.back = Some(self.now);
        }
        self.now = clock;
        if let Some(back) = self.back.as_mut().filter(|_| !self.paused) {
            *back += seconds * self.speed;
            if *back < oldest {
                *back = clock;
            }
        }
        if self.back.is_some_and(|back| back >= clock) {
            self.back = None;
        }
        self.back = self.back.map(|back| back.max(oldest));
    }

    fn settle(&mut self, oldest: f64) {
        self.back = self.back.filter(|back| *back < self.now).map(|back| back.max(oldest));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_runs_slowly_stands_still_and_is_looked_back_at() {
        let mut transport = Transport::default();
        transport.pass(2.0, 1.0);
        transport.obey(&Asked { speed: Some(0.01), ..Asked::default() }, 1.0, 0.001);
        transport.pass(1.0, 1.0);
        assert!((transport.now - 2.01).abs() < 1e-12 && !transport.strobes());
        transport.obey(&Asked { shown_s: Some(0.5), ..Asked::default() }, 1.0, 0.001);
        assert_eq!((transport.shown(), transport.paused), (1.0, true));
        transport.pass(1.0, 1.0);
        assert_eq!(transport.shown(), 1.0);
        transport.obey(&Asked { step: Some(-3), shown_s: Some(1.5), ..Asked::default() }, 1.0, 0.001);
        assert!((transport.shown() - 1.497).abs() < 1e-12);
        transport.obey(&Asked { paused: Some(false), ..Asked::default() }, 1.0, 0.001);
        // It runs on from there, and is live again when it has caught up with where the surface stands.
        transport.pass(100.0, 1.0);
        assert_eq!(transport.back, None);
        transport.obey(&Asked { step: Some(2), ..Asked::default() }, 1.0, 0.001);
        assert!((transport.now - 2.012).abs() < 1e-12 && transport.paused);
    }

    #[test]
    fn what_is_recorded_is_wound_both_ways() {
        let mut transport = Transport::default();
        transport.wind(&Asked { shown_s: Some(0.02), ..Asked::default() }, [0.0, 0.03], 0.001);
        assert_eq!((transport.shown(), transport.paused), (0.02, true));
        transport.wind(&Asked { step: Some(-2), ..Asked::default() }, [0.0, 0.03], 0.001);
        assert!((transport.shown() - 0.018).abs() < 1e-12);
        transport.wind(
            &Asked { shown_s: Some(9.0), paused: Some(false), ..Asked::default() },
            [0.0, 0.03],
            0.001,
        );
        assert_eq!((transport.shown(), transport.paused), (0.03, false));
    }

    #[test]
    fn a_clock_that_cannot_be_slowed_is_looked_back_on() {
        let mut transport = Transport { now: 5.0, ..Transport::default() };
        transport.follow(5.1, 0.1, 4.1);
        assert_eq!(transport.back, None);
        transport.speed = 0.1;
        transport.follow(5.2, 0.1, 4.2);
        assert!((transport.shown() - 5.11).abs() < 1e-12);
        (0..100).for_each(|i| transport.follow(5.3 + 0.1 * f64::from(i), 0.1, 4.3 + 0.1 * f64::from(i)));
        assert!(transport.shown() >= 4.3 && transport.shown() <= transport.now);
    }
}
