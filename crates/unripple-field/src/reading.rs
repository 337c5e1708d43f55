//! Evaluation of the field of a modal system: traces, surveys, felt levels, focal spots.

use crate::contact::summed;
use crate::feeling::Feeling;
use crate::modal::{ModalField, State, add_to};
use crate::motion::Motion;
use crate::source::{Passage, Quantity, Source, Survey, Tally, Trace, Weighed};
use crate::spot::{Around, Spot};
use crate::{FieldError, spot};
use rayon::prelude::*;
use std::ops::Range;
use unripple_core::{Observed, Point};
use unripple_linalg::{Mat, product};

/// Largest number of samples from the start of a drive: 7 minutes at 48 kHz. Twice as many: 14 minutes.
const MOST_SAMPLES: usize = 20_000_000;

impl Source for ModalField<'_> {
    fn points(&self) -> &[Point] {
        &self.kept.points
    }

    fn locate(&self, place: Point) -> Result<Point, FieldError> {
        let outline = &self.responses.conditions.outline;
        if outline.contains(place) {
            return Ok(place);
        }
        Err(FieldError::Outside { at: place, nearest: outline.nearest(place) })
    }

    fn known(&self) -> usize {
        MOST_SAMPLES
    }

    fn traces(&self, sets: &[Vec<Point>], range: Range<usize>) -> Vec<Trace> {
        let mean = |set: &Vec<Point>| -> Vec<(Point, f64)> {
            set.iter().map(|point| (*point, 1.0 / set.len() as f64)).collect()
        };
        let sets: Vec<Vec<(Point, f64)>> = sets.iter().map(mean).collect();
        let contacts: Vec<&[(Point, f64)]> = sets.iter().map(Vec::as_slice).collect();
        let weights = summed(self.responses.shapes.as_ref(), &contacts);
        let mut traces = vec![Trace::default(); sets.len()];
        let mut motion = Motion::new(self.responses, self.drive);
        motion.skip_to(range.start, self.samples_at_once());
        while motion.next() < range.end {
            let count = (range.end - motion.next()).min(self.samples_at_once());
            let [velocity, displacement] =
                motion.states(count).map(|states| product(weights.as_ref(), states.as_ref()));
            for (row, trace) in traces.iter_mut().enumerate() {
                trace.velocity.extend((0..count).map(|i| velocity[(row, i)]));
                trace.displacement.extend((0..count).map(|i| displacement[(row, i)]));
            }
        }
        traces
    }

    fn survey(&self, segments: &[Range<usize>], instants: &[usize]) -> Survey {
        let chunk =
            |points: &[Point]| vec![[Tally::zeros(points.len()), Tally::zeros(points.len())]; segments.len()];
        let mut tallies: Vec<Vec<[Tally; 2]>> =
            self.points().chunks(self.points_at_once()).map(chunk).collect();
        let mut motion = Motion::new(self.responses, self.drive);
        let observed = Observed::here();
        let (all, mut done) = (segments.iter().map(Range::len).sum::<usize>(), 0);
        observed.part(|| format!("{} points, {all} samples", self.points().len()));
        for (segment, range) in segments.iter().enumerate() {
            motion.skip_to(range.start, self.samples_at_once());
            while motion.next() < range.end {
                let count = (range.end - motion.next()).min(self.samples_at_once());
                let both = motion.states(count).map(|states| {
                    let read = self.as_read(states);
                    Mat::from_fn(read.nrows(), count, |m, i| read[(m, i)] as f32)
                });
                self.for_chunks(&mut tallies, |weights, own| {
                    for (states, tally) in both.iter().zip(&mut own[segment]) {
                        add_to(tally, weights.as_ref(), states.as_ref());
                    }
                });
                done += count;
                observed.done(done as f64 / all as f64);
            }
        }
        Survey { tallies: joined(tallies, segments.len()), snapshots: self.snapshots(instants) }
    }

    fn weighed(&self, passage: &Passage) -> Weighed {
        Feeling::of(self, passage).weighed()
    }

    fn under(&self, contacts: &[&[(Point, f64)]]) -> Option<Vec<Vec<f64>>> {
        Some(self.velocities_under(contacts))
    }

    fn spots(&self, requests: &[(Point, usize, Quantity)]) -> Vec<Spot> {
        let instants: Vec<usize> = requests.iter().map(|(_, sample, _)| *sample).collect();
        let states = self.states(&instants);
        let conditions = &self.responses.conditions;
        let measure = |((at, _, quantity), state): (&(Point, usize, Quantity), &State)| {
            let state = Mat::from_fn(self.modes(), 1, |m, _| state.of(*quantity)[m]);
            let shapes = self.responses.shapes.as_ref();
            // To combine the motion once costs less than the shapes at every point.
            let (shapes, state) = match shapes.mixture() {
                Some(mixture) => (mixture.base, mixture.of_base(state.as_ref())),
                None => (shapes, state),
            };
            let field = |points: &[Point]| {
                let weights = shapes.at_all(points);
                let value = |p| (0..state.nrows()).map(|m| weights[(p, m)] * state[(m, 0)]).sum();
                (0..points.len()).map(value).collect::<Vec<f64>>()
            };
            spot::spot(
                &Around { at: *at, outline: &conditions.outline, wavelength: conditions.lambda_min },
                field,
            )
        };
        requests.par_iter().zip(&states).map(measure).collect()
    }
}

/// Joins tallies `[chunk of points][segment]` into one tally per segment over all points.
fn joined(chunks: Vec<Vec<[Tally; 2]>>, segments: usize) -> Vec<[Tally; 2]> {
    let mut whole = vec![<[Tally; 2]>::default(); segments];
    for chunk in chunks {
        for (to, from) in whole.iter_mut().zip(chunk) {
            for (to, from) in to.iter_mut().zip(from) {
                to.peak.extend(from.peak);
                to.squares.extend(from.squares);
            }
        }
    }
    whole
}
