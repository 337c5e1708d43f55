//! Modes and time-reversed states for studies of contrast.

use super::Replay;
use super::replay::{product, rings};
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_core::{
    Conditions, ModalResponses, Outline, Point, Pole, Port, Responses, Shapes, Surface, window_samples,
};
use unripple_field::{FieldError, Grid};
use unripple_linalg::{Mat, MatRef};
use unripple_physics::{Medium, Modes, PhysicsError};

/// Relative accuracy of the natural frequencies. Errors are then far below a linewidth; ten times less would change no
/// result.
const ACCURACY: f64 = 1e-4;

/// Cells of the grid per shortest wavelength along each side. On 4, contrasts differ by 2 % rms; 16 take four times as
/// long.
pub const CELLS: f64 = 8.0;

/// Why a study could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The modes or responses of the surface could not be computed.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// No drive could be computed.
    #[error(transparent)]
    Focus(#[from] unripple_focus::FocusError),
    /// The field or its grid could not be computed.
    #[error(transparent)]
    Field(#[from] FieldError),
}

/// A surface prepared for statistics over many foci: its modes and the sums of their products over a grid, so that
/// contrast is computed without evaluating fields.
///
/// Time reversal plays back g_n(t) φ_n(a) φ_n(A), with g_n the velocity of mode n after an impulse, φ_n its shape, a an
/// actuator and A the target. So the velocities of the modes at the focal instant (the *state*) are v_m = Σ_a φ_m(a)
/// Σ_n I_mn φ_n(a) φ_n(A), where I has all that depends on time ([`Replay`]). The sum of squares of a field over the
/// grid is vᵀKv with K = Σ_x φ(x)φ(x)ᵀ.
#[derive(Clone, Debug)]
pub struct ContrastModel {
    shapes: Arc<Modes>,
    poles: Vec<Pole>,
    conditions: Conditions,
    points: Vec<Point>,
    /// Shapes at the grid's points, points x modes.
    weights: Mat<f64>,
    /// K, modes x modes; `None` where there are more modes than points, so that the field itself is cheaper.
    gram: Option<Mat<f64>>,
}

/// A target, with the points of the grid inside and outside its focal disc.
#[derive(Clone, Debug)]
pub struct Outside {
    /// Shapes at the target, 1 x modes.
    target: Mat<f64>,
    /// Shapes at the grid's points within the disc, points x modes.
    within: Mat<f64>,
    /// Number of points outside the disc.
    beyond: f64,
}

impl Outside {
    /// Velocity at the target of each state (modes x states), in m/s.
    pub fn at_target(&self, states: MatRef<'_, f64>) -> Vec<f64> {
        product(self.target.as_ref(), states).row(0).iter().copied().collect()
    }
}

impl ContrastModel {
    /// Prepares a surface in its band, on a grid of `cells` cells per shortest wavelength ([`CELLS`] for the definition
    /// of contrast).
    ///
    /// # Errors
    /// [`StudyError::Physics`] if the modes cannot be computed, [`StudyError::Field`] if the grid cannot.
    pub fn of(surface: &Surface, cells: f64) -> Result<Self, StudyError> {
        let modes = Modes::solve(surface, surface.emission.band[1], ACCURACY)?;
        Self::with(surface, Arc::new(modes), cells)
    }

    /// A model of the same surface with a band that ends at `top_hz` (Hz), at most at the top of the
    /// present band.
    ///
    /// # Errors
    /// [`StudyError::Field`] if the grid cannot be computed.
    pub fn up_to(&self, surface: &Surface, top_hz: f64) -> Result<Self, StudyError> {
        let mut narrow = surface.clone();
        narrow.emission.band[1] = top_hz.min(surface.emission.band[1]);
        Self::with(&narrow, self.shapes.clone(), CELLS)
    }

    fn with(surface: &Surface, shapes: Arc<Modes>, cells: f64) -> Result<Self, StudyError> {
        let [low, top] = surface.emission.band;
        let poles: Vec<Pole> =
            shapes.poles().iter().copied().filter(|pole| pole.omega <= TAU * top).collect();
        let conditions = Conditions {
            rate: surface.emission.rate,
            band: [low, top],
            lambda_min: Medium::of(&surface.sheet).lambda_min(top),
            outline: surface.outline.clone(),
        };
        let points = Grid::new(&conditions, cells)?.points();
        let weights = shapes.at_all(&points).get(.., ..poles.len()).to_owned();
        let gram = (points.len() > poles.len()).then(|| product(weights.transpose(), weights.as_ref()));
        Ok(Self { shapes, poles, conditions, points, weights, gram })
    }

    /// Number of modes in the band.
    pub fn modes(&self) -> usize {
        self.poles.len()
    }

    /// Band, sample rate, shortest wavelength and outline.
    pub fn conditions(&self) -> &Conditions {
        &self.conditions
    }

    /// The outline of the surface.
    pub fn outline(&self) -> &Outline {
        &self.conditions.outline
    }

    /// Mode shapes at points, points x modes.
    pub fn shapes_at(&self, points: &[Point]) -> Mat<f64> {
        self.shapes.at_all(points).get(.., ..self.modes()).to_owned()
    }

    /// Modal responses of ideal force actuators at these points (m), for focusing and evaluation by the crates
    /// `unripple-focus` and `unripple-field`.
    pub fn responses(&self, actuators: &[Point]) -> Responses {
        let ports = (1..).zip(actuators).map(|(i, at)| Port { name: format!("a{i}"), at: *at }).collect();
        Responses::Modal(ModalResponses {
            ports,
            poles: self.poles.clone(),
            input: self.shapes_at(actuators),
            shapes: Arc::new(Leading { shapes: self.shapes.clone(), modes: self.modes() }),
            conditions: self.conditions.clone(),
            frequency_error: 0.0,
            mode_errors: Vec::new(),
        })
    }

    /// Matrix of time reversal ([`Replay`]) for a single pulse with a window (s).
    pub fn once(&self, window: f64) -> Replay {
        Replay::once(&self.poles, self.conditions.rate, window)
    }

    /// Matrix of time reversal ([`Replay`]) for a single pulse with a window (s), in closed form: the
    /// computing time does not depend on the window. For modes that oscillate.
    pub fn once_of_any_length(&self, window: f64) -> Replay {
        Replay::of_any_length(&self.poles, self.conditions.rate, window)
    }

    /// Matrix of time reversal ([`Replay`]) for a pulse repeated every `period` seconds, with a window (s),
    /// in the steady state.
    pub fn repeated(&self, window: f64, period: f64) -> Replay {
        Replay::repeated(&self.poles, self.conditions.rate, window, period)
    }

    /// Velocities of the modes after an impulse, over a window (s), samples x modes.
    pub(super) fn rings(&self, window: f64) -> Mat<f64> {
        rings(&self.poles, self.conditions.rate, window_samples(window, self.conditions.rate))
    }

    /// The points outside and inside the focal disc, of radius 4/3 λ_min, of a target (m).
    pub fn outside(&self, target: Point) -> Outside {
        let reach = self.conditions.focal_radius();
        let within: Vec<usize> =
            (0..self.points.len()).filter(|i| self.points[*i].distance(target) <= reach).collect();
        Outside {
            target: self.shapes_at(&[target]),
            within: Mat::from_fn(within.len(), self.modes(), |i, m| self.weights[(within[i], m)]),
            beyond: (self.points.len() - within.len()) as f64,
        }
    }

    /// States (modal velocities) at the focal instant of the target in `outside`, modes x actuators: column
    /// k is the state for the first k + 1 actuators together.
    ///
    /// `inputs` are the shapes at the actuators, actuators x modes.
    pub fn states(&self, replay: &Replay, inputs: MatRef<'_, f64>, outside: &Outside) -> Mat<f64> {
        let modes = self.modes();
        let replayed = Mat::from_fn(modes, inputs.nrows(), |m, a| inputs[(a, m)] * outside.target[(0, m)]);
        let mut states = replay.apply(replayed.as_ref());
        for a in 0..inputs.nrows() {
            for m in 0..modes {
                let before = if a > 0 { states[(m, a - 1)] } else { 0.0 };
                states[(m, a)] = before + inputs[(a, m)] * states[(m, a)];
            }
        }
        states
    }

    /// Contrast of each state (modes x states): velocity at the target over rms velocity outside its disc.
    pub fn contrasts(&self, states: MatRef<'_, f64>, outside: &Outside) -> Vec<f64> {
        let everywhere = match &self.gram {
            Some(gram) => {
                let summed = product(gram.as_ref(), states);
                (0..states.ncols()).map(|k| dot(states.col(k), summed.col(k))).collect::<Vec<_>>()
            }
            None => squares(product(self.weights.as_ref(), states).as_ref()),
        };
        let inside = squares(product(outside.within.as_ref(), states).as_ref());
        let peaks = outside.at_target(states);
        let contrast = |k: usize| peaks[k] / ((everywhere[k] - inside[k]) / outside.beyond).sqrt();
        (0..states.ncols()).map(contrast).collect()
    }
}

/// Shapes of the first `modes` modes only.
#[derive(Debug)]
struct Leading {
    shapes: Arc<Modes>,
    modes: usize,
}

impl Shapes for Leading {
    fn modes(&self) -> usize {
        self.modes
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        let all = self.shapes.at_all(&[point]);
        row.iter_mut().enumerate().for_each(|(m, weight)| *weight = all[(0, m)]);
    }

    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        self.shapes.at_all(points).get(.., ..self.modes).to_owned()
    }
}

fn dot(a: unripple_linalg::ColRef<'_, f64>, b: unripple_linalg::ColRef<'_, f64>) -> f64 {
    a.iter().zip(b.iter()).map(|(x, y)| x * y).sum()
}

/// Sum of squares of each column.
fn squares(columns: MatRef<'_, f64>) -> Vec<f64> {
    (0..columns.ncols()).map(|k| dot(columns.col(k), columns.col(k))).collect()
}
