//! Checks of the device, its wires and its clock.

use super::check::Check;
use crate::calibrate::{People, nobody, open};
use crate::{DeviceAsk, DeviceKind, TaskError};
use std::sync::Arc;
use unripple::core::{Device, Layout, ModalResponses, Point, Responses, State, Status, Surface};
use unripple_devices::{Expected, WiringOptions, check_wiring};
use unripple_live::real_time;

/// Opens the device, and checks its sample rate, the wiring of each actuator and sensor, and lost blocks.
pub fn checks(
    options: &DeviceAsk,
    surface: &Surface,
    model: &Arc<Responses>,
) -> Result<Vec<Check>, TaskError> {
    let mut opened = match open(options, surface, People { hands: nobody(), probe: true, hammer: false }) {
        Ok(opened) => opened,
        Err(error) => {
            let fix = match options.device {
                DeviceKind::Virtual => "correct the surface file",
                _ => {
                    "start the sound server, or try --device virtual; `unripple devices` lists what there is"
                }
            };
            return Ok(vec![Check::failed("device", error.to_string(), fix)]);
        }
    };
    let layout = opened.rig.device().layout().clone();
    let mut checks = vec![Check::good("device", told(&layout))];
    if layout.rate != surface.emission.rate {
        let found =
            format!("the device runs at {} Hz, the surface file says {}", layout.rate, surface.emission.rate);
        checks.push(Check::failed("rate", found, "set `sample_rate_hz` and the device to the same"));
        return Ok(checks);
    }
    if let Responses::Modal(modal) = model.as_ref() {
        checks.push(wiring(opened.rig.device(), surface, modal));
        checks.push(blocks(&opened.rig.device().status()));
    }
    Ok(checks)
}

fn told(layout: &Layout) -> String {
    format!(
        "{}: {} outputs, {} inputs, {} Hz, blocks of {} ({:.2} ms)",
        layout.device,
        layout.outputs.len(),
        layout.inputs.len(),
        layout.rate,
        layout.block,
        1e3 * layout.block as f64 / layout.rate
    )
}

fn wiring(device: &mut dyn Device, surface: &Surface, modal: &ModalResponses) -> Check {
    let (inputs, outputs) = (device.layout().inputs.len(), device.layout().outputs.len());
    if inputs < outputs || outputs != modal.ports.len() {
        return Check::skipped("wiring", "the device has no sensor for each actuator");
    }
    let trial = WiringOptions::for_surface(surface);
    let (width, height) = surface.outline.extent();
    let probe = (inputs > outputs).then_some(Point::new(width / 2.0, height / 2.0));
    let found = Expected::of(surface, modal, probe, trial.listen)
        .and_then(|expected| check_wiring(device, &expected, &trial));
    match found {
        Ok(found) if found.faults().is_empty() => {
            Check::good("wiring", format!("each of {outputs} actuators reaches the sensors that it should"))
        }
        Ok(found) => Check::failed("wiring", found.summary().join("; "), "correct the wires named here"),
        Err(error) => Check::failed("wiring", error.to_string(), "check whether the device still runs"),
    }
}

fn blocks(status: &Status) -> Check {
    match (&status.state, status.lost) {
        (State::Running, 0) => Check::good("blocks", format!("{} blocks passed, none lost", status.blocks)),
        (State::Running, lost) => Check::doubtful(
            "blocks",
            format!("{lost} of {} blocks were lost", status.blocks),
            "longer blocks, fewer programs, or real-time priority",
        ),
        (state, _) => Check::failed("blocks", state.to_string(), "check whether the device still runs"),
    }
}

/// Checks whether the audio thread would get real-time priority.
pub fn priority() -> Check {
    match real_time() {
        Ok(granted) => Check::good("priority", granted),
        Err(refused) => Check::doubtful(
            "priority",
            refused,
            "allow real-time priority to your user, or expect blocks to be lost on a busy machine",
        ),
    }
}
