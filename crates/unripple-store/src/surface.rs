//! Surface files, format 1.

mod actuator;
mod apart;
mod bounds;
mod edge;
mod emission;
mod grain;
mod hole;
mod lattice;
mod layers;
mod material;
mod outline;
mod path;
mod piezo;
mod place;
mod places;
mod polygon;
mod profile;
pub(crate) mod range;
pub(crate) mod reader;
mod ring;
mod scatterer;
mod sheet;
mod suspension;
mod write;

pub use write::to_toml;

use crate::document;
use crate::{FileFaults, StoreError};
use actuator::Base;
use hole::Cut;
use outline::{Fetch, Rim};
use place::Ground;
use range::of;
use reader::{Faults, Section};
use unripple_core::{Finger, Hole, Outline, Point, Sheet, Surface};

/// Keys at the top of a surface file, format 1.
const KEYS: [&str; 12] = [
    "format",
    "name",
    "accuracy",
    "outline",
    "hole",
    "sheet",
    "scatterer",
    "lattice",
    "drive",
    "finger",
    actuator::DEFAULTS,
    "actuator",
];

/// Reads a surface from the text of a surface file in format 1. `file` is the name of the file in messages.
/// An outline from an SVG file is refused, because with the text alone no other file can be read.
///
/// # Errors
/// [`FileFaults`] with all faults of the text, or only the first error of TOML syntax.
///
/// ```
/// let text = r#"
///     format = 1
///     [outline]
///     rectangle_mm = [150, 150]
///     [sheet]
///     material = "BoPET"
///     thickness_mm = 0.125
///     tension_n_per_m = 200
///     decay_time_ms = 70
///     [drive]
///     band_hz = [0, 3000]
///     [[actuator]]
///     at_mm = [12, 31]
/// "#;
/// let surface = unripple_store::parse_surface(text, "film.toml")?;
/// assert_eq!(surface.name, "film");
/// assert_eq!(surface.sheet.thickness, 0.125e-3);
/// # Ok::<(), unripple_store::FileFaults>(())
/// ```
pub fn parse_surface(text: &str, file: &str) -> Result<Surface, FileFaults> {
    parse_surface_with(text, file, &|name| {
        Err(StoreError::content(name, "a surface file on disk, which `svg` is relative to", "text alone"))
    })
}

/// As [`parse_surface`], with `fetch` to return the text of an SVG file that an outline or a hole names.
///
/// # Errors
/// [`FileFaults`] with all faults of the text, or only the first error of TOML syntax.
pub fn parse_surface_with(
    text: &str,
    file: &str,
    fetch: &dyn Fn(&str) -> Result<String, StoreError>,
) -> Result<Surface, FileFaults> {
    document::parse(text, file, &KEYS, |root, name, faults| read(root, name, fetch, faults))
}

fn read(root: &Section, name: Option<String>, fetch: &Fetch, faults: &mut Faults) -> Option<Surface> {
    let table = |key: &str, faults: &mut Faults| {
        root.require(key, &format!("a table [{key}]"), faults).and_then(|entry| entry.section(faults))
    };
    let rim = table("outline", faults).map_or_else(Rim::default, |t| outline::read(&t, fetch, faults));
    let sheet = table("sheet", faults).and_then(|t| sheet::read(&t, faults));
    let emission = table("drive", faults).and_then(|t| emission::read(&t, faults));
    let finger = match root.get("finger") {
        Some(entry) => entry.section(faults).and_then(|t| emission::finger(&t, faults)),
        None => Some(Finger::default()),
    };
    let (holes, sound) = holes(root, &rim, fetch, faults);
    let ground = rim.outline(&holes).map(Ground::new);
    held(&rim, &holes, sheet.as_ref(), faults);
    let bends = sheet.as_ref().is_none_or(|sheet| sheet.young > 0.0);
    let attached = scatterer::read(root, ground.as_ref(), bends, faults);
    let alone = attached.as_ref().map_or(0, |attached| attached.resonators.len());
    let density = sheet.as_ref().map(|sheet| sheet.density * sheet.thickness);
    let under = lattice::Under { ground: ground.as_ref(), density, bends, others: alone };
    let lattices = lattice::read(root, &under, faults);
    let thickness = |at: Point| Some(thickness_at(sheet.as_ref()?, ground.as_ref()?, at));
    let actuators = actuator::read(root, &Base { ground: ground.as_ref(), thickness: &thickness }, faults);
    if let (Some(emission), Some(actuators)) = (&emission, &actuators) {
        emission::carry(root, emission, actuators.len(), faults);
    }
    let accuracy = match root.get("accuracy") {
        Some(entry) => entry.number(&of::ACCURACY, faults).map(Some),
        None => Some(None),
    };
    let mut sheet = sheet?;
    let attached = attached?;
    (sheet.uneven.scatterers, sheet.uneven.resonators) = (attached.scatterers, attached.resonators);
    sheet.uneven.lattices = lattices?;
    Some(Surface {
        name: name?,
        outline: Outline { shape: rim.shape?, edges: rim.edges.filter(|_| sound)?, holes },
        sheet,
        emission: emission?,
        finger: finger?,
        actuators: actuators?,
        accuracy: accuracy?,
    })
}

/// The holes of the file that are without fault, those drawn with the outline first, and whether these are all.
fn holes(root: &Section, rim: &Rim, fetch: &Fetch, faults: &mut Faults) -> (Vec<Hole>, bool) {
    let drawn = rim.holes.iter().map(|hole| Cut {
        hole: hole.clone(),
        key: "outline.svg".into(),
        span: rim.shape_span.clone(),
    });
    let (cuts, whole) = hole::read(root, fetch, faults);
    let cuts: Vec<Cut> = drawn.chain(cuts).collect();
    let Some(good) = apart::check(rim, &cuts, faults) else { return (Vec::new(), false) };
    let sound = whole && good.iter().all(|good| *good);
    let kept = cuts.into_iter().zip(good).filter(|(_, good)| *good);
    (kept.map(|(cut, _)| cut.hole).collect(), sound)
}

/// A fault if nothing keeps the sheet where it is: no edge does, and it has no stiffness.
fn held(rim: &Rim, holes: &[Hole], sheet: Option<&Sheet>, faults: &mut Faults) {
    let Some(outline) = rim.edges.as_ref().and_then(|_| rim.outline(holes)) else { return };
    if !outline.resists_displacement() && sheet.is_some_and(|sheet| sheet.young == 0.0) {
        let found = "no edge fixed and no stiffness: nothing holds the sheet";
        let expected = "an edge that is clamped, supported or on springs with lift_n_per_mm2 above 0, or a sheet with \
                        young_gpa above 0";
        faults.add("outline.edge", rim.edge_span.clone(), found, expected, Some("\"clamped\"".into()));
    }
}

fn thickness_at(sheet: &Sheet, ground: &Ground, at: Point) -> f64 {
    let factor = sheet.uneven.thickness.as_ref().map_or(1.0, |profile| profile.at(at, ground.extent()));
    sheet.thickness * factor
}
