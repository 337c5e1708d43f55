//! A surface somewhere else: it is played what was written, and somebody records what it hears.
#![allow(dead_code)] // Each test file uses its own part of this.

use std::path::Path;
use unripple::core::{Device, Drive, Point, Surface};
use unripple_devices::{Handle, Perturbation, Virtual, VirtualOptions};
use unripple_store::{read_wav, write_wav};

/// A surface that is not as it is told, with somebody who plays and records.
pub struct Elsewhere {
    device: Virtual,
    handle: Handle,
    pub play: Vec<Vec<f64>>,
}

impl Elsewhere {
    pub fn new(surface: &Surface, seed: u64, play: &str) -> Self {
        let truth = Perturbation { seed, ..Perturbation::default() }.truth(surface).unwrap();
        let device = Virtual::of_truth(&truth, &VirtualOptions::default()).unwrap();
        Self { handle: device.handle(), device, play: read_wav(play).unwrap().channels }
    }

    /// What all channels hear, the recording begun so many samples before the playing.
    pub fn record(&mut self, at: Point, early: usize, seed: u64) -> Vec<Vec<f64>> {
        self.handle.rest(seed);
        self.handle.move_probe(at).unwrap();
        let (inputs, block) = (self.device.layout().inputs.len(), self.device.layout().block);
        let mut lines = vec![Vec::new(); inputs];
        let mut heard = vec![0.0f32; inputs * block];
        for first in (0..early + self.play[0].len() + 4800).step_by(block) {
            let sample = |line: &Vec<f64>, i: usize| i.checked_sub(early).and_then(|i| line.get(i)).copied();
            let drive = self
                .play
                .iter()
                .flat_map(|line| (first..first + block).map(move |i| sample(line, i).unwrap_or(0.0) as f32));
            self.device.exchange(&drive.collect::<Vec<_>>(), &mut heard).unwrap();
            for (line, plane) in lines.iter_mut().zip(heard.chunks(block)) {
                line.extend(plane.iter().map(|x| f64::from(*x)));
            }
        }
        lines
    }
}

/// Brings a recording into a folder.
pub fn bring(folder: &str, file: &str, lines: &[Vec<f64>]) {
    bring_at(folder, file, lines, 48e3);
}

/// The same at another rate.
pub fn bring_at(folder: &str, file: &str, lines: &[Vec<f64>], rate: f64) {
    let names = (0..lines.len()).map(|i| format!("c{i}")).collect();
    write_wav(Path::new(folder).join(file), &Drive::new(rate, names, lines.to_vec()).unwrap()).unwrap();
}

/// A response of a library, all actuators one after the other.
pub fn response(library: &str, point: usize) -> Vec<f64> {
    let bytes = std::fs::read(format!("{library}/responses/c.{point}.0.0")).unwrap();
    let (values, _) = bytes[..bytes.len() - 4].as_chunks::<4>();
    values.iter().map(|bytes| f64::from(f32::from_le_bytes(*bytes))).collect()
}

/// Rms of what two responses differ by, over that of the second.
pub fn apart(a: &[f64], b: &[f64]) -> f64 {
    let power = |h: &[f64]| h.iter().map(|x| x * x).sum::<f64>();
    let apart: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    (power(&apart) / power(b)).sqrt()
}
