//! A surface's model as fitted from its actuators alone.

use super::coil::Coil;
use super::following::Following;
use super::layout::{KNOTS, Unknown, Values};
use super::loaded::LoadedModes;
use super::reached::Reached;
use super::residual::Case;
use super::solve::Found;
use crate::signals::Band;
use crate::{CalibrateError, Tracker, Tracking};
use unripple_core::{Conditions, ModalResponses, Point, Port, Responses, Surface};
use unripple_linalg::{Mat, Scale};
use unripple_physics::Medium;

/// The share of what was measured that neither model nor noise explains from which a model is called doubtful: a
/// tenth, as amplitude.
const DOUBTED: f64 = 0.1;

/// How many spreads an unknown may be from what was expected. Of values drawn from a normal distribution one in 16
/// 000 lies farther.
const FAR: f64 = 4.0;

/// How many spreads a mass may be below none. Less than that is what noise makes of a mass of 0.
const NEGATIVE: f64 = 0.2;

/// A value and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value found, in SI.
    pub value: f64,
    /// Its standard error: as large as noise and residual make it if the model is right, and no larger than its prior.
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
/// The mass per area is that of the nominal surface: only tension, bending stiffness and loads over it can be found
/// from responses, the mass itself only together with all gains.
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
    unexplained: f64,
    /// Whether to trust it.
    pub verdict: Verdict,
    responses: ModalResponses,
    beyond: ModalResponses,
    /// Beyond the surface's band as far as the measurement's, where that has one.
    reached: Option<Reached>,
    sensors: Mat<f64>,
    bending_shares: Vec<f64>,
    coils: Vec<Option<Coil>>,
}

/// The unknowns of the model as fitted, with their errors.
struct Answers<'a> {
    case: &'a Case<'a>,
    found: &'a Found,
    variances: Vec<f64>,
    /// Logarithms of nominal gains.
    gains: Vec<f64>,
}

impl Answers<'_> {
    fn of(&self, unknown: Unknown) -> Estimate {
        let place = self.case.layout.unknowns().iter().position(|u| *u == unknown).unwrap_or(0);
        let error = self.variances[place].max(0.0).sqrt() * self.case.layout.spread(unknown);
        Estimate { value: *self.found.values.clone().of(unknown), error }
    }

    /// Of a logarithm.
    fn ratio(&self, unknown: Unknown, by: f64) -> Estimate {
        let Estimate { value, error } = self.of(unknown);
        Estimate { value: by * value.exp(), error: by * value.exp() * error }
    }

    fn load(&self, p: usize) -> FittedLoad {
        let one = Estimate { value: 1.0, error: 0.0 };
        let own = |unknown, level: f64| match self.gains.get(p) {
            Some(nominal) => self.ratio(unknown, (level - nominal).exp()),
            None => one,
        };
        FittedLoad {
            at: [self.of(Unknown::Place(p, 0)), self.of(Unknown::Place(p, 1))],
            mass: self.of(Unknown::Mass(p)),
            damping: self.of(Unknown::Resistance(p)),
            drive: own(Unknown::Drive(p), 0.0),
            sense: own(Unknown::Sense(p), self.found.values.level),
        }
    }

    /// Unknowns that are farther from what was expected than such values are. Gains may be anything.
    fn far(&self, expected: &Values) -> Vec<String> {
        let (mut values, mut thought) = (self.found.values.clone(), expected.clone());
        let far = |u: &Unknown| {
            if matches!(u, Unknown::Drive(_) | Unknown::Sense(_) | Unknown::Level) {
                return false;
            }
            let (value, spread) = (*values.of(*u), self.case.layout.spread(*u));
            let negative = matches!(u, Unknown::Mass(_)) && value < -NEGATIVE * spread;
            negative || (value - *thought.of(*u)).abs() > FAR * spread
        };
        let mut all = self.case.layout.unknowns();
        let mut far = far;
        all.retain(|u| far(u));
        all.iter().map(|u| format!("{u:?}").to_lowercase()).collect()
    }

    /// Modes of a band (Hz) as responses, and as the sensors'.
    fn responses(&self, band: [f64; 2], nominal: &Surface) -> Result<Modelled, CalibrateError> {
        let values = &self.found.values;
        let system = self.case.system(values)?;
        let modes = LoadedModes::new(self.case.basis, &system, values, band)?;
        let gained = |gain: &dyn Fn(usize) -> f64| {
            Mat::from_fn(self.gains.len(), modes.poles.len(), |a, m| gain(a) * modes.weights[(a, m)])
        };
        let medium = Medium::of(&nominal.sheet);
        let fitted = Medium {
            tension: medium.tension * values.tension.exp(),
            bending_stiffness: medium.bending_stiffness * values.bending.exp(),
            ..medium
        };
        let ports = nominal.actuators.iter().zip(&values.places);
        Ok(Modelled {
            sensors: gained(&|a| (values.sense[a] + values.level).exp()),
            responses: ModalResponses {
                ports: ports.map(|(a, at)| Port { name: a.name.clone(), at: *at }).collect(),
                input: gained(&|a| values.drive[a].exp()),
                poles: modes.poles,
                shapes: modes.shapes,
                conditions: Conditions {
                    rate: nominal.emission.rate,
                    band: nominal.emission.band,
                    lambda_min: fitted.lambda_min(nominal.emission.band[1]),
                    outline: nominal.outline.clone(),
                },
            },
            bending_shares: modes.bending_shares,
        })
    }
}

