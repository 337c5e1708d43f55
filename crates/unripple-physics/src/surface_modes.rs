//! The modes of a surface: of the sheet alone, and of the sheet with its actuators on it, from one solution.

use crate::responses::Asked;
use crate::{Accuracy, Modes, PhysicsError, ResponseOptions, cost};
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_core::{Cost, ModeError, Pole, Surface};

/// The modes of a surface up to a frequency, lowest first, without their shapes.
///
/// The frequency of a pole is |s|/2π of its complex frequency s, its decay rate -Re s.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceModes {
    /// The poles of the sheet alone, one per mode.
    pub sheet: Vec<Pole>,
    /// Share of bending in the elastic energy of each mode of the sheet alone, 0 to 1.
    pub bending_shares: Vec<f64>,
    /// The poles of the sheet with its actuators (their masses, springs, coils and electrical loads), one per mode; `None` if no actuator
    /// loads the sheet.
    pub loaded: Option<Vec<Pole>>,
    /// An upper bound of the relative error of the frequencies of the sheet alone, see [`Modes::error`](crate::Modes::error).
    pub error: f64,
    /// Upper bounds of the errors of each mode of the sheet alone, see [`Modes::errors`](crate::Modes::errors).
    pub errors: Vec<ModeError>,
}

impl SurfaceModes {
    /// Computes the modes up to `top_hz` (Hz); frequencies of the sheet alone have the relative accuracy `accuracy`.
    ///
    /// Where actuators load the sheet, its modes are solved for up to one and a half times `top_hz`, and those up to `top_hz` are kept of
    /// the sheet alone. The compliance of all higher modes enters the loaded ones as that of an infinite sheet.
    ///
    /// # Errors
    /// Those of [`responses`](crate::responses()); [`PhysicsError::Range`] if `top_hz` is not above 0.
    ///
    /// ```
    /// # use unripple_core::{ActuatorKind, CoilDrive};
    /// use unripple_physics::{SurfaceModes, design::papers_surface};
    ///
    /// let mut film = papers_surface();
    /// let bare = SurfaceModes::solve(&film, 400.0, 1e-4)?;
    /// assert!(bare.loaded.is_none(), "ideal forces are no load");
    /// // Eight magnets of 0.1 g: the first mode falls.
    /// for actuator in &mut film.actuators {
    ///     actuator.contact_radius = 2e-3;
    ///     actuator.kind = ActuatorKind::MovingMagnet {
    ///         force_constant: 0.2,
    ///         resistance: 8.0,
    ///         inductance: 0.0,
    ///         moving_mass: 1e-4,
    ///         driven_by: CoilDrive::Current,
    ///     };
    /// }
    /// let found = SurfaceModes::solve(&film, 400.0, 1e-4)?;
    /// assert_eq!(found.sheet.len(), bare.sheet.len());
    /// assert!(found.loaded.is_some_and(|loaded| loaded[0].omega < 0.999 * found.sheet[0].omega));
    /// # Ok::<(), unripple_physics::PhysicsError>(())
    /// ```
    pub fn solve(
        surface: &Surface,
        top_hz: f64,
        accuracy: impl Into<Accuracy>,
    ) -> Result<Self, PhysicsError> {
        let (below, asked) = asked(surface, top_hz, accuracy.into())?;
        let modes = Arc::new(asked.modes(&below)?);
        Self::coupled(&below, &asked, modes)
    }

    /// The estimated cost of [`SurfaceModes::solve`].
    ///
    /// # Errors
    /// Those of [`SurfaceModes::solve`] that are known before solving, such as [`PhysicsError::TooLarge`].
    pub fn cost(surface: &Surface, top_hz: f64, accuracy: impl Into<Accuracy>) -> Result<Cost, PhysicsError> {
        let (below, asked) = asked(surface, top_hz, accuracy.into())?;
        cost::of(&below, &asked)
    }

    /// The modes of the sheet from which [`SurfaceModes::solve`] computes.
    pub(crate) fn modes(
        surface: &Surface,
        top_hz: f64,
        accuracy: impl Into<Accuracy>,
    ) -> Result<Modes, PhysicsError> {
        let (below, asked) = asked(surface, top_hz, accuracy.into())?;
        asked.modes(&below)
    }

    /// The modes up to `top_hz` (Hz) from modes of the sheet already computed: at least up to `top_hz`, and where actuators load the sheet,
    /// best up to one and a half times that.
    ///
    /// # Errors
    /// Those of [`SurfaceModes::solve`].
    pub fn on(surface: &Surface, top_hz: f64, modes: Arc<Modes>) -> Result<Self, PhysicsError> {
        let (below, asked) = asked(surface, top_hz, Accuracy::from(modes.error()))?;
        Self::coupled(&below, &asked, modes)
    }

    /// The modes of the sheet alone up to `top_hz` (Hz), for callers that do not know its loads.
    pub fn of_sheet(modes: &Modes, top_hz: f64) -> Self {
        let inside = modes.poles().partition_point(|pole| pole.omega <= TAU * top_hz);
        Self {
            sheet: modes.poles()[..inside].to_vec(),
            bending_shares: modes.bending_shares()[..inside].to_vec(),
            loaded: None,
            error: modes.error(),
            errors: modes.errors()[..inside].to_vec(),
        }
    }

    fn coupled(below: &Surface, asked: &Asked, modes: Arc<Modes>) -> Result<Self, PhysicsError> {
        let sheet = Self::of_sheet(&modes, below.emission.band[1]);
        let loaded = if asked.bare() { None } else { Some(asked.coupled(below, modes)?.modes) };
        Ok(Self { loaded, ..sheet })
    }
}

/// A surface with a band from 0 to `top_hz` (Hz), and what is asked of it.
fn asked(surface: &Surface, top_hz: f64, accuracy: Accuracy) -> Result<(Surface, Asked), PhysicsError> {
    let mut below = surface.clone();
    below.emission.band = [0.0, top_hz];
    // Nothing is sampled: the rate is only to be no reason to refuse.
    below.emission.rate = below.emission.rate.max(3.0 * top_hz);
    let asked = Asked::of(&below, &ResponseOptions { accuracy, ..ResponseOptions::default() })?;
    Ok((below, asked))
}
