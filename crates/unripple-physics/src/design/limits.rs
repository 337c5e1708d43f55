//! Limits of the model on a surface: how thick the sheet is for thin-plate theory, which contacts are wide for its shortest waves, and
//! radiation of sound that is left out.

use super::Note;
use super::digits::rounded;
use crate::Medium;
use std::f64::consts::TAU;
use unripple_core::{Actuator, ActuatorKind, Air, Patch, Sheet, Surface};
use unripple_plates::{AIR_CELERITY, decay_rate};

/// Ratio of thickness to shortest wavelength above which a note states the error of thin-plate theory: at
/// this ratio, its frequencies are 2 % too high. With twice this value, errors up to 7 % would not be
/// noted.
const THICK: f64 = 0.05;

/// Ratio of thickness to shortest wavelength above which thin-plate theory should not be relied on: at this
/// ratio, its frequencies are 7 % too high.
const TOO_THICK: f64 = 0.1;

/// Shear correction factor of a plate of one material: the parabolic profile of shear stress over the thickness (Reissner 1945).
const SHEAR: f64 = 5.0 / 6.0;

/// Ratio of width to shortest wavelength above which a contact counts as wide: parts of it then move in
/// opposition.
const WIDE: f64 = 0.5;

/// Notes on where the model reaches its limits on a surface; none where it holds.
///
/// Thin-plate (Kirchhoff) theory neglects shear and rotary inertia; a note gives its error at the top of the band by Mindlin's theory
/// (*J. Appl. Mech.* 18, 31, 1951) where the sheet is thicker than a twentieth of the shortest wavelength. Another names the patches and
/// contacts that are wider than half of that wavelength, a third the radiation of sound where air is left out.
///
/// ```
/// use unripple_physics::design::{limits, papers_surface};
///
/// assert!(limits(&papers_surface()).is_empty());
/// let mut thick = papers_surface();
/// thick.sheet.thickness = 6e-3;
/// assert!(limits(&thick)[0].text.contains("Mindlin"));
/// ```
pub fn limits(surface: &Surface) -> Vec<Note> {
    [thick(surface), wide(surface), silent(surface)].into_iter().flatten().collect()
}

/// For a wave of wavenumber `k` (rad/m) in a sheet of one material, without air: the ratio of its frequency
/// by thin-plate (Kirchhoff) theory to its frequency by Mindlin's theory, which includes shear and rotary
/// inertia. It is 1 for a sheet without thickness.
///
/// Mindlin's frequency is the lower root of the dispersion relation for deflection and rotation,
/// (κGhk² + Tk² - ρhω²)(Dk² + κGh - ρh³ω²/12) = (κGhk)², with κ = 5/6.
///
/// ```
/// # use unripple_physics::design::{kirchhoff_over_mindlin, papers_surface};
/// let sheet = papers_surface().sheet;
/// assert!((kirchhoff_over_mindlin(&sheet, 430.0) - 1.0).abs() < 1e-3);
/// ```
pub fn kirchhoff_over_mindlin(sheet: &Sheet, k: f64) -> f64 {
    let Sheet { young, density, poisson, thickness: h, tension, .. } = *sheet;
    if !(h > 0.0 && young > 0.0 && k > 0.0) {
        return 1.0;
    }
    let bending = young * h.powi(3) / (12.0 * (1.0 - poisson * poisson));
    let shear = SHEAR * young / (2.0 * (1.0 + poisson)) * h;
    let (mass, rotary) = (density * h, density * h.powi(3) / 12.0);
    let (square, held) = (k * k, bending * k * k + shear);
    let thin = (bending * square + tension) * square / mass;
    // mass·rotary ω⁴ - b ω² + c = 0; the lower root, without cancellation.
    let b = mass * held + rotary * (shear + tension) * square;
    // (shear + tension)·held - shear² with what cancels left out.
    let c = square * (shear * bending * square + tension * held);
    let lower = 2.0 * c / (b + (b * b - 4.0 * mass * rotary * c).max(0.0).sqrt());
    (thin / lower).sqrt()
}

