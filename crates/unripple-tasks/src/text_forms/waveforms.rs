//! Waveforms, still places and strokes on the command line, in millimetres, micrometres and milliseconds.

use crate::args::{FocusOptions, TargetOptions};
use crate::error::CliError;
use crate::targets::{self, numbers, place, positive};
use unripple_tasks::target::{LineAsk, ShapeAsk};
use unripple_tasks::waveform::{SoundAsk, WaveformAsk};

/// Level of a waveform if none is typed, in metres. A micrometre is well above the threshold of touch at 250 Hz (0.1
/// µm) and far below a film's thickness.
const LEVEL: f64 = 1e-6;

/// Velocity of the pulses of a stroke if none is typed, in m/s.
const STROKE: f64 = 10e-3;

/// Refuses combinations of options that are not possible.
pub fn check(options: &FocusOptions) -> Result<(), CliError> {
    let TargetOptions {
        at,
        shape,
        peak_um,
        felt_db,
        full_limit,
        waveform,
        silent,
        path,
        speed_mm_s,
        level_mm_s,
    } = &options.targets;
    let wrong = |text: &str| Err(CliError::Input(text.to_owned()));
    if !waveform.is_empty() && path.is_some() {
        return wrong("--waveform: expected no --path beside it, found one");
    }
    if waveform.is_empty() && !silent.is_empty() {
        return wrong("--silent: expected --waveform X,Y,WHAT beside it, found none");
    }
    if path.is_none() && (speed_mm_s.is_some() || level_mm_s.is_some()) {
        return wrong("--speed-mm-s, --level-mm-s: expected --path beside them, found none");
    }
    let moving = !waveform.is_empty() || path.is_some();
    let levelled = peak_um.is_some() || felt_db.is_some() || *full_limit;
    if moving && !(at.is_empty() && shape.is_empty() && !levelled) {
        return wrong(
            "--waveform, --path: expected no --at, --shape, --peak-um, --felt-db or --full-limit beside them, found one",
        );
    }
    if moving && !options.finger.is_empty() {
        return wrong("--waveform, --path: expected no --finger beside them, found one");
    }
    Ok(())
}

/// Parses the values of `--waveform`: `X,Y,sine:HZ,MS[,UM]`, `X,Y,burst:HZ,CYCLES[,UM]`, `X,Y,click:MS[,UM]` or
/// `X,Y,FILE.wav[,UM]`.
pub fn waveforms(options: &TargetOptions) -> Result<Vec<WaveformAsk>, CliError> {
    options.waveform.iter().map(|text| waveform(text)).collect()
}

fn waveform(text: &str) -> Result<WaveformAsk, CliError> {
    let parts: Vec<&str> = text.splitn(3, ',').collect();
    let &[x, y, what] = &parts[..] else {
        let form = "X,Y and sine:HZ,MS, burst:HZ,CYCLES, click:MS or a WAV file";
        return Err(CliError::Input(format!("--waveform {text}: expected {form}, found `{text}`")));
    };
    let at = place(&format!("{x},{y}"), "--waveform")?;
    let option = format!("--waveform {x},{y},");
    let named = |name: &str| what.strip_prefix(name).and_then(|rest| rest.strip_prefix(':'));
    let level = |um: Option<&f64>| match um {
        Some(um) => Ok(positive(*um, "--waveform: level", "µm")? * 1e-6),
        None => Ok::<f64, CliError>(LEVEL),
    };
    let (sound, level_m) = if let Some(rest) = named("sine") {
        let n = numbers(rest, &format!("{option}sine:"), "HZ,MS[,UM]", 2, 3)?;
        (SoundAsk::Sine { hz: n[0], length_s: n[1] / 1e3 }, level(n.get(2))?)
    } else if let Some(rest) = named("burst") {
        let n = numbers(rest, &format!("{option}burst:"), "HZ,CYCLES[,UM]", 2, 3)?;
        (SoundAsk::Burst { hz: n[0], cycles: n[1] }, level(n.get(2))?)
    } else if let Some(rest) = named("click") {
        let n = numbers(rest, &format!("{option}click:"), "MS[,UM]", 1, 2)?;
        (SoundAsk::Click { length_s: n[0] / 1e3 }, level(n.get(1))?)
    } else {
        let typed = what.rsplit_once(',').and_then(|(file, um)| Some((file, um.trim().parse::<f64>().ok()?)));
        let (file, um) = typed.map_or((what, None), |(file, um)| (file, Some(um)));
        (SoundAsk::Wav { file: file.into() }, level(um.as_ref())?)
    };
    Ok(WaveformAsk { at_m: [at.x, at.y], sound, level_m })
}

