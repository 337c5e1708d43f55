//! Measurement by taps: the model from which the force of each tap is computed.

use super::campaign::Campaign;
use super::filler::{LibraryFiller, SAID};
use super::finish::points as counted;
use crate::TaskError;
use crate::fit;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use unripple::core::Layout;
use unripple_calibrate::measure::{MeasureOptions, Sink, TapSession, Wires};
use unripple_calibrate::{FitOptions, Fitted, Verdict};
use unripple_store::Library;

/// Key of the log entries on the model from which the forces of taps are computed: an entry of each point,
/// and one of the library for points that use the model of the surface file.
const KEY: &str = "taps";

/// Prepares a session of taps with a model fitted to the responses between actuators. If no good model can
/// be fitted, that of the surface file is used, and the log of each point that is still to be measured says
/// so, and why.
pub(super) fn session(
    known: &Campaign<'_>,
    filler: &mut LibraryFiller,
    layout: &Layout,
    wires: &Wires,
    settings: &MeasureOptions,
) -> Result<TapSession, TaskError> {
    let surface = known.surface;
    let session = TapSession::new(surface, layout, wires, known.model.clone(), settings)?
        .by_scales(filler.sensors.clone());
    let missing = filler.missing();
    if missing.is_empty() {
        return Ok(session);
    }
    let (session, why) = match fitted(known, filler)? {
        Ok(fitted) => (session.by_fitted(&fitted), Value::Null),
        Err(why) => (session, Value::String(why)),
    };
    let log = json!({ KEY: { "fitted": why.is_null(), "why": why } });
    filler
        .library
        .log_points(missing.into_iter().map(|point| (point, log.clone())).collect::<BTreeMap<_, _>>())?;
    let said = said(&filler.library);
    filler.library.log(KEY, said.map_or(Value::Null, |said| json!({ SAID: said })))?;
    Ok(session)
}

/// Sentence on how many points were measured with the model of the surface file, and why; `None` if none
/// was.
fn said(library: &Library) -> Option<String> {
    let log = |point: usize| library.logged_point(point)?.get(KEY);
    let unfitted = |point: &usize| log(*point).is_some_and(|log| log["fitted"] == false);
    let points: Vec<usize> = (0..library.points().len()).filter(unfitted).collect();
    let (last, count) = (points.last()?, counted(points.len()));
    let why = log(*last).and_then(|log| log["why"].as_str()).unwrap_or("not said");
    Some(format!(
        "at {count} the forces of taps are computed with the model of the surface file, since no model was fitted to the responses \
         between actuators ({why}): near masses that the file does not contain, and where taps bounce, responses may be wrong"
    ))
}

/// The model fitted to the responses between actuators, or why there is no good one.
fn fitted(known: &Campaign<'_>, filler: &LibraryFiller) -> Result<Result<Fitted, String>, TaskError> {
    if !known.settings.model {
        return Ok(Err("`no_model`".into()));
    }
    let FitOptions { strays, profile, .. } = FitOptions::default();
    let found =
        known.with_progress(|heard| fit::model(&filler.library, known.surface, [strays, profile], heard));
    Ok(match found {
        Err(TaskError::Cancelled) => return Err(TaskError::Cancelled),
        Err(error) => Err(error.to_string()),
        Ok((_, fitted)) => match &fitted.verdict {
            Verdict::Good => Ok(fitted),
            Verdict::Doubtful { why, .. } => Err(why.clone()),
        },
    })
}
