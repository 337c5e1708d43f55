use super::layout::{KNOTS, Unknown, Values};
use super::loaded::LoadedModes;
use super::residual::Case;
use super::solve::Found;
use crate::{CalibrateError, Tracker, Tracking};
use faer::Mat;
use unripple_core::{Conditions, ModalResponses, Point, Port, Responses, Surface};
use unripple_physics::Medium;

/// The residual, above what noise explains and as a share of what was measured, from which a model is doubted.
const DOUBTED: f64 = 0.1;

/// How many spreads an unknown may be from what was expected.
const FAR: f64 = 4.0;

/// How many spreads a mass may be below none.
const NEGATIVE: f64 = 0.2;

/// A value and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Its standard error: as large as noise and residual make it if the model is right, and no larger than what was thought before.
    pub error: f64,
}

/// An actuator, or a stray mass, as fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedLoad {
    /// Where, in metres: x and y.
    pub at: [Estimate; 2],
    /// Mass that moves along, in kg. Far less than noise allows may come out negative.
    pub mass: Estimate,
    /// Damping to the ground, in N·s/m.
    pub damping: Estimate,
    /// Gain of the drive over nominal; 1 for a stray. Drive and sense are known but for a factor from one to the other.
    pub drive: Estimate,
    /// Gain of the sensor over nominal.
    pub sense: Estimate,
}

/// Whether a fitted model is to be trusted.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// It explains what was measured.
    Good,
    /// It does not: the surface is something that no value of the unknowns makes.
    Doubtful {
        /// Share of what was measured that neither model nor noise explains.
        unexplained: f64,
        /// Why, in words.
        why: String,
    },
}

/// A model fitted to what was measured, with responses anywhere.
///
/// The mass per area is that of the nominal surface: only tension, bending stiffness and loads over it can be told from responses,
/// the mass itself only together with all gains.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// Mean tension, in N/m.
    pub tension: Estimate,
    /// Bending stiffness, in N·m.
    pub bending_stiffness: Estimate,
    /// Half the difference of the tensions along x and y, over their mean.
    pub anisotropy: Estimate,
    /// Terms cos(pπx/a) cos(qπy/b) of the tension's profile as shares of the mean: [p, q] and the value.
    pub profile: Vec<([u32; 2], Estimate)>,
    /// Amplitude decay time (s) at some frequencies (Hz).
    pub decay: Vec<(f64, Estimate)>,
    /// The actuators in channel order.
    pub actuators: Vec<FittedLoad>,
    /// Masses found elsewhere on the sheet.
    pub strays: Vec<FittedLoad>,
    /// Seconds by which responses between actuators came late.
    pub late: Estimate,
    /// Root of the mean square of the residual, over noise: 1 for a perfect model.
    pub excess: f64,
    /// Residual over what was measured.
    pub residual: f64,
    /// Whether to trust it.
    pub verdict: Verdict,
    responses: ModalResponses,
    sensors: Mat<f64>,
    bending_shares: Vec<f64>,
}

