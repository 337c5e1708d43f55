//! Check of wires by the reciprocity of responses between actuators, without a model of the surface.

use unripple_dsp::rms;

/// Error of reciprocity above which wires are suspected: noise at 20 dB leaves 0.14, and with half the limit recordings as noisy as
/// that would be suspected.
const SUSPECT: f64 = 0.3;

/// Largest share of the error that may remain after an exchange of wires for the exchange to be reported as
/// the fault: if more remains, it explains less than half of the error.
const LEFT: f64 = 0.5;

/// Result of a check of wires by reciprocity.
#[derive(Clone, Debug, PartialEq)]
pub struct Reciprocal {
    /// Rms difference between the two directions of a pair, relative to the rms of the responses, over all
    /// pairs, whatever the gains and signs of the channels; 0 with fewer than two actuators.
    pub error: f64,
    /// Faults, one sentence each: sensors swapped, with each other or with a spare input, reversed, or recording something else.
    pub faults: Vec<String>,
}

/// Responses of all channels, the first of which belong to the actuators' sensors.
struct Heard<'a> {
    /// `[channel][drive][sample]`, sensors first.
    channels: Vec<&'a [Vec<f64>]>,
    actuators: usize,
}

/// Checks the wires of the actuators `names` by reciprocity, without a model. `heard[sensor][drive]` are responses; `spare` are other
/// inputs by name that recorded the same drives, such as a probe at any place.
///
/// h_ab = h_ba up to one factor for each actuator, the ratio of its gains as drive and as sensor. Swapped
/// sensors violate this for all their pairs, and so does an input that records something else; a reversed
/// sensor shows in the signs. It cannot be distinguished whether an output or a sensor is at fault, and an
/// actuator both of whose wires are swapped with another's is not detected.
///
/// ```
/// # let noise = |seed: u64| -> Vec<f64> {
/// #     let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
/// #     (0..2000).map(|_| { state ^= state << 13; state ^= state >> 7; state ^= state << 17;
/// #         (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0 }).collect() };
/// let names = ["a", "b", "c", "d"].map(String::from);
/// // Reciprocal responses: the same for each pair of places, whoever drives.
/// let between = |a: u64, b: u64| noise(1 + a.min(b) * 10 + a.max(b));
/// let mut heard: Vec<Vec<Vec<f64>>> = (0..4).map(|s| (0..4).map(|d| between(s, d)).collect()).collect();
/// let right = unripple_devices::reciprocal(&names, &heard, &[]);
/// assert!(right.error < 1e-6 && right.faults.is_empty());
/// heard.swap(1, 3);
/// let wrong = unripple_devices::reciprocal(&names, &heard, &[]);
/// assert_eq!(wrong.faults, ["the sensors of `b` and `d` are swapped, or their outputs"]);
/// ```
pub fn reciprocal(
    names: &[String],
    heard: &[Vec<Vec<f64>>],
    spare: &[(String, Vec<Vec<f64>>)],
) -> Reciprocal {
    let actuators = names.len().min(heard.len());
    let channels = heard[..actuators].iter().map(Vec::as_slice);
    let heard = Heard {
        channels: channels.chain(spare.iter().map(|(_, rows)| rows.as_slice())).collect(),
        actuators,
    };
    let straight: Vec<usize> = (0..actuators).collect();
    let error = heard.error(&straight, None);
    if error <= SUSPECT {
        return Reciprocal { error, faults: heard.reversed(names) };
    }
    let faults = heard.suspect(names, spare, error).into_iter().collect();
    Reciprocal { error, faults }
}

