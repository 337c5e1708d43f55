//! Values from arrays of NumPy, and arrays of values: copied in, moved or shared out.

use crate::error::{input, raised};
use numpy::ndarray::{Array, ArrayView, Dimension, StrideShape};
use numpy::{Element, PyArray, PyArray2, PyArrayDyn, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::PyClass;
use pyo3::prelude::*;
use pyo3::pyclass::boolean_struct::True;
use pyo3::types::IntoPyDict;
use unripple::core::Point;
use unripple_tasks::TaskError;

/// The values of an array of float32 or float64 with `N` dimensions, in C order, and its shape; `what` names it in messages.
///
/// # Errors
/// `InputError` of anything else, and of a value that is not finite.
pub(crate) fn doubles<const N: usize>(
    value: &Bound<'_, PyAny>,
    what: &str,
) -> PyResult<(Vec<f64>, [usize; N])> {
    let py = value.py();
    let (values, shape) = match copied::<f64, N>(value)? {
        Some(found) => found,
        None => {
            let (values, shape) = copied::<f32, N>(value)?.ok_or_else(|| other::<N>(value, what))?;
            (py.detach(move || values.into_iter().map(f64::from).collect()), shape)
        }
    };
    finite(py, what, &values, shape)?;
    Ok((values, shape))
}

/// The same in single precision; a value beyond it counts as infinite.
///
/// # Errors
/// As those of [`doubles`].
pub(crate) fn singles<const N: usize>(
    value: &Bound<'_, PyAny>,
    what: &str,
) -> PyResult<(Vec<f32>, [usize; N])> {
    let py = value.py();
    let (values, shape) = match copied::<f32, N>(value)? {
        Some(found) => found,
        None => {
            let (values, shape) = copied::<f64, N>(value)?.ok_or_else(|| other::<N>(value, what))?;
            (py.detach(move || values.into_iter().map(|x| x as f32).collect()), shape)
        }
    };
    finite(py, what, &values, shape)?;
    Ok((values, shape))
}

/// Places (m) from an array [place, 2] of x and y.
///
/// # Errors
/// Those of [`doubles`], and `InputError` of another shape.
pub(crate) fn points(value: &Bound<'_, PyAny>, what: &str) -> PyResult<Vec<Point>> {
    let (values, shape) = doubles::<2>(value, what)?;
    match shape {
        [_, 2] => Ok(values.chunks_exact(2).map(|place| Point::new(place[0], place[1])).collect()),
        [rows, columns] => {
            let found = format!("{what}: expected an array of x and y, N x 2, found {rows} x {columns}");
            Err(input(value.py(), found))
        }
    }
}

/// An array of these values, given in C order, which are moved into it: the caller's own, who may write to it.
///
/// # Errors
/// `WorkError` if they are not as many as the shape holds.
pub(crate) fn owned<'py, T: Element, D: Dimension>(
    py: Python<'py>,
    values: Vec<T>,
    shape: impl Into<StrideShape<D>>,
) -> PyResult<Bound<'py, PyArray<T, D>>> {
    let array = Array::from_shape_vec(shape, values).map_err(|error| raised(py, TaskError::work(error)))?;
    Ok(PyArray::from_owned_array(py, array))
}

/// The same, read-only.
///
/// # Errors
/// Those of [`owned`].
pub(crate) fn moved<'py, T: Element, D: Dimension>(
    py: Python<'py>,
    values: Vec<T>,
    shape: impl Into<StrideShape<D>>,
) -> PyResult<Bound<'py, PyArray<T, D>>> {
    sealed(owned(py, values, shape)?)
}

/// Places (m) as an array [place, 2] of x and y: the caller's own, who may write to it.
pub(crate) fn coordinates<'py>(
    py: Python<'py>,
    places: impl IntoIterator<Item = Point>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let values: Vec<f64> = places.into_iter().flat_map(|place| [place.x, place.y]).collect();
    let count = values.len() / 2;
    owned(py, values, [count, 2])
}

