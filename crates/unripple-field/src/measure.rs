//! All metrics of a drive at its aims.

use crate::aim::{Resolved, last_period, segments};
use crate::felt::{AllFelt, decibels, felt};
use crate::field::bounded;
use crate::figures::{DriveFigures, Maps, Measured, TakenOn, TargetFigures};
use crate::similarity::Similarity;
use crate::source::{Quantity, Survey, Trace, largest};
use crate::spot::Spot;
use crate::{Aim, Field, FieldError, MeasureOptions, pulse};
use rayon::prelude::*;
use std::ops::Range;
use unripple_core::{Drive, Point, Responses, require};
use unripple_dsp::Threshold;

/// Evaluates how well `drive` focuses on `aims` through `responses`: all metrics, in velocity, in displacement and as
/// felt.
///
/// "Outside" are the points of the field farther than (4/3) λ_min from every point of every aim; the span is [0, 2T]
/// with T the aim's instant, or the last full period of a repeated drive. Without aims, the span is that of a focus at
/// the drive's last sample, and only the metrics of the drive and the maps are computed.
///
/// # Errors
/// Those of [`Field::new`] and of [`Field::measure`].
pub fn measure(
    responses: &Responses,
    drive: &Drive,
    aims: &[Aim],
    options: &MeasureOptions,
) -> Result<Measured, FieldError> {
    let field = Field::new(responses, drive, options.cells)?.felt_above(options.threshold.clone());
    field.measure(aims, options.period)
}

impl Field<'_> {
    /// Computes all metrics of this field at `aims`, those of [`measure`](crate::measure()); `period` (s) is
    /// that of [`MeasureOptions`].
    ///
    /// # Errors
    /// [`FieldError::Outside`], [`FieldError::Unknown`], [`FieldError::Instant`] and [`FieldError::Count`] for aims,
    /// [`FieldError::Range`] for a period longer than the drive.
    pub fn measure(&self, aims: &[Aim], period: Option<f64>) -> Result<Measured, FieldError> {
        let field = self;
        let period = period.map(|period| whole_period(period, field.drive)).transpose()?;
        let resolved =
            aims.iter().map(|aim| Resolved::of(aim, field, period)).collect::<Result<Vec<_>, _>>()?;
        let spans = spans(&resolved, field, period);
        let traces = target_traces(&resolved, field, &spans, period)?;
        let peaks: Vec<Peaks> =
            resolved.iter().zip(&traces).map(|(aim, (first, t))| Peaks::of(aim, *first, t)).collect();
        let within = |(aim, (first, t)): (&Resolved, &(usize, Trace))| {
            fast(&t.velocity[aim.span.start - first..aim.span.end - first], field.rate())
        };
        let fast: Vec<f64> = resolved.iter().zip(&traces).map(within).collect();
        let radius = field.conditions.focal_radius();
        let centres: Vec<Point> = resolved.iter().flat_map(|aim| aim.points.iter().copied()).collect();
        let outside = outside(field.points(), &centres, radius);
        let segments = segments(&spans);
        let instants: Vec<usize> =
            resolved.iter().map(|aim| aim.instant).chain(peaks.iter().map(|p| p.extreme)).collect();
        let survey = field.source.survey(&segments, &instants);
        let spots = spots(&resolved, &peaks, field);
        let felt = felt(field, &resolved, &spans, period, &outside);
        let judge = Judge {
            field,
            aims,
            resolved: &resolved,
            peaks: &peaks,
            fast: &fast,
            survey: &survey,
            segments: &segments,
            outside: &outside,
            felt: &felt,
        };
        let targets = (0..aims.len()).map(|i| judge.figures(i, spots[i])).collect();
        Ok(Measured {
            targets,
            drive: drive_figures(field, period),
            lambda_min_m: field.conditions.lambda_min,
            focal_radius_m: radius,
            taken_on: if field.grid().is_some() { TakenOn::Grid } else { TakenOn::Library },
            outside_points: outside.iter().filter(|out| **out).count(),
            outside_share: outside.iter().filter(|out| **out).count() as f64 / outside.len().max(1) as f64,
            felt_outside_db: loudest(&felt.peak, &outside),
            ssim: Similarity::surveyed(field.grid(), &survey.tallies, &centres, radius),
            maps: maps(field, survey, felt.peak, outside, &instants),
        })
    }
}

