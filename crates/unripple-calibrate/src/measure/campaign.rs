//! Measurement of all points of a plan, one by one, into a sink from which a later run can resume.

use super::{Channel, HammerSession, Listen, Rig, Session, TapSession};
use crate::CalibrateError;
use std::ops::ControlFlow;
use unripple_core::Point;

/// Storage of measured points, to which one point is written at a time.
pub trait Sink {
    /// Indices of the points that are still to be measured.
    fn missing(&self) -> Vec<usize>;

    /// Stores the responses of point `number` so that they survive even a crash of the program. `fault` is
    /// the reason why the point is bad; `None` for a good point.
    ///
    /// # Errors
    /// [`CalibrateError::Sink`] if the point could not be stored.
    fn keep(&mut self, number: usize, channel: &Channel, fault: Option<&str>) -> Result<(), CalibrateError>;
}

/// Progress of a campaign.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// Number of points stored so far, in this run.
    pub done: usize,
    /// Number of points that were missing when this run began.
    pub total: usize,
    /// Index of the point stored last.
    pub number: usize,
    /// Number of recordings of that point.
    pub attempts: u64,
    /// Reason why the point is bad; `None` if it is good.
    pub fault: Option<String>,
}

/// Way of measuring a place: by a probe, by taps, or by blows of a hammer with a force sensor.
#[derive(Clone, Debug)]
pub enum Way {
    /// By a probe on the surface, while the actuators drive.
    Probe(Box<Session>),
    /// By taps on the surface, which the actuators record as sensors.
    Tap(Box<TapSession>),
    /// By blows of a hammer whose force is recorded, as the actuators' signals as sensors are.
    Hammer(Box<HammerSession>),
}

impl Way {
    fn measure(
        &self,
        rig: &mut dyn Rig,
        number: usize,
        at: Point,
        attempt: u64,
    ) -> Result<Channel, CalibrateError> {
        match self {
            Self::Probe(session) => {
                let found = session.measure(rig, number, at, attempt, Listen::Probe)?;
                found.into_iter().next().ok_or_else(|| CalibrateError::Recording {
                    what: "recording".into(),
                    expected: "signal of the probe".into(),
                    found: "nothing".into(),
                })
            }
            Self::Tap(session) => session.measure(rig, number, at, attempt),
            Self::Hammer(session) => session.measure(rig, number, at, attempt),
        }
    }

    fn fault(&self, channel: &Channel) -> Option<String> {
        match self {
            Self::Probe(session) => session.fault(channel),
            Self::Tap(session) => session.fault(channel),
            Self::Hammer(session) => session.fault(channel),
        }
    }
}

/// Measures every point that is missing in a sink, in order, and stores each as soon as it is finished;
/// returns the number of bad points. A bad point is measured again, up to `again` times, and the best of its
/// recordings is stored. `tell` is called after each point; the campaign ends early if it returns
/// [`ControlFlow::Break`].
///
/// # Errors
/// Those of rig, device and sink, and [`CalibrateError::Count`] for a missing point that is not among `points`. Points stored
/// before stay stored, and a later run continues from there.
pub fn campaign(
    rig: &mut dyn Rig,
    way: &Way,
    points: &[Point],
    sink: &mut dyn Sink,
    again: u64,
    tell: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<usize, CalibrateError> {
    let missing = sink.missing();
    let mut bad = 0;
    for (done, number) in missing.iter().copied().enumerate() {
        let Some(at) = points.get(number).copied() else {
            let expected = format!("less than {}", points.len());
            return Err(CalibrateError::Count { what: "number of a missing point", expected, found: number });
        };
        let (mut best, mut attempts) = (None::<(f64, Channel, Option<String>)>, 0);
        while attempts <= again && best.as_ref().is_none_or(|(_, _, fault)| fault.is_some()) {
            let channel = match way.measure(rig, number, at, attempts) {
                // A gap is a passing failure of the device.
                Err(CalibrateError::Gap { .. }) if attempts < again => {
                    attempts += 1;
                    continue;
                }
                other => other?,
            };
            attempts += 1;
            let fault = way.fault(&channel);
            let worst = channel.quality.iter().map(|q| q.snr_db).fold(f64::INFINITY, f64::min);
            if fault.is_none() || best.as_ref().is_none_or(|(before, _, _)| worst > *before) {
                best = Some((worst, channel, fault));
            }
        }
        let Some((_, channel, fault)) = best else { continue };
        sink.keep(number, &channel, fault.as_deref())?;
        bad += usize::from(fault.is_some());
        let progress = Progress { done: done + 1, total: missing.len(), number, attempts, fault };
        if tell(&progress).is_break() {
            break;
        }
    }
    Ok(bad)
}
