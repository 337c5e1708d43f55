//! Impulse responses of a surface, by modal superposition (poles and residues).

use crate::loads::{of_lattice, resonators};
use crate::{
    Accuracy, Footprint, Load, Loaded, Medium, Modes, Oscillations, PhysicsError, Transducer, transducers,
};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_core::{
    Cached, Conditions, Contact, ModalResponses, Point, Pole, Port, Responses, SampledResponses, Shape,
    Shapes, Surface, require,
};
use unripple_dsp::ModalSynth;
use unripple_linalg::{Mat, MatRef};
use unripple_plates::decay_rate;

/// Number of points for which one thread computes sampled responses at once. With twice this value, there
/// are half as many tasks to share among threads.
const POINTS: usize = 64;

/// Error of sampled responses before rounding to single precision, relative to the sum of the magnitudes of
/// modal weights. Ten times more would be larger than that rounding.
const LIBRARY_ACCURACY: f64 = 1e-6;

/// Relative error, root mean square, that [`sample()`] adds to responses: that of each mode's part, with its rounding. Half as much would
/// be less than some modes have.
pub const SAMPLING_ERROR: f64 = 2.0 * LIBRARY_ACCURACY;

/// With loads, modes are kept one by one up to this multiple of the top frequency; modes above are far from
/// resonance within the band. With twice this value, eigenvalue problems have up to four times the
/// coordinates, and take 64 times as long.
const DYNAMIC: f64 = 1.1;

/// Options of the computation of responses from a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseOptions {
    /// Highest frequency of the modes included, in Hz; `None` for the top of the surface's band. The band and λ_min stored with the
    /// responses stay those of the surface.
    pub max_hz: Option<f64>,
    /// Relative accuracy required of the modes' frequencies, and the largest error that is accepted if this
    /// accuracy cannot be reached.
    pub accuracy: Accuracy,
    /// Fingers that rest on the surface, as loads.
    pub contacts: Vec<Contact>,
    /// With loads on the sheet, modes up to this multiple of `max_hz` (at least 1.1) are computed, since
    /// those above `max_hz` add compliance at the loads. With more than 64 resonators they are computed
    /// further, until there is one for each resonator.
    pub reach: f64,
}

/// Relative accuracy of natural frequencies that are computed on a mesh: a phase error of 0.06 rad at 3 kHz after 30
/// ms for the highest mode, and far less for lower ones.
const MESHED: f64 = 1e-4;

/// Relative accuracy to which the natural frequencies of a surface are computed: the one that its file
/// states, or by default that of [`ResponseOptions`] for plain rectangles and circles and 1e-4 where a mesh is needed.
/// If an accuracy from the file is out of reach, that is an error; in place of the default, the best that
/// can be reached is used ([`Accuracy::or_best`]).
pub fn accuracy(surface: &Surface) -> Accuracy {
    let plain = matches!(surface.outline.shape, Shape::Rectangle { .. } | Shape::Circle { .. })
        && surface.outline.holes.is_empty()
        && surface.sheet.uneven.is_uniform();
    Accuracy::of(surface.accuracy, if plain { ResponseOptions::default().accuracy.aim } else { MESHED })
}

impl Default for ResponseOptions {
    fn default() -> Self {
        Self { max_hz: None, accuracy: Accuracy::from(1e-6), contacts: Vec::new(), reach: 1.5 }
    }
}

