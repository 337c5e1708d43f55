//! Responses and modes from universal files.

use super::found::Found;
use super::labels::Labels;
use super::measured::{Complex, Measured, Says, Signal, Who};
use super::uff_nodes::{Nodes, Units};
use super::{Kind, Per, Quantity, uff_modes, units};
use crate::TaskError;
use unripple_exchange::{Axis, Dof, Function, read_uff};

/// Numbers of quantities in universal files.
const DISPLACEMENT: i64 = 8;
const VELOCITY: i64 = 11;
const ACCELERATION: i64 = 12;
const FORCES: [i64; 2] = [9, 13];
const FREQUENCY: i64 = 18;

/// Numbers of kinds of functions.
const UNKNOWN: i64 = 0;
const TIME_RESPONSE: i64 = 1;
const FREQUENCY_RESPONSE: i64 = 4;
const FILTER: i64 = 25;

/// The direction normal to the sheet, z, and that of a scalar.
const NORMAL: i64 = 3;
const SCALAR: i64 = 0;

/// Reads a universal file.
pub(super) fn read(bytes: &[u8], file: &str, labels: &Labels, found: &mut Found) -> Result<(), TaskError> {
    let uff = read_uff(bytes, file).map_err(TaskError::input)?;
    let nodes = Nodes::of(&uff, file, labels)?;
    let (mut kinds, mut directions) = (0, 0);
    for function in &uff.functions {
        let kind = match function.kind {
            FREQUENCY_RESPONSE => Some(Kind::FrequencyResponses),
            FILTER => Some(Kind::Filters),
            UNKNOWN | TIME_RESPONSE => None,
            // Coherences, power spectra and the like.
            _ => {
                kinds += 1;
                continue;
            }
        };
        let Some(sign) = normal(&function.response).zip(normal(&function.reference)).map(|(a, b)| a * b)
        else {
            directions += 1;
            continue;
        };
        found.responses.push(measured(function, kind, sign, file, &nodes, labels)?);
    }
    for (count, why) in
        [(kinds, "functions of other kinds"), (directions, "functions in other directions than z")]
    {
        if count > 0 {
            found.left_out.push(format!("{file}: {count} {why}"));
        }
    }
    if !uff.modes.is_empty() {
        found.modes.push(uff_modes::of_file(&uff, file, &nodes)?);
    }
    if uff.functions.is_empty() && uff.modes.is_empty() {
        let others: Vec<&str> = uff.others.keys().map(String::as_str).collect();
        let others = if others.is_empty() { "none".into() } else { others.join(", ") };
        return Err(TaskError::Input(format!("{file}: expected datasets 58, 58b or 55, found {others}")));
    }
    Ok(())
}

/// 1 for a direction along z or a scalar, -1 against z; `None` for others.
fn normal(dof: &Dof) -> Option<f64> {
    match dof.direction {
        NORMAL | SCALAR => Some(1.0),
        _ if dof.direction == -NORMAL => Some(-1.0),
        _ => None,
    }
}

fn measured(
    function: &Function,
    kind: Option<Kind>,
    sign: f64,
    file: &str,
    nodes: &Nodes<'_>,
    labels: &Labels,
) -> Result<Measured, TaskError> {
    let from = format!("{file}: dataset {}", function.dataset);
    let unit = &function.numerator.unit;
    // What a label means that is not understood is not what dataset 164 says.
    if !unit.is_empty() && !labels.have_unit() && units::response(unit).is_none() {
        let expected = "the unit of what was measured, such as m/s, mm/s, um, m/s2 or g";
        return Err(TaskError::ask("unit", expected, format!("none, and the label `{unit}` ({from})")));
    }
    let refused =
        |expected: &str, found: &str| TaskError::Input(format!("{from}: expected {expected}, found {found}"));
    let (start, step) = (function.start, function.step);
    let in_frequency = function.abscissa.quantity == FREQUENCY || kind == Some(Kind::FrequencyResponses);
    let signal = match (in_frequency, function.complex) {
        (true, true) => {
            let pairs = function.values.as_chunks::<2>().0.iter();
            let values = pairs.map(|[re, im]| Complex::new(*re, *im)).collect();
            Signal::Frequency { start, step, values }
        }
        (false, false) => Signal::Time { start, step, values: function.values.clone() },
        (true, false) => return Err(refused("complex values in frequency", "real ones")),
        (false, true) => return Err(refused("real values in time", "complex ones")),
    };
    let at = nodes.place(function.response.node, &from)?;
    let reference = &function.reference;
    let named = (!reference.name.is_empty()).then(|| reference.name.clone());
    let names = named.into_iter().chain([reference.node.to_string()]).collect();
    let who = Who { names, at: nodes.known(reference.node)? };
    let says = Says { kind, ..says(&function.numerator, &function.denominator, nodes.units) };
    Ok(Measured { from, who, at, signal, sign, says })
}

/// What the quantities and units of the axes say.
fn says(numerator: &Axis, denominator: &Axis, units: Units) -> Says {
    let quantity = match numerator.quantity {
        DISPLACEMENT => Some(Quantity::Displacement),
        VELOCITY => Some(Quantity::Velocity),
        ACCELERATION => Some(Quantity::Acceleration),
        _ => None,
    };
    // A unit of another quantity than the number says is not believed.
    let unit = units::response(&numerator.unit).filter(|(of_unit, _)| quantity.is_none_or(|q| q == *of_unit));
    let by_label = units::reference(&denominator.unit);
    let by_units =
        units.filter(|_| FORCES.contains(&denominator.quantity)).map(|(_, newtons)| (Per::Newton, newtons));
    Says { kind: None, quantity, unit, length: units.map(|(metres, _)| metres), per: by_label.or(by_units) }
}
