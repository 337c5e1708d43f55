//! Allowed ranges of values, in SI units, as `[least, greatest]`, and the largest sizes of lists. All are far wider than what
//! hands and surfaces need: they catch mistakes (millimetres given as metres, say) and bound work and memory. None is
//! a recommendation.

/// Distance from one pulse to the next along a finger's path, in m. At the least distance, a finger that moves at 0.1 m/s
/// sets off as many pulses per second as [`RATE`] allows.
pub const PITCH: [f64; 2] = [1e-4, 1.0];
/// Pulses per second: up to the highest frequency that a fingertip feels as vibration.
pub const RATE: [f64; 2] = [0.1, 1000.0];
/// Frequency of a waveform, in Hz: the range that a fingertip feels.
pub const FREQUENCY: [f64; 2] = [1.0, 1000.0];
/// Samples per second of waveforms: at least four for each period of the highest frequency.
pub const SAMPLE_RATE: [f64; 2] = [4000.0, 1e6];
/// A gain, a share, or the degree of random variation: from 0 to 1 by definition.
pub const SHARE: [f64; 2] = [0.0, 1.0];
/// A level above the detection threshold, in dB: from well below it (not felt) to well above.
pub const FELT: [f64; 2] = [-20.0, 80.0];
/// A coordinate on the surface, in m: up to a kilometre, so that only mistakes are refused.
pub const PLACE: [f64; 2] = [-1000.0, 1000.0];
/// A length on the surface, in m: from a tenth of a millimetre to a kilometre.
pub const LENGTH: [f64; 2] = [1e-4, 1000.0];
/// Greatest distance of random pulses from the finger, in m: zero for none, at most a metre.
pub const SCATTER: [f64; 2] = [0.0, 1.0];
/// Pressing force of a finger, in N: from 0.01 N, which is less than any touch exerts, to 100 N.
pub const FORCE: [f64; 2] = [0.01, 100.0];
/// Speed of a finger or of a point that traces a shape, in m/s: up to far more than that of a hand.
pub const SPEED: [f64; 2] = [0.0, 100.0];
/// Duration of a fade, in s: at most ten seconds, so that a voice ends soon after it is stopped.
pub const FADE: [f64; 2] = [0.0, 10.0];
/// A time within an envelope or a score, in s: at most [`LONGEST`].
pub const TIME: [f64; 2] = [0.0, LONGEST];
/// Period of a score that repeats, in s: at least a hundredth of a second, which is a hundred repetitions
/// per second.
pub const PERIOD: [f64; 2] = [0.01, LONGEST];
/// Hysteresis of a notch, as a share of its pitch: below 0.5, since with 0.5 the finger would enter a detent
/// only at that detent's centre.
pub const HYSTERESIS: [f64; 2] = [0.0, 0.45];
/// An angle, in rad: about two turns in either direction, more than needed.
pub const ANGLE: [f64; 2] = [-13.0, 13.0];

/// Longest envelope or score, and greatest total duration of the waveforms of a set, in s: the samples take
/// 23 MB at 48 kHz. With twice this value, they take twice the memory.
pub const LONGEST: f64 = 120.0;
/// Largest number of effects in a set: each is evaluated at every touch. With twice this value, a touch takes up to twice as long to
/// process.
pub const MOST_EFFECTS: usize = 64;
/// Largest number of points of a curve. With twice this value, curves take up to twice the memory.
pub const MOST_POINTS: usize = 16_384;
/// Largest number of corners of a region or of a shape: each is tested at every touch. With twice this value, a touch takes up to twice
/// as long to process.
pub const MOST_CORNERS: usize = 1024;
/// Largest number of events of a score: the same as [`MOST_CUES`], the largest number of cues of one call.
pub const MOST_EVENTS: usize = 4096;
/// Largest number of points of a shape that is played on all points at once: the focus uses the responses of each. With twice this
/// value, such a focus takes twice as long to compute.
pub const MOST_AT_ONCE: usize = 256;
/// Greatest number of pulses of a pulse train: at the highest rate ([`RATE`]) they last 17 minutes.
pub const MOST_COUNT: u32 = 1_000_000;

/// Largest number of fingers tracked at once; further ones are ignored until one of these is lifted. With twice this value, calls take up
/// to twice as long.
pub const MOST_FINGERS: usize = 64;
/// Largest number of scores that run at once without a finger: each is evaluated at every call. With twice this value, calls take up to
/// twice as long.
pub const MOST_SCORES: usize = 64;
/// Largest number of cues that one call adds, not counting stops: a bound on the time that a call takes. With twice this value, a call
/// takes twice the time at worst.
pub const MOST_CUES: usize = 4096;
/// Largest number of pulses that one effect gives for one movement of one finger; a longer movement gives no more. With twice this
/// value, a finger that jumps sets off up to twice as many.
pub const MOST_IN_STEP: usize = 64;
/// How late a timed pulse may still be cued, in s; pulses that are overdue by more are skipped. With twice this value, a player that
/// was interrupted catches up with more pulses at once.
pub const LATEST: f64 = 0.25;
/// How long a finger is assumed to keep its velocity when no touch event arrives, in s, so that the pulses of textures come
/// evenly between two events. With twice this time, textures go on for longer after a finger has stopped.
pub const HOLD: f64 = 0.05;