/// The impulse responses of a surface to its actuators in modal form: h(t) = Σ_m φ_m(x_A) φ_m(x) g_m(t),
/// with the mode shapes φ_m at the actuator x_A and at the point x, and the velocity g_m of a damped
/// oscillator, per unit of each actuator's drive (N, A or V).
///
/// Modes below the band or above [`ResponseOptions::max_hz`] are left out. With loads on the sheet (coils, magnets, patches, fingers or
/// resonators), the modes are those of the coupled system ([`Loaded`]).
///
/// # Errors
/// Those of [`Modes::solve`] and [`transducers`]; [`PhysicsError::Unsupported`] for a finger outside the outline;
/// [`PhysicsError::Range`] for a band, sample rate or `max_hz` out of range, a load that is not passive, or a reach below 1.1.
///
/// ```
/// # use unripple_core::*;
/// use unripple_physics::{ResponseOptions, responses};
/// # let sheet = Sheet { material: "BoPET".into(), young: 4e9, density: 1400.0, poisson: 0.3, strength: None,
/// #     thickness: 0.125e-3, tension: 200.0, decay: Decay::Time(0.07), air: Air::None,
/// #     uneven: Uneven::default() };
/// # let a1 = Actuator { name: "a1".into(), at: Point::from_mm(12.0, 31.0), kind: ActuatorKind::Force,
/// #     contact_radius: 0.0 };
/// # let surface = Surface { name: "film".into(), outline: Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 }),
/// #     sheet, emission: Emission { band: [0.0, 1e3], rate: 48e3, limit: 1.0, rms_limit: None },
/// #     finger: Finger::default(), accuracy: None, actuators: vec![a1] };
/// let Responses::Modal(modal) = responses(&surface, &ResponseOptions::default())? else { unreachable!() };
/// assert_eq!(modal.input.ncols(), modal.poles.len());
/// assert_eq!(modal.ports[0].name, "a1");
/// # Ok::<(), unripple_physics::PhysicsError>(())
/// ```
pub fn responses(surface: &Surface, options: &ResponseOptions) -> Result<Responses, PhysicsError> {
    let asked = Asked::of(surface, options)?;
    let modes = asked.modes(surface)?;
    asked.responses(surface, Arc::new(modes))
}

/// The modes of the sheet without loads from which [`responses`] computes: up to
/// [`ResponseOptions::max_hz`], or, if there are loads, up to [`ResponseOptions::reach`] times that.
///
/// # Errors
/// Those of [`responses`].
pub fn response_modes(surface: &Surface, options: &ResponseOptions) -> Result<Modes, PhysicsError> {
    Asked::of(surface, options)?.modes(surface)
}

/// The impulse responses as by [`responses`], from modes that [`response_modes`] has computed for the same
/// surface and options.
///
/// # Errors
/// Those of [`responses`].
pub fn responses_on(
    surface: &Surface,
    modes: Arc<Modes>,
    options: &ResponseOptions,
) -> Result<Responses, PhysicsError> {
    Asked::of(surface, options)?.responses(surface, modes)
}

/// Frequency (Hz) up to which a time-domain simulation ([`stepper`](crate::stepper)) needs modes to agree
/// with [`responses`] up to `max_hz`. With loads on the sheet it is 1.5 times `max_hz`, since higher modes
/// add compliance at the loads, but at most 0.45 of the sample rate (and at least `max_hz`).
///
/// # Errors
/// Those of [`transducers`].
pub fn stepped_hz(surface: &Surface, max_hz: f64) -> Result<f64, PhysicsError> {
    let reach = if is_loaded(surface)? { ResponseOptions::default().reach } else { 1.0 };
    let hz = (reach * max_hz).max(of_lattice(surface, surface.resonators().len()));
    Ok(sampled_hz(surface, hz, max_hz))
}

/// Whether any actuator or resonator loads the sheet.
pub(crate) fn is_loaded(surface: &Surface) -> Result<bool, PhysicsError> {
    Ok(surface.sheet.uneven.resonates()
        || transducers(surface)?.iter().filter_map(|t| t.load.as_ref()).any(Load::acts))
}

/// Highest frequency of modes in sampled responses, as a share of the sample rate: modes above half the
/// rate would alias, and filters need some room. With twice this value, modes would alias.
const OF_RATE: f64 = 0.45;

/// Limits `hz`, a highest frequency of modes, to 0.45 of the surface's sample rate, but never to less than
/// `least`; all in Hz.
pub fn sampled_hz(surface: &Surface, hz: f64, least: f64) -> f64 {
    hz.min(OF_RATE * surface.emission.rate).max(least)
}

