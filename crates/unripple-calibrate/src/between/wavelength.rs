//! The wavelength of measured responses, from how they correlate in space.

use super::bessel::Bessel;
use crate::CalibrateError;
use crate::signals::line;
use std::f64::consts::TAU;
use unripple_core::{Point, SampledResponses};
use unripple_dsp::median;

/// First zero of the Bessel function J0: the correlation of a diffuse field vanishes first at this argument.
const FIRST_ZERO: f64 = 2.404_825_557_695_773;

/// Lower edge of the band that is evaluated, relative to its upper edge: the wavelength varies by a tenth at most within it, and there are
/// some ten times as many modes as it takes for a mean.
const NARROW: f64 = 0.9;

/// Number of groups of frequencies, each of which is left out in turn to find the error.
const GROUPS: usize = 6;

/// Largest number of frequencies and of points that are evaluated: more do not make the error smaller, since modes limit it.
const MOST_HZ: usize = 30;
const MOST_POINTS: usize = 100;

/// Least number of points: 66 distances.
const LEAST_POINTS: usize = 12;

/// Number of classes of distances over that of neighbouring points.
const CLASSES: f64 = 4.0;

/// Longest distance that is evaluated, over that of neighbouring points.
const FAR: f64 = 12.0;

/// Shortest wavelength that is searched, over the distance of neighbouring points: shorter ones cannot be told from longer ones.
const SHORTEST: f64 = 1.2;

/// Number of wavelengths that are tried, in equal ratios.
const TRIED: usize = 400;

/// Least share of the variance of the correlation that a diffuse field has to explain, and largest error relative to the wavelength.
const EXPLAINED: f64 = 0.6;
const VAGUE: f64 = 0.15;

/// A wavelength that was found from how responses correlate in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wavelength {
    /// The wavelength, in m.
    pub metres: f64,
    /// Its standard error, in m.
    pub error: f64,
    /// Middle of the frequencies that it holds for, in Hz.
    pub hz: f64,
    /// Distance in m at which the correlation vanishes first.
    pub first_zero: f64,
}

/// The wavelength at the top of the band of measured responses, from their correlation in space; `None` where too few points, or a
/// correlation that is not that of a diffuse field of one wavelength, do not tell it.
///
/// The correlation over frequencies and actuators, C(r) = Re Σ H* H' / √(Σ|H|² Σ|H'|²), is averaged over classes of distances r and compared
/// with J0(2πr/λ), of which the λ that explains most of its variance is taken. The standard error is that of a jackknife over
/// groups of frequencies.
///
/// Source: R. K. Cook et al., J. Acoust. Soc. Am. 27, 1072 (1955), in two dimensions.
///
/// # Errors
/// [`CalibrateError::Core`] if the responses cannot be selected.
pub fn wavelength(responses: &SampledResponses) -> Result<Option<Wavelength>, CalibrateError> {
    if responses.points.len() < LEAST_POINTS {
        return Ok(None);
    }
    let responses = responses.select(&central(&responses.points))?;
    let points = &responses.points;
    let apart = |a: usize, b: usize| points[a].distance(points[b]);
    let count = points.len();
    let others = |a: usize| (0..count).filter(move |b| *b != a);
    let neighbour = |a: usize| others(a).map(|b| apart(a, b)).fold(f64::INFINITY, f64::min);
    let Some(next) = median((0..count).map(neighbour)).filter(|next| *next > 0.0) else { return Ok(None) };
    let extent = (0..count).flat_map(|a| others(a).map(move |b| apart(a, b))).fold(0.0, f64::max);
    let far = (extent / 2.0).min(FAR * next);
    let top = responses.conditions.band[1].min(responses.conditions.rate / 2.0);
    let spectra = Spectra::of(&responses, top);
    let Some(hz) = spectra.middle() else { return Ok(None) };
    let pairs: Vec<(usize, usize, f64)> = (0..count)
        .flat_map(|a| (0..a).map(move |b| (a, b)))
        .map(|(a, b)| (a, b, apart(a, b)))
        .filter(|(.., r)| *r <= far)
        .collect();
    let classes = Classes::of(&pairs, next / CLASSES);
    let (shortest, longest) = (SHORTEST * next, TAU / FIRST_ZERO * far);
    if shortest >= longest {
        return Ok(None);
    }
    let bessel = Bessel::up_to(TAU * (far + next) / shortest);
    let tried: Vec<f64> =
        (0..TRIED).map(|i| shortest * (longest / shortest).powf(i as f64 / (TRIED - 1) as f64)).collect();
    let best = |without: Option<usize>| classes.best(&spectra.correlations(&pairs, without), &tried, &bessel);
    let (metres, explained) = best(None);
    let logs: Vec<f64> = (0..spectra.groups.len()).map(|group| best(Some(group)).0.ln()).collect();
    let groups = logs.len() as f64;
    let mean = logs.iter().sum::<f64>() / groups;
    let scatter: f64 = logs.iter().map(|log| (log - mean).powi(2)).sum();
    // Half a step of the wavelengths that are tried is the least error.
    let step = (longest / shortest).ln() / (2.0 * (TRIED - 1) as f64);
    let error = metres * ((groups - 1.0) / groups * scatter).sqrt().max(step);
    let at_end = metres <= tried[1] || metres >= tried[TRIED - 2];
    let clear = explained >= EXPLAINED && error <= VAGUE * metres && !at_end;
    Ok(clear.then_some(Wavelength { metres, error, hz, first_zero: FIRST_ZERO / TAU * metres }))
}