/// A note on a sheet that is thick for its shortest wavelength.
fn thick(surface: &Surface) -> Option<Note> {
    let top = surface.emission.band[1];
    let k = Medium::of(&surface.sheet).wavenumber(TAU * top);
    let share = surface.sheet.thickness * k / TAU;
    if share <= THICK {
        return None;
    }
    let over = 100.0 * (kirchhoff_over_mindlin(&surface.sheet, k) - 1.0);
    let mut text = format!(
        "at {top} Hz the sheet is {} of a wavelength thick: thin-plate (Kirchhoff) theory, by which everything here is computed, gives \
         frequencies {} % above those of Mindlin's theory with shear and rotary inertia",
        rounded(share, 2),
        rounded(over, 2)
    );
    if share > TOO_THICK {
        text += "; near the top of the band, modes and responses are not to be relied on";
    }
    Some(Note { topic: "thick sheet".into(), text })
}

/// A note on patches and contacts that are wide for the shortest wavelength.
fn wide(surface: &Surface) -> Option<Note> {
    let lambda = Medium::of(&surface.sheet).lambda_min(surface.emission.band[1]);
    let found: Vec<(&Actuator, f64)> =
        surface.actuators.iter().map(|a| (a, width(a))).filter(|(_, width)| *width > WIDE * lambda).collect();
    let (first, _) = found.first()?;
    let widest = found.iter().map(|(_, width)| *width).fold(0.0, f64::max);
    let who = match found.len() {
        1 => format!("{} is", first.name),
        more => format!("{} and {} more are", first.name, more - 1),
    };
    Some(Note {
        topic: "wide contacts".into(),
        text: format!(
            "{who} up to {} mm wide, more than half of the shortest wavelength of {} mm: parts of such an area move in opposition. Forces, \
             masses and moments are integrated over the area, as that of a contact that does not stiffen the sheet",
            rounded(1e3 * widest, 3),
            rounded(1e3 * lambda, 3)
        ),
    })
}

/// A note on a sheet without air in a band where it would radiate sound: its waves are faster than sound there.
fn silent(surface: &Surface) -> Option<Note> {
    let (sheet, top) = (&surface.sheet, surface.emission.band[1]);
    let medium = Medium::of(sheet);
    let k = medium.wavenumber(TAU * top);
    if sheet.air != Air::None || medium.phase_celerity(k) <= AIR_CELERITY {
        return None;
    }
    let ms = |rate: f64| rounded(1e3 / rate, 2);
    let radiated = |air: Air| ms(medium.with_air(air).radiation(k));
    let from = match medium.coincidence_hz() {
        Some(hz) => format!("above {hz:.0} Hz"),
        None => "at every frequency".into(),
    };
    Some(Note {
        topic: "radiation".into(),
        text: format!(
            "`air` is \"none\", though {from} waves on the sheet are faster than sound in air and radiate sound: the amplitude of waves of \
             {top} Hz would fall to 1/e by radiation alone in {} ms with air on one side, in {} ms on both, and does by the damping of the \
             sheet in {} ms. Nothing computed here includes radiation; with `air` \"one-side\" or \"both-sides\" all of it does",
            radiated(Air::OneSide),
            radiated(Air::BothSides),
            ms(decay_rate(&sheet.decay, TAU * top, medium.bending_share(k)))
        ),
    })
}

/// The largest width of an actuator's patch or contact disc, in metres.
fn width(actuator: &Actuator) -> f64 {
    match actuator.kind {
        ActuatorKind::Piezo { patch: Patch::Round { radius }, .. } => 2.0 * radius,
        ActuatorKind::Piezo { patch: Patch::Rectangular { sides: [a, b], .. }, .. } => a.max(b),
        ActuatorKind::Force | ActuatorKind::MovingMagnet { .. } | ActuatorKind::Exciter { .. } => {
            2.0 * actuator.contact_radius
        }
    }
}
