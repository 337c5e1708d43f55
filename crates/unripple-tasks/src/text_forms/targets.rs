//! Targets on the command line: `X,Y[,GAIN[,HZ]]` and shapes, in millimetres.

use crate::args::TargetOptions;
use crate::error::CliError;
use unripple::core::Point;
use unripple_tasks::Place;
use unripple_tasks::target::{LevelAsk, PointAsk, ShapeAsk};

/// Parses `least` to `most` numbers separated by commas; `option` and `form` are named in errors.
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

/// Parses a place `X,Y` in millimetres.
pub fn place(text: &str, option: &str) -> Result<Point, CliError> {
    let mm = numbers(text, option, "X,Y in mm", 2, 2)?;
    Ok(Point::from_mm(mm[0], mm[1]))
}

/// Checks that a number is above 0; the error names its option and unit.
pub fn positive(value: f64, option: &str, unit: &str) -> Result<f64, CliError> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(CliError::Input(format!("{option}: expected a number above 0 {unit}, found {value}")))
    }
}

/// The level of the drive that the options ask for.
pub fn level(options: &TargetOptions) -> Result<LevelAsk, CliError> {
    Ok(match (options.felt_db, options.peak_um, options.full_limit) {
        (Some(db), ..) => LevelAsk::FeltDb(db),
        (None, Some(um), _) => LevelAsk::PeakM(positive(um, "--peak-um", "µm")? / 1e6),
        (None, None, true) => LevelAsk::Limit,
        (None, None, false) => LevelAsk::Linear,
    })
}

/// Converts a time above 0 from milliseconds to seconds.
pub fn seconds(ms: Option<f64>, option: &str) -> Result<Option<f64>, CliError> {
    ms.map(|ms| Ok(positive(ms, option, "ms")? / 1e3)).transpose()
}

/// The points asked for, in the order typed.
pub fn points(options: &TargetOptions) -> Result<Vec<PointAsk>, CliError> {
    options.at.iter().map(|text| point(text)).collect()
}

/// The shapes asked for, in the order typed.
pub fn shapes(options: &TargetOptions) -> Result<Vec<ShapeAsk>, CliError> {
    options.shape.iter().map(|text| shape(text, "--shape")).collect()
}

fn point(text: &str) -> Result<PointAsk, CliError> {
    let values = numbers(text, "--at", "X,Y[,GAIN[,HZ]] in mm and Hz", 2, 4)?;
    let gain = values.get(2).copied().unwrap_or(1.0);
    let rate = values.get(3).map(|rate| positive(*rate, &format!("--at {text}: rate"), "Hz"));
    Ok(PointAsk { at_m: [values[0] / 1e3, values[1] / 1e3], gain, rate_hz: rate.transpose()? })
}

/// Parses a shape: `triangle:X,Y,SIZE` or `circle:X,Y,R`, which are outlines, or an SVG file, whose paths say whether
/// they are filled or stroked.
pub fn shape(text: &str, option: &str) -> Result<ShapeAsk, CliError> {
    let form = |rest: &str, name: &str| {
        let values = numbers(rest, &format!("{option} {name}"), "X,Y and a size in mm", 3, 3)?;
        let size = positive(values[2], &format!("{option} {text}: size"), "mm")?;
        Ok::<_, CliError>(([values[0] / 1e3, values[1] / 1e3], size / 1e3))
    };
    if let Some(rest) = text.strip_prefix("triangle:") {
        form(rest, "triangle:").map(|(centre_m, side_m)| ShapeAsk::Triangle { centre_m, side_m })
    } else if let Some(rest) = text.strip_prefix("circle:") {
        form(rest, "circle:").map(|(centre_m, radius_m)| ShapeAsk::Circle { centre_m, radius_m })
    } else {
        Ok(ShapeAsk::Svg { file: text.into() })
    }
}

/// Parses places `X,Y` in millimetres; gives them in metres.
pub fn places(typed: &[String], option: &str) -> Result<Vec<Place>, CliError> {
    typed.iter().map(|text| place(text, option).map(|at| [at.x, at.y])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_come_with_gain_and_rate() {
        let owned = |list: &[&str]| list.iter().map(|s| (*s).to_owned()).collect();
        let options = TargetOptions {
            at: owned(&["62,90,-0.5,5", "10,20"]),
            shape: owned(&["circle:75,75,20", "arrow.svg"]),
            ..TargetOptions::default()
        };
        let found = points(&options).unwrap();
        assert_eq!((found[0].gain, found[0].rate_hz), (-0.5, Some(5.0)));
        assert_eq!((found[1].gain, found[1].rate_hz), (1.0, None));
        let drawn = [
            ShapeAsk::Circle { centre_m: [0.075, 0.075], radius_m: 0.02 },
            ShapeAsk::Svg { file: "arrow.svg".into() },
        ];
        assert_eq!(shapes(&options).unwrap(), drawn);
        for bad in ["triangle:1,2", "circle:1,2,-3"] {
            assert!(shape(bad, "--shape").is_err(), "{bad}");
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
