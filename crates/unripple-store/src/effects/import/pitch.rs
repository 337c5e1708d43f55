//! Pitches of formats for phones, as frequencies.

/// Frequencies of the pitches 0 and 1 of formats for phones, in Hz: the range of MPEG's reference encoder for AHAP.
const PITCH: [f64; 2] = [65.0, 300.0];

/// The frequency in Hz of a pitch from 0 to 1.
pub(super) fn pitch(share: f64) -> f64 {
    PITCH[0] + share.clamp(0.0, 1.0) * (PITCH[1] - PITCH[0])
}
