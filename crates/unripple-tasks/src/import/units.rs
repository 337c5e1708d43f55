//! Units by their names, and what they make of values: taken from the file or from options, never guessed.

use super::measured::{Says, Signal};
use super::{Ask, Kind, Per, Quantity};
use crate::TaskError;

/// Standard gravity in m/s², by which accelerations in g are defined.
const GRAVITY: f64 = 9.80665;

/// Lengths by the names of their units, in m.
const LENGTHS: [(&str, f64); 9] = [
    ("m", 1.0),
    ("cm", 1e-2),
    ("mm", 1e-3),
    ("um", 1e-6),
    // The micro sign, and the Greek letter that looks alike.
    ("\u{b5}m", 1e-6),
    ("\u{3bc}m", 1e-6),
    ("nm", 1e-9),
    ("in", 0.0254),
    ("ft", 0.3048),
];

/// References by the names of their units, and SI units in each.
const REFERENCES: [(&str, Per, f64); 8] = [
    ("N", Per::Newton, 1.0),
    ("mN", Per::Newton, 1e-3),
    ("kN", Per::Newton, 1e3),
    ("lbf", Per::Newton, 4.448_221_615_260_5),
    ("V", Per::Volt, 1.0),
    ("mV", Per::Volt, 1e-3),
    ("A", Per::Ampere, 1.0),
    ("mA", Per::Ampere, 1e-3),
];

/// Metres in a unit of length; `None` if its name is not known.
pub(super) fn length(name: &str) -> Option<f64> {
    LENGTHS.iter().find(|(known, _)| *known == name).map(|(_, metres)| *metres)
}

/// The quantity that a unit measures, and SI units in it; `None` if its name is not known. A number before the name multiplies it.
pub(super) fn response(text: &str) -> Option<(Quantity, f64)> {
    let name: String = text.replace("**", "").replace('²', "2");
    let name: String = name.chars().filter(|c| !"^()[] ".contains(*c)).collect();
    // What is before the first letter is a number.
    let letters = name.find(|c: char| c.is_alphabetic())?;
    let (number, unit) = name.split_at(letters);
    // An exponent is no unit.
    let (number, unit) = match unit.strip_prefix('e').filter(|_| !number.is_empty()) {
        Some(rest) => {
            let end = rest.find(|c: char| c.is_alphabetic())?;
            (format!("{number}e{}", &rest[..end]), &rest[end..])
        }
        None => (number.to_owned(), unit),
    };
    let factor = if number.is_empty() { 1.0 } else { number.parse::<f64>().ok()? };
    let (quantity, si) = match unit {
        "g" | "gn" => (Quantity::Acceleration, GRAVITY),
        "mg" => (Quantity::Acceleration, 1e-3 * GRAVITY),
        _ => match unit.split_once('/') {
            None => (Quantity::Displacement, length(unit)?),
            Some((of, "s")) => (Quantity::Velocity, length(of)?),
            Some((of, "s2" | "s/s")) => (Quantity::Acceleration, length(of)?),
            Some(_) => return None,
        },
    };
    (factor.is_finite() && factor != 0.0).then_some((quantity, factor * si))
}

/// What a reference is, and SI units in its unit; `None` if the name is not known.
pub(super) fn reference(name: &str) -> Option<(Per, f64)> {
    REFERENCES.iter().find(|(known, ..)| *known == name).map(|(_, per, si)| (*per, *si))
}

/// The unit that the request names.
fn asked(text: &str) -> Result<(Quantity, f64), TaskError> {
    let expected = "a unit such as m/s, mm/s, um, m/s2 or g, with a number before it or without";
    response(text).ok_or_else(|| TaskError::ask("unit", expected, format!("`{text}`")))
}

/// What responses are, with all units known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Settled {
    /// What the values are.
    pub kind: Kind,
    /// What was measured at the point.
    pub quantity: Quantity,
    /// Unit of the reference.
    pub per: Per,
    /// Factor from the values of the file to SI units per unit of the actuator's drive.
    pub scale: f64,
}

/// Settles what the values of a file are, by the request before the file. `drive` is the unit of the actuator's drive; `from` names the place
/// in the file.
///
/// # Errors
/// [`TaskError::Ask`] with the fields that say what neither the file nor the request says, or what they say differently.
pub(super) fn settle(
    ask: &Ask,
    says: &Says,
    signal: &Signal,
    drive: &str,
    from: &str,
) -> Result<Settled, TaskError> {
    let kind = kind(ask, says, signal, from)?;
    let unit = ask.unit.as_deref().map(asked).transpose()?;
    let named = unit.or(says.unit);
    let quantity = ask.quantity.or(named.map(|(quantity, _)| quantity)).or(says.quantity);
    let si = named.map(|(_, si)| si).or(says.length);
    let per = ask.per.map(|per| (per, 1.0)).or(says.per);
    let (Some(quantity), Some(si), Some((per, reference))) = (quantity, si, per) else {
        return Err(missing(quantity.is_none(), si.is_none(), per.is_none(), from));
    };
    if let Some((of_unit, _)) = named.filter(|(of_unit, _)| *of_unit != quantity) {
        let expected = format!("{}, as its unit says", of_unit.name());
        return Err(TaskError::ask("quantity", expected, format!("{} ({from})", quantity.name())));
    }
    let scale = si / reference / drive_per_reference(ask, per, drive, from)?;
    Ok(Settled { kind, quantity, per, scale })
}

