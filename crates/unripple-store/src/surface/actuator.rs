//! Actuators in a surface file.

use super::piezo::{self, PIEZO_KEYS, Spot};
use super::place::Ground;
use super::places::{self, MOST_ACTUATORS, PLACE_KEYS, Places};
use super::range::of;
use super::reader::{Faults, LONGEST_LINE, Section};
use super::suspension::{self, SUSPENSION_KEYS, Suspension};
use std::collections::HashMap;
use std::ops::Range;
use unripple_core::{Actuator, ActuatorKind, CoilDrive, Point};

/// Name of the table with values for the keys that tables `[[actuator]]` leave out.
pub(super) const DEFAULTS: &str = "actuator_defaults";

/// Keys of the table `[[actuator]]`: of all kinds, of those that press on a disc, and of those with a coil.
const COMMON_KEYS: [&str; 2] = ["name", "kind"];
const PAD_KEY: &str = "contact_radius_mm";
const COIL_KEYS: [&str; 5] =
    ["force_constant_n_per_a", "resistance_ohm", "inductance_mh", "moving_mass_mg", "driven_by"];

/// What an amplifier may keep to the signal, current or voltage, by its name in files.
pub(super) const COIL_DRIVES: [(&str, CoilDrive); 2] =
    [("current", CoilDrive::Current), ("voltage", CoilDrive::Voltage)];

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Force,
    MovingMagnet,
    Exciter,
    Piezo,
}

/// The kinds of actuators, by their names in files.
const KINDS: [(&str, Kind); 4] = [
    ("force", Kind::Force),
    ("moving-magnet", Kind::MovingMagnet),
    ("exciter", Kind::Exciter),
    ("piezo", Kind::Piezo),
];

/// The sheet under the actuators: its outline, and its thickness in metres at a point of it.
pub(super) struct Base<'b> {
    /// The sheet and its holes; nothing if they are at fault.
    pub ground: Option<&'b Ground>,
    /// Thickness of the sheet in metres at a point; nothing where it is not known.
    pub thickness: &'b dyn Fn(Point) -> Option<f64>,
}

/// All actuators of a file, in its order.
pub(super) fn read(root: &Section, base: &Base, faults: &mut Faults) -> Option<Vec<Actuator>> {
    let defaults = root.get(DEFAULTS).and_then(|entry| entry.section(faults));
    defaults.iter().for_each(|defaults| check_defaults(defaults, faults));
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
    let (mut actuators, mut whole, mut channel) = (Vec::new(), true, 0);
    for (index, item) in items.iter().enumerate() {
        let section = item.section(faults).map(|section| section.with_defaults(defaults.as_ref()));
        let made =
            section.and_then(|section| table(&section, Numbers { index, channel }, base, &mut names, faults));
        channel += made.as_ref().map_or(1, Vec::len);
        if channel > MOST_ACTUATORS {
            item.refuse(format!("at most {MOST_ACTUATORS} actuators in all"), None, faults);
            return None;
        }
        whole &= made.is_some();
        actuators.extend(made.into_iter().flatten());
    }
    let still = |actuator: &Actuator| matches!(actuator.kind, ActuatorKind::Piezo { moment: 0.0, .. });
    if whole && actuators.iter().all(still) {
        let span = entry.map_or(root.span.clone(), |e| e.span);
        let found = "patches without a moment alone";
        faults.add("actuator", span, found, "an actuator that moves the sheet", None);
        return None;
    }
    whole.then_some(actuators)
}

/// Refuses keys that no actuator has, and those that are of one actuator alone.
fn check_defaults(defaults: &Section, faults: &mut Faults) {
    let known = [&["kind", PAD_KEY], &COIL_KEYS[..], &SUSPENSION_KEYS, &PIEZO_KEYS].concat();
    let own = |key: &str| {
        let own = key == "name" || PLACE_KEYS.contains(&key);
        own.then(|| "this key in a table [[actuator]], since it is of one actuator alone".into())
    };
    defaults.check_keys(&known, own, faults);
}

/// Index of a table in the file, and of the channel of its first actuator.
#[derive(Clone, Copy)]
struct Numbers {
    index: usize,
    channel: usize,
}

/// The actuators of one table: one, or several in a row, round a ring or on a grid.
fn table(
    section: &Section,
    numbers: Numbers,
    base: &Base,
    names: &mut Names,
    faults: &mut Faults,
) -> Option<Vec<Actuator>> {
    let kind = section.choice_or("kind", Kind::Force, &KINDS, faults);
    check_keys(section, kind, faults);
    let named = Named::read(section, numbers, faults);
    let places = places::read(section, base.ground, faults);
    // Where the places are at fault, the rest is read once, for its own faults.
    let several = places.as_ref().is_some_and(Places::are_several);
    let count = places.as_ref().map_or(1, |places| places.at.len());
    let named = named.filter(|named| !several || named.leaves_room(count, faults));
    let at: Vec<Option<Point>> =
        places.map_or(vec![None], |places| places.at.into_iter().map(Some).collect());
    let made: Vec<Option<Actuator>> = at
        .into_iter()
        .enumerate()
        .map(|(i, at)| {
            let name = named.as_ref().and_then(|named| names.take(named, several.then_some(i), faults));
            one(section, kind, (name, at), base, faults)
        })
        .collect();
    made.into_iter().collect()
}

