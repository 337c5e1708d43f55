//! Places, polygons and distances on the surface, in mm.

use super::numbers::{FormError, numbers};
use crate::Place;

/// Corners of a polygon at most: more numbers are taken for a mistake.
const CORNERS: usize = 1000;

/// Reads a place `X,Y` in mm; gives it in m.
///
/// # Errors
/// [`FormError`] of anything but two finite numbers.
///
/// ```
/// assert_eq!(unripple_tasks::text_forms::place("62, 90")?, [0.062, 0.09]);
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn place(text: &str) -> Result<Place, FormError> {
    Ok(metres(&numbers(text, "X,Y in mm", 2, 2)?))
}

/// Reads places with optional weights, `X,Y[,WEIGHT]` in mm; gives the places in m, and their weights: none if no place has one, else 1 for
/// those that have none.
///
/// # Errors
/// [`FormError`] of anything but two or three finite numbers.
///
/// ```
/// let (places, weights) = unripple_tasks::text_forms::weighted(&["62,90", "40,60,2"])?;
/// assert_eq!((places, weights), (vec![[0.062, 0.09], [0.04, 0.06]], vec![1.0, 2.0]));
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn weighted(texts: &[impl AsRef<str>]) -> Result<(Vec<Place>, Vec<f64>), FormError> {
    let read = texts.iter().map(|text| numbers(text.as_ref(), "X,Y[,WEIGHT] in mm", 2, 3));
    let all = read.collect::<Result<Vec<_>, _>>()?;
    let weights = match all.iter().any(|values| values.len() == 3) {
        true => all.iter().map(|values| values.get(2).copied().unwrap_or(1.0)).collect(),
        false => Vec::new(),
    };
    Ok((all.iter().map(|values| metres(values)).collect(), weights))
}

/// Reads the corners of a polygon, `X,Y,X,Y,X,Y...` in mm, at least three; gives them in m.
///
/// # Errors
/// [`FormError`] of fewer corners, of half a corner, and of what is no finite number.
///
/// ```
/// use unripple_tasks::text_forms::polygon;
///
/// assert_eq!(polygon("0,0,10,0,10,20")?, [[0.0, 0.0], [0.01, 0.0], [0.01, 0.02]]);
/// assert!(polygon("0,0,10,0,10,20,5").is_err());
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn polygon(text: &str) -> Result<Vec<Place>, FormError> {
    let mm = numbers(text, "at least three corners X,Y in mm", 6, 2 * CORNERS)?;
    match mm.len() % 2 {
        0 => Ok(mm.chunks_exact(2).map(metres).collect()),
        _ => Err(FormError::new(text, "pairs X,Y in mm", format!("{} numbers", mm.len()))),
    }
}

/// Reads the corners of a polygon and its weight, `X,Y,X,Y,X,Y...:WEIGHT` in mm; gives the corners in m.
///
/// # Errors
/// [`FormError`] of a text without `:`, of a weight that is no finite number from 0, and those of [`polygon`].
///
/// ```
/// use unripple_tasks::text_forms::weighted_polygon;
///
/// let (corners, weight) = weighted_polygon("0,0,10,0,10,20:3")?;
/// assert_eq!((corners.len(), weight), (3, 3.0));
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn weighted_polygon(text: &str) -> Result<(Vec<Place>, f64), FormError> {
    let form = "X,Y,X,Y,X,Y...:WEIGHT in mm";
    let (corners, weight) = text.rsplit_once(':').ok_or_else(|| FormError::new(text, form, "no weight"))?;
    let weight = numbers(weight, "a weight from 0", 1, 1).map_err(|error| error.within(text, "weight"))?[0];
    match weight >= 0.0 {
        true => Ok((polygon(corners)?, weight)),
        false => Err(FormError::new(text, form, format!("a weight of {weight}"))),
    }
}

/// Reads a least and a greatest distance, `LEAST,MOST` in mm; gives them in m. Which of them is larger is left to the task.
///
/// # Errors
/// [`FormError`] of anything but two finite numbers.
///
/// ```
/// assert_eq!(unripple_tasks::text_forms::distances("6,12")?, [0.006, 0.012]);
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn distances(text: &str) -> Result<[f64; 2], FormError> {
    Ok(metres(&numbers(text, "LEAST,MOST in mm", 2, 2)?))
}

/// The first two of some lengths, from mm to m.
fn metres(mm: &[f64]) -> [f64; 2] {
    [mm[0] / 1e3, mm[1] / 1e3]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_two_finite_numbers() {
        assert_eq!(place("62, 90").unwrap(), [0.062, 0.09]);
        for bad in ["", "62", "62;90", "62,NaN", "62,inf", "1,2,3", "a,b"] {
            let said = place(bad).unwrap_err().of("--at");
            assert!(said.starts_with("--at ") && said.contains("expected X,Y in mm"), "{said}");
        }
    }

    #[test]
    fn weights_are_there_if_one_is_typed() {
        assert!(weighted(&["62,90"]).unwrap().1.is_empty());
        let said = weighted(&["62,90", "1,2,3,4"]).unwrap_err().of("--at");
        assert_eq!(said, "--at 1,2,3,4: expected X,Y[,WEIGHT] in mm, found 4 numbers");
    }

    #[test]
    fn weights_of_polygons_are_numbers_from_0() {
        let said = |text: &str| weighted_polygon(text).unwrap_err().of("--important");
        assert_eq!(
            said("0,0,10,10,20,0"),
            "--important 0,0,10,10,20,0: expected X,Y,X,Y,X,Y...:WEIGHT in mm, found no weight"
        );
        assert_eq!(
            said("0,0,10,10,20,0:x"),
            "--important 0,0,10,10,20,0:x: weight: expected a weight from 0, found `x`"
        );
        assert!(said("0,0,10,10,20,0:-1").ends_with("found a weight of -1"));
        assert!(said("0,0,10,10:1").contains("at least three corners"));
        assert_eq!(weighted_polygon("0,0,10,10,20,0:0").unwrap().1, 0.0);
    }

    #[test]
    fn polygons_have_three_whole_corners_and_not_too_many() {
        let said = |text: &str| polygon(text).unwrap_err().of("--within");
        assert_eq!(
            said("0,0,10,10"),
            "--within 0,0,10,10: expected at least three corners X,Y in mm, found 4 numbers"
        );
        assert_eq!(
            said("0,0,10,10,20,0,5"),
            "--within 0,0,10,10,20,0,5: expected pairs X,Y in mm, found 7 numbers"
        );
        let many = vec!["1"; 2 * CORNERS + 2].join(",");
        assert!(said(&many).ends_with("found 2002 numbers"));
    }
}
