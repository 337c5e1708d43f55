//! Actuators in a surface file.

use super::piezo::{self, PIEZO_KEYS, Spot};
use super::place::Ground;
use super::range::of;
use super::reader::{Faults, Section};
use std::collections::HashMap;
use std::ops::Range;
use unripple_core::{Actuator, ActuatorKind, CoilDrive, Point};

/// Most actuators of a surface.
pub(super) const MOST_ACTUATORS: usize = 4096;

const COMMON_KEYS: [&str; 3] = ["name", "at_mm", "kind"];
const PAD_KEY: &str = "contact_radius_mm";
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

/// What actuators stand on: the sheet's outline, and its thickness in metres at a point of it.
pub(super) struct Base<'b> {
    pub ground: Option<&'b Ground>,
    pub thickness: &'b dyn Fn(Point) -> Option<f64>,
}

/// All actuators of a file, in its order.
pub(super) fn read(root: &Section, base: &Base, faults: &mut Faults) -> Option<Vec<Actuator>> {
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
        .map(|(i, item)| one(&item.section(faults)?, i, base, &mut names, faults))
        .collect();
    read.into_iter().collect()
}

fn one(
    section: &Section,
    index: usize,
    base: &Base,
    names: &mut Names,
    faults: &mut Faults,
) -> Option<Actuator> {
    let kind = section.choice_or("kind", Kind::Force, &KINDS, faults);
    check_keys(section, kind, faults);
    let name = name(section, index, names, faults);
    let at = Ground::read(base.ground, section, faults);
    let kind = kind?;
    let pad = match kind {
        Kind::Force | Kind::MovingMagnet => section.number_or(PAD_KEY, 0.0, &of::PAD_RADIUS, faults),
        Kind::Piezo => Some(0.0),
    };
    let kind = match kind {
        Kind::Force => Some(ActuatorKind::Force),
        Kind::MovingMagnet => magnet(section, faults),
        Kind::Piezo => {
            let place = base.ground.map(Ground::outline).zip(at);
            piezo::read(section, &Spot { thickness: at.and_then(base.thickness), place }, faults)
        }
    };
    Some(Actuator { name: name?, at: at?, kind: kind?, contact_radius: pad? })
}

fn check_keys(section: &Section, kind: Option<Kind>, faults: &mut Faults) {
    let keys: Vec<&str> = match kind {
        Some(Kind::Force) => vec![PAD_KEY],
        Some(Kind::MovingMagnet) => [&[PAD_KEY], &MAGNET_KEYS[..]].concat(),
        Some(Kind::Piezo) => PIEZO_KEYS.to_vec(),
        None => [&[PAD_KEY], &MAGNET_KEYS[..], &PIEZO_KEYS[..]].concat(),
    };
    let elsewhere = |key: &str| match key {
        PAD_KEY => Some("this key only where kind = \"force\" or \"moving-magnet\"".into()),
        key if MAGNET_KEYS.contains(&key) => Some("this key only where kind = \"moving-magnet\"".into()),
        key if PIEZO_KEYS.contains(&key) => Some("this key only where kind = \"piezo\"".into()),
        _ => None,
    };
    section.check_keys(&[&COMMON_KEYS[..], &keys].concat(), elsewhere, faults);
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
