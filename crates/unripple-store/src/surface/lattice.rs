//! Lattices of resonators in a surface file.

use super::place::Ground;
use super::range::of;
use super::reader::{Entry, Faults, Section};
use super::scatterer::{MOST_SCATTERERS, RESONATOR_KEYS, STIFF_ENOUGH};
use unripple_core::{Lattice, Outline, Point};

/// Keys of the table `[[lattice]]` beside those of a resonator.
const FROM: &str = "from_mm";
const TO: &str = "to_mm";
const PITCH: &str = "pitch_mm";
const COUNTS: [&str; 2] = ["columns", "rows"];
const RATIO: &str = "mass_ratio";
const SCATTER: &str = "scatter_percent";
const SEED: &str = "seed";

/// Largest seed: any of so many is enough, and a spreadsheet shows it whole.
const MOST_SEED: usize = 1_000_000_000;

/// The seed where the file gives none.
const DEFAULT_SEED: u64 = 1;

/// Pitches this little too long for a further cell still count as fitting it, as a share of a cell: rounding of lengths in decimal digits.
const FITS: f64 = 1e-9;

/// The sheet under a lattice, as far as the file is without fault.
pub(super) struct Under<'a> {
    /// Its outline, with its holes.
    pub ground: Option<&'a Ground>,
    /// Its mass per area, in kg/m².
    pub density: Option<f64>,
    /// Whether it resists bending.
    pub bends: bool,
    /// Number of resonators that stand on it beside those of lattices.
    pub others: usize,
}

/// All tables `[[lattice]]`, in the file's order.
pub(super) fn read(root: &Section, under: &Under<'_>, faults: &mut Faults) -> Option<Vec<Lattice>> {
    let Some(entry) = root.get("lattice") else { return Some(Vec::new()) };
    let Some(items) = entry.items() else {
        entry.refuse("a list of tables, each headed [[lattice]]", None, faults);
        return None;
    };
    if !under.bends && !items.is_empty() {
        entry.refuse(STIFF_ENOUGH, None, faults);
        return None;
    }
    let read: Vec<Option<Lattice>> = items.iter().map(|item| one(item, under, faults)).collect();
    let lattices: Vec<Lattice> = read.into_iter().collect::<Option<_>>()?;
    let whole =
        under.others + lattices.iter().map(|lattice| lattice.cells[0] * lattice.cells[1]).sum::<usize>();
    if whole > MOST_SCATTERERS {
        let expected = format!("at most {MOST_SCATTERERS} resonators in all");
        faults.add(
            "lattice",
            entry.span,
            format!("{whole} resonators"),
            expected,
            Some(MOST_SCATTERERS.to_string()),
        );
        return None;
    }
    Some(lattices)
}

fn one(item: &Entry, under: &Under<'_>, faults: &mut Faults) -> Option<Lattice> {
    let (ground, density) = (under.ground, under.density);
    let section = &item.section(faults)?;
    let [mass, frequency, quality] = RESONATOR_KEYS;
    let keys = [FROM, TO, PITCH, COUNTS[0], COUNTS[1], mass, RATIO, frequency, quality, SCATTER, SEED];
    section.check_keys(&keys, |_| None, faults);
    let grid = grid(section, ground, faults);
    let mass = mass_of(section, faults);
    let frequency = section.number(frequency, &of::RESONANCE, faults);
    let quality_factor = section.number(quality, &of::RESONATOR_QUALITY, faults);
    let scatter = section.number_or(SCATTER, 0.0, &of::FREQUENCY_SCATTER, faults);
    let seed = match section.get(SEED) {
        Some(entry) => entry.count(0, MOST_SEED, faults).map(|seed| seed as u64),
        None => Some(DEFAULT_SEED),
    };
    let (corners, cells) = grid?;
    let mut lattice = Lattice {
        corners,
        cells,
        mass: 0.0,
        frequency: frequency?,
        quality_factor: quality_factor?,
        scatter: scatter?,
        seed: seed?,
    };
    let [x, y] = lattice.pitch();
    lattice.mass = match mass? {
        Mass::Each(mass) => mass,
        Mass::Share(ratio, entry) => {
            let mass = ratio * density? * x * y;
            if !of::RESONATOR_MASS.hold(mass) {
                let found = format!("{:.3e} g for each resonator", mass * 1e3);
                faults.add(&entry.key, entry.span, found, of::RESONATOR_MASS.expected(), None);
                return None;
            }
            mass
        }
    };
    if ground.is_some_and(|ground| lattice.resonators(ground.outline()).is_empty()) {
        let found = "a lattice none of whose cells has its centre on the sheet";
        faults.add(&item.key, item.span.clone(), found, "places on the sheet", None);
        return None;
    }
    Some(lattice)
}

