//! One array of numpy: a header in the syntax of Python, and the values.

use crate::arrays::{product, turned};
use crate::bytes::{Bytes, Order};
use crate::error::shown;
use crate::room::{self, Room};
use crate::{Array, ExchangeError, Place, Values};

/// First bytes of an array of numpy.
const MAGIC: &[u8] = b"\x93NUMPY";

/// Most axes of an array; numpy allows 64.
const MOST_AXES: usize = 64;

/// What the header says.
struct Header {
    order: Order,
    /// Letter of the type: f, c, i, u, b, U or S.
    kind: u8,
    /// Bytes of a number, or letters of a text.
    size: usize,
    first_fastest: bool,
    shape: Vec<usize>,
}

/// Reads an array of a name in a file, whose room it takes.
pub(crate) fn read(bytes: &[u8], name: &str, room: &mut Room<'_>) -> Result<Array, ExchangeError> {
    let place = format!("{}: `{name}`", room.file);
    let mut bytes = Bytes::of(bytes, 0, &place);
    let magic = bytes.take(8, "an array of numpy")?;
    if !magic.starts_with(MAGIC) {
        return Err(bytes.refused("an array of numpy", shown(&magic[..6])));
    }
    let length = match magic[6] {
        1 => usize::from(Order::Little.u16(bytes.take(2, "the length of the header")?)),
        2 | 3 => Order::Little.u32(bytes.take(4, "the length of the header")?) as usize,
        other => return Err(bytes.refused("version 1 to 3 of the format", other)),
    };
    let text = bytes.take(length, "the header")?;
    let header = header(text).ok_or_else(|| {
        bytes.refused("a header with descr, fortran_order and shape of numbers or texts", shown(text))
    })?;
    let each = if header.kind == b'U' { 4 * header.size } else { header.size };
    let count = product(&header.shape);
    let wanted = count.and_then(|count| count.checked_mul(each));
    let (Some(count), Some(wanted)) = (count, wanted.filter(|wanted| *wanted == bytes.left())) else {
        let expected = format!("the bytes of values of the shape {:?}", header.shape);
        return Err(bytes.refused(expected, format!("{} bytes", bytes.left())));
    };
    // Texts of no letter have no bytes that could bound their number.
    if each == 0 && count > length {
        return Err(bytes.refused("texts with letters", format!("{count} without")));
    }
    let kept = match header.kind {
        b'c' => 2 * room::NUMBER,
        b'U' | b'S' => room::TEXT,
        _ => room::NUMBER,
    };
    room.take(count, kept, Place::Named(name.to_owned()))?;
    let values = values(&header, bytes.take(wanted, "values")?, count);
    Ok(Array { values: ordered(&header, values), shape: header.shape })
}

fn ordered(header: &Header, values: Values) -> Values {
    if !header.first_fastest {
        return values;
    }
    match values {
        Values::Real(values) => Values::Real(turned(&header.shape, &values)),
        Values::Complex(values) => Values::Complex(turned(&header.shape, &values)),
        Values::Text(values) => Values::Text(turned(&header.shape, &values)),
    }
}

/// The values of an array.
fn values(header: &Header, bytes: &[u8], count: usize) -> Values {
    let (order, size) = (header.order, header.size);
    let real = |number: &[u8]| -> f64 {
        let (wide, bits) = match size {
            1 => (u64::from(number[0]), 8),
            2 => (u64::from(order.u16(number)), 16),
            4 => (u64::from(order.u32(number)), 32),
            _ => (order.u64(number), 64),
        };
        match header.kind {
            b'f' if size == 4 => order.f32(number),
            b'f' => order.f64(number),
            // The sign is that of the highest bit of its own size.
            b'i' => ((wide << (64 - bits)) as i64 >> (64 - bits)) as f64,
            _ => wide as f64,
        }
    };
    match header.kind {
        b'c' => {
            let half = size / 2;
            let part = |bytes: &[u8]| if half == 4 { order.f32(bytes) } else { order.f64(bytes) };
            Values::Complex(bytes.chunks_exact(size).map(|pair| [part(pair), part(&pair[half..])]).collect())
        }
        b'U' | b'S' => {
            let each = if header.kind == b'U' { 4 * size } else { size };
            let text = |n: usize| letters(header, &bytes[n * each..(n + 1) * each]);
            Values::Text((0..count).map(text).collect())
        }
        _ => Values::Real(bytes.chunks_exact(size).map(real).collect()),
    }
}

/// A text, without the zeros that fill it up.
fn letters(header: &Header, bytes: &[u8]) -> String {
    let text = match header.kind {
        b'U' => bytes
            .chunks_exact(4)
            .map(|letter| char::from_u32(header.order.u32(letter)).unwrap_or(char::REPLACEMENT_CHARACTER))
            .collect(),
        _ => String::from_utf8_lossy(bytes).into_owned(),
    };
    text.trim_end_matches('\0').to_owned()
}

/// What the header says; `None` if it is not understood, or of values that are not read here.
fn header(text: &[u8]) -> Option<Header> {
    let text = std::str::from_utf8(text).ok()?;
    let after = |key: &str| {
        let quoted = [format!("'{key}':"), format!("\"{key}\":")];
        quoted.iter().find_map(|key| text.split_once(key.as_str())).map(|(_, after)| after.trim_start())
    };
    let descr = after("descr")?.trim_start_matches(['\'', '"']);
    let descr = descr.split(['\'', '"']).next()?;
    let mut letters = descr.chars();
    let order = match letters.next()? {
        '<' | '|' | '=' => Order::Little,
        '>' => Order::Big,
        _ => return None,
    };
    let kind = u8::try_from(letters.next()?).ok()?;
    let size: usize = letters.as_str().parse().ok()?;
    let read = match kind {
        b'f' => matches!(size, 4 | 8),
        b'c' => matches!(size, 8 | 16),
        b'i' | b'u' => matches!(size, 1 | 2 | 4 | 8),
        b'b' => size == 1,
        b'U' | b'S' => size < 1 << 20,
        _ => false,
    };
    let first_fastest = after("fortran_order")?.starts_with("True");
    let shape = after("shape")?.strip_prefix('(')?.split(')').next()?;
    let shape: Option<Vec<usize>> = shape
        .split(',')
        .map(str::trim)
        .filter(|length| !length.is_empty())
        .map(|length| length.trim_end_matches('L').parse().ok())
        .collect();
    let shape = shape.filter(|shape| shape.len() <= MOST_AXES)?;
    read.then_some(Header { order, kind, size, first_fastest, shape })
}