/// The same, read-only.
pub(crate) fn places<'py>(
    py: Python<'py>,
    places: impl IntoIterator<Item = Point>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    sealed(coordinates(py, places)?)
}

/// A read-only array that shares the memory of values, in C order, that `owner` holds; it keeps the owner alive.
///
/// # Errors
/// `WorkError` if they are not as many as the shape holds.
#[allow(unsafe_code)]
pub(crate) fn shared<'py, C, T, D>(
    owner: &Bound<'py, C>,
    values: impl for<'a> FnOnce(&'a C) -> &'a [T],
    shape: impl Into<StrideShape<D>>,
) -> PyResult<Bound<'py, PyArray<T, D>>>
where
    C: PyClass<Frozen = True> + Sync,
    T: Element,
    D: Dimension,
{
    let view = ArrayView::from_shape(shape, values(owner.get()))
        .map_err(|error| raised(owner.py(), TaskError::work(error)))?;
    // SAFETY: the values are lent by an object of a frozen class, for as long as the object is borrowed. There is never a mutable reference
    // to it, it does not move, and what it lends it cannot free while it lives; the array keeps it alive, as its base. Nobody writes to the
    // values through the array: it is made read-only before anyone else sees it, and NumPy makes it writable again only if its base offers
    // a buffer, which the object does not.
    let array = unsafe { PyArray::borrow_from_array(&view, owner.clone().into_any()) };
    sealed(array)
}

/// The array, which nobody can write to any more.
fn sealed<T, D>(array: Bound<'_, PyArray<T, D>>) -> PyResult<Bound<'_, PyArray<T, D>>> {
    array.call_method1("setflags", (false,))?;
    Ok(array)
}

/// The values of an array in C order, copied, and its shape; nothing if it has other values or another number of dimensions.
fn copied<T: Element + Copy, const N: usize>(
    value: &Bound<'_, PyAny>,
) -> PyResult<Option<(Vec<T>, [usize; N])>> {
    let Ok(array) = value.cast::<PyArrayDyn<T>>() else { return Ok(None) };
    let Ok(shape) = <[usize; N]>::try_from(array.shape()) else { return Ok(None) };
    let array = if array.is_c_contiguous() && array.is_aligned() {
        array.clone()
    } else {
        // NumPy alone knows every layout.
        let py = value.py();
        let order = [("order", "C")].into_py_dict(py)?;
        py.import("numpy")?.call_method("array", (array,), Some(&order))?.cast_into::<PyArrayDyn<T>>()?
    };
    let values = array.try_readonly()?.as_slice()?.to_vec();
    Ok(Some((values, shape)))
}

/// Refuses values that are not finite, and names the place of the first.
fn finite<T: Copy + Into<f64> + Sync, const N: usize>(
    py: Python<'_>,
    what: &str,
    values: &[T],
    shape: [usize; N],
) -> PyResult<()> {
    let number = |value: &T| -> f64 { (*value).into() };
    let wrong = py.detach(|| values.iter().position(|value| !number(value).is_finite()));
    let Some(wrong) = wrong else { return Ok(()) };
    let (mut index, mut left) = ([0; N], wrong);
    for (place, length) in index.iter_mut().zip(shape).rev() {
        *place = left % length.max(1);
        left /= length.max(1);
    }
    let found = number(&values[wrong]);
    Err(input(py, format!("{what}: expected finite numbers, found {found} at {index:?}")))
}

/// The error of something that is not such an array.
fn other<const N: usize>(value: &Bound<'_, PyAny>, what: &str) -> PyErr {
    let found = match value.cast::<PyUntypedArray>() {
        Ok(array) => format!("one of {} with {}", array.dtype(), array.ndim()),
        Err(_) => value.get_type().to_string(),
    };
    let expected = format!("an array of float32 or float64 with {N} dimensions");
    input(value.py(), format!("{what}: expected {expected}, found {found}"))
}
