//! Scatterers in a surface file: point masses and discs.

use super::material;
use super::place::Ground;
use super::range::of;
use super::reader::{Faults, Section};
use unripple_core::{Scatterer, ScattererKind};

/// Largest number of scatterers of a surface: a bound on the cost of the coupled problem that a small file can pose.
const MOST_SCATTERERS: usize = 1024;

/// Keys of the table `[[scatterer]]`: of both kinds, of a point mass, and of a glued disc.
const COMMON_KEYS: [&str; 2] = ["at_mm", "kind"];
const MASS_KEYS: [&str; 1] = ["mass_mg"];
const DISC_KEYS: [&str; 6] =
    ["radius_mm", "thickness_mm", "material", "young_gpa", "density_kg_m3", "poisson_ratio"];

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Mass,
    Disc,
}

/// The kinds of scatterers, by their names in files.
const KINDS: [(&str, Kind); 2] = [("mass", Kind::Mass), ("disc", Kind::Disc)];

/// What a point mass needs.
const STIFF: &str = "\"disc\" where young_gpa is 0: without stiffness against bending a sheet gives way at a point, and does not move with \
                     a mass there";

/// All tables `[[scatterer]]`, in the file's order; `bends` says whether the sheet resists bending.
pub(super) fn read(
    root: &Section,
    ground: Option<&Ground>,
    bends: bool,
    faults: &mut Faults,
) -> Option<Vec<Scatterer>> {
    let Some(entry) = root.get("scatterer") else { return Some(Vec::new()) };
    let Some(items) = entry.items() else {
        entry.refuse("a list of tables, each headed [[scatterer]]", None, faults);
        return None;
    };
    if items.len() > MOST_SCATTERERS {
        let found = format!("{} scatterers", items.len());
        let expected = format!("at most {MOST_SCATTERERS} tables headed [[scatterer]]");
        faults.add("scatterer", entry.span, found, expected, Some(MOST_SCATTERERS.to_string()));
        return None;
    }
    let read: Vec<Option<Scatterer>> =
        items.iter().map(|item| one(&item.section(faults)?, ground, bends, faults)).collect();
    read.into_iter().collect()
}

fn one(section: &Section, ground: Option<&Ground>, bends: bool, faults: &mut Faults) -> Option<Scatterer> {
    let kind = section.require("kind", "\"mass\" or \"disc\"", faults).and_then(|entry| {
        let kind = entry.choice(&KINDS, faults)?;
        if kind == Kind::Mass && !bends {
            entry.refuse(STIFF, None, faults);
            return None;
        }
        Some(kind)
    });
    let keys: Vec<&str> = match kind {
        Some(Kind::Mass) => MASS_KEYS.to_vec(),
        Some(Kind::Disc) => DISC_KEYS.to_vec(),
        None => [&MASS_KEYS[..], &DISC_KEYS[..]].concat(),
    };
    let elsewhere = |key: &str| match key {
        key if MASS_KEYS.contains(&key) => Some("this key only where kind = \"mass\"".into()),
        key if DISC_KEYS.contains(&key) => Some("this key only where kind = \"disc\"".into()),
        _ => None,
    };
    section.check_keys(&[&COMMON_KEYS[..], &keys].concat(), elsewhere, faults);
    let at = Ground::read(ground, section, faults);
    let kind = match kind? {
        Kind::Mass => section.number(MASS_KEYS[0], &of::SCATTERER_MASS, faults).map(ScattererKind::Mass),
        Kind::Disc => disc(section, faults),
    };
    Some(Scatterer { at: at?, kind: kind? })
}

fn disc(section: &Section, faults: &mut Faults) -> Option<ScattererKind> {
    let radius = section.number(DISC_KEYS[0], &of::DISC_RADIUS, faults);
    let thickness = section.number(DISC_KEYS[1], &of::THICKNESS, faults);
    let stuff = material::read(section, faults)?;
    let (young, density, poisson) = (stuff.young, stuff.density, stuff.poisson);
    Some(ScattererKind::Disc { radius: radius?, thickness: thickness?, young, density, poisson })
}
