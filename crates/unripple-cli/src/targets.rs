//! Targets as typed: `X,Y[,GAIN[,HZ]]` and shapes, in millimetres.

use crate::args::TargetOptions;
use crate::error::CliError;
use unripple::act::{self, Level};
use unripple::core::{Conditions, Point};
use unripple::focus::{Line, Pattern, Target};
use unripple_store::Drawing;

/// How closely the curves of an SVG shape are followed, in metres.
const TOLERANCE: f64 = 0.05e-3;

/// Numbers separated by commas, between `least` and `most` of them.
pub fn numbers(
    text: &str,
    option: &str,
    form: &str,
    least: usize,
    most: usize,
) -> Result<Vec<f64>, CliError> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let wrong = |found: String| CliError::Input(format!("{option} {text}: expected {form}, found {found}"));
    if !(least..=most).contains(&parts.len()) {
        return Err(wrong(format!("{} numbers", parts.len())));
    }
    parts
        .iter()
        .map(|part| match part.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(wrong(format!("`{part}`"))),
        })
        .collect()
}

/// A place from `X,Y` in millimetres.
pub fn place(text: &str, option: &str) -> Result<Point, CliError> {
    let mm = numbers(text, option, "X,Y in mm", 2, 2)?;
    Ok(Point::from_mm(mm[0], mm[1]))
}

/// A positive number, or an error naming its option and unit.
pub fn positive(value: f64, option: &str, unit: &str) -> Result<f64, CliError> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(CliError::Input(format!("{option}: expected a number above 0 {unit}, found {value}")))
    }
}

/// How loud a drive is to be.
pub fn level(options: &TargetOptions) -> Result<Level, CliError> {
    Ok(match (options.felt_db, options.peak_um, options.full_limit) {
        (Some(db), ..) => Level::Felt(db),
        (None, Some(um), _) => Level::Peak(positive(um, "--peak-um", "µm")? / 1e6),
        (None, None, true) => Level::Limit,
        (None, None, false) => Level::default(),
    })
}

/// The same on responses of which nobody knows the scale, if there is a reason `why`: as loud as the limit allows, and no level that is asked
/// for by its size.
pub fn level_on(options: &TargetOptions, why: Option<&str>) -> Result<Level, CliError> {
    match (level(options)?, why) {
        (level, None) => Ok(level),
        (Level::Linear | Level::Limit, Some(_)) => Ok(Level::Limit),
        (Level::Peak(_) | Level::Felt(_), Some(why)) => {
            let option = if options.peak_um.is_some() { "--peak-um" } else { "--felt-db" };
            let text = format!("{option}: expected a library whose level is known, found one without: {why}");
            Err(CliError::Input(text))
        }
    }
}

/// Refuses a time that no wave of the band fits into, naming the option that makes it longer.
pub fn carries(conditions: &Conditions, seconds: f64, option: &str) -> Result<(), CliError> {
    act::carries(conditions, seconds).map_err(|error| CliError::Work(format!("{option}: {error}")))
}

/// An error, and if it is about a window that nobody `asked` for, the option that gives another.
pub fn of_window(error: CliError, asked: bool) -> CliError {
    let told = |text: String| match !asked && text.contains("window") && !text.contains("--window-ms") {
        true => format!("{text} (the window is the default one; --window-ms gives another)"),
        false => text,
    };
    match error {
        CliError::Input(text) => CliError::Input(told(text)),
        CliError::Work(text) => CliError::Work(told(text)),
        faults @ CliError::Faults(_) => faults,
    }
}

/// A positive time given in milliseconds, in seconds.
pub fn seconds(ms: Option<f64>, option: &str) -> Result<Option<f64>, CliError> {
    ms.map(|ms| Ok(positive(ms, option, "ms")? / 1e3)).transpose()
}