/// Indices of the points (m) whose responses [`wavelength()`] looks at: the 100 nearest to the middle of all, the nearest first.
///
/// ```
/// use unripple_core::Point;
/// let line: Vec<Point> = (0..5).map(|i| Point::from_mm(f64::from(i), 0.0)).collect();
/// assert_eq!(unripple_calibrate::central(&line)[0], 2);
/// ```
pub fn central(points: &[Point]) -> Vec<usize> {
    let mean = |of: fn(&Point) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let middle = Point::new(mean(|p| p.x), mean(|p| p.y));
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| points[*a].distance(middle).total_cmp(&points[*b].distance(middle)));
    order.truncate(MOST_POINTS);
    order
}

/// Spectra at some frequencies, in groups.
struct Spectra {
    hz: Vec<f64>,
    /// Real and imaginary part, `[group][point][frequency and actuator]`.
    groups: Vec<Vec<Vec<[f64; 2]>>>,
}

impl Spectra {
    /// Spectra of responses below a frequency `top` in Hz.
    fn of(responses: &SampledResponses, top: f64) -> Self {
        let rate = responses.conditions.rate;
        // What is longer than the lines need tells no more of them.
        let needed = MOST_HZ as f64 * rate / ((1.0 - NARROW) * top);
        let samples = responses.samples().min(needed.ceil() as usize);
        // Lines of a record are independent at the inverse of its length.
        let lines = ((1.0 - NARROW) * top * samples as f64 / rate) as usize;
        let lines = lines.min(MOST_HZ);
        let hz: Vec<f64> = (0..lines)
            .map(|line| top * (NARROW + (1.0 - NARROW) * (line as f64 + 0.5) / lines as f64))
            .collect();
        let groups = hz.chunks(lines.div_ceil(GROUPS).max(1));
        let spectra = |group: &[f64]| {
            let point = |point: usize| {
                let one = |actuator: usize| {
                    let response = &responses.response(actuator, point)[..samples];
                    group.iter().map(move |hz| line(response.iter().map(|x| f64::from(*x)), hz / rate))
                };
                (0..responses.ports.len()).flat_map(one).collect()
            };
            (0..responses.points.len()).map(point).collect()
        };
        let groups = groups.map(spectra).collect();
        Self { hz, groups }
    }

    /// Middle of the frequencies; `None` if they are too few for groups.
    fn middle(&self) -> Option<f64> {
        (self.groups.len() >= GROUPS / 2).then(|| self.hz.iter().sum::<f64>() / self.hz.len() as f64)
    }

    /// Correlation of the points of each pair over all groups but one; 0 where a point is at rest.
    fn correlations(&self, pairs: &[(usize, usize, f64)], without: Option<usize>) -> Vec<f64> {
        let groups = || self.groups.iter().enumerate().filter(move |(group, _)| Some(*group) != without);
        let product = |a: usize, b: usize| -> f64 {
            let of = |group: &Vec<Vec<[f64; 2]>>| {
                let both = group[a].iter().zip(&group[b]);
                both.map(|([x, y], [u, v])| x * u + y * v).sum::<f64>()
            };
            groups().map(|(_, group)| of(group)).sum()
        };
        let count = self.groups.first().map_or(0, Vec::len);
        let powers: Vec<f64> = (0..count).map(|a| product(a, a)).collect();
        pairs
            .iter()
            .map(|(a, b, _)| {
                let power = (powers[*a] * powers[*b]).sqrt();
                if power > 0.0 { product(*a, *b) / power } else { 0.0 }
            })
            .collect()
    }
}

/// Classes of distances of pairs of points.
struct Classes {
    /// Class of each pair.
    of: Vec<usize>,
    /// Number of pairs and mean distance (m) of each class.
    all: Vec<(f64, f64)>,
}

impl Classes {
    /// Classes of a width in m.
    fn of(pairs: &[(usize, usize, f64)], width: f64) -> Self {
        let of: Vec<usize> = pairs.iter().map(|(.., r)| (r / width) as usize).collect();
        let mut all = vec![(0.0, 0.0); of.iter().max().map_or(0, |most| most + 1)];
        for (class, (.., r)) in of.iter().zip(pairs) {
            all[*class] = (all[*class].0 + 1.0, all[*class].1 + r);
        }
        all.iter_mut().filter(|(count, _)| *count > 0.0).for_each(|(count, r)| *r /= *count);
        Self { of, all }
    }

    /// The wavelength (m) of which a diffuse field explains most of these correlations of pairs, and the share of their variance, negative
    /// for the opposite sign.
    fn best(&self, correlations: &[f64], tried: &[f64], bessel: &Bessel) -> (f64, f64) {
        let mut means = vec![0.0; self.all.len()];
        self.of.iter().zip(correlations).for_each(|(class, c)| means[*class] += c);
        let share = |wavelength: f64| {
            let (mut cj, mut jj, mut cc) = (0.0, 0.0, 0.0);
            for ((count, r), sum) in self.all.iter().zip(&means).filter(|((count, _), _)| *count > 0.0) {
                let (c, j) = (sum / count, bessel.ring(TAU * r / wavelength));
                (cj, jj, cc) = (cj + count * c * j, jj + count * j * j, cc + count * c * c);
            }
            if jj * cc > 0.0 { cj * cj.abs() / (jj * cc) } else { 0.0 }
        };
        let shares = tried.iter().map(|wavelength| (*wavelength, share(*wavelength)));
        shares.fold((0.0, f64::NEG_INFINITY), |best, one| if one.1 > best.1 { one } else { best })
    }
}
