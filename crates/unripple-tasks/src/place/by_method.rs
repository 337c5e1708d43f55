//! Drives of focusing methods, evaluated before and after actuators were placed.

use super::budget::JUDGED;
use super::second::leading;
use super::setting::Setting;
use crate::{Progress, Solved, TaskError, go_on, judge};
use serde::Serialize;
use unripple::act::{Act, ActError, Level, Readouts, carries};
use unripple::core::Surface;
use unripple::focus::{Focuser, Method, Options, Target};
use unripple_placement::Aim;

/// Metrics of the drives of one focusing method, averaged over some targets with their weights and simulated on modes up to twice the top
/// of the band.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ByMethod {
    /// Name of the method.
    pub method: &'static str,
    /// Number of targets, each with a drive of its own.
    pub targets: usize,
    /// Results from the surface's own actuators; absent where it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub before: Option<Means>,
    /// Results from the actuators as placed, with their loads.
    pub after: Means,
}

/// Metrics averaged over some targets, with their weights; absent where a metric is not defined at one of them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Means {
    /// Contrast at the focal instant.
    pub contrast: Option<f64>,
    /// Felt contrast, in dB.
    pub felt_contrast_db: Option<f64>,
    /// Felt level at the target with the drive at its limit, in dB above the threshold of touch.
    pub felt_level_db: Option<f64>,
    /// Energy of the drive for a peak velocity of 1 m/s, in squared units of drive times seconds.
    pub energy_for_peak: Option<f64>,
}

/// Results of every method on the surface with its own actuators and with the placed ones.
pub(super) fn each(
    methods: &[Method],
    setting: &Setting,
    built: &Surface,
    progress: &mut dyn Progress,
) -> Result<Vec<ByMethod>, TaskError> {
    if methods.is_empty() {
        return Ok(Vec::new());
    }
    let aims = leading(setting, &setting.tested, JUDGED);
    let own = &setting.surface;
    let before = match own.actuators.is_empty() {
        true => None,
        false => Some(means(methods, own, &aims, setting.window, progress)?),
    };
    let after = means(methods, built, &aims, setting.window, progress)?;
    let each = methods.iter().zip(after).enumerate().map(|(i, (method, after))| ByMethod {
        method: method.name(),
        targets: aims.len(),
        before: before.as_ref().map(|before| before[i].clone()),
        after,
    });
    Ok(each.collect())
}

/// Results of every method on a surface.
fn means(
    methods: &[Method],
    surface: &Surface,
    aims: &[Aim],
    window: f64,
    progress: &mut dyn Progress,
) -> Result<Vec<Means>, TaskError> {
    let solved = Solved::default();
    let known = solved.model(surface, None, &[])?;
    go_on(progress)?;
    let (judge::Models { free: plant, .. }, _) = judge::models(surface, None, &[], &solved)?;
    carries(known.conditions(), window)?;
    let on = Readouts::of(&plant);
    let total: f64 = aims.iter().map(|aim| aim.weight).sum();
    let mut all = Vec::with_capacity(methods.len());
    for method in methods {
        let options = Options {
            method: *method,
            window,
            limit: surface.emission.limit,
            rms_limit: surface.emission.rms_limit,
            ..Options::default()
        };
        let focuser = Focuser::new(&known, &options).map_err(ActError::from)?;
        let mut sums = [Some(0.0); 4];
        for aim in aims {
            go_on(progress)?;
            let targets = [Target::at(aim.at)];
            let act =
                Act { surface, responses: &plant, targets: &targets, options: &options, level: Level::Limit };
            let focused = focuser.focus(&targets).map_err(ActError::from)?;
            let measured = act.measure(&act.send(&focuser, focused, &on)?, &on)?;
            let (found, peak) = (&measured.targets[0], measured.targets[0].peak_velocity_m_s);
            let energy = measured.drive.energy / (peak * peak);
            let values = [found.contrast, found.felt_contrast_db, found.felt_level_db, Some(energy)];
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum = sum.zip(value).map(|(sum, value)| sum + value * aim.weight / total);
            }
        }
        let [contrast, felt_contrast_db, felt_level_db, energy_for_peak] = sums;
        all.push(Means { contrast, felt_contrast_db, felt_level_db, energy_for_peak });
    }
    Ok(all)
}