/// A request for responses, after its options have been checked.
pub(crate) struct Asked {
    transducers: Vec<Transducer>,
    /// Fingers, then resonators.
    others: Vec<Load>,
    /// Frequency (Hz) up to which the sheet has as many modes as there are resonators; 0 if they are few.
    lattice_hz: f64,
    max_hz: f64,
    reach: f64,
    accuracy: Accuracy,
}

impl Asked {
    /// Checks surface and options, and prepares the transducers and the loads of fingers and resonators.
    pub(crate) fn of(surface: &Surface, options: &ResponseOptions) -> Result<Self, PhysicsError> {
        let emission = &surface.emission;
        let [low, high] = emission.band;
        require("sample rate in Hz", emission.rate > 0.0, "a positive number", emission.rate)?;
        require("bottom of the band in Hz", low >= 0.0 && low < high, "0 or more, below the top", low)?;
        require(
            "top of the band in Hz",
            high > low && high < emission.rate / 2.0,
            "less than half the sample rate",
            high,
        )?;
        let transducers = transducers(surface)?;
        let mut others = fingers(surface, &options.contacts)?;
        let resonators = resonators(surface)?;
        let lattice_hz = of_lattice(surface, resonators.len());
        others.extend(resonators);
        let max_hz = options.max_hz.unwrap_or(high);
        require("top frequency of the modes in Hz", max_hz >= high, "at least the top of the band", max_hz)?;
        let reach = options.reach;
        require("reach of the modes that loads feel", reach >= DYNAMIC, "at least 1.1", reach)?;
        Ok(Self { transducers, others, lattice_hz, max_hz, reach, accuracy: options.accuracy })
    }

    /// Whether there are no loads on the sheet.
    pub(crate) fn bare(&self) -> bool {
        self.loads() == 0
    }

    /// Whether the modes of the sheet reach as far as a lattice of many resonators needs.
    pub(crate) fn on_lattice(&self) -> bool {
        self.lattice_hz > 0.0
    }

    /// Number of loads on the sheet.
    pub(crate) fn loads(&self) -> usize {
        self.transducers
            .iter()
            .filter_map(|t| t.load.as_ref())
            .chain(&self.others)
            .filter(|l| l.acts())
            .count()
    }

    /// Highest frequency of the modes of the sheet without loads that are needed, in Hz.
    pub(crate) fn modes_hz(&self) -> f64 {
        if self.bare() { self.max_hz } else { (self.reach * self.max_hz).max(self.lattice_hz) }
    }

    /// Relative accuracy of the modes' frequencies.
    pub(crate) fn accuracy(&self) -> Accuracy {
        self.accuracy
    }

    /// Highest frequency of the modes that are coupled one by one, in Hz.
    pub(crate) fn coupled_hz(&self) -> f64 {
        DYNAMIC * self.max_hz
    }

    /// The modes of the sheet without loads that are needed.
    pub(crate) fn modes(&self, surface: &Surface) -> Result<Modes, PhysicsError> {
        Modes::solve(surface, self.modes_hz(), self.accuracy)
    }

    /// The oscillations of the sheet coupled to all loads, from the bottom of the band to `max_hz`.
    pub(crate) fn coupled(&self, surface: &Surface, modes: Arc<Modes>) -> Result<Oscillations, PhysicsError> {
        let poles = modes.poles().to_vec();
        let (sheet, medium) = (&surface.sheet, Medium::of(&surface.sheet));
        let loaded = Loaded::new(modes, &poles, &self.transducers, &self.others)?.with_rest(
            medium,
            medium.wavenumber(TAU * self.modes_hz()),
            sheet.thickness,
            |omega, k| decay_rate(&sheet.decay, omega, medium.bending_share(k)),
        )?;
        let band = [surface.emission.band[0], self.max_hz];
        Cached::here().result_by(
            || {
                let on = (&surface.outline, &surface.sheet, &poles, self.reach, self.accuracy, band);
                format!("modes with loads: {on:?} {:?} {:?}", self.transducers, self.others)
            },
            || loaded.oscillations(self.coupled_hz(), band),
            Oscillations::encode,
            |from| loaded.decode(from),
        )
    }

