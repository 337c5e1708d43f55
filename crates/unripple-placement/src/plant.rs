//! A surface on which an actuator can be put anywhere.

use crate::PlacementError;
use std::sync::Arc;
use unripple_core::{Actuator, ActuatorKind, CoilDrive, ModalResponses, Point, Responses, Surface};
use unripple_linalg::Mat;
use unripple_physics::{Modes, ResponseOptions, Transducer, accuracy, response_modes, responses_on};

/// A surface with the actuators that it keeps, and the kind of actuator that is placed on it.
///
/// An actuator to be placed is modelled as a force (or as the moment of a patch) that does not load the sheet: its mass, spring and
/// electrical damping are left out while places are compared, and are included once its place is chosen. The kept actuators load the
/// sheet.
#[derive(Clone, Debug)]
pub struct Plant {
    surface: Surface,
    template: Actuator,
    gain: f64,
    modes: Arc<Modes>,
    options: ResponseOptions,
    /// Weight of this surface in the objective, if layouts are optimised for several models of the surface.
    pub weight: f64,
}

impl Plant {
    /// A surface whose actuators are all kept, with actuators like `kind` to be placed on it.
    ///
    /// # Errors
    /// [`PlacementError::Physics`] of the surface's modes.
    ///
    /// ```
    /// use unripple_core::Point;
    /// use unripple_physics::design::papers_surface;
    /// use unripple_placement::Plant;
    ///
    /// let mut film = papers_surface();
    /// film.emission.band = [0.0, 500.0];
    /// let kind = film.actuators.remove(0);
    /// let plant = Plant::new(film, &kind)?;
    /// let responses = plant.responses(&[Point::from_mm(50.0, 60.0)])?;
    /// assert_eq!((plant.kept(), responses.input.nrows()), (7, 8));
    /// # Ok::<(), unripple_placement::PlacementError>(())
    /// ```
    pub fn new(surface: Surface, kind: &Actuator) -> Result<Self, PlacementError> {
        let options = ResponseOptions { accuracy: accuracy(&surface), ..ResponseOptions::default() };
        let modes = Arc::new(response_modes(&surface, &options)?);
        let (template, gain) = without_load(kind);
        Ok(Self { surface, template, gain, modes, options, weight: 1.0 })
    }

    /// The surface, with the kept actuators only.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Number of modes of the sheet that were computed: at least as many as the responses have.
    pub fn modes(&self) -> usize {
        self.modes.poles().len()
    }

    /// An upper bound of the relative error of the sheet's natural frequencies (a ratio).
    pub fn frequency_error(&self) -> f64 {
        self.modes.error()
    }

    /// The actuator that is placed, modelled without its load on the sheet.
    pub fn kind(&self) -> &Actuator {
        &self.template
    }

    /// Number of kept actuators.
    pub fn kept(&self) -> usize {
        self.surface.actuators.len()
    }

    /// Whether an actuator of the kind can be at a place (m): it must be on the sheet, a patch with its whole
    /// area.
    pub fn holds(&self, at: Point) -> bool {
        let there = Actuator { at, ..self.template.clone() };
        Transducer::of(&there, &self.surface.outline).is_ok()
    }

    /// The responses to the kept actuators, followed by those to one more at each of `places` (m).
    ///
    /// # Errors
    /// [`PlacementError::Physics`] for a place at which no actuator can be.
    pub fn responses(&self, places: &[Point]) -> Result<ModalResponses, PlacementError> {
        let mut surface = self.surface.clone();
        surface.actuators.extend(
            places.iter().enumerate().map(|(i, at)| Actuator { at: *at, ..named(&self.template, i) }),
        );
        let Responses::Modal(mut modal) = responses_on(&surface, self.modes.clone(), &self.options)? else {
            unreachable!("a model has modes")
        };
        let (kept, gain) = (self.kept(), self.gain);
        modal.input = Mat::from_fn(modal.input.nrows(), modal.input.ncols(), |row, mode| {
            modal.input[(row, mode)] * if row < kept { 1.0 } else { gain }
        });
        Ok(modal)
    }
}

fn named(actuator: &Actuator, i: usize) -> Actuator {
    Actuator { name: format!("place {i}"), ..actuator.clone() }
}

/// An actuator without its load on the sheet, and the factor on its force per drive: for a coil driven by a voltage, that at frequencies
/// where the coil's resistance alone sets the current.
fn without_load(actuator: &Actuator) -> (Actuator, f64) {
    let gain = actuator.kind.coil().map_or(1.0, |coil| match coil.driven_by {
        CoilDrive::Current => coil.force_constant,
        CoilDrive::Voltage => coil.force_constant / coil.resistance,
    });
    let kind = match actuator.kind {
        ActuatorKind::Piezo { patch, moment, .. } => ActuatorKind::Piezo { patch, moment, mass: 0.0 },
        ActuatorKind::Force | ActuatorKind::MovingMagnet { .. } | ActuatorKind::Exciter { .. } => {
            ActuatorKind::Force
        }
    };
    (Actuator { kind, ..actuator.clone() }, gain)
}
