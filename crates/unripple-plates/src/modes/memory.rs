//! The memory that a solution for modes may take.

/// Memory that a solution for modes may take, in bytes. With twice this value, top frequencies may be about
/// 1.4 times as high before they are refused.
pub(super) const MEMORY: f64 = 4.0 * GIB;
/// Bytes of a GiB, 2³⁰ by definition.
pub(super) const GIB: f64 = (1u64 << 30) as f64;
