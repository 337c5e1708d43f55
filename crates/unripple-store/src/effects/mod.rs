//! Files of effects, format 1.

mod builtin;
mod curve;
mod import;
mod kind;
mod level;
mod load;
mod path;
mod range;
mod region;
mod score;
mod write;

pub use builtin::{BuiltinEffects, builtin_effect, builtin_effects};
pub use import::import_haptic;
pub use load::{effect_files, load_effects};
pub use write::effects_to_toml;

use crate::document;
use crate::fault::{Fault, FileFaults};
use crate::names::nearest;
use crate::surface::reader::{Entry, Faults, Section};
use std::collections::HashMap;
use unripple_effects::{Effect, EffectSet, Kind, Region, limits};

/// Keys at the top of a file of effects.
const KEYS: [&str; 4] = ["format", "name", "about", "effect"];
/// Keys that every effect may have, whatever its kind.
const COMMON: [&str; 5] = ["kind", "name", "region", "gain", "felt_db"];

/// The JSON schema (draft 2020-12) of a file of effects, for editors: it describes the TOML file read as JSON.
pub const EFFECTS_SCHEMA: &str = include_str!("../../schema/effects-1.json");

/// Reads effects from the text of a file of effects in format 1. `file` is the name of the file in messages.
///
/// # Errors
/// [`FileFaults`] with all faults of the text, or only the first error of TOML syntax.
///
/// ```
/// let text = r#"
///     format = 1
///     [[effect]]
///     kind = "texture"
///     every_mm = 2
///     felt_db = 20
/// "#;
/// let set = unripple_store::parse_effects(text, "grooves.toml")?;
/// assert_eq!((set.name.as_str(), set.effects.len()), ("grooves", 1));
/// let faults = unripple_store::parse_effects(&text.replace("every", "evry"), "grooves.toml").unwrap_err();
/// assert_eq!(faults.faults()[1].nearest.as_deref(), Some("every_mm"));
/// # Ok::<(), unripple_store::FileFaults>(())
/// ```
pub fn parse_effects(text: &str, file: &str) -> Result<EffectSet, FileFaults> {
    let set = document::parse(text, file, &KEYS, read)?;
    match set.check() {
        Ok(()) => Ok(set),
        // What only the whole set can tell, as the length of its waveforms together.
        Err(error) => Err(FileFaults::new(file, text, vec![of_set(&error.to_string())])),
    }
}

fn of_set(found: &str) -> Fault {
    Fault {
        key: "effect".into(),
        line: 0,
        column: 0,
        found: found.into(),
        expected: "effects within their limits together".into(),
        nearest: None,
        span: 0..0,
    }
}

fn read(root: &Section, name: Option<String>, faults: &mut Faults) -> Option<EffectSet> {
    let about = match root.get("about") {
        Some(entry) => entry.line("what it is like", faults),
        None => Some(String::new()),
    };
    let effects = effects(root, faults);
    Some(EffectSet { name: name?, about: about?, effects: effects? })
}

fn effects(root: &Section, faults: &mut Faults) -> Option<Vec<Effect>> {
    let most = limits::MOST_EFFECTS;
    let expected = format!("1 to {most} tables headed [[effect]]");
    let items = root.require("effect", &expected, faults)?;
    let Some(items) = items.items().filter(|items| (1..=most).contains(&items.len())) else {
        items.refuse(expected, None, faults);
        return None;
    };
    let mut names = HashMap::new();
    let read: Vec<Option<Effect>> = items
        .iter()
        .enumerate()
        .map(|(i, item)| one(&item.section(faults)?, i, &mut names, faults))
        .collect();
    read.into_iter().collect()
}

fn one(
    section: &Section,
    index: usize,
    names: &mut HashMap<String, usize>,
    faults: &mut Faults,
) -> Option<Effect> {
    let expected = kind::NAMES.map(|name| format!("\"{name}\"")).join(" or ");
    let kind_entry = section.require("kind", &expected, faults);
    let known = kind_entry.as_ref().and_then(|entry| known_kind(entry, &expected, faults));
    check_keys(section, known, faults);
    let region = match section.get("region") {
        Some(entry) => entry.section(faults).and_then(|table| region::read(&table, faults)),
        None => Some(Region::Everywhere),
    };
    let level = level::read(section, faults);
    let kind = known.and_then(|name| kind::read(name, section, faults));
    if let Some(Kind::Edge(edge)) = &kind
        && edge.line.is_none()
        && section.get("region").is_none()
    {
        let expected = "line_mm, or a region whose border is felt";
        faults.add(&section.key, section.span.clone(), "an edge without a place", expected, None);
    }
    let name = name(section, index, known.unwrap_or("effect"), names, faults);
    Some(Effect { name: name?, region: region?, level: level?, kind: kind? })
}

fn known_kind(entry: &Entry, expected: &str, faults: &mut Faults) -> Option<&'static str> {
    let choices = kind::NAMES.map(|name| (name, name));
    if entry.is_text() {
        return entry.choice(&choices, faults);
    }
    entry.refuse(expected, None, faults);
    None
}

/// Refuses keys that the kind does not have, and says which kind does.
fn check_keys(section: &Section, known: Option<&'static str>, faults: &mut Faults) {
    let of = |name: &str| kind::keys(name).to_vec();
    let own = match known {
        Some(name) => of(name),
        None => kind::NAMES.iter().flat_map(|name| of(name)).collect(),
    };
    let elsewhere = |key: &str| {
        let kinds = kind::NAMES.iter().filter(|name| kind::keys(name).contains(&key));
        let kinds: Vec<String> = kinds.map(|name| format!("kind = \"{name}\"")).collect();
        (!kinds.is_empty()).then(|| format!("this key only where {}", kinds.join(" or ")))
    };
    section.check_keys(&[&COMMON[..], &own].concat(), elsewhere, faults);
}

fn name(
    section: &Section,
    index: usize,
    kind: &str,
    names: &mut HashMap<String, usize>,
    faults: &mut Faults,
) -> Option<String> {
    let entry = section.get("name");
    let name = match &entry {
        Some(entry) => entry.line("a name", faults)?,
        None => format!("{kind}-{}", index + 1),
    };
    let Some(first) = names.get(&name) else {
        names.insert(name.clone(), index);
        return Some(name);
    };
    let span = entry.map_or(section.span.clone(), |entry| entry.span);
    let found = format!("\"{name}\", which is also the name of effect[{first}]");
    faults.add(&format!("{}.name", section.key), span, found, "a unique name", None);
    None
}

/// "(nearest: …)" for a name among others, or nothing.
fn near(found: &str, known: &[&str]) -> String {
    nearest(found, known.iter().copied()).map_or_else(String::new, |name| format!(" (nearest: {name})"))
}
