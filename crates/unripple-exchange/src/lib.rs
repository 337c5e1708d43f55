//! Measurements in files of other programs, from bytes to plain structs and back: universal files (UFF), CSV, NPZ and MATLAB 5.
//!
//! Nothing here opens a file, converts a unit or knows a surface: a reader gives what a file says, and refuses by line, byte or name what
//! it cannot mean. No reader takes memory for a count that a file claims before it has compared the count with the bytes that are left.
//!
//! # In reading order
//!
//! - [`read_uff`] reads datasets 15 and 2411 (nodes), 55 (modes), 58 and 58b (functions) and 164 (units); [`write_uff`] writes them.
//! - [`Csv`] is a table of texts, [`read_columns`] one of numbers.
//! - [`read_npz`] and [`read_mat`] read named [`Array`]s; [`write_mat`] writes them.
//!
//! ```
//! use unripple_exchange::read_columns;
//!
//! let table = read_columns(b"time_s,a1\n0,1\n0.5,-2\n", "table.csv")?;
//! assert_eq!((table.names[1].as_str(), table.values[1].as_slice()), ("a1", &[1.0, -2.0][..]));
//! # Ok::<(), unripple_exchange::ExchangeError>(())
//! ```

mod arrays;
mod bytes;
mod csv;
mod error;
mod mat;
mod npy;
mod npz;
mod room;
mod uff;
mod zip;

pub use arrays::{Array, Arrays, Values};
pub use csv::{Columns, Csv, Row, read_columns};
pub use error::{ExchangeError, Place};
pub use mat::{read_mat, write_mat};
pub use npz::read_npz;
pub use uff::{Axis, Dof, Function, Mode, Node, Uff, UffUnits, read_uff, write_uff};
