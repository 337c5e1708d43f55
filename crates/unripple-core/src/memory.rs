//! The memory that computations may take.

use crate::scope;
use std::cell::RefCell;

/// Memory that a computation may take where nothing else is said, in bytes: 4 GiB, which a small machine has. With half this value, some
/// surfaces that fit would be refused. WebAssembly has 4 GiB of addresses in all, of which a phone's browser gives it a part: there, 1 GiB.
const USUAL: f64 = if cfg!(target_family = "wasm") { 1.0 } else { 4.0 } * Memory::GIB;

thread_local! {
    /// The memory that computations begun on this thread may take; `None` for the usual one.
    static HERE: RefCell<Option<Memory>> = const { RefCell::new(None) };
}

/// Memory that a computation may take, in bytes. What would need more is refused before it begins; no other result depends on it. A
/// computation asks for that of the thread on which it begins; functions in between need no parameter for it.
///
/// ```
/// use unripple_core::Memory;
///
/// assert_eq!(Memory::here(), Memory::default());
/// Memory::of(1e9).during(|| assert!(!Memory::here().holds(2e9)));
/// assert!(Memory::here().holds(2e9));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Memory(f64);

impl Default for Memory {
    /// 4 GiB.
    fn default() -> Self {
        Self(USUAL)
    }
}

impl Memory {
    /// Bytes of a GiB, 2³⁰ by definition.
    pub const GIB: f64 = (1u64 << 30) as f64;

    /// A memory of `bytes` bytes.
    pub fn of(bytes: f64) -> Self {
        Self(bytes)
    }

    /// The memory that computations on the current thread may take: as set by [`Memory::during`], or else 4
    /// GiB.
    pub fn here() -> Self {
        HERE.with_borrow(|memory| memory.unwrap_or_default())
    }

    /// Runs `work` on the current thread with this memory as its limit, and restores the previous limit afterwards.
    pub fn during<T>(self, work: impl FnOnce() -> T) -> T {
        scope::during(&HERE, Some(self), work)
    }

    /// Number of bytes.
    pub fn bytes(self) -> f64 {
        self.0
    }

    /// Whether a computation that needs `bytes` bytes fits into this memory.
    pub fn holds(self, bytes: f64) -> bool {
        bytes <= self.0
    }
}
