use super::range::of;
use super::reader::{Entry, Faults, Section};
use crate::names::nearest;
use unripple_core::{Air, Decay, MATERIALS, Material, Sheet};

const KEYS: [&str; 10] = [
    "material",
    "young_gpa",
    "density_kg_m3",
    "poisson_ratio",
    "strength_mpa",
    "thickness_mm",
    "tension_n_per_m",
    "decay_time_ms",
    "loss_factor",
    "air",
];

/// The air conditions and their names.
pub(super) const AIRS: [(&str, Air); 3] =
    [("none", Air::None), ("one-side", Air::OneSide), ("both-sides", Air::BothSides)];

pub(super) fn read(section: &Section, faults: &mut Faults) -> Option<Sheet> {
    section.check_keys(&KEYS, |_| None, faults);
    let made_of = material(section, faults);
    let thickness = section.number("thickness_mm", &of::THICKNESS, faults);
    let tension = section.number_or("tension_n_per_m", 0.0, &of::TENSION, faults);
    let decay = decay(section, faults);
    let air = section.choice_or("air", Air::None, &AIRS, faults);
    if let (Some(stuff), Some(0.0)) = (&made_of, tension)
        && stuff.young == 0.0
    {
        let span = section.get("tension_n_per_m").map_or(section.span.clone(), |entry| entry.span);
        let expected = "a positive tension_n_per_m or young_gpa: nothing else pulls the sheet back";
        faults.add("sheet.tension_n_per_m", span, "neither tension nor stiffness", expected, None);
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
    })
}

/// What the sheet is made of, overrides included.
struct Stuff {
    name: String,
    young: f64,
    density: f64,
    poisson: f64,
    strength: Option<f64>,
}

fn material(section: &Section, faults: &mut Faults) -> Option<Stuff> {
    let given = section.get("material");
    let name = given.as_ref().and_then(|entry| entry.line("the name of a material", faults));
    let known = name.as_deref().and_then(Material::named);
    let complete = ["young_gpa", "density_kg_m3", "poisson_ratio"].iter().all(|k| section.get(k).is_some());
    let unknown = given.is_some() && (name.is_none() || (known.is_none() && !complete));
    if let (Some(entry), Some(name), true) = (&given, &name, unknown) {
        refuse_material(entry, name, faults);
    }
    let mut number = |key, limits, of_material: fn(&Material) -> f64| match known {
        Some(m) => section.number_or(key, of_material(m), limits, faults),
        // One fault for the name is enough.
        None if unknown => section.number_or(key, 0.0, limits, faults),
        None => section.number(key, limits, faults),
    };
    let young = number("young_gpa", &of::YOUNG, |m| m.young);
    let density = number("density_kg_m3", &of::DENSITY, |m| m.density);
    let poisson = number("poisson_ratio", &of::POISSON, |m| m.poisson);
    let strength = match section.get("strength_mpa") {
        Some(entry) => entry.number(&of::STRENGTH, faults).map(Some),
        None => Some(known.map(|m| m.strength)),
    };
    if unknown {
        return None;
    }
    let name = known.map(|m| m.name.to_owned()).or(name).unwrap_or_else(|| "custom".into());
    Some(Stuff { name, young: young?, density: density?, poisson: poisson?, strength: strength? })
}

fn refuse_material(entry: &Entry, name: &str, faults: &mut Faults) {
    let names: Vec<&str> = MATERIALS.iter().map(|m| m.name).collect();
    let near = nearest(name, names.iter().copied()).map(|n| format!("\"{n}\""));
    let expected = format!(
        "one of {}, or young_gpa, density_kg_m3 and poisson_ratio beside a name of your own",
        names.join(", ")
    );
    entry.refuse(expected, near, faults);
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
