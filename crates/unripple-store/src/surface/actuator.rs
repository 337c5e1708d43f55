use super::place;
use super::range::of;
use super::reader::{Entry, Faults, Section};
use std::collections::HashMap;
use std::ops::Range;
use unripple_core::{Actuator, ActuatorKind, CoilDrive, Outline, Point};

/// Most actuators of a surface.
pub(super) const MOST_ACTUATORS: usize = 4096;

const COMMON_KEYS: [&str; 3] = ["name", "at_mm", "kind"];
const MAGNET_KEYS: [&str; 5] =
    ["force_constant_n_per_a", "resistance_ohm", "inductance_mh", "moving_mass_mg", "driven_by"];

/// What an amplifier may hold, and the names.
pub(super) const COIL_DRIVES: [(&str, CoilDrive); 2] =
    [("current", CoilDrive::Current), ("voltage", CoilDrive::Voltage)];

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Force,
    MovingMagnet,
    Piezo,
}

const KINDS: [(&str, Kind); 3] =
    [("force", Kind::Force), ("moving-magnet", Kind::MovingMagnet), ("piezo", Kind::Piezo)];

/// All actuators of a file, in its order.
pub(super) fn read(root: &Section, outline: Option<&Outline>, faults: &mut Faults) -> Option<Vec<Actuator>> {
    let entry = root.get("actuator");
    let items = match &entry {
        Some(entry) => entry.items().or_else(|| {
            entry.refuse("a list of tables, each headed [[actuator]]", None, faults);
            None
        })?,
        None => Vec::new(),
    };
    let expected = format!("1 to {MOST_ACTUATORS} tables headed [[actuator]]");
    if items.is_empty() || items.len() > MOST_ACTUATORS {
        let span = entry.map_or(root.span.clone(), |e| e.span);
        let (found, near) = match items.len() {
            0 => ("no actuators".into(), None),
            many => (format!("{many} actuators"), Some(MOST_ACTUATORS.to_string())),
        };
        faults.add("actuator", span, found, expected, near);
        return None;
    }
    let mut names = Names::default();
    let read: Vec<Option<Actuator>> = items
        .iter()
        .enumerate()
        .map(|(i, item)| one(&item.section(faults)?, i, outline, &mut names, faults))
        .collect();
    read.into_iter().collect()
}

fn one(
    section: &Section,
    index: usize,
    outline: Option<&Outline>,
    names: &mut Names,
    faults: &mut Faults,
) -> Option<Actuator> {
    let kind = section.choice_or("kind", Kind::Force, &KINDS, faults);
    let keys: &[&str] =
        if kind == Some(Kind::Force) || kind == Some(Kind::Piezo) { &[] } else { &MAGNET_KEYS };
    let known: Vec<&str> = COMMON_KEYS.iter().chain(keys).copied().collect();
    let elsewhere =
        |key: &str| MAGNET_KEYS.contains(&key).then(|| "this key only where kind = \"moving-magnet\"".into());
    section.check_keys(&known, elsewhere, faults);
    let name = name(section, index, names, faults);
    let at = at(section, outline, faults);
    let kind = match kind? {
        Kind::Force => Some(ActuatorKind::Force),
        Kind::Piezo => Some(ActuatorKind::Piezo),
        Kind::MovingMagnet => magnet(section, faults),
    };
    Some(Actuator { name: name?, at: at?, kind: kind? })
}

/// Names taken so far, and by which actuator.
#[derive(Default)]
struct Names(HashMap<String, usize>);

fn name(section: &Section, index: usize, names: &mut Names, faults: &mut Faults) -> Option<String> {
    let entry = section.get("name");
    let name = match &entry {
        Some(entry) => entry.line("a name", faults)?,
        None => format!("a{}", index + 1),
    };
    let Some(first) = names.0.get(&name) else {
        names.0.insert(name.clone(), index);
        return Some(name);
    };
    let span: Range<usize> = entry.map_or(section.span.clone(), |e| e.span);
    let found = format!("\"{name}\", which is also the name of actuator[{first}]");
    faults.add(&format!("{}.name", section.key), span, found, "a name of its own", None);
    None
}

fn at(section: &Section, outline: Option<&Outline>, faults: &mut Faults) -> Option<Point> {
    let shape = "[x, y] in mm";
    let entry: Entry = section.require("at_mm", shape, faults)?;
    let [x, y] = entry.numbers(&of::COORDINATE, shape, faults)?;
    let point = Point::new(x, y);
    // With no outline to judge by, that the outline is at fault has been said already.
    let Some(outline) = outline else { return Some(point) };
    if outline.contains(point) {
        return Some(point);
    }
    let rim = place::nearest_on_rim(outline, point);
    let (width, height) = outline.extent();
    let expected = format!(
        "a point inside the outline, which spans {:.4} x {:.4} mm and is {:.3} mm away",
        width * 1e3,
        height * 1e3,
        point.distance(rim) * 1e3
    );
    let nearest = if faults.are_plenty() { None } else { place::nearest_legal(outline, rim) };
    entry.refuse(expected, nearest, faults);
    None
}

fn magnet(section: &Section, faults: &mut Faults) -> Option<ActuatorKind> {
    let force_constant = section.number(MAGNET_KEYS[0], &of::FORCE_CONSTANT, faults);
    let resistance = section.number(MAGNET_KEYS[1], &of::RESISTANCE, faults);
    let inductance = section.number_or(MAGNET_KEYS[2], 0.0, &of::INDUCTANCE, faults);
    let moving_mass = section.number_or(MAGNET_KEYS[3], 0.0, &of::MOVING_MASS, faults);
    let driven_by = section.choice_or(MAGNET_KEYS[4], CoilDrive::Current, &COIL_DRIVES, faults);
    Some(ActuatorKind::MovingMagnet {
        force_constant: force_constant?,
        resistance: resistance?,
        inductance: inductance?,
        moving_mass: moving_mass?,
        driven_by: driven_by?,
    })
}
