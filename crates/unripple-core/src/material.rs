//! Materials: density, Young's modulus, Poisson's ratio, strength.

/// The constants of a material. Typical values at room temperature; each can be overridden in a surface file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// The name of the material in surface files.
    pub name: &'static str,
    /// Other names that surface files may use for it.
    pub aliases: &'static [&'static str],
    /// Young's modulus E, in Pa.
    pub young: f64,
    /// Density ρ, in kg/m³.
    pub density: f64,
    /// Poisson's ratio ν.
    pub poisson: f64,
    /// Stress at yield, or at fracture if brittle, in Pa.
    pub strength: f64,
    /// Source of the values, and how far the values in that source differ from those used here.
    pub source: &'static str,
}

/// The built-in materials, by name: typical values at room temperature. If a Young's modulus is doubled, the frequencies of
/// a plate rise by √2; if a density is doubled, they fall by √2.
pub const MATERIALS: &[Material] = &[
    Material {
        name: "BoPET",
        aliases: &["PET", "Mylar"],
        young: 4.0e9,
        density: 1400.0,
        poisson: 0.3,
        strength: 100e6,
        source: "Hudin et al. (EuroHaptics 2012), table 1, and a Poisson's ratio and strength chosen here; DuPont Teijin Films gives for Mylar (H-37232-3) 1390 kg/m³, 4.8 to 5.0 GPa, a Poisson's ratio of 0.38 and 100 MPa at 5 % strain",
    },
    Material {
        name: "glass",
        aliases: &[],
        young: 69.0e9,
        density: 2300.0,
        poisson: 0.22,
        strength: 40e6,
        source: "Hudin et al. (EuroHaptics 2012), table 1; Poisson's ratio and strength as for soda-lime glass",
    },
    Material {
        name: "soda-lime glass",
        aliases: &[],
        young: 72.0e9,
        density: 2500.0,
        poisson: 0.22,
        strength: 40e6,
        source: "float glass: Pilkington, Technical Bulletin ATS-129 (2013), which gives a Poisson's ratio of 0.23 and fracture at 41 MPa on average, at 19 MPa in 0.8 % of all panes",
    },
    Material {
        name: "strengthened glass",
        aliases: &[],
        young: 70.0e9,
        density: 2440.0,
        poisson: 0.22,
        strength: 600e6,
        source: "typical of ion-exchanged aluminosilicate glass for displays, no single source: its strength is that of the compressed surface and depends on the process",
    },
    Material {
        name: "polycarbonate",
        aliases: &[],
        young: 2.35e9,
        density: 1200.0,
        poisson: 0.37,
        strength: 62e6,
        source: "Covestro, Makrolon 2407 data sheet, which gives a flexural modulus of 2.35 GPa (2.4 GPa in tension) and yield at 66 MPa; Poisson's ratio typical, no single source",
    },
    Material {
        name: "PMMA",
        aliases: &["acrylic"],
        young: 3.1e9,
        density: 1190.0,
        poisson: 0.37,
        strength: 70e6,
        source: "typical of cast sheet, no single source: manufacturers give 2.8 to 3.3 GPa and 67 to 75 MPa (ISO 527)",
    },
    Material {
        name: "polyimide",
        aliases: &["Kapton"],
        young: 2.5e9,
        density: 1420.0,
        poisson: 0.34,
        strength: 69e6,
        source: "DuPont, Kapton HN data sheet, at 23 °C; its strength is the stress at 3 % strain",
    },
    Material {
        name: "aluminium",
        aliases: &["aluminum"],
        young: 69.0e9,
        density: 2700.0,
        poisson: 0.33,
        strength: 145e6,
        source: "alloy 3003-H14: Aluminum Association, typical values, which are 68.9 GPa and 2730 kg/m³; other alloys differ in strength more than in stiffness",
    },
    Material {
        name: "steel",
        aliases: &[],
        young: 200.0e9,
        density: 7900.0,
        poisson: 0.29,
        strength: 250e6,
        source: "austenitic stainless steel 1.4301 (EN 10088-1: 200 GPa, 7900 kg/m³), of which bars have a 0.2 % proof stress of at least 190 MPa (EN 10088-3), strip more; Poisson's ratio typical, no single source",
    },
    Material {
        name: "MDF",
        aliases: &[],
        young: 3.6e9,
        density: 750.0,
        poisson: 0.25,
        strength: 36e6,
        source: "USDA Forest Products Laboratory, Wood Handbook (FPL-GTR-190, 2010), table 12-1, in bending, which gives 3.59 GPa, 35.9 MPa and a specific gravity of 0.7 to 0.9; density within these and Poisson's ratio typical, no single source; boards of low density have 2.5 GPa and less",
    },
    Material {
        name: "plywood",
        aliases: &[],
        young: 7.8e9,
        density: 550.0,
        poisson: 0.1,
        strength: 38e6,
        source: "USDA Forest Products Laboratory, Wood Handbook (FPL-GTR-190, 2010), table 12-1, in bending along the grain of the faces, which gives 6.96 to 8.55 GPa, 33.7 to 42.6 MPa and a specific gravity of 0.4 to 0.6; Poisson's ratio typical of crossed veneers, no single source; across that grain and in shear it is softer (0.6 to 0.75 GPa in shear)",
    },
];

impl Material {
    /// Names of all built-in materials.
    pub fn names() -> Vec<&'static str> {
        MATERIALS.iter().map(|material| material.name).collect()
    }

    /// The built-in material with a given name or alias, upper or lower case; `None` if there is none.
    pub fn named(name: &str) -> Option<&'static Self> {
        let called = |known: &&str| known.eq_ignore_ascii_case(name);
        MATERIALS.iter().find(|m| called(&m.name) || m.aliases.iter().any(&called))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_or_alias_is_that_of_one_material() {
        let mut seen = Vec::new();
        for material in MATERIALS {
            for name in std::iter::once(&material.name).chain(material.aliases) {
                assert_eq!(Material::named(&name.to_uppercase()), Some(material), "{name}");
                seen.push(name.to_lowercase());
            }
        }
        let all = seen.len();
        seen.sort();
        seen.dedup();
        assert_eq!(seen.len(), all, "a name stands for two materials");
        assert_eq!(Material::named("pet").map(|m| m.name), Some("BoPET"));
        assert!(Material::named("mdf").is_some() && Material::named("plywood").is_some());
    }
}
