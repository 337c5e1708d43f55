//! When sweeps were heard, and under what tension: sensors' signals compared with another take, or with each other.

use super::apart::{Apart, Pairs};
use super::law::Law;
use crate::signals::{Band, Delay};

/// Seconds by which a sweep is looked for before and after where it should be.
const REACH: f64 = 0.1;

/// Likeness below which a sweep is not known again.
const LEAST: f64 = 0.7;

/// Likeness that the coarse search asks for: it sees the neighbouring sweeps too, and is small even where all is
/// well.
const COARSE: f64 = 0.4;

/// Sensors that take part in the coarse search. The second decides where the first is spoilt by a knock; more take
/// longer.
const LOUDEST: usize = 2;

/// Energy over that of the loudest from which a reference hears a sweep.
const HEARD: f64 = 0.1;

/// Times that a delay is looked for anew where the last one led. A delay that has not settled by then is left as it
/// is.
const STEPS: usize = 6;

/// Rounds in which delays between pairs become delays of sweeps.
const ROUNDS: usize = 200;

/// Periodic deconvolutions of what some sensors recorded of all sweeps of one take.
pub(super) struct Telling<'a> {
    /// For each sensor, the number of its own actuator.
    pub sensors: &'a [usize],
    /// For each sensor, its whole deconvolution.
    pub wholes: &'a [Vec<f64>],
    /// Where each sweep's response begins in them, lead included.
    pub starts: &'a [usize],
    /// Samples before time 0 that a response begins with.
    pub lead: usize,
    /// Samples per second.
    pub rate: f64,
    /// The band in which responses are compared.
    pub band: Band,
    /// Where frequencies go when tension changes.
    pub law: &'a Law,
}

/// `length` samples of a periodic signal.
pub(super) fn around(whole: &[f64], first: i64, length: usize) -> Vec<f64> {
    let size = whole.len().max(1) as i64;
    (0..length as i64)
        .map(|i| whole.get((first + i).rem_euclid(size) as usize).copied().unwrap_or(0.0))
        .collect()
}

impl Telling<'_> {
    /// Each sweep beside what the same sensors heard of it before, `known[sensor][actuator]` from time 0.
    pub fn beside(&self, known: &[Vec<Vec<f64>>], still: bool) -> Vec<Option<Apart>> {
        let one = |(sweep, start): (usize, &usize)| {
            let pairs: Vec<(&[f64], usize)> =
                known.iter().enumerate().filter_map(|(s, k)| Some((k.get(sweep)?.as_slice(), s))).collect();
            self.compared(&pairs, (*start + self.lead) as i64, 0, still)
        };
        self.starts.iter().enumerate().map(one).collect()
    }

    /// The sweeps whose actuators' sensors are known beside each other, by reciprocity: what a hears of b is what b hears
    /// of a, at another time. Delays and changes are known but for one that is common to all.
    pub fn beside_each_other(&self, length: usize, still: bool) -> Vec<Option<Apart>> {
        let count = self.sensors.len();
        let mut pairs: Vec<(usize, usize, Apart)> = Vec::new();
        for i in 0..count {
            for j in i + 1..count {
                let [a, b] = [self.sensors[i], self.sensors[j]];
                let [from_a, from_b] = [a, b].map(|actuator| self.starts[actuator] as i64);
                let known = around(&self.wholes[i], from_b, length);
                if let Some(apart) = self.compared(&[(&known, j)], from_a, self.lead, still) {
                    pairs.push((i, j, apart));
                }
            }
        }
        let found =
            [|apart: &Apart| (apart.late, apart.errors[0]), |apart: &Apart| (apart.change, apart.errors[1])]
                .map(|value| levelled(count, &pairs, value));
        let mut all = vec![None; self.starts.len()];
        for (i, actuator) in self.sensors.iter().enumerate() {
            let own = pairs.iter().filter(|(a, b, _)| *a == i || *b == i);
            let likeness = own.map(|(_, _, apart)| apart.likeness).fold(f64::NEG_INFINITY, f64::max);
            let [late, change] = [found[0][i], found[1][i]];
            if let (Some((late, a)), Some((change, b))) = (late, change) {
                all[*actuator] = Some(Apart { late, change, likeness, errors: [a, b] });
            }
        }
        all
    }

    /// Each sweep beside the loudest, as one input heard them that hears what is sent (all of it, or the sum): how much later
    /// than it should be. `None` for those that it does not hear.
    pub fn beside_the_loudest(&self, length: usize) -> Vec<Option<Apart>> {
        let Some(whole) = self.wholes.first() else { return vec![None; self.starts.len()] };
        let cuts: Vec<Vec<f64>> =
            self.starts.iter().map(|start| around(whole, *start as i64, length)).collect();
        let powers: Vec<f64> = cuts.iter().map(|cut| cut.iter().map(|x| x * x).sum()).collect();
        let most = powers.iter().copied().fold(0.0, f64::max);
        let Some(loudest) = powers.iter().position(|power| *power >= most) else { return Vec::new() };
        let one = |(start, power): (&usize, &f64)| {
            if *power < HEARD * most {
                return None;
            }
            self.compared(&[(&cuts[loudest], 0)], *start as i64, self.lead, true)
        };
        self.starts.iter().zip(&powers).map(one).collect()
    }

    /// The differences of known responses from those around `at`, which have their time 0 after `origin` samples.
    fn compared(&self, known: &[(&[f64], usize)], at: i64, origin: usize, still: bool) -> Option<Apart> {
        let mut whole = self.coarse(known, at)?;
        let mut best = None::<Apart>;
        for _ in 0..STEPS {
            let cut =
                |(known, sensor): &(&[f64], usize)| around(&self.wholes[*sensor], at + whole, known.len());
            let found: Vec<Vec<f64>> = known.iter().map(cut).collect();
            let pairs: Vec<(&[f64], &[f64])> =
                known.iter().zip(&found).map(|((k, _), f)| (*k, &f[..])).collect();
            let apart = agreed(Pairs::of(&pairs, origin, self.rate, self.band, self.law)?, still);
            best = Some(Apart { late: apart.late + whole as f64, ..apart });
            // Another tension moves what is coarsely seen: whole samples are taken out until none is left.
            if apart.late.abs() < 1.0 {
                break;
            }
            whole += apart.late.round() as i64;
        }
        best.filter(|apart| apart.likeness >= LEAST)
    }

    /// Whole samples by which what was found comes late.
    fn coarse(&self, known: &[(&[f64], usize)], at: i64) -> Option<i64> {
        let power = |signal: &[f64]| signal.iter().map(|x| x * x).sum::<f64>();
        let mut loudest: Vec<&(&[f64], usize)> = known.iter().collect();
        loudest.sort_by(|a, b| power(b.0).total_cmp(&power(a.0)));
        let reach = (REACH * self.rate) as i64;
        let found = loudest.into_iter().take(LOUDEST).filter_map(|(known, sensor)| {
            let long = around(&self.wholes[*sensor], at - reach, known.len() + 2 * reach as usize);
            let delay = Delay::between(&long, known, self.rate, self.band).ok()?;
            (!delay.inverted).then_some(delay)
        });
        // The correlation is of the whole stretch, in which neighbours sound too: it is small even where all is well.
        let best = found.max_by(|a, b| a.correlation.total_cmp(&b.correlation))?;
        (best.correlation >= COARSE).then(|| best.samples.round() as i64 - reach)
    }
}

