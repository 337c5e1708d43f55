//! A surface written as a file.

mod rim;

use super::actuator::COIL_DRIVES;
use super::range::of;
use super::sheet::AIRS;
use crate::decimal::text;
use crate::degrees;
use crate::lines::{Lines, list, named, point, quoted};
use unripple_core::{
    Actuator, ActuatorKind, CoilDrive, Decay, Emission, Finger, Lattice, Patch, Profile, Resonator,
    Scatterer, ScattererKind, Sheet, Surface, Uneven,
};

/// Writes a surface as the text of a file in format 1. [`crate::parse_surface`] turns the text back into the
/// same surface, bit for bit, provided the values are within the format's limits.
///
/// ```
/// let film = unripple_store::load_surface("hudin-2012")?;
/// let text = unripple_store::to_toml(&film);
/// assert_eq!(unripple_store::parse_surface(&text, "copy.toml")?, film);
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
pub fn to_toml(surface: &Surface) -> String {
    let mut out = Lines::default();
    out.line("format", "1");
    out.line("name", &quoted(&surface.name));
    if let Some(accuracy) = surface.accuracy {
        out.line("accuracy", &text(accuracy, 0));
    }
    rim::outline(&surface.outline, &mut out);
    surface.outline.holes.iter().for_each(|hole| rim::hole(hole, &mut out));
    sheet(&surface.sheet, &mut out);
    surface.sheet.uneven.scatterers.iter().for_each(|s| scatterer(s, &mut out));
    surface.sheet.uneven.resonators.iter().for_each(|r| resonator(r, &mut out));
    surface.sheet.uneven.lattices.iter().for_each(|l| lattice(l, &mut out));
    emission(&surface.emission, &mut out);
    finger(&surface.finger, &mut out);
    surface.actuators.iter().for_each(|a| actuator(a, &mut out));
    out.into_text()
}

fn emission(emission: &Emission, out: &mut Lines) {
    out.table("[drive]");
    out.line("band_hz", &format!("[{}, {}]", text(emission.band[0], 0), text(emission.band[1], 0)));
    out.line("sample_rate_hz", &text(emission.rate, 0));
    out.line("limit", &text(emission.limit, 0));
    if let Some(limit) = emission.rms_limit {
        out.line("rms_limit", &text(limit, 0));
    }
}

fn finger(finger: &Finger, out: &mut Lines) {
    out.table("[finger]");
    out.line("mass_g", &text(finger.mass, 3));
    out.line("damping_n_s_per_m", &text(finger.damping, 0));
    out.line("stiffness_n_per_mm", &text(finger.stiffness, -3));
    out.line("contact_radius_mm", &text(finger.contact_radius, 3));
}

fn sheet(sheet: &Sheet, out: &mut Lines) {
    out.table("[sheet]");
    out.line("material", &quoted(&sheet.material));
    out.line("young_gpa", &text(sheet.young, -9));
    out.line("density_kg_m3", &text(sheet.density, 0));
    out.line("poisson_ratio", &text(sheet.poisson, 0));
    if let Some(strength) = sheet.strength {
        out.line("strength_mpa", &text(strength, -6));
    }
    if let Some(grain) = &sheet.uneven.grain {
        out.line("young_across_gpa", &text(grain.young_across, -9));
        out.line("shear_gpa", &text(grain.shear, -9));
        out.line("grain_deg", &of::DIRECTION.text(grain.direction));
    }
    out.line("thickness_mm", &text(sheet.thickness, 3));
    out.line("tension_n_per_m", &text(sheet.tension, 0));
    match &sheet.decay {
        Decay::Time(time) => out.line("decay_time_ms", &text(*time, 3)),
        Decay::Table(rows) => {
            let row = |(hz, s): &(f64, f64)| format!("[{}, {}]", text(*hz, 0), text(*s, 3));
            out.line("decay_time_ms", &list(rows.iter().map(row)));
        }
        Decay::LossFactor(factor) => out.line("loss_factor", &text(*factor, 0)),
    }
    out.line("air", &named(&AIRS, &sheet.air));
    profiles(&sheet.uneven, out);
}

fn profiles(uneven: &Uneven, out: &mut Lines) {
    let rows =
        |profile: &Profile| list(profile.rows().map(|row| list(row.iter().map(|value| text(*value, 0)))));
    let profiles = [
        ("thickness_profile", &uneven.thickness),
        ("tension_profile", &uneven.tension),
        ("added_mass_kg_m2", &uneven.added_mass),
    ];
    for (key, profile) in profiles {
        if let Some(profile) = profile {
            out.line(key, &rows(profile));
        }
    }
}

