//! Notes on the figures of a design: how far they reach, and what they leave out.

use super::ground::Ground;
use super::left_out::left_out;
use super::limits::limits;
use super::{Design, Note, milliseconds};

/// The notes on the figures of a surface.
pub(super) fn notes(ground: &Ground<'_>, design: &Design) -> Vec<Note> {
    let mut notes = vec![growth(design), power()];
    notes.extend(limits(ground.surface));
    notes.extend(left_out(ground));
    notes
}

/// How contrast grows with the window, and why not as its square root.
fn growth(design: &Design) -> Note {
    Note {
        topic: "contrast".into(),
        text: format!(
            "around the recommended window it varies as T^{:.2}; as √T only where T is far below the Heisenberg time \
             ({} ms) and the decay time ({} ms)",
            design.window_exponent,
            milliseconds(design.heisenberg_time_s),
            milliseconds(design.decay_time_s)
        ),
    }
}

/// Which power is meant.
fn power() -> Note {
    Note {
        topic: "power at a finger".into(),
        text: "that of the incident wave at its crest; its mean over a period is half".into(),
    }
}
