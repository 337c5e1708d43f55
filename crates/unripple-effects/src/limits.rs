//! The least and greatest legal values, in SI, and the sizes of things.

/// Distance from one pulse to the next along a finger's path, in m.
pub const PITCH: [f64; 2] = [1e-4, 1.0];
/// Pulses per second.
pub const RATE: [f64; 2] = [0.1, 1000.0];
/// Frequency of a waveform, in Hz: what a fingertip feels.
pub const FREQUENCY: [f64; 2] = [1.0, 1000.0];
/// Samples per second of waveforms.
pub const SAMPLE_RATE: [f64; 2] = [4000.0, 1e6];
/// A gain, a share, or how much of it is left to chance.
pub const SHARE: [f64; 2] = [0.0, 1.0];
/// A level above threshold, in dB.
pub const FELT: [f64; 2] = [-20.0, 80.0];
/// A place on the surface, in m.
pub const PLACE: [f64; 2] = [-1000.0, 1000.0];
/// A length on the surface, in m.
pub const LENGTH: [f64; 2] = [1e-4, 1000.0];
/// A length that may be nothing, in m.
pub const SCATTER: [f64; 2] = [0.0, 1.0];
/// How hard a finger presses, in N.
pub const FORCE: [f64; 2] = [0.01, 100.0];
/// Speed of a finger or of a traced point, in m/s.
pub const SPEED: [f64; 2] = [0.0, 100.0];
/// A fade, in s.
pub const FADE: [f64; 2] = [0.0, 10.0];
/// A time within an envelope or a score, in s.
pub const TIME: [f64; 2] = [0.0, LONGEST];
/// Period of a score that starts over, in s.
pub const PERIOD: [f64; 2] = [0.01, LONGEST];
/// Play of a notch as a share of its pitch.
pub const HYSTERESIS: [f64; 2] = [0.0, 0.45];
/// An angle, in rad.
pub const ANGLE: [f64; 2] = [-13.0, 13.0];

/// Longest envelope or score, and longest waveforms of a whole set together, in s.
pub const LONGEST: f64 = 120.0;
/// Most effects of a set.
pub const MOST_EFFECTS: usize = 64;
/// Most points of a curve, a polygon or a path.
pub const MOST_POINTS: usize = 16_384;
/// Most corners of a region.
pub const MOST_CORNERS: usize = 1024;
/// Most events of a score.
pub const MOST_EVENTS: usize = 4096;
/// Most points of a shape given all at once.
pub const MOST_AT_ONCE: usize = 256;
/// Most pulses of a train that are counted.
pub const MOST_COUNT: u32 = 1_000_000;

/// Most fingers followed; further ones do nothing until one of these lifts.
pub const MOST_FINGERS: usize = 64;
/// Most scores running without a finger.
pub const MOST_SCORES: usize = 64;
/// Most cues of one call, stops left out.
pub const MOST_CUES: usize = 4096;
/// Most pulses of one step of one finger in one effect; a longer step gives no more.
pub const MOST_IN_STEP: usize = 64;
/// How late timed pulses are still cued, in s: what is overdue by more is skipped.
pub const LATEST: f64 = 0.25;
/// How long a finger that sends no news is taken to move on, in s.
pub const HOLD: f64 = 0.05;
