//! Felt levels of a modal field: modes filtered by the threshold of touch, then summed.

use crate::modal::{ModalField, STATES, add_to};
use crate::motion::Motion;
use crate::source::{Passage, Tally, Weighed};
use rayon::prelude::*;
use std::ops::Range;
use unripple_core::{Mixture, Observed};
use unripple_linalg::{Mat, product};

/// Number of values of filtered modes in memory at once, 128 MiB of them. With twice this value, twice the
/// memory and half the passes; results stay the same.
const HELD: usize = 1 << 25;

/// Threshold-weighted displacement of a modal field: the displacement of every mode is filtered over the
/// whole passage, then those modes that matter are summed at every point.
pub(crate) struct Feeling<'a> {
    field: &'a ModalField<'a>,
    passage: &'a Passage,
    /// Largest magnitude of every mode's shape over the points of the field, in 1/√kg.
    reach: Vec<f64>,
}

/// Threshold-weighted displacements of all modes over some samples.
struct Block {
    /// One row of samples per mode.
    rows: Vec<Vec<f32>>,
    /// Largest magnitude over the whole span of every mode's displacement, filtered by 1/threshold, in √kg.
    peaks: Vec<f64>,
}

impl<'a> Feeling<'a> {
    /// Prepares the computation of the threshold-weighted displacement of a field over the time span
    /// `passage`.
    pub fn of(field: &'a ModalField<'a>, passage: &'a Passage) -> Self {
        let mut own = vec![Vec::new(); field.points().len().div_ceil(field.points_at_once())];
        field.for_chunks(&mut own, |weights, own| {
            let largest = |m: usize| weights.col_as_slice(m).iter().fold(0.0, |r: f32, w| r.max(w.abs()));
            *own = (0..weights.ncols()).map(largest).collect();
        });
        let most = |m: usize| own.iter().map(|chunk: &Vec<f32>| f64::from(chunk[m])).fold(0.0, f64::max);
        Self { field, passage, reach: (0..field.read_modes()).map(most).collect() }
    }

    /// Computes the threshold-weighted displacement at every point, in units of the threshold.
    pub fn weighed(&self) -> Weighed {
        let span = &self.passage.span;
        let stride = (HELD / self.field.read_modes().max(1)).max(1);
        let chunks = self.field.points().chunks(self.field.points_at_once());
        let mut tallies: Vec<Tally> = chunks.map(|points| Tally::zeros(points.len())).collect();
        let mut snapshots = vec![Vec::new(); self.passage.instants.len()];
        let observed = Observed::here();
        observed.part(|| format!("as felt at {} points, {} samples", self.field.points().len(), span.len()));
        for start in span.clone().step_by(stride) {
            let part = start..span.end.min(start + stride);
            let block = self.block(&part);
            let most: Vec<f64> =
                block.peaks.iter().zip(&self.reach).map(|(peak, reach)| peak * reach).collect();
            let kept = kept(&most, self.passage.slack);
            let states = Mat::from_fn(kept.len(), part.len(), |m, i| block.rows[kept[m]][i]);
            drop(block);
            let instants: Vec<usize> =
                (0..snapshots.len()).filter(|i| part.contains(&self.passage.instants[*i])).collect();
            let then = Mat::from_fn(kept.len(), instants.len(), |m, i| {
                states[(m, self.passage.instants[instants[i]] - part.start)]
            });
            let mut read: Vec<(&mut Tally, Mat<f32>)> =
                tallies.iter_mut().map(|tally| (tally, Mat::zeros(0, 0))).collect();
            self.field.for_chunks(&mut read, |weights, (tally, values)| {
                let own = Mat::from_fn(weights.nrows(), kept.len(), |p, m| weights[(p, kept[m])]);
                add_to(tally, own.as_ref(), states.as_ref());
                *values = product(own.as_ref(), then.as_ref());
            });
            for (column, instant) in instants.into_iter().enumerate() {
                snapshots[instant] =
                    read.iter().flat_map(|(_, values)| values.col_as_slice(column)).copied().collect();
            }
            observed.done((part.end - span.start) as f64 / span.len() as f64);
        }
        let mut tally = Tally::default();
        for own in tallies {
            tally.peak.extend(own.peak);
            tally.squares.extend(own.squares);
        }
        Weighed { tally, snapshots }
    }

