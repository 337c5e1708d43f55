//! Options of `unripple import`.

use super::names::{KindName, PerName, QuantityName};
use super::{examples, heading};
use crate::common::Common;
use crate::error::CliError;
use crate::typed::{each, of, seconds};
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::import::Ask;
use unripple_tasks::text_forms::{band, place, wire};

/// Options of `import`.
#[derive(Debug, Args)]
#[command(after_help = examples::IMPORT)]
pub struct ImportOptions {
    /// A surface file, or the name of a built-in surface: the sheet that was measured, with its actuators.
    pub surface: String,
    /// Files with responses or modes (.uff, .unv, .csv, .npz, .mat), or folders of WAV files, such as `export` writes.
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// What the responses are, if the file does not say it.
    #[arg(long, value_enum, help_heading = heading::MEASURED)]
    pub kind: Option<KindName>,
    /// What was measured, if neither the file nor --unit says it.
    #[arg(long, value_enum, help_heading = heading::MEASURED)]
    pub quantity: Option<QuantityName>,
    /// Unit of what was measured, if the file does not say it: m/s, mm/s, um, m/s2, g; a number before it multiplies it, as in "0.5 m/s".
    #[arg(long, value_name = "UNIT", help_heading = heading::MEASURED)]
    pub unit: Option<String>,
    /// Unit of the reference, if the file does not say it.
    #[arg(long, value_enum, help_heading = heading::MEASURED)]
    pub per: Option<PerName>,
    /// Drive of the actuators in their own unit for one unit of the reference: 2 if a volt makes 2 N.
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true, help_heading = heading::MEASURED)]
    pub drive_per_reference: Option<f64>,
    /// Lowest and highest frequency that are kept, in Hz; by default those of the files.
    #[arg(long, value_name = "LOW,HIGH", help_heading = heading::MEASURED)]
    pub band_hz: Option<String>,
    /// Table (CSV) with a column `file`, `column` or `node`, and columns `actuator`, `x_mm` and `y_mm`, of what names do not say.
    #[arg(long, value_name = "CSV", help_heading = heading::PLACES)]
    pub table: Option<PathBuf>,
    /// How names of WAV files or columns say actuator and place, as in "{actuator}_{x_mm}_{y_mm}.wav"; {any} stands for what says nothing.
    #[arg(long, value_name = "PATTERN", help_heading = heading::PLACES)]
    pub pattern: Option<String>,
    /// Unit of the places, before that of the file: m, cm, mm, in.
    #[arg(long, value_name = "UNIT", help_heading = heading::PLACES)]
    pub length_unit: Option<String>,
    /// Add this to all places of the files, in mm.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = heading::PLACES)]
    pub offset_mm: Option<String>,
    /// Name or node of an actuator in the files, where neither its name nor its place tells. Repeatable.
    #[arg(long, value_name = "NAME=NODE", help_heading = heading::ACTUATORS)]
    pub actuator: Vec<String>,
    /// An actuator that was not measured. Repeatable.
    #[arg(long, value_name = "NAME", help_heading = heading::ACTUATORS)]
    pub without: Vec<String>,
    /// Length of the responses, in ms; by default that of the files, or until modes have decayed by 60 dB.
    #[arg(long, value_name = "MS", allow_negative_numbers = true, help_heading = heading::TIME)]
    pub length_ms: Option<f64>,
    /// Folder of the library to write.
    #[arg(short, long, value_name = "LIBRARY", help_heading = heading::RESULTS)]
    pub output: PathBuf,
}

impl ImportOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<Ask, CliError> {
        let offset = of("--offset-mm", self.offset_mm.as_deref().map(place).transpose())?;
        Ok(Ask {
            surface: common.surface(&self.surface),
            files: self.files.clone(),
            table: self.table.clone(),
            pattern: self.pattern.clone(),
            kind: self.kind.map(Into::into),
            quantity: self.quantity.map(Into::into),
            unit: self.unit.clone(),
            per: self.per.map(Into::into),
            drive_per_reference: self.drive_per_reference,
            length_unit: self.length_unit.clone(),
            offset_m: offset.unwrap_or_default(),
            actuator_names: each(&self.actuator, "--actuator", wire)?,
            without: self.without.clone(),
            band_hz: of("--band-hz", self.band_hz.as_deref().map(band).transpose())?,
            length_s: seconds(self.length_ms, "--length-ms")?,
            output: self.output.clone(),
        })
    }
}
