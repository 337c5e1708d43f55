//! Checks of a focus on the model: contrast, and the level that a fingertip feels at the focus and elsewhere.

use super::check::Check;
use crate::judge::{self, Judging, Models};
use crate::position::anywhere;
use crate::{Solved, TaskError};
use unripple::core::{Contact, Responses, Surface};
use unripple::field::{Aim, Field, TargetFigures};
use unripple::focus::{Options, Target, focus};
use unripple_live::Window;

/// A level in dB above threshold that nearly everybody feels: thresholds of persons differ by 6 dB.
const CLEAR: f64 = 12.0;

/// Contrast below which a focus is reported as doubtful.
const WEAK: f64 = 5.0;

/// Least difference in dB between the felt level at the focus and the largest one elsewhere, for the focus
/// to be felt as distinct.
const APART: f64 = 3.0;

/// Cells of the evaluation grid per shortest wavelength: enough for a verdict.
const CELLS: f64 = 4.0;

/// Checks a focus on the model, with and without the load of a finger: contrast, felt level, and level felt
/// elsewhere. The drive is computed from `model`, the modes of the band, and evaluated on modes above the
/// band as well, as in every other task.
pub fn checks(
    surface: &Surface,
    model: &Responses,
    window: Window,
    solved: &Solved,
) -> Result<Vec<Check>, TaskError> {
    let at = anywhere(&surface.outline);
    let options = Options { window: window.seconds, limit: surface.emission.limit, ..Options::default() };
    let drive = focus(model, &[Target::at(at)], &options).map_err(TaskError::input)?.drive.as_emitted();
    let judged = |responses: &Responses| -> Result<TargetFigures, TaskError> {
        let field = Field::new(responses, &drive, CELLS).map_err(TaskError::input)?;
        let aim = Aim { points: vec![at], instant: window.seconds };
        let measured = field.measure(&[aim], None).map_err(TaskError::input)?;
        measured.targets.into_iter().next().ok_or_else(|| TaskError::Work("no target was evaluated".into()))
    };
    let contacts = [Contact { at, finger: surface.finger }];
    let (Models { free, under }, judging) = judge::models(surface, None, &contacts, solved)?;
    let (free, under) = (judged(&free)?, judged(under.as_ref().unwrap_or(&free))?);
    Ok(vec![contrast(&free, window, &judging), level(&free, &under), spread(&free)])
}

fn contrast(free: &TargetFigures, window: Window, judging: &Judging) -> Check {
    let contrast = free.contrast.unwrap_or(0.0);
    let why = judging.why().map_or(String::new(), |why| format!("; {why}"));
    let found = format!(
        "contrast {contrast:.1} in a window of {:.1} ms, on the modes up to {} Hz{why}",
        1e3 * window.seconds,
        judging.hz
    );
    match contrast >= WEAK {
        true => Check::good("focus", found),
        false => Check::doubtful(
            "focus",
            found,
            "more actuators, a longer window or a sheet that rings longer: `unripple design` shows what each gives",
        ),
    }
}

fn level(free: &TargetFigures, under: &TargetFigures) -> Check {
    let db = |figures: &TargetFigures| figures.felt_level_db.unwrap_or(f64::NEG_INFINITY);
    let (alone, pressed) = (db(free), db(under));
    let found = format!(
        "{pressed:.0} dB above the threshold of touch under a finger at the drive's limit ({alone:.0} dB without the finger)"
    );
    if pressed < 0.0 {
        let fix = "raise `limit`, use stronger actuators or more of them, or a lighter sheet";
        return Check::failed("level", found, fix);
    }
    match pressed >= CLEAR {
        true => Check::good("level", found),
        false => Check::doubtful(
            "level",
            found,
            "thresholds differ between persons by 6 dB: raise `limit`, or choose effects with more of their energy around 250 \
             Hz",
        ),
    }
}

fn spread(free: &TargetFigures) -> Check {
    let Some(worst) = free.felt_worst_spot_db else {
        return Check::skipped("elsewhere", "nothing moves outside the focus");
    };
    let found = format!("the largest level felt elsewhere is {worst:.1} dB below that at the focus");
    match worst >= APART {
        true => Check::good("elsewhere", found),
        false => Check::doubtful(
            "elsewhere",
            found,
            "vibration is felt nearly everywhere: --method felt lowers it outside the focus",
        ),
    }
}