fn scatterer(scatterer: &Scatterer, out: &mut Lines) {
    out.table("[[scatterer]]");
    out.line("at_mm", &point(&scatterer.at));
    match &scatterer.kind {
        ScattererKind::Mass(mass) => {
            out.line("kind", "\"mass\"");
            out.line("mass_mg", &text(*mass, 6));
        }
        ScattererKind::Disc { radius, thickness, young, density, poisson } => {
            out.line("kind", "\"disc\"");
            out.line("radius_mm", &text(*radius, 3));
            out.line("thickness_mm", &text(*thickness, 3));
            out.line("young_gpa", &text(*young, -9));
            out.line("density_kg_m3", &text(*density, 0));
            out.line("poisson_ratio", &text(*poisson, 0));
        }
    }
}

fn resonator(resonator: &Resonator, out: &mut Lines) {
    out.table("[[scatterer]]");
    out.line("at_mm", &point(&resonator.at));
    out.line("kind", "\"resonator\"");
    tuned([resonator.mass, resonator.frequency, resonator.quality_factor], out);
}

fn lattice(lattice: &Lattice, out: &mut Lines) {
    out.table("[[lattice]]");
    out.line("from_mm", &point(&lattice.corners[0]));
    out.line("to_mm", &point(&lattice.corners[1]));
    out.line("columns", &lattice.cells[0].to_string());
    out.line("rows", &lattice.cells[1].to_string());
    tuned([lattice.mass, lattice.frequency, lattice.quality_factor], out);
    out.line("scatter_percent", &text(lattice.scatter, 2));
    out.line("seed", &lattice.seed.to_string());
}

/// Mass (kg), frequency (Hz) and quality factor of resonators.
fn tuned([mass, frequency, quality_factor]: [f64; 3], out: &mut Lines) {
    out.line("mass_g", &text(mass, 3));
    out.line("frequency_hz", &text(frequency, 0));
    out.line("quality_factor", &text(quality_factor, 0));
}

fn actuator(actuator: &Actuator, out: &mut Lines) {
    out.table("[[actuator]]");
    out.line("name", &quoted(&actuator.name));
    out.line("at_mm", &point(&actuator.at));
    out.line("kind", &quoted(actuator.kind.name()));
    if actuator.contact_radius != 0.0 {
        out.line("contact_radius_mm", &text(actuator.contact_radius, 3));
    }
    match &actuator.kind {
        ActuatorKind::Force => {}
        ActuatorKind::MovingMagnet { force_constant, resistance, inductance, moving_mass, driven_by } => {
            coil([force_constant, resistance, inductance, moving_mass], driven_by, out);
        }
        ActuatorKind::Exciter {
            force_constant,
            resistance,
            inductance,
            moving_mass,
            housing_mass,
            resonance,
            quality_factor,
            driven_by,
        } => {
            coil([force_constant, resistance, inductance, moving_mass], driven_by, out);
            out.line("housing_g", &text(*housing_mass, 3));
            out.line("resonance_hz", &text(*resonance, 0));
            out.line("quality_factor", &text(*quality_factor, 0));
        }
        ActuatorKind::Piezo { patch, moment, mass } => {
            match patch {
                Patch::Round { radius } => out.line("radius_mm", &text(*radius, 3)),
                Patch::Rectangular { sides: [width, height], angle } => {
                    out.line("rectangle_mm", &format!("[{}, {}]", text(*width, 3), text(*height, 3)));
                    if *angle != 0.0 {
                        out.line("angle_deg", &degrees::text(*angle));
                    }
                }
            }
            out.line("moment_n_per_v", &text(*moment, 0));
            out.line("patch_mass_mg", &text(*mass, 6));
        }
    }
}

fn coil(
    [force_constant, resistance, inductance, moving_mass]: [&f64; 4],
    driven_by: &CoilDrive,
    out: &mut Lines,
) {
    out.line("force_constant_n_per_a", &text(*force_constant, 0));
    out.line("resistance_ohm", &text(*resistance, 0));
    out.line("inductance_mh", &text(*inductance, 3));
    out.line("moving_mass_mg", &text(*moving_mass, 6));
    out.line("driven_by", &named(&COIL_DRIVES, driven_by));
}
