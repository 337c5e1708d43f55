//! The table `[sheet]`.

use super::grain::{self, GRAIN_KEYS};
use super::layers::{self, LAYER};
use super::material::{self, MATERIAL_KEYS, MaterialProperties};
use super::profile;
use super::range::{Limits, of};
use super::reader::{Entry, Faults, Section};
use unripple_core::{Air, Decay, Profile, Sheet, Uneven};

/// Keys of the table `[sheet]` itself, and those of quantities that vary over it.
const KEYS: [&str; 5] = ["thickness_mm", "tension_n_per_m", "decay_time_ms", "loss_factor", "air"];
const UNEVEN_KEYS: [&str; 3] = ["thickness_profile", "tension_profile", "added_mass_kg_m2"];

/// Whether air loads the sheet and on how many sides, by the names in files.
pub(super) const AIRS: [(&str, Air); 3] =
    [("none", Air::None), ("one-side", Air::OneSide), ("both-sides", Air::BothSides)];

/// The table `[sheet]`, but for scatterers.
pub(super) fn read(section: &Section, faults: &mut Faults) -> Option<Sheet> {
    let known = [&MATERIAL_KEYS[..], &GRAIN_KEYS, &KEYS, &UNEVEN_KEYS, &[LAYER]].concat();
    section.check_keys(&known, |_| None, faults);
    let (made_of, thickness) = match section.get(LAYER) {
        Some(layers) => layers::read(&layers, section, faults).unzip(),
        None => (material::read(section, faults), section.number("thickness_mm", &of::THICKNESS, faults)),
    };
    let grain = grain::read(section, made_of.as_ref(), faults);
    let tension = section.number_or("tension_n_per_m", 0.0, &of::TENSION, faults);
    let decay = decay(section, faults);
    let air = section.choice_or("air", Air::None, &AIRS, faults);
    let thickness_profile = profile(section, UNEVEN_KEYS[0], &of::THICKNESS_FACTOR, faults);
    let tension_profile = profile(section, UNEVEN_KEYS[1], &of::TENSION_FACTOR, faults);
    let added_mass = match section.get(UNEVEN_KEYS[2]) {
        Some(entry) => profile::read_or_number(&entry, &of::ADDED_MASS, faults).map(Some),
        None => Some(None),
    };
    if let (Some(stuff), Some(tension), Some(profile)) = (&made_of, tension, &tension_profile) {
        pulled_back(section, stuff, tension, profile.as_ref(), faults);
    }
    if let Some(stuff) = &made_of {
        damped(section, stuff, faults);
    }
    let stuff = made_of?;
    Some(Sheet {
        material: stuff.name,
        young: stuff.young,
        density: stuff.density,
        poisson: stuff.poisson,
        strength: stuff.strength,
        thickness: thickness?,
        tension: tension?,
        decay: decay?,
        air: air?,
        uneven: Uneven {
            grain: grain?,
            thickness: thickness_profile?,
            tension: tension_profile?,
            added_mass: added_mass?,
            scatterers: Vec::new(),
            resonators: Vec::new(),
            lattices: Vec::new(),
        },
    })
}

fn profile(section: &Section, key: &str, limits: &Limits, faults: &mut Faults) -> Option<Option<Profile>> {
    match section.get(key) {
        Some(entry) => profile::read(&entry, limits, faults).map(Some),
        None => Some(None),
    }
}

/// A fault if neither tension nor stiffness pulls the sheet back, be it only in places.
fn pulled_back(
    section: &Section,
    stuff: &MaterialProperties,
    tension: f64,
    profile: Option<&Profile>,
    faults: &mut Faults,
) {
    if stuff.young > 0.0 {
        return;
    }
    if tension == 0.0 {
        let span = section.get("tension_n_per_m").map_or(section.span.clone(), |entry| entry.span);
        let expected = "a positive tension_n_per_m or young_gpa: nothing else pulls the sheet back";
        faults.add("sheet.tension_n_per_m", span, "neither tension nor stiffness", expected, None);
    } else if let (Some(entry), Some(profile)) = (section.get(UNEVEN_KEYS[1]), profile)
        && profile.range().0 == 0.0
    {
        let expected =
            "positive factors of tension, or a positive young_gpa: nothing else pulls the sheet back there";
        faults.add(&entry.key, entry.span, "places with neither tension nor stiffness", expected, None);
    }
}

/// A fault if a sheet without stiffness has a loss factor, which is that of bending.
fn damped(section: &Section, stuff: &MaterialProperties, faults: &mut Faults) {
    if let (Some(factor), None) = (section.get("loss_factor"), section.get("decay_time_ms"))
        && stuff.young == 0.0
    {
        let expected = "decay_time_ms, or a positive young_gpa: a loss factor is that of bending, which is all that it damps";
        factor.refuse(expected, None, faults);
    }
}

fn decay(section: &Section, faults: &mut Faults) -> Option<Decay> {
    match (section.get("decay_time_ms"), section.get("loss_factor")) {
        (Some(time), None) => decay_time(&time, faults),
        (None, Some(factor)) => factor.number(&of::LOSS_FACTOR, faults).map(Decay::LossFactor),
        (None, None) => {
            let expected = "one of decay_time_ms, loss_factor";
            faults.add("sheet.decay_time_ms", section.span.clone(), "no such key", expected, None);
            None
        }
        (Some(_), Some(second)) => {
            let found = "decay_time_ms and loss_factor";
            faults.add(&second.key, second.span, found, "exactly one of them", None);
            None
        }
    }
}

fn decay_time(entry: &Entry, faults: &mut Faults) -> Option<Decay> {
    let Some(rows) = entry.items() else {
        return entry.number(&of::DECAY_TIME, faults).map(Decay::Time);
    };
    if rows.is_empty() {
        entry.refuse("a number of ms, or a table [[Hz, ms], …] of at least one row", None, faults);
        return None;
    }
    let read: Vec<Option<(f64, f64)>> = rows.iter().map(|row| decay_row(row, faults)).collect();
    let table = read.into_iter().collect::<Option<Vec<_>>>()?;
    for (pair, row) in table.windows(2).zip(&rows[1..]) {
        if pair[1].0 <= pair[0].0 {
            row.refuse(format!("frequencies that ascend, so more than {} Hz here", pair[0].0), None, faults);
            return None;
        }
    }
    Some(Decay::Table(table))
}

fn decay_row(row: &Entry, faults: &mut Faults) -> Option<(f64, f64)> {
    let Some([frequency, time]) = row.items().and_then(|items| <[Entry; 2]>::try_from(items).ok()) else {
        row.refuse("[Hz, ms]", None, faults);
        return None;
    };
    let frequency = frequency.number(&of::FREQUENCY, faults);
    let time = time.number(&of::DECAY_TIME, faults);
    Some((frequency?, time?))
}
