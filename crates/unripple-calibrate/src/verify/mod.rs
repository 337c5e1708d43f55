//! Check of probed responses against a model that is fitted to the sensors' recordings.

mod checker;
mod copies;
mod judge;
mod late;
mod levels;
mod quick;
mod sensors;
mod sheet;
mod verdict;
mod words;

pub use late::late;
pub use verdict::{Checked, Doubted, PointVerdict, Verified, VerifyOptions};

use crate::CalibrateError;
use crate::fit::{Fitted, Measured};
use checker::Projected;
use judge::{Bench, Judged, Kind};
use quick::Quick;
use rayon::prelude::*;
use sheet::Sheet;
use std::f64::consts::TAU;
use unripple_core::{SampledResponses, Surface, require};
use unripple_physics::Medium;

/// Compares each probed response with that of a fitted model at its place; gain, sign and delay may differ.
///
/// The model is [fitted](crate::fit) to the responses between actuators, in the lowest modes, so that errors
/// of the surface file do not make good data look bad. If it leaves too much of them unexplained, there is
/// no comparison, and the result reports that. If a point's responses do not fit its place, the whole sheet
/// is searched, so that exchanged recordings, a probe beside its place and a probe on an actuator's channel
/// are identified.
///
/// `measured` holds the responses between actuators, `probed` the responses of the same actuators at the probed points.
///
/// # Errors
/// [`CalibrateError::Count`] and [`CalibrateError::Range`] for measurements that do not belong together.
///
/// ```
/// use unripple_calibrate::Measured;
/// use unripple_calibrate::verify::{VerifyOptions, check};
/// use unripple_core::{Point, Responses};
/// use unripple_physics::{ResponseOptions, design::papers_surface, responses, sample};
///
/// let mut surface = papers_surface();
/// surface.emission.band[1] = 600.0;
/// let above = ResponseOptions { max_hz: Some(1200.0), ..ResponseOptions::default() };
/// let Responses::Modal(modal) = responses(&surface, &above)? else { unreachable!() };
/// let own: Vec<Point> = surface.actuators.iter().map(|a| a.at).collect();
/// let heard = sample(&modal, &own, 4800);
/// let signal = |n: usize| heard.response(n / 8, n % 8).iter().map(|v| f64::from(*v)).collect();
/// let measured = Measured::pairs(48e3, (0..64).map(signal).collect(), 1e-3);
/// // The probe stood 20 mm beside the second of two points.
/// let said = [Point::from_mm(62.0, 90.0), Point::from_mm(100.0, 60.0)];
/// let stood = [said[0], Point::from_mm(120.0, 60.0)];
/// let mut probed = sample(&modal, &stood, 4800);
/// probed.points = said.to_vec();
/// let found = check(&surface, &measured, &probed, &VerifyOptions::default())?;
/// assert_eq!(found.doubts.len(), 1);
/// assert_eq!(found.doubts[0].points, [1]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn check(
    surface: &Surface,
    measured: &Measured,
    probed: &SampledResponses,
    options: &VerifyOptions,
) -> Result<Verified, CalibrateError> {
    together(surface, measured, probed)?;
    let copies = copies::doubts(probed, options);
    if !options.model {
        return Ok(Verified::without("it was not asked for".into(), copies));
    }
    let quick = Quick::new(surface, measured, probed, options);
    Ok(judged(quick, surface, probed, options, copies))
}

/// Compares each probed response as [`check`] does, with a model that has already been fitted to the
/// responses between all actuators.
///
/// # Errors
/// Those of [`check`].
pub fn check_by(
    fitted: &Fitted,
    surface: &Surface,
    measured: &Measured,
    probed: &SampledResponses,
    options: &VerifyOptions,
) -> Result<Verified, CalibrateError> {
    together(surface, measured, probed)?;
    let copies = copies::doubts(probed, options);
    let quick = Quick::known(fitted, surface, measured, probed, options);
    Ok(judged(quick, surface, probed, options, copies))
}

/// Checks that probed responses have the number of actuators of the surface and the sample rate of
/// `measured`.
fn together(surface: &Surface, measured: &Measured, probed: &SampledResponses) -> Result<(), CalibrateError> {
    let (expected, found) = (surface.actuators.len(), probed.ports.len());
    if expected != found {
        let what = "actuators of the probed responses";
        return Err(CalibrateError::Count { what, expected: expected.to_string(), found });
    }
    let rate = probed.conditions.rate;
    Ok(require("sample rate of the probed responses in Hz", rate == measured.rate, "the sensors'", rate)?)
}

/// The result of the check against a model, or the reason why there is no model.
fn judged(
    quick: Result<Quick, String>,
    surface: &Surface,
    probed: &SampledResponses,
    options: &VerifyOptions,
    copies: Vec<Doubted>,
) -> Verified {
    match quick {
        Ok(quick) => against(&quick, surface, probed, options, copies),
        Err(why) => Verified::without(why, copies),
    }
}

/// Checks all points against a model.
fn against(
    quick: &Quick,
    surface: &Surface,
    probed: &SampledResponses,
    options: &VerifyOptions,
    copies: Vec<Doubted>,
) -> Verified {
    let checker = quick.checker();
    let wavenumber = Medium::of(&surface.sheet).wavenumber(TAU * quick.band[1]);
    let sheet = Sheet::new(&checker, &surface.outline, wavenumber, quick.band[1]);
    let wave = TAU / wavenumber;
    let bench = Bench { quick, sheet: &sheet, surface, places: &probed.points, options, wave };
    let mut doubts = copies.clone();
    doubts.extend(sensors::doubts(&bench));
    let heard: Vec<Projected> = quick.probed.par_iter().map(|spectra| checker.project(spectra)).collect();
    let common = bench.common(&heard);
    let judged: Vec<Judged> =
        heard.par_iter().enumerate().map(|(p, heard)| bench.judge(p, heard, common)).collect();
    let here: Vec<bool> = judged.iter().map(|j| j.kind == Kind::Here).collect();
    let levels = levels::Levels::of(&judged);
    let points: Vec<PointVerdict> =
        (0..judged.len()).map(|p| words::verdict(&bench, &judged, &levels, p, common)).collect();
    let mut notes = Vec::new();
    words::gather(&bench, &points, (&judged, &levels), (&mut notes, &mut doubts));
    let delay = common - quick.fitted.late.value;
    let told = options.probe && here.iter().any(|here| *here) && delay.abs() > bench.worth(&judged);
    if let Some(why) = words::delay(options, delay, told) {
        doubts.push(why);
    }
    Verified {
        model: Checked::Against { band: quick.band, unexplained: quick.fitted.unexplained() },
        points,
        probe_delay: told.then_some(delay),
        gain: levels.common,
        notes,
        copies,
        doubts,
    }
}