/// A period (s) as a whole number of samples.
pub(crate) fn whole_period(period: f64, drive: &Drive) -> Result<usize, FieldError> {
    let samples = (period * drive.rate()).round();
    let legal = (1.0..=drive.samples() as f64).contains(&samples);
    let expected = format!("{} to {}, the drive's length", 1.0 / drive.rate(), drive.duration());
    require("period (s)", legal, expected, period)?;
    Ok(samples as usize)
}

/// The samples over which each aim is evaluated; without aims, those of a focus at the drive's last sample.
pub(crate) fn spans(aims: &[Resolved], field: &Field<'_>, period: Option<usize>) -> Vec<Range<usize>> {
    if !aims.is_empty() {
        return aims.iter().map(|aim| aim.span.clone()).collect();
    }
    vec![match period {
        Some(period) => last_period(field, period),
        None => 0..(2 * field.drive.samples() - 1).min(field.known()),
    }]
}

/// For each aim, the first sample of its trace and the trace itself, which covers the aim's span and half a
/// period before and after it.
pub(crate) fn target_traces(
    aims: &[Resolved],
    field: &Field<'_>,
    spans: &[Range<usize>],
    period: Option<usize>,
) -> Result<Vec<(usize, Trace)>, FieldError> {
    let margin = period.unwrap_or(0) / 2;
    let first = spans.iter().map(|span| span.start).min().unwrap_or(0).saturating_sub(margin);
    let end = spans.iter().map(|span| span.end).max().unwrap_or(0) + margin;
    bounded("values of the traces", (end - first).saturating_mul(2 * aims.len()))?;
    let sets: Vec<Vec<Point>> = aims.iter().map(|aim| aim.points.clone()).collect();
    Ok(field.source.traces(&sets, first..end).into_iter().map(|trace| (first, trace)).collect())
}

/// Levels, instants and widths of the motion at a target.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Peaks {
    /// Velocity at the focal instant T (m/s), and displacement at the sample where its magnitude is largest
    /// (m).
    pub levels: [f64; 2],
    /// Sample at which the magnitude of the velocity is largest.
    fastest: usize,
    /// Sample at which the magnitude of the displacement is largest.
    pub extreme: usize,
    /// Full widths at half maximum in time, of velocity and displacement, in samples.
    widths: [Option<f64>; 2],
}

impl Peaks {
    /// Finds the peaks of the motion at an aim from its trace, whose first sample is the drive's sample
    /// `first`.
    pub fn of(aim: &Resolved, first: usize, trace: &Trace) -> Self {
        let largest = |values: &[f64]| {
            let span = aim.span.start - first..aim.span.end - first;
            let larger = |best: usize, i: usize| if values[i].abs() > values[best].abs() { i } else { best };
            span.clone().fold(span.start, larger) + first
        };
        let (velocity, displacement) = (&trace.velocity, &trace.displacement);
        let (fastest, extreme) = (largest(velocity), largest(displacement));
        let (at_focus, at_extreme) = (aim.instant - first, extreme - first);
        Self {
            levels: [velocity[at_focus], displacement[at_extreme]],
            fastest,
            extreme,
            widths: [pulse::width(velocity, at_focus), pulse::width(displacement, at_extreme)],
        }
    }
}

/// Whether each point is farther than `radius` from every centre of a focal disc.
fn outside(points: &[Point], centres: &[Point], radius: f64) -> Vec<bool> {
    points.par_iter().map(|p| centres.iter().all(|centre| centre.distance(*p) > radius)).collect()
}

/// Focal spots, in velocity and in displacement, of the aims that are single points.
fn spots(aims: &[Resolved], peaks: &[Peaks], field: &Field<'_>) -> Vec<[Spot; 2]> {
    let requests = aims.iter().zip(peaks).flat_map(|(aim, peaks)| {
        let at = aim.points[0];
        [(at, aim.instant, Quantity::Velocity), (at, peaks.extreme, Quantity::Displacement)]
    });
    let found = field.spots(&requests.collect::<Vec<_>>());
    let single = |aim: &Resolved, pair: &[Spot]| {
        if aim.points.len() == 1 { [pair[0], pair[1]] } else { [Spot::default(); 2] }
    };
    aims.iter().zip(found.chunks_exact(2)).map(|(aim, pair)| single(aim, pair)).collect()
}

/// Everything from which the metrics of one target are computed.
struct Judge<'a> {
    field: &'a Field<'a>,
    aims: &'a [Aim],
    resolved: &'a [Resolved],
    peaks: &'a [Peaks],
    /// Share of energy above 1 kHz of the velocity of each target.
    fast: &'a [f64],
    survey: &'a Survey,
    segments: &'a [Range<usize>],
    outside: &'a [bool],
    felt: &'a AllFelt,
}

