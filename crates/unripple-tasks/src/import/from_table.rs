//! Responses from a table of numbers, one in each column, or two for a complex one; and tables of modes.

use super::labels::Labels;
use super::measured::{Complex, Found, Measured, Says, Signal};
use super::{Kind, spectrum, uff_modes};
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
            let Some(at) = label.at else {
                return Err(TaskError::Input(format!(
                    "{}: expected the place of `{name}`, found none",
                    label.from
                )));
            };
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

/// First value and distance of values at even distances.
///
/// # Errors
/// [`TaskError::Input`] of fewer than two, and of the first that is not where it should be; `place` names its place in the file.
pub(super) fn even(
    values: &[f64],
    what: &str,
    place: impl Fn(usize) -> String,
) -> Result<(f64, f64), TaskError> {
    let [first, .., last] = values else {
        return Err(TaskError::Input(format!(
            "`{what}`: expected two values or more, found {}",
            values.len()
        )));
    };
    let step = (last - first) / (values.len() - 1) as f64;
    if !step.is_finite() || step <= 0.0 {
        return Err(TaskError::Input(format!(
            "`{what}`: expected values that grow, found {first} to {last}"
        )));
    }
    for (n, value) in values.iter().enumerate() {
        let wanted = first + n as f64 * step;
        if (value - wanted).abs() > spectrum::OFF * step + spectrum::DIGITS * wanted.abs() {
            return Err(TaskError::Input(format!(
                "{}: expected an even abscissa, with {what} {wanted}, found {value}",
                place(n)
            )));
        }
    }
    Ok((*first, step))
}

#[cfg(test)]
mod tests {
    use super::even;

    #[test]
    fn only_even_values_are_taken() {
        let of =
            |values: &[f64]| even(values, "time_s", |n| format!("line {}", n + 2)).map_err(|e| e.to_string());
        assert_eq!(of(&[1.0, 1.5, 2.0]), Ok((1.0, 0.5)));
        assert!(of(&[0.0, 0.333333, 0.666667, 1.0]).is_ok());
        assert_eq!(
            of(&[0.0, 0.5, 1.5]),
            Err("line 3: expected an even abscissa, with time_s 0.75, found 0.5".to_owned())
        );
        assert!(of(&[0.0]).is_err() && of(&[1.0, 1.0]).is_err() && of(&[1.0, 0.0]).is_err());
    }
}
