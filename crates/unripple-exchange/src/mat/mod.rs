//! MATLAB files of version 5: what `save` writes without options, and with `-v6` and `-v7`.

mod element;
mod matrix;
mod write;

use crate::bytes::{Bytes, Order};
use crate::error::shown;
use crate::room::{self, Room};
use crate::{Arrays, ExchangeError, Place};
use element::{Element, MATRIX, PACKED};
use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;

pub use write::write_mat;

/// Bytes of the header: a text of 116, of which nothing is meant, a version and the order of bytes.
const HEADER: usize = 128;

/// Reads the variables of a MATLAB file: numbers, texts, and lists of texts. Variables of other classes, such as structures, are left out.
///
/// # Errors
/// [`ExchangeError::Content`] with the byte at fault: a file of another version, cut short, or damaged; and arrays
/// that would take more memory than 1032 times the file, or 4 GiB.
pub fn read_mat(bytes: &[u8], file: &str) -> Result<Arrays, ExchangeError> {
    let order = order(bytes, file)?;
    let mut rest = Bytes::of(&bytes[HEADER..], HEADER, file);
    let (mut arrays, mut room) = (Arrays::new(), Room::of(bytes.len(), file));
    while rest.left() > 0 {
        let element = Element::next(&mut rest, order)?;
        let unpacked;
        let element = match element.kind {
            PACKED => {
                let most = usize::try_from(room::most(element.bytes.len())).unwrap_or(usize::MAX);
                unpacked = decompress_to_vec_zlib_with_limit(element.bytes, most).map_err(|error| {
                    let found = format!("{:?}", error.status);
                    ExchangeError::content(file, Place::Byte(element.at), "a compressed variable", found)
                })?;
                // Bytes of what was unpacked have no place in the file: messages name where it begins.
                Element::next(&mut Bytes::of(&unpacked, element.at, file), order)?
            }
            _ => element,
        };
        if element.kind != MATRIX {
            continue;
        }
        if let Some((name, array)) = matrix::read(element, order, 0, &mut room)? {
            arrays.insert(name, array);
        }
    }
    Ok(arrays)
}

/// The order of bytes, from the header, which says also what file it is.
fn order(bytes: &[u8], file: &str) -> Result<Order, ExchangeError> {
    let refused = |found: String| {
        let expected = "a MATLAB file of version 5, as `save` writes with -v7 (those of -v7.3 are HDF5, which Python reads)";
        Err(ExchangeError::content(file, Place::Whole, expected, found))
    };
    if bytes.starts_with(b"MATLAB 7.3") || bytes.starts_with(b"\x89HDF") {
        return refused("one of version 7.3".into());
    }
    let Some(header) = bytes.get(..HEADER) else {
        return refused(format!("{} bytes", bytes.len()));
    };
    let order = match &header[126..128] {
        b"IM" => Order::Little,
        b"MI" => Order::Big,
        _ => return refused(shown(&header[..40])),
    };
    match order.u16(&header[124..]) >> 8 {
        1 => Ok(order),
        other => refused(format!("version {other}")),
    }
}
