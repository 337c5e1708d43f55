//! Delay and change of tension of each sweep of a take, from sensors' signals compared with another take or with each other.

use super::apart::{Apart, Change, Pairs};
use super::law::Law;
use crate::signals::{Band, Delay};

/// Largest deviation of a sweep from its expected time that is searched, either way, in s: a buffer of 4096 samples at 44.1 kHz, and
/// some more.
const REACH: f64 = 0.12;

/// Smallest correlation at which a sweep is recognised.
const LEAST: f64 = 0.7;

/// Smallest correlation accepted by the coarse search, whose segment contains neighbouring sweeps, so that
/// the correlation is small even without faults.
const COARSE: f64 = 0.4;

/// Number of sensors, the loudest ones, in the coarse search. The second is needed when a knock disturbs the
/// first; more take longer.
const LOUDEST: usize = 2;

/// Smallest energy of a sweep in the reference channel, relative to the loudest, with which the sweep counts as present.
const HEARD: f64 = 0.1;

/// Largest number of searches for a delay, each starting where the last one led. A delay that has not settled by then is left as it
/// is.
const STEPS: usize = 6;

/// Iterations that turn delays between pairs of sweeps into delays of sweeps.
const ROUNDS: usize = 200;

/// Deconvolved recordings of some sensors, each with all sweeps of one take, from which the sweeps' delays and tensions are found.
pub(super) struct Telling<'a> {
    /// For each sensor, the index of its own actuator.
    pub sensors: &'a [usize],
    /// For each sensor, its deconvolved recording, which is periodic.
    pub wholes: &'a [Vec<f64>],
    /// Sample of these recordings at which the response to each sweep begins, lead included.
    pub starts: &'a [usize],
    /// Number of samples before time 0 with which a response begins.
    pub lead: usize,
    /// Samples per second.
    pub rate: f64,
    /// The band in which responses are compared.
    pub band: Band,
    /// Shift of natural frequencies with tension or stiffness.
    pub law: &'a Law,
}

/// `length` samples of a periodic signal, from sample `first` on, which may be negative.
pub(super) fn around(whole: &[f64], first: i64, length: usize) -> Vec<f64> {
    let size = whole.len().max(1) as i64;
    (0..length as i64)
        .map(|i| whole.get((first + i).rem_euclid(size) as usize).copied().unwrap_or(0.0))
        .collect()
}

impl Telling<'_> {
    /// Delay and change of tension of each sweep relative to the responses of the same sensors in another
    /// take, `known[sensor][actuator][sample]` from time 0. `None` for a sweep that is not recognised.
    pub fn beside(&self, known: &[Vec<Vec<f64>>]) -> Vec<Option<Apart>> {
        let mut change = Change::Near(0.0);
        let one = |(sweep, start): (usize, &usize)| {
            let pairs: Vec<(&[f64], usize)> =
                known.iter().enumerate().filter_map(|(s, k)| Some((k.get(sweep)?.as_slice(), s))).collect();
            let found = self.compared(&pairs, (*start + self.lead) as i64, 0, change);
            change = change.after(found);
            found
        };
        self.starts.iter().enumerate().map(one).collect()
    }

    /// Delay and change of tension of each sweep relative to the others, for actuators whose sensors are recorded, by reciprocity:
    /// the response of sensor a to the sweep of actuator b equals that of b to the sweep of a, which is played at another time. A part
    /// common to all sweeps cannot be found.
    pub fn beside_each_other(&self, length: usize) -> Vec<Option<Apart>> {
        let count = self.sensors.len();
        let mut change = Change::Near(0.0);
        let mut pairs: Vec<(usize, usize, Apart)> = Vec::new();
        for i in 0..count {
            for j in i + 1..count {
                let [a, b] = [self.sensors[i], self.sensors[j]];
                let [from_a, from_b] = [a, b].map(|actuator| self.starts[actuator] as i64);
                let beside = |known: usize, at: i64, other: usize, near: i64| {
                    let known = around(&self.wholes[known], at, length);
                    self.compared(&[(&known, other)], near, self.lead, change)
                };
                // If the delay exceeds the length of a response, only the comparison in the other direction
                // finds it.
                let apart = beside(i, from_b, j, from_a).or_else(|| {
                    beside(j, from_a, i, from_b).map(|apart| Apart {
                        late: -apart.late,
                        change: -apart.change,
                        ..apart
                    })
                });
                change = change.after(apart);
                pairs.extend(apart.map(|apart| (i, j, apart)));
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

    /// Delay, in samples, of each sweep relative to the loudest one, from a loopback recording: one input that carries the sum of the sent
    /// signals, or one of them. `length` is the number of samples of the deconvolved recording that are compared. `None` for sweeps that
    /// the input does not carry.
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
            self.compared(&[(&cuts[loudest], 0)], *start as i64, self.lead, Change::None)
        };
        self.starts.iter().zip(&powers).map(one).collect()
    }

    /// Difference of known responses and those found around sample `at`, both with time 0 after `origin` samples; `None` if the
    /// correlation is too low.
    fn compared(&self, known: &[(&[f64], usize)], at: i64, origin: usize, change: Change) -> Option<Apart> {
        let mut whole = self.coarse(known, at)?;
        let mut best = None::<Apart>;
        for _ in 0..STEPS {
            let cut =
                |(known, sensor): &(&[f64], usize)| around(&self.wholes[*sensor], at + whole, known.len());
            let found: Vec<Vec<f64>> = known.iter().map(cut).collect();
            let pairs: Vec<(&[f64], &[f64])> =
                known.iter().zip(&found).map(|((k, _), f)| (*k, &f[..])).collect();
            let apart = agreed(Pairs::of(&pairs, origin, self.rate, self.band, self.law)?, change);
            best = Some(Apart { late: apart.late + whole as f64, ..apart });
            // A change of tension shifts the coarse delay: whole samples are removed until none is left.
            if apart.late.abs() < 1.0 {
                break;
            }
            whole += apart.late.round() as i64;
        }
        best.filter(|apart| apart.likeness >= LEAST)
    }

    /// Delay of the found responses in whole samples, by correlation; `None` if the correlation is too low.
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
        // The segment contains neighbouring sweeps too: the correlation is small even without faults.
        let best = found.max_by(|a, b| a.correlation.total_cmp(&b.correlation))?;
        (best.correlation >= COARSE).then(|| best.samples.round() as i64 - reach)
    }
}

/// Delay and change of tension common to all pairs; if the pairs do not agree, those of the majority,
/// without pairs that do not fit, such as those of a dead sensor.
fn agreed(pairs: Pairs<'_>, change: Change) -> Apart {
    let apart = pairs.apart(change);
    if apart.likeness >= LEAST {
        return apart;
    }
    let strange = pairs.strange(&apart, LEAST);
    pairs.without(&strange).map_or(apart, |others| others.apart(change))
}

/// Values of `count` items and their errors, from differences of pairs (the first item's value minus the
/// second's), each with its error: weighted least squares by damped Jacobi iterations, mean 0. `None` for
/// items in no pair.
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
                // Half of the step, so that two items that are only paired with each other do not oscillate.
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
