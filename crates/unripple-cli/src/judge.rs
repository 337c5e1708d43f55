//! A drive on a surface, judged before people's eyes.

use crate::error::CliError;
use crate::progress::Terminal;
use unripple::act;
pub use unripple::act::{CELLS, Judged, accuracy};
use unripple::core::{Contact, Responses, Surface};
use unripple::field::{Aim, Field};

pub fn model(surface: &Surface, max_hz: Option<f64>, contacts: &[Contact]) -> Result<Responses, CliError> {
    Ok(act::model(surface, max_hz, contacts)?)
}

pub fn judge(
    surface: &Surface,
    field: &Field,
    aims: &[Aim],
    period: Option<f64>,
    until: f64,
) -> Result<Judged, CliError> {
    Ok(unripple_tasks::judge::judge(surface, field, aims, period, until, &mut Terminal::default())?)
}

pub fn seen<T>(length: f64, work: impl FnOnce() -> Result<T, act::ActError>) -> Result<T, CliError> {
    Ok(unripple_tasks::judge::seen(length, &mut Terminal::default(), work)?)
}
