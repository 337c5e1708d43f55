//! Compares recordings with the prediction: delay, gain, likely causes, and the recordings in step with the prediction.

use super::bench::{QUIET, Recorded};
use super::setting::Setting;
use crate::TaskError;
use unripple::dsp::mean_square;
use unripple::physics::Medium;
use unripple_calibrate::causes::{Findings, Lines, Model, Played, find};
use unripple_calibrate::signals::{Band, shift};

/// Recordings compared with the prediction.
pub(super) struct Analysis {
    /// Delay, gain and suspected causes.
    pub findings: Findings,
    /// Recorded velocity in the band, without its delay, places x samples; without a scale times a factor with which it fits the
    /// prediction best.
    pub measured: Vec<Vec<f64>>,
}

impl Analysis {
    /// Analyses the recordings of a setting's drive.
    ///
    /// # Errors
    /// Those of [`find`].
    pub fn of(setting: &Setting, recorded: &Recorded) -> Result<Self, TaskError> {
        let rate = setting.drive.rate();
        let band = inner(setting);
        let samples = recorded.full.iter().map(Vec::len).max().unwrap_or(0);
        let lines = Lines::new(samples, rate, band)?;
        let medium = Medium::of(&setting.surface.sheet);
        let model = Model::new(&setting.responses, &setting.places, &medium, lines)?;
        let mut noise = recorded.noise.clone();
        band.limit(&mut noise, rate).map_err(TaskError::input)?;
        let played = Played {
            drive: setting.drive.channels(),
            full: &recorded.full,
            quiet: Some((QUIET, &recorded.quiet)),
            noise: mean_square(&noise) * (samples * recorded.full.len()) as f64,
        };
        let findings = find(&model, &played)?;
        let factor = match recorded.scaled {
            false if findings.gain != 0.0 => 1.0 / findings.gain,
            _ => 1.0,
        };
        let whole = setting.band();
        let aligned = |line: &Vec<f64>| {
            let mut line = shift(line, -findings.delay);
            whole.limit(&mut line, rate).map_err(TaskError::input)?;
            line.resize(setting.samples, 0.0);
            line.iter_mut().for_each(|v| *v *= factor);
            Ok(line)
        };
        let measured = recorded.full.iter().map(aligned).collect::<Result<_, TaskError>>()?;
        Ok(Self { findings, measured })
    }
}

/// The band in which causes are sought: that of the surface, in which drives have their energy.
fn inner(setting: &Setting) -> Band {
    let (top, whole) = (setting.surface.emission.band[1], setting.band());
    let high = top.min(whole.high[0]);
    Band { low: [0.0; 2], high: [high, high * whole.high[1] / whole.high[0]] }
}