/// Parses the path of a stroke, and gives it with its speed and the velocity of its pulses (both m/s).
pub fn stroke(options: &TargetOptions, text: &str) -> Result<(ShapeAsk, f64, f64), CliError> {
    let Some(speed) = options.speed_mm_s else {
        return Err(CliError::Input("--path: expected --speed-mm-s V beside it, found none".into()));
    };
    let speed = positive(speed, "--speed-mm-s", "mm/s")? / 1e3;
    let level = match options.level_mm_s {
        Some(v) => positive(v, "--level-mm-s", "mm/s")? / 1e3,
        None => STROKE,
    };
    Ok((path(text)?, speed, level))
}

fn path(text: &str) -> Result<ShapeAsk, CliError> {
    let Some(rest) = text.strip_prefix("line:") else {
        return targets::shape(text, "--path");
    };
    let mm = numbers(rest, "--path line:", "X1,Y1,X2,Y2 in mm", 4, 4)?;
    let points_m = vec![[mm[0] / 1e3, mm[1] / 1e3], [mm[2] / 1e3, mm[3] / 1e3]];
    Ok(ShapeAsk::Lines { lines: vec![LineAsk { points_m, closed: false }], filled: false })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(text: &str) -> String {
        match waveform(text) {
            Err(CliError::Input(text)) => text,
            other => panic!("{text}: {other:?}"),
        }
    }

    #[test]
    fn waveforms_are_a_place_and_a_sound() {
        let tone = waveform("45,60,sine:250,1000,5").unwrap();
        assert_eq!((tone.at_m, tone.level_m), ([0.045, 0.06], 5.0 * 1e-6));
        assert_eq!(tone.sound, SoundAsk::Sine { hz: 250.0, length_s: 1.0 });
        assert_eq!(waveform("1,2,click:2").unwrap().sound, SoundAsk::Click { length_s: 0.002 });
        assert_eq!(waveform("1,2,burst:250,5").unwrap().sound, SoundAsk::Burst { hz: 250.0, cycles: 5.0 });
        assert_eq!(waveform("1,2,a.wav,3").unwrap().sound, SoundAsk::Wav { file: "a.wav".into() });
        assert!(refusal("1,2").contains("expected X,Y and sine:HZ,MS"));
        assert!(refusal("1,a,click:2").contains("`a`"));
        assert!(refusal("1,2,sine:250").contains("HZ,MS[,UM]"));
        assert!(refusal("1,2,sine:250,1000,-1").contains("above 0 µm"));
    }

    #[test]
    fn paths_are_lines_circles_and_drawings() {
        let of = |path: &str, speed| {
            stroke(&TargetOptions { speed_mm_s: speed, ..TargetOptions::default() }, path)
        };
        let (line, speed, level) = of("line:40,75,110,75", Some(100.0)).unwrap();
        assert!(matches!(line, ShapeAsk::Lines { .. }) && speed == 0.1 && level == 0.01);
        let (round, ..) = of("circle:75,75,10", Some(100.0)).unwrap();
        assert_eq!(round, ShapeAsk::Circle { centre_m: [0.075, 0.075], radius_m: 0.01 });
        assert!(of("line:40,75,110,75", None).is_err());
        assert!(of("line:40,75,110", Some(100.0)).is_err());
    }
}
