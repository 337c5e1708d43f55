//! Where and when a focus is evaluated, and options of the evaluation.

use crate::{Field, FieldError};
use std::ops::Range;
use unripple_core::Point;
use unripple_dsp::Threshold;

/// A focus to be evaluated: a point or a set of points, and the instant at which it should be in focus.
#[derive(Clone, Debug, PartialEq)]
pub struct Aim {
    /// The points, in metres; a set is evaluated by its mean motion.
    pub points: Vec<Point>,
    /// Focal instant T, in seconds from the drive's first sample; rounded to a sample.
    pub instant: f64,
}

impl Aim {
    /// An aim at one point (m) that should be in focus at an instant (s).
    pub fn at(point: Point, instant: f64) -> Self {
        Self { points: vec![point], instant }
    }
}

/// Options of [`measure()`](crate::measure()): period, grid and threshold.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasureOptions {
    /// Period of a repeated drive, in seconds: the metrics are then those of its last full period, the last samples of
    /// the drive. `None` for a single pulse: the metrics are those from its start to twice the focal instant.
    pub period: Option<f64>,
    /// Cells of the grid per shortest wavelength along each side of the surface.
    pub cells: f64,
    /// Threshold of vibrotactile detection, for the metrics of what is felt.
    pub threshold: Threshold,
}

impl Default for MeasureOptions {
    /// A single pulse, eight cells per shortest wavelength, and the published threshold.
    fn default() -> Self {
        Self { period: None, cells: 8.0, threshold: Threshold::default() }
    }
}

/// An aim in samples, at points that have responses.
#[derive(Clone, Debug)]
pub(crate) struct Resolved {
    /// The points requested or, with sampled responses, the nearest stored ones.
    pub points: Vec<Point>,
    /// Sample of the focal instant T.
    pub instant: usize,
    /// Samples over which the motion at the aim is evaluated.
    pub span: Range<usize>,
    /// Whether the field is known over the whole time span: [0, 2T] for a single pulse, the last full period
    /// of a repeated drive.
    pub complete: bool,
}

impl Resolved {
    /// Finds points, focal sample and time span of an aim. The span of a single pulse is [0, 2T] in samples,
    /// shortened if the responses end earlier; that of a repeated drive is its last full period.
    pub fn of(aim: &Aim, field: &Field<'_>, period: Option<usize>) -> Result<Self, FieldError> {
        if aim.points.is_empty() {
            return Err(FieldError::Count {
                what: "points of a target",
                expected: "at least 1".to_owned(),
                found: 0,
            });
        }
        let points = aim.points.iter().map(|p| field.source.locate(*p)).collect::<Result<_, _>>()?;
        let Some(period) = period else {
            let instant = field.sample(aim.instant)?;
            let end = 2 * instant + 1;
            let span = 0..end.min(field.known());
            return Ok(Self { points, instant, complete: span.end == end, span });
        };
        let span = last_period(field, period);
        let rate = field.drive.rate();
        let instant = (aim.instant * rate).round();
        if !(span.start as f64..span.end as f64).contains(&instant) {
            let (first, last) = (span.start as f64 / rate, (span.end - 1) as f64 / rate);
            let why = "the last full period of the drive";
            return Err(FieldError::Instant { found: aim.instant, first, last, why });
        }
        Ok(Self { points, instant: instant as usize, complete: span.end <= field.known(), span })
    }
}

/// The last `period` samples of the drive.
pub(crate) fn last_period(field: &Field<'_>, period: usize) -> Range<usize> {
    let end = field.drive.samples();
    end.saturating_sub(period)..end
}

/// Splits spans of samples at the ends of all others into segments, so that every span is a union of
/// segments.
pub(crate) fn segments(spans: &[Range<usize>]) -> Vec<Range<usize>> {
    let mut ends: Vec<usize> = spans.iter().flat_map(|span| [span.start, span.end]).collect();
    ends.sort_unstable();
    ends.dedup();
    let pieces = ends.windows(2).map(|pair| pair[0]..pair[1]);
    pieces
        .filter(|piece| spans.iter().any(|span| span.start <= piece.start && piece.end <= span.end))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_cover_every_span_once() {
        let ends =
            |spans: &[Range<usize>]| -> Vec<_> { segments(spans).iter().map(|s| (s.start, s.end)).collect() };
        assert_eq!(ends(&[0..7, 0..7]), [(0, 7)]);
        assert_eq!(ends(&[0..7, 0..3, 9..12]), [(0, 3), (3, 7), (9, 12)]);
        assert_eq!(ends(&[]), []);
    }
}