/// One actuator, of which name and place are known.
fn one(
    section: &Section,
    kind: Option<Kind>,
    (name, at): (Option<String>, Option<Point>),
    base: &Base,
    faults: &mut Faults,
) -> Option<Actuator> {
    let kind = kind?;
    let pad = match kind {
        Kind::Force | Kind::MovingMagnet | Kind::Exciter => {
            section.number_or(PAD_KEY, 0.0, &of::PAD_RADIUS, faults)
        }
        Kind::Piezo => Some(0.0),
    };
    let kind = match kind {
        Kind::Force => Some(ActuatorKind::Force),
        Kind::MovingMagnet => magnet(section, faults),
        Kind::Exciter => exciter(section, faults),
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
        Some(Kind::MovingMagnet) => [&[PAD_KEY], &COIL_KEYS[..]].concat(),
        Some(Kind::Exciter) => [&[PAD_KEY], &COIL_KEYS[..], &SUSPENSION_KEYS].concat(),
        Some(Kind::Piezo) => PIEZO_KEYS.to_vec(),
        None => [&[PAD_KEY], &COIL_KEYS[..], &SUSPENSION_KEYS, &PIEZO_KEYS].concat(),
    };
    let elsewhere = |key: &str| match key {
        PAD_KEY => Some("this key only where kind = \"force\" or \"moving-magnet\" or \"exciter\"".into()),
        key if COIL_KEYS.contains(&key) => {
            Some("this key only where kind = \"moving-magnet\" or \"exciter\"".into())
        }
        key if SUSPENSION_KEYS.contains(&key) => Some("this key only where kind = \"exciter\"".into()),
        key if PIEZO_KEYS.contains(&key) => Some("this key only where kind = \"piezo\"".into()),
        _ => None,
    };
    section.check_keys(&[&COMMON_KEYS[..], &PLACE_KEYS, &keys].concat(), elsewhere, faults);
}

/// What a table gives for the names of its actuators.
struct Named {
    /// The name as it stands in the file; without one, actuators are called by their channels.
    given: Option<String>,
    key: String,
    span: Range<usize>,
    numbers: Numbers,
}

impl Named {
    fn read(section: &Section, numbers: Numbers, faults: &mut Faults) -> Option<Self> {
        let entry = section.get("name");
        let given = match &entry {
            Some(entry) => Some(entry.line("a name", faults)?),
            None => None,
        };
        let span = entry.map_or(section.span.clone(), |e| e.span);
        Some(Self { given, key: format!("{}.name", section.key), span, numbers })
    }

    /// The name of its only actuator, or of one of several.
    fn of(&self, which: Option<usize>) -> String {
        match (&self.given, which) {
            (Some(name), None) => name.clone(),
            (Some(name), Some(which)) => format!("{name}-{}", which + 1),
            (None, which) => format!("a{}", self.numbers.channel + which.unwrap_or(0) + 1),
        }
    }

    /// Whether the names of `count` actuators, numbered, are short enough for a file, or a fault.
    fn leaves_room(&self, count: usize, faults: &mut Faults) -> bool {
        let longest = self.of(Some(count.saturating_sub(1))).len();
        if longest > LONGEST_LINE {
            let expected =
                format!("a name of at most {LONGEST_LINE} bytes with the numbers of its actuators");
            faults.add(&self.key, self.span.clone(), format!("{longest} bytes"), expected, None);
        }
        longest <= LONGEST_LINE
    }
}

/// Names taken so far, and by which table.
#[derive(Default)]
struct Names(HashMap<String, usize>);

impl Names {
    /// Takes a name for an actuator, or a fault if another has it.
    fn take(&mut self, named: &Named, which: Option<usize>, faults: &mut Faults) -> Option<String> {
        let name = named.of(which);
        let Some(first) = self.0.get(&name) else {
            self.0.insert(name.clone(), named.numbers.index);
            return Some(name);
        };
        let found = format!("\"{name}\", which is also the name of actuator[{first}]");
        faults.add(&named.key, named.span.clone(), found, "a unique name", None);
        None
    }
}

/// A coil, and the mass that moves with the sheet.
struct Coil {
    force_constant: f64,
    resistance: f64,
    inductance: f64,
    moving_mass: f64,
    driven_by: CoilDrive,
}

fn coil(section: &Section, faults: &mut Faults) -> Option<Coil> {
    let force_constant = section.number(COIL_KEYS[0], &of::FORCE_CONSTANT, faults);
    let resistance = section.number(COIL_KEYS[1], &of::RESISTANCE, faults);
    let inductance = section.number_or(COIL_KEYS[2], 0.0, &of::INDUCTANCE, faults);
    let moving_mass = section.number_or(COIL_KEYS[3], 0.0, &of::MOVING_MASS, faults);
    let driven_by = section.choice_or(COIL_KEYS[4], CoilDrive::Current, &COIL_DRIVES, faults);
    Some(Coil {
        force_constant: force_constant?,
        resistance: resistance?,
        inductance: inductance?,
        moving_mass: moving_mass?,
        driven_by: driven_by?,
    })
}

fn magnet(section: &Section, faults: &mut Faults) -> Option<ActuatorKind> {
    let Coil { force_constant, resistance, inductance, moving_mass, driven_by } = coil(section, faults)?;
    Some(ActuatorKind::MovingMagnet { force_constant, resistance, inductance, moving_mass, driven_by })
}

fn exciter(section: &Section, faults: &mut Faults) -> Option<ActuatorKind> {
    // Both are read before either is missed, for the faults of both.
    let (coil, suspension) = (coil(section, faults), suspension::read(section, faults));
    let Coil { force_constant, resistance, inductance, moving_mass, driven_by } = coil?;
    let Suspension { housing_mass, resonance, quality_factor } = suspension?;
    Some(ActuatorKind::Exciter {
        force_constant,
        resistance,
        inductance,
        moving_mass,
        housing_mass,
        resonance,
        quality_factor,
        driven_by,
    })
}