/// Modes with all that is read from them.
struct Modelled {
    responses: ModalResponses,
    sensors: Mat<f64>,
    bending_shares: Vec<f64>,
}

impl Fitted {
    pub(super) fn new(
        case: &Case,
        found: &Found,
        expected: &Values,
        (nominal, limited): (&Surface, Option<Band>),
    ) -> Result<Self, CalibrateError> {
        let answers = Answers { case, found, variances: case.variances(found)?, gains: case.basis.gains() };
        let Modelled { responses, sensors, bending_shares } =
            answers.responses(nominal.emission.band, nominal)?;
        let knot = |k: usize| {
            let rate = answers.ratio(Unknown::Knot(k), 1.0);
            let time = 1.0 / rate.value;
            (KNOTS[k] * case.top, Estimate { value: time, error: time * rate.error / rate.value })
        };
        let loads: Vec<FittedLoad> = (0..case.layout.loaded()).map(|p| answers.load(p)).collect();
        let actuators = case.layout.actuators;
        let medium = Medium::of(&nominal.sheet);
        let terms = case.layout.waves.iter().enumerate();
        let following = Following::of(&found.residual.lines);
        let beyond = answers.responses([0.0, f64::INFINITY], nominal)?.responses;
        Ok(Self {
            tension: answers.ratio(Unknown::Tension, medium.tension),
            bending_stiffness: answers.ratio(Unknown::Bending, medium.bending_stiffness),
            anisotropy: answers.of(Unknown::Skew),
            profile: terms.map(|(t, wave)| (*wave, answers.of(Unknown::Term(t)))).collect(),
            decay: (0..KNOTS.len()).map(knot).collect(),
            actuators: loads[..actuators].to_vec(),
            strays: loads[actuators..].to_vec(),
            late: answers.of(Unknown::Late),
            excess: found.excess,
            residual: found.share,
            unexplained: following.share,
            verdict: verdict(found, following.share, &answers.far(expected)),
            sensors,
            bending_shares,
            coils: case.basis.coils.clone(),
            reached: limited.map(|band| Reached::of(&beyond, band)),
            responses,
            beyond,
        })
    }

    /// The responses of the fitted surface, per unit of each actuator's drive, anywhere; of coils on a voltage, as if they had no
    /// inductance: with it they are those of [`Fitted::sampled`].
    pub fn responses(&self) -> Responses {
        Responses::Modal(self.responses.clone())
    }

    /// The modal responses of the fitted surface.
    pub fn modal(&self) -> &ModalResponses {
        &self.responses
    }

    /// The same model with some of its actuators only.
    pub(crate) fn among(&self, actuators: &[usize]) -> Self {
        let part = |responses: &ModalResponses| ModalResponses {
            ports: actuators.iter().map(|a| responses.ports[*a].clone()).collect(),
            input: Mat::from_fn(actuators.len(), responses.poles.len(), |a, m| {
                responses.input[(actuators[a], m)]
            }),
            ..responses.clone()
        };
        Self {
            actuators: actuators.iter().map(|a| self.actuators[*a]).collect(),
            coils: actuators.iter().map(|a| self.coils[*a].clone()).collect(),
            responses: part(&self.responses),
            beyond: part(&self.beyond),
            reached: self.reached.as_ref().map(|reached| reached.with(part)),
            ..self.clone()
        }
    }

    /// The same with all modes that the fit worked with, those outside the band too.
    pub(crate) fn beyond(&self) -> &ModalResponses {
        &self.beyond
    }

    /// The model through the measurement's band, where that has one.
    pub(super) fn reached(&self) -> Option<&Reached> {
        self.reached.as_ref()
    }

    /// The circuit of an actuator, if it is a coil on a voltage.
    pub(crate) fn coil(&self, actuator: usize) -> Option<&Coil> {
        self.coils.get(actuator).and_then(Option::as_ref)
    }

    /// The same model with all responses multiplied by a gain, a ratio: in the scale of a probe that is not the
    /// sensors'.
    #[must_use]
    pub fn scaled(mut self, gain: f64) -> Self {
        let reached = self.reached.as_mut().map(|reached| &mut reached.responses);
        for responses in [&mut self.responses, &mut self.beyond].into_iter().chain(reached) {
            responses.input = &responses.input * Scale(gain);
        }
        self
    }

    /// Weights of each mode in the signal of each actuator's sensor, actuators x modes: for a [`Tracker`](crate::Tracker).
    pub fn sensors(&self) -> &Mat<f64> {
        &self.sensors
    }

    /// Bending's share of each mode's elastic energy.
    pub fn bending_shares(&self) -> &[f64] {
        &self.bending_shares
    }

    /// Share of what was measured, as amplitude, that neither model nor noise explains: what of the residual is large where the signal
    /// is large, whatever the noise was said to be.
    pub fn unexplained(&self) -> f64 {
        self.unexplained
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

    /// Places (m) of the stray masses that were found.
    pub fn stray_places(&self) -> Vec<Point> {
        self.strays.iter().map(|s| Point::new(s.at[0].value, s.at[1].value)).collect()
    }
}

fn verdict(found: &Found, unexplained: f64, far: &[String]) -> Verdict {
    if unexplained > DOUBTED {
        let why = format!(
            "{:.1} % of the signal amplitude is explained neither by the model nor by noise, in a residual of {:.1} times the \
             noise: the surface has something that the model has not, or changed while it was measured",
            100.0 * unexplained,
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
