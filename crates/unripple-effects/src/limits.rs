//! The least and greatest legal values, in SI, and the sizes of things. Each is far wider than what hands and
//! surfaces do, so that it stops mistakes (millimetres given as metres, say) and bounds work and memory; none
//! is a recommendation.

/// Distance from one pulse to the next along a finger's path, in m. At the least, a finger of 0.1 m/s sets
/// off as many pulses as [`RATE`] allows.
pub const PITCH: [f64; 2] = [1e-4, 1.0];
/// Pulses per second: up to what a fingertip feels as vibration.
pub const RATE: [f64; 2] = [0.1, 1000.0];
/// Frequency of a waveform, in Hz: what a fingertip feels.
pub const FREQUENCY: [f64; 2] = [1.0, 1000.0];
/// Samples per second of waveforms: at least four for each period of the highest frequency.
pub const SAMPLE_RATE: [f64; 2] = [4000.0, 1e6];
/// A gain, a share, or how much of it is left to chance, by definition from nothing to all.
pub const SHARE: [f64; 2] = [0.0, 1.0];
/// A level above threshold, in dB: from well below it, which is not felt, up.
pub const FELT: [f64; 2] = [-20.0, 80.0];
/// A place on the surface, in m: a kilometre, so that only mistakes are refused.
pub const PLACE: [f64; 2] = [-1000.0, 1000.0];
/// A length on the surface, in m: from a tenth of a millimetre to a kilometre.
pub const LENGTH: [f64; 2] = [1e-4, 1000.0];
/// A length that may be nothing, in m: at most a metre.
pub const SCATTER: [f64; 2] = [0.0, 1.0];
/// How hard a finger presses, in N: from a hundredth, less than any finger does, to a hundred.
pub const FORCE: [f64; 2] = [0.01, 100.0];
/// Speed of a finger or of a traced point, in m/s: up to far more than a hand's.
pub const SPEED: [f64; 2] = [0.0, 100.0];
/// A fade, in s: at most ten, so that what is stopped ends.
pub const FADE: [f64; 2] = [0.0, 10.0];
/// A time within an envelope or a score, in s: at most [`LONGEST`].
pub const TIME: [f64; 2] = [0.0, LONGEST];
/// Period of a score that starts over, in s: at least a hundredth, a hundred repetitions a second.
pub const PERIOD: [f64; 2] = [0.01, LONGEST];
/// Play of a notch as a share of its pitch: less than half, for at half the next detent would begin only
/// where it lies.
pub const HYSTERESIS: [f64; 2] = [0.0, 0.45];
/// An angle, in rad: two turns either way, more than enough.
pub const ANGLE: [f64; 2] = [-13.0, 13.0];

/// Longest envelope or score, and longest waveforms of a whole set together, in s: 23 MB at 48 kHz. Doubled,
/// twice that.
pub const LONGEST: f64 = 120.0;
/// Most effects of a set: each is asked at every touch. Doubled, touches take up to twice as long.
pub const MOST_EFFECTS: usize = 64;
/// Most points of a curve, a polygon or a path. Doubled, twice the memory, and polygons and paths take twice
/// the time.
pub const MOST_POINTS: usize = 16_384;
/// Most corners of a region: each is tried at every touch. Doubled, touches take up to twice as long.
pub const MOST_CORNERS: usize = 1024;
/// Most events of a score: as many as the cues of a call, [`MOST_CUES`].
pub const MOST_EVENTS: usize = 4096;
/// Most points of a shape given all at once: each has responses of its own in its focus. Doubled, such a
/// focus takes twice as long.
pub const MOST_AT_ONCE: usize = 256;
/// Most pulses of a train that are counted: 17 minutes at the greatest rate. Doubled, twice as long.
pub const MOST_COUNT: u32 = 1_000_000;

/// Most fingers followed; further ones do nothing until one of these lifts. Doubled, ticks take up to twice
/// as long.
pub const MOST_FINGERS: usize = 64;
/// Most scores running without a finger: each is asked at every tick. Doubled, ticks take up to twice as
/// long.
pub const MOST_SCORES: usize = 64;
/// Most cues of one call, stops left out: a bound on the time that one takes. Doubled, twice the time at
/// worst.
pub const MOST_CUES: usize = 4096;
/// Most pulses of one step of one finger in one effect; a longer step gives no more. Doubled, a finger that
/// jumps sets off up to twice as many.
pub const MOST_IN_STEP: usize = 64;
/// How late timed pulses are still cued, in s: what is overdue by more is skipped. Doubled, a player that
/// stood still catches up with more pulses at once.
pub const LATEST: f64 = 0.25;
/// How long a finger that sends no news is taken to move on, in s, so that grains come evenly between two
/// touches. Doubled, textures go on for longer after a finger stopped.
pub const HOLD: f64 = 0.05;
