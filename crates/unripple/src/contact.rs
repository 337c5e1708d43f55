//! Motion of a finger that rests on a surface, and the power that it absorbs from the field.

use serde::Serialize;
use unripple_core::{Contact, Outline};
use unripple_field::{Field, FieldError, Trace};
use unripple_physics::Footprint;

/// Motion of a finger that rests on a surface under a drive, with force, power and energy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Touch {
    /// Centre of the contact, in metres.
    pub at_m: [f64; 2],
    /// Largest magnitude of the velocity averaged over the contact disc, in m/s.
    pub peak_velocity_m_s: f64,
    /// Largest magnitude of the displacement averaged over the contact disc, in metres.
    pub peak_displacement_m: f64,
    /// Largest magnitude of the force on the finger, μv̇ + βv + κu, in N, with the finger's mass μ, damping
    /// β and stiffness κ.
    pub peak_force_n: f64,
    /// Largest power into the finger, force times velocity, in W.
    pub peak_power_w: f64,
    /// Energy that the damping of the finger absorbs, ∫βv²dt, in J.
    pub energy_j: f64,
}

/// Motion of the finger of `contact` in a field, from the drive's first sample up to `until` (s). The field must be of
/// responses computed with this finger on the surface (`ResponseOptions::contacts`); otherwise the result is for a
/// finger that does not change the motion.
///
/// # Errors
/// Those of [`Field::traces`].
///
/// ```
/// use unripple::core::{Contact, Drive, Finger, Point};
/// use unripple::field::Field;
/// use unripple::physics::{ResponseOptions, design::papers_surface, responses};
///
/// let film = papers_surface();
/// let contact = Contact { at: Point::from_mm(62.0, 90.0), finger: Finger::default() };
/// let loaded = responses(&film, &ResponseOptions { contacts: vec![contact], ..ResponseOptions::default() })?;
/// let names = film.actuators.iter().map(|a| a.name.clone()).collect();
/// let drive = Drive::new(48e3, names, vec![vec![1.0; 480]; 8])?;
/// let felt = unripple::touch(&Field::new(&loaded, &drive, 1.0)?, &contact, &film.outline, 0.02)?;
/// assert!(felt.energy_j > 0.0 && felt.peak_power_w > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn touch(field: &Field, contact: &Contact, outline: &Outline, until: f64) -> Result<Touch, FieldError> {
    let footprint = Footprint::disc(contact.at, contact.finger.contact_radius, outline);
    let places: Vec<_> = footprint.points.iter().map(|(place, _)| *place).collect();
    let traces = field.traces(&places, until)?;
    let mean = |of: fn(&Trace) -> &[f64]| {
        let samples = traces.first().map_or(0, |trace| of(trace).len());
        let at = |i: usize| footprint.points.iter().zip(&traces).map(|((_, w), t)| w * of(t)[i]).sum::<f64>();
        (0..samples).map(at).collect::<Vec<f64>>()
    };
    let (velocity, displacement) = (mean(|t| &t.velocity), mean(|t| &t.displacement));
    let finger = &contact.finger;
    let force = |i: usize| {
        finger.mass * slope(&velocity, i) * field.rate()
            + finger.damping * velocity[i]
            + finger.stiffness * displacement[i]
    };
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |m: f64, v| m.max(v.abs()));
    let power = (0..velocity.len()).map(|i| force(i) * velocity[i]);
    Ok(Touch {
        at_m: [contact.at.x, contact.at.y],
        peak_velocity_m_s: largest(&mut velocity.iter().copied()),
        peak_displacement_m: largest(&mut displacement.iter().copied()),
        peak_force_n: largest(&mut (0..velocity.len()).map(force)),
        peak_power_w: power.fold(0.0, f64::max),
        energy_j: finger.damping * velocity.iter().map(|v| v * v).sum::<f64>() / field.rate(),
    })
}

/// The derivative per sample, fourth order; at both ends what is beyond counts as at rest.
fn slope(values: &[f64], i: usize) -> f64 {
    let at = |offset: isize| i.checked_add_signed(offset).and_then(|j| values.get(j)).copied().unwrap_or(0.0);
    (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / 12.0
}
