//! Options that say which places a search chooses from.

use super::heading;
use crate::error::CliError;
use crate::typed::{each, of, places};
use clap::Args;
use unripple_tasks::Place;
use unripple_tasks::text_forms::{distances, polygon};

/// Distances from the rim, polygons, and places one by one.
#[derive(Debug, Args)]
pub struct AreaOptions {
    /// Least and greatest distance of places from the rim, in mm; by default anywhere.
    #[arg(long, value_name = "LEAST,MOST", help_heading = heading::PLACES)]
    pub rim_mm: Option<String>,
    /// A polygon in which places must lie, as its corners in mm. Repeatable: then in any of them.
    #[arg(long, value_name = "X,Y,X,Y,X,Y...", allow_hyphen_values = true, help_heading = heading::PLACES)]
    pub within: Vec<String>,
    /// A polygon in which no place may lie, and into which no actuator may reach, as its corners in mm. Repeatable.
    #[arg(long, value_name = "X,Y,X,Y,X,Y...", allow_hyphen_values = true, help_heading = heading::PLACES)]
    pub keep_out: Vec<String>,
    /// A place to choose from, in mm, instead of those of a grid. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = heading::PLACES)]
    pub place: Vec<String>,
}

impl AreaOptions {
    /// Least and greatest distance from the rim, in m.
    pub fn rim(&self) -> Result<Option<[f64; 2]>, CliError> {
        of("--rim-mm", self.rim_mm.as_deref().map(distances).transpose())
    }

    /// The polygons in which places must lie, as their corners in m.
    pub fn within(&self) -> Result<Vec<Vec<Place>>, CliError> {
        each(&self.within, "--within", polygon)
    }

    /// The polygons in which no place may lie, as their corners in m.
    pub fn keep_out(&self) -> Result<Vec<Vec<Place>>, CliError> {
        each(&self.keep_out, "--keep-out", polygon)
    }

    /// The places to choose from, in m; none for those of a grid.
    pub fn places(&self) -> Result<Vec<Place>, CliError> {
        places(&self.place, "--place")
    }
}
