//! What this machine has: memory to spare, and the speed of its processors.

use std::env;
use std::hint::black_box;
use std::sync::OnceLock;
use sysinfo::{MemoryRefreshKind, RefreshKind, System};
use unripple::core::clock::Instant;
use unripple::core::{Cost, Memory};
use unripple::linalg::{Accum, Mat, Par, multiply};
use unripple::physics::PhysicsError;

/// The variable that names the largest amount of memory that a solution may take, in GiB.
pub const VARIABLE: &str = "UNRIPPLE_MEMORY_GIB";

/// Share of the memory to spare that a solution may take; the rest is for what comes after it.
const SHARE: f64 = 0.8;

/// Size of the matrices by which the speed is measured: large enough that their product runs at full speed, for 2 ms.
const SIZE: usize = 256;

/// Least speed that is believed, relative to that of the laws: slower ones are machines at other work.
pub(crate) const SLOWEST: f64 = 0.05;

/// Number of products, of which the fastest counts, since other work delays some.
const TIMES: usize = 5;

/// The memory that solutions for modes may take: as much as the variable `UNRIPPLE_MEMORY_GIB` says, 4 GiB by default, but not more than the
/// machine has to spare.
pub fn memory() -> Memory {
    let asked = asked().ok().flatten().unwrap_or(Memory::default().bytes());
    Memory::of(spare().map_or(asked, |spare| asked.min(SHARE * spare)))
}

/// The memory that the variable allows, in bytes; `None` where it is not set.
///
/// # Errors
/// What is wrong with it, in words, if it is no positive number.
pub fn asked() -> Result<Option<f64>, String> {
    let Some(text) = env::var_os(VARIABLE).filter(|text| !text.is_empty()) else { return Ok(None) };
    let text = text.to_string_lossy();
    match text.trim().parse::<f64>() {
        Ok(gib) if gib > 0.0 && gib.is_finite() => Ok(Some(gib * Memory::GIB)),
        _ => Err(format!("{VARIABLE}: expected a number of GiB above 0, such as 8, found {text}")),
    }
}

/// The message of an error, with the value of the variable that would allow a problem which is too large, where the machine has the memory.
pub(crate) fn told(error: &PhysicsError) -> String {
    let PhysicsError::TooLarge { needed_gib, .. } = error else { return error.to_string() };
    // Some more, since the estimate is one.
    let gib = (1.1 * needed_gib).ceil();
    match spare().is_some_and(|spare| gib * Memory::GIB <= SHARE * spare) {
        true => format!("{error}; {VARIABLE}={gib} allows it on this machine"),
        false => error.to_string(),
    }
}

/// Memory to spare in bytes, within the limits of a container, whose cached files may be dropped; `None` where the system does not tell.
fn spare() -> Option<f64> {
    let memory = RefreshKind::nothing().with_memory(MemoryRefreshKind::nothing().with_ram());
    let system = System::new_with_specifics(memory).ok()?;
    let free = Some(system.available_memory()).filter(|bytes| *bytes > 0)?;
    let within = system
        .cgroup_limits()
        .map_or(free, |limits| limits.total_memory.saturating_sub(limits.rss).min(free));
    Some(within as f64)
}

/// Time by the clock that work of this processor time takes on this machine, in s: about half of it runs on all processors.
pub(crate) fn clock(cost: Cost) -> f64 {
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    processor(cost) * 0.5 * (1.0 + 1.0 / processors as f64)
}

/// Processor time of work on this machine, in s.
pub(crate) fn processor(cost: Cost) -> f64 {
    cost.seconds / speed()
}

/// Speed of a processor of this machine, relative to the one on which the laws of [`Cost`] were measured.
pub fn speed() -> f64 {
    static SPEED: OnceLock<f64> = OnceLock::new();
    *SPEED.get_or_init(|| {
        let matrix = Mat::from_fn(SIZE, SIZE, |i, j| 1.0 / (1 + i + j) as f64);
        let mut out = Mat::zeros(SIZE, SIZE);
        let mut alone = || {
            let begun = Instant::now();
            multiply(
                out.as_mut(),
                Accum::Replace,
                black_box(matrix.as_ref()),
                matrix.as_ref(),
                1.0,
                Par::Seq,
            );
            black_box(&out);
            begun.elapsed().as_secs_f64()
        };
        let fastest = (0..TIMES).map(|_| alone()).fold(f64::INFINITY, f64::min);
        let operations = 2.0 * (SIZE as f64).powi(3);
        (operations / fastest / Cost::RATE).clamp(SLOWEST, 20.0)
    })
}
