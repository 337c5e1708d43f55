//! How loud a drive is: the sound pressure level above the surface.

use super::ActError;
use crate::core::{Drive, ModalResponses, Point, Responses, Surface};
use crate::dsp::REFERENCE_PRESSURE;
use crate::field::{FieldError, Listener, Pressure, Radiated};
use crate::physics::{AIR_CELERITY, AIR_DENSITY, Medium};
use serde::Serialize;
use std::f64::consts::TAU;

/// Usual height of the listener above the middle of the surface, in metres: about that of a head over a device in the hand. With twice
/// this value, levels are about 6 dB lower.
pub const LISTEN_M: f64 = 0.3;

/// Why levels of a library are not known.
const SCATTERED: &str = "the responses are known at the points of a library only, and sound comes from the motion between them too";

/// Why levels are not known where the scale of the responses is not.
const WITHOUT_SCALE: &str = "the scale of the responses is not known";

/// The sound of a drive at a listener above the middle of the surface, as levels in dB re 20 µPa.
///
/// It is that of the surface in a rigid baffle, of one face, by the Rayleigh integral in air at 20 °C. Without a baffle the two faces
/// partly cancel, and a sheet radiates less below coincidence: the levels are upper bounds there as long as the sheet is small against the
/// waves in air. Of shorter waves, diffraction at the rim may add to the level at some places, as on the axis. Levels that do not apply are
/// `None`: those of a single event have no mean, and those of a repeated one no exposure. All are `None` for a silent drive.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sound {
    /// The listener's place x, y, z, in metres: above the middle of the bounding box of the surface.
    pub at_m: [f64; 3],
    /// Mean level of a repeated drive over its last period, A-weighted (LAeq), in dB.
    pub a_weighted_level_db: Option<f64>,
    /// Mean level of a repeated drive over its last period, unweighted (LZeq), in dB.
    pub level_db: Option<f64>,
    /// Sound exposure level of a single drive with all that rings after it, A-weighted (LAE), in dB re (20 µPa)² s.
    pub a_weighted_exposure_db: Option<f64>,
    /// Sound exposure level of a single drive with all that rings after it, unweighted (LZE), in dB re (20 µPa)² s.
    pub exposure_db: Option<f64>,
    /// Level of the largest pressure, unweighted (LZpeak), in dB.
    pub peak_db: Option<f64>,
    /// Why no level is known; absent if levels are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unknown: Option<String>,
}

/// What a listener hears of a surface, for any number of drives.
#[derive(Debug)]
pub struct Hearing<'a> {
    at: [f64; 3],
    radiated: Result<Radiated<'a>, String>,
}

impl<'a> Hearing<'a> {
    /// A listener `height` metres above the middle of a surface that moves as `responses` say. On sampled responses, and on a surface
    /// with too many modes and waves for the memory, the levels are unknown.
    ///
    /// # Errors
    /// [`ActError::Field`] for a height that is not a positive number.
    pub fn new(surface: &Surface, responses: &'a Responses, height: f64) -> Result<Self, ActError> {
        let (width, depth) = responses.conditions().outline.extent();
        let above = Point::new(width / 2.0, depth / 2.0);
        let at = [above.x, above.y, height];
        let Responses::Modal(modal) = responses else {
            return Ok(Self { at, radiated: Err(SCATTERED.to_owned()) });
        };
        let top = highest_hz(modal);
        let wavelength = Medium::of(&surface.sheet).lambda_min(top).min(AIR_CELERITY / top);
        let listener = Listener { above, height, density: AIR_DENSITY, celerity: AIR_CELERITY, wavelength };
        let radiated = match Radiated::new(responses, &listener) {
            Ok(radiated) => radiated.ok_or_else(|| SCATTERED.to_owned()),
            Err(FieldError::Count { what, expected, found }) => {
                Err(format!("{what}: expected {expected}, found {found}"))
            }
            Err(error) => return Err(error.into()),
        };
        Ok(Self { at, radiated })
    }

    /// The sound of a drive, of its last period if it is repeated with a `period` (s).
    ///
    /// # Errors
    /// Those of [`Radiated::pressure`].
    pub fn sound(&self, drive: &Drive, period: Option<f64>) -> Result<Sound, ActError> {
        let none = Sound::without_levels(self.at, None);
        let radiated = match &self.radiated {
            Ok(radiated) => radiated,
            Err(why) => return Ok(Sound { unknown: Some(why.clone()), ..none }),
        };
        let pressure = radiated.pressure(drive, period)?;
        let Pressure { exposure, a_weighted_exposure, duration, .. } = pressure;
        let peak_db = level(pressure.peak().powi(2));
        Ok(match period {
            Some(_) => Sound {
                a_weighted_level_db: level(a_weighted_exposure / duration),
                level_db: level(exposure / duration),
                peak_db,
                ..none
            },
            None => Sound {
                a_weighted_exposure_db: level(a_weighted_exposure),
                exposure_db: level(exposure),
                peak_db,
                ..none
            },
        })
    }
}

impl Sound {
    /// The sound at a place (m) of which no level is known, and why if there is a reason.
    fn without_levels(at_m: [f64; 3], unknown: Option<String>) -> Self {
        let [a_weighted_level_db, level_db, a_weighted_exposure_db, exposure_db, peak_db] = [None; 5];
        Self { at_m, a_weighted_level_db, level_db, a_weighted_exposure_db, exposure_db, peak_db, unknown }
    }

    /// The sound of which no level is known, for responses without a scale.
    #[must_use]
    pub fn without_scale(self) -> Self {
        Self::without_levels(self.at_m, self.unknown.or_else(|| Some(WITHOUT_SCALE.to_owned())))
    }

    /// The A-weighted level in dB: the mean one of a repeated drive, or the exposure level of a single one.
    pub fn a_weighted_db(&self) -> Option<f64> {
        self.a_weighted_level_db.or(self.a_weighted_exposure_db)
    }

    /// The levels in words, one line.
    pub fn text(&self) -> String {
        let at = format!("sound {} m above the middle", self.at_m[2]);
        if let Some(why) = &self.unknown {
            return format!("{at}: unknown ({why})");
        }
        let all = |a: Option<f64>, z: Option<f64>| Some((a?, z?, self.peak_db?));
        let mean = all(self.a_weighted_level_db, self.level_db);
        let event = all(self.a_weighted_exposure_db, self.exposure_db);
        let levels = match (mean, event) {
            (Some((a, z, peak)), _) => {
                format!("{a:.1} dB(A) on average (LAeq), {z:.1} dB unweighted, peak {peak:.1} dB")
            }
            (None, Some((a, z, peak))) => format!(
                "{a:.1} dB(A) sound exposure level of one drive (LAE), {z:.1} dB unweighted, peak {peak:.1} dB"
            ),
            (None, None) => return format!("{at}: none"),
        };
        format!(
            "{at}: {levels}; as in a rigid baffle, without which the sheet radiates less below coincidence"
        )
    }
}

/// Level of a squared pressure (Pa²) in dB re 20 µPa; `None` for silence.
fn level(square: f64) -> Option<f64> {
    (square > 0.0).then(|| 10.0 * (square / REFERENCE_PRESSURE.powi(2)).log10())
}

/// The highest natural frequency (Hz), but at least the top of the band and at most half the sample rate.
fn highest_hz(modal: &ModalResponses) -> f64 {
    let highest = modal.poles.iter().map(|pole| pole.omega / TAU).fold(modal.conditions.band[1], f64::max);
    highest.min(modal.conditions.rate / 2.0)
}
