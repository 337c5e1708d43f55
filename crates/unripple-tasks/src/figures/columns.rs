//! Width of figures: that of each kind of figure, or that of one or two columns of a printed page.

use crate::TaskError;
use unripple_plot::Figure;

/// Widths of one and of two columns of a printed page, in mm: 3 3/8 and 7 inches, as in the journals of the
/// American Physical Society.
const ONE_MM: f64 = 86.0;
const TWO_MM: f64 = 178.0;

/// Width of figures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Columns {
    /// Each kind of figure has its own default width.
    #[default]
    Own,
    /// Figures are as wide as one column of a page, with panels one above the other.
    One,
    /// Figures are as wide as two columns of a page.
    Two,
}

impl Columns {
    /// The width of figures from the field `columns` of a request: 1 or 2 columns, or `None` for the
    /// default.
    ///
    /// # Errors
    /// [`TaskError::Ask`] of another number.
    pub fn of(asked: Option<usize>) -> Result<Self, TaskError> {
        match asked {
            None => Ok(Self::Own),
            Some(1) => Ok(Self::One),
            Some(2) => Ok(Self::Two),
            Some(other) => Err(TaskError::ask("columns", "1 or 2", other)),
        }
    }

    /// Resizes named figures to this width; sizes of text stay as they are.
    pub fn fit(self, figures: Vec<(&str, Figure)>) -> Vec<(&str, Figure)> {
        let wide = |figure: Figure| match self {
            Self::Own => figure,
            Self::One => Figure { width_mm: ONE_MM, columns: 1, ..figure },
            Self::Two => Figure { width_mm: TWO_MM, ..figure },
        };
        figures.into_iter().map(|(name, figure)| (name, wide(figure))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_is_as_wide_as_was_asked_for() {
        let own = Figure { width_mm: 120.0, columns: 2, ..Figure::default() };
        let fitted = |asked| {
            let figures = Columns::of(asked).unwrap().fit(vec![("traces", own.clone())]);
            (figures[0].0, figures[0].1.width_mm, figures[0].1.columns)
        };
        assert_eq!(fitted(None), ("traces", 120.0, 2));
        assert_eq!(fitted(Some(1)), ("traces", 86.0, 1));
        assert_eq!(fitted(Some(2)), ("traces", 178.0, 2));
        let refused = Columns::of(Some(3)).unwrap_err();
        assert_eq!(refused.to_string(), "columns: expected 1 or 2, found 3");
    }
}
