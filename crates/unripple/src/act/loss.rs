//! Notes on what a method loses below the drive limit, or does not reach at the limit.

use super::{Act, ActError, Note, Readouts, Strength};
use crate::core::Drive;
use crate::field::Aim;
use crate::focus::{Focused, Focuser, Method, Options, Shaping, focus};

/// A note that the limited method gave up, and the drive is at its limit without being shaped by it.
pub(super) fn gave_up(act: &Act<'_>, focused: &Focused, strength: &Strength) -> Option<Note> {
    let Shaping::GaveUp { attempts } = focused.shaping else { return None };
    let text = || {
        format!(
            "push has no effect: no drive within the limits was found that gives the targets together the levels it asks for, nor \
             lower ones in {attempts} attempts, each with half the rise of the one before; the drive is that of {}, at its limit",
            unlimited(act, focused)
        )
    };
    strength.at_limit().then(|| Note { topic: "method", text: text() })
}

/// A note on what a method loses if its drive is below the limit.
pub(super) fn idle(
    act: &Act<'_>,
    (focuser, on): (&Focuser<'_>, &Readouts<'_>),
    focused: &Focused,
    drive: &Drive,
    aims: &[Aim],
    scaled: bool,
) -> Result<Option<Note>, ActError> {
    let text = match focused.method {
        Method::Limited => match (focused.shaping, scaled) {
            (Shaping::Shaped, true) => {
                "no drive was found for this level: the drive is the one for the limit, scaled down".into()
            }
            // What is not shaped at the limit is not shaped below it.
            (Shaping::Unshaped, _) | (Shaping::GaveUp { .. }, true) => format!(
                "the limit is not reached at this level: the drive is that of {}, and push has no effect",
                unlimited(act, focused)
            ),
            (Shaping::Shaped | Shaping::GaveUp { .. }, false) => return Ok(None),
        },
        Method::OneBit => one_bit(act, (focuser, on), drive, aims)?,
        _ => return Ok(None),
    };
    Ok(Some(Note { topic: "method", text }))
}

/// The method and strength that give the drive of [`Method::Limited`] where no limit shapes it.
fn unlimited(act: &Act<'_>, focused: &Focused) -> String {
    let strength = act.options.strength.unwrap_or(focused.method.strength());
    format!("{} with a strength of {strength}", Method::Concentrate)
}

/// Text that compares a one-bit drive below the limit with time reversal at the same peak.
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
