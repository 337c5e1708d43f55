//! A film with actuators, and functions that pass blocks through a device.
#![allow(dead_code)] // Each test file uses its own part of this.

pub mod server;

use unripple_core::*;

/// The paper's film, up to a frequency (Hz).
pub fn film(top: f64) -> Surface {
    let mut film = unripple_physics::design::papers_surface();
    film.name = "film".into();
    film.sheet.strength = None;
    film.emission = Emission { band: [0.0, top], limit: 2.0, ..film.emission };
    film
}

/// Plays a drive, a function of output and sample with 1 for full scale, and returns so many samples of every input.
pub fn play(device: &mut dyn Device, samples: usize, drive: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
    let layout = device.layout().clone();
    let (outputs, inputs) = (layout.outputs.len(), layout.inputs.len());
    let mut all = vec![Vec::new(); inputs];
    let mut heard = vec![0.0f32; inputs * layout.block];
    for start in (0..samples).step_by(layout.block) {
        let block: Vec<f32> = (0..outputs * layout.block)
            .map(|n| drive(n / layout.block, start + n % layout.block) as f32)
            .collect();
        device.exchange(&block, &mut heard).unwrap();
        for (line, plane) in all.iter_mut().zip(heard.chunks(layout.block)) {
            line.extend(plane.iter().map(|x| f64::from(*x)));
        }
    }
    all.iter_mut().for_each(|line| line.truncate(samples));
    all
}

/// A drive of zeros.
pub fn silence(_: usize, _: usize) -> f64 {
    0.0
}

pub fn rms(line: &[f64]) -> f64 {
    (line.iter().map(|x| x * x).sum::<f64>() / line.len() as f64).sqrt()
}

/// Largest difference of two signals, relative to the largest magnitude of the second.
pub fn apart(found: &[f64], exact: &[f64]) -> f64 {
    assert_eq!(found.len(), exact.len());
    let most = exact.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    found.iter().zip(exact).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs())) / most
}

/// Pseudorandom numbers between -1 and 1.
pub fn noise(seed: u64, count: usize) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    (0..20).for_each(|_| {
        next();
    });
    (0..count).map(|_| next()).collect()
}
