//! How loud a drive is to be, as felt.

use crate::error::CliError;
use unripple::core::{Drive, Responses};
use unripple::field::{Aim, Field};

/// The factor on a drive at its limit that puts the first target at `wanted` dB above the threshold of touch.
///
/// # Errors
/// Levels that are not finite, or higher than the drive limit gives; a target that does not move.
pub fn felt_gain(
    wanted: f64,
    responses: &Responses,
    drive: &Drive,
    aims: &[Aim],
    period: Option<f64>,
) -> Result<f64, CliError> {
    let refused = |expected: String, found: String| {
        Err(CliError::Input(format!("--felt-db: expected {expected}, found {found}")))
    };
    if !wanted.is_finite() {
        return refused("a finite number of dB".into(), wanted.to_string());
    }
    let field = Field::new(responses, drive, 1.0).map_err(CliError::input)?;
    let first = &aims[..aims.len().min(1)];
    let targets = field.measure(first, period).map_err(CliError::input)?.targets;
    match targets.first().and_then(|target| target.felt_level_db) {
        Some(most) if wanted <= most => Ok(10f64.powf((wanted - most) / 20.0)),
        Some(most) => {
            let expected = format!("at most {most:.2} dB above threshold, which the drive limit gives");
            refused(expected, wanted.to_string())
        }
        None => refused("a first target that the drive moves".into(), "silence there".into()),
    }
}
