//! The note on what the closed forms of a design ignore on a surface: masses, coils, housings, patches and
//! contacts of its actuators, an uneven sheet.

use super::Note;
use super::digits::rounded;
use super::ground::Ground;
use unripple_core::{Actuator, ActuatorKind, CoilDrive, Surface, VoiceCoil};

/// The note on what the closed forms ignore, and on which figures do include it; `None` for ideal forces at
/// points of a uniform sheet, where nothing is ignored.
pub(super) fn left_out(ground: &Ground<'_>) -> Option<Note> {
    let surface = ground.surface;
    let parts = [
        masses(surface),
        coils(surface),
        housings(surface),
        patches(surface),
        contacts(surface),
        resonators(surface),
        uneven(surface),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    if parts.is_empty() {
        return None;
    }
    let parts = parts.join(", ");
    let ideal = "those of ideal forces at points of a uniform sheet, without";
    let text = match ground.loaded_contrast {
        Some(_) => format!(
            "modes and decay time of the sheet alone and the plain form are {ideal} {parts}; the window and all other contrasts are \
             computed with all of that"
        ),
        None => format!(
            "modes, decay time and contrasts are {ideal} {parts}; the window, computed from statistics here, leaves it out as well"
        ),
    };
    Some(Note { topic: "left out".into(), text })
}

/// Text on the masses that move with the sheet at its actuators.
fn masses(surface: &Surface) -> Option<String> {
    let mass = |actuator: &Actuator| match (actuator.kind, actuator.kind.coil()) {
        (ActuatorKind::Piezo { mass, .. }, _) => mass,
        (_, coil) => coil.map_or(0.0, |coil| coil.moving_mass),
    };
    let found = all(surface, mass);
    (!found.is_empty()).then(|| format!("moving masses of {} mg ({})", range(&found, 1e6), actuators(&found)))
}

/// Text on the damping and inductance of coils driven by a voltage; they have no effect with a current
/// source.
fn coils(surface: &Surface) -> Option<String> {
    let held = |actuator: &Actuator| actuator.kind.coil().filter(|coil| coil.driven_by == CoilDrive::Voltage);
    let of_coil = |coil: VoiceCoil| coil.force_constant * coil.force_constant / coil.resistance;
    let damping = all(surface, |actuator| held(actuator).map_or(0.0, of_coil));
    let inductance = all(surface, |actuator| held(actuator).map_or(0.0, |coil| coil.inductance));
    if damping.is_empty() {
        return None;
    }
    let mut text = format!("the damping (bl)²/R = {} N·s/m", range(&damping, 1.0));
    if !inductance.is_empty() {
        text += &format!(" and the inductance of {} mH", range(&inductance, 1e3));
    }
    Some(format!("{text} of coils driven by a voltage ({})", actuators(&damping)))
}

/// Text on the housings of exciters, whose resonance and mass the closed forms ignore.
fn housings(surface: &Surface) -> Option<String> {
    let found = all(surface, |actuator| match actuator.kind {
        ActuatorKind::Exciter { resonance, .. } => resonance,
        _ => 0.0,
    });
    (!found.is_empty()).then(|| {
        format!("housings on springs that resonate at {} Hz ({})", range(&found, 1.0), actuators(&found))
    })
}

/// Text on patches, which bend the sheet instead of pushing it.
fn patches(surface: &Surface) -> Option<String> {
    let found =
        all(surface, |actuator| f64::from(u8::from(matches!(actuator.kind, ActuatorKind::Piezo { .. }))));
    (!found.is_empty()).then(|| format!("piezo patches, which act by moments ({})", actuators(&found)))
}

/// Text on the discs over which forces are spread, so that short waves are driven less.
fn contacts(surface: &Surface) -> Option<String> {
    let radius = |actuator: &Actuator| match actuator.kind {
        ActuatorKind::Force | ActuatorKind::MovingMagnet { .. } | ActuatorKind::Exciter { .. } => {
            actuator.contact_radius
        }
        ActuatorKind::Piezo { .. } => 0.0,
    };
    let found = all(surface, radius);
    (!found.is_empty())
        .then(|| format!("contact discs of {} mm radius ({})", range(&found, 1e3), actuators(&found)))
}

/// Text on the resonators on the sheet.
fn resonators(surface: &Surface) -> Option<String> {
    let found = surface.resonators();
    let mass = found.iter().map(|resonator| resonator.mass).sum::<f64>() * 1e3;
    (!found.is_empty()).then(|| format!("resonators of {} g in all ({})", rounded(mass, 3), found.len()))
}

/// Text on what makes the sheet uneven.
fn uneven(surface: &Surface) -> Option<String> {
    let even = surface.sheet.uneven.is_uniform();
    (!even).then(|| {
        "the grain of the sheet, its profiles and what is fixed to it (which the number of modes, where counted, includes)"
            .into()
    })
}

/// The values of a property for all actuators for which it is positive.
fn all(surface: &Surface, of: impl Fn(&Actuator) -> f64) -> Vec<f64> {
    surface.actuators.iter().map(of).filter(|value| *value > 0.0).collect()
}

/// Text for a number of actuators: how many values there are.
fn actuators(values: &[f64]) -> String {
    if values.len() == 1 { "1 actuator".into() } else { format!("{} actuators", values.len()) }
}

/// Text for values times `unit`, with three digits: the single value, or the least and the greatest.
fn range(values: &[f64], unit: f64) -> String {
    let ends = (f64::INFINITY, 0.0);
    let (low, high) = values.iter().fold(ends, |(l, h): (f64, f64), value| (l.min(*value), h.max(*value)));
    let [low, high] = [low, high].map(|value| rounded(unit * value, 3));
    if low == high { low.to_string() } else { format!("{low} to {high}") }
}
