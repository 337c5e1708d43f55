//! Values of a function, as text and in binary, at abscissae that are even or written beside them.

use super::dataset::Function;
use super::fields::columns;
use super::lines::Records;
use crate::ExchangeError;
use crate::bytes::Order;

/// Precision of the values.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Coding {
    Single,
    Double,
}

/// How the values are written.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    /// Number of values, or of pairs of abscissa and value.
    pub count: usize,
    /// Whether values are complex, real part first.
    pub complex: bool,
    /// Whether abscissae are even, and not written.
    pub even: bool,
    /// Precision of the values.
    pub coding: Coding,
}

impl Layout {
    /// Numbers of one value: its parts, and its abscissa if that is written.
    fn each(self) -> usize {
        usize::from(self.complex) + 1 + usize::from(!self.even)
    }

    /// All numbers of the function; `None` if there are more than can be counted.
    fn numbers(self) -> Option<usize> {
        self.count.checked_mul(self.each())
    }

    /// Widths of the fields of a line.
    fn widths(self) -> &'static [usize] {
        match (self.coding, self.even, self.complex) {
            (Coding::Single, ..) => &[13; 6],
            (Coding::Double, true, _) => &[20; 4],
            (Coding::Double, false, false) => &[13, 20, 13, 20],
            (Coding::Double, false, true) => &[13, 20, 20],
        }
    }
}

/// The numbers of a function in text: parts of values, after their abscissae if these are written.
pub(super) fn text(records: &mut Records<'_>, layout: Layout) -> Result<Vec<f64>, ExchangeError> {
    // A number takes a byte at least.
    let wanted = layout.numbers().filter(|wanted| *wanted <= records.left());
    let wanted = wanted.ok_or_else(|| {
        records.refused(format!("{} values", layout.count), format!("{} bytes", records.left()))
    })?;
    let mut numbers = Vec::new();
    while numbers.len() < wanted {
        let line = records.record("a line of values")?;
        let mut start = 0;
        for width in layout.widths().iter().take(wanted - numbers.len()) {
            let field = columns(line.bytes, start, *width).trim_ascii();
            numbers.push(records.finite(line, field, "a value")?);
            start += width;
        }
        if !columns(line.bytes, start, usize::MAX - start).trim_ascii().is_empty() {
            let found = format!("a line of {} columns", line.bytes.len());
            return Err(records.refused(format!("values in {start} columns"), found));
        }
    }
    Ok(numbers)
}

/// The numbers of a binary function of `bytes` bytes.
pub(super) fn binary(
    records: &mut Records<'_>,
    layout: Layout,
    order: Order,
    bytes: usize,
) -> Result<Vec<f64>, ExchangeError> {
    let size = if layout.coding == Coding::Double { 8 } else { 4 };
    let wanted = layout.numbers().and_then(|numbers| numbers.checked_mul(size));
    // Abscissae beside values of double precision are of single precision in some files.
    let mixed = !layout.even && layout.coding == Coding::Double;
    let narrow = wanted.map(|wanted| wanted - 4 * layout.count.min(wanted / 4)).filter(|_| mixed);
    let mut known = [wanted, narrow].into_iter().flatten();
    // Some writers count complex values as real ones: there the mark that ends the dataset decides.
    let found = known
        .clone()
        .find(|known| *known == bytes)
        .or_else(|| known.find(|known| records.ends_after(*known)));
    let Some(bytes) = found else {
        let expected = wanted.map_or_else(|| "fewer values".to_owned(), |wanted| format!("{wanted} bytes"));
        return Err(records.refused(format!("{expected} of {} values", layout.count), bytes));
    };
    let taken = records.binary(bytes)?;
    let numbers: Vec<f64> = match (wanted == Some(bytes), size) {
        (true, 8) => taken.chunks_exact(8).map(|bytes| order.f64(bytes)).collect(),
        (true, _) => taken.chunks_exact(4).map(|bytes| order.f32(bytes)).collect(),
        (false, _) => {
            let parts = layout.each() - 1;
            let pairs = taken.chunks_exact(4 + 8 * parts);
            let read = |pair: &[u8]| {
                let values: Vec<f64> = pair[4..].chunks_exact(8).map(|bytes| order.f64(bytes)).collect();
                [vec![order.f32(pair)], values].concat()
            };
            pairs.flat_map(read).collect()
        }
    };
    checked(records, &numbers, taken, size, order)?;
    Ok(numbers)
}

/// Refuses numbers that are not finite, or that make sense only in the other order of bytes.
fn checked(
    records: &Records<'_>,
    numbers: &[f64],
    taken: &[u8],
    size: usize,
    order: Order,
) -> Result<(), ExchangeError> {
    let share = |order: Order| {
        let strange = |bytes: &[u8]| {
            let number = if size == 8 { order.f64(bytes) } else { order.f32(bytes) };
            number != 0.0 && !(LEAST..=MOST).contains(&number.abs())
        };
        let count = taken.chunks_exact(size).filter(|bytes| strange(bytes)).count();
        count as f64 / (taken.len() / size).max(1) as f64
    };
    if share(order) > STRANGE && share(order.other()) < STRANGE / 10.0 {
        let name = |order: Order| if order == Order::Little { "least" } else { "most" };
        let found =
            format!("numbers that make sense with the {} significant byte first", name(order.other()));
        return Err(
            records.refused(format!("numbers with the {} significant byte first", name(order)), found)
        );
    }
    match numbers.iter().position(|number| !number.is_finite()) {
        None => Ok(()),
        Some(at) => Err(records.refused("finite values", format!("{} as number {}", numbers[at], at + 1))),
    }
}

/// Magnitudes of what is measured lie between these in any unit; numbers whose bytes are in the wrong order mostly do not.
const LEAST: f64 = 1e-18;
const MOST: f64 = 1e18;

/// Share of numbers beyond these magnitudes from which the order of bytes is doubted; a tenth of it is left to those of the other order.
const STRANGE: f64 = 0.2;

/// Share of a step by which abscissae may be off, and share of their own value, which is that of six digits.
const OFF: f64 = 1e-3;
const DIGITS: f64 = 5e-6;

/// A function with the values of `numbers`, whose abscissae are written between them and must be even.
pub(super) fn evened(
    records: &Records<'_>,
    layout: Layout,
    numbers: &[f64],
    function: Function,
    line: usize,
) -> Result<Function, ExchangeError> {
    let each = layout.each();
    let at = |n: usize| numbers[n * each];
    let count = layout.count;
    if count < 2 {
        return Err(records.refused_at(line, "two abscissae or more", count));
    }
    let (start, step) = (at(0), (at(count - 1) - at(0)) / (count - 1) as f64);
    let expected =
        || "an even abscissa, which values in time and frequency have when they are transformed".to_owned();
    if step <= 0.0 {
        return Err(records.refused_at(line, expected(), "one that does not grow"));
    }
    for n in 0..count {
        let even = start + n as f64 * step;
        if (at(n) - even).abs() > OFF * step + DIGITS * even.abs() {
            let found = format!("an uneven one: {} as number {} where {even} would be even", at(n), n + 1);
            return Err(records.refused_at(line, expected(), found));
        }
    }
    let values = numbers.chunks_exact(each).flat_map(|pair| pair[1..].iter().copied()).collect();
    Ok(Function { start, step, values, ..function })
}
