//! The measurements in a library: responses between actuators, and responses at all other points.

use crate::calibrate::before::SWEPT;
use crate::calibrate::by_taps;
use crate::own;
use crate::{Progress, TaskError};
use unripple::core::{SampledResponses, Surface};
use unripple::dsp::median;
use unripple_calibrate::Measured;
use unripple_calibrate::measure::MeasureOptions;
use unripple_calibrate::signals::Band;
use unripple_store::Library;

/// Distance in metres within which a point counts as lying at an actuator. Places are written in files to a
/// nanometre.
const SAME: f64 = 1e-9;

/// Lowest frequency that is fitted, relative to the lowest that is measured in full. Below, the sweep's
/// fade-in has changed amplitudes.
const LOWEST: f64 = 1.2;

/// Highest frequency that is fitted, relative to the top of the band: modes at the very top are cut.
pub(crate) const TOP: f64 = 0.9;

/// Measured responses of a library, split into those between actuators and those at all other points.
pub struct Measurements {
    /// Responses between actuators: from each actuator to the sensors of all.
    pub measured: Measured,
    /// The responses at all other points.
    pub probed: SampledResponses,
    /// Numbers of the points of `probed` in the library, from 1.
    pub numbers: Vec<usize>,
    /// Indices of actuators that are dead or were left out of the measurement.
    pub dead: Vec<usize>,
    /// Whether the responses in `probed` were measured by a probe rather than by taps on the surface.
    pub probe: bool,
    /// The band that is fitted, in Hz.
    pub band: [f64; 2],
}

impl Measurements {
    /// Reads the responses between a library's actuators, and those at all other points.
    pub fn of(library: &Library, surface: &Surface, progress: &mut dyn Progress) -> Result<Self, TaskError> {
        let (all, damage) = library.intact()?;
        for damage in &damage {
            progress.tell(&format!("damaged, and left out: {damage}"));
        }
        let count = surface.actuators.len();
        // The last point of a place is the actuator's own; one before may be a probe's.
        let place = |at: unripple::core::Point| all.points.iter().rposition(|p| p.distance(at) < SAME);
        let own: Vec<Option<usize>> = surface.actuators.iter().map(|actuator| place(actuator.at)).collect();
        if own.iter().flatten().count() < 2 || all.ports.len() != count {
            return Err(TaskError::Input(format!(
                "{}: expected the responses between {count} actuators, found {} of them with sensors (measure with `unripple \
                 calibrate` on a device with an input for each actuator's sensor)",
                library.path().display(),
                own.iter().flatten().count(),
            )));
        }
        let dead = library.dead();
        let one = |n: usize| match own[n % count] {
            _ if dead.contains(&(n % count)) || dead.contains(&(n / count)) => Vec::new(),
            Some(point) => all.response(n / count, point).iter().map(|v| f64::from(*v)).collect(),
            None => Vec::new(),
        };
        let responses = (0..count * count).map(one).collect();
        let [low, high] = all.conditions.band;
        let [from, to] = swept(library, surface)?;
        let limited = Band::within(from, to);
        let (rate, band) = (all.conditions.rate, [low.max(LOWEST * limited.low[1]), TOP * high]);
        let numbers = numbers(library, &all);
        let measured = Measured::reciprocal(rate, responses, [from, to])?.limited_to(limited);
        let measured = match noise(library, &all, &own, &numbers)? {
            Some(noise) => measured.with_noise(noise),
            None => measured,
        };
        let others: Vec<usize> = (0..all.points.len()).filter(|p| !own.contains(&Some(*p))).collect();
        let probed = all.select(&others).map_err(TaskError::work)?;
        let numbers = others.iter().map(|p| numbers[*p] + 1).collect();
        let probe = !by_taps(library);
        Ok(Self { measured, probed, numbers, dead, probe, band })
    }

    /// Number of measured responses between actuators.
    pub fn count(&self) -> usize {
        self.measured.pairs.iter().flat_map(|p| &p.responses).filter(|r| !r.is_empty()).count()
    }
}

/// Numbers in the library, from 0, of the points that could be read.
fn numbers(library: &Library, all: &SampledResponses) -> Vec<usize> {
    let mut done = library.done().into_iter();
    all.points.iter().filter_map(|at| done.find(|point| library.points()[*point] == *at)).collect()
}

/// Median rms noise of the responses between actuators, from the measured signal-to-noise ratios.
fn noise(
    library: &Library,
    all: &SampledResponses,
    own: &[Option<usize>],
    numbers: &[usize],
) -> Result<Option<f64>, TaskError> {
    let mut found = Vec::new();
    for (sensor, point) in own.iter().enumerate() {
        let Some(point) = *point else { continue };
        let qualities = library.quality(numbers[point])?;
        for (driven, quality) in qualities.iter().enumerate().filter(|(driven, _)| *driven != sensor) {
            let response = all.response(driven, point);
            let power = response.iter().map(|h| f64::from(*h).powi(2)).sum::<f64>() / response.len() as f64;
            found.extend(own::noise(quality).filter(|_| power > 0.0).map(|noise| power.sqrt() * noise));
        }
    }
    Ok(median(found))
}

/// The lowest and the highest frequency of the sweeps that a library was measured with, in Hz: as it
/// states, or else those that `calibrate` uses by default.
fn swept(library: &Library, surface: &Surface) -> Result<[f64; 2], TaskError> {
    let Some(text) = library.plan().provenance.get(SWEPT) else {
        return Ok(MeasureOptions::default().swept(surface));
    };
    let hz: Vec<f64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    match hz[..] {
        [from, to] if from > 0.0 && from.is_finite() && to > 1.8 * from && to.is_finite() => Ok([from, to]),
        _ => Err(TaskError::Input(format!(
            "{}: expected `{SWEPT}` as the lowest and the highest frequency, found `{text}`",
            library.path().display()
        ))),
    }
}
