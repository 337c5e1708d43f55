//! Report of the task `materials`.

use serde::Serialize;
use std::fmt::Write;
use textwrap::{Options, WordSplitter};
use unripple::core::Material;

/// Materials that surface files may name.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The materials, in the order of the guide.
    pub materials: Vec<MaterialRow>,
}

/// A material, with the source of its constants.
#[derive(Clone, Debug, Serialize)]
pub struct MaterialRow {
    /// Name of the material in surface files.
    pub name: &'static str,
    /// Other names that surface files may use for it.
    pub aliases: &'static [&'static str],
    /// Young's modulus, in Pa.
    pub young_pa: f64,
    /// Density, in kg/m³.
    pub density_kg_m3: f64,
    /// Poisson's ratio, without unit.
    pub poisson_ratio: f64,
    /// Stress at yield, or at fracture if brittle, in Pa.
    pub strength_pa: f64,
    /// Source of the values, and by how much the source's values differ from these.
    pub source: &'static str,
}

/// Columns of a terminal that the text fills.
const WIDTH: usize = 100;

/// Indentation of the lines that belong to a material, below the line with its name.
const INDENT: &str = "    ";

impl Report {
    pub(super) fn of(materials: impl IntoIterator<Item = &'static Material>) -> Self {
        let row = |material: &Material| MaterialRow {
            name: material.name,
            aliases: material.aliases,
            young_pa: material.young,
            density_kg_m3: material.density,
            poisson_ratio: material.poisson,
            strength_pa: material.strength,
            source: material.source,
        };
        Self { materials: materials.into_iter().map(row).collect() }
    }
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let mut text = String::from("material              GPa   kg/m³  Poisson    MPa\n");
        let within = Options::new(WIDTH).initial_indent(INDENT).subsequent_indent(INDENT);
        let within = within.word_splitter(WordSplitter::NoHyphenation);
        for row in &self.materials {
            let (young, strength) = (row.young_pa / 1e9, row.strength_pa / 1e6);
            let (density, poisson) = (row.density_kg_m3, row.poisson_ratio);
            let _ = writeln!(text, "{:<18} {young:>6} {density:>7} {poisson:>8} {strength:>6}", row.name);
            if !row.aliases.is_empty() {
                let _ = writeln!(text, "{INDENT}also called {}", row.aliases.join(", "));
            }
            let _ = writeln!(text, "{}", textwrap::fill(row.source, &within));
        }
        text
    }
}
