//! All tests of foreign formats as one program: linking is what takes time.

mod archive;
mod arrays;
mod mutations;
mod uff;
mod uff_modes;
mod uff_text;