/// Motion outside the focal discs with which the level at a target is compared.
struct Surroundings {
    /// Rms velocity (m/s) or displacement (m) over outside points at the instant of the level.
    then: f64,
    /// Rms velocity (m/s) or displacement (m) over outside points and the span.
    background: f64,
    /// Largest magnitude of the velocity (m/s) or displacement (m) over outside points and the span.
    worst: f64,
    /// Index of the point where that magnitude is reached; `None` if nothing moves.
    worst_point: Option<usize>,
}

/// The strongest motion outside the focal discs.
#[derive(Clone, Copy)]
struct Worst {
    /// Where it is, in metres.
    at: [f64; 2],
    /// The sample at which the velocity there is largest.
    sample: usize,
    /// Share of energy above 1 kHz of the velocity there.
    fast: f64,
}

impl Judge<'_> {
    /// The metrics of the target with this index.
    fn figures(&self, index: usize, spots: [Spot; 2]) -> TargetFigures {
        let (aim, resolved, peaks) = (&self.aims[index], &self.resolved[index], &self.peaks[index]);
        let rate = self.field.drive.rate();
        let seconds = |sample: usize| sample as f64 / rate;
        let [velocity, displacement] = [0, 1].map(|q| self.surroundings(index, q));
        let worst = velocity.worst_point.map(|point| self.worst(point, &resolved.span));
        let ranges = self.ranges(index);
        let felt = &self.felt.targets[index];
        let count = aim.points.len() as f64;
        let mean = |of: fn(&Point) -> f64| aim.points.iter().map(of).sum::<f64>() / count;
        let apart = aim.points.iter().zip(&resolved.points).map(|(a, b)| a.distance(*b)).sum::<f64>();
        TargetFigures {
            at_m: [mean(|p| p.x), mean(|p| p.y)],
            points: aim.points.len(),
            misplaced_m: apart / count,
            instant_s: seconds(resolved.instant),
            span_s: [seconds(resolved.span.start), seconds(resolved.span.end - 1)],
            span_complete: resolved.complete,
            peak_velocity_m_s: peaks.levels[0],
            peak_time_s: seconds(peaks.fastest),
            contrast: ratio(peaks.levels[0], velocity.then),
            background_contrast: ratio(peaks.levels[0], velocity.background),
            worst_spot: ratio(peaks.levels[0], velocity.worst),
            worst_spot_at_m: worst.map(|worst| worst.at),
            worst_spot_time_s: worst.map(|worst| seconds(worst.sample)),
            share_above_1khz: self.fast[index],
            worst_spot_share_above_1khz: worst.map(|worst| worst.fast),
            spot_diameter_m: spots[0].diameter,
            spot_area_m2: spots[0].area,
            focus_offset_m: spots[0].offset,
            pulse_duration_s: peaks.widths[0].map(|width| width / rate),
            peak_displacement_m: peaks.levels[1],
            displacement_peak_time_s: seconds(peaks.extreme),
            displacement_contrast: ratio(peaks.levels[1], displacement.then),
            displacement_background_contrast: ratio(peaks.levels[1], displacement.background),
            displacement_worst_spot: ratio(peaks.levels[1], displacement.worst),
            displacement_spot_diameter_m: spots[1].diameter,
            displacement_spot_area_m2: spots[1].area,
            displacement_pulse_duration_s: peaks.widths[1].map(|width| width / rate),
            felt_level_db: felt.level_db,
            felt_peak_time_s: seconds(felt.extreme),
            felt_duration_s: felt.lasting.map(seconds),
            felt_contrast_db: felt.contrast_db,
            felt_background_db: felt.background_db,
            felt_worst_spot_db: felt.worst_spot_db,
            velocity_range_m_s: ranges.map(|[velocity, _]| velocity),
            displacement_range_m: ranges.map(|[_, displacement]| displacement),
        }
    }

    /// Motion outside with which the level at the target of this index is compared, in velocity (0) or
    /// displacement (1).
    fn surroundings(&self, index: usize, quantity: usize) -> Surroundings {
        let span = &self.resolved[index].span;
        let snapshot = &self.survey.snapshots[index + quantity * self.aims.len()][quantity];
        let outside = || self.outside.iter().enumerate().filter(|(_, out)| **out).map(|(point, _)| point);
        let count = outside().count().max(1) as f64;
        let then = outside().map(|p| f64::from(snapshot[p]).powi(2)).sum::<f64>();
        let (mut squares, mut worst, mut worst_point) = (0.0, 0.0, None);
        for (segment, pair) in self.segments.iter().zip(&self.survey.tallies) {
            if span.start <= segment.start && segment.end <= span.end {
                squares += outside().map(|p| pair[quantity].squares[p]).sum::<f64>();
                for point in outside() {
                    let peak = f64::from(pair[quantity].peak[point]);
                    if peak > worst {
                        (worst, worst_point) = (peak, Some(point));
                    }
                }
            }
        }
        let background = (squares / (count * span.len() as f64)).sqrt();
        Surroundings { then: (then / count).sqrt(), background, worst, worst_point }
    }

    /// The motion over a span at a point of the field, by its index.
    fn worst(&self, point: usize, span: &Range<usize>) -> Worst {
        let at = self.field.points()[point];
        let traces = self.field.source.traces(&[vec![at]], span.clone());
        let velocity = traces.first().map_or(&[][..], |trace| trace.of(Quantity::Velocity));
        let largest = velocity.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let sample = span.start + largest.map_or(0, |(i, _)| i);
        Worst { at: [at.x, at.y], sample, fast: fast(velocity, self.field.rate()) }
    }

    /// Least and greatest velocity at T, and displacement at the instant of its largest magnitude, over a
    /// target's points.
    fn ranges(&self, index: usize) -> Option<[[f64; 2]; 2]> {
        let (resolved, peaks) = (&self.resolved[index], &self.peaks[index]);
        if resolved.points.len() < 2 {
            return None;
        }
        let singles: Vec<Vec<Point>> = resolved.points.iter().map(|p| vec![*p]).collect();
        let range = |sample: usize, quantity| {
            let traces = self.field.source.traces(&singles, sample..sample + 1);
            let values = traces.iter().flat_map(|trace| trace.of(quantity).first().copied());
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        };
        Some([range(resolved.instant, Quantity::Velocity), range(peaks.extreme, Quantity::Displacement)])
    }
}

