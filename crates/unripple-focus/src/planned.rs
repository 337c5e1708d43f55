use crate::limited::Limits;
use crate::objective::{Levels, Objective, level};
use crate::state::{Keeps, ModalPlant, Plant, SampledPlant, State};
use crate::{FocusError, Method, Options, Target};
use faer::Mat;
use unripple_core::{Point, Responses};

/// Accuracy of drives that modes are summed to.
const ACCURACY: f64 = 1e-9;

/// Drives made from the state at the focal instant, for one window or one period.
#[derive(Debug)]
pub(crate) struct Planned<'r> {
    state: State<'r>,
    /// `None` where energy alone is spared.
    objective: Option<Objective>,
    options: Options,
    strength: f64,
}

impl<'r> Planned<'r> {
    /// For drives of `length` samples: once, or again and again for ever.
    ///
    /// # Errors
    /// [`FocusError::Count`], [`FocusError::NeedsModes`] and [`FocusError::Decomposition`].
    pub fn new(
        responses: &'r Responses,
        options: &Options,
        length: usize,
        again: bool,
    ) -> Result<Self, FocusError> {
        let plants = plants(responses, options, length, again)?;
        let state = State::new(plants, responses.ports().len(), length)?;
        let strength = options.strength.unwrap_or(options.method.strength());
        let outside = options.method != Method::Inverse;
        let objective = outside.then(|| Objective::new(&state, strength, responses.conditions()));
        Ok(Self { state, objective, options: options.clone(), strength })
    }

    /// The drive that gives targets their gains as velocity at the focal instant, in m/s, and the points they stand for;
    /// channels one behind the other.
    ///
    /// # Errors
    /// [`FocusError::Still`] and [`FocusError::Unknown`] for targets that cannot be reached.
    pub fn drive(&self, targets: &[(usize, &Target)]) -> Result<(Vec<f64>, Vec<Vec<Point>>), FocusError> {
        let (levels, used) = self.levels(targets)?;
        let state = match &self.objective {
            None => self.inverse(&levels)?,
            Some(objective) => objective.least(&levels)?,
        };
        if self.options.method == Method::Limited
            && let Some(objective) = &self.objective
        {
            let limits = Limits {
                peak: self.options.limit,
                rms: self.options.rms_limit,
                push: self.options.push,
                samples: self.state.length(),
            };
            let matrix = objective.around(&levels.points);
            let energy = (1.0 - self.strength).max(1e-6) * self.state.scale;
            return Ok((limits.drive(&self.state, matrix, energy, &levels, &state)?, used));
        }
        Ok((self.state.emit(state.as_ref())?, used))
    }

    /// `y = ((1 - κ) s + κ Λ)⁻¹ P μ`: from time reversal to the least-energy drive of a band-limited delta.
    fn inverse(&self, levels: &Levels) -> Result<Mat<f64>, FocusError> {
        let mut states = levels.readout.clone();
        let weak = (1.0 - self.strength) * self.state.scale;
        for column in 0..states.ncols() {
            let rows = states.col_as_slice_mut(column).iter_mut().zip(&self.state.energies);
            rows.for_each(|(y, energy)| *y /= weak + self.strength * energy);
        }
        level(states, levels)
    }

    fn levels(&self, targets: &[(usize, &Target)]) -> Result<(Levels, Vec<Vec<Point>>), FocusError> {
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
        let moved = (0..wanted.len()).map(|k| readout.col(k).norm_l2());
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

/// The nominal plant, and those beside it that the method is to bear.
fn plants<'r>(
    responses: &'r Responses,
    options: &Options,
    length: usize,
    again: bool,
) -> Result<Vec<Plant<'r>>, FocusError> {
    let modal = match responses {
        Responses::Modal(modal) => modal,
        Responses::Sampled(_) if again => return Err(FocusError::NeedsModes("a drive for a period")),
        Responses::Sampled(_) if options.method == Method::Robust => {
            return Err(FocusError::NeedsModes("a drive for a spread of frequencies"));
        }
        Responses::Sampled(_) if options.rest => {
            return Err(FocusError::NeedsModes("displacements brought to rest"));
        }
        Responses::Sampled(sampled) => return Ok(vec![Plant::Sampled(SampledPlant::once(sampled, length)?)]),
    };
    let plant = |stretch: f64| -> Result<Plant<'r>, FocusError> {
        Ok(Plant::Modal(Box::new(match again {
            true => ModalPlant::again(modal, length, stretch)?,
            false => ModalPlant::once(modal, length, stretch, Keeps::Velocity, ACCURACY),
        })))
    };
    let mut plants = vec![plant(1.0)?];
    if options.method == Method::Robust {
        plants.push(plant(1.0 - options.spread)?);
        plants.push(plant(1.0 + options.spread)?);
    }
    if options.rest && !again {
        let resting = ModalPlant::once(modal, length, 1.0, Keeps::Displacement, ACCURACY);
        plants.push(Plant::Modal(Box::new(resting)));
    }
    Ok(plants)
}
