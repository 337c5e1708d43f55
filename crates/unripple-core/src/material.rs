//! Materials: density, Young's modulus, Poisson's ratio, strength.

/// The constants of a material. Typical values at room temperature; each can be overridden in a surface file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// The name of the material in surface files.
    pub name: &'static str,
    /// Young's modulus E, in Pa.
    pub young: f64,
    /// Density ρ, in kg/m³.
    pub density: f64,
    /// Poisson's ratio ν.
    pub poisson: f64,
    /// Stress at yield, or at fracture if brittle, in Pa.
    pub strength: f64,
}

/// The built-in materials, by name: typical values at room temperature. If a Young's modulus is doubled, the frequencies of
/// a plate rise by √2; if a density is doubled, they fall by √2.
pub const MATERIALS: &[Material] = &[
    Material { name: "BoPET", young: 4.0e9, density: 1400.0, poisson: 0.3, strength: 100e6 },
    Material { name: "glass", young: 69.0e9, density: 2300.0, poisson: 0.22, strength: 40e6 },
    Material { name: "soda-lime glass", young: 72.0e9, density: 2500.0, poisson: 0.22, strength: 40e6 },
    Material { name: "strengthened glass", young: 70.0e9, density: 2440.0, poisson: 0.22, strength: 600e6 },
    Material { name: "polycarbonate", young: 2.35e9, density: 1200.0, poisson: 0.37, strength: 62e6 },
    Material { name: "PMMA", young: 3.1e9, density: 1190.0, poisson: 0.37, strength: 70e6 },
    Material { name: "polyimide", young: 2.5e9, density: 1420.0, poisson: 0.34, strength: 69e6 },
    Material { name: "aluminium", young: 69.0e9, density: 2700.0, poisson: 0.33, strength: 145e6 },
    Material { name: "steel", young: 200.0e9, density: 7900.0, poisson: 0.29, strength: 250e6 },
];

impl Material {
    /// The built-in material of that name, whatever the case of its letters; `None` if there is none.
    pub fn named(name: &str) -> Option<&'static Self> {
        MATERIALS.iter().find(|m| m.name.eq_ignore_ascii_case(name))
    }
}
