//! Synthetic fingers that tap and slide, from a seed.

use crate::{Counts, Heard, Source, TouchError};
use std::f64::consts::{PI, TAU};
use unripple_core::{OutOfRange, Outline, Phase, Point, Random, Touch, require};

/// Places looked at to find one on the surface. On a sheet that fills a hundredth of its bounding box one is still
/// found, but for one time in 20 000.
const TRIALS: usize = 1000;
/// Largest number of steps of all fingers in one poll, so that a poll does bounded work.
const STEPS: usize = 256;
/// Shortest and longest tap, slide, and pause between two of them, in s. Each is drawn uniformly in its range; the
/// ranges are typical of people.
const TAP: (f64, f64) = (0.05, 0.2);
const SLIDE: (f64, f64) = (0.3, 2.0);
const REST: (f64, f64) = (0.1, 0.5);
/// Least and largest radius of circles, in m: about a fingertip's own and those that fit on a small sheet.
const RADIUS: (f64, f64) = (0.004, 0.015);

/// Options of synthetic fingers: number, seed, speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SyntheticOptions {
    /// Number of fingers.
    pub fingers: usize,
    /// Seed of the random numbers; equal seeds give equal sessions.
    pub seed: u64,
    /// Distance that fingers keep from the edge of the surface, in m.
    pub margin: f64,
    /// Rate at which fingers are simulated and sliding ones reported, in Hz.
    pub rate: f64,
    /// Lowest and highest speed of slides, in m/s.
    pub speed: (f64, f64),
}

impl Default for SyntheticOptions {
    /// Two fingers, seed 1, 5 mm from the edge, 120 reports a second, 20 to 200 mm/s.
    fn default() -> Self {
        Self { fingers: 2, seed: 1, margin: 0.005, rate: 120.0, speed: (0.02, 0.2) }
    }
}

#[derive(Clone, Debug)]
struct Hand {
    random: Random,
    /// The finger while it is down.
    touch: Option<Touch>,
    /// Steps until it comes, or leaves.
    left: u64,
    heading: f64,
    speed: f64,
    /// Turning, in rad/s, and how fast that changes at random, in rad/s per step.
    turn: f64,
    waver: f64,
}

/// Simulated fingers that tap, and slide along lines, circles and random paths.
///
/// The session depends on the seed, not on the rate of polling.
///
/// ```
/// use unripple_core::{Outline, Shape};
/// use unripple_touch::{Heard, Source, Synthetic, SyntheticOptions};
///
/// let sheet = Outline::new(Shape::Circle { radius: 0.07 });
/// let options = SyntheticOptions { fingers: 10, ..SyntheticOptions::default() };
/// let (mut often, mut seldom) = (Synthetic::new(&sheet, options)?, Synthetic::new(&sheet, options)?);
/// let (mut a, mut b) = (Heard::default(), Heard::default());
/// (0..=1000).for_each(|i| often.poll(1e-3 * f64::from(i), &mut a));
/// (0..=10).for_each(|i| seldom.poll(0.1 * f64::from(i), &mut b));
/// assert_eq!(a, b);
/// # Ok::<(), unripple_touch::TouchError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Synthetic {
    surface: Outline,
    options: SyntheticOptions,
    hands: Vec<Hand>,
    start: Option<f64>,
    step: u64,
    given: u64,
    counts: Counts,
}

impl Synthetic {
    /// Simulated fingers on a surface. Fails if an option is out of range, or if the margin leaves no room on the
    /// surface.
    pub fn new(surface: &Outline, options: SyntheticOptions) -> Result<Self, TouchError> {
        let SyntheticOptions { fingers, seed, margin, rate, speed } = options;
        require("synthetic fingers", (1..=64).contains(&fingers), "1 to 64", fingers as f64)?;
        require("margin of synthetic fingers, m", margin >= 0.0, "at least 0", margin)?;
        require("rate of synthetic fingers, Hz", (1.0..=10e3).contains(&rate), "1 to 10000", rate)?;
        require("least speed of synthetic fingers, m/s", speed.0 >= 0.0, "at least 0", speed.0)?;
        require(
            "most speed of synthetic fingers, m/s",
            speed.1 >= speed.0,
            "at least the least speed",
            speed.1,
        )?;
        let hands = (0..fingers as u64).map(|i| Hand::new(seed, i, rate)).collect();
        let surface = surface.clone();
        let (start, counts) = (None, Counts::default());
        let all = Self { surface, options, hands, start, step: 0, given: 0, counts };
        if all.place(&mut Random::seeded(seed)).is_none() {
            let expected = "a margin that leaves room on the surface";
            return Err(TouchError::Range(OutOfRange::new(
                "margin of synthetic fingers, m",
                expected,
                margin,
            )));
        }
        Ok(all)
    }

