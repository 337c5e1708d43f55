//! Which rows of a long table are printed.

/// Rows of a table that are printed, where it has more: all are in the JSON.
const ROWS: usize = 12;

/// Indices of the rows of a table with so many that are printed: evenly some of them, the first, the last, and the `wanted` one (counted
/// from 1).
pub(crate) fn thinned(rows: usize, wanted: usize) -> impl Iterator<Item = usize> {
    let step = rows.div_ceil(ROWS).max(1);
    (0..rows).filter(move |i| (i + 1) % step == 0 || *i == 0 || i + 1 == wanted || i + 1 == rows)
}

#[cfg(test)]
mod tests {
    use super::thinned;

    #[test]
    fn ends_and_the_wanted_row_are_always_there() {
        assert_eq!(thinned(5, 2).collect::<Vec<_>>(), [0, 1, 2, 3, 4]);
        assert_eq!(thinned(30, 5).collect::<Vec<_>>(), [0, 2, 4, 5, 8, 11, 14, 17, 20, 23, 26, 29]);
        assert_eq!(thinned(0, 1).count(), 0);
    }
}
