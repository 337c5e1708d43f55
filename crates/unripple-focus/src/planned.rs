//! Drives optimised through the state at the focal instant: inverse, concentrated, limited, robust.

use crate::limited::Limits;
use crate::objective::{Levels, Objective};
use crate::state::{Keeps, ModalPlant, Plant, ReducedPlant, SampledPlant, State};
use crate::{FocusError, Method, Options, Shaping, Target};
use unripple_core::{Onset, Point, Responses, require};
use unripple_linalg::{Mat, norm};

/// Accuracy to which drives are summed from modes, relative to the sum of the magnitudes: the drive is a small
/// difference of large terms. Larger, the sum would lose contrast that the optimisation has gained.
const ACCURACY: f64 = 1e-9;

/// Largest number of points of targets: the equations for their levels are a matrix of half a GiB. Twice as many make one four times as
/// large.
const MOST_POINTS: usize = 1 << 13;

/// Drives optimised through the state at the focal instant, for one window or one period.
#[derive(Debug)]
pub(crate) struct Planned<'r> {
    state: State<'r>,
    objective: Objective,
    options: Options,
}

/// An optimised drive.
pub(crate) struct Sought {
    /// Samples of the drive, `[actuator][sample]`.
    pub drive: Vec<f64>,
    /// The points of each target: those requested or, with sampled responses, the nearest stored ones.
    pub points: Vec<Vec<Point>>,
    /// How the limits changed the waveforms, apart from scaling the whole drive.
    pub shaping: Shaping,
}

impl<'r> Planned<'r> {
    /// Prepares drives of `length` samples, which are played once or, with `periodic`, repeated without end.
    ///
    /// # Errors
    /// [`FocusError::Count`], [`FocusError::NeedsModes`] and [`FocusError::Decomposition`].
    pub fn new(
        responses: &'r Responses,
        others: &'r [Responses],
        options: &Options,
        length: usize,
        periodic: bool,
    ) -> Result<Self, FocusError> {
        let mut all = plants(responses, options, length, periodic)?;
        for other in others.iter().filter(|_| options.method == Method::Robust) {
            alike(responses, other)?;
            all.push(plant(other, length, 1.0, periodic)?);
        }
        let state = State::new(all, responses.ports().len(), length)?;
        let strength = options.strength.unwrap_or(options.method.strength());
        let all = options.method == Method::Inverse;
        let objective = Objective::new(&state, strength, responses.conditions(), all)?;
        Ok(Self { state, objective, options: options.clone() })
    }

    /// Computes the drive for which the velocity of each target at the focal instant, in m/s, equals its
    /// gain. For [`Method::Limited`], the drive reaches `share` of the level that the limits allow.
    ///
    /// # Errors
    /// [`FocusError::Still`] and [`FocusError::Unknown`] for targets that cannot be reached, [`FocusError::Count`] for too
    /// many points.
    pub fn drive(&self, targets: &[(usize, &Target)], share: f64) -> Result<Sought, FocusError> {
        let (levels, points) = self.levels(targets)?;
        let state = self.objective.least(&levels)?;
        if self.options.method != Method::Limited {
            let drive = self.state.emit(state.as_ref())?;
            return Ok(Sought { drive, points, shaping: Shaping::Unshaped });
        }
        let limits = Limits {
            peak: self.options.limit,
            rms: self.options.rms_limit,
            total_rms: self.options.total_rms,
            push: self.options.push,
            share,
            samples: self.state.length(),
        };
        let matrix = self.objective.around(&levels.points);
        let (drive, shaping) = limits.drive(&self.state, matrix, self.objective.energy, &levels, &state)?;
        Ok(Sought { drive, points, shaping })
    }

