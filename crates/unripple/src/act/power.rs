//! Mechanical power that the actuators give to the sheet.

use super::ActError;
use crate::core::Surface;
use crate::field::Field;
use crate::physics::{Transducer, transducers};

/// Mean mechanical power (W) that the actuators of a surface give to the sheet over the last `seconds` of the field's drive: force times
/// velocity under each actuator, summed. `None` for sampled responses, whose motion under the actuators is not known.
///
/// What is on the sheet counts as the sheet: the masses of actuators, which keep nothing of it, and fingers. A coil on a voltage and the
/// housing of an exciter take back what the motion of the sheet makes them take; that is subtracted.
///
/// # Errors
/// Those of [`transducers`].
pub fn power(surface: &Surface, field: &Field<'_>, seconds: f64) -> Result<Option<f64>, ActError> {
    let (transducers, drive) = (transducers(surface)?, field.drive());
    let contacts: Vec<_> = transducers.iter().map(|t| t.footprint.points.as_slice()).collect();
    let Some(velocities) = field.under(&contacts) else { return Ok(None) };
    let samples = ((seconds * drive.rate()).round() as usize).min(drive.samples());
    let first = drive.samples() - samples;
    let work = |((transducer, channel), velocity): ((&Transducer, &Vec<f64>), &Vec<f64>)| {
        let forces = transducer.forces(channel, velocity, drive.rate());
        forces[first..].iter().zip(&velocity[first..]).map(|(f, v)| f * v).sum::<f64>()
    };
    let each = transducers.iter().zip(drive.channels()).zip(&velocities).map(work);
    Ok(Some(each.sum::<f64>() / samples.max(1) as f64))
}
