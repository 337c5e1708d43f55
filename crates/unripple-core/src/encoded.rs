//! Values made of numbers, as bytes.

use crate::{Onset, Pole};
use unripple_linalg::{Mat, MatRef};

/// A value that is made of numbers, as bytes: each number as its eight bytes, the lowest first.
pub trait Encoded: Sized {
    /// Appends the bytes of this value.
    fn encode(&self, to: &mut Vec<u8>);

    /// Takes the bytes of a value off the front; `None` if they are not those of a value.
    fn decode(from: &mut &[u8]) -> Option<Self>;
}

/// Takes eight bytes off the front.
fn eight(from: &mut &[u8]) -> Option<[u8; 8]> {
    let (first, rest) = from.split_first_chunk()?;
    *from = rest;
    Some(*first)
}

impl Encoded for f64 {
    fn encode(&self, to: &mut Vec<u8>) {
        to.extend(self.to_le_bytes());
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        eight(from).map(Self::from_le_bytes)
    }
}

impl Encoded for usize {
    fn encode(&self, to: &mut Vec<u8>) {
        to.extend((*self as u64).to_le_bytes());
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        Self::try_from(u64::from_le_bytes(eight(from)?)).ok()
    }
}

impl<T: Encoded> Encoded for Vec<T> {
    fn encode(&self, to: &mut Vec<u8>) {
        self.len().encode(to);
        self.iter().for_each(|value| value.encode(to));
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        let count = usize::decode(from)?;
        // Each value takes a byte at least, so that a damaged count asks for no more memory than there are bytes.
        (count <= from.len()).then(|| (0..count).map(|_| T::decode(from)).collect())?
    }
}

impl<T: Encoded, const N: usize> Encoded for [T; N] {
    fn encode(&self, to: &mut Vec<u8>) {
        self.iter().for_each(|value| value.encode(to));
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        let values: Option<Vec<T>> = (0..N).map(|_| T::decode(from)).collect();
        values?.try_into().ok()
    }
}

impl<A: Encoded, B: Encoded> Encoded for (A, B) {
    fn encode(&self, to: &mut Vec<u8>) {
        self.0.encode(to);
        self.1.encode(to);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        Some((A::decode(from)?, B::decode(from)?))
    }
}

/// Appends the bytes of a matrix, as [`Encoded::encode`] does for one of its own.
pub fn encode_matrix(matrix: MatRef<f64>, to: &mut Vec<u8>) {
    (matrix.nrows(), matrix.ncols()).encode(to);
    matrix.col_iter().for_each(|column| column.iter().for_each(|value| value.encode(to)));
}

impl Encoded for Mat<f64> {
    fn encode(&self, to: &mut Vec<u8>) {
        encode_matrix(self.as_ref(), to);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        let (rows, columns) = <(usize, usize)>::decode(from)?;
        let bytes = rows.checked_mul(columns)?.checked_mul(8)?;
        let (values, rest) = from.split_at_checked(bytes)?;
        *from = rest;
        let mut values =
            values.chunks_exact(8).map(|value| f64::from_le_bytes(value.try_into().unwrap_or_default()));
        let mut matrix = Self::zeros(rows, columns);
        for column in matrix.col_iter_mut() {
            column.iter_mut().zip(&mut values).for_each(|(to, value)| *to = value);
        }
        Some(matrix)
    }
}

impl Encoded for Pole {
    fn encode(&self, to: &mut Vec<u8>) {
        let moved = usize::from(self.onset == Onset::Displacement);
        ([self.omega, self.sigma], moved).encode(to);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        match <([f64; 2], usize)>::decode(from)? {
            ([omega, sigma], 0) => Some(Self::new(omega, sigma)),
            ([omega, sigma], 1) => Some(Self::moved(omega, sigma)),
            _ => None,
        }
    }
}
