//! Mechanical power that the actuators give to the sheet.

use super::ActError;
use crate::core::Surface;
use crate::field::Field;
use crate::physics::{Transducer, transducers};

/// Mean mechanical power (W) that the actuators of a surface give to the sheet over the last `seconds` of
/// the field's drive: force times velocity under each actuator, summed. Power that fingers absorb
/// comes from the sheet and is not subtracted; masses of actuators absorb none.
///
/// `None` for sampled responses, whose motion under the actuators is not known; and where an actuator is a coil on a voltage or an exciter.
/// Their force depends on the velocity under them, of which the modes of an evaluation have only a part: modes far above yield at the contact
/// as well, by as much as those of the band or more, which no product of a given force and velocity notices.
///
/// # Errors
/// Those of [`transducers`].
pub fn power(surface: &Surface, field: &Field<'_>, seconds: f64) -> Result<Option<f64>, ActError> {
    let (transducers, drive) = (transducers(surface)?, field.drive());
    let yields =
        |t: &Transducer| t.load.as_ref().is_some_and(|load| load.circuit.is_some() || load.housing.is_some());
    if transducers.iter().any(yields) {
        return Ok(None);
    }
    let contacts: Vec<_> = transducers.iter().map(|t| t.footprint.points.as_slice()).collect();
    let Some(velocities) = field.under(&contacts) else { return Ok(None) };
    let samples = ((seconds * drive.rate()).round() as usize).min(drive.samples());
    let first = drive.samples() - samples;
    let work = |((transducer, channel), velocity): ((&Transducer, &Vec<f64>), &Vec<f64>)| {
        transducer.gain * channel[first..].iter().zip(&velocity[first..]).map(|(d, v)| d * v).sum::<f64>()
    };
    let each = transducers.iter().zip(drive.channels()).zip(&velocities).map(work);
    Ok(Some(each.sum::<f64>() / samples.max(1) as f64))
}