    /// The responses from modes, with all loads.
    fn responses(&self, surface: &Surface, modes: Arc<Modes>) -> Result<Responses, PhysicsError> {
        let emission = &surface.emission;
        let [low, high] = emission.band;
        let frequency_error = modes.error();
        let errors = modes.errors().to_vec();
        let (poles, input, shapes, mode_errors) = if self.bare() {
            let (poles, input, shapes) = unloaded(modes, &self.transducers, low);
            let above = errors.len() - poles.len();
            (poles, input, shapes, errors[above..].to_vec())
        } else {
            let found = self.coupled(surface, modes)?;
            (found.poles, found.input, found.shapes, Vec::new())
        };
        let ports = surface.actuators.iter().map(|a| Port { name: a.name.clone(), at: a.at }).collect();
        let conditions = Conditions {
            rate: emission.rate,
            band: emission.band,
            lambda_min: Medium::of(&surface.sheet).lambda_min(high),
            outline: surface.outline.clone(),
        };
        Ok(Responses::Modal(ModalResponses {
            ports,
            poles,
            input,
            shapes,
            conditions,
            frequency_error,
            mode_errors,
        }))
    }
}

/// Poles, input weights and shapes of the modes from the frequency `low` (Hz) on, for a sheet without
/// loads.
fn unloaded(
    modes: Arc<Modes>,
    transducers: &[Transducer],
    low: f64,
) -> (Vec<Pole>, Mat<f64>, Arc<dyn Shapes>) {
    let below = modes.poles().partition_point(|pole| pole.omega / TAU < low);
    let poles = modes.poles()[below..].to_vec();
    let shapes: Arc<dyn Shapes> = if below == 0 { modes } else { Arc::new(Above { modes, below }) };
    let footprints: Vec<Footprint> = transducers.iter().map(|t| t.footprint.clone()).collect();
    let mut input = Footprint::all_weights(&footprints, shapes.as_ref());
    for (row, transducer) in transducers.iter().enumerate() {
        let gain = transducer.unloaded_gain();
        input.row_mut(row).iter_mut().for_each(|weight| *weight *= gain);
    }
    (poles, input, shapes)
}

/// Fingers as loads on the sheet.
fn fingers(surface: &Surface, contacts: &[Contact]) -> Result<Vec<Load>, PhysicsError> {
    let load = |contact: &Contact| {
        if !surface.outline.contains(contact.at) {
            return Err(PhysicsError::Unsupported {
                what: "place of a finger",
                expected: "a point inside the outline",
                found: format!("{}; the nearest is {}", contact.at, surface.outline.nearest(contact.at)),
            });
        }
        let radius = contact.finger.contact_radius;
        require("contact radius of a finger in m", radius >= 0.0, "0 or more", radius)?;
        let load = Load::finger(contact, &surface.outline);
        load.check()?;
        Ok(load)
    };
    contacts.iter().map(load).collect()
}

/// Sampled responses at many points (m), in single precision, computed on all threads from responses in modal form.
///
/// Each response has `samples` samples from the impulse on, at the rate of the responses. Errors stay below about 2e-6 times the
/// sum of the magnitudes of its modal weights.
pub fn sample(responses: &ModalResponses, points: &[Point], samples: usize) -> SampledResponses {
    let ModalResponses { ports, poles, input, shapes, conditions, .. } = responses;
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

/// Weights of the modes for each pair of actuator and point, (points · actuators) x modes.
fn weights(input: MatRef<f64>, readout: MatRef<f64>) -> Mat<f32> {
    let mut weights = Mat::zeros(readout.nrows() * input.nrows(), readout.ncols());
    for ((column, input), readout) in weights.col_iter_mut().zip(input.col_iter()).zip(readout.col_iter()) {
        let products = readout.iter().flat_map(|r| input.iter().map(move |i| (i * r) as f32));
        column.iter_mut().zip(products).for_each(|(w, product)| *w = product);
    }
    weights
}

/// The shapes of the modes with index `below` and higher.
#[derive(Debug)]
struct Above {
    modes: Arc<Modes>,
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
