//! The faults for which an outline encloses no valid sheet.

use crate::Point;

/// A reason for which an outline encloses no valid sheet. Rims are its boundary curves: rim 0 is the outer
/// one, rim i + 1 that of hole i. Sides are numbered within their rim, in the order of
/// [`Outline::loops`](crate::Outline::loops).
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("expected {}, found {}", self.expected(), self.found())]
pub enum OutlineFault {
    /// A rim has no sides.
    Empty {
        /// Index of the rim.
        rim: usize,
    },
    /// A side has a coordinate that is not finite, or a radius that is not positive.
    Unbounded {
        /// Index of the rim.
        rim: usize,
        /// Index of the side within its rim.
        side: usize,
    },
    /// A side has no length.
    Pointlike {
        /// Index of the rim.
        rim: usize,
        /// Index of the side within its rim.
        side: usize,
        /// Where the side is, in metres.
        at: Point,
    },
    /// A side does not start where the previous side ends.
    Open {
        /// Index of the rim.
        rim: usize,
        /// Index of the side within its rim.
        side: usize,
        /// Where the previous side ends, in metres.
        end: Point,
        /// Where this side starts, in metres.
        start: Point,
    },
    /// Two sides touch, cross or run back over each other.
    Meeting {
        /// Indices of the rims of the two sides, the smaller first.
        rims: [usize; 2],
        /// Indices of the two sides, each within its rim.
        sides: [usize; 2],
        /// Where the two sides meet, in metres.
        at: Point,
    },
    /// A rim encloses no area.
    Flat {
        /// Index of the rim.
        rim: usize,
        /// The area that the rim encloses, in m².
        area: f64,
        /// Where the rim starts, in metres.
        at: Point,
    },
    /// The sides of a rim are listed clockwise instead of anticlockwise.
    Clockwise {
        /// Index of the rim.
        rim: usize,
        /// Where the rim starts, in metres.
        at: Point,
    },
    /// A hole lies outside the outer rim.
    Outside {
        /// Index of the rim.
        rim: usize,
        /// Where the rim of the hole starts, in metres.
        at: Point,
    },
    /// A hole lies within another hole.
    Nested {
        /// Index of the rim of the inner hole.
        rim: usize,
        /// Index of the rim of the hole around it.
        within: usize,
        /// Where the rim of the inner hole starts, in metres.
        at: Point,
    },
    /// Sides lie along each other in so many places that the check was given up.
    TooMany,
}

impl OutlineFault {
    /// What a valid outline would have instead, in words for people: the part of the error message after
    /// "expected".
    pub fn expected(&self) -> &'static str {
        match self {
            Self::Empty { .. } => "rims of at least one side",
            Self::Unbounded { .. } => "finite coordinates and positive radii",
            Self::Pointlike { .. } => "sides that have a length",
            Self::Open { .. } => "sides that meet end to end",
            Self::Meeting { .. } | Self::TooMany => {
                "rims that neither cross nor touch themselves or each other"
            }
            Self::Flat { .. } => "rims that enclose an area",
            Self::Clockwise { .. } => "sides listed anticlockwise",
            Self::Outside { .. } | Self::Nested { .. } => "holes within the sheet, none within another",
        }
    }

    /// What was found and where, in words for people: the part of the error message after "found".
    pub fn found(&self) -> String {
        match self {
            Self::Empty { rim } => format!("{} without sides", name(*rim)),
            Self::Unbounded { rim, side } => format!("side {side} of {} without them", name(*rim)),
            Self::Pointlike { rim, at, .. } => format!("a side without length of {} at {at}", name(*rim)),
            Self::Open { rim, end, start, .. } => {
                format!("a side that ends at {end} before one that starts at {start}, on {}", name(*rim))
            }
            Self::Meeting { rims: [one, other], at, .. } => match (one, other) {
                (0, 0) => format!("an outer rim that meets itself at {at}"),
                (0, _) => format!("a hole that meets the outer rim at {at}"),
                (one, other) if one == other => format!("a hole whose rim meets itself at {at}"),
                _ => format!("holes that meet at {at}"),
            },
            Self::Flat { rim, area, at } => format!("{} through {at} of {:e} mm²", name(*rim), area * 1e6),
            Self::Clockwise { rim, at } => format!("{} through {at} that runs clockwise", name(*rim)),
            Self::Outside { at, .. } => format!("a hole through {at}, outside the outer rim"),
            Self::Nested { at, .. } => format!("a hole through {at}, within another"),
            Self::TooMany => "sides that lie along each other in too many places to compare".to_owned(),
        }
    }

    /// Index of the rim at fault; if two rims meet, the larger of their indices. `None` for
    /// [`OutlineFault::TooMany`], which concerns all rims.
    pub fn rim(&self) -> Option<usize> {
        match *self {
            Self::Empty { rim }
            | Self::Unbounded { rim, .. }
            | Self::Pointlike { rim, .. }
            | Self::Open { rim, .. }
            | Self::Flat { rim, .. }
            | Self::Clockwise { rim, .. }
            | Self::Outside { rim, .. }
            | Self::Nested { rim, .. } => Some(rim),
            Self::Meeting { rims: [_, later], .. } => Some(later),
            Self::TooMany => None,
        }
    }
}

fn name(rim: usize) -> &'static str {
    if rim == 0 { "an outer rim" } else { "a hole" }
}
