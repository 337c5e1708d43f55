//! Named arrays of numbers or texts, as NPZ and MATLAB files hold them.

use std::collections::BTreeMap;

/// Arrays by their names.
pub type Arrays = BTreeMap<String, Array>;

/// An array of any number of axes, its last axis running fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Length of each axis; empty for a single value.
    pub shape: Vec<usize>,
    /// The values, as many as the product of the lengths of the axes.
    pub values: Values,
}

/// Values of an array.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Real numbers of any type.
    Real(Vec<f64>),
    /// Complex numbers, real and imaginary part.
    Complex(Vec<[f64; 2]>),
    /// Texts, such as names.
    Text(Vec<String>),
}

impl Values {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::Real(values) => values.len(),
            Self::Complex(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    /// Whether there is no value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Array {
    /// An array of real numbers with the lengths of its axes.
    pub fn real(shape: &[usize], values: Vec<f64>) -> Self {
        Self { shape: shape.to_vec(), values: Values::Real(values) }
    }

    /// A list of texts, with one axis.
    pub fn texts(values: Vec<String>) -> Self {
        Self { shape: vec![values.len()], values: Values::Text(values) }
    }

    /// Real numbers of the array, the last axis running fastest; `None` of others.
    pub fn as_real(&self) -> Option<&[f64]> {
        match &self.values {
            Values::Real(values) => Some(values),
            _ => None,
        }
    }

    /// Texts of the array; `None` of numbers.
    pub fn as_texts(&self) -> Option<&[String]> {
        match &self.values {
            Values::Text(values) => Some(values),
            _ => None,
        }
    }

    /// The only number of an array with one; `None` of all others.
    pub fn as_number(&self) -> Option<f64> {
        self.as_real().filter(|values| values.len() == 1).map(|values| values[0])
    }

    /// The only text of an array with one; `None` of all others.
    pub fn as_text(&self) -> Option<&str> {
        self.as_texts().filter(|values| values.len() == 1).map(|values| values[0].as_str())
    }
}

/// The product of the lengths of axes; `None` if it is past what memory could hold.
pub(crate) fn product(shape: &[usize]) -> Option<usize> {
    shape.iter().try_fold(1_usize, |product, length| product.checked_mul(*length))
}

/// Values whose first axis runs fastest, in the order in which the last one does.
pub(crate) fn turned<T: Clone>(shape: &[usize], values: &[T]) -> Vec<T> {
    // With at most one axis longer than 1 both orders are one.
    if shape.iter().filter(|length| **length != 1).count() < 2 {
        return values.to_vec();
    }
    let mut strides = Vec::with_capacity(shape.len());
    let mut stride = 1;
    for length in shape {
        strides.push(stride);
        stride *= length;
    }
    let mut index = vec![0; shape.len()];
    let mut at = 0;
    let mut turned = Vec::with_capacity(values.len());
    while turned.len() < values.len() {
        turned.push(values[at].clone());
        for axis in (0..shape.len()).rev() {
            index[axis] += 1;
            at += strides[axis];
            if index[axis] < shape[axis] {
                break;
            }
            at -= strides[axis] * shape[axis];
            index[axis] = 0;
        }
    }
    turned
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_axes_is_turned() {
        // Columns 1 4, 2 5, 3 6 of two rows.
        assert_eq!(turned(&[2, 3], &[1, 4, 2, 5, 3, 6]), [1, 2, 3, 4, 5, 6]);
        assert_eq!(turned(&[1, 3], &[1, 2, 3]), [1, 2, 3]);
        // a[i][j][k] = 100 i + 10 j + k.
        let first_fastest = [0, 100, 10, 110, 1, 101, 11, 111];
        assert_eq!(turned(&[2, 2, 2], &first_fastest), [0, 1, 10, 11, 100, 101, 110, 111]);
        assert_eq!(turned::<u8>(&[2, 0], &[]), [0_u8; 0]);
        assert_eq!(product(&[usize::MAX, 2]), None);
        assert_eq!(product(&[]), Some(1));
    }
}