/// Share of the energy of a velocity (`rate` samples per second) above the highest frequency at which the
/// threshold of touch was measured.
fn fast(velocity: &[f64], rate: f64) -> f64 {
    unripple_dsp::share_above(&[velocity.to_vec()], rate, Threshold::MEASURED_TO_HZ)
}

fn ratio(level: f64, surroundings: f64) -> Option<f64> {
    (surroundings > 0.0).then(|| level.abs() / surroundings)
}

/// Metrics of the whole drive, or of its last `period` samples.
fn drive_figures(field: &Field<'_>, period: Option<usize>) -> DriveFigures {
    let drive = field.drive;
    let first = period.map_or(0, |period| last_period(field, period).start);
    let channels: Vec<Vec<f64>> = drive.channels().iter().map(|channel| channel[first..].to_vec()).collect();
    let samples = drive.samples() - first;
    let squares: f64 = channels.iter().flatten().map(|d| d * d).sum();
    DriveFigures {
        peak: channels.iter().flatten().fold(0.0, |m, d| f64::max(m, d.abs())),
        rms: (squares / (samples * channels.len()) as f64).sqrt(),
        energy: squares / drive.rate(),
        share_above_band: unripple_dsp::share_above(&channels, drive.rate(), field.conditions.band[1]),
        duration_s: samples as f64 / drive.rate(),
    }
}

/// The highest felt level at the points outside, in dB above the threshold.
fn loudest(felt: &[f32], outside: &[bool]) -> Option<f64> {
    let levels = felt.iter().zip(outside).filter(|(_, out)| **out).map(|(level, _)| f64::from(*level));
    Some(levels.fold(0.0, f64::max)).filter(|level| *level > 0.0).map(decibels)
}

/// Maps and snapshots of the field from the values of a survey.
fn maps(
    field: &Field<'_>,
    survey: Survey,
    felt_peak: Vec<f32>,
    outside: Vec<bool>,
    instants: &[usize],
) -> Maps {
    let peak = |quantity| largest(&survey.tallies, quantity, field.points().len());
    let (peak_velocity, peak_displacement) = (peak(0), peak(1));
    let snapshots =
        instants.iter().zip(survey.snapshots).map(|(sample, values)| field.snapshot(*sample, values));
    let mut at_peak: Vec<_> = snapshots.collect();
    let at_displacement_peak = at_peak.split_off(at_peak.len() / 2);
    Maps {
        points: field.points().to_vec(),
        grid: field.grid().cloned(),
        outside,
        peak_velocity,
        peak_displacement,
        felt_peak,
        at_peak,
        at_displacement_peak,
    }
}
