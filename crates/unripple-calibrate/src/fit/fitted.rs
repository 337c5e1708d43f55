//! A fitted model of a surface: values, standard errors and responses.

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

/// Smallest unexplained share of the measured signals, as amplitude, at which a model is reported as
/// doubtful.
const DOUBTED: f64 = 0.1;

/// Largest accepted distance of an unknown from its expected value, in standard deviations of its prior. Of values from a normal
/// distribution one in 16 000 lies farther.
const FAR: f64 = 4.0;

/// Largest accepted negative mass, in standard deviations of its prior: noise turns a mass of 0 into values down to this. [`FAR`] standard
/// errors are accepted as well, where they are more: they grow with what the model leaves unexplained.
const NEGATIVE: f64 = 0.2;

/// A value and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value found, in the quantity's SI unit.
    pub value: f64,
    /// Standard error of the value, from noise and residual, if the model is right; at most the standard deviation of its prior.
    pub error: f64,
}

/// Fitted properties of an actuator, or of a stray mass (one that the surface file does not contain).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedLoad {
    /// Place on the surface, x and y, in metres.
    pub at: [Estimate; 2],
    /// Mass that moves with the sheet, in kg. A mass much smaller than its error may come out negative.
    pub mass: Estimate,
    /// Damping to the ground, in N·s/m.
    pub damping: Estimate,
    /// Gain of the drive, relative to nominal; 1 for a stray mass. A factor common to all drives cannot be
    /// distinguished from its inverse on all sensors.
    pub drive: Estimate,
    /// Gain of the sensor, relative to nominal; 1 for a stray mass.
    pub sense: Estimate,
}

/// Whether a fitted model is to be trusted.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The model explains the measurement.
    Good,
    /// The model does not explain the measurement, or only with values far from nominal.
    Doubtful {
        /// Share of the measured signals, as amplitude, that neither model nor noise explains.
        unexplained: f64,
        /// The reason for the doubt, in words.
        why: String,
    },
}

/// A model of a surface fitted to measurements, with responses at any place.
///
/// The mass per area is that of the nominal surface: responses determine only the ratios of tension, bending stiffness and loads to
/// it. The mass itself cannot be told from a gain common to all responses.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// Mean tension, in N/m.
    pub tension: Estimate,
    /// Bending stiffness, in N·m.
    pub bending_stiffness: Estimate,
    /// Half the difference of the tensions along x and y, over their mean.
    pub anisotropy: Estimate,
    /// Terms cos(pπx/a) cos(qπy/b) of the tension's profile, a and b the width and height of the surface: [p, q] and the amplitude as
    /// a share of the mean tension.
    pub profile: Vec<([u32; 2], Estimate)>,
    /// Amplitude decay time (s) at some frequencies (Hz).
    pub decay: Vec<(f64, Estimate)>,
    /// Fitted properties of the actuators, in channel order.
    pub actuators: Vec<FittedLoad>,
    /// Stray masses found on the sheet, which the surface file does not contain.
    pub strays: Vec<FittedLoad>,
    /// Remaining latency of the responses between actuators, in s.
    pub late: Estimate,
    /// Rms residual of the fit, relative to the noise: 1 for a perfect model.
    pub excess: f64,
    /// Rms residual of the fit, relative to the rms of the measured signals.
    pub residual: f64,
    unexplained: f64,
    /// Whether the model explains the measurement.
    pub verdict: Verdict,
    responses: ModalResponses,
    all_modes: ModalResponses,
    /// The model up to the measurement's band, beyond that of the surface, where the measurement was limited to one.
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
        let place = self.case.layout.unknowns().iter().position(|u| *u == unknown);
        // An unknown without measurements is as uncertain as its prior.
        let variance = place.map_or(1.0, |place| self.variances[place].max(0.0));
        let error = variance.sqrt() * self.case.layout.spread(unknown);
        Estimate { value: *self.found.values.clone().of(unknown), error }
    }

    /// Estimate of `by` times e to the unknown, a logarithm.
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

    /// Names of unknowns that are farther than [`FAR`] from what was expected. Gains are not checked.
    fn far(&self, expected: &Values) -> Vec<String> {
        let (mut values, mut thought) = (self.found.values.clone(), expected.clone());
        let far = |u: &Unknown| {
            if matches!(u, Unknown::Drive(_) | Unknown::Sense(_) | Unknown::Level) {
                return false;
            }
            let (value, spread) = (*values.of(*u), self.case.layout.spread(*u));
            let negative =
                matches!(u, Unknown::Mass(_)) && value < -(NEGATIVE * spread).max(FAR * self.of(*u).error);
            negative || (value - *thought.of(*u)).abs() > FAR * spread
        };
        let mut all = self.case.layout.unknowns();
        let mut far = far;
        all.retain(|u| far(u));
        all.iter().map(|u| format!("{u:?}").to_lowercase()).collect()
    }

    /// Modal responses of a band (Hz), and the modes' weights in the sensors' signals.
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
                frequency_error: 0.0,
                mode_errors: Vec::new(),
            },
            bending_shares: modes.bending_shares,
        })
    }
}

