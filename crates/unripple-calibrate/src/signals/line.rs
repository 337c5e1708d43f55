//! One line of a signal's spectrum.

use std::f64::consts::TAU;

/// Fourier transform of a signal at a frequency in cycles per sample: real and imaginary part.
pub(crate) fn line(signal: impl Iterator<Item = f64>, cycles: f64) -> [f64; 2] {
    let (sin, cos) = (TAU * cycles).sin_cos();
    let (mut turn, mut sum) = ([1.0, 0.0], [0.0; 2]);
    for x in signal {
        sum = [sum[0] + x * turn[0], sum[1] - x * turn[1]];
        turn = [turn[0] * cos - turn[1] * sin, turn[0] * sin + turn[1] * cos];
    }
    sum
}
