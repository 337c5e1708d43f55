//! Measuring by taps: the model by which the force of each is found.

use super::campaign::Campaign;
use super::shelf::{SAID, Shelf};
use crate::TaskError;
use crate::fit;
use serde_json::json;
use unripple::core::Layout;
use unripple_calibrate::measure::{MeasureOptions, TapSession, Wires};
use unripple_calibrate::{FitOptions, Fitted, Verdict};

/// Key of the library's log entry that says by which model forces were found.
const KEY: &str = "taps";

/// A session of taps, by a model that is fitted to the responses between actuators. Where they give no good one, the surface file's has to
/// do, and the log says so.
pub(super) fn session(
    known: &Campaign<'_>,
    shelf: &mut Shelf,
    layout: &Layout,
    wires: &Wires,
    settings: &MeasureOptions,
) -> Result<TapSession, TaskError> {
    let session = TapSession::new(known.surface, layout, wires, known.model.clone(), settings)?;
    let (session, said) = match fitted(known, shelf)? {
        Ok(fitted) => (session.by_fitted(&fitted), None),
        Err(why) => (
            session,
            Some(format!(
                "the forces of taps are found by the model of the surface file, since none could be fitted to the responses between \
                 actuators ({why}): beside masses that the file does not know, and of taps that bounce, responses are wrong"
            )),
        ),
    };
    shelf.library.log(KEY, json!({ "fitted": said.is_none(), SAID: said }))?;
    Ok(session)
}

/// The model fitted to the responses between actuators, or why there is no good one.
fn fitted(known: &Campaign<'_>, shelf: &Shelf) -> Result<Result<Fitted, String>, TaskError> {
    if !known.settings.model {
        return Ok(Err("`no_model`".into()));
    }
    let FitOptions { strays, profile, .. } = FitOptions::default();
    let found =
        known.with_progress(|heard| fit::model(&shelf.library, known.surface, [strays, profile], heard));
    Ok(match found {
        Err(TaskError::Cancelled) => return Err(TaskError::Cancelled),
        Err(error) => Err(error.to_string()),
        Ok((_, fitted)) => match &fitted.verdict {
            Verdict::Good => Ok(fitted),
            Verdict::Doubtful { why, .. } => Err(why.clone()),
        },
    })
}
