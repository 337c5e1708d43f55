//! Velocity and prediction of a finger: a line fitted to its last places.

use unripple_core::{Outline, Point};

/// How many places are remembered: of a screen that reports a hundred times a second, those of the last 80 ms.
const PLACES: usize = 8;
/// How far back places count, in s: twice as long smooths the velocity more and follows a turn of the finger later.
const MEMORY: f64 = 0.08;

/// Motion of a finger, from the times and places of its touches. A velocity stated by the sender is not used.
///
/// The velocity is the slope of the least-squares line through the places of the last 80 ms, at most eight of them.
/// With fewer than two places in that time the finger is at rest.
///
/// ```
/// use unripple_core::Point;
/// use unripple_touch::Motion;
///
/// let mut motion = Motion::new(0.0, Point::new(0.05, 0.05));
/// motion.push(0.01, Point::new(0.051, 0.05));
/// motion.push(0.02, Point::new(0.052, 0.05));
/// let (x, y) = motion.velocity(0.02);
/// assert!((x - 0.1).abs() < 1e-12 && y == 0.0);
/// ```
#[derive(Clone, Debug)]
pub struct Motion {
    places: [(f64, Point); PLACES],
    count: usize,
}

impl Motion {
    /// Motion of a finger that was put down at a time, in s, at a place, in m.
    pub fn new(time: f64, at: Point) -> Self {
        Self { places: [(time, at); PLACES], count: 1 }
    }

    /// Last place of the finger, in m.
    pub fn at(&self) -> Point {
        self.last().1
    }

    /// Adds a place, in m, at a time, in s. If the time is not later than that of the last place, the new place
    /// replaces it.
    pub fn push(&mut self, time: f64, at: Point) {
        if time <= self.last().0 {
            self.places[self.count - 1].1 = at;
            return;
        }
        if self.count == PLACES {
            self.places.rotate_left(1);
            self.count -= 1;
        }
        self.places[self.count] = (time, at);
        self.count += 1;
    }

    /// Velocity in m/s, to the right and up, at a time in s not before that of the last place.
    pub fn velocity(&self, now: f64) -> (f64, f64) {
        let recent = || self.places[..self.count].iter().filter(|(time, _)| now - time <= MEMORY);
        let count = recent().count() as f64;
        if count < 2.0 {
            return (0.0, 0.0);
        }
        let mean = |of: fn(&(f64, Point)) -> f64| recent().map(of).sum::<f64>() / count;
        let (t, x, y) = (mean(|p| p.0), mean(|p| p.1.x), mean(|p| p.1.y));
        let spread: f64 = recent().map(|p| (p.0 - t).powi(2)).sum();
        // Places within a millisecond say nothing of the speed.
        if spread < 1e-6 {
            return (0.0, 0.0);
        }
        let along =
            |of: &dyn Fn(&(f64, Point)) -> f64| recent().map(|p| (p.0 - t) * of(p)).sum::<f64>() / spread;
        (along(&|p| p.1.x - x), along(&|p| p.1.y - y))
    }

    /// Predicted place of the finger, in m, `ahead` s after `now`: on a straight line from its last place, at most
    /// `reach` m from it, and on the surface. A path that leaves the surface is shortened to a half or a quarter, or
    /// to the last place.
    pub fn predict(&self, now: f64, ahead: f64, reach: f64, surface: &Outline) -> Point {
        let (at, (vx, vy)) = (self.at(), self.velocity(now));
        let time = (now - self.last().0).max(0.0) + ahead.max(0.0);
        let distance = vx.hypot(vy) * time;
        if !(distance > 0.0 && distance.is_finite()) {
            return at;
        }
        let scale = time * (reach / distance).min(1.0);
        let ahead = |part: f64| Point::new(at.x + part * scale * vx, at.y + part * scale * vy);
        [1.0, 0.5, 0.25].map(ahead).into_iter().find(|p| surface.contains(*p)).unwrap_or(at)
    }

    fn last(&self) -> &(f64, Point) {
        &self.places[self.count - 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::{Random, Shape};

    fn sheet() -> Outline {
        Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 })
    }

    #[test]
    fn follows_a_stroke_through_jitter() {
        // 120 places a second, noticed up to 4 ms late, each off by 0.1 mm, at 200 mm/s.
        let mut random = Random::seeded(3);
        let mut motion = Motion::new(0.0, Point::new(0.02, 0.03));
        for i in 1..60 {
            let t = f64::from(i) / 120.0;
            let noise = |r: &mut Random| 1e-4 * (r.uniform() - 0.5);
            let at = Point::new(0.02 + 0.16 * t + noise(&mut random), 0.03 + 0.12 * t + noise(&mut random));
            motion.push(t, at);
            if i > 8 {
                let (x, y) = motion.velocity(t + random.between(0.0, 0.004));
                assert!((x - 0.16).abs() < 0.02 && (y - 0.12).abs() < 0.02, "{x} {y}");
            }
        }
        let t = 59.0 / 120.0;
        let truth = Point::new(0.02 + 0.16 * (t + 0.03), 0.03 + 0.12 * (t + 0.03));
        assert!(motion.predict(t, 0.03, 0.02, &sheet()).distance(truth) < 1e-3);
        assert!(motion.predict(t, 0.03, 0.002, &sheet()).distance(motion.at()) < 0.002 + 1e-12);
    }

    #[test]
    fn rests_when_nothing_is_heard() {
        let mut motion = Motion::new(0.0, Point::new(0.02, 0.03));
        motion.push(0.01, Point::new(0.03, 0.03));
        assert_eq!(motion.velocity(0.2), (0.0, 0.0));
        assert_eq!(motion.predict(0.2, 0.03, 0.02, &sheet()), Point::new(0.03, 0.03));
    }

    #[test]
    fn never_leaves_the_surface() {
        let mut motion = Motion::new(0.0, Point::new(0.13, 0.05));
        motion.push(0.01, Point::new(0.1495, 0.05));
        for ahead in [0.001, 0.01, 0.1, 1e9, f64::INFINITY, f64::NAN] {
            assert!(sheet().contains(motion.predict(0.01, ahead, 0.02, &sheet())));
        }
    }

    #[test]
    fn takes_two_places_at_one_time_as_one() {
        let mut motion = Motion::new(0.0, Point::new(0.02, 0.03));
        motion.push(0.0, Point::new(0.04, 0.03));
        assert_eq!((motion.at(), motion.velocity(0.0)), (Point::new(0.04, 0.03), (0.0, 0.0)));
    }
}
