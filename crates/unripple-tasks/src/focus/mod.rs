//! `focus`: computes a drive that focuses on points and shapes, with its report and its figures.

mod ask;
mod check;
mod made;
mod report;
mod run;
mod write;

pub use ask::{Ask, Losses};
pub use check::check;
pub use made::Made;
pub use report::Report;
pub use run::{make, make_on, run, run_on};
pub use write::figures;
