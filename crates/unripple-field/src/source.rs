//! What a field is read from: modal or sampled responses.

use crate::FieldError;
use std::ops::Range;
use unripple_core::Point;
use unripple_dsp::Weighting;

/// The quantity that is read: velocity or displacement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// Normal velocity, in m/s.
    Velocity,
    /// Normal displacement, in metres.
    Displacement,
}

/// How a place moves: one value per sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// Velocity, in m/s.
    pub velocity: Vec<f64>,
    /// Displacement, in metres.
    pub displacement: Vec<f64>,
}

impl Trace {
    /// One of the two, a number per sample in m/s or m.
    pub(crate) fn of(&self, quantity: Quantity) -> &[f64] {
        match quantity {
            Quantity::Velocity => &self.velocity,
            Quantity::Displacement => &self.displacement,
        }
    }
}

/// What one quantity does at every point of a field over a segment of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Tally {
    /// Largest magnitude at each point.
    pub peak: Vec<f32>,
    /// Sum of squares over the samples.
    pub squares: Vec<f64>,
}

impl Tally {
    /// Nothing tallied yet at so many points, a number.
    pub fn zeros(points: usize) -> Self {
        Self { peak: vec![0.0; points], squares: vec![0.0; points] }
    }
}

/// The field over segments of time and at instants, at every one of its points; velocity and displacement.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Survey {
    /// Tallies of velocity and displacement, a pair per segment.
    pub tallies: Vec<[Tally; 2]>,
    /// Velocity and displacement at every point, a pair per instant.
    pub snapshots: Vec<[Vec<f32>; 2]>,
}

/// A stretch of displacement to be weighed by the threshold of touch.
#[derive(Clone, Debug)]
pub(crate) struct Passage {
    /// Samples that are weighed together; what lies beyond them is the weighting's to say.
    pub taken: Range<usize>,
    /// Those of them that are tallied.
    pub span: Range<usize>,
    /// Those of the span that snapshots are taken at.
    pub instants: Vec<usize>,
    /// 1/threshold, for as many samples as are taken.
    pub weighting: Weighting,
    /// By how much the result may be off anywhere, in units of the threshold.
    pub slack: f64,
}

/// What is felt at every point of a field during a passage, in units of the threshold.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Weighed {
    /// What is felt at every point over the span.
    pub tally: Tally,
    /// What is felt at every point, one list per instant.
    pub snapshots: Vec<Vec<f32>>,
}

/// A field under a drive, whatever its responses are kept in. Samples count from the drive's first.
pub(crate) trait Source: Send + Sync {
    /// The points (m) it is taken on.
    fn points(&self) -> &[Point];

    /// The point that stands for a place, both in metres.
    fn locate(&self, place: Point) -> Result<Point, FieldError>;

    /// How many samples are known, from the drive's first.
    fn known(&self) -> usize;

    /// Traces over a range of samples, each the mean over a set of points.
    fn traces(&self, sets: &[Vec<Point>], range: Range<usize>) -> Vec<Trace>;

    /// Tallies over segments of samples (ascending, apart from each other) and snapshots at instants, both at
    /// every point.
    fn survey(&self, segments: &[Range<usize>], instants: &[usize]) -> Survey;

    /// What is felt during a passage.
    fn weighed(&self, passage: &Passage) -> Weighed;

    /// Full width at half maximum around a point at a sample, in metres, for each request.
    fn spots(&self, requests: &[(Point, usize, Quantity)]) -> Vec<Option<f64>>;
}
