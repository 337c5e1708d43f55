//! Groups of neighbouring points for which the kriging equations are solved at every frequency bin.

use super::medium::Waves;
use super::spectra::Spectra;
use super::system::{System, distances};
use crate::CalibrateError;
use rayon::prelude::*;
use unripple_core::Point;
use unripple_linalg::Mat;

/// A group of neighbouring measured points, with the solution (K + N)⁻¹ h of the kriging equations for each frequency
/// bin and actuator, where h are the responses at the points.
#[derive(Debug)]
pub(crate) struct Neighbourhood {
    points: Vec<Point>,
    /// Kriging solutions (K + N)⁻¹ h, `[bin][point][actuator]`.
    solved: Vec<f64>,
}

impl Neighbourhood {
    /// Solves the kriging equations for the points `all[indices]`.
    ///
    /// # Errors
    /// [`CalibrateError::Singular`] if the covariance matrix of the points is not positive definite.
    pub fn solve(
        spectra: &Spectra,
        waves: &Waves,
        all: &[Point],
        indices: &[usize],
    ) -> Result<Self, CalibrateError> {
        let points: Vec<Point> = indices.iter().map(|i| all[*i]).collect();
        let (count, actuators) = (points.len(), spectra.actuators);
        let distances = distances(&points);
        let width = all.len() * actuators;
        let mut solved = vec![0.0; spectra.bins() * count * actuators];
        solved.par_chunks_mut(count * actuators).enumerate().try_for_each(|(bin, solved)| {
            let line = &waves.lines[bin];
            let values = &spectra.values[bin * width..][..width];
            let mut columns = Mat::from_fn(count, actuators, |p, a| values[indices[p] * actuators + a]);
            let system = System::factor(waves, line, &distances, count)
                .ok_or(CalibrateError::Singular { points: count, hz: bin as f64 * spectra.step })?;
            system.solve(columns.as_mut());
            for (p, row) in solved.chunks_exact_mut(actuators).enumerate() {
                row.iter_mut().enumerate().for_each(|(a, x)| *x = columns[(p, a)] / line.kept);
            }
            Ok::<(), CalibrateError>(())
        })?;
        Ok(Self { points, solved })
    }

    /// Interpolated spectra of all actuators' responses at a place, `[bin][actuator]`.
    pub fn bins(&self, waves: &Waves, place: Point, actuators: usize) -> Vec<f64> {
        let distances: Vec<f64> = self.points.iter().map(|point| point.distance(place)).collect();
        let mut bins = vec![0.0; waves.lines.len() * actuators];
        let per_bin = self.points.len() * actuators;
        let of_bins = bins.par_chunks_mut(actuators).zip(self.solved.par_chunks(per_bin)).zip(&waves.lines);
        of_bins.with_min_len(32).for_each(|((bin, solved), line)| {
            for (distance, row) in distances.iter().zip(solved.chunks_exact(actuators)) {
                let weight = waves.covariance(line, *distance);
                bin.iter_mut().zip(row).for_each(|(sum, x)| *sum += weight * x);
            }
        });
        bins
    }
}

/// All neighbourhoods of a surface, with their centres: a place belongs to the one whose centre is nearest.
#[derive(Debug)]
pub(crate) struct Patches {
    centres: Vec<Point>,
    /// The neighbourhoods; adjacent ones have points in common.
    pub neighbourhoods: Vec<Neighbourhood>,
}

impl Patches {
    /// Builds one neighbourhood of all points if there are at most `most`, otherwise overlapping
    /// neighbourhoods of `most / 2` points.
    ///
    /// # Errors
    /// [`CalibrateError::Singular`] if the covariance matrix of a neighbourhood is not positive definite.
    pub fn of(
        spectra: &Spectra,
        waves: &Waves,
        points: &[Point],
        most: usize,
    ) -> Result<Self, CalibrateError> {
        let all: Vec<usize> = (0..points.len()).collect();
        let (centres, parts) = if points.len() <= most {
            (vec![Point::default()], vec![all])
        } else {
            let centres = centres(points, &all, most / 8);
            let parts = centres.iter().map(|centre| nearest(points, *centre, most / 2)).collect();
            (centres, parts)
        };
        let solve = |part: &Vec<usize>| Neighbourhood::solve(spectra, waves, points, part);
        let neighbourhoods = parts.iter().map(solve).collect::<Result<_, _>>()?;
        Ok(Self { centres, neighbourhoods })
    }

    /// The neighbourhood whose centre is nearest to a place (m).
    pub fn around(&self, place: Point) -> Option<&Neighbourhood> {
        let nearest = (0..self.centres.len())
            .min_by(|a, b| self.centres[*a].distance(place).total_cmp(&self.centres[*b].distance(place)))?;
        self.neighbourhoods.get(nearest)
    }
}

/// Indices of the `count` points nearest to a place, in no particular order.
pub(crate) fn nearest(points: &[Point], place: Point, count: usize) -> Vec<usize> {
    let mut indices: Vec<usize> = (0..points.len()).collect();
    let count = count.min(points.len());
    if count < points.len() {
        let by = |a: &usize, b: &usize| points[*a].distance(place).total_cmp(&points[*b].distance(place));
        indices.select_nth_unstable_by(count, by);
        indices.truncate(count);
    }
    indices
}

/// Centres of patches of at most `most` points. A patch with more is halved across its longer side.
fn centres(points: &[Point], indices: &[usize], most: usize) -> Vec<Point> {
    let range = |of: fn(&Point) -> f64| {
        let values = indices.iter().map(|i| of(&points[*i]));
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    };
    let (x, y) = (range(|p| p.x), range(|p| p.y));
    if indices.len() <= most.max(1) {
        return vec![Point::new((x[0] + x[1]) / 2.0, (y[0] + y[1]) / 2.0)];
    }
    let along = |p: Point| if x[1] - x[0] >= y[1] - y[0] { p.x } else { p.y };
    let mut sorted = indices.to_vec();
    sorted.sort_by(|a, b| along(points[*a]).total_cmp(&along(points[*b])));
    let (low, high) = sorted.split_at(sorted.len() / 2);
    [low, high].iter().flat_map(|half| centres(points, half, most)).collect()
}
