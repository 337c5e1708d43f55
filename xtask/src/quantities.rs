//! Public functions of real numbers name a unit, a shape or a pure number in their docs.

use crate::items::{self, declared};
use crate::sources;
use std::path::Path;

/// Types that hold quantities.
const TYPES: [&str; 11] =
    ["f64", "f32", "c64", "Complex", "Mat", "MatRef", "MatMut", "Col", "ColRef", "Point", "Duration"];

/// Units as they are written, in upper and lower case; not the ampere's, which begins sentences as an article.
const UNITS: &str = "m mm µm s ms µs ns Hz kHz N mN V W J Pa GPa kg g mg dB rad rad/s rad/m m/s m² 1/s 1/m 1/kg N/m N/A N·m \
    N·s/m N·s m/s/N kg/m² kg/m³ px pt % Ω H T K °C SI Hz²";

/// Words for units, shapes and pure numbers, in lower case; a plural in `s` counts as well.
const WORDS: &str = "second millisecond microsecond nanosecond metre millimetre micrometre hertz newton volt ampere watt \
    joule kilogram decibel radian degree kelvin pixel byte bit sample frame block channel row column \
    point mode actuator cell number count index ratio share factor fraction multiple \
    percentile power amplitude correlation period wavelength octave neper unit dimensionless shape \
    matrix vector length weight probability likeness";

/// Finds public functions of quantities whose docs name no unit or shape.
pub fn check(root: &Path) -> Vec<String> {
    sources::faults(root, &|text| {
        let lines: Vec<&str> = text.lines().collect();
        let lines = items::code(&lines);
        let bare = (0..lines.len()).filter(|at| is_numeric(lines, *at) && !is_named(lines, *at));
        bare.map(|at| (at, "expected a doc that names a unit or a shape".to_owned())).collect()
    })
}

/// Whether a line begins a public function that takes or gives quantities.
fn is_numeric(lines: &[&str], at: usize) -> bool {
    let function = declared(lines[at]).is_some_and(|item| item.kind == "fn" && item.public);
    let signature = lines[at..items::signature_end(lines, at)].join(" ");
    let mut words = signature.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    function && words.any(|word| TYPES.contains(&word))
}

/// Whether the doc above a line names a unit or a shape; a missing doc is another rule's.
fn is_named(lines: &[&str], at: usize) -> bool {
    items::doc(lines, at).is_none_or(|doc| {
        doc.contains('[')
            || doc.contains("0 to 1")
            || doc.contains(" x ")
            || doc.contains("per cent")
            || doc.split_whitespace().any(|word| {
                let word = word.trim_matches(|c: char| !(c.is_alphanumeric() || "%²³".contains(c)));
                let lower = word.to_lowercase();
                let single = lower.strip_suffix('s').unwrap_or(&lower);
                let single = if single == "indice" { "index" } else { single };
                let named = |list: &str, word: &str| list.split(' ').any(|known| known == word);
                named(UNITS, word) || named(WORDS, &lower) || named(WORDS, single)
            })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bare(text: &str) -> bool {
        let lines: Vec<&str> = text.lines().collect();
        let at = lines.iter().position(|line| line.contains("fn ")).unwrap();
        is_numeric(&lines, at) && !is_named(&lines, at)
    }

    #[test]
    fn a_quantity_without_a_unit_is_seen() {
        assert!(bare("/// How strong it is.\npub fn strength(&self) -> f64 {"));
        assert!(!bare("/// How strong it is, in N.\npub fn strength(&self) -> f64 {"));
        assert!(!bare("/// Weights, modes x points.\npub fn weights(&self) -> Mat<f64> {"));
        assert!(!bare("/// Indices of them.\npub fn of(at: Point) -> Vec<usize> {"));
        assert!(!bare("/// Whether it is.\npub fn is(&self) -> bool {"));
        assert!(!bare("/// How strong it is.\nfn strength(&self) -> f64 {"));
        assert!(bare("/// Where that would be.\npub fn moved(\n    &self,\n    at: Point,\n) -> Self {"));
    }
}
