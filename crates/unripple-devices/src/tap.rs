//! The force pulse of a tap.

use std::f64::consts::PI;
use unripple_core::Random;

/// A force pulse on the sheet, as of a fingertip, a ballpoint pen or a small hammer: samples of force in N.
///
/// ```
/// use unripple_devices::Tap;
///
/// let known = Tap::half_sine(2.0, 0.5e-3, 48e3);
/// assert_eq!(known.force().len(), 24);
/// let unknown = Tap::random(7, 48e3);
/// assert_eq!(unknown, Tap::random(7, 48e3));
/// assert_ne!(unknown, Tap::random(8, 48e3));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Tap {
    force: Vec<f64>,
}

impl Tap {
    /// A pulse with the forces `force`, in N, one for each sample. A force that is not finite counts as 0.
    pub fn new(force: Vec<f64>) -> Self {
        let finite = |f: f64| if f.is_finite() { f } else { 0.0 };
        Self { force: force.into_iter().map(finite).collect() }
    }

    /// A pulse of half a sine with a peak (N) and a duration (s, one second at most); `rate` is in samples
    /// per second.
    pub fn half_sine(peak: f64, duration: f64, rate: f64) -> Self {
        let samples = (duration.clamp(0.0, 1.0) * rate).ceil() as usize;
        let at = |i: usize| (PI * (i as f64 + 0.5) / (duration * rate).max(1.0)).sin().max(0.0);
        Self::new((0..samples).map(|i| peak * at(i)).collect())
    }

    /// A random pulse; equal seeds give equal pulses: 0.1 to 1 ms long, 0.5 to 5 N strong, skewed, more or
    /// less peaked, and in one of three cases with a weaker bounce 3 to 12 ms later.
    pub fn random(seed: u64, rate: f64) -> Self {
        let mut random = Random::seeded(seed);
        let mut force = Self::bump(&mut random, rate);
        if random.uniform() < 1.0 / 3.0 {
            let (share, later) = (random.between(0.1, 0.4), random.between(3e-3, 12e-3));
            let bounce = Self::bump(&mut random, rate);
            let peak = |pulse: &[f64]| pulse.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
            let weight = share * peak(&force) / peak(&bounce);
            let start = (later * rate) as usize;
            force.resize(start.max(force.len()) + bounce.len(), 0.0);
            force[start..].iter_mut().zip(&bounce).for_each(|(to, from)| *to += weight * from);
        }
        Self { force }
    }

    /// A random blow of a small hammer with a hard tip; equal seeds give equal blows: a push of 0.15 to 0.4 ms and 2 to 10 N, and in one of
    /// four cases a second one of a tenth to a half of its strength 3 to 12 ms later, a double hit.
    pub fn hammer(seed: u64, rate: f64) -> Self {
        let mut random = Random::seeded(seed);
        let peak = random.decades(2.0, 10.0);
        let mut push = Self::half_sine(peak, random.decades(0.15e-3, 0.4e-3), rate);
        if random.uniform() < 0.25 {
            let second = Self::half_sine(peak * random.between(0.1, 0.5), 0.4e-3, rate);
            push.force.resize(((random.between(3e-3, 12e-3) * rate) as usize).max(push.force.len()), 0.0);
            push.force.extend(second.force);
        }
        push
    }

    /// One push of random duration, strength and shape.
    fn bump(random: &mut Random, rate: f64) -> Vec<f64> {
        let duration = random.decades(0.1e-3, 1e-3);
        let (peak, power, skew) =
            (random.decades(0.5, 5.0), random.between(0.8, 2.0), random.between(0.7, 1.4));
        // Whatever the sample rate, the pulse begins and ends within it.
        let samples = (duration * rate).ceil().clamp(1.0, 1e6) as usize;
        let at = |i: usize| ((i as f64 + 0.5) / (duration * rate).max(1.0)).min(1.0);
        (0..samples).map(|i| peak * (PI * at(i).powf(skew)).sin().max(0.0).powf(power)).collect()
    }

    /// The force of the pulse at each sample, in N.
    pub fn force(&self) -> &[f64] {
        &self.force
    }

    /// The impulse, in N·s: the sum of the forces divided by `rate` (samples per second).
    pub fn impulse(&self, rate: f64) -> f64 {
        self.force.iter().sum::<f64>() / rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_half_sine_has_its_impulse() {
        let tap = Tap::half_sine(3.0, 1e-3, 48e3);
        assert!((tap.impulse(48e3) / (2.0 / PI * 3.0 * 1e-3) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn some_blows_of_a_hammer_are_double() {
        let blows: Vec<Tap> = (0..200).map(|seed| Tap::hammer(seed, 48e3)).collect();
        let double = blows.iter().filter(|blow| blow.force.len() as f64 > 2e-3 * 48e3).count();
        assert!((30..75).contains(&double), "{double}");
        assert!(blows.iter().all(|blow| blow.force.iter().all(|f| (0.0..10.01).contains(f))));
    }

    #[test]
    fn random_taps_are_pulses_of_all_kinds() {
        let taps: Vec<Tap> = (0..200).map(|seed| Tap::random(seed, 48e3)).collect();
        for tap in &taps {
            assert!(tap.force.iter().all(|f| (0.0..5.01).contains(f)));
            assert!(tap.impulse(48e3) > 1e-5 && tap.impulse(48e3) < 1e-2);
        }
        let bounced = taps.iter().filter(|tap| tap.force.len() > 100).count();
        assert!((40..100).contains(&bounced), "{bounced}");
    }
}
