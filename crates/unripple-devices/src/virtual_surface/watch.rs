//! Recording of the displacement at some places of a virtual surface.

use std::collections::VecDeque;
use unripple_core::Point;
use unripple_physics::stepper::Reading;

/// Largest number of samples of each place that are stored until they are read, the newest: 1.4 s at 48 kHz.
/// Twice as many take twice the memory.
const KEPT: usize = 1 << 16;

/// Index of the probe, and of the first recorded place, among the surface's readings.
pub(super) const PROBE: usize = 0;
const FIRST: usize = 1;

/// Displacement recorded at some places, stored until it is read.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    /// Where displacement is recorded, in m.
    places: Vec<Point>,
    stride: usize,
    /// Number of samples until the next that is stored.
    wait: usize,
    traces: Vec<VecDeque<f32>>,
    /// Place of the probe; `None` until it is moved.
    probe: Option<Point>,
}

impl Watch {
    /// A recorder of the displacement at these places (m), at every `stride`-th sample.
    pub fn new(places: &[Point], stride: usize, probe: Option<Point>) -> Self {
        let traces = vec![VecDeque::new(); places.len()];
        Self { places: places.to_vec(), stride: stride.max(1), wait: 0, traces, probe }
    }

    /// Stores the place, in m, to which the probe was moved.
    pub fn set_probe(&mut self, at: Point) {
        self.probe = Some(at);
    }

    /// Readings that have to move when the places are replaced by as many new `places` (in m): the index of
    /// each among the surface's readings, and its new place.
    pub fn moves(&self, places: &[Point]) -> Vec<(usize, Point)> {
        let both = self.places.iter().zip(places).enumerate();
        both.filter(|(_, (old, new))| old != new).map(|(i, (_, new))| (FIRST + i, *new)).collect()
    }

    /// Replaces the recorded places by `places`, in m.
    pub fn set_places(&mut self, places: &[Point]) {
        self.places = places.to_vec();
    }

    /// Number of places at which displacement is recorded.
    pub fn places(&self) -> usize {
        self.places.len()
    }

    /// Place of the probe, in m; `None` until it is moved.
    pub fn probe(&self) -> Option<Point> {
        self.probe
    }

    /// The readings to be computed by the simulation: velocity (m/s) at the place `probe`, then displacement
    /// (m) at all recorded places.
    pub fn probes(&self, probe: Point) -> Vec<(Point, Reading)> {
        let watched = self.places.iter().map(|place| (*place, Reading::Displacement));
        [(probe, Reading::Velocity)].into_iter().chain(watched).collect()
    }

    /// Stores every `stride`-th sample of a block, which has `frames` samples in a row for each place.
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

    /// Returns and removes the displacement (m) stored since the last call, `[place][sample]`.
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
