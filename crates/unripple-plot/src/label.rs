//! The box that a line of text takes up in a drawing.

use crate::font;

/// A line of text in a drawing, and the box that it takes up.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The text that is written.
    pub text: String,
    /// Upper left corner of its box, in points from the upper left corner of the drawing.
    pub upper_left: [f64; 2],
    /// Lower right corner of its box, in points from the upper left corner of the drawing.
    pub lower_right: [f64; 2],
}

impl Label {
    /// The box of a text of `size` points that reads rightwards or upwards. The place, in points, is on its baseline, a share `before` of
    /// its width after its start.
    pub(crate) fn of(text: &str, [x, y]: [f64; 2], before: f64, size: f64, upwards: bool) -> Self {
        let wide = font::width(text, size);
        let (before, after) = (before * wide, (1.0 - before) * wide);
        let [rise, fall] = [font::DIGIT_HEIGHT, font::DESCENT].map(|share| share * size);
        let (upper_left, lower_right) = match upwards {
            true => ([x - rise, y - after], [x + fall, y + before]),
            false => ([x - before, y - rise], [x + after, y + fall]),
        };
        Self { text: text.to_owned(), upper_left, lower_right }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_follow_the_direction_and_the_anchor() {
        let (size, at) = (10.0, [100.0, 50.0]);
        let wide = font::width("abc", size);
        let across = Label::of("abc", at, 0.0, size, false);
        assert_eq!((across.upper_left[0], across.lower_right[0]), (100.0, 100.0 + wide));
        assert!(across.upper_left[1] < 50.0 - 7.0 && across.lower_right[1] > 50.0);
        let up = Label::of("abc", at, 1.0, size, true);
        assert_eq!((up.upper_left[1], up.lower_right[1]), (50.0, 50.0 + wide));
        assert!(up.upper_left[0] < 100.0 - 7.0 && up.lower_right[0] > 100.0);
    }
}
