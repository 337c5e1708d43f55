//! Waveforms, points of silence and strokes as typed, in millimetres, micrometres and milliseconds.

use crate::args::{FocusOptions, TargetOptions};
use crate::error::CliError;
use crate::targets::{self, numbers, place, positive};
use unripple::core::Point;
use unripple::focus::waveform::{burst, click, resampled, sine};
use unripple::focus::{Line, Pattern, Stroke, Waveform};
use unripple_store::read_wav;

/// Level of a waveform if none is typed, in metres.
const LEVEL: f64 = 1e-6;

/// Velocity of the pulses of a stroke if none is typed, in m/s.
const STROKE: f64 = 10e-3;

/// Refuses options that do not go together.
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

/// `X,Y,sine:HZ,MS[,UM]`, `X,Y,burst:HZ,CYCLES[,UM]`, `X,Y,click:MS[,UM]` or `X,Y,FILE.wav[,UM]`.
pub fn waveforms(options: &TargetOptions, rate: f64) -> Result<Vec<Waveform>, CliError> {
    options.waveform.iter().map(|text| waveform(text, rate)).collect()
}

/// The points of silence.
pub fn silent(options: &TargetOptions) -> Result<Vec<Point>, CliError> {
    options.silent.iter().map(|text| place(text, "--silent")).collect()
}

fn waveform(text: &str, rate: f64) -> Result<Waveform, CliError> {
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
    let samples = if let Some(rest) = named("sine") {
        let n = numbers(rest, &format!("{option}sine:"), "HZ,MS[,UM]", 2, 3)?;
        sine(n[0], n[1] / 1e3, level(n.get(2))?, rate)
    } else if let Some(rest) = named("burst") {
        let n = numbers(rest, &format!("{option}burst:"), "HZ,CYCLES[,UM]", 2, 3)?;
        burst(n[0], n[1], level(n.get(2))?, rate)
    } else if let Some(rest) = named("click") {
        let n = numbers(rest, &format!("{option}click:"), "MS[,UM]", 1, 2)?;
        click(n[0] / 1e3, level(n.get(1))?, rate)
    } else {
        let typed = what.rsplit_once(',').and_then(|(file, um)| Some((file, um.trim().parse::<f64>().ok()?)));
        let (file, um) = typed.map_or((what, None), |(file, um)| (file, Some(um)));
        return Ok(Waveform::at(at, recorded(file, level(um.as_ref())?, rate)?));
    };
    Ok(Waveform::at(at, samples.map_err(|error| CliError::Input(format!("--waveform {text}: {error}")))?))
}

/// The first channel of a recording, its largest sample brought to `level`.
fn recorded(file: &str, level: f64, rate: f64) -> Result<Vec<f64>, CliError> {
    let wav = read_wav(file)?;
    let first = wav.channels.first().map_or(&[][..], |channel| channel);
    let mut samples = resampled(first, wav.rate, rate).map_err(CliError::input)?;
    let peak = samples.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if peak == 0.0 {
        return Err(CliError::Input(format!("--waveform: {file}: expected a sound, found silence")));
    }
    samples.iter_mut().for_each(|x| *x *= level / peak);
    Ok(samples)
}

/// The stroke of `--path`, if there is one.
pub fn stroke(options: &TargetOptions) -> Result<Option<Stroke>, CliError> {
    let Some(text) = &options.path else { return Ok(None) };
    let Some(speed) = options.speed_mm_s else {
        return Err(CliError::Input("--path: expected --speed-mm-s V beside it, found none".into()));
    };
    let speed = positive(speed, "--speed-mm-s", "mm/s")? / 1e3;
    let level = match options.level_mm_s {
        Some(v) => positive(v, "--level-mm-s", "mm/s")? / 1e3,
        None => STROKE,
    };
    Ok(Some(Stroke { level, ..Stroke::along(path(text)?, speed) }))
}

fn path(text: &str) -> Result<Pattern, CliError> {
    let Some(rest) = text.strip_prefix("line:") else {
        let drawn = targets::pattern(text, "--path")?;
        return Ok(Pattern { filled: false, ..drawn });
    };
    let mm = numbers(rest, "--path line:", "X1,Y1,X2,Y2 in mm", 4, 4)?;
    let points = vec![Point::from_mm(mm[0], mm[1]), Point::from_mm(mm[2], mm[3])];
    Ok(Pattern { lines: vec![Line { points, closed: false }], filled: false })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(text: &str) -> String {
        match waveform(text, 48e3) {
            Err(CliError::Input(text)) => text,
            other => panic!("{text}: {other:?}"),
        }
    }

    #[test]
    fn waveforms_are_a_place_and_a_sound() {
        let tone = waveform("45,60,sine:250,1000,5", 48e3).unwrap();
        assert_eq!((tone.points[0], tone.samples.len()), (Point::from_mm(45.0, 60.0), 48_000));
        let peak = tone.samples.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        assert!((peak - 5e-6).abs() < 1e-8);
        assert_eq!(waveform("1,2,click:2", 48e3).unwrap().samples.len(), 96);
        assert_eq!(waveform("1,2,burst:250,5", 48e3).unwrap().samples.len(), 960);
        assert!(refusal("1,2").contains("expected X,Y and sine:HZ,MS"));
        assert!(refusal("1,a,click:2").contains("`a`"));
        assert!(refusal("1,2,sine:250").contains("HZ,MS[,UM]"));
        assert!(refusal("1,2,sine:250,1000,-1").contains("above 0 µm"));
        assert!(refusal("1,2,sine:99000,1000").contains("below 24000"));
    }

    #[test]
    fn paths_are_lines_circles_and_drawings() {
        let of = |path: &str, speed| TargetOptions {
            path: Some(path.into()),
            speed_mm_s: speed,
            ..TargetOptions::default()
        };
        let line = stroke(&of("line:40,75,110,75", Some(100.0))).unwrap().unwrap();
        assert!((line.duration() - 0.7).abs() < 1e-12 && line.level == 0.01);
        let round = stroke(&of("circle:75,75,10", Some(100.0))).unwrap().unwrap();
        assert!((round.duration() - 0.628).abs() < 1e-3);
        assert!(stroke(&of("line:40,75,110,75", None)).is_err());
        assert!(stroke(&of("line:40,75,110", Some(100.0))).is_err());
        assert!(stroke(&TargetOptions::default()).unwrap().is_none());
    }
}
