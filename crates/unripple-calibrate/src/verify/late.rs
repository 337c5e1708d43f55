//! The delay of responses between actuators, from a model that is fitted to them.

use super::quick::{Part, SPOILT};
use super::verdict::VerifyOptions;
use crate::fit::{Estimate, FitOptions, Measured, fit};
use unripple_core::Surface;

/// Number of modes in the band that is fitted. More take longer; with fewer, a delay by a hundredth of a sample is not seen.
const MODES: usize = 20;

/// Highest frequency of the modes used, relative to the top of the band: the remaining effect of modes above
/// looks like a delay, a few hundredths of a sample with 2.5.
const REACH: f64 = 4.0;

/// Common delay, in s, of the responses between actuators relative to a model [fitted](crate::fit) to them
/// in the lowest modes. `dead` are indices of actuators that are left out. `None` if no model explains the
/// responses well enough.
///
/// If damping couples modes, the phases of tones depend on the surface, and a model that was not fitted
/// cannot separate them from a delay.
///
/// ```
/// use unripple_calibrate::signals::{Band, shift};
/// use unripple_calibrate::{Measured, verify};
/// use unripple_core::{Point, Responses};
/// use unripple_physics::{ResponseOptions, design::papers_surface, responses, sample};
///
/// let mut surface = papers_surface();
/// surface.emission.band[1] = 600.0;
/// let above = ResponseOptions { max_hz: Some(2400.0), ..ResponseOptions::default() };
/// let Responses::Modal(modal) = responses(&surface, &above)? else { unreachable!() };
/// let own: Vec<Point> = surface.actuators.iter().map(|a| a.at).collect();
/// let heard = sample(&modal, &own, 9600);
/// // As they are measured: limited to a band, 0.3 samples late, from time 0.
/// let band = Band::within(60.0, 720.0);
/// let mut pairs = Vec::new();
/// for n in 0..64 {
///     let mut signal = vec![0.0; 240];
///     signal.extend(heard.response(n / 8, n % 8).iter().map(|v| f64::from(*v)));
///     band.limit(&mut signal, 48e3)?;
///     pairs.push(shift(&signal, 0.3).split_off(240));
/// }
/// let measured = Measured::pairs(48e3, pairs, 1e-3).limited_to(band);
/// let found = verify::late(&surface, &measured, &[]).expect("a model fits");
/// assert!((found.value * 48e3 - 0.3).abs() < 0.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn late(surface: &Surface, measured: &Measured, dead: &[usize]) -> Option<Estimate> {
    let options = VerifyOptions { dead: dead.to_vec(), modes: MODES, ..VerifyOptions::default() };
    let Part { surface, heard, band, .. } = Part::of(surface, measured, &options).ok()?;
    let plan = FitOptions { band: Some(band), reach: REACH, ..FitOptions::default() };
    let fitted = fit(&surface, &heard, &plan).ok()?;
    (fitted.unexplained() < SPOILT).then_some(fitted.late)
}
