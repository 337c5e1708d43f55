//! `reproduce`: computes the paper's table and figures again, and shows them beside the printed ones on one
//! page.

mod ask;
mod cavities;
mod coils;
mod contrast;
mod fields;
mod fig1;
mod fig2;
mod fig3;
mod fig4;
mod finger;
mod levels;
mod modes;
mod numbers;
mod page;
mod places;
mod repetition;
mod report;
mod run;
mod section;
mod setup;
mod table1;

pub use ask::Ask;
pub use report::{ComparedReport, FigureReport, PredictedReport, Report, SectionReport};
pub use run::run;
pub(crate) use section::{Compared, Picture, Predicted, Section};
pub(crate) use setup::PaperSetup;
