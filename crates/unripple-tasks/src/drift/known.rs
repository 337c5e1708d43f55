//! The model whose tension is followed: that of a surface file, or one fitted to the responses between a library's actuators.

use crate::fit::{FITTED_TO, Measurements, model};
use crate::{Progress, SurfaceAsk, TaskError, fit, judge, source};
use unripple::core::{ModalResponses, Pole, Responses, Surface};
use unripple::dsp::convolve;
use unripple::physics::Modes;
use unripple_calibrate::{Drift, Fitted, PingOptions, Tracker, Tracking, Verdict};
use unripple_store::Library;

/// Share of the sensors' signals that the model of a surface file may leave unexplained. The noise of a microphone and the rounding of a
/// device to float32 leave far less, an actuator that is off its place by a millimetre far more.
const MODEL: f64 = 0.02;

/// Name of the reference of a measured tension if that is a surface file.
pub(super) const FILE: &str = "the surface file";

/// Reference of the drift measurement: the surface, the responses of its model, and its dead actuators.
pub(super) struct Known {
    /// The surface as its file or its library describes it.
    pub surface: Surface,
    /// Responses of the surface's model, computed from the file or fitted to the library.
    pub modal: ModalResponses,
    /// What the measured tension is compared with, in words.
    pub against: String,
    /// Actuators that are dead: they neither drive nor sense.
    pub dead: Vec<usize>,
    library: Option<Measured>,
}

/// A library with the model fitted to it.
struct Measured {
    name: String,
    measurements: Measurements,
    fitted: Fitted,
    /// Factor by which each sensor's signal is multiplied, and the drive that a sample at full scale stands
    /// for, if the library's log states it.
    scales: Vec<f64>,
    output: Option<f64>,
}

impl Known {
    /// Reads a surface or a library, and computes or fits its model.
    ///
    /// # Errors
    /// Those of reading either; [`TaskError::Input`] of a library without sensors at its actuators, and of a sheet without tension; those
    /// of the model or fit.
    pub fn of(ask: &SurfaceAsk, progress: &mut dyn Progress) -> Result<Self, TaskError> {
        let known = match ask {
            SurfaceAsk::Name(name) if Library::is_at(name) => {
                Self::of_library(Library::open(name)?, progress)?
            }
            _ => Self::of_surface(ask.load()?, FILE.into(), progress)?,
        };
        match known.surface.sheet.tension > 0.0 {
            true => Ok(known),
            false => Err(TaskError::Input(format!(
                "{}: expected a sheet under tension, found a plate without tension",
                known.surface.name
            ))),
        }
    }

    fn of_surface(surface: Surface, against: String, progress: &mut dyn Progress) -> Result<Self, TaskError> {
        progress.stage("responses");
        let Responses::Modal(modal) = judge::model(&surface, None, &[])? else {
            return Err(TaskError::Work("expected a model with modes, found samples".into()));
        };
        Ok(Self { surface, modal, against, dead: Vec::new(), library: None })
    }

    fn of_library(library: Library, progress: &mut dyn Progress) -> Result<Self, TaskError> {
        let surface = source::described(&library)?;
        let provenance = &library.plan().provenance;
        let name = library.path().display().to_string();
        if provenance.get("device").is_some_and(|device| device == "model") {
            return Self::of_surface(
                surface,
                format!("the surface file that {name} was computed from"),
                progress,
            );
        }
        if let Some(measured) = provenance.get(FITTED_TO) {
            if !Library::is_at(measured) {
                return Err(TaskError::Input(format!(
                    "{name}: expected the measured library that this model was fitted to at `{measured}`, since its responses give the \
                     tension, found none there"
                )));
            }
            return Self::of_library(Library::open(measured)?, progress);
        }
        source::warn(&library, progress);
        let usual = fit::Ask::default();
        let (measurements, fitted) = model(&library, &surface, [usual.strays, usual.profile], progress)?;
        if let Verdict::Doubtful { why, .. } = &fitted.verdict {
            return Err(TaskError::Work(format!(
                "{name}: expected a model that explains the sensor signals of its actuators, found a doubtful one: {why}"
            )));
        }
        let told = library.logged("scale").cloned().unwrap_or_default();
        let scale = |name: &str| told["input"][name].as_f64().or(told["input_all"].as_f64()).unwrap_or(1.0);
        Ok(Self {
            modal: fitted.modal().clone(),
            against: format!("when {name} was measured"),
            dead: measurements.dead.clone(),
            library: Some(Measured {
                scales: surface.actuators.iter().map(|actuator| scale(&actuator.name)).collect(),
                output: told["output"].as_f64(),
                name,
                measurements,
                fitted,
            }),
            surface,
        })
    }

