//! Options of the pictures that a command writes.

use super::heading;
use clap::Args;

/// Whether pictures are written, and how wide they are.
#[derive(Debug, Args)]
pub struct FigureOptions {
    /// Write no pictures.
    #[arg(long, help_heading = heading::RESULTS)]
    pub no_figures: bool,
    /// Width of the pictures, in columns of a printed page: 1 (86 mm) or 2 (178 mm); by default it depends on the picture.
    #[arg(long, value_name = "1|2", help_heading = heading::RESULTS)]
    pub columns: Option<usize>,
}