/// The common difference of pairs: of most of them, where the others have nothing in common, as at a dead sensor.
fn agreed(pairs: Pairs<'_>, still: bool) -> Apart {
    let apart = pairs.apart(still);
    if apart.likeness >= LEAST {
        return apart;
    }
    let strange = pairs.strange(&apart, LEAST);
    pairs.without(&strange).map_or(apart, |others| others.apart(still))
}

/// What each of `count` has, when pairs (later minus earlier number's: the first of the pair less the second) are known, each
/// with its error: weighted least squares by damped Jacobi iterations, mean 0. `None` for those in no pair.
fn levelled(
    count: usize,
    pairs: &[(usize, usize, Apart)],
    value: impl Fn(&Apart) -> (f64, f64),
) -> Vec<Option<(f64, f64)>> {
    let mut level = vec![0.0; count];
    let mut weights = vec![0.0; count];
    let weight = |apart: &Apart| 1.0 / (value(apart).1.powi(2)).max(1e-18);
    for (i, j, apart) in pairs {
        weights[*i] += weight(apart);
        weights[*j] += weight(apart);
    }
    for _ in 0..ROUNDS {
        let mut sums = vec![0.0; count];
        for (i, j, apart) in pairs {
            sums[*i] += weight(apart) * (level[*j] + value(apart).0);
            sums[*j] += weight(apart) * (level[*i] - value(apart).0);
        }
        for i in 0..count {
            if weights[i] > 0.0 {
                // Half of the way, so that two that only know each other do not swing.
                level[i] = 0.5 * (level[i] + sums[i] / weights[i]);
            }
        }
        let known = weights.iter().filter(|weight| **weight > 0.0).count().max(1);
        let mean = level.iter().sum::<f64>() / known as f64;
        level.iter_mut().zip(&weights).filter(|(_, w)| **w > 0.0).for_each(|(x, _)| *x -= mean);
    }
    let known = |i: usize| (weights[i] > 0.0).then(|| (level[i], (1.0 / weights[i]).sqrt()));
    (0..count).map(known).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_make_levels() {
        let truth = [3.0, -1.0, 0.5, -2.5];
        let mut pairs = Vec::new();
        for i in 0..4 {
            for j in i + 1..4 {
                let late = truth[i] - truth[j];
                pairs.push((i, j, Apart { late, change: 0.0, likeness: 1.0, errors: [0.1 + i as f64, 0.1] }));
            }
        }
        let found = levelled(5, &pairs, |apart| (apart.late, apart.errors[0]));
        assert_eq!(found[4], None);
        let mean = truth.iter().sum::<f64>() / 4.0;
        for (truth, found) in truth.iter().zip(&found) {
            let shift = found.unwrap().0 - (truth - mean);
            assert!(shift.abs() < 1e-6, "{found:?}");
        }
    }

    #[test]
    fn what_goes_round_is_cut_anywhere() {
        assert_eq!(around(&[0.0, 1.0, 2.0], -1, 5), [2.0, 0.0, 1.0, 2.0, 0.0]);
    }
}
