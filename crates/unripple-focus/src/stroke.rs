//! A focus that moves along a path at one level.

use crate::waveform::MOST_SAMPLES;
use crate::{FocusError, Pattern, Pulse};
use unripple_core::{Conditions, Point, Responses, require};

/// A focus that moves along a path: pulses at successive places, all at one level.
///
/// ```
/// use unripple_core::Point;
/// use unripple_focus::{Line, Pattern, Stroke};
///
/// let ends = vec![Point::from_mm(40.0, 75.0), Point::from_mm(110.0, 75.0)];
/// let line = Pattern { lines: vec![Line { points: ends, closed: false }], filled: false };
/// let stroke = Stroke::along(line, 0.1);
/// assert!((stroke.duration() - 0.7).abs() < 1e-12);
/// assert!(stroke.place(0.35).distance(Point::from_mm(75.0, 75.0)) < 1e-12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// The lines that the focus follows, one after the other; it jumps from the end of one to the start of the next.
    pub path: Pattern,
    /// Speed along the path, in m/s.
    pub speed: f64,
    /// Velocity of the surface at the focus in each pulse, in m/s.
    pub level: f64,
    /// Pulses per second. More are used where successive pulses would be farther apart than an eighth of the shortest
    /// wavelength.
    pub rate_hz: f64,
    /// Whether every second pulse has the opposite sign: the motion then has half the repetition rate and no mean.
    pub alternating: bool,
}

impl Stroke {
    /// A stroke along a path at `speed` (m/s), with 200 pulses a second of 1 m/s each.
    pub fn along(path: Pattern, speed: f64) -> Self {
        Self { path, speed, level: 1.0, rate_hz: 200.0, alternating: false }
    }

    /// Duration of the stroke, in seconds: the length of its lines over its speed.
    pub fn duration(&self) -> f64 {
        self.length() / self.speed
    }

    /// Position of the focus, in metres, at a time (s) after the start.
    pub fn place(&self, time: f64) -> Point {
        let mut left = (time * self.speed).max(0.0);
        let mut end = Point::default();
        for (a, b) in self.sides() {
            let length = a.distance(b);
            if left <= length && length > 0.0 {
                let share = left / length;
                return Point::new(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y));
            }
            left -= length;
            end = b;
        }
        end
    }

    /// Checks that a drive at `rate` samples per second can contain the stroke.
    ///
    /// # Errors
    /// [`FocusError::Range`] for a speed, rate or level that is not positive, a path without length, and a speed so low that the
    /// stroke would last more than 2²⁴ samples.
    pub fn check(&self, rate: f64) -> Result<(), FocusError> {
        for (what, x) in [
            ("speed of a stroke (m/s)", self.speed),
            ("pulses per second of a stroke", self.rate_hz),
            ("level of a stroke (m/s)", self.level),
        ] {
            require(what, x.is_finite() && x > 0.0, "a positive number", x)?;
        }
        let length = self.length();
        require("length of the path of a stroke (m)", length.is_finite() && length > 0.0, "above 0", length)?;
        let longest = MOST_SAMPLES as f64 / rate;
        // A hundredth more, so that it is enough as rounded.
        let least = 1.01 * length / longest;
        let expected = format!("at least {least:.2e}, for a stroke of at most {longest:.0} s");
        Ok(require("speed of a stroke (m/s)", self.duration() <= longest, expected, self.speed)?)
    }

    /// The pulses of the stroke, equally spaced in time from its start to its end, at most an eighth of the shortest
    /// wavelength apart.
    ///
    /// # Errors
    /// Those of [`Stroke::check`]; [`FocusError::Range`] for a speed at which pulses would follow one another within half a
    /// period of the highest frequency. Whether the path is filled makes no difference.
    pub fn pulses(&self, responses: &Responses) -> Result<Vec<Pulse>, FocusError> {
        self.pulses_in(responses.conditions())
    }

    /// The pulses of [`Stroke::pulses`], from the conditions (band, sample rate, shortest wavelength) alone,
    /// if the responses have not been computed yet.
    ///
    /// # Errors
    /// Those of [`Stroke::pulses`].
    pub fn pulses_in(&self, conditions: &Conditions) -> Result<Vec<Pulse>, FocusError> {
        self.check(conditions.rate)?;
        let duration = self.duration();
        let most = conditions.band[1] * conditions.lambda_min / 4.0;
        require("speed of a stroke (m/s)", self.speed <= most, format!("at most {most:.3}"), self.speed)?;
        let rate = self.rate_hz.max(8.0 * self.speed / conditions.lambda_min);
        let fastest = 2.0 * conditions.band[1];
        require(
            "pulses per second of a stroke",
            rate <= fastest,
            format!("at most {fastest}"),
            self.rate_hz,
        )?;
        // A hair less, so that rounding adds no step.
        let steps = (duration * rate - 1e-9).ceil().max(1.0) as usize;
        let pulse = |i: usize| {
            let instant = duration * i as f64 / steps as f64;
            let sign = if self.alternating && i % 2 == 1 { -1.0 } else { 1.0 };
            Pulse { points: vec![self.place(instant)], instant, level: sign * self.level }
        };
        let last = usize::from(!self.returns());
        Ok((0..steps + last).map(pulse).collect())
    }

    /// Whether the path ends where it started.
    fn returns(&self) -> bool {
        matches!(&self.path.lines[..], [line] if line.closed)
    }

    /// Length of all lines together, in m.
    fn length(&self) -> f64 {
        // A sum of nothing would be -0.
        self.sides().fold(0.0, |length, (a, b)| length + a.distance(b))
    }

    /// Every side of every line, in order.
    fn sides(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        self.path.lines.iter().flat_map(|line| {
            let last = line.points.len().saturating_sub(usize::from(!line.closed));
            let next = line.points.iter().cycle().skip(1);
            line.points.iter().zip(next).take(last).map(|(a, b)| (*a, *b))
        })
    }
}
