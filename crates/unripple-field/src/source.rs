//! Motion at points of a surface, from modal or sampled responses.

use crate::FieldError;
use crate::spot::Spot;
use std::ops::Range;
use unripple_core::Point;
use unripple_dsp::Weighting;

/// The quantity that is evaluated: velocity or displacement.
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
    /// Sum of squares of the quantity over the samples, at each point.
    pub squares: Vec<f64>,
}

impl Tally {
    /// A tally of `points` points with all values 0.
    pub fn zeros(points: usize) -> Self {
        Self { peak: vec![0.0; points], squares: vec![0.0; points] }
    }
}

/// The largest magnitude over all segments at each of `points` points: of velocity (0) or displacement (1).
pub(crate) fn largest(tallies: &[[Tally; 2]], quantity: usize, points: usize) -> Vec<f32> {
    let mut peak = vec![0.0_f32; points];
    for pair in tallies {
        peak.iter_mut().zip(&pair[quantity].peak).for_each(|(p, own)| *p = p.max(*own));
    }
    peak
}

/// Velocity and displacement at every point of a field: tallies over segments of time, and values at
/// instants.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Survey {
    /// Tallies of velocity and displacement, a pair per segment.
    pub tallies: Vec<[Tally; 2]>,
    /// Velocity and displacement at every point, a pair per instant.
    pub snapshots: Vec<[Vec<f32>; 2]>,
}

/// A time span over which displacement is filtered by the threshold of touch.
#[derive(Clone, Debug)]
pub(crate) struct Passage {
    /// Range of samples that is filtered; `weighting` determines what is assumed before and after it.
    pub taken: Range<usize>,
    /// Range of samples within `taken` over which peaks and squares are accumulated.
    pub span: Range<usize>,
    /// Samples within `span` at which snapshots are taken.
    pub instants: Vec<usize>,
    /// Filter by 1/threshold(f), for signals of the length of `taken`.
    pub weighting: Weighting,
    /// Largest error allowed in the displacement as weighted by the threshold of touch, at any point and sample, in units of the threshold.
    pub slack: f64,
}

/// Threshold-weighted displacement at every point of a field during a passage, in units of the threshold.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Weighed {
    /// Peak and sum of squares of the threshold-weighted displacement at every point over the span.
    pub tally: Tally,
    /// Threshold-weighted displacement at every point, one list per instant.
    pub snapshots: Vec<Vec<f32>>,
}

/// The motion that a drive causes, from modal or sampled responses. Samples are counted from the drive's
/// first.
pub(crate) trait Source: Send + Sync {
    /// The points (m) at which the field is evaluated.
    fn points(&self) -> &[Point];

    /// The point (m) at which the motion at `place` (m) is evaluated: `place` itself, or the nearest point
    /// with responses.
    fn locate(&self, place: Point) -> Result<Point, FieldError>;

    /// Number of samples for which the field is known, from the drive's first.
    fn known(&self) -> usize;

    /// Traces over a range of samples, each the mean over a set of points.
    fn traces(&self, sets: &[Vec<Point>], range: Range<usize>) -> Vec<Trace>;

    /// Tallies over segments of samples (ascending, apart from each other) and snapshots at instants, both at
    /// every point.
    fn survey(&self, segments: &[Range<usize>], instants: &[usize]) -> Survey;

    /// Computes the threshold-weighted displacement at all points during a passage.
    fn weighed(&self, passage: &Passage) -> Weighed;

    /// The velocity under contacts at each sample of the drive, as the mean of that before and after the
    /// sample's impulse; `None` for sampled responses.
    fn under(&self, contacts: &[&[(Point, f64)]]) -> Option<Vec<Vec<f64>>>;

    /// The focal spot around a point at a sample, for each request.
    fn spots(&self, requests: &[(Point, usize, Quantity)]) -> Vec<Spot>;
}
