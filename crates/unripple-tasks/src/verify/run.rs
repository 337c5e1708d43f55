//! Plays a drive and compares what a probe records with the prediction.

use super::analysis::Analysis;
use super::setting::Setting;
use super::{Ask, Report, bench};
use crate::calibrate::{Hands, nobody};
use crate::{DeviceKind, Progress, TaskError, go_on};

/// Plays a drive through a device that needs no person at the surface, and compares; for others use [`run_with`].
///
/// ```
/// use unripple_tasks::field::DriveAsk;
/// use unripple_tasks::verify::{Ask, State, run};
/// use unripple_tasks::{Silent, SurfaceAsk};
///
/// // A pulse of a millisecond from the first of eight actuators.
/// let pulse: Vec<f64> = (0..48).map(|i| 0.1 * (0.13 * f64::from(i)).sin().powi(2)).collect();
/// let channels = std::iter::once(pulse).chain(std::iter::repeat_n(vec![0.0; 48], 7)).collect();
/// let set = [("drive.band_hz".to_owned(), "[0, 500]".to_owned())].into();
/// let ask = Ask {
///     surface: SurfaceAsk::Set { name: "hudin-2012".into(), set },
///     drive: DriveAsk::Samples { channels, rate_hz: 48e3 },
///     target_m: Some([0.062, 0.090]),
///     dry_run: true,
///     ..Ask::default()
/// };
/// let report = run(&ask, &mut Silent)?;
/// // The target and two places: at 500 Hz focal discs are large, and leave room for two outside.
/// assert_eq!((report.state, report.places.len()), (State::Planned, 3));
/// assert!(report.predicted.velocity_m_s != 0.0 && report.measured.is_none());
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// Those of [`run_with`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    run_with(ask, nobody(), progress)
}

/// Plays a drive and compares as [`run()`] does, and calls `hands` to ask a person to move the probe.
///
/// # Errors
/// [`TaskError::Ask`] of options that make no sense, and of a drive beyond the surface's limit; those of surfaces, libraries, drives
/// and devices; [`TaskError::Work`] where the bench is much louder than predicted; [`TaskError::Cancelled`].
pub fn run_with(ask: &Ask, hands: Hands, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    if ask.device.device == DeviceKind::Tape {
        return Err(TaskError::ask("device", "one that plays and records at once", "tape"));
    }
    go_on(progress)?;
    let setting = Setting::of(ask, progress)?;
    let planned = Report::planned(&setting, ask.level);
    if ask.dry_run {
        return Ok(planned);
    }
    let recorded = bench::play(ask, &setting, hands, progress)?;
    go_on(progress)?;
    progress.stage("causes");
    let analysis = Analysis::of(&setting, &recorded)?;
    Ok(planned.with(&setting, &recorded, &analysis))
}
