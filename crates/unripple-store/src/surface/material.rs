//! Materials in a surface file.

use super::range::of;
use super::reader::{Entry, Faults, Section};
use crate::names::nearest;
use unripple_core::Material;

/// The keys of a table that say what something is made of; a table may know fewer.
pub(super) const MATERIAL_KEYS: [&str; 5] =
    ["material", "young_gpa", "density_kg_m3", "poisson_ratio", "strength_mpa"];

/// Properties of a material, overrides of the file included.
pub(super) struct MaterialProperties {
    /// Name of the material; empty where the file gives numbers only.
    pub name: String,
    /// Young's modulus in Pa.
    pub young: f64,
    /// Density in kg/m³.
    pub density: f64,
    /// Poisson's ratio, without unit.
    pub poisson: f64,
    /// Tensile strength in Pa, if known.
    pub strength: Option<f64>,
}

/// What a table says that something is made of: a known material, or its numbers, or both.
pub(super) fn read(section: &Section, faults: &mut Faults) -> Option<MaterialProperties> {
    let given = section.get("material");
    let name = given.as_ref().and_then(|entry| entry.line("the name of a material", faults));
    let known = name.as_deref().and_then(Material::named);
    let complete = ["young_gpa", "density_kg_m3", "poisson_ratio"].iter().all(|k| section.get(k).is_some());
    let unknown = given.is_some() && (name.is_none() || (known.is_none() && !complete));
    if let (Some(entry), Some(name), true) = (&given, &name, unknown) {
        refuse(entry, name, faults);
    }
    let mut number = |key, limits, of_material: fn(&Material) -> f64| match known {
        Some(m) => section.number_or(key, of_material(m), limits, faults),
        // One fault for the name is enough.
        None if unknown => section.number_or(key, 0.0, limits, faults),
        None => section.number(key, limits, faults),
    };
    let young = number("young_gpa", &of::YOUNG, |m| m.young);
    let density = number("density_kg_m3", &of::DENSITY, |m| m.density);
    let poisson = number("poisson_ratio", &of::POISSON, |m| m.poisson);
    let strength = match section.get("strength_mpa") {
        Some(entry) => entry.number(&of::STRENGTH, faults).map(Some),
        None => Some(known.map(|m| m.strength)),
    };
    if unknown {
        return None;
    }
    let name = known.map(|m| m.name.to_owned()).or(name).unwrap_or_else(|| "custom".into());
    Some(MaterialProperties {
        name,
        young: young?,
        density: density?,
        poisson: poisson?,
        strength: strength?,
    })
}

fn refuse(entry: &Entry, name: &str, faults: &mut Faults) {
    let names = Material::names();
    let near = nearest(name, names.iter().copied()).map(|n| format!("\"{n}\""));
    let expected = format!(
        "one of {}, or young_gpa, density_kg_m3 and poisson_ratio beside a name of your own",
        names.join(", ")
    );
    entry.refuse(expected, near, faults);
}
