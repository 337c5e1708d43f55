//! Options of `unripple export`.

use super::names::FormatName;
use super::{examples, heading};
use crate::common::Common;
use crate::error::CliError;
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::export::Ask;

/// Options of `export`.
#[derive(Debug, Args)]
#[command(after_help = examples::EXPORT)]
pub struct ExportOptions {
    /// A library of responses.
    pub library: String,
    /// Folder for WAV, or file for other formats. An earlier export is replaced if it is WAV or SOFA; other files must not exist yet.
    #[arg(short, long, value_name = "DIR|FILE")]
    pub output: PathBuf,
    /// Format; by default the one that the ending of the name implies (.sofa, .uff, .unv, .mat), or WAV if it has none.
    #[arg(long, value_enum)]
    pub format: Option<FormatName>,
    /// SOFA: author to contact, with an address.
    #[arg(long, value_name = "TEXT", help_heading = heading::SOFA)]
    pub author: Option<String>,
    /// SOFA: organization where the responses were measured or computed.
    #[arg(long, value_name = "TEXT", help_heading = heading::SOFA)]
    pub organization: Option<String>,
    /// SOFA: licence of the data.
    #[arg(long, value_name = "TEXT", help_heading = heading::SOFA)]
    pub license: Option<String>,
}

impl ExportOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<Ask, CliError> {
        common.without_surface()?;
        Ok(Ask {
            library: self.library.clone().into(),
            output: self.output.clone(),
            format: self.format.map(Into::into),
            author: self.author.clone(),
            organization: self.organization.clone(),
            license: self.license.clone(),
        })
    }
}
