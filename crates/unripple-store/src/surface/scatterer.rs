//! Scatterers in a surface file: point masses, discs and resonators.

use super::material;
use super::place::Ground;
use super::range::of;
use super::reader::{Faults, Section};
use unripple_core::{Point, Resonator, Scatterer, ScattererKind};

/// Largest number of scatterers of a surface: a bound on the cost of the coupled problem that a small file can pose.
pub(super) const MOST_SCATTERERS: usize = 1024;

/// Keys of a resonator, alone or in a lattice.
pub(super) const RESONATOR_KEYS: [&str; 3] = ["mass_g", "frequency_hz", "quality_factor"];

/// Keys of the table `[[scatterer]]`: of all kinds, of a point mass, and of a glued disc.
const COMMON_KEYS: [&str; 2] = ["at_mm", "kind"];
const MASS_KEYS: [&str; 1] = ["mass_mg"];
const DISC_KEYS: [&str; 6] =
    ["radius_mm", "thickness_mm", "material", "young_gpa", "density_kg_m3", "poisson_ratio"];

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Mass,
    Disc,
    Resonator,
}

/// The kinds of scatterers, by their names in files.
const KINDS: [(&str, Kind); 3] = [("mass", Kind::Mass), ("disc", Kind::Disc), ("resonator", Kind::Resonator)];

/// What a point mass or a resonator needs.
const STIFF: &str = "\"disc\" where young_gpa is 0: without stiffness against bending a sheet gives way at a point, and does not move with \
                     a mass there";

/// What a lattice needs.
pub(super) const STIFF_ENOUGH: &str = "no lattice where young_gpa is 0: without stiffness against bending a sheet gives way at a point, \
                                       and does not move with a resonator there";

/// What the tables `[[scatterer]]` put on the sheet, each kind in the file's order.
#[derive(Default)]
pub(super) struct Attached {
    /// Masses and discs.
    pub scatterers: Vec<Scatterer>,
    /// Resonators that stand alone.
    pub resonators: Vec<Resonator>,
}

/// One table.
enum One {
    Scatterer(Scatterer),
    Resonator(Resonator),
}

/// All tables `[[scatterer]]`; `bends` says whether the sheet resists bending.
pub(super) fn read(
    root: &Section,
    ground: Option<&Ground>,
    bends: bool,
    faults: &mut Faults,
) -> Option<Attached> {
    let mut attached = Attached::default();
    let Some(entry) = root.get("scatterer") else { return Some(attached) };
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
    let read: Vec<Option<One>> =
        items.iter().map(|item| one(&item.section(faults)?, ground, bends, faults)).collect();
    for one in read {
        match one? {
            One::Scatterer(scatterer) => attached.scatterers.push(scatterer),
            One::Resonator(resonator) => attached.resonators.push(resonator),
        }
    }
    Some(attached)
}

fn one(section: &Section, ground: Option<&Ground>, bends: bool, faults: &mut Faults) -> Option<One> {
    let kind = section.require("kind", "\"mass\", \"disc\" or \"resonator\"", faults).and_then(|entry| {
        let kind = entry.choice(&KINDS, faults)?;
        if kind != Kind::Disc && !bends {
            entry.refuse(STIFF, None, faults);
            return None;
        }
        Some(kind)
    });
    let keys: Vec<&str> = match kind {
        Some(Kind::Mass) => MASS_KEYS.to_vec(),
        Some(Kind::Disc) => DISC_KEYS.to_vec(),
        Some(Kind::Resonator) => RESONATOR_KEYS.to_vec(),
        None => [&MASS_KEYS[..], &DISC_KEYS[..], &RESONATOR_KEYS[..]].concat(),
    };
    let elsewhere = |key: &str| match key {
        key if MASS_KEYS.contains(&key) => Some("this key only where kind = \"mass\"".into()),
        key if DISC_KEYS.contains(&key) => Some("this key only where kind = \"disc\"".into()),
        key if RESONATOR_KEYS.contains(&key) => Some("this key only where kind = \"resonator\"".into()),
        _ => None,
    };
    section.check_keys(&[&COMMON_KEYS[..], &keys].concat(), elsewhere, faults);
    let at = Ground::read(ground, section, faults);
    let kind = match kind? {
        Kind::Mass => section.number(MASS_KEYS[0], &of::SCATTERER_MASS, faults).map(ScattererKind::Mass),
        Kind::Disc => disc(section, faults),
        Kind::Resonator => return resonator(section, at, faults).map(One::Resonator),
    };
    Some(One::Scatterer(Scatterer { at: at?, kind: kind? }))
}

fn resonator(section: &Section, at: Option<Point>, faults: &mut Faults) -> Option<Resonator> {
    let [mass, frequency, quality] = RESONATOR_KEYS;
    let mass = section.number(mass, &of::RESONATOR_MASS, faults);
    let frequency = section.number(frequency, &of::RESONANCE, faults);
    let quality_factor = section.number(quality, &of::RESONATOR_QUALITY, faults);
    Some(Resonator { at: at?, mass: mass?, frequency: frequency?, quality_factor: quality_factor? })
}

fn disc(section: &Section, faults: &mut Faults) -> Option<ScattererKind> {
    let radius = section.number(DISC_KEYS[0], &of::DISC_RADIUS, faults);
    let thickness = section.number(DISC_KEYS[1], &of::THICKNESS, faults);
    let stuff = material::read(section, faults)?;
    let (young, density, poisson) = (stuff.young, stuff.density, stuff.poisson);
    Some(ScattererKind::Disc { radius: radius?, thickness: thickness?, young, density, poisson })
}