fn kind(ask: &Ask, says: &Says, signal: &Signal, from: &str) -> Result<Kind, TaskError> {
    let in_time = matches!(signal, Signal::Time { .. });
    let expected = match in_time {
        true => "`impulse-responses` or `filters` for values in time",
        false => "`frequency-responses` for values in frequency",
    };
    let kind = ask.kind.or(says.kind).or((!in_time).then_some(Kind::FrequencyResponses));
    match kind {
        Some(kind) if (kind == Kind::FrequencyResponses) != in_time => Ok(kind),
        Some(other) => Err(TaskError::ask("kind", expected, format!("{} ({from})", other.name()))),
        None => Err(TaskError::ask("kind", expected, format!("none, and {from} does not say it"))),
    }
}

/// The error of units that nobody says.
fn missing(quantity: bool, unit: bool, per: bool, from: &str) -> TaskError {
    let (field, expected) = match (quantity, unit, per) {
        (_, true, true) => (
            "unit, per",
            "the unit of what was measured (m/s, mm/s, g…) and that of the reference (newton, volt or ampere)",
        ),
        (_, true, false) => ("unit", "the unit of what was measured: m/s, mm/s, um, m/s2, g…"),
        (true, false, true) => (
            "quantity, per",
            "velocity, displacement or acceleration, and the unit of the reference: newton, volt or ampere",
        ),
        (true, false, false) => ("quantity", "velocity, displacement or acceleration"),
        (false, false, _) => ("per", "the unit of the reference: newton, volt or ampere"),
    };
    TaskError::ask(field, expected, format!("none, and {from} does not say it"))
}

/// Drive in the actuator's own unit for one unit of the reference, 1 where these are the same.
pub(super) fn drive_per_reference(ask: &Ask, per: Per, drive: &str, from: &str) -> Result<f64, TaskError> {
    let field = "drive_per_reference";
    match (ask.drive_per_reference, per.symbol() == drive) {
        (None, true) => Ok(1.0),
        (Some(ratio), false) if ratio.is_finite() && ratio != 0.0 => Ok(ratio),
        (Some(ratio), false) => {
            Err(TaskError::ask(field, format!("a number of {drive}/{}", per.symbol()), ratio))
        }
        (Some(ratio), true) => {
            let expected = format!("none, since drive and reference of {from} are both in {drive}");
            Err(TaskError::ask(field, expected, ratio))
        }
        (None, false) => {
            let symbol = per.symbol();
            let expected =
                format!("how many {drive} one {symbol} makes, since the actuator is driven in {drive}");
            Err(TaskError::ask(field, expected, format!("none, for {from} per {symbol}")))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_known_by_their_names() {
        use Quantity::{Acceleration, Displacement, Velocity};
        for (text, wanted) in [
            ("m/s", Some((Velocity, 1.0))),
            ("mm/s", Some((Velocity, 1e-3))),
            ("0.5 m/s", Some((Velocity, 0.5))),
            ("2e-3 mm/s", Some((Velocity, 2e-6))),
            ("m/s^2", Some((Acceleration, 1.0))),
            ("(m/s**2)", Some((Acceleration, 1.0))),
            ("m/s²", Some((Acceleration, 1.0))),
            ("g", Some((Acceleration, GRAVITY))),
            ("0.1g", Some((Acceleration, 0.1 * GRAVITY))),
            ("um", Some((Displacement, 1e-6))),
            ("\u{b5}m", Some((Displacement, 1e-6))),
            ("2e3 \u{3bc}m/s", Some((Velocity, 2e-3))),
            ("mg", Some((Acceleration, 1e-3 * GRAVITY))),
            ("in/s", Some((Velocity, 0.0254))),
            ("Pa", None),
            ("", None),
            ("0 m", None),
            ("m/N", None),
            ("12", None),
        ] {
            let read = response(text);
            let same = match (read, wanted) {
                (Some((a, x)), Some((b, y))) => a == b && (x - y).abs() <= 1e-12 * y,
                (a, b) => a.is_none() && b.is_none(),
            };
            assert!(same, "{text}: {read:?}");
        }
        assert_eq!(reference("mV"), Some((Per::Volt, 1e-3)));
        assert_eq!(reference("Pa"), None);
    }

    #[test]
    fn what_is_not_said_is_asked_for() {
        let signal = Signal::Time { start: 0.0, step: 1.0, values: vec![0.0] };
        let of = |ask: &Ask| settle(ask, &Says::default(), &signal, "N", "a.csv");
        let field = |ask: &Ask| match of(ask) {
            Err(TaskError::Ask { field, .. }) => field,
            other => panic!("{other:?}"),
        };
        let mut ask = Ask::default();
        assert_eq!(field(&ask), "kind");
        ask.kind = Some(Kind::Filters);
        assert_eq!(field(&ask), "unit, per");
        ask.unit = Some("mm/s".into());
        assert_eq!(field(&ask), "per");
        ask.per = Some(Per::Volt);
        assert_eq!(field(&ask), "drive_per_reference");
        ask.drive_per_reference = Some(2.0);
        let settled = of(&ask).unwrap();
        assert!((settled.scale - 5e-4).abs() < 1e-15, "{settled:?}");
        ask.quantity = Some(Quantity::Displacement);
        assert_eq!(field(&ask), "quantity");
    }
}
