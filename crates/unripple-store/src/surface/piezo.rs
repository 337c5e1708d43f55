//! Piezoelectric patches in a surface file.

use super::range::of;
use super::reader::{Entry, Faults, Section};
use crate::decimal;
use unripple_core::{ActuatorKind, Outline, Patch, Point};

/// All keys that a piezo patch may have.
pub(super) const PIEZO_KEYS: [&str; 9] = [
    "radius_mm",
    "rectangle_mm",
    "angle_deg",
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
    /// Thickness of the sheet at the patch, in metres.
    pub thickness: Option<f64>,
    /// The outline, and where on it the patch is.
    pub place: Option<(&'a Outline, Point)>,
}

/// Reads a piezo patch, with all its keys.
pub(super) fn read(section: &Section, spot: &Spot<'_>, faults: &mut Faults) -> Option<ActuatorKind> {
    let patch = patch(section, faults);
    let fits = patch.is_none_or(|patch| within(section, patch, spot.place, faults));
    let patch_thickness = match section.get("patch_thickness_mm") {
        Some(entry) => entry.number(&of::PATCH_THICKNESS, faults).map(Some),
        None => Some(None),
    };
    let moment = moment(section, spot.thickness, patch_thickness, faults);
    let mass = mass(section, patch, patch_thickness, faults);
    fits.then_some(ActuatorKind::Piezo { patch: patch?, moment: moment?, mass: mass? })
}

/// The outline of a patch: a disc or a rectangle.
fn patch(section: &Section, faults: &mut Faults) -> Option<Patch> {
    // A table that gives one form needs nothing of the other, whichever the defaults give.
    let own = |key: &str, other: &str| section.gives(key) && !section.gives(other);
    let (round, angular) = (own("radius_mm", "rectangle_mm"), own("rectangle_mm", "radius_mm"));
    let Some(rectangle) = section.get("rectangle_mm").filter(|_| !round) else {
        if let Some(angle) = section.get("angle_deg").filter(|_| !round || section.gives("angle_deg")) {
            faults.add(&angle.key, angle.span, "angle_deg without rectangle_mm", "both or neither", None);
            return None;
        }
        let expected = format!("{}, or rectangle_mm = [width, height] instead", of::PATCH_RADIUS.expected());
        let radius = section.require("radius_mm", &expected, faults)?.number(&of::PATCH_RADIUS, faults)?;
        return Some(Patch::Round { radius });
    };
    let sides = rectangle.numbers(&of::PATCH_SIDE, "[width, height] in mm", faults);
    let angle = section.number_or("angle_deg", 0.0, &of::DIRECTION, faults);
    if section.get("radius_mm").is_some() && !angular {
        let found = "radius_mm and rectangle_mm";
        faults.add(&rectangle.key, rectangle.span, found, "one of them", None);
        return None;
    }
    Some(Patch::Rectangular { sides: sides?, angle: angle? })
}

/// Whether a patch keeps within the rims, or a fault: its moment acts along the whole of its own rim.
fn within(section: &Section, patch: Patch, place: Option<(&Outline, Point)>, faults: &mut Faults) -> bool {
    let Some((outline, at)) = place else { return true };
    if patch.lies_on(outline, at) {
        return true;
    }
    let most = (outline.to_rim(at) * 1e7).floor() / 1e4;
    let (key, found, expected, near) = match patch {
        Patch::Round { radius } => (
            "radius_mm",
            format!("{} mm, which reaches beyond the rim", radius * 1e3),
            format!("at most {most} mm, the distance from the nearest rim"),
            (most >= of::PATCH_RADIUS.least).then(|| most.to_string()),
        ),
        Patch::Rectangular { sides: [width, height], .. } => (
            "rectangle_mm",
            format!("{} x {} mm, which reaches beyond the rim", width * 1e3, height * 1e3),
            format!("a rectangle on the sheet: the nearest rim is {most} mm from its centre"),
            None,
        ),
    };
    if let Some(entry) = section.get(key) {
        faults.add(&entry.key, entry.span, found, expected, near);
    }
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
    patch: Option<Patch>,
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
    let mass = patch?.area() * patch_thickness?? * value?;
    if of::PATCH_MASS.hold(mass) {
        return Some(mass);
    }
    let written = |mg: f64| decimal::plain(&format!("{mg:.3e}"));
    let found = format!("one with which the patch has {} mg", written(mass * 1e6));
    let expected =
        format!("a density with which the patch has at most {} mg", written(of::PATCH_MASS.greatest));
    faults.add(&density.key, density.span, found, expected, None);
    None
}