impl Fitted {
    pub(super) fn new(
        case: &Case,
        found: &Found,
        expected: &Values,
        nominal: &Surface,
    ) -> Result<Self, CalibrateError> {
        let covariance = case.covariance(found)?;
        let unknowns = case.layout.unknowns();
        let (mut values, mut thought) = (found.values.clone(), expected.clone());
        let mut estimate = |unknown: Unknown| {
            let place = unknowns.iter().position(|u| *u == unknown).unwrap_or(0);
            let error = covariance[(place, place)].max(0.0).sqrt() * case.layout.spread(unknown);
            Estimate { value: *values.of(unknown), error }
        };
        let scaled = |e: Estimate, by: f64| Estimate {
            value: by * e.value.exp(),
            error: by * e.value.exp() * e.error,
        };
        let medium = Medium::of(&nominal.sheet);
        let actuators = case.layout.actuators;
        let one = Estimate { value: 1.0, error: 0.0 };
        let mut load = |p: usize| FittedLoad {
            at: [estimate(Unknown::Place(p, 0)), estimate(Unknown::Place(p, 1))],
            mass: estimate(Unknown::Mass(p)),
            damping: estimate(Unknown::Resistance(p)),
            drive: if p < actuators { scaled(estimate(Unknown::Drive(p)), 1.0) } else { one },
            sense: if p < actuators { scaled(estimate(Unknown::Sense(p)), 1.0) } else { one },
        };
        let loads: Vec<FittedLoad> = (0..case.layout.loaded()).map(&mut load).collect();
        let far = unknowns.iter().filter(|u| {
            let (value, spread) = (*found.values.clone().of(**u), case.layout.spread(**u));
            let negative = matches!(u, Unknown::Mass(_)) && value < -NEGATIVE * spread;
            negative || (value - *thought.of(**u)).abs() > FAR * spread
        });
        let far: Vec<String> = far.map(|u| format!("{u:?}").to_lowercase()).collect();
        let modes =
            LoadedModes::new(case.basis, &case.system(&found.values)?, &found.values, nominal.emission.band)?;
        let gained = |gains: &[f64]| {
            Mat::from_fn(actuators, modes.poles.len(), |a, m| gains[a].exp() * modes.weights[(a, m)])
        };
        let knot =
            |k: usize, e: Estimate| (KNOTS[k] * case.top, scaled(Estimate { value: -e.value, ..e }, 1.0));
        let terms = case.layout.waves.iter().enumerate();
        Ok(Self {
            tension: scaled(estimate(Unknown::Tension), medium.tension),
            bending_stiffness: scaled(estimate(Unknown::Bending), medium.bending_stiffness),
            anisotropy: estimate(Unknown::Skew),
            profile: terms.map(|(t, wave)| (*wave, estimate(Unknown::Term(t)))).collect(),
            decay: (0..KNOTS.len()).map(|k| knot(k, estimate(Unknown::Knot(k)))).collect(),
            actuators: loads[..actuators].to_vec(),
            strays: loads[actuators..].to_vec(),
            late: estimate(Unknown::Late),
            excess: found.excess,
            residual: found.share,
            verdict: verdict(found, &far),
            sensors: gained(&found.values.sense),
            bending_shares: modes.bending_shares.clone(),
            responses: ModalResponses {
                ports: (nominal.actuators.iter().zip(&found.values.places))
                    .map(|(actuator, at)| Port { name: actuator.name.clone(), at: *at })
                    .collect(),
                input: gained(&found.values.drive),
                poles: modes.poles,
                shapes: modes.shapes,
                conditions: Conditions {
                    rate: nominal.emission.rate,
                    band: nominal.emission.band,
                    lambda_min: Medium {
                        tension: medium.tension * found.values.tension.exp(),
                        bending_stiffness: medium.bending_stiffness * found.values.bending.exp(),
                        ..medium
                    }
                    .lambda_min(nominal.emission.band[1]),
                    outline: nominal.outline.clone(),
                },
            },
        })
    }

    /// The responses of the fitted surface, per unit of each actuator's drive, anywhere.
    pub fn responses(&self) -> Responses {
        Responses::Modal(self.responses.clone())
    }

    /// The same, mode by mode.
    pub fn modal(&self) -> &ModalResponses {
        &self.responses
    }

    /// Weights of each mode in the signal of each actuator's sensor, actuators x modes: for a [`Tracker`](crate::Tracker).
    pub fn sensors(&self) -> &Mat<f64> {
        &self.sensors
    }

    /// Bending's share of each mode's elastic energy.
    pub fn bending_shares(&self) -> &[f64] {
        &self.bending_shares
    }

    /// Share of what was measured that neither model nor noise explains.
    pub fn unexplained(&self) -> f64 {
        unexplained(self.residual, self.excess)
    }

    /// What follows tension, over that at calibration, by this model. What the model leaves unexplained counts as its error, if it is
    /// more than the options say.
    ///
    /// # Errors
    /// Those of [`Tracker::with_sensors`].
    pub fn tracker(&self, options: &Tracking) -> Result<Tracker, CalibrateError> {
        let options = Tracking { model: options.model.max(self.unexplained()), ..options.clone() };
        Tracker::with_sensors(&self.responses, &self.bending_shares, &self.sensors, &options)
    }

    /// Where a stray mass was found.
    pub fn stray_places(&self) -> Vec<Point> {
        self.strays.iter().map(|s| Point::new(s.at[0].value, s.at[1].value)).collect()
    }
}

/// What noise leaves of the residual's square is its share over the square of the excess.
fn unexplained(share: f64, excess: f64) -> f64 {
    share * (1.0 - excess.powi(-2)).max(0.0).sqrt()
}

fn verdict(found: &Found, far: &[String]) -> Verdict {
    let unexplained = unexplained(found.share, found.excess);
    if unexplained > DOUBTED {
        let why = format!(
            "residual of {:.1} % of what was measured, {:.1} times the noise: the surface has something that the model has not",
            100.0 * found.share,
            found.excess
        );
        return Verdict::Doubtful { unexplained, why };
    }
    if !far.is_empty() {
        let why = format!("values far from nominal: {}", far.join(", "));
        return Verdict::Doubtful { unexplained, why };
    }
    Verdict::Good
}
