//! The types and constants of JACK that are used, as `jack/types.h` declares them.

use std::ffi::{c_uint, c_ulong, c_void};

/// A client and a port, as the library knows them.
pub(super) enum RawClient {}
pub(super) enum RawPort {}

/// Start no server, a server's name follows, and what a port is.
pub(super) const NO_START_SERVER: c_uint = 0x01;
pub(super) const SERVER_NAME: c_uint = 0x04;
pub(super) const PORT_IS_INPUT: c_ulong = 0x1;
pub(super) const PORT_IS_OUTPUT: c_ulong = 0x2;
pub(super) const PORT_IS_PHYSICAL: c_ulong = 0x4;

/// Latency of what is recorded, and of what is played.
pub(super) const CAPTURE_LATENCY: c_uint = 0;
pub(super) const PLAYBACK_LATENCY: c_uint = 1;

/// Least and largest latency in samples, of all paths to or from a port.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub(super) struct LatencyRange {
    pub(super) min: u32,
    pub(super) max: u32,
}

/// What callbacks and threads are given.
pub(super) type Arg = *mut c_void;
