//! What a drive does to a surface: velocity and displacement anywhere, at any time.

use crate::modal::ModalField;
use crate::sampled::SampledField;
use crate::source::{Quantity, Source};
use crate::spot::Spot;
use crate::{FieldError, Grid, Readout, Trace};
use unripple_core::{Conditions, Drive, Point, Responses, require};
use unripple_dsp::Threshold;

/// Largest number of values of all snapshots or traces together: 800 MB of traces. Twice as many take twice
/// the memory.
const MOST_VALUES: usize = 100_000_000;

/// What a drive does to a surface: velocity and displacement anywhere, at any time.
///
/// Modal responses are evaluated on the cells of a [`Grid`], sampled ones at their own points. Velocity is
/// `v[i] = Σ_j h[i−j] d[j] / rate`, where `h[0]`, the value just after the impulse, counts whole; displacement is its
/// exact integral over time, from rest.
pub struct Field<'a> {
    /// Where velocity and displacement are read: modes or samples.
    pub(crate) source: Box<dyn Source + 'a>,
    /// Band, rate and region of the responses.
    pub(crate) conditions: &'a Conditions,
    /// The drive that is simulated.
    pub(crate) drive: &'a Drive,
    /// Threshold of vibrotactile detection.
    pub(crate) threshold: Threshold,
    grid: Option<Grid>,
}

impl std::fmt::Debug for Field<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Field").field("points", &self.points().len()).field("grid", &self.grid).finish()
    }
}

/// The field at one instant, one value per point of the field.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Time of the snapshot, in seconds from the drive's first sample.
    pub instant: f64,
    /// Velocity at each point of the field, in m/s.
    pub velocity: Vec<f32>,
    /// Displacement at each point of the field, in metres.
    pub displacement: Vec<f32>,
}

impl<'a> Field<'a> {
    /// The field of `drive` through `responses`, on a grid of `cells` cells per shortest wavelength (8 where
    /// metrics are computed), or at the stored points of sampled responses.
    ///
    /// # Errors
    /// [`FieldError::Channels`] and [`FieldError::Rate`] if the drive is not for these responses,
    /// [`FieldError::Count`] if it is empty, [`FieldError::Range`] if the grid would have no or too many cells.
    pub fn new(responses: &'a Responses, drive: &'a Drive, cells: f64) -> Result<Self, FieldError> {
        check(responses, drive)?;
        Ok(Self::on(&Readout::new(responses, cells)?, responses, drive))
    }

    /// The field of a drive that has been checked against these responses, on the points of their readout.
    fn on(readout: &Readout<'_>, responses: &'a Responses, drive: &'a Drive) -> Self {
        let source: Box<dyn Source + 'a> = match responses {
            Responses::Modal(modal) => Box::new(ModalField::new(modal, drive, readout.kept.clone())),
            Responses::Sampled(sampled) => Box::new(SampledField::new(sampled, drive)),
        };
        let (conditions, threshold, grid) =
            (responses.conditions(), Threshold::default(), readout.grid.clone());
        Self { source, conditions, drive, threshold, grid }
    }

    /// The field with another threshold of vibrotactile detection than the published one.
    #[must_use]
    pub fn felt_above(mut self, threshold: Threshold) -> Self {
        self.threshold = threshold;
        self
    }

    /// The points (m) for which snapshots and maps have values.
    pub fn points(&self) -> &[Point] {
        self.source.points()
    }

    /// The grid whose cell centres are [`Field::points`]; `None` for sampled responses, whose points are
    /// those stored.
    pub fn grid(&self) -> Option<&Grid> {
        self.grid.as_ref()
    }

    /// Sample rate of drive and responses, in samples per second.
    pub fn rate(&self) -> f64 {
        self.drive.rate()
    }

    /// Number of samples, counted from the drive's first, for which the field is known.
    pub fn known(&self) -> usize {
        self.source.known()
    }

    /// Velocity and displacement at points (m) from the drive's first sample up to the sample at `until` (s), included.
    ///
    /// # Errors
    /// [`FieldError::Outside`] and [`FieldError::Unknown`] for points without responses, [`FieldError::Instant`] and
    /// [`FieldError::Count`] for too long a time.
    pub fn traces(&self, points: &[Point], until: f64) -> Result<Vec<Trace>, FieldError> {
        let sets = points
            .iter()
            .map(|p| Ok(vec![self.source.locate(*p)?]))
            .collect::<Result<Vec<_>, FieldError>>()?;
        let end = self.sample(until)? + 1;
        bounded("values of the traces", end.saturating_mul(2 * points.len()))?;
        Ok(self.source.traces(&sets, 0..end))
    }

    /// The field at all points at some instants (s), each rounded to a sample.
    ///
    /// # Errors
    /// [`FieldError::Instant`] and [`FieldError::Count`] for instants that are not known, or too many.
    pub fn snapshots(&self, instants: &[f64]) -> Result<Vec<Snapshot>, FieldError> {
        let samples = instants.iter().map(|t| self.sample(*t)).collect::<Result<Vec<_>, _>>()?;
        bounded("values of the snapshots", samples.len().saturating_mul(2 * self.points().len()))?;
        let found = self.source.survey(&[], &samples).snapshots;
        Ok(samples.iter().zip(found).map(|(sample, values)| self.snapshot(*sample, values)).collect())
    }

    /// A snapshot at a sample, of velocity (m/s) and displacement (m) at every point.
    pub(crate) fn snapshot(&self, sample: usize, [velocity, displacement]: [Vec<f32>; 2]) -> Snapshot {
        Snapshot { instant: sample as f64 / self.drive.rate(), velocity, displacement }
    }

    /// The sample nearest to an instant.
    pub(crate) fn sample(&self, instant: f64) -> Result<usize, FieldError> {
        let rate = self.drive.rate();
        let last = (self.known().max(1) - 1) as f64;
        let sample = (instant * rate).round();
        if (0.0..=last).contains(&sample) {
            return Ok(sample as usize);
        }
        let why = "as far as the field is known";
        Err(FieldError::Instant { found: instant, first: 0.0, last: last / rate, why })
    }

    /// Focal spots, for [`crate::measure()`].
    pub(crate) fn spots(&self, requests: &[(Point, usize, Quantity)]) -> Vec<Spot> {
        self.source.spots(requests)
    }
}

