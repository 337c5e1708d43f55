//! A note on outlines whose simply supported polygon seems to stand for a curve.

use unripple::act::Note;
use unripple::core::Surface;

/// A note if a simply supported edge of a sheet with bending stiffness seems to be a curve replaced by
/// straight sides.
pub(crate) fn flattened(surface: &Surface) -> Option<Note> {
    let corners = surface.outline.flattened_corners();
    let text = format!(
        "{corners} corners between supported sides are within 20° of straight, as where a curve was replaced by a polygon: a plate \
         supported along straight sides has higher frequencies than one supported along the curve, however short they are (Babuška's \
         paradox; a circle's first by about a sixth). If a curve is meant, give it as circle_mm, stadium_mm, path_mm or svg"
    );
    (corners > 0 && surface.sheet.young > 0.0).then_some(Note { topic: "supported polygon", text })
}
