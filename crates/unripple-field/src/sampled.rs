//! The field at the points of a library, by convolution.

use crate::source::{Passage, Quantity, Source, Survey, Tally, Trace, Weighed};
use crate::spot::Spot;
use crate::{FieldError, spot};
use rayon::prelude::*;
use std::collections::HashMap;
use std::f64::consts::PI;
use std::ops::Range;
use unripple_core::{Drive, Point, SampledResponses};
use unripple_dsp::{Convolver, integral};

/// The field at the points of a library of responses, by convolution with each.
///
/// Displacement is the convolution with each response's integral from its first sample, to sixth order in the sample
/// interval: within 0.3 % of the wave at an eighth of the sample rate, 0.004 % at a sixteenth. Nothing is filtered: a
/// constant error of stored responses grows into a drift of the displacement.
#[derive(Debug)]
pub(crate) struct SampledField<'a> {
    responses: &'a SampledResponses,
    drive: &'a Drive,
}

impl<'a> SampledField<'a> {
    /// The field of sampled responses under a drive.
    pub fn new(responses: &'a SampledResponses, drive: &'a Drive) -> Self {
        Self { responses, drive }
    }

    /// Index of the stored point used for a place: the nearest, at most λ_min/4 away.
    fn index(&self, place: Point) -> Result<usize, FieldError> {
        let reach = self.responses.conditions.lambda_min / 4.0;
        let stored = self.responses.nearest(place).ok_or(FieldError::Count {
            what: "points with responses",
            expected: "at least 1".to_owned(),
            found: 0,
        })?;
        let nearest = self.responses.points[stored];
        let distance = nearest.distance(place);
        if distance <= reach || distance == 0.0 {
            Ok(stored)
        } else {
            Err(FieldError::Unknown { at: place, nearest, distance, reach })
        }
    }

    /// The mean trace over a set of places.
    fn mean(&self, set: &[Point], player: &Player<'_>) -> Trace {
        let indices: Vec<usize> = set.iter().filter_map(|p| self.index(*p).ok()).collect();
        let traces: Vec<Trace> = indices.par_iter().map(|i| player.play(*i)).collect();
        let mean = |quantity| {
            let length = player.range.len();
            let sum = |i: usize| traces.iter().map(|t| t.of(quantity)[i]).sum::<f64>();
            (0..length).map(|i| sum(i) / traces.len().max(1) as f64).collect()
        };
        Trace { velocity: mean(Quantity::Velocity), displacement: mean(Quantity::Displacement) }
    }

    /// The spot diameter around a place (m), by a fit to the library's points.
    fn spot(&self, at: Point, player: &Player<'_>, quantity: Quantity) -> Option<f64> {
        let wavelength = self.responses.conditions.lambda_min;
        let value = |i: usize| player.play(i).of(quantity).first().copied();
        let middle = self.index(at).ok()?;
        let top = value(middle).filter(|top| *top != 0.0)?;
        let centre = self.responses.points[middle];
        let distance = |i: usize| self.responses.points[i].distance(centre);
        let mut near: Vec<usize> =
            (0..self.responses.points.len()).filter(|i| distance(*i) <= 8.0 * wavelength).collect();
        near.sort_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        let values: Vec<(f64, f64)> =
            near.par_iter().filter_map(|&i| Some((distance(i), value(i)? / top))).collect();
        spot::fitted_diameter(&values, wavelength)
    }
}