    /// The levels wanted at all points of some targets, and the points used: those requested, or the nearest
    /// stored ones.
    fn levels(&self, targets: &[(usize, &Target)]) -> Result<(Levels, Vec<Vec<Point>>), FocusError> {
        let count: usize = targets.iter().map(|(_, target)| target.points.len()).sum();
        if count > MOST_POINTS {
            let expected = format!("at most {MOST_POINTS} for a drive that is optimised");
            return Err(FocusError::Count { what: "points over all targets", expected, found: count });
        }
        let mut used = Vec::with_capacity(targets.len());
        let mut parts = Vec::with_capacity(targets.len());
        let mut wanted = Vec::new();
        for (index, target) in targets {
            let (readout, points) = self.state.readout(*index, &target.points)?;
            wanted.extend(points.iter().map(|_| target.gain));
            parts.push(readout);
            used.push(points);
        }
        let mut readout = Mat::zeros(self.state.rank(), wanted.len());
        let columns = parts.iter().flat_map(|part| (0..part.ncols()).map(move |k| part.col_as_slice(k)));
        columns.enumerate().for_each(|(k, column)| readout.col_as_slice_mut(k).copy_from_slice(column));
        let points: Vec<Point> = used.iter().flatten().copied().collect();
        let moved = (0..wanted.len()).map(|k| norm(readout.col(k).as_mat()));
        let most = self.state.energies.last().copied().unwrap_or(0.0).sqrt();
        if let Some(k) = moved.into_iter().position(|norm| norm.is_nan() || norm <= 1e-9 * most) {
            let target = targets.iter().scan(0, |end, (index, target)| {
                *end += target.points.len();
                Some((*index, *end))
            });
            let target = target.clone().find(|(_, end)| k < *end).map_or(0, |(index, _)| index);
            return Err(FocusError::Still { target, at: points[k] });
        }
        Ok((Levels { readout, wanted, points }, used))
    }
}

/// The model of the nominal surface, and those of all others for which the method optimises.
fn plants<'r>(
    responses: &'r Responses,
    options: &Options,
    length: usize,
    periodic: bool,
) -> Result<Vec<Plant<'r>>, FocusError> {
    let mut plants = vec![plant(responses, length, 1.0, periodic)?];
    if options.method == Method::Robust && options.spread > 0.0 {
        plants.push(plant(responses, length, 1.0 - options.spread, periodic)?);
        plants.push(plant(responses, length, 1.0 + options.spread, periodic)?);
    }
    if options.rest && options.method == Method::Inverse && !periodic {
        let Responses::Modal(modal) = responses else {
            return Err(FocusError::NeedsModes("displacements at rest"));
        };
        let resting = ModalPlant::single(modal, length, 1.0, Keeps::Displacement, ACCURACY)?;
        plants.push(Plant::Modal(Box::new(resting)));
    }
    Ok(plants)
}

/// The model of one surface, with its natural frequencies multiplied by `stretch`.
fn plant(
    responses: &Responses,
    length: usize,
    stretch: f64,
    periodic: bool,
) -> Result<Plant<'_>, FocusError> {
    match responses {
        // Under loads, the shapes of the oscillations are linearly dependent.
        Responses::Modal(modal) if modal.poles.iter().any(|pole| pole.onset == Onset::Displacement) => {
            Ok(Plant::Reduced(Box::new(ReducedPlant::new(modal, length, stretch, periodic)?)))
        }
        Responses::Modal(modal) if periodic => {
            Ok(Plant::Modal(Box::new(ModalPlant::periodic(modal, length, stretch)?)))
        }
        Responses::Modal(modal) => {
            let single = ModalPlant::single(modal, length, stretch, Keeps::Velocity, ACCURACY)?;
            Ok(Plant::Modal(Box::new(single)))
        }
        Responses::Sampled(_) if periodic => Err(FocusError::NeedsModes("a drive for a period")),
        Responses::Sampled(_) if stretch != 1.0 => {
            Err(FocusError::NeedsModes("a drive for a spread of frequencies"))
        }
        Responses::Sampled(sampled) => Ok(Plant::Sampled(SampledPlant::single(sampled, length)?)),
    }
}

/// Refuses responses with another number of actuators or another sample rate than the first.
fn alike(one: &Responses, other: &Responses) -> Result<(), FocusError> {
    let [expected, found] = [one, other].map(|responses| responses.ports().len());
    if expected != found {
        let expected = format!("{expected}, as the first plant has");
        return Err(FocusError::Count { what: "actuators of another plant", expected, found });
    }
    let [expected, found] = [one, other].map(|responses| responses.conditions().rate);
    Ok(require("sample rate of another plant (Hz)", expected == found, format!("{expected}"), found)?)
}