/// The mass of a resonator as a table gives it.
enum Mass<'a> {
    /// In kg.
    Each(f64),
    /// Relative to the mass of the sheet in a cell, and where the file says so.
    Share(f64, Entry<'a>),
}

fn mass_of<'a>(section: &Section<'a>, faults: &mut Faults) -> Option<Mass<'a>> {
    let key = RESONATOR_KEYS[0];
    let Some(ratio) = section.get(RATIO) else {
        let expected = format!("{}, or {RATIO} instead", of::RESONATOR_MASS.expected());
        return section.require(key, &expected, faults)?.number(&of::RESONATOR_MASS, faults).map(Mass::Each);
    };
    if section.get(key).is_some() {
        faults.add(&ratio.key, ratio.span, format!("{key} and {RATIO}"), "one of them", None);
        return None;
    }
    let share = ratio.number(&of::MASS_RATIO, faults)?;
    Some(Mass::Share(share, ratio))
}

/// The corners of the rectangle that cells fill, and their numbers along x and y.
fn grid(section: &Section, ground: Option<&Ground>, faults: &mut Faults) -> Option<([Point; 2], [usize; 2])> {
    let corners = corners(section, ground.map(Ground::outline), faults);
    let counts = COUNTS.map(|key| section.get(key));
    let Some(pitch) = section.get(PITCH) else {
        let expected = format!("a whole number from 1 to {MOST_SCATTERERS}, or {PITCH} instead of both");
        let read = COUNTS.map(|key| {
            section.require(key, &expected, faults).and_then(|entry| entry.count(1, MOST_SCATTERERS, faults))
        });
        let [columns, rows] = read;
        return Some((corners?, [columns?, rows?]));
    };
    let length = pitch.number(&of::LATTICE_PITCH, faults);
    if counts.iter().any(Option::is_some) {
        let found = format!("{PITCH} and numbers of cells");
        faults.add(&pitch.key, pitch.span, found, format!("either {PITCH} or columns and rows"), None);
        return None;
    }
    let ([from, to], length) = (corners?, length?);
    let sides = [to.x - from.x, to.y - from.y];
    let cells = sides.map(|side| (side / length + FITS).floor() as usize);
    if cells.contains(&0) {
        let shorter = sides[0].min(sides[1]) * 1e3;
        let expected = format!("at most {shorter:.4} mm, the shorter side of the lattice's rectangle");
        pitch.refuse(expected, None, faults);
        return None;
    }
    // What is left over is shared between both sides.
    let rest = [0, 1].map(|i| 0.5 * (sides[i] - cells[i] as f64 * length));
    let corners =
        [Point::new(from.x + rest[0], from.y + rest[1]), Point::new(to.x - rest[0], to.y - rest[1])];
    Some((corners, cells))
}

/// The lower left and the upper right corner; by default those of the box around the outline.
fn corners(section: &Section, outline: Option<&Outline>, faults: &mut Faults) -> Option<[Point; 2]> {
    let mut corner = |key: &str, default: Option<Point>| match section.get(key) {
        Some(entry) => {
            let [x, y] = entry.numbers(&of::COORDINATE, "[x, y] in mm", faults)?;
            Some(Point::new(x, y))
        }
        None => default,
    };
    let from = corner(FROM, outline.map(|_| Point::new(0.0, 0.0)));
    let to = corner(TO, outline.map(|outline| outline.extent()).map(|(w, h)| Point::new(w, h)));
    let (from, to) = (from?, to?);
    if to.x <= from.x || to.y <= from.y {
        let expected = format!("a corner to the right of {FROM} and above it");
        match section.get(TO).or_else(|| section.get(FROM)) {
            Some(entry) => entry.refuse(expected, None, faults),
            None => return None,
        }
        return None;
    }
    Some([from, to])
}