impl<'a> Readout<'a> {
    /// The field of a drive, evaluated on the points of this readout.
    ///
    /// # Errors
    /// [`FieldError::Channels`] and [`FieldError::Rate`] if the drive is not for these responses, [`FieldError::Count`] if it is empty.
    pub fn field<'b>(&self, drive: &'b Drive) -> Result<Field<'b>, FieldError>
    where
        'a: 'b,
    {
        check(self.responses, drive)?;
        Ok(Field::on(self, self.responses, drive))
    }
}

/// Refuses more values than may be held in memory.
pub(crate) fn bounded(what: &'static str, found: usize) -> Result<(), FieldError> {
    if found <= MOST_VALUES {
        return Ok(());
    }
    Err(FieldError::Count { what, expected: format!("at most {MOST_VALUES}"), found })
}

/// Checks that a drive has the channels and the sample rate of these responses.
pub(crate) fn check(responses: &Responses, drive: &Drive) -> Result<(), FieldError> {
    let names: Vec<&str> = responses.ports().iter().map(|port| port.name.as_str()).collect();
    let rate = responses.conditions().rate;
    require("sample rate of the responses (Hz)", rate.is_finite() && rate > 0.0, "a positive number", rate)?;
    fits(&names, rate, drive)
}

/// Checks that a drive has samples, one channel for each of these actuators in this order, and the sample
/// rate `rate` (samples per second).
///
/// # Errors
/// [`FieldError::Channels`], [`FieldError::Rate`] and [`FieldError::Count`].
pub fn fits(actuators: &[&str], rate: f64, drive: &Drive) -> Result<(), FieldError> {
    let list = |names: Vec<&str>| {
        let more = if names.len() > 16 { ", …" } else { "" };
        format!("{} ({}{more})", names.len(), names[..names.len().min(16)].join(", "))
    };
    let found: Vec<&str> = drive.names().iter().map(String::as_str).collect();
    if actuators != found {
        return Err(FieldError::Channels { expected: list(actuators.to_vec()), found: list(found) });
    }
    // Equal rates, but for rounding in files.
    if (drive.rate() / rate - 1.0).abs() > 1e-9 {
        return Err(FieldError::Rate { expected: rate, found: drive.rate() });
    }
    if drive.samples() == 0 || drive.channels().is_empty() {
        return Err(FieldError::Count {
            what: "samples of the drive",
            expected: "at least 1".to_owned(),
            found: 0,
        });
    }
    Ok(())
}