/// All targets asked for: points first, then shapes, each in the order typed.
pub fn all(options: &TargetOptions, lambda_min: f64) -> Result<Vec<Target>, CliError> {
    let mut targets = options.at.iter().map(|text| point(text)).collect::<Result<Vec<_>, _>>()?;
    for text in &options.shape {
        let points = pattern(text, "--shape")?
            .sample(Pattern::pitch(lambda_min))
            .map_err(|error| CliError::Input(format!("--shape {text}: {error}")))?;
        targets.push(Target::of(points));
    }
    if targets.is_empty() {
        return Err(CliError::Input("targets: expected --at X,Y or --shape SHAPE, found none".into()));
    }
    Ok(targets)
}

fn point(text: &str) -> Result<Target, CliError> {
    let values = numbers(text, "--at", "X,Y[,GAIN[,HZ]] in mm and Hz", 2, 4)?;
    let mut target = Target::at(Point::from_mm(values[0], values[1]));
    if let Some(gain) = values.get(2) {
        target = target.with_gain(*gain);
    }
    if let Some(rate) = values.get(3) {
        target = target.repeated(positive(*rate, &format!("--at {text}: rate"), "Hz")?);
    }
    Ok(target)
}

/// `triangle:X,Y,SIZE` and `circle:X,Y,R` are outlines; an SVG file says by itself what is filled and what is stroked.
pub fn pattern(text: &str, option: &str) -> Result<Pattern, CliError> {
    let form = |rest: &str, name: &str| {
        let values = numbers(rest, &format!("{option} {name}"), "X,Y and a size in mm", 3, 3)?;
        let size = positive(values[2], &format!("{option} {text}: size"), "mm")?;
        Ok((Point::from_mm(values[0], values[1]), size / 1e3))
    };
    if let Some(rest) = text.strip_prefix("triangle:") {
        form(rest, "triangle:").map(|(centre, side)| Pattern::triangle(centre, side))
    } else if let Some(rest) = text.strip_prefix("circle:") {
        form(rest, "circle:").map(|(centre, radius)| Pattern::circle(centre, radius))
    } else {
        drawn(text, option)
    }
}

fn drawn(file: &str, option: &str) -> Result<Pattern, CliError> {
    let drawing = Drawing::read(file, TOLERANCE)?;
    let filled = drawing.shapes.iter().any(|shape| shape.fill.is_some());
    let meant = drawing.shapes.iter().filter(|shape| shape.fill.is_some() == filled);
    let lines: Vec<Line> = meant
        .flat_map(|shape| &shape.polylines)
        .map(|line| Line { points: line.points.clone(), closed: line.closed })
        .collect();
    if lines.is_empty() {
        return Err(CliError::Input(format!(
            "{option} {file}: expected a filled or stroked path, found none"
        )));
    }
    Ok(Pattern { lines, filled })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(at: &[&str], shape: &[&str]) -> TargetOptions {
        let owned = |list: &[&str]| list.iter().map(|s| (*s).to_owned()).collect();
        TargetOptions { at: owned(at), shape: owned(shape), ..TargetOptions::default() }
    }

    #[test]
    fn points_come_with_gain_and_rate() {
        let targets = all(&options(&["62,90,-0.5,5", "10,20"], &["circle:75,75,20"]), 0.0146).unwrap();
        assert_eq!((targets[0].gain, targets[0].rate_hz), (-0.5, Some(5.0)));
        assert_eq!((targets[1].gain, targets[1].rate_hz), (1.0, None));
        let rim = Point::from_mm(75.0, 75.0);
        assert!(targets[2].points.iter().all(|p| (p.distance(rim) - 0.02).abs() < 1e-5));
        assert!(all(&options(&[], &[]), 0.0146).is_err());
        for bad in ["triangle:1,2", "circle:1,2,-3", "no-such-file.svg"] {
            assert!(all(&options(&[], &[bad]), 0.0146).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_place_is_two_finite_numbers() {
        assert_eq!(place("62, 90", "--at").unwrap(), Point::from_mm(62.0, 90.0));
        for bad in ["", "62", "62;90", "62,NaN", "62,inf", "1,2,3", "a,b"] {
            let CliError::Input(text) = place(bad, "--at").unwrap_err() else { panic!("{bad}") };
            assert!(text.starts_with("--at ") && text.contains("expected X,Y in mm"), "{text}");
        }
    }
}
