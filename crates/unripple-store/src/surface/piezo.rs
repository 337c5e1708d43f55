//! Piezoelectric patches in a surface file.

use super::range::of;
use super::reader::{Entry, Faults, Section};
use std::f64::consts::PI;
use unripple_core::{ActuatorKind, Outline, Point};

/// All keys that a piezo patch may have.
pub(super) const PIEZO_KEYS: [&str; 7] = [
    "radius_mm",
    "moment_n_per_v",
    "d31_pm_per_v",
    "patch_young_gpa",
    "patch_thickness_mm",
    "patch_mass_mg",
    "patch_density_kg_m3",
];
/// Keys that together give the moment of a patch, in place of `moment_n_per_v`.
const PATCH_KEYS: [&str; 3] = ["d31_pm_per_v", "patch_young_gpa", "patch_thickness_mm"];
/// Poisson's ratio of a patch, near that of the PZT ceramics (0.3 to 0.34); the moment grows as 1 / (1 - ν), by 6 %
/// from 0.3 to 0.34.
const PATCH_POISSON: f64 = 0.3;

/// The sheet where a piezo patch is, as far as the file is without fault.
pub(super) struct Spot<'a> {
    /// Thickness there, in metres.
    pub thickness: Option<f64>,
    /// The outline, and where on it the patch is.
    pub place: Option<(&'a Outline, Point)>,
}

/// Reads a piezo patch, with all its keys.
pub(super) fn read(section: &Section, spot: &Spot<'_>, faults: &mut Faults) -> Option<ActuatorKind> {
    let radius = section.number(PIEZO_KEYS[0], &of::PATCH_RADIUS, faults);
    let fits = radius.is_none() || within(section, radius, spot.place, faults);
    let patch_thickness = match section.get("patch_thickness_mm") {
        Some(entry) => entry.number(&of::PATCH_THICKNESS, faults).map(Some),
        None => Some(None),
    };
    let moment = moment(section, spot.thickness, patch_thickness, faults);
    let mass = mass(section, radius, patch_thickness, faults);
    fits.then_some(ActuatorKind::Piezo { radius: radius?, moment: moment?, mass: mass? })
}

/// Whether a patch keeps within the rims, or a fault: its moment acts along the whole of its own rim.
fn within(
    section: &Section,
    radius: Option<f64>,
    place: Option<(&Outline, Point)>,
    faults: &mut Faults,
) -> bool {
    let (Some(radius), Some((outline, at))) = (radius, place) else { return true };
    if outline.holds_disc(at, radius) {
        return true;
    }
    let Some(entry) = section.get(PIEZO_KEYS[0]) else { return false };
    let most = (outline.to_rim(at) * 1e7).floor() / 1e4;
    let found = format!("{} mm, which reaches beyond the rim", radius * 1e3);
    let near = (most >= of::PATCH_RADIUS.least).then(|| most.to_string());
    faults.add(
        &entry.key,
        entry.span,
        found,
        format!("at most {most} mm, the distance from the nearest rim"),
        near,
    );
    false
}

/// Moment per length of rim and volt.
///
/// A thin patch that may not stretch presses with the stress E d31 V / (1 - ν) / t_p over its thickness t_p in both
/// directions, at (h + t_p) / 2 from the middle of the sheet (E. F. Crawley and J. de Luis, AIAA Journal 25, 1987; C. R.
/// Fuller, S. J. Elliott and P. A. Nelson, Active Control of Vibration, 1996): d31 E (h + t_p) / 2 / (1 - ν) per volt.
fn moment(
    section: &Section,
    thickness: Option<f64>,
    patch_thickness: Option<Option<f64>>,
    faults: &mut Faults,
) -> Option<f64> {
    let given = section.get("moment_n_per_v");
    let patch: Vec<Entry> = PATCH_KEYS[..2].iter().filter_map(|key| section.get(key)).collect();
    match (given, patch.as_slice()) {
        (Some(moment), []) => moment.number(&of::PATCH_MOMENT, faults),
        (Some(moment), [first, ..]) => {
            let other = first.key.rsplit('.').next().unwrap_or_default();
            let expected = format!("either moment_n_per_v, or {}", PATCH_KEYS.join(", "));
            faults.add(&moment.key, moment.span, format!("moment_n_per_v and {other}"), expected, None);
            None
        }
        (None, []) if section.get(PATCH_KEYS[2]).is_none() => {
            let expected = format!("{}, or {} instead", of::PATCH_MOMENT.expected(), PATCH_KEYS.join(", "));
            section.require("moment_n_per_v", &expected, faults);
            None
        }
        (None, _) => {
            let d31 = section.number(PATCH_KEYS[0], &of::STRAIN_CONSTANT, faults);
            let young = section.number(PATCH_KEYS[1], &of::PATCH_YOUNG, faults);
            section.require(PATCH_KEYS[2], &of::PATCH_THICKNESS.expected(), faults);
            let lever = (thickness? + patch_thickness??) / 2.0;
            Some(d31?.abs() * young? * lever / (1.0 - PATCH_POISSON))
        }
    }
}

fn mass(
    section: &Section,
    radius: Option<f64>,
    patch_thickness: Option<Option<f64>>,
    faults: &mut Faults,
) -> Option<f64> {
    let Some(density) = section.get("patch_density_kg_m3") else {
        return section.number_or("patch_mass_mg", 0.0, &of::PATCH_MASS, faults);
    };
    let value = density.number(&of::DENSITY, faults);
    if section.get("patch_mass_mg").is_some() {
        let found = "patch_mass_mg and patch_density_kg_m3";
        faults.add(&density.key, density.span, found, "at most one of them", None);
        return None;
    }
    if patch_thickness == Some(None) {
        let expected = "patch_thickness_mm beside it, or patch_mass_mg in its place";
        faults.add(&density.key, density.span, "patch_density_kg_m3 alone", expected, None);
        return None;
    }
    Some(PI * radius?.powi(2) * patch_thickness?? * value?)
}
