//! The clock: the operating system's, or on WebAssembly, which has none, the one that the page provides.

#[cfg(any(target_family = "wasm", test))]
mod provided;

#[cfg(target_family = "wasm")]
pub use provided::{Instant, provide};
#[cfg(not(target_family = "wasm"))]
pub use std::time::Instant;

/// Seconds since the beginning of 1970, UTC, without leap seconds; 0 by a clock that is set to before that.
pub fn unix_seconds() -> u64 {
    #[cfg(target_family = "wasm")]
    return Instant::now().unix().as_secs();
    #[cfg(not(target_family = "wasm"))]
    std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).map_or(0, |since| since.as_secs())
}
