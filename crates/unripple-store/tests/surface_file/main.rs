//! The surface file: what it means, the way back to a file, and its faults.

mod arrays;
mod exciters;
mod faults;
mod good;
mod layers;
mod rim_faults;
mod rims;
mod sheet_faults;
mod surfaces;
mod uneven;
