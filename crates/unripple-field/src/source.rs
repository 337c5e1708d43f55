//! Motion at points of a surface, from modal or sampled responses.

use crate::FieldError;
use crate::spot::Spot;
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

/// Motion of a point, or the mean over a set of points: one value per sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// Velocity, in m/s.
    pub velocity: Vec<f64>,
    /// Displacement, in metres.
    pub displacement: Vec<f64>,
}

impl Trace {
    /// Velocity (m/s) or displacement (m), one number per sample.
    pub(crate) fn of(&self, quantity: Quantity) -> &[f64] {
        match quantity {
            Quantity::Velocity => &self.velocity,
            Quantity::Displacement => &self.displacement,
        }
    }
}

/// Largest magnitude and sum of squares of one quantity at every point of a field, over a segment of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Tally {
    /// Largest magnitude of the quantity at each point: m/s, m, or units of the threshold of touch.
    pub peak: Vec<f32>,
    /// Sum of squares over the samples.
    pub squares: Vec<f64>,
}

impl Tally {
    /// A tally of zeros at `points` points, a number.
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

/// A stretch of time over which displacement is filtered by the threshold of touch.
#[derive(Clone, Debug)]
pub(crate) struct Passage {
    /// Samples that are filtered together; the weighting says what is assumed beyond them.
    pub taken: Range<usize>,
    /// The samples among them that are tallied.
    pub span: Range<usize>,
    /// The samples of the span at which snapshots are taken.
    pub instants: Vec<usize>,
    /// 1/threshold, for as many samples as are taken.
    pub weighting: Weighting,
    /// Error allowed anywhere, in units of the threshold.
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

/// The motion that a drive causes, from modal or sampled responses. Samples count from the drive's first.
pub(crate) trait Source: Send + Sync {
    /// The points (m) at which the field is evaluated.
    fn points(&self) -> &[Point];

    /// The point at which the motion at `place` is evaluated, both in metres: itself, or the nearest one with
    /// responses.
    fn locate(&self, place: Point) -> Result<Point, FieldError>;

    /// Number of samples for which the field is known, from the drive's first.
    fn known(&self) -> usize;

    /// Traces over a range of samples, each the mean over a set of points.
    fn traces(&self, sets: &[Vec<Point>], range: Range<usize>) -> Vec<Trace>;

    /// Tallies over segments of samples (ascending, apart from each other) and snapshots at instants, both at
    /// every point.
    fn survey(&self, segments: &[Range<usize>], instants: &[usize]) -> Survey;

    /// What is felt during a passage.
    fn weighed(&self, passage: &Passage) -> Weighed;

    /// The velocity under contacts at each sample of the drive, halfway through its impulse; `None` for sampled responses.
    fn under(&self, contacts: &[&[(Point, f64)]]) -> Option<Vec<Vec<f64>>>;

    /// The focal spot around a point at a sample, for each request.
    fn spots(&self, requests: &[(Point, usize, Quantity)]) -> Vec<Spot>;
}
