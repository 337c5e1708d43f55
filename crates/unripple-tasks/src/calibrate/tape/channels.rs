//! The channels that recordings made elsewhere have, and how many there may be.

use crate::TaskError;
use crate::calibrate::ask::{Ask, By};
use unripple::core::{FORCE, Layout, PROBE, Surface};

/// Samples of a block. Nothing waits for a block here, so that it only determines the silence at the
/// beginning.
const BLOCK: usize = 256;

/// Largest number of recordings, all repeats of all points together: nobody makes more by hand. With twice
/// this value, a plan takes 20 MB.
const MOST_RECORDINGS: usize = 100_000;

/// Returns an error for more recordings than anybody makes.
pub fn few(points: usize, repeats: usize) -> Result<(), TaskError> {
    let found = points.saturating_mul(repeats);
    if found <= MOST_RECORDINGS {
        return Ok(());
    }
    Err(TaskError::Input(format!(
        "`tape`: expected at most {MOST_RECORDINGS} recordings, found {found} ({points} points times {repeats} `repeats`)"
    )))
}

/// The channels, sample rate and full scale that recordings are to have.
pub fn layout(ask: &Ask, surface: &Surface, full_scale: f64) -> Result<Layout, TaskError> {
    let names: Vec<String> = surface.actuators.iter().map(|actuator| actuator.name.clone()).collect();
    let inputs = match &ask.device.tape_inputs[..] {
        [] => {
            let last = match ask.by {
                By::Probe => Some(PROBE),
                By::Hammer => Some(FORCE),
                By::Tap => None,
            };
            names.iter().cloned().chain(last.map(str::to_owned)).collect()
        }
        given => given.to_vec(),
    };
    if let Some(twice) = inputs.iter().enumerate().find(|(i, name)| inputs[..*i].contains(name)) {
        return Err(TaskError::Input(format!(
            "`tape_inputs`: expected each name once, found `{}` twice",
            twice.1
        )));
    }
    Ok(Layout {
        device: "tape".into(),
        rate: surface.emission.rate,
        block: BLOCK,
        outputs: names,
        inputs,
        full_scale,
    })
}
