//! Waveforms at a place: tones, bursts, clicks and recordings, in mm, ms and µm.

use super::numbers::{FormError, above_zero, numbers};
use super::places::place;
use crate::waveform::{LEVEL_M, SoundAsk, WaveformAsk};

/// Reads a waveform at a place: `X,Y,sine:HZ,MS[,UM]`, `X,Y,burst:HZ,CYCLES[,UM]`, `X,Y,click:MS[,UM]` or `X,Y,FILE.wav[,UM]`, in mm, with its
/// peak in µm, 1 µm if there is none.
///
/// # Errors
/// [`FormError`] of another form, and of a peak that is not above 0.
///
/// ```
/// use unripple_tasks::waveform::SoundAsk;
///
/// let burst = unripple_tasks::text_forms::waveform("62,90,burst:250,5,3")?;
/// assert_eq!((burst.at_m, burst.level_m), ([0.062, 0.09], 3e-6));
/// assert_eq!(burst.sound, SoundAsk::Burst { hz: 250.0, cycles: 5.0 });
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn waveform(text: &str) -> Result<WaveformAsk, FormError> {
    let parts: Vec<&str> = text.splitn(3, ',').collect();
    let &[x, y, what] = &parts[..] else {
        let form = "X,Y and sine:HZ,MS, burst:HZ,CYCLES, click:MS or a WAV file";
        return Err(FormError::new(text, form, format!("`{text}`")));
    };
    let at_m = place(&format!("{x},{y}"))?;
    // The numbers behind a name, of which the last may be left out.
    let named = |name: &str, form: &str, most: usize| {
        let rest = what.strip_prefix(name)?.strip_prefix(':')?;
        let read = numbers(rest, form, most - 1, most);
        Some(read.map_err(|error| error.behind(&format!("{x},{y},{name}:"))))
    };
    let (sound, um) = if let Some(read) = named("sine", "HZ,MS[,UM]", 3) {
        let n = read?;
        (SoundAsk::Sine { hz: n[0], length_s: n[1] / 1e3 }, n.get(2).copied())
    } else if let Some(read) = named("burst", "HZ,CYCLES[,UM]", 3) {
        let n = read?;
        (SoundAsk::Burst { hz: n[0], cycles: n[1] }, n.get(2).copied())
    } else if let Some(read) = named("click", "MS[,UM]", 2) {
        let n = read?;
        (SoundAsk::Click { length_s: n[0] / 1e3 }, n.get(1).copied())
    } else {
        let typed = what.rsplit_once(',').and_then(|(file, um)| Some((file, um.trim().parse::<f64>().ok()?)));
        let (file, um) = typed.map_or((what, None), |(file, um)| (file, Some(um)));
        (SoundAsk::Wav { file: file.into() }, um)
    };
    let refused = |error: FormError| FormError { quantity: Some("level"), ..error };
    let level_m = match um {
        Some(um) => above_zero(um, "µm").map_err(refused)? * 1e-6,
        None => LEVEL_M,
    };
    Ok(WaveformAsk { at_m, sound, level_m })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waveforms_are_a_place_and_a_sound() {
        let tone = waveform("45,60,sine:250,1000,5").unwrap();
        assert_eq!((tone.at_m, tone.level_m), ([0.045, 0.06], 5.0 * 1e-6));
        assert_eq!(tone.sound, SoundAsk::Sine { hz: 250.0, length_s: 1.0 });
        let sound = |text: &str| waveform(text).unwrap().sound;
        assert_eq!(sound("1,2,click:2"), SoundAsk::Click { length_s: 0.002 });
        assert_eq!(sound("1,2,burst:250,5"), SoundAsk::Burst { hz: 250.0, cycles: 5.0 });
        assert_eq!(sound("1,2,a.wav,3"), SoundAsk::Wav { file: "a.wav".into() });
        assert_eq!(
            waveform("1,2,a,b.wav").unwrap(),
            WaveformAsk {
                at_m: [0.001, 0.002],
                sound: SoundAsk::Wav { file: "a,b.wav".into() },
                level_m: 1e-6,
            }
        );
    }

    #[test]
    fn waveforms_are_refused_by_what_is_wrong_with_them() {
        for (text, said) in [
            (
                "1,2",
                "--waveform 1,2: expected X,Y and sine:HZ,MS, burst:HZ,CYCLES, click:MS or a WAV file, found `1,2`",
            ),
            ("1,a,click:2", "--waveform 1,a: expected X,Y in mm, found `a`"),
            ("1,2,sine:250", "--waveform 1,2,sine: 250: expected HZ,MS[,UM], found 1 numbers"),
            ("1,2,sine:250,1000,-1", "--waveform: level: expected a number above 0 µm, found -1"),
        ] {
            assert_eq!(waveform(text).unwrap_err().of("--waveform"), said);
        }
    }
}
