//! Responses from a table of numbers, one in each column, or two for a complex one; and tables of modes.

use super::abscissa::even;
use super::found::Found;
use super::labels::Labels;
use super::measured::{Complex, Measured, Says, Signal};
use super::{Kind, uff_modes};
use crate::TaskError;
use unripple_exchange::{Columns, Csv, read_columns};

/// Names of the column of times, in seconds, and of that of frequencies, in hertz.
const TIME: &str = "time_s";
const FREQUENCY: &str = "frequency_hz";

/// Endings of the names of two columns that are the parts of a complex one.
const REAL: &str = ".re";
const IMAGINARY: &str = ".im";

/// Reads a table.
pub(super) fn read(bytes: &[u8], file: &str, labels: &Labels, found: &mut Found) -> Result<(), TaskError> {
    let table = Csv::of(bytes, file).map_err(TaskError::input)?;
    let first = table.names[0].clone();
    match first.as_str() {
        "node" => {
            found.modes.push(uff_modes::of_table(&table, file, labels)?);
            return Ok(());
        }
        TIME | FREQUENCY => {}
        _ => {
            return Err(TaskError::Input(format!(
                "{file}: expected `{TIME}`, `{FREQUENCY}` or, for modes, `node` as the first column, found `{first}`"
            )));
        }
    }
    let table = read_columns(bytes, file).map_err(TaskError::input)?;
    let (start, step) = even(&table.values[0], &first, |row| format!("{file}: line {}", table.lines[row]))?;
    let mut column = 1;
    while column < table.names.len() {
        let (name, signal, taken) = signal(&table, column, first == TIME, start, step, file)?;
        column += taken;
        let from = format!("{file}: column `{name}`");
        for label in labels.named(&name, &from)? {
            let at = label.place(&name)?;
            let kind = (first == FREQUENCY).then_some(Kind::FrequencyResponses);
            let says = Says { kind, ..Says::default() };
            let signal = signal.clone();
            found.responses.push(Measured {
                from: from.clone(),
                who: label.who,
                at,
                signal,
                sign: 1.0,
                says,
            });
        }
    }
    Ok(())
}

/// The response in a column, its name, and how many columns it takes.
fn signal(
    table: &Columns,
    column: usize,
    in_time: bool,
    start: f64,
    step: f64,
    file: &str,
) -> Result<(String, Signal, usize), TaskError> {
    let (name, values) = (&table.names[column], &table.values[column]);
    if in_time {
        return Ok((name.clone(), Signal::Time { start, step, values: values.clone() }, 1));
    }
    let alone = name.strip_suffix(REAL);
    let other = alone.map(|alone| format!("{alone}{IMAGINARY}"));
    match (alone, table.names.get(column + 1) == other.as_ref()) {
        (Some(alone), true) => {
            let pairs = values.iter().zip(&table.values[column + 1]);
            let values = pairs.map(|(re, im)| Complex::new(*re, *im)).collect();
            Ok((alone.to_owned(), Signal::Frequency { start, step, values }, 2))
        }
        _ => Err(TaskError::Input(format!(
            "{file}: expected two columns NAME{REAL} and NAME{IMAGINARY} for each response, found `{name}`"
        ))),
    }
}
