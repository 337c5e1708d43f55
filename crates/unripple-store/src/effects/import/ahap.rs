//! AHAP, Apple's haptic patterns: transient and continuous events, whose intensity and sharpness curves control.
//!
//! Attack, decay and release of events are not followed, and sounds for the ear are left out.

use super::node::Node;
use super::notes::Notes;
use super::pitch::pitch;
use crate::StoreError;
use unripple_effects::limits::{SHARE, TIME};

/// Types of AHAP events that are known; the two for the ear are passed over.
const EVENTS: [&str; 4] = ["HapticTransient", "HapticContinuous", "AudioContinuous", "AudioCustom"];
/// Largest number of points of all curves of one kind. Every event looks its values up among them, so the work grows with their
/// number times that of the events.
const MOST_POINTS: usize = 16_384;
/// Intensity and sharpness of events that do not say. The middle of their range.
const DEFAULT: f64 = 0.5;
/// Length of a continuous event that does not say, in s.
const DURATION: f64 = 0.1;
/// Continuous events shorter than this are pulses, in s. A thousandth of a second holds less than a third of a period
/// of the highest pitch, 300 Hz.
const SHORTEST: f64 = 1e-3;

pub(super) fn read(root: &Node, notes: &mut Notes) -> Result<(), StoreError> {
    let items = root.items("Pattern")?;
    let intensity = Control::read(&items, "HapticIntensityControl", 1.0, SHARE)?;
    let sharpness = Control::read(&items, "HapticSharpnessControl", 0.0, [-1.0, 1.0])?;
    for item in &items {
        if let Some(parameter) = item.get("Parameter") {
            return Err(parameter.refuse("a ParameterCurve in place of a Parameter, which is not supported"));
        }
        let Some(event) = item.get("Event") else {
            item.require("ParameterCurve", "or Event")?;
            continue;
        };
        let kind = event.require("EventType", "a text")?.one_of(&EVENTS)?;
        let at = event.number_of("Time", TIME)?;
        let (strength, sharp) =
            (parameter(&event, "HapticIntensity")?, parameter(&event, "HapticSharpness")?);
        match kind {
            "HapticTransient" => notes.pulse(at, strength * intensity.at(at))?,
            "HapticContinuous" => {
                let duration = event.number_or("EventDuration", DURATION, TIME)?;
                if duration < SHORTEST {
                    notes.pulse(at, strength * intensity.at(at))?;
                    continue;
                }
                let amplitude = intensity.over(at, duration, |control| strength * control);
                let frequency = sharpness.over(at, duration, |control| pitch(sharp + control));
                notes.wave(at, amplitude, frequency)?;
            }
            _ => {}
        }
    }
    Ok(())
}

/// A parameter of an event, by its name.
fn parameter(event: &Node, name: &str) -> Result<f64, StoreError> {
    if event.get("EventParameters").is_none() {
        return Ok(DEFAULT);
    }
    for item in event.items("EventParameters")? {
        if item.require("ParameterID", "a text")?.text()? == name {
            return item.number_of("ParameterValue", SHARE);
        }
    }
    Ok(DEFAULT)
}

/// What the curves of one name add up to: each holds from its start, and its last value until the next starts.
struct Control {
    rest: f64,
    points: Vec<(f64, f64)>,
}

impl Control {
    fn read(items: &[Node], name: &str, rest: f64, range: [f64; 2]) -> Result<Self, StoreError> {
        let mut curves: Vec<(f64, Vec<(f64, f64)>)> = Vec::new();
        let mut count = 0;
        for item in items {
            let Some(curve) = item.get("ParameterCurve") else { continue };
            if curve.require("ParameterID", "a text")?.text()? != name {
                continue;
            }
            let start = curve.number_or("Time", 0.0, TIME)?;
            let controls = curve.items("ParameterCurveControlPoints")?;
            count += controls.len();
            if count > MOST_POINTS {
                return Err(curve.refuse(format!("at most {MOST_POINTS} points of {name} in all")));
            }
            let point =
                |c: &Node| Ok((start + c.number_of("Time", TIME)?, c.number_of("ParameterValue", range)?));
            let points = controls.iter().map(point).collect::<Result<Vec<_>, StoreError>>()?;
            Node::ascending(&controls, "Time", &points)?;
            curves.push((start, points));
        }
        curves.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut control = Self { rest, points: Vec::new() };
        for (_, points) in curves {
            let Some(&(first, _)) = points.first() else { continue };
            let held = control.at(first);
            control.points.truncate(control.points.partition_point(|p| p.0 < first));
            control.points.push((first, held));
            control.points.extend(points);
        }
        Ok(control)
    }

    /// The value at a time; at a step, the later one.
    fn at(&self, time: f64) -> f64 {
        let after = self.points.partition_point(|p| p.0 <= time);
        match after {
            0 => self.rest,
            n if n == self.points.len() => self.points[n - 1].1,
            n => {
                let ((t0, v0), (t1, v1)) = (self.points[n - 1], self.points[n]);
                v0 + (v1 - v0) * (time - t0) / (t1 - t0)
            }
        }
    }

    /// The points within an event, times from its start, ends included.
    fn over(&self, start: f64, duration: f64, value: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let (from, to) = (start, start + duration);
        let within = self.points.iter().filter(|p| p.0 > from && p.0 < to);
        let inner = within.map(|(time, control)| ((time - from).clamp(0.0, duration), value(*control)));
        let mut points = vec![(0.0, value(self.at(from)))];
        points.extend(inner);
        // Just before the end, so that a curve that starts there has no part in it.
        points.push((duration, value(self.before(to))));
        points
    }

    /// The value that a time is approached with.
    fn before(&self, time: f64) -> f64 {
        let after = self.points.partition_point(|p| p.0 < time);
        match after {
            0 => self.rest,
            n if n == self.points.len() => self.points[n - 1].1,
            n => {
                let ((t0, v0), (t1, v1)) = (self.points[n - 1], self.points[n]);
                v0 + (v1 - v0) * (time - t0) / (t1 - t0)
            }
        }
    }
}
