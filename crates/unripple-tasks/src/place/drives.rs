//! What drives of a method reach from a layout, as a score by which layouts are compared: computed and evaluated as `focus` does, with the
//! loads of all actuators.

use super::{Ask, ByAsk};
use crate::{Progress, TaskError, go_on};
use std::sync::Arc;
use unripple::act::{Act, ActError, Judging, Level, Readouts, model_modes, model_on};
use unripple::core::Surface;
use unripple::field::Measured;
use unripple::focus::{FocusError, Focuser, Method, Options, Target};
use unripple::physics::Modes;
use unripple_placement::{Aim, Objective};

impl ByAsk {
    /// Its key in the results by method.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Contrast => "contrast",
            Self::FeltContrast => "felt_contrast_db",
            Self::FeltLevel => "felt_level_db",
            Self::EnergyForPeak => "energy_for_peak",
        }
    }

    /// The figure in words, with its unit.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Contrast => "contrast",
            Self::FeltContrast => "felt contrast (dB)",
            Self::FeltLevel => "felt level at the limit (dB)",
            Self::EnergyForPeak => "energy for a peak",
        }
    }

    /// The figure as a score in the same unit, of which more is better, and the score as a figure.
    pub(super) fn turned(self, value: f64) -> f64 {
        if self == Self::EnergyForPeak { -value } else { value }
    }

    /// The figure of a drive to one target; `None` where it is not defined.
    fn of(self, measured: &Measured) -> Option<f64> {
        let target = measured.targets.first()?;
        match self {
            Self::Contrast => target.contrast,
            Self::FeltContrast => target.felt_contrast_db,
            Self::FeltLevel => target.felt_level_db,
            Self::EnergyForPeak => {
                let energy = measured.drive.energy / target.peak_velocity_m_s.powi(2);
                energy.is_finite().then_some(energy)
            }
        }
    }
}

/// The method whose drives count.
pub(super) fn method(ask: &Ask) -> Method {
    ask.methods.first().copied().unwrap_or_default()
}

/// Drives of a method from any layout of the same actuators.
pub(super) struct Drives {
    by: ByAsk,
    objective: Objective,
    method: Method,
    /// Window T, in s.
    window: f64,
    /// The modes of the band, from which drives are computed.
    band: Arc<Modes>,
    /// The modes on which drives are evaluated, and the frequency up to which they go, in Hz.
    judged: (Arc<Modes>, f64),
}

impl Drives {
    /// Prepares drives with a window (s) for layouts of the actuators of a surface.
    ///
    /// # Errors
    /// Those of solving for modes.
    pub fn of(ask: &Ask, by: ByAsk, surface: &Surface, window: f64) -> Result<Self, TaskError> {
        let band = Arc::new(model_modes(surface, None)?);
        let (judged, judging) =
            Judging::of(surface, None, |hz| Ok(Arc::new(model_modes(surface, Some(hz))?)))?;
        let (objective, method) = (ask.objective(), method(ask));
        Ok(Self { by, objective, method, window, band, judged: (judged, judging.hz) })
    }

    /// The objective for the figures of drives to `aims` from the actuators of a surface, as a score: more is better. It is minus infinity
    /// where the figure of a drive is not defined. Fields that are `thinned` are read at a fourth of the points.
    ///
    /// # Errors
    /// Those of computing and evaluating drives; [`TaskError::Cancelled`].
    pub fn score(
        &self,
        surface: &Surface,
        aims: &[Aim],
        thinned: bool,
        progress: &dyn Progress,
    ) -> Result<f64, TaskError> {
        go_on(progress)?;
        let known = model_on(surface, self.band.clone(), None)?;
        let plant = model_on(surface, self.judged.0.clone(), Some(self.judged.1))?;
        let on = if thinned { Readouts::thinned(&plant) } else { Readouts::of(&plant) };
        let options = Options {
            method: self.method,
            window: self.window,
            limit: surface.emission.limit,
            rms_limit: surface.emission.rms_limit,
            ..Options::default()
        };
        let focuser = Focuser::new(&known, &options).map_err(ActError::from)?;
        let mut scores = Vec::with_capacity(aims.len());
        for aim in aims {
            go_on(progress)?;
            let targets = [Target::at(aim.at)];
            let act =
                Act { surface, responses: &plant, targets: &targets, options: &options, level: Level::Limit };
            match self.figure(&act, &focuser, &on)? {
                Some(figure) => scores.push(self.by.turned(figure)),
                None => return Ok(f64::NEG_INFINITY),
            }
        }
        let total: f64 = aims.iter().map(|aim| aim.weight).sum();
        let weights: Vec<f64> = aims.iter().map(|aim| aim.weight / total).collect();
        Ok(self.objective.of(&scores, &weights))
    }

    /// The figure of the drive to the target of an act; `None` where it is not defined.
    fn figure(
        &self,
        act: &Act<'_>,
        focuser: &Focuser<'_>,
        on: &Readouts<'_>,
    ) -> Result<Option<f64>, TaskError> {
        let focused = match focuser.focus(act.targets) {
            // Not from these places.
            Err(FocusError::Still { .. }) => return Ok(None),
            focused => focused.map_err(ActError::from)?,
        };
        let sent = act.send(focuser, focused, on)?;
        Ok(self.by.of(&act.measure(&sent, on)?))
    }
}
