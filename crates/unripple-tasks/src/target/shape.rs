//! A shape or a path in a request.

use crate::{Place, TaskError, point};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use unripple::core::Point;
use unripple::focus::{Line, Pattern};
use unripple_store::Drawing;

/// Largest deviation of polylines from the curves of an SVG shape, in metres: a hundredth of a focus's
/// width and less.
const TOLERANCE: f64 = 0.05e-3;

/// A polyline, given by its corners.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LineAsk {
    /// Corners of the line, in m.
    pub points_m: Vec<Place>,
    /// Whether the line goes back to the first corner.
    pub closed: bool,
}

/// A shape in a request: a target, or the path of a moving focus.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum ShapeAsk {
    /// The outline of an equilateral triangle that stands on a side.
    Triangle {
        /// Centre of the triangle, in m.
        centre_m: Place,
        /// Length of the triangle's sides, in m.
        side_m: f64,
    },
    /// The circumference of a circle.
    Circle {
        /// Centre of the circle, in m.
        centre_m: Place,
        /// Radius of the circle, in m.
        radius_m: f64,
    },
    /// Polylines, or the areas that they enclose.
    Lines {
        /// The polylines, each a list of corners.
        lines: Vec<LineAsk>,
        /// Whether the enclosed areas are the targets rather than the lines.
        filled: bool,
    },
    /// An SVG file, whose paths say whether they are filled or stroked.
    Svg {
        /// Path of the SVG file.
        file: PathBuf,
    },
}

impl ShapeAsk {
    /// Mutable reference to the path of the shape's SVG file; `None` for shapes without a file.
    pub fn file(&mut self) -> Option<&mut PathBuf> {
        match self {
            Self::Svg { file } => Some(file),
            _ => None,
        }
    }

    /// Converts the shape to a [`Pattern`]; errors name `field`.
    ///
    /// # Errors
    /// [`TaskError::Ask`] of a size that is not above 0, or of a drawing without a path; those of reading a drawing.
    pub fn pattern(&self, field: &'static str) -> Result<Pattern, TaskError> {
        let sized = |centre: &Place, size: f64, made: fn(Point, f64) -> Pattern| match size.is_finite()
            && size > 0.0
        {
            true => Ok(made(point(centre), size)),
            false => Err(TaskError::ask(field, "a size above 0 m", size)),
        };
        match self {
            Self::Triangle { centre_m, side_m } => sized(centre_m, *side_m, Pattern::triangle),
            Self::Circle { centre_m, radius_m } => sized(centre_m, *radius_m, Pattern::circle),
            Self::Lines { lines, filled } => {
                let line = |line: &LineAsk| Line {
                    points: line.points_m.iter().map(point).collect(),
                    closed: line.closed,
                };
                Ok(Pattern { lines: lines.iter().map(line).collect(), filled: *filled })
            }
            Self::Svg { file } => drawn(file, field),
        }
    }
}

fn drawn(file: &PathBuf, field: &'static str) -> Result<Pattern, TaskError> {
    let drawing = Drawing::read(file, TOLERANCE)?;
    let filled = drawing.shapes.iter().any(|shape| shape.fill.is_some());
    let meant = drawing.shapes.iter().filter(|shape| shape.fill.is_some() == filled);
    let lines: Vec<Line> = meant
        .flat_map(|shape| &shape.polylines)
        .map(|line| Line { points: line.points.clone(), closed: line.closed })
        .collect();
    if lines.is_empty() {
        let found = format!("none in {}", file.display());
        return Err(TaskError::ask(field, "a filled or stroked path", found));
    }
    Ok(Pattern { lines, filled })
}
