use crate::modes::{Modes, check};
use crate::{Medium, PhysicsError};
use faer::{Mat, MatRef};
use rayon::prelude::*;
use std::sync::Arc;
use unripple_core::{
    Actuator, ActuatorKind, Conditions, ModalResponses, Point, Pole, Port, Responses, SampledResponses,
    Shapes, Surface,
};
use unripple_dsp::ModalSynth;

/// Points of a library worked on at once.
const POINTS: usize = 64;

/// Error of a library's samples before rounding to single precision.
const LIBRARY_ACCURACY: f64 = 1e-6;

/// How responses are made from a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResponseOptions {
    /// Top frequency of the modes, in Hz; the band's where `None`. Only the top moves: the band and λ_min stay the
    /// surface's.
    pub max_hz: Option<f64>,
    /// Relative accuracy of the frequencies.
    pub accuracy: f64,
}

impl Default for ResponseOptions {
    fn default() -> Self {
        Self { max_hz: None, accuracy: 1e-6 }
    }
}

/// The responses of a surface to its actuators, factored into modes: h = Σ_m φ_m(x_A) φ_m(x) e^{-σt}(…).
///
/// Modes outside the band are left out.
///
/// # Errors
/// Those of [`Modes::solve`]; [`PhysicsError::Unsupported`] for actuators other than ideal forces;
/// [`PhysicsError::Range`] for an actuator outside the outline, a band or a sample rate that cannot be.
///
/// ```
/// # use unripple_core::*;
/// use unripple_physics::{ResponseOptions, responses};
/// # let sheet = Sheet { material: "BoPET".into(), young: 4e9, density: 1400.0, poisson: 0.3, strength: None,
/// #     thickness: 0.125e-3, tension: 200.0, decay: Decay::Time(0.07), air: Air::None };
/// # let a1 = Actuator { name: "a1".into(), at: Point::from_mm(12.0, 31.0), kind: ActuatorKind::Force };
/// # let surface = Surface { name: "film".into(), outline: Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 }),
/// #     sheet, emission: Emission { band: [0.0, 1e3], rate: 48e3, limit: 1.0, rms_limit: None },
/// #     finger: Finger::default(), actuators: vec![a1] };
/// let Responses::Modal(modal) = responses(&surface, &ResponseOptions::default())? else { unreachable!() };
/// assert_eq!(modal.input.ncols(), modal.poles.len());
/// assert_eq!(modal.ports[0].name, "a1");
/// # Ok::<(), unripple_physics::PhysicsError>(())
/// ```
pub fn responses(surface: &Surface, options: &ResponseOptions) -> Result<Responses, PhysicsError> {
    let emission = &surface.emission;
    let [low, high] = emission.band;
    check("sample rate in Hz", emission.rate, emission.rate > 0.0, "a positive number")?;
    check("bottom of the band in Hz", low, low >= 0.0 && low < high, "0 or more, below the top")?;
    check(
        "top of the band in Hz",
        high,
        high > low && high < emission.rate / 2.0,
        "less than half the sample rate",
    )?;
    let ports = ports(surface)?;
    let max_hz = options.max_hz.unwrap_or(high);
    check("top frequency of the modes in Hz", max_hz, max_hz >= high, "at least the top of the band")?;
    let modes = Modes::solve(surface, max_hz, options.accuracy)?;
    let below = modes.frequencies_hz().partition_point(|hz| *hz < low);
    let poles: Vec<Pole> = modes.poles()[below..].to_vec();
    let shapes: Arc<dyn Shapes> = if below == 0 { Arc::new(modes) } else { Arc::new(Above { modes, below }) };
    let places: Vec<Point> = ports.iter().map(|port| port.at).collect();
    let conditions = Conditions {
        rate: emission.rate,
        band: emission.band,
        lambda_min: Medium::of(&surface.sheet).lambda_min(high),
        outline: surface.outline.clone(),
    };
    Ok(Responses::Modal(ModalResponses { ports, poles, input: shapes.at_all(&places), shapes, conditions }))
}

/// Sampled responses at many points, single precision: the product of weights and sampled modes, on all threads.
///
/// `samples` from the impulse on, at the rate of the responses. Errors stay below about 2e-6 of the sum of the magnitudes
/// of a response's modal weights.
pub fn sample(responses: &ModalResponses, points: &[Point], samples: usize) -> SampledResponses {
    let ModalResponses { ports, poles, input, shapes, conditions } = responses;
    let synth = ModalSynth::new(poles, conditions.rate, samples, LIBRARY_ACCURACY);
    let per_point = ports.len() * samples;
    let mut data = vec![0.0f32; points.len() * per_point];
    if per_point > 0 {
        data.par_chunks_mut(POINTS * per_point).zip(points.par_chunks(POINTS)).for_each(|(out, points)| {
            let weights = weights(input.as_ref(), shapes.at_all(points).as_ref());
            // Sizes agree by construction.
            let _ = synth.respond_f32(weights.as_ref(), out);
        });
    }
    match SampledResponses::new(ports.clone(), points.to_vec(), conditions.clone(), samples, data) {
        Ok(sampled) => sampled,
        Err(_) => unreachable!("the data were made to size"),
    }
}

/// Weights of each actuator at each point, (points · actuators) x modes.
fn weights(input: MatRef<f64>, readout: MatRef<f64>) -> Mat<f32> {
    let mut weights = Mat::zeros(readout.nrows() * input.nrows(), readout.ncols());
    for ((column, input), readout) in weights.col_iter_mut().zip(input.col_iter()).zip(readout.col_iter()) {
        let products = readout.iter().flat_map(|r| input.iter().map(move |i| (i * r) as f32));
        column.iter_mut().zip(products).for_each(|(w, product)| *w = product);
    }
    weights
}

fn ports(surface: &Surface) -> Result<Vec<Port>, PhysicsError> {
    surface.actuators.iter().enumerate().map(|(i, actuator)| port(surface, i, actuator)).collect()
}

fn port(surface: &Surface, index: usize, actuator: &Actuator) -> Result<Port, PhysicsError> {
    if actuator.kind != ActuatorKind::Force {
        return Err(PhysicsError::Unsupported {
            what: "kind of an actuator",
            expected: "`force`",
            found: format!("`{}` (actuator {index}, `{}`)", actuator.kind.name(), actuator.name),
        });
    }
    if !surface.outline.contains(actuator.at) {
        let (width, height) = surface.outline.extent();
        return Err(PhysicsError::Unsupported {
            what: "place of an actuator",
            expected: "a point inside the outline",
            found: format!(
                "{} (actuator {index}, `{}`) on {:.1} x {:.1} mm",
                actuator.at,
                actuator.name,
                width * 1e3,
                height * 1e3
            ),
        });
    }
    Ok(Port { name: actuator.name.clone(), at: actuator.at })
}

/// The modes from `below` on.
#[derive(Debug)]
struct Above {
    modes: Modes,
    below: usize,
}

impl Shapes for Above {
    fn modes(&self) -> usize {
        self.modes.modes() - self.below
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        let mut all = vec![0.0; self.modes.modes()];
        self.modes.at(point, &mut all);
        row.copy_from_slice(&all[self.below..]);
    }

    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        self.modes.at_all(points).subcols(self.below, self.modes()).to_owned()
    }
}
