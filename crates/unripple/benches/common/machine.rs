//! Speed, load and memory of the machine, measured in the same run.

use super::times::Times;
use std::hint::black_box;
use std::ops::Neg;
use unripple_linalg::{Accum, Mat, Number, Par, multiply};

/// Prints what a benchmark is about, on how many threads, and how busy the machine is.
pub fn introduce(title: &str, threads: usize) {
    println!("\n{title}");
    println!("  threads {threads}, load before {}", load());
}

/// Runnable processes averaged over the last minute, where the system tells.
pub fn load() -> String {
    let read = std::fs::read_to_string("/proc/loadavg").ok();
    read.and_then(|text| text.split(' ').next().map(str::to_owned)).unwrap_or_else(|| "unknown".into())
}

/// Number of threads of the global rayon pool.
pub fn threads() -> usize {
    rayon::current_num_threads()
}

/// Best rate of the product of a `rows` x `inner` and an `inner` x `columns` matrix, in flop/s, over a few runs.
///
/// The right factor and the result lie row by row, as in a library of responses.
pub fn product_rate<T: Number + Neg<Output = T>>(
    [rows, inner, columns]: [usize; 3],
    par: Par,
    unit: T,
) -> f64 {
    let left = Mat::from_fn(rows, inner, |i, j| if (3 * i + 7 * j) % 5 < 2 { unit } else { -unit });
    let right = Mat::from_fn(columns, inner, |i, j| if (5 * i + 3 * j) % 7 < 3 { unit } else { -unit });
    let mut result = Mat::zeros(columns, rows);
    let times = Times::of(5, |_| {
        let out = result.transpose_mut();
        multiply(out, Accum::Replace, left.as_ref(), right.transpose(), unit, par);
        black_box(&result);
    });
    2.0 * (rows * inner * columns) as f64 / times.best()
}

/// Largest resident memory of this process so far, in MB; `None` where the system does not say.
pub fn peak_megabytes() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<f64>().ok().map(|kilobytes| kilobytes / 1e3)
}
