//! Largest displacement, slope and curvature of a field, which decide whether linear theory holds.

use crate::measure::{Peaks, spans, target_traces};
use crate::{Aim, Field, FieldError, Maps, Measured, Steepness};
use crate::{aim::Resolved, aim::segments, measure::whole_period};

/// Largest displacement, slope and curvature of a field, over the whole surface and the time evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Largest displacement at any point of the grid or library and at the targets, in metres.
    pub displacement: f64,
    /// Largest slope and curvature of the surface; `None` for sampled responses, whose points form no grid.
    pub steepness: Option<Steepness>,
}

impl Reach {
    /// Largest displacement, slope and curvature of a field, from its metrics.
    pub fn of(measured: &Measured) -> Self {
        Self::new(&measured.maps, measured.targets.iter().map(|target| target.peak_displacement_m))
    }

    /// Largest values from maps and the targets' largest displacements. Slope and curvature are known at the
    /// instants of these only; if the surface has a larger displacement at another time, they are multiplied
    /// by the ratio of the two.
    fn new(maps: &Maps, levels: impl Iterator<Item = f64>) -> Self {
        let largest = |values: &[f32]| values.iter().fold(0.0, |m: f64, u| m.max(f64::from(u.abs())));
        let displacement = levels.fold(largest(&maps.peak_displacement), |m, u| m.max(u.abs()));
        let taken = maps.at_displacement_peak.iter().map(|shot| largest(&shot.displacement));
        let taken = taken.fold(0.0, f64::max);
        let more = if taken > 0.0 { (displacement / taken).max(1.0) } else { 1.0 };
        let steepness = Steepness::of(maps).map(|steep| Steepness {
            slope: steep.slope * more,
            mean_square_slope: steep.mean_square_slope * more * more,
            curvature: steep.curvature * more,
        });
        Self { displacement, steepness }
    }
}

impl Field<'_> {
    /// Computes the largest displacement, slope and curvature of this field, over the time span that
    /// [`Field::measure`] evaluates; `period` (s) is that of [`MeasureOptions`](crate::MeasureOptions). This
    /// is much quicker than computing all metrics.
    ///
    /// # Errors
    /// Those of [`Field::measure`].
    pub fn reach(&self, aims: &[Aim], period: Option<f64>) -> Result<Reach, FieldError> {
        let period = period.map(|period| whole_period(period, self.drive)).transpose()?;
        let resolved =
            aims.iter().map(|aim| Resolved::of(aim, self, period)).collect::<Result<Vec<_>, _>>()?;
        let spans = spans(&resolved, self, period);
        let traces = target_traces(&resolved, self, &spans, period)?;
        let peaks: Vec<Peaks> =
            resolved.iter().zip(&traces).map(|(aim, (first, t))| Peaks::of(aim, *first, t)).collect();
        let instants: Vec<usize> = peaks.iter().map(|peaks| peaks.extreme).collect();
        let survey = self.source.survey(&segments(&spans), &instants);
        let mut peak_displacement = vec![0.0_f32; self.points().len()];
        for [_, displacement] in &survey.tallies {
            peak_displacement.iter_mut().zip(&displacement.peak).for_each(|(p, own)| *p = p.max(*own));
        }
        let shots = instants.iter().zip(survey.snapshots);
        let maps = Maps {
            grid: self.grid().cloned(),
            peak_displacement,
            at_displacement_peak: shots.map(|(sample, values)| self.snapshot(*sample, values)).collect(),
            ..Maps::default()
        };
        Ok(Reach::new(&maps, peaks.iter().map(|peaks| peaks.levels[1])))
    }
}
