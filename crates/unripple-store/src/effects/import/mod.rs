//! Effects imported from files made for phones and controllers.

mod ahap;
mod haptic;
mod hjif;
mod node;
mod notes;
mod pitch;

use super::near;
use crate::StoreError;
use crate::file::LARGEST_TEXT;
use node::Node;
use notes::Notes;
use std::path::Path;
use unripple_effects::Score;

/// Reads a score of haptic events from the text of a file made for phones and controllers. The format follows from
/// the file's extension: `.haptic` (Lofelt, Meta), `.ahap` (Apple) or `.hjif` (ISO/IEC 23090-31).
///
/// The score starts with a touch and plays at the finger. Short events become focused pulses, whatever their pitch;
/// long ones become waveforms. A pitch from 0 to 1 becomes a frequency from 65 to 300 Hz. Audio events are left out.
///
/// # Errors
/// [`StoreError::Content`], with the place in the file, what was expected and what was found there.
///
/// ```
/// let text = r#"{"version": {"major": 1, "minor": 0, "patch": 0}, "signals": {"continuous": {"envelopes": {
///     "amplitude": [{"time": 0.0, "amplitude": 0.2}, {"time": 0.5, "amplitude": 0.9}]}}}}"#;
/// let score = unripple_store::import_haptic(text, "swell.haptic")?;
/// assert_eq!(score.events.len(), 1);
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
pub fn import_haptic(text: &str, file: &str) -> Result<Score, StoreError> {
    if text.len() > LARGEST_TEXT {
        return Err(crate::file::too_large(file, text.len() as u64));
    }
    let ending = Path::new(file).extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    let read = match ending.as_str() {
        "haptic" => haptic::read,
        "ahap" => ahap::read,
        "hjif" => hjif::read,
        _ => {
            let found = format!("a name that ends in `{ending}`");
            return Err(StoreError::content(file, "a .haptic, .ahap or .hjif file", found));
        }
    };
    let value = serde_json::from_str(text).map_err(|e| StoreError::content(file, "JSON", e.to_string()))?;
    let mut notes = Notes::new(file);
    read(&Node::root(&value, file), &mut notes)?;
    notes.score()
}
