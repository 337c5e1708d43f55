//! The window of a focus that a page requests, and the longest one that is accepted: responses have decayed
//! after it.

use super::{ComputeWorker, Unfinished};
use crate::edition::Edition;
use std::sync::Arc;
use unripple::act::{self, Note};
use unripple::core::{Pole, Responses, window_samples};
use unripple::focus::FocusError;
use unripple_tasks::{Progress, TaskError};

/// Decay, in nepers, after which a response is over: to 1/1000, or 60 dB, as reverberation times are defined. What a longer window adds
/// is silence, and its computation would only keep other pages waiting.
const OVER: f64 = 6.907_755;

impl ComputeWorker {
    /// The window in s that is asked for, or else the recommended one with a note on the reason for it.
    pub(super) fn window(
        &self,
        of: &Arc<Edition>,
        responses: &Arc<Responses>,
        asked: Option<f64>,
        progress: &mut dyn Progress,
    ) -> Result<(f64, Option<Note>), Unfinished> {
        let stored = of.edit == 0 && self.stored.is_some();
        let known = self.draft.as_ref().filter(|(edit, _)| *edit == of.edit && !stored);
        let design = known.map(|(_, draft)| draft.design());
        if let Some(seconds) = asked {
            check(responses, seconds, design.map_or(0.0, |design| design.window_recommended_s))?;
            return Ok((seconds, None));
        }
        let (seconds, text) = match design {
            Some(design) => (design.window_recommended_s, design.window_text()),
            None => {
                let (of, responses) = (of.clone(), responses.clone());
                let chosen =
                    self.aside(progress, move |_| Ok(act::chosen_window(&of.surface, &responses)))?;
                (chosen.seconds, chosen.text())
            }
        };
        Ok((seconds, Some(Note { topic: "window", text })))
    }
}

/// Refuses a window of `seconds` into which no wave fits, or which goes on after the responses are over, in the words of the command line.
/// The `recommended` window (s) is always allowed.
fn check(responses: &Responses, seconds: f64, recommended: f64) -> Result<(), Unfinished> {
    let conditions = responses.conditions();
    act::carries(conditions, seconds).map_err(|error| format!("window_ms: {error}"))?;
    let found = window_samples(seconds, conditions.rate).saturating_add(1);
    let (most, until) = match responses {
        Responses::Sampled(sampled) => (sampled.samples(), ""),
        Responses::Modal(modal) => {
            // A sheet that moves as a whole has no response that goes on.
            let ringing = modal.poles.iter().filter(|pole| pole.omega > 0.0);
            let slowest = ringing.map(decay).fold(f64::INFINITY, f64::min);
            let lasting = (OVER / slowest).max(recommended);
            (window_samples(lasting, conditions.rate).saturating_add(1), " until they have fallen by 60 dB")
        }
    };
    if found <= most {
        return Ok(());
    }
    let expected = format!("at most {most}, the length of the responses{until}");
    Err(TaskError::work(FocusError::Count { what: "samples of the window", expected, found }).into())
}

/// Decay rate of the slower part of a mode, in 1/s.
fn decay(pole: &Pole) -> f64 {
    let square = (pole.sigma - pole.omega) * (pole.sigma + pole.omega);
    pole.sigma - square.max(0.0).sqrt()
}
