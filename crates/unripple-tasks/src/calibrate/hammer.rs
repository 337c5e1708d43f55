//! Measurement by a hammer with a force sensor: the session, with the scales of its inputs.

use super::campaign::Campaign;
use super::filler::LibraryFiller;
use crate::TaskError;
use unripple::core::{FORCE, Layout};
use unripple_calibrate::measure::{HammerSession, MeasureOptions, Wires};

/// Prepares a session of blows, whose force has the scale of the request, as the sensors' signals have those of the library.
pub(super) fn session(
    known: &Campaign<'_>,
    filler: &LibraryFiller,
    layout: &Layout,
    wires: &Wires,
    settings: &MeasureOptions,
) -> Result<HammerSession, TaskError> {
    let newtons = known.scales.input(FORCE);
    let session = HammerSession::new(known.surface, layout, wires, newtons, settings)?;
    Ok(session.by_scales(filler.sensors.clone()))
}
