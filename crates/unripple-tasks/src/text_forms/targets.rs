//! Targets and paths: points with gains and rates, shapes and lines, in mm.

use super::numbers::{FormError, above_zero, numbers};
use crate::target::{LineAsk, PointAsk, ShapeAsk};

/// Reads a point to be in focus: `X,Y[,GAIN[,HZ]]` in mm, with its gain and its repetition rate in Hz.
///
/// # Errors
/// [`FormError`] of another form, and of a rate that is not above 0.
///
/// ```
/// let point = unripple_tasks::text_forms::point("62,90,-0.5,50")?;
/// assert_eq!((point.at_m, point.gain, point.rate_hz), ([0.062, 0.09], -0.5, Some(50.0)));
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn point(text: &str) -> Result<PointAsk, FormError> {
    let values = numbers(text, "X,Y[,GAIN[,HZ]] in mm and Hz", 2, 4)?;
    let gain = values.get(2).copied().unwrap_or(1.0);
    let rate = values.get(3).map(|rate| above_zero(*rate, "Hz").map_err(|error| error.within(text, "rate")));
    Ok(PointAsk { at_m: [values[0] / 1e3, values[1] / 1e3], gain, rate_hz: rate.transpose()? })
}

/// Reads a shape: `triangle:X,Y,SIZE` or `circle:X,Y,R` in mm, which are outlines, or the path of an SVG file, whose paths say whether they
/// are filled or stroked.
///
/// # Errors
/// [`FormError`] of a triangle or circle without three numbers, or whose size is not above 0.
///
/// ```
/// use unripple_tasks::target::ShapeAsk;
/// use unripple_tasks::text_forms::shape;
///
/// assert_eq!(shape("circle:75,75,20")?, ShapeAsk::Circle { centre_m: [0.075, 0.075], radius_m: 0.02 });
/// assert_eq!(shape("arrow.svg")?, ShapeAsk::Svg { file: "arrow.svg".into() });
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn shape(text: &str) -> Result<ShapeAsk, FormError> {
    let sized = |rest: &str, name: &str| {
        let mm = numbers(rest, "X,Y and a size in mm", 3, 3).map_err(|error| error.behind(name))?;
        let size = above_zero(mm[2], "mm").map_err(|error| error.within(text, "size"))?;
        Ok::<_, FormError>(([mm[0] / 1e3, mm[1] / 1e3], size / 1e3))
    };
    if let Some(rest) = text.strip_prefix("triangle:") {
        sized(rest, "triangle:").map(|(centre_m, side_m)| ShapeAsk::Triangle { centre_m, side_m })
    } else if let Some(rest) = text.strip_prefix("circle:") {
        sized(rest, "circle:").map(|(centre_m, radius_m)| ShapeAsk::Circle { centre_m, radius_m })
    } else {
        Ok(ShapeAsk::Svg { file: text.into() })
    }
}

/// Reads the path of a moving focus: `line:X1,Y1,X2,Y2` in mm, or a shape as [`shape()`] reads it.
///
/// # Errors
/// [`FormError`] of a line without four finite numbers; those of [`shape()`].
///
/// ```
/// use unripple_tasks::target::{LineAsk, ShapeAsk};
///
/// let line = LineAsk { points_m: vec![[0.04, 0.075], [0.11, 0.075]], closed: false };
/// let path = unripple_tasks::text_forms::path("line:40,75,110,75")?;
/// assert_eq!(path, ShapeAsk::Lines { lines: vec![line], filled: false });
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn path(text: &str) -> Result<ShapeAsk, FormError> {
    let Some(rest) = text.strip_prefix("line:") else { return shape(text) };
    let mm = numbers(rest, "X1,Y1,X2,Y2 in mm", 4, 4).map_err(|error| error.behind("line:"))?;
    let points_m = vec![[mm[0] / 1e3, mm[1] / 1e3], [mm[2] / 1e3, mm[3] / 1e3]];
    Ok(ShapeAsk::Lines { lines: vec![LineAsk { points_m, closed: false }], filled: false })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_come_with_gain_and_rate() {
        let all = point("62,90,-0.5,5").unwrap();
        assert_eq!((all.gain, all.rate_hz), (-0.5, Some(5.0)));
        let bare = point("10,20").unwrap();
        assert_eq!((bare.gain, bare.rate_hz), (1.0, None));
        let said = point("62,90,1,0").unwrap_err().of("--at");
        assert_eq!(said, "--at 62,90,1,0: rate: expected a number above 0 Hz, found 0");
    }

    #[test]
    fn shapes_are_refused_by_what_is_wrong_with_them() {
        let said = |text: &str| shape(text).unwrap_err().of("--shape");
        assert_eq!(
            said("triangle:1,2"),
            "--shape triangle: 1,2: expected X,Y and a size in mm, found 2 numbers"
        );
        assert_eq!(
            said("circle:1,2,-3"),
            "--shape circle:1,2,-3: size: expected a number above 0 mm, found -3"
        );
    }

    #[test]
    fn paths_are_lines_circles_and_drawings() {
        let round = ShapeAsk::Circle { centre_m: [0.075, 0.075], radius_m: 0.01 };
        assert_eq!(path("circle:75,75,10").unwrap(), round);
        assert_eq!(path("arrow.svg").unwrap(), ShapeAsk::Svg { file: "arrow.svg".into() });
        let said = path("line:40,75,110").unwrap_err().of("--path");
        assert_eq!(said, "--path line: 40,75,110: expected X1,Y1,X2,Y2 in mm, found 3 numbers");
    }
}