/// Modal responses, the sensors' weights (actuators x modes) and the share of bending in each mode's elastic energy.
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
        let all_modes = answers.responses([0.0, f64::INFINITY], nominal)?.responses;
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
            reached: limited.map(|band| Reached::of(&all_modes, band)),
            responses,
            all_modes,
        })
    }

    /// Responses of the fitted surface at any place, per unit of each actuator's drive. Coils driven by a voltage count as without
    /// inductance, and exciters as driving against a housing that stands still; [`Fitted::sampled`] includes both.
    pub fn responses(&self) -> Responses {
        Responses::Modal(self.responses.clone())
    }

    /// The modal responses of the fitted surface.
    pub fn modal(&self) -> &ModalResponses {
        &self.responses
    }

    /// This model restricted to the actuators of these indices.
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
            all_modes: part(&self.all_modes),
            reached: self.reached.as_ref().map(|reached| reached.with(part)),
            ..self.clone()
        }
    }

    /// Modal responses with all modes of the fit, also those outside the surface's band.
    pub(crate) fn all_modes(&self) -> &ModalResponses {
        &self.all_modes
    }

    /// Modal responses with all modes of the fit that can be sampled at its rate, where it was fitted to responses limited to a band; else
    /// those in the surface's band.
    pub(crate) fn sampleable(&self) -> &ModalResponses {
        self.reached.as_ref().map_or(&self.responses, |reached| &reached.responses)
    }

    /// The model limited to the measurement's band, where the measurement was limited to one.
    pub(super) fn reached(&self) -> Option<&Reached> {
        self.reached.as_ref()
    }

    /// The coil of an actuator that depends on frequency: of an exciter, or on a voltage with an inductance; `None` for others.
    pub(crate) fn coil(&self, actuator: usize) -> Option<&Coil> {
        self.coils.get(actuator).and_then(Option::as_ref)
    }

    /// This model with all responses multiplied by `gain`, a ratio: for a probe whose scale differs from that of the sensors.
    #[must_use]
    pub fn scaled(mut self, gain: f64) -> Self {
        let reached = self.reached.as_mut().map(|reached| &mut reached.responses);
        for responses in [&mut self.responses, &mut self.all_modes].into_iter().chain(reached) {
            responses.input = &responses.input * Scale(gain);
        }
        self
    }

    /// Weights of each mode in the signal of each actuator's sensor, actuators x modes: for a [`Tracker`](crate::Tracker).
    pub fn sensors(&self) -> &Mat<f64> {
        &self.sensors
    }

    /// Share of bending in the elastic energy of each mode, 0 to 1.
    pub fn bending_shares(&self) -> &[f64] {
        &self.bending_shares
    }

    /// Share of the measured signals, as amplitude, that neither model nor noise explains. It is estimated from the part of the
    /// residual that grows with the signal, whatever noise was stated.
    pub fn unexplained(&self) -> f64 {
        self.unexplained
    }

    /// A tracker of the tension, relative to that at calibration, that uses this model. The model error of
    /// the options is raised to the share of the signals that the model leaves unexplained, if that is
    /// larger.
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