impl Heard<'_> {
    /// Correlation of both directions between two actuators, their sensors being the channels `rows`.
    fn correlation(&self, rows: &[usize], a: usize, b: usize) -> f64 {
        let empty = Vec::new();
        let of = |row: usize, drive: usize| self.channels[rows[row]].get(drive).unwrap_or(&empty);
        let (forth, back) = (of(b, a), of(a, b));
        let both: f64 = forth.iter().zip(back).map(|(x, y)| x * y).sum();
        let power = rms(forth) * rms(back) * forth.len().max(1) as f64;
        if power > 0.0 { both / power } else { 0.0 }
    }

    /// Error of reciprocity over all actuators, or over all but one.
    fn error(&self, rows: &[usize], without: Option<usize>) -> f64 {
        let taken: Vec<usize> = (0..self.actuators).filter(|a| Some(*a) != without).collect();
        let pairs = taken.iter().enumerate().flat_map(|(i, a)| taken[i + 1..].iter().map(move |b| (*a, *b)));
        let (sum, count) = pairs
            .fold((0.0, 0.0), |(sum, count), (a, b)| (sum + self.correlation(rows, a, b).abs(), count + 1.0));
        if count > 0.0 { (2.0 * (1.0 - sum / count)).max(0.0).sqrt() } else { 0.0 }
    }

    /// The one exchange of wires, or the one wrong input, that explains most of an error.
    fn suspect(&self, names: &[String], spare: &[(String, Vec<Vec<f64>>)], error: f64) -> Option<String> {
        let straight: Vec<usize> = (0..self.actuators).collect();
        let mut found: Vec<(f64, String)> = Vec::new();
        for a in 0..self.actuators {
            for b in a + 1..self.actuators {
                let mut rows = straight.clone();
                rows.swap(a, b);
                let said =
                    format!("the sensors of `{}` and `{}` are swapped, or their outputs", names[a], names[b]);
                found.push((self.error(&rows, None), said));
            }
            for (i, (other, _)) in spare.iter().enumerate() {
                let mut rows = straight.clone();
                rows[a] = self.actuators + i;
                found.push((
                    self.error(&rows, None),
                    format!("inputs `{}` and `{other}` are swapped", names[a]),
                ));
            }
        }
        let least = |found: Vec<(f64, String)>| {
            let good = found.into_iter().filter(|(left, _)| *left <= LEFT * error);
            good.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, said)| said)
        };
        // With fewer than four actuators, too few pairs are left to find the one that is wrong.
        least(found).or_else(|| {
            let all = names.iter().enumerate().take(self.actuators).filter(|_| self.actuators > 3);
            let alone = all.map(|(a, name)| {
                let said = format!("input `{name}` does not carry the signal of the sensor of `{name}`");
                (self.error(&straight, Some(a)), said)
            });
            least(alone.collect())
        })
    }

    /// Actuators whose sign differs from that of the others, in words.
    fn reversed(&self, names: &[String]) -> Vec<String> {
        let rows: Vec<usize> = (0..self.actuators).collect();
        let mut signs = vec![1.0; self.actuators];
        for _ in 0..2 * self.actuators {
            let before = signs.clone();
            for a in 0..self.actuators {
                let others = (0..self.actuators).filter(|b| *b != a);
                let sum: f64 = others.map(|b| signs[b] * self.correlation(&rows, a, b)).sum();
                signs[a] = if sum < 0.0 { -1.0 } else { 1.0 };
            }
            if signs == before {
                break;
            }
        }
        let negative: Vec<usize> = (0..self.actuators).filter(|a| signs[*a] < 0.0).collect();
        let fewer = match 2 * negative.len() > self.actuators {
            true => (0..self.actuators).filter(|a| !negative.contains(a)).collect(),
            false => negative,
        };
        if let ([_], [one, other]) = (&fewer[..], names) {
            return vec![format!("the output or the sensor of `{one}` or of `{other}` is reversed")];
        }
        fewer.iter().map(|a| format!("the output or the sensor of `{}` is reversed", names[*a])).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Noise that is the same for each pair of places, whoever drives; channels have gains of their own.
    fn surface(count: usize, seed: u64) -> Vec<Vec<Vec<f64>>> {
        let noise = |key: u64| {
            let mut state = (seed.wrapping_mul(31) + key + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
            let next = |_| {
                state ^= state << 13;
                state ^= state >> 7;
                state ^= state << 17;
                (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
            };
            (0..1500).map(next).collect::<Vec<f64>>()
        };
        let gain = |s: usize, d: usize| (1.0 + 0.3 * s as f64) * (2.0 - 0.1 * d as f64);
        let response = |s: usize, d: usize| -> Vec<f64> {
            let base = noise((s.min(d) * 100 + s.max(d)) as u64);
            let own = noise((10_000 + s * 100 + d) as u64);
            base.iter().zip(own).map(|(x, n)| gain(s, d) * (x + 0.05 * n)).collect()
        };
        (0..count).map(|s| (0..count).map(|d| response(s, d)).collect()).collect()
    }

    fn names(count: usize) -> Vec<String> {
        (0..count).map(|i| format!("a{}", i + 1)).collect()
    }

    #[test]
    fn one_fault_is_named_and_none_is_not() {
        for (count, a, b, seed) in [(4, 0, 3, 1), (5, 4, 4, 2), (6, 2, 1, 3), (8, 7, 0, 4), (8, 3, 5, 5)] {
            let names = names(count);
            let right = surface(count, seed);
            let found = reciprocal(&names, &right, &[]);
            assert!(found.faults.is_empty() && found.error < 0.15, "{:?}", found);

            let mut reversed = right.clone();
            reversed[a].iter_mut().flatten().for_each(|x| *x = -*x);
            let found = reciprocal(&names, &reversed, &[]);
            assert_eq!(found.faults, [format!("the output or the sensor of `a{}` is reversed", a + 1)]);

            let mut elsewhere = right.clone();
            elsewhere[a] = surface(2 * count, seed ^ 77)[2 * count - 1][..count].to_vec();
            let found = reciprocal(&names, &elsewhere, &[]);
            assert_eq!(
                &found.faults,
                &[format!("input `a{0}` does not carry the signal of the sensor of `a{0}`", a + 1)]
            );
            let probe = [("probe".to_owned(), right[a].clone())];
            let found = reciprocal(&names, &elsewhere, &probe);
            assert_eq!(&found.faults, &[format!("inputs `a{}` and `probe` are swapped", a + 1)]);

            if a != b {
                let mut swapped = right;
                swapped.swap(a, b);
                let found = reciprocal(&names, &swapped, &[]);
                let (low, high) = (a.min(b) + 1, a.max(b) + 1);
                let said = format!("the sensors of `a{low}` and `a{high}` are swapped, or their outputs");
                assert_eq!(&found.faults, &[said]);
            }
        }
    }

    #[test]
    fn few_or_silent_ones_tell_nothing() {
        assert_eq!(reciprocal(&[], &[], &[]), Reciprocal { error: 0.0, faults: vec![] });
        let one = reciprocal(&names(1), &surface(1, 3), &[]);
        assert_eq!(one, Reciprocal { error: 0.0, faults: vec![] });
        let silent = reciprocal(&names(3), &vec![vec![vec![0.0; 9]; 3]; 3], &[]);
        assert!(silent.faults.is_empty() && silent.error > 1.0);
        let mut two = surface(2, 5);
        two[1].iter_mut().flatten().for_each(|x| *x = -*x);
        assert_eq!(
            reciprocal(&names(2), &two, &[]).faults,
            ["the output or the sensor of `a1` or of `a2` is reversed"]
        );
    }
}
