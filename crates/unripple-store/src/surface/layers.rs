//! The tables `[[sheet.layer]]`: a laminate, reduced to one sheet that bends alike.

use super::material::{self, MATERIAL_KEYS, MaterialProperties};
use super::range::{Limits, of};
use super::reader::{Entry, Faults, LONGEST_LINE, Section};
use unripple_core::{Laminate, Layer};

/// The key of the list, and most layers in it: a display has about ten.
pub(super) const LAYER: &str = "layer";
const MOST_LAYERS: usize = 32;

/// The laminate as a material, and its thickness in metres. `sheet` must not say anything of that itself.
pub(super) fn read(entry: &Entry, sheet: &Section, faults: &mut Faults) -> Option<(MaterialProperties, f64)> {
    let alone = MATERIAL_KEYS.iter().chain(&["thickness_mm"]).filter_map(|key| sheet.get(key));
    let mut sound = true;
    for other in alone {
        other.refuse("no such key beside sheet.layer, which says what the sheet is made of", None, faults);
        sound = false;
    }
    let Some(items) = entry.items().filter(|items| items.iter().all(Entry::is_table)) else {
        entry.refuse("a list of tables, each headed [[sheet.layer]]", None, faults);
        return None;
    };
    if items.is_empty() || items.len() > MOST_LAYERS {
        let found = format!("{} layers", items.len());
        faults.add(
            &entry.key,
            entry.span.clone(),
            found,
            format!("1 to {MOST_LAYERS} tables headed [[sheet.layer]]"),
            None,
        );
        return None;
    }
    let layers: Vec<Option<(String, Layer)>> = items.iter().map(|item| layer(item, faults)).collect();
    let (names, layers): (Vec<String>, Vec<Layer>) =
        layers.into_iter().collect::<Option<Vec<_>>>()?.into_iter().unzip();
    let Some(whole) = Laminate::of(&layers) else {
        entry.refuse("a layer with a young_gpa above 0", None, faults);
        return None;
    };
    let Laminate { young, density, poisson, strength, thickness, .. } = whole;
    if !of::THICKNESS.allow(thickness * 1e3) {
        let found = format!("{:.3} mm in all", thickness * 1e3);
        faults.add(&entry.key, entry.span.clone(), found, "layers of at most 100 mm together", None);
        return None;
    }
    let as_one: [(&str, Option<f64>, Limits); 4] = [
        ("young_gpa", Some(young), of::YOUNG),
        ("density_kg_m3", Some(density), of::DENSITY),
        ("poisson_ratio", Some(poisson), of::POISSON),
        ("strength_mpa", strength, of::STRENGTH),
    ];
    for (key, value, limits) in as_one {
        if let Some(value) = value.filter(|value| !limits.hold(*value)) {
            let expected = format!("layers whose {key} as one sheet is {}", limits.expected());
            faults.add(&entry.key, entry.span.clone(), limits.text(value), expected, None);
            sound = false;
        }
    }
    sound.then(|| (MaterialProperties { name: named(&names), young, density, poisson, strength }, thickness))
}

/// What the sheet is made of: the names of its layers, or their number if a line of a file cannot hold the names.
fn named(layers: &[String]) -> String {
    let all = layers.join(" + ");
    if all.len() <= LONGEST_LINE { all } else { format!("laminate of {} layers", layers.len()) }
}

/// One layer, with the name of its material.
fn layer(item: &Entry, faults: &mut Faults) -> Option<(String, Layer)> {
    let section = item.section(faults)?;
    let known = [&MATERIAL_KEYS[..], &["thickness_mm"]].concat();
    section.check_keys(&known, |_| None, faults);
    let made_of = material::read(&section, faults);
    let thickness = section.number("thickness_mm", &of::THICKNESS, faults);
    let MaterialProperties { name, young, density, poisson, strength } = made_of?;
    Some((name, Layer { young, density, poisson, strength, thickness: thickness? }))
}