    /// A random place at least the margin away from the edge.
    fn place(&self, random: &mut Random) -> Option<Point> {
        let (width, height) = self.surface.extent();
        let draw = |random: &mut Random| Point::new(random.between(0.0, width), random.between(0.0, height));
        (0..TRIALS).map(|_| draw(random)).find(|p| self.clear(*p))
    }

    /// Whether a place and eight around it at the margin are on the surface.
    fn clear(&self, p: Point) -> bool {
        let around = |i: i32| {
            let angle = TAU * f64::from(i) / 8.0;
            Point::new(p.x + self.options.margin * angle.cos(), p.y + self.options.margin * angle.sin())
        };
        self.surface.contains(p) && (0..8).all(|i| self.surface.contains(around(i)))
    }

    fn advance(&mut self, time: f64, heard: &mut Heard) {
        let mut hands = std::mem::take(&mut self.hands);
        for hand in &mut hands {
            if let Some(touch) = self.act(hand, time) {
                self.counts.touches += 1;
                self.counts.downs += u64::from(touch.phase == Phase::Down);
                heard.touches.push(touch);
            }
        }
        self.hands = hands;
    }

    /// One step of one hand, and the touch that comes of it.
    fn act(&mut self, hand: &mut Hand, time: f64) -> Option<Touch> {
        hand.left = hand.left.saturating_sub(1);
        let Some(touch) = &mut hand.touch else {
            if hand.left > 0 {
                return None;
            }
            let at = self.place(&mut hand.random)?;
            self.given += 1;
            let force = Some(hand.random.between(0.2, 0.8));
            hand.touch = Some(Touch { finger: self.given, phase: Phase::Down, at, time, force });
            hand.begin(&self.options);
            return hand.touch;
        };
        touch.time = time;
        if hand.left == 0 {
            touch.phase = Phase::Up;
            hand.left = hand.steps(REST, self.options.rate);
            return hand.touch.take();
        }
        if hand.speed == 0.0 {
            return None;
        }
        let step = 1.0 / self.options.rate;
        hand.turn += hand.waver * hand.random.normal();
        hand.heading += hand.turn * step;
        let (dx, dy) = (hand.heading.cos() * hand.speed * step, hand.heading.sin() * hand.speed * step);
        let next = Point::new(touch.at.x + dx, touch.at.y + dy);
        if !self.clear(next) {
            // Back where it came from, along another curve.
            hand.heading += PI + hand.random.between(-0.5, 0.5);
            return None;
        }
        (touch.phase, touch.at) = (Phase::Move, next);
        hand.touch
    }
}

impl Hand {
    fn new(seed: u64, i: u64, rate: f64) -> Self {
        // Far apart in the generator's sequence.
        let random = Random::seeded(seed ^ i.wrapping_mul(0xd134_2543_de82_ef95));
        let mut hand = Self { random, touch: None, left: 0, heading: 0.0, speed: 0.0, turn: 0.0, waver: 0.0 };
        hand.left = hand.steps((0.0, REST.1), rate);
        hand
    }

    /// Chooses what to do while down.
    fn begin(&mut self, options: &SyntheticOptions) {
        let choice = self.random.uniform();
        self.heading = self.random.between(0.0, TAU);
        self.speed = self.random.between(options.speed.0, options.speed.1);
        (self.turn, self.waver) = (0.0, 0.0);
        match choice {
            c if c < 0.4 => self.speed = 0.0,
            c if c < 0.6 => {}
            c if c < 0.8 => self.turn = self.speed / self.random.between(RADIUS.0, RADIUS.1),
            _ => self.waver = 1.0,
        }
        let range = if choice < 0.4 { TAP } else { SLIDE };
        self.left = self.steps(range, options.rate);
    }

    fn steps(&mut self, range: (f64, f64), rate: f64) -> u64 {
        (self.random.between(range.0, range.1) * rate).ceil().max(1.0) as u64
    }
}

impl Source for Synthetic {
    fn name(&self) -> &str {
        "synthetic fingers"
    }

    fn poll(&mut self, now: f64, heard: &mut Heard) {
        let start = *self.start.get_or_insert(now);
        for _ in 0..STEPS {
            let time = start + self.step as f64 / self.options.rate;
            if time > now || !time.is_finite() {
                return;
            }
            self.step += 1;
            self.advance(time, heard);
        }
    }

    fn due(&self, now: f64) -> Option<f64> {
        Some(self.start.map_or(now, |start| start + self.step as f64 / self.options.rate))
    }

    fn counts(&self) -> Counts {
        self.counts
    }
}
