//! Contrast and energy of time reversal from a layout, target by target.

use crate::{Aim, Forms, Objective, PlacementError, Plant};
use unripple_core::Point;

/// Contrast and energy of time reversal from a layout to one target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached {
    /// Contrast: peak velocity over the rms outside the focal disc at the focal instant; the mean over the models of the surface.
    pub contrast: f64,
    /// The least contrast of all models of the surface.
    pub least: f64,
    /// Energy of the drive for a peak velocity of 1 m/s, in squared units of drive times seconds; the mean over the models.
    pub energy: f64,
}

/// Contrast and energy of time reversal to each target, from the kept actuators and one more at each of `places`
/// (m).
///
/// # Errors
/// Those of [`Forms::new`].
///
/// ```
/// use unripple_core::Point;
/// use unripple_physics::design::papers_surface;
/// use unripple_placement::{Aim, Plant, reached};
///
/// let mut film = papers_surface();
/// film.emission.band = [0.0, 1000.0];
/// let kind = film.actuators[7].clone();
/// let aim = Aim { at: Point::from_mm(62.0, 90.0), weight: 1.0 };
/// let eight = reached(&[Plant::new(film.clone(), &kind)?], &[], &[aim], 30e-3)?;
/// // The last one is put back where it was.
/// film.actuators.pop();
/// let again = reached(&[Plant::new(film, &kind)?], &[kind.at], &[aim], 30e-3)?;
/// assert!((eight[0].contrast / again[0].contrast - 1.0).abs() < 1e-4);
/// # Ok::<(), unripple_placement::PlacementError>(())
/// ```
pub fn reached(
    plants: &[Plant],
    places: &[Point],
    aims: &[Aim],
    window: f64,
) -> Result<Vec<Reached>, PlacementError> {
    let mut found = reached_each(plants, std::slice::from_ref(&places.to_vec()), aims, window)?;
    Ok(found.remove(0))
}

/// Places of layouts that are evaluated at once: more of them share what does not depend on places, and take more memory.
const AT_ONCE: usize = 400;

/// The results of [`reached`] for each of several layouts.
///
/// # Errors
/// Those of [`Forms::new`].
pub fn reached_each(
    plants: &[Plant],
    layouts: &[Vec<Point>],
    aims: &[Aim],
    window: f64,
) -> Result<Vec<Vec<Reached>>, PlacementError> {
    let kept = plants.first().map_or(0, Plant::kept);
    let mut found = Vec::with_capacity(layouts.len());
    let mut rest = layouts;
    while !rest.is_empty() {
        let mut total = 0;
        let many = rest.iter().take_while(|layout| {
            total += layout.len();
            total <= AT_ONCE
        });
        let (batch, later) = rest.split_at(many.count().max(1));
        let places: Vec<Point> = batch.iter().flatten().copied().collect();
        let forms = Forms::new(plants, &places, aims, window, 0.0)?;
        let mut first = kept;
        for layout in batch {
            let set: Vec<usize> = (0..kept).chain(first..first + layout.len()).collect();
            first += layout.len();
            found.push(of_targets(&forms, &set, aims.len()));
        }
        rest = later;
    }
    Ok(found)
}

/// Contrast and energy of time reversal to each target from a set of actuators, given by their indices in the forms of one model or of
/// sampled responses. Of forms of several models, the results are those of each target on each model in turn.
pub fn reached_from(forms: &Forms, set: &[usize]) -> Vec<Reached> {
    of_targets(forms, set, forms.cases())
}

/// Contrast and energy of time reversal from a set of actuators to each target.
fn of_targets(forms: &Forms, set: &[usize], targets: usize) -> Vec<Reached> {
    let (peaks, contrasts) = forms.of_set(set);
    let energies: Vec<f64> = forms.energies(&peaks).collect();
    // Cases are in the order of the models, and for each in that of the targets.
    let mean = |of: &[f64], target: usize| {
        let share = |case: usize| of[case] * forms.weights()[case];
        let cases = || (target..forms.cases()).step_by(targets);
        cases().map(share).sum::<f64>() / cases().map(|case| forms.weights()[case]).sum::<f64>()
    };
    let least = |target: usize| {
        (target..forms.cases()).step_by(targets).map(|case| contrasts[case]).fold(f64::INFINITY, f64::min)
    };
    let reached = |target: usize| Reached {
        contrast: mean(&contrasts, target),
        least: least(target),
        energy: mean(&energies, target),
    };
    (0..targets).map(reached).collect()
}

/// The value of an objective for the contrasts at some targets, itself a contrast (ratio).
pub fn figure(reached: &[Reached], aims: &[Aim], objective: Objective) -> f64 {
    let total: f64 = aims.iter().map(|aim| aim.weight).sum();
    let weights: Vec<f64> = aims.iter().map(|aim| aim.weight / total).collect();
    // The worst that may come about, in any model; means and quantiles are over the targets.
    let of = |reached: &Reached| match objective {
        Objective::Worst => reached.least,
        Objective::Mean | Objective::Quantile(_) => reached.contrast,
    };
    let contrasts: Vec<f64> = reached.iter().map(of).collect();
    objective.of(&contrasts, &weights)
}