    /// Mean tension that the responses assume, in N/m.
    pub fn tension(&self) -> f64 {
        self.library.as_ref().map_or(self.surface.sheet.tension, |library| library.fitted.tension.value)
    }

    /// Whether the model was fitted to a library.
    pub fn is_fitted(&self) -> bool {
        self.library.is_some()
    }

    /// The dimensionless factor by which an actuator's sensor signal is multiplied; actuators count from 0.
    pub fn scale(&self, actuator: usize) -> f64 {
        self.library.as_ref().and_then(|library| library.scales.get(actuator)).copied().unwrap_or(1.0)
    }

    /// Drive that a sample at full scale stands for, in the actuators' unit, if the library's log states
    /// it.
    pub fn output_scale(&self) -> Option<f64> {
        self.library.as_ref().and_then(|library| library.output)
    }

    /// Lowest and highest frequency of the pings, as shares of the top of the surface's band: high
    /// frequencies are most sensitive to tension, and a fit leaves out the highest.
    pub fn ping_band(&self) -> [f64; 2] {
        let fitted = |library: &Measured| library.measurements.band[1] / self.modal.conditions.band[1];
        let top = self.library.as_ref().map_or(1.0, fitted);
        PingOptions::default().band.map(|share| share * top)
    }

    /// Share of the sensors' signals that the model may leave unexplained.
    pub fn unexplained(&self) -> f64 {
        self.library.as_ref().map_or(MODEL, |library| library.fitted.unexplained().max(MODEL))
    }

    /// Tracker of the tension, for a ping (actuators x samples), a noise (rms on each sensor) and the
    /// largest relative change `range`. For a library, zero change is the tension that explains the
    /// response to the ping as computed from the measured responses.
    ///
    /// # Errors
    /// Those of the trackers; [`TaskError::Work`] of a library that its model does not explain.
    pub fn tracker(&self, ping: &[Vec<f64>], noise: f64, range: f64) -> Result<Tracker, TaskError> {
        let options = Tracking { noise, range, model: MODEL, ..Tracking::default() };
        let Some(Measured { name, measurements, fitted, .. }) = &self.library else {
            let shares = bending_shares(&self.surface, &self.modal)?;
            return Ok(Tracker::of_surface(&self.surface, &self.modal, &shares, &options)?);
        };
        let fresh = fitted.tracker(&options)?.without(&self.dead);
        let mut then = fresh.clone();
        match then.observe(ping, &sounded(ping, measurements))? {
            Drift::Followed { tension, .. } => Ok(fresh.with_zero(tension)?),
            Drift::Unexplained { excess, limit, .. } => Err(TaskError::Work(format!(
                "{name}: expected a model whose sensor signals after a ping agree with those of the measured responses within {limit:.0} \
                 times what noise and the model's error explain, found a residual of {excess:.1} times that"
            ))),
        }
    }
}

/// Share of bending in the stiffness of each mode of a surface with its actuators: that of the bare sheet's
/// mode nearest in frequency, which actuators change little. The share on an endless sheet would be off by
/// some per cent near clamped edges.
fn bending_shares(surface: &Surface, modal: &ModalResponses) -> Result<Vec<f64>, TaskError> {
    let modes =
        Modes::solve(surface, modal.conditions.band[1], judge::accuracy(surface)).map_err(TaskError::work)?;
    let known: Vec<(f64, f64)> =
        modes.poles().iter().map(|pole| pole.omega).zip(modes.bending_shares().iter().copied()).collect();
    let nearest = |pole: &Pole| {
        let apart = |mode: &&(f64, f64)| (mode.0 - pole.omega).abs();
        known.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).map_or(0.0, |(_, share)| *share)
    };
    Ok(modal.poles.iter().map(nearest).collect())
}

/// Sensor signals that a drive would have caused when the library was measured, as long as the library's
/// responses.
fn sounded(drive: &[Vec<f64>], measurements: &Measurements) -> Vec<Vec<f64>> {
    let rate = measurements.measured.rate;
    let pairs: Vec<&Vec<f64>> =
        measurements.measured.pairs.iter().flat_map(|pairs| &pairs.responses).collect();
    let samples = pairs.iter().map(|response| response.len()).max().unwrap_or(0);
    let sensor = |sensor: usize| {
        let mut sum = vec![0.0; samples];
        for (driven, signal) in drive.iter().enumerate() {
            let Some(response) = pairs.get(driven * drive.len() + sensor) else { continue };
            if !response.is_empty() {
                sum.iter_mut().zip(convolve(signal, response)).for_each(|(sum, x)| *sum += x / rate);
            }
        }
        sum
    };
    (0..drive.len()).map(sensor).collect()
}
