//! `optimise`: searches the designs whose figures are most or least, with a table of all designs as the only state of the search.
//!
//! A search goes in generations. The designs of a generation are *asked* for by an optimiser, which is *told* the rows of all generations
//! before; they are then computed as a sweep. An optimiser lives as long as the process of the search, and is told each generation once. In
//! another process it is begun anew and told everything again, so that a search that was stopped goes on where it was, on any machine.

mod ask;
mod asker;
mod course;
mod crew;
mod end;
mod figure;
mod folder;
mod front;
mod good;
mod question;
mod report;
mod run;
mod samples;
mod search;
mod stepped;
mod stop;
mod table;
mod told;
mod volume;

pub use ask::Ask;
pub use asker::{Answer, Asker, ByPython};
pub use crew::Crew;
pub use end::{End, EndedBy};
pub use good::{Good, Step};
pub use question::Question;
pub use report::Report;
pub use run::{run, run_with};
pub use search::Search;
pub use stepped::{Missing, Stepped};
