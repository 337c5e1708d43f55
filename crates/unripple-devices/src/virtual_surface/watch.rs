//! Displacement recorded at some places of a virtual surface.

use std::collections::VecDeque;
use unripple_core::Point;
use unripple_physics::stepper::Reading;

/// Samples of each place that are kept until they are taken, the newest: 1.4 s at 48 kHz. Twice as many take twice
/// the memory.
const KEPT: usize = 1 << 16;

/// Number among the surface's readings of the probe, and of the first place.
pub(super) const PROBE: usize = 0;
const FIRST: usize = 1;

/// Displacement at some places, kept until it is taken.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    /// Where displacement is recorded, in m.
    places: Vec<Point>,
    stride: usize,
    /// Samples until the next that is kept.
    wait: usize,
    traces: Vec<VecDeque<f32>>,
    /// Where the probe is, once it was moved.
    probe: Option<Point>,
}

impl Watch {
    /// A watch of every `stride`-th sample at these places (m).
    pub fn new(places: &[Point], stride: usize, probe: Option<Point>) -> Self {
        let traces = vec![VecDeque::new(); places.len()];
        Self { places: places.to_vec(), stride: stride.max(1), wait: 0, traces, probe }
    }

    /// Notes that the probe was moved to a place, in m.
    pub fn set_probe(&mut self, at: Point) {
        self.probe = Some(at);
    }

    /// Readings, by number, that have to move for the places to become these (in m), as many as there are.
    pub fn moves(&self, places: &[Point]) -> Vec<(usize, Point)> {
        let both = self.places.iter().zip(places).enumerate();
        both.filter(|(_, (old, new))| old != new).map(|(i, (_, new))| (FIRST + i, *new)).collect()
    }

    /// Notes that the places are now these, in m.
    pub fn set_places(&mut self, places: &[Point]) {
        self.places = places.to_vec();
    }

    /// Number of places that are recorded.
    pub fn places(&self) -> usize {
        self.places.len()
    }

    /// Where the probe is, in m, once it was moved.
    pub fn probe(&self) -> Option<Point> {
        self.probe
    }

    /// The readings of the surface: velocity (m/s) at the probe, then displacement (m) at all other places.
    pub fn probes(&self, probe: Point) -> Vec<(Point, Reading)> {
        let watched = self.places.iter().map(|place| (*place, Reading::Displacement));
        [(probe, Reading::Velocity)].into_iter().chain(watched).collect()
    }

    /// Keeps every `stride`-th sample of a block, which has one plane of samples for each place.
    pub fn keep(&mut self, planes: &[f64], frames: usize) {
        if self.places.is_empty() || frames == 0 {
            return;
        }
        let first = self.wait;
        for (trace, plane) in self.traces.iter_mut().zip(planes.chunks_exact(frames)) {
            for value in plane.iter().skip(first).step_by(self.stride) {
                if trace.len() == KEPT {
                    trace.pop_front();
                }
                trace.push_back(*value as f32);
            }
        }
        let kept = frames.saturating_sub(first).div_ceil(self.stride);
        self.wait = first + kept * self.stride - frames;
    }

    /// Displacement (m) kept since it was last taken, `[place][sample]`.
    pub fn take(&mut self) -> Vec<Vec<f32>> {
        self.traces.iter_mut().map(|trace| std::mem::take(trace).into()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_third_sample_is_kept_whatever_the_blocks() {
        let place = Point::new(0.0, 0.0);
        let line: Vec<f64> = (0..100).map(f64::from).collect();
        for block in [1, 2, 5, 20, 100] {
            let mut watch = Watch::new(&[place], 3, None);
            line.chunks(block).for_each(|part| watch.keep(part, part.len()));
            let expected: Vec<f32> = (0..34).map(|i| (3 * i) as f32).collect();
            assert_eq!(watch.take(), [expected]);
            assert_eq!(watch.take(), [Vec::new()]);
        }
    }
}