    /// Threshold-weighted displacement of every mode, over part of the span.
    fn block(&self, part: &Range<usize>) -> Block {
        let Passage { taken, span, weighting, .. } = self.passage;
        let modes = self.field.read_modes();
        // The motion of all modes is computed for each group of combinations, of which there are therefore few.
        let held = if self.field.mixture().is_some() { HELD } else { STATES };
        let together = (held / taken.len().max(1)).max(1);
        let mut block = Block { rows: Vec::with_capacity(modes), peaks: Vec::with_capacity(modes) };
        for first in (0..modes).step_by(together) {
            let traces = self.traces(first..modes.min(first + together));
            let weigh = |trace: &Vec<f64>| {
                let felt = weighting.weigh(trace);
                let at = |samples: &Range<usize>| samples.start - taken.start..samples.end - taken.start;
                let peak = felt[at(span)].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
                (felt[at(part)].iter().map(|x| *x as f32).collect::<Vec<f32>>(), peak)
            };
            let weighed: Vec<_> = traces.par_iter().map(weigh).collect();
            for (row, peak) in weighed {
                block.rows.push(row);
                block.peaks.push(peak);
            }
        }
        block
    }

    /// Displacement of some of the shapes that are read out over the samples of the passage, one row per shape.
    fn traces(&self, modes: Range<usize>) -> Vec<Vec<f64>> {
        let taken = &self.passage.taken;
        if let Some(mixture) = self.field.mixture() {
            let some = Mixture { mixing: mixture.mixing.subrows(modes.start, modes.len()), ..mixture };
            return self.mixed(&some);
        }
        let mut traces = vec![Vec::with_capacity(taken.len()); modes.len()];
        let mut motion = Motion::of(self.field.responses, self.field.drive, modes);
        motion.skip_to(taken.start, self.field.samples_at_once());
        while motion.next() < taken.end {
            let count = (taken.end - motion.next()).min(self.field.samples_at_once());
            motion.advance(count, |displacement, _| {
                traces.iter_mut().zip(displacement).for_each(|(trace, u)| trace.push(*u));
            });
        }
        traces
    }

    /// Displacement of combinations over the samples of the passage, one row per shape of their base.
    fn mixed(&self, mixture: &Mixture) -> Vec<Vec<f64>> {
        let (taken, at_once) = (&self.passage.taken, self.field.samples_at_once());
        let mut traces = vec![Vec::with_capacity(taken.len()); mixture.mixing.nrows()];
        let mut motion = Motion::new(self.field.responses, self.field.drive);
        motion.skip_to(taken.start, at_once);
        while motion.next() < taken.end {
            let count = (taken.end - motion.next()).min(at_once);
            let [_, displacement] = motion.states(count);
            let read = mixture.of_base(displacement.as_ref());
            for (m, trace) in traces.iter_mut().enumerate() {
                trace.extend((0..count).map(|i| read[(m, i)]));
            }
        }
        traces
    }
}

/// Indices of the modes that matter, ascending, from the largest magnitude of each at any point and time. The
/// magnitudes of the modes left out add up to at most `slack`, which bounds the error.
fn kept(most: &[f64], slack: f64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..most.len()).collect();
    order.sort_by(|a, b| most[*a].total_cmp(&most[*b]));
    let mut sum = 0.0;
    let dropped = order.iter().take_while(|m| {
        sum += most[**m];
        sum <= slack
    });
    let mut kept = order[dropped.count()..].to_vec();
    kept.sort_unstable();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_out_adds_up_to_the_slack_at_most() {
        let most = [3.0, 0.25, 0.0, 0.5, 7.0, 0.5];
        assert_eq!(kept(&most, 0.0), [0, 1, 3, 4, 5]);
        assert_eq!(kept(&most, 0.3), [0, 3, 4, 5]);
        assert_eq!(kept(&most, 1.25), [0, 4]);
        assert_eq!(kept(&most, 100.0), [0; 0]);
        assert_eq!(kept(&[], 1.0), [0; 0]);
    }
}
