//! Metrics of what is felt: level, contrast and background in dB.

use crate::aim::Resolved;
use crate::source::{Passage, Quantity, Tally};
use crate::{Field, pulse};
use std::ops::Range;
use unripple_core::Point;
use unripple_dsp::{Threshold, Weighting};

/// Error allowed in the threshold-weighted displacement elsewhere, as a share of the level at the target: 80
/// dB below it. Ten times more would leave out modes that matter where the largest displacement elsewhere is
/// 60 dB below the target's.
const SLACK: f64 = 1e-4;

/// Metrics of what is felt at one target, in dB; `None` without points outside the focal discs, or without
/// motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Felt {
    /// Largest magnitude of the threshold-weighted displacement at the target during the time that is evaluated, in dB above the threshold of
    /// touch.
    pub level_db: Option<f64>,
    /// The sample at which the threshold-weighted displacement at the target is largest in magnitude.
    pub extreme: usize,
    /// Duration of the felt motion around `extreme`, in samples, as [`pulse::lasting`] counts them with
    /// pauses of up to [`Threshold::INTEGRATION_S`]; `None` if the motion never pauses.
    pub lasting: Option<usize>,
    /// The target's level over the rms threshold-weighted displacement of the outside points at the sample
    /// `extreme`, in dB.
    pub contrast_db: Option<f64>,
    /// The target's level over the rms threshold-weighted displacement of the outside points during the
    /// span, in dB.
    pub background_db: Option<f64>,
    /// The target's level over the largest threshold-weighted displacement of any outside point during the
    /// span, in dB.
    pub worst_spot_db: Option<f64>,
}

/// Felt metrics at all aims, and the largest threshold-weighted displacement at every point.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct AllFelt {
    /// Metrics of what is felt at each aim.
    pub targets: Vec<Felt>,
    /// Largest magnitude of the threshold-weighted displacement at every point over all spans, in units of the threshold.
    pub peak: Vec<f32>,
}

/// Displacement filtered by 1/threshold(f), evaluated at every aim; without aims, over `spans` for the map alone.
///
/// A single pulse in focus at T is filtered over the time from −T to 3T, the surface being at rest before the drive's
/// first sample at 0 and counted as at rest after 3T. A repeated drive is filtered as if its last period had always
/// been repeated.
pub(crate) fn felt(
    field: &Field<'_>,
    aims: &[Resolved],
    spans: &[Range<usize>],
    period: Option<usize>,
    outside: &[bool],
) -> AllFelt {
    let mut all =
        AllFelt { targets: vec![Felt::default(); aims.len()], peak: vec![0.0; field.points().len()] };
    for (mut passage, members) in passages(field, aims, spans, period) {
        // A drive of a single period is not repeated: before it the surface is at rest.
        let again = period.is_some() && passage.span.start > 0;
        let own = own(field, members.iter().map(|i| &aims[*i]), &passage, again);
        passage.slack = SLACK * own.iter().map(|own| own.level).reduce(f64::min).unwrap_or(0.0);
        passage.instants = own.iter().map(|own| own.extreme).collect();
        let weighed = field.source.weighed(&passage);
        for ((i, own), snapshot) in members.iter().zip(own).zip(&weighed.snapshots) {
            all.targets[*i] = figures(own, snapshot, &weighed.tally, outside, passage.span.len());
        }
        all.peak.iter_mut().zip(&weighed.tally.peak).for_each(|(peak, own)| *peak = peak.max(*own));
    }
    all
}

/// The time spans to be filtered, each with the indices of the aims that are evaluated from it.
fn passages(
    field: &Field<'_>,
    aims: &[Resolved],
    spans: &[Range<usize>],
    period: Option<usize>,
) -> Vec<(Passage, Vec<usize>)> {
    let mut found: Vec<(Passage, Vec<usize>)> = Vec::new();
    for (i, span) in spans.iter().enumerate() {
        let focal = aims.get(i).map_or(field.drive.samples() - 1, |aim| aim.instant);
        let taken = if period.is_some() { span.clone() } else { 0..3 * focal + 1 };
        let member = aims.get(i).map(|_| i);
        let same = |(passage, _): &&mut (Passage, _)| (&passage.span, &passage.taken) == (span, &taken);
        if let Some((_, members)) = found.iter_mut().find(same) {
            members.extend(member);
            continue;
        }
        let (threshold, rate) = (&field.threshold, field.rate());
        let weighting = match period {
            Some(_) => Weighting::periodic(threshold, rate, taken.len()),
            None => Weighting::padded(threshold, rate, taken.len(), focal),
        };
        let passage = Passage { taken, span: span.clone(), instants: Vec::new(), weighting, slack: 0.0 };
        found.push((passage, member.into_iter().collect()));
    }
    found
}

/// Largest threshold-weighted displacement at an aim, when it is reached, and how long the motion lasts.
struct Own {
    /// Sample at which the threshold-weighted displacement is largest in magnitude.
    extreme: usize,
    /// Magnitude of the threshold-weighted displacement at that sample, in units of the threshold.
    level: f64,
    /// Duration of the felt motion around that sample, in samples; `None` if it never pauses.
    lasting: Option<usize>,
}

/// What is felt at each aim, of a motion that occurs once or, with `again`, is repeated.
fn own<'a>(
    field: &Field<'_>,
    aims: impl Iterator<Item = &'a Resolved>,
    passage: &Passage,
    again: bool,
) -> Vec<Own> {
    let sets: Vec<Vec<Point>> = aims.map(|aim| aim.points.clone()).collect();
    let Passage { taken, span, weighting, .. } = passage;
    let traces = field.source.traces(&sets, taken.clone());
    let pause = (Threshold::INTEGRATION_S * field.rate()) as usize;
    let largest = |felt: &[f64]| {
        let within = span.clone().map(|i| (i, felt[i - taken.start].abs()));
        let first = (span.start, 0.0);
        let (extreme, level) = within.fold(first, |best, own| if own.1 > best.1 { own } else { best });
        Own { extreme, level, lasting: pulse::lasting(felt, extreme - taken.start, pause, again) }
    };
    traces.iter().map(|trace| largest(&weighting.weigh(trace.of(Quantity::Displacement)))).collect()
}

/// One target's figures, from its own level and what is felt elsewhere.
fn figures(
    Own { extreme, level, lasting }: Own,
    then: &[f32],
    tally: &Tally,
    outside: &[bool],
    samples: usize,
) -> Felt {
    let points = || outside.iter().enumerate().filter(|(_, out)| **out).map(|(point, _)| point);
    let count = points().count().max(1) as f64;
    let rms = |squares: f64, count: f64| (squares / count).sqrt();
    let now = rms(points().map(|p| f64::from(then[p]).powi(2)).sum(), count);
    let background = rms(points().map(|p| tally.squares[p]).sum(), count * samples as f64);
    let worst = points().map(|p| f64::from(tally.peak[p])).fold(0.0, f64::max);
    let over = |other: f64| (level > 0.0 && other > 0.0).then(|| decibels(level / other));
    Felt {
        level_db: over(1.0),
        extreme,
        lasting,
        contrast_db: over(now),
        background_db: over(background),
        worst_spot_db: over(worst),
    }
}

/// The level 20 log10 of a ratio of amplitudes, in dB.
pub(crate) fn decibels(ratio: f64) -> f64 {
    20.0 * ratio.log10()
}
