//! Orthotropic sheets in a surface file.

use super::material::MaterialProperties;
use super::range::of;
use super::reader::{Faults, Section};
use crate::decimal;
use unripple_core::Grain;

/// The keys of the table `[sheet]` that make it orthotropic.
pub(super) const GRAIN_KEYS: [&str; 3] = ["young_across_gpa", "shear_gpa", "grain_deg"];

/// The grain that a sheet says it has, if any; `None` at a fault. `stuff` is what it is made of along the grain.
pub(super) fn read(
    section: &Section,
    stuff: Option<&MaterialProperties>,
    faults: &mut Faults,
) -> Option<Option<Grain>> {
    if GRAIN_KEYS.iter().all(|key| section.get(key).is_none()) {
        return Some(None);
    }
    let across = section.number(GRAIN_KEYS[0], &of::GRAIN_YOUNG, faults);
    let shear = match section.get(GRAIN_KEYS[1]) {
        Some(entry) => entry.number(&of::GRAIN_YOUNG, faults).map(Some),
        None => Some(None),
    };
    let direction = section.number_or(GRAIN_KEYS[2], 0.0, &of::DIRECTION, faults);
    let (stuff, across) = (stuff?, across?);
    bounded(section, stuff, across, faults)?;
    let shear = match shear? {
        Some(shear) => shear,
        None => mean(section, stuff, across, faults)?,
    };
    Some(Some(Grain { direction: direction?, young_across: across, shear }))
}

/// The shear modulus where a file does not give it: E1 E2 / (E1 + E2 + 2 ν12 E2), Huber's estimate for orthotropic
/// plates. For an isotropic sheet it is the exact one.
fn mean(section: &Section, stuff: &MaterialProperties, across: f64, faults: &mut Faults) -> Option<f64> {
    let mean = stuff.young / (1.0 + stuff.young / across + 2.0 * stuff.poisson);
    if of::GRAIN_YOUNG.allow(mean / 1e9) {
        return Some(mean);
    }
    let expected =
        format!("{}: the default from the other numbers is {:e} GPa", of::GRAIN_YOUNG.expected(), mean / 1e9);
    section.require(GRAIN_KEYS[1], &expected, faults);
    None
}

/// Whether the sheet's strain energy is positive: ν12 ν21 = ν12² E2 / E1 < 1.
fn bounded(section: &Section, stuff: &MaterialProperties, across: f64, faults: &mut Faults) -> Option<()> {
    if stuff.young < of::GRAIN_YOUNG.least * 1e9 {
        let span = section.get("young_gpa").map_or(section.span.clone(), |entry| entry.span);
        let found = format!("{} GPa", of::YOUNG.text(stuff.young));
        let expected = format!(
            "{}: a sheet with grain needs a Young's modulus along the grain",
            of::GRAIN_YOUNG.expected()
        );
        let nearest = of::GRAIN_YOUNG.nearest(0.0);
        faults.add(&format!("{}.young_gpa", section.key), span, found, expected, nearest);
        return None;
    }
    let poisson = stuff.poisson * stuff.poisson;
    if poisson * across < stuff.young {
        return Some(());
    }
    let entry = section.get(GRAIN_KEYS[0])?;
    let most = stuff.young / poisson;
    // Four digits, below the limit however they are rounded.
    let below = decimal::plain(&format!("{:.3e}", most / 1e9 * (1.0 - 1e-3)));
    let expected = format!(
        "a number below young_gpa / poisson_ratio², which is {:.4} GPa: with more, the stiffness is not positive definite",
        most / 1e9
    );
    entry.refuse(expected, Some(below), faults);
    None
}
