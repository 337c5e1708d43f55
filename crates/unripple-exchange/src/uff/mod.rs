//! Universal files (UFF, UNV): nodes, units, functions and modes.

mod dataset;
mod fields;
mod function;
mod lines;
mod modes;
mod nodes;
mod values;
mod write;

use crate::error::shown;
use crate::{ExchangeError, Place};
use fields::text;
use lines::Records;

pub use dataset::{Axis, Dof, Function, Mode, Node, Uff, UffUnits};
pub use write::write_uff;

/// Reads a universal file.
///
/// # Errors
/// [`ExchangeError::Content`] with the dataset and the line of what is missing, cut short, not finite, or of a kind that is not read here.
pub fn read_uff(bytes: &[u8], file: &str) -> Result<Uff, ExchangeError> {
    let mut records = Records::of(bytes, file);
    let mut uff = Uff::default();
    while let Some(head) = records.begin()? {
        let number = text(head.bytes, 0, 80);
        let number = number.split_whitespace().next().unwrap_or_default().to_owned();
        match number.as_str() {
            "15" => nodes::read(&mut records, &mut uff.nodes, false)?,
            "2411" => nodes::read(&mut records, &mut uff.nodes, true)?,
            "164" => uff.units = Some(nodes::units(&mut records)?),
            "55" => uff.modes.push(modes::read(&mut records, head.number)?),
            "58" | "58b" => uff.functions.push(function::read(&mut records, head)?),
            other if other.bytes().next().is_some_and(|b| b.is_ascii_digit()) => {
                records.skip_dataset()?;
                *uff.others.entry(other.to_owned()).or_default() += 1;
            }
            _ => {
                let at = Place::Dataset { dataset: records.dataset, line: head.number };
                let expected = "the number of a dataset";
                return Err(ExchangeError::content(file, at, expected, shown(head.bytes)));
            }
        }
    }
    if records.dataset == 0 {
        let expected = "a universal file, whose first line is -1";
        return Err(ExchangeError::content(file, Place::Whole, expected, "an empty file"));
    }
    Ok(uff)
}
