//! Limit on the size of the tables from which drives are optimised.

use crate::FocusError;

/// Largest number of values of a table, 2 GiB of them. With twice as many, windows may be twice as long.
const MOST_VALUES: usize = 1 << 28;

/// Refuses a table of too many values before it is allocated; `what` names the product of its rows and columns.
///
/// # Errors
/// [`FocusError::Count`].
pub(super) fn fits(what: &'static str, rows: usize, columns: usize) -> Result<(), FocusError> {
    let found = rows.saturating_mul(columns);
    if found <= MOST_VALUES {
        return Ok(());
    }
    Err(FocusError::Count { what, expected: format!("at most {MOST_VALUES}"), found })
}