impl Source for SampledField<'_> {
    fn points(&self) -> &[Point] {
        &self.responses.points
    }

    fn locate(&self, place: Point) -> Result<Point, FieldError> {
        let outline = &self.responses.conditions.outline;
        if !outline.contains(place) {
            return Err(FieldError::Outside { at: place, nearest: outline.nearest(place) });
        }
        self.index(place).map(|stored| self.responses.points[stored])
    }

    /// Responses of L samples determine the field until L samples after the first non-zero sample of the
    /// drive.
    fn known(&self) -> usize {
        let sounds = |i: &usize| self.drive.channels().iter().any(|channel| channel[*i] != 0.0);
        let begins = (0..self.drive.samples()).find(sounds).unwrap_or(self.drive.samples());
        begins + self.responses.samples()
    }

    fn traces(&self, sets: &[Vec<Point>], range: Range<usize>) -> Vec<Trace> {
        let player = Player::plan(self, range);
        sets.iter().map(|set| self.mean(set, &player)).collect()
    }

    fn survey(&self, segments: &[Range<usize>], instants: &[usize]) -> Survey {
        let wanted = segments.iter().cloned().chain(instants.iter().map(|i| *i..i + 1));
        let whole = wanted.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end)).unwrap_or(0..0);
        let player = Player::plan(self, whole.clone());
        let quantities = [Quantity::Velocity, Quantity::Displacement];
        let of_point = |point: usize| {
            let trace = player.play(point);
            let tally = |range: &Range<usize>, quantity| {
                let values = &trace.of(quantity)[range.start - whole.start..range.end - whole.start];
                let peak = values.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
                (peak as f32, values.iter().map(|x| x * x).sum::<f64>())
            };
            let tallies: Vec<_> = segments.iter().map(|range| quantities.map(|q| tally(range, q))).collect();
            let values: Vec<_> =
                instants.iter().map(|i| quantities.map(|q| trace.of(q)[i - whole.start] as f32)).collect();
            (tallies, values)
        };
        let points: Vec<_> = (0..self.responses.points.len()).into_par_iter().map(of_point).collect();
        let tally = |segment: usize, quantity: usize| Tally {
            peak: points.iter().map(|(tallies, _)| tallies[segment][quantity].0).collect(),
            squares: points.iter().map(|(tallies, _)| tallies[segment][quantity].1).collect(),
        };
        let values =
            |i: usize, quantity: usize| points.iter().map(|(_, values)| values[i][quantity]).collect();
        Survey {
            tallies: (0..segments.len()).map(|s| [tally(s, 0), tally(s, 1)]).collect(),
            snapshots: (0..instants.len()).map(|i| [values(i, 0), values(i, 1)]).collect(),
        }
    }

    /// The surface is assumed to be at rest after the end of the responses.
    fn weighed(&self, passage: &Passage) -> Weighed {
        let Passage { taken, span, instants, weighting, .. } = passage;
        let player = Player::plan(self, taken.clone());
        let of_point = |point: usize| {
            let felt = weighting.weigh(&player.moved(point));
            let within = &felt[span.start - taken.start..span.end - taken.start];
            let peak = within.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            let values: Vec<f32> = instants.iter().map(|i| felt[i - taken.start] as f32).collect();
            (peak as f32, within.iter().map(|x| x * x).sum::<f64>(), values)
        };
        let points: Vec<_> = (0..self.responses.points.len()).into_par_iter().map(of_point).collect();
        Weighed {
            tally: Tally {
                peak: points.iter().map(|point| point.0).collect(),
                squares: points.iter().map(|point| point.1).collect(),
            },
            snapshots: (0..instants.len()).map(|i| points.iter().map(|point| point.2[i]).collect()).collect(),
        }
    }

    fn under(&self, _contacts: &[&[(Point, f64)]]) -> Option<Vec<Vec<f64>>> {
        None
    }

    fn spots(&self, requests: &[(Point, usize, Quantity)]) -> Vec<Spot> {
        let mut players = HashMap::new();
        let spot = |(at, sample, quantity): &(Point, usize, Quantity)| {
            let player = players.entry(*sample).or_insert_with(|| Player::plan(self, *sample..sample + 1));
            let diameter = self.spot(*at, player, *quantity);
            Spot { diameter, area: diameter.map(|width| PI / 4.0 * width * width), offset: None }
        };
        requests.iter().map(spot).collect()
    }
}

/// A drive prepared for convolution with the responses of many points, over one range of samples.
struct Player<'a> {
    responses: &'a SampledResponses,
    range: Range<usize>,
    /// First sample of the drive that affects the range.
    first: usize,
    plan: Convolver,
    /// Spectrum of each channel, divided by the rate.
    sent: Vec<Vec<Complex>>,
}

type Complex = unripple_dsp::Complex<f64>;

impl<'a> Player<'a> {
    /// Prepares the drive for the motion over a range of samples.
    fn plan(field: &SampledField<'a>, range: Range<usize>) -> Self {
        let length = field.responses.samples();
        let first = (range.start + 1).saturating_sub(length).min(field.drive.samples());
        let end = range.end.min(field.drive.samples()).max(first);
        // What wraps round must fall before the range.
        let tail = (end + length).saturating_sub(range.start);
        let plan = Convolver::new(tail.max(range.end - first));
        let rate = field.drive.rate();
        let spectrum = |channel: &Vec<f64>| plan.spectrum(channel[first..end].iter().map(|d| d / rate));
        let sent = field.drive.channels().iter().map(spectrum).collect();
        Self { responses: field.responses, range, first, plan, sent }
    }

    /// The trace of one stored point over the range.
    fn play(&self, point: usize) -> Trace {
        let velocity = self.sum(point, |response| response.iter().map(|h| f64::from(*h)).collect());
        Trace { velocity, displacement: self.moved(point) }
    }

    /// The displacement of one stored point over the range.
    fn moved(&self, point: usize) -> Vec<f64> {
        self.sum(point, |response| integral(response, self.responses.conditions.rate))
    }

    /// The sum over actuators of the drive convolved with a signal that `made` computes from each response of one
    /// stored point, over the range.
    fn sum(&self, point: usize, made: impl Fn(&[f32]) -> Vec<f64>) -> Vec<f64> {
        let mut sum = vec![Complex::default(); self.plan.size() / 2 + 1];
        for (actuator, sent) in self.sent.iter().enumerate() {
            let own = self.plan.spectrum(made(self.responses.response(actuator, point)));
            sum.iter_mut().zip(sent).zip(own).for_each(|((sum, d), h)| *sum += d * h);
        }
        let signal = self.plan.signal(sum);
        signal[self.range.start - self.first..self.range.end - self.first].to_vec()
    }
}
