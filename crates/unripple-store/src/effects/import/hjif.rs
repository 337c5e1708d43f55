//! `.hjif`, the interchange format of ISO/IEC 23090-31: bands of effects made of keyframes.
//!
//! Vectorial waves and transients are read, wherever on the body they are meant for; wavelets and sampled curves are
//! refused, and so are composite effects. If channel gains make the strongest more than full scale, all are scaled down.

use super::node::Node;
use super::notes::Notes;
use crate::StoreError;
use std::collections::HashMap;
use unripple_effects::limits::{FREQUENCY, TIME};

/// Words of ISO/IEC 23090-31 that are understood: types of bands, of effects, of base signals, and what an effect is
/// meant for. A file with any other is refused rather than played wrong.
const BANDS: [&str; 2] = ["VectorialWave", "Transient"];
const EFFECTS: [&str; 2] = ["Basis", "Reference"];
const SIGNALS: [&str; 1] = ["Sine"];
const MODALITIES: [&str; 4] = ["Vibrotactile", "Vibration", "Vibrotactile Texture", "Other"];
/// Ticks per second of files that do not say. Milliseconds, as the format has it.
const TIMESCALE: f64 = 1000.0;
/// Least and greatest time in ticks: at the usual 1000 per second, eleven days.
const TICKS: [f64; 2] = [0.0, 1e9];
/// Least and greatest number taken for a gain, or for a frequency before it is clamped: products of a few such stay
/// finite.
const GAIN: [f64; 2] = [-1e6, 1e6];
/// Largest number of keyframes read, those of an effect of the library each time that it is referred to. Past it the file is
/// refused, so that a small file with many references takes no unbounded memory.
const MOST_FRAMES: usize = 1 << 16;

/// Keyframes in time, strengths not yet scaled.
enum Found {
    Pulse(f64, f64),
    Wave { at: f64, amplitude: Vec<(f64, f64)>, frequency: Vec<(f64, f64)> },
}

/// Pulses and waves found so far, and how many keyframes were read for them.
#[derive(Default)]
struct Score {
    found: Vec<Found>,
    frames: usize,
}

/// The effects of a perception's library, by their id.
type Library<'n, 'v> = HashMap<u64, &'n Node<'v>>;

/// Where effects lie, and how strong they are.
struct Place {
    /// Ticks per second.
    timescale: f64,
    gain: f64,
    /// Legal frequencies, in Hz.
    band: [f64; 2],
    is_wave: bool,
}

pub(super) fn read(root: &Node, notes: &mut Notes) -> Result<(), StoreError> {
    let timescale = root.number_or("timescale", TIMESCALE, [1.0, 1e6])?;
    let mut score = Score::default();
    for perception in root.items("perceptions")? {
        if let Some(modality) = perception.get("perception_modality") {
            modality.one_of(&MODALITIES)?;
        }
        let library = match perception.get("effect_library") {
            Some(_) => perception.items("effect_library")?,
            None => Vec::new(),
        };
        let id = |node: &Node| node.get("id").and_then(|id| id.number(TICKS).ok()).map(f64::to_bits);
        let library: Library = library.iter().filter_map(|node| Some((id(node)?, node))).collect();
        for channel in perception.items("channels")? {
            let gain = channel.number_or("gain", 1.0, GAIN)?.abs();
            for band in channel.items("bands")? {
                read_band(&band, timescale, gain, &library, &mut score)?;
            }
        }
    }
    let strongest = score.found.iter().map(Found::peak).fold(1.0, f64::max);
    for one in score.found {
        match one {
            Found::Pulse(at, gain) => notes.pulse(at, gain / strongest)?,
            Found::Wave { at, mut amplitude, frequency } => {
                amplitude.iter_mut().for_each(|(_, a)| *a /= strongest);
                notes.wave(at, amplitude, frequency)?;
            }
        }
    }
    Ok(())
}

impl Found {
    fn peak(&self) -> f64 {
        match self {
            Self::Pulse(_, gain) => *gain,
            Self::Wave { amplitude, .. } => amplitude.iter().map(|(_, a)| *a).fold(0.0, f64::max),
        }
    }
}

fn read_band(
    band: &Node,
    timescale: f64,
    gain: f64,
    library: &Library,
    score: &mut Score,
) -> Result<(), StoreError> {
    let is_wave = band.require("band_type", "a text")?.one_of(&BANDS)? == BANDS[0];
    let limit = |key: &str, default: f64| band.number_or(key, default, [0.0, 1e6]);
    let low = limit("lower_frequency_limit", FREQUENCY[0])?.clamp(FREQUENCY[0], FREQUENCY[1]);
    let high = limit("upper_frequency_limit", FREQUENCY[1])?.clamp(low, FREQUENCY[1]);
    let place = Place { timescale, gain, band: [low, high], is_wave };
    for effect in band.items("effects")? {
        let position = effect.number_or("position", 0.0, TICKS)?;
        let kind = effect.require("effect_type", "a text")?.one_of(&EFFECTS)?;
        if kind == EFFECTS[1] {
            let id = effect.number_of("id", TICKS)?;
            let expected = || effect.refuse(format!("an effect whose id, {id}, is in effect_library"));
            let basis = library.get(&id.to_bits()).ok_or_else(expected)?;
            basis.require("effect_type", "a text")?.one_of(&EFFECTS[..1])?;
            read_effect(basis, position, &place, score)?;
        } else {
            read_effect(&effect, position, &place, score)?;
        }
    }
    Ok(())
}

fn read_effect(effect: &Node, position: f64, place: &Place, score: &mut Score) -> Result<(), StoreError> {
    if let Some(signal) = effect.get("base_signal").filter(|_| place.is_wave) {
        signal.one_of(&SIGNALS)?;
    }
    let seconds = |ticks: f64| ticks / place.timescale;
    let at = seconds(position);
    if at > TIME[1] {
        return Err(effect.refuse(format!("an effect within {} s", TIME[1])));
    }
    let frames = effect.items("keyframes")?;
    score.frames += frames.len();
    if score.frames > MOST_FRAMES {
        return Err(effect.refuse(format!("at most {MOST_FRAMES} keyframes in all")));
    }
    let (mut amplitude, mut frequency) = (Vec::new(), Vec::new());
    let mut times = Vec::new();
    for frame in &frames {
        let time = seconds(frame.number_or("relative_position", 0.0, TICKS)?);
        times.push((time, 0.0));
        if let Some(value) = frame.get("amplitude_modulation") {
            amplitude.push((time, place.gain * value.number(GAIN)?.abs()));
        }
        if let Some(value) = frame.get("frequency_modulation") {
            frequency.push((time, value.number(GAIN)?.clamp(place.band[0], place.band[1])));
        }
    }
    Node::ascending(&frames, "relative_position", &times)?;
    if !place.is_wave {
        if times.last().is_some_and(|(time, _)| at + time > TIME[1]) {
            return Err(effect.refuse(format!("transients within {} s", TIME[1])));
        }
        score.found.extend(amplitude.into_iter().map(|(time, gain)| Found::Pulse(at + time, gain)));
        return Ok(());
    }
    // The effect lasts until its last keyframe, at its last amplitude.
    let Some(&(end, _)) = times.last().filter(|(end, _)| *end > 0.0) else { return Ok(()) };
    let last = amplitude.last().map_or(place.gain, |(_, a)| *a);
    amplitude.push((end, last));
    if frequency.is_empty() {
        frequency.push((0.0, 0.5 * (place.band[0] + place.band[1])));
    }
    score.found.push(Found::Wave { at, amplitude, frequency });
    Ok(())
}
