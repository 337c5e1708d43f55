//! Drives scaled so that the peak velocity at the focus stays constant while tension drifts.

use crate::CalibrateError;
use unripple_core::{ModalResponses, Point, require};
use unripple_physics::sample;

/// Scales drives so that the peak velocity at the focus stays constant while tension changes.
///
/// A drive at its limit makes a different peak velocity when the tension is different. The first drive is therefore scaled to a
/// level a little below the limit (the headroom), and each later one so that it makes the same peak. The peak at place A and
/// instant T is predicted from the present responses: v(A, T) = Σ h·d.
///
/// ```
/// use unripple_calibrate::{Hold, Warp};
/// use unripple_core::{Point, Responses};
/// use unripple_physics::{Medium, ResponseOptions, design::papers_surface, responses};
///
/// let mut surface = papers_surface();
/// surface.emission.band[1] = 500.0;
/// let Responses::Modal(nominal) = responses(&surface, &ResponseOptions::default())? else { unreachable!() };
/// let warmer = Warp::new(&Medium::of(&surface.sheet)).modal(&nominal, 0.98);
///
/// let mut hold = Hold::new(1.0, 0.05)?;
/// let at = Point::from_mm(62.0, 90.0);
/// let mut pulse = vec![vec![0.0; 100]; 8];
/// pulse[0][0] = 3.0;
/// let first = hold.scale(&nominal, at, 80, &mut pulse)?;
/// assert_eq!(pulse[0][0], 0.95);
/// let second = hold.scale(&warmer, at, 80, &mut pulse)?;
/// assert!((second.predicted - first.predicted).abs() < 1e-6 * first.predicted || second.short);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Hold {
    limit: f64,
    headroom: f64,
    wanted: Option<f64>,
}

/// Result of scaling a drive with [`Hold::scale`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held {
    /// Predicted velocity at the focus, in m/s, with its sign.
    pub predicted: f64,
    /// Factor by which the drive was multiplied.
    pub gain: f64,
    /// Whether the peak stays below the constant level because the drive is at its limit.
    pub short: bool,
}

impl Hold {
    /// A scaler for drives whose samples may have a magnitude of at most `limit`, in the drive's unit.
    /// `headroom` is the share of the limit (0 to 1) that the first drive leaves unused; 0.05 is enough for
    /// ±5 % of tension.
    ///
    /// # Errors
    /// [`CalibrateError::Range`] for a limit that is not positive or a headroom that is no share.
    pub fn new(limit: f64, headroom: f64) -> Result<Self, CalibrateError> {
        require("limit of the drive", limit > 0.0 && limit.is_finite(), "a positive number", limit)?;
        require("headroom", (0.0..1.0).contains(&headroom), "0 or more, below 1", headroom)?;
        Ok(Self { limit, headroom, wanted: None })
    }

    /// Peak velocity that is kept constant, in m/s: that of the first drive that moves its focus; `None`
    /// before that drive.
    pub fn level(&self) -> Option<f64> {
        self.wanted
    }

    /// Scales a drive, `[channel][sample]`, so that it makes the peak velocity that is kept constant. The
    /// first drive, scaled to the limit less the headroom, sets that velocity. The peak is the velocity at
    /// `at` and sample `instant`, predicted by `responses` under the present tension.
    ///
    /// # Errors
    /// [`CalibrateError::Count`] for another number of channels than actuators, [`CalibrateError::Range`] for samples that are
    /// not finite.
    pub fn scale(
        &mut self,
        responses: &ModalResponses,
        at: Point,
        instant: usize,
        drive: &mut [Vec<f64>],
    ) -> Result<Held, CalibrateError> {
        let (expected, found) = (responses.ports.len(), drive.len());
        if expected != found {
            let expected = expected.to_string();
            return Err(CalibrateError::Count { what: "channels of the drive", expected, found });
        }
        let mut largest = 0.0_f64;
        for value in drive.iter().flatten() {
            require("sample of a drive", value.is_finite(), "a finite number", *value)?;
            largest = largest.max(value.abs());
        }
        let known = sample(responses, &[at], instant + 1);
        let made = |(a, channel): (usize, &Vec<f64>)| -> f64 {
            let response = known.response(a, 0).iter().rev();
            channel.iter().zip(response).map(|(d, h)| d * f64::from(*h)).sum()
        };
        let peak = drive.iter().enumerate().map(made).sum::<f64>() / responses.conditions.rate;
        if largest == 0.0 || peak == 0.0 {
            return Ok(Held { predicted: 0.0, gain: 1.0, short: self.wanted.is_some() });
        }
        let most = self.limit / largest;
        let wanted = *self.wanted.get_or_insert((1.0 - self.headroom) * most * peak.abs());
        let gain = (wanted / peak.abs()).min(most);
        drive.iter_mut().flatten().for_each(|d| *d *= gain);
        Ok(Held { predicted: gain * peak, gain, short: gain * peak.abs() < wanted * (1.0 - 1e-9) })
    }
}
