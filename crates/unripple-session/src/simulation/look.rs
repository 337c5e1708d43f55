//! Pictures of the surface.

use super::Simulation;
use super::lens::{product, weights};
use super::past::Past;
use crate::outbox::{Outbox, Picture};
use crate::wire::{Frame, Head, Resting, Strip};
use unripple::core::Point;

/// How much of the past a trace shows, in s. Twice as long crowds periods of 1 kHz together.
const SPAN: f64 = 0.04;

/// Traces in a picture: as many as there are colours to tell them apart.
const MOST_TRACES: usize = 8;

/// The motion of one place.
struct Followed<'a> {
    name: String,
    at: Point,
    weights: &'a [f32],
}

impl Simulation {
    /// Puts up a picture, if somebody looks and something has changed.
    pub(super) fn show(&mut self, out: &mut Outbox) {
        let shown = self.transport.shown();
        let still = shown == self.before && !self.changed;
        if self.viewers == 0 || still {
            return;
        }
        self.changed = false;
        match &self.replay {
            Some(replay) => {
                for (pane, frame) in replay.frames(shown, self.velocity).into_iter().enumerate() {
                    self.frame += 1;
                    self.put(format!("frame {pane}"), frame, out);
                }
            }
            None => {
                self.follow_targets();
                if let Some(frame) = self.picture(shown) {
                    self.frame += 1;
                    out.withdraw("frame 1");
                    self.put("frame 0".into(), frame, out);
                }
            }
        }
        self.before = shown;
    }

    fn put(&self, kind: String, mut frame: Frame, out: &mut Outbox) {
        frame.head.frame = self.frame;
        let moved =
            frame.traces.iter().filter_map(|trace| trace.last()).fold(0.0, |m: f32, x| m.max(x.abs()));
        let strength = frame.head.strobed.then_some(moved);
        let picture = Picture { number: self.frame, first: self.first, strength };
        out.frame(kind, frame.encode(), picture);
    }

    /// Knows what the places under fingers read of the modes; remembers the last of each finger until others come.
    fn follow_targets(&mut self) {
        let fingers = &self.known.fingers;
        if fingers.is_empty() {
            return;
        }
        let (targets, plant) = (&mut self.targets, &self.instrument.plant);
        targets.retain(|id, _| fingers.iter().any(|(finger, _)| finger == id));
        for (id, at) in fingers {
            if targets.get(id).is_none_or(|(known, _)| known != at) {
                targets.insert(*id, (*at, weights(plant, &[*at])));
            }
        }
    }

    /// The live surface at a moment.
    fn picture(&self, shown: f64) -> Option<Frame> {
        let instrument = &self.instrument;
        let rate = instrument.rate();
        let followed = self.followed();
        let strobes = self.transport.strobes();
        let velocity = self.velocity;
        let (cells, time, traces, samples, stride) = instrument.handle.history(|history| {
            let past = Past { history, rate, velocity };
            let mut at = past.back(shown);
            if strobes && !followed.is_empty() {
                at = strongest(&past, at, past.back(self.before), &followed);
            }
            let span = past.span(at, SPAN);
            let traces: Vec<Vec<f32>> =
                followed.iter().map(|place| past.trace(place.weights, at, span)).collect();
            let time = (history.newest() as f64 - (at * history.stride()) as f64) / rate;
            Some((instrument.lens.look(past.state(at)?), time, traces, span, history.stride()))
        })??;
        let head = Head {
            panes: 1,
            columns: instrument.lens.cells.columns,
            rows: instrument.lens.cells.rows,
            time_s: time,
            quantity: if self.velocity { "velocity" } else { "displacement" },
            strobed: strobes,
            drive: self.driven(time),
            fingers: self.fingers(),
            targets: self.targets.values().map(|(at, _)| [at.x * 1e3, at.y * 1e3]).collect(),
            samples,
            span_s: (samples * stride) as f64 / rate,
            traces: followed.iter().map(Followed::strip).collect(),
            ..Head::default()
        };
        Some(Frame { head, cells, traces })
    }

    /// Places whose motion is shown: under fingers, then probes.
    fn followed(&self) -> Vec<Followed<'_>> {
        let numbers = 1..;
        let fingers = self.targets.values().zip(numbers).map(|((at, weights), number)| Followed {
            name: format!("finger {number}"),
            at: *at,
            weights,
        });
        let probes = self.probes.iter().map(|probe| Followed {
            name: format!("probe {}", probe.id),
            at: probe.at,
            weights: &probe.weights,
        });
        fingers.chain(probes).take(MOST_TRACES).collect()
    }

    /// Drive of every actuator at a moment, over its limit.
    fn driven(&self, time: f64) -> Vec<f32> {
        let sample = ((time * self.instrument.rate()).round() as u64).saturating_sub(1);
        let outputs = self.instrument.spec.surface.actuators.len();
        self.instrument.tape.at(sample).map_or_else(|| vec![0.0; outputs], <[f32]>::to_vec)
    }

    /// Fingers on the surface, and what it pushes them with.
    pub(super) fn fingers(&self) -> Vec<Resting> {
        let resting = |(id, at): &(u64, Point)| Resting {
            id: *id,
            at_mm: [at.x * 1e3, at.y * 1e3],
            force_n: self.instrument.handle.finger_motion(*id).map_or(0.0, |motion| motion.force),
        };
        self.known.fingers.iter().map(resting).collect()
    }
}

impl Followed<'_> {
    fn strip(&self) -> Strip {
        Strip { name: self.name.clone(), at_mm: [self.at.x * 1e3, self.at.y * 1e3], scale: 1.0 }
    }
}

/// The state from `newest` back to `oldest` in which the followed places move most.
fn strongest(past: &Past, newest: usize, oldest: usize, followed: &[Followed]) -> usize {
    let strength = |back: &usize| {
        let Some(state) = past.state(*back) else { return 0.0 };
        followed.iter().map(|place| product(place.weights, state).abs()).fold(0.0, f32::max)
    };
    let most = oldest.min(past.history.len().saturating_sub(1)).max(newest);
    (newest..=most).max_by(|a, b| strength(a).total_cmp(&strength(b))).unwrap_or(newest)
}
