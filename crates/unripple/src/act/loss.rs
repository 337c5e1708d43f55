//! What a method loses below the limit of the drive, as a note.

use super::{Act, ActError, Note, Readouts};
use crate::core::Drive;
use crate::field::Aim;
use crate::focus::{Focused, Focuser, Method, Options, focus};

/// A note on what a method loses below the limit of the drive.
pub(super) fn idle(
    act: &Act<'_>,
    (focuser, on): (&Focuser<'_>, &Readouts<'_>),
    focused: &Focused,
    drive: &Drive,
    aims: &[Aim],
    scaled: bool,
) -> Result<Option<Note>, ActError> {
    let text = match focused.method {
        Method::Limited if scaled => {
            "no drive was found for this level: the drive is the one for the limit, scaled down".into()
        }
        Method::Limited if !focused.shaped => format!(
            "the limit is not reached at this level: the drive is that of concentrate with a strength of {}, and push has no \
             effect",
            act.options.strength.unwrap_or(focused.method.strength())
        ),
        Method::OneBit => one_bit(act, (focuser, on), drive, aims)?,
        _ => return Ok(None),
    };
    Ok(Some(Note { topic: "method", text }))
}

/// One-bit below the limit, beside time reversal at the same peak.
fn one_bit(
    act: &Act<'_>,
    (focuser, on): (&Focuser<'_>, &Readouts<'_>),
    drive: &Drive,
    aims: &[Aim],
) -> Result<String, ActError> {
    let options = Options { method: Method::TimeReversal, ..act.options.clone() };
    let reversed = focus(focuser.responses(), act.targets, &options)?.drive;
    let peak = |drive: &Drive| -> Result<f64, ActError> {
        let Some(aim) = aims.first() else { return Ok(0.0) };
        let traces = on.fine()?.field(drive)?.traces(&aim.points, aim.instant)?;
        let sum: f64 = traces.iter().filter_map(|trace| trace.velocity.last()).sum();
        Ok((sum / traces.len().max(1) as f64).abs())
    };
    let share = peak(drive)? / peak(&reversed)?;
    let said = "one-bit gives the highest peak for a drive at the limit, but this level needs less";
    if share.is_nan() || share > 1.0 {
        return Ok(format!(
            "{said}: its drive is scaled down as a whole, but time reversal would exceed the limit for the same peak"
        ));
    }
    let energy = share * share * reversed.energy() / drive.energy();
    Ok(format!(
        "{said}: its drive is scaled down as a whole, and time reversal gives the same peak velocity for {energy:.2} times the energy"
    ))
}
