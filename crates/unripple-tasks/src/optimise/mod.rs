//! `optimise`: searches the designs whose figures are most or least, with a table of all designs as the only state of the search.
//!
//! A search goes in generations. The designs of a generation are *asked* for by an optimiser, which is *told* the rows of all generations
//! before; they are then computed as a sweep. An optimiser is begun anew for each generation and told everything again, so that a search
//! that was stopped goes on where it was, on any machine.

mod ask;
mod asker;
mod course;
mod figure;
mod folder;
mod front;
mod good;
mod report;
mod run;
mod samples;
mod search;
mod table;
mod told;

pub use ask::Ask;
pub use asker::{Asker, by_python};
pub use good::{Good, Step};
pub use report::Report;
pub use run::{Crew, run, run_with};
pub use search::Search;
