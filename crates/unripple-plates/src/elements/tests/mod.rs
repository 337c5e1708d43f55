//! Truth: closed forms, published numbers, rates of convergence, and properties of the space.

mod bessel;
mod circles;
mod fabrics;
mod kinks;
mod meshes;
mod patch;
mod readout;
mod relative;
mod solve;
mod squares;
