//! Modal responses of the film with one actuator, and the largest force that figures of it share.

use super::PaperSetup;
use unripple::core::{Conditions, Decay, ModalResponses, Port, Responses};
use unripple::physics::design::closed;
use unripple_tasks::TaskError;

/// Largest force of an actuator in these figures, in N: far below the film's drive limit, so that the
/// displacement stays below the film's thickness.
pub(super) const FORCE: f64 = 10e-3;

/// The modal responses, or an error if the responses are sampled.
pub(super) fn modal(responses: &Responses) -> Result<&ModalResponses, TaskError> {
    match responses {
        Responses::Modal(modal) => Ok(modal),
        Responses::Sampled(_) => {
            Err(TaskError::Work("the paper's figures need modes, found sampled responses".into()))
        }
    }
}

/// The actuator with this index, or an error if there are fewer.
pub(super) fn actuator(modal: &ModalResponses, index: usize) -> Result<Port, TaskError> {
    let missing = || {
        TaskError::Work(format!("actuators: expected at least {}, found {}", index + 1, modal.ports.len()))
    };
    modal.ports.get(index).cloned().ok_or_else(missing)
}

/// Responses of the same surface to one ideal point force at `port`; a mode's input weight at a point is
/// its readout weight there.
pub(super) fn driven_at(modal: &ModalResponses, port: Port) -> Responses {
    let input = modal.shapes.at_all(&[port.at]);
    Responses::Modal(ModalResponses { ports: vec![port], input, ..modal.clone() })
}

/// The closed form's contrast on the setup's film with `actuators` actuators; `None` where decay varies with frequency.
pub(super) fn closed_contrast(setup: &PaperSetup, modal: &ModalResponses, actuators: usize) -> Option<f64> {
    let Decay::Time(tau) = setup.surface.sheet.decay else { return None };
    let Conditions { band: [low, high], .. } = modal.conditions;
    Some(closed::contrast(actuators as f64, high - low, tau, setup.window, modal.poles.len() as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Index of some actuator.
    const ACTUATOR: usize = 0;

    #[test]
    fn one_port_takes_in_what_that_actuator_does() {
        let setup = PaperSetup::new().unwrap();
        let modal = modal(&setup.responses).unwrap();
        let port = actuator(modal, ACTUATOR).unwrap();
        let Responses::Modal(alone) = driven_at(modal, port) else { unreachable!() };
        assert_eq!(alone.input.ncols(), modal.poles.len());
        for mode in 0..modal.poles.len() {
            let (found, expected) = (alone.input[(0, mode)], modal.input[(ACTUATOR, mode)]);
            assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0));
        }
        assert!(actuator(modal, modal.ports.len()).is_err());
    }
}
