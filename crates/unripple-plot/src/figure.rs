//! Panels in a grid, their frames aligned.

use crate::canvas::{Canvas, Rect, Text};
use crate::drawing::Drawing;
use crate::placed::Placed;
use crate::prepared::{Margins, Prepared};
use crate::style::{Style, points};
use crate::{Panel, PlotError};

/// A figure: panels in a grid, filled row by row, their frames aligned.
///
/// # Example
/// ```
/// use unripple_plot::{Figure, Line, Plot};
/// let line = |y: [f64; 2]| Line { x: vec![0.0, 1.0], y: y.to_vec(), ..Line::default() };
/// let rising = Plot { layers: vec![line([0.0, 1.0]).into()], ..Plot::default() };
/// let falling = Plot { layers: vec![line([1.0, 0.0]).into()], ..Plot::default() };
/// let figure = Figure { columns: 2, panels: vec![rising.into(), falling.into()], ..Figure::default() };
/// let png = figure.draw()?.png(300.0)?;
/// assert_eq!(&png[1..4], b"PNG");
/// # Ok::<(), unripple_plot::PlotError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Width of the figure in millimetres: 85 fills one column of a journal, 178 two.
    pub width_mm: f64,
    /// Number of panels side by side.
    pub columns: usize,
    /// The panels, filled in row by row.
    pub panels: Vec<Panel>,
    /// Whether panels are lettered (a), (b), … when there are several.
    pub letters: bool,
    /// What the figure shows, for readers who cannot see it; kept in the SVG's title.
    pub description: String,
    /// Sizes of text and lines.
    pub style: Style,
}

impl Default for Figure {
    fn default() -> Self {
        Self {
            width_mm: 85.0,
            columns: 1,
            panels: Vec::new(),
            letters: true,
            description: String::new(),
            style: Style::default(),
        }
    }
}

/// Space round a figure, in points, so that no line is cut at the edge of the page.
const EDGE: f64 = 2.0;
/// Space between columns and between rows, in points. Less, and labels of neighbours touch.
const BETWEEN: f64 = 9.0;

impl Figure {
    /// A figure of one panel at single-column width.
    pub fn of(panel: impl Into<Panel>) -> Self {
        Self { panels: vec![panel.into()], ..Self::default() }
    }

    /// Draws the figure.
    ///
    /// Errors when there is no panel, when a panel has nothing finite to show or lengths that disagree, and when a
    /// value or an option is outside its range.
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        self.check()?;
        let columns = self.columns.clamp(1, self.panels.len());
        let width = points(self.width_mm);
        let cell = (width - 2.0 * EDGE - (columns - 1) as f64 * BETWEEN) / columns as f64;
        let prepared = self
            .panels
            .iter()
            .map(|panel| panel.prepare(cell, &self.style))
            .collect::<Result<Vec<_>, _>>()?;
        let margins = self.margins(&prepared, columns);
        let mut canvas = Canvas::default();
        let mut placed: Vec<Placed> = Vec::with_capacity(prepared.len());
        let mut y = EDGE;
        for (row, panels) in prepared.chunks(columns).enumerate() {
            let margins = &margins[row * columns..][..panels.len()];
            let frame_width = |m: &Margins| (cell - m.left - m.right).max(10.0);
            let height =
                panels.iter().zip(margins).map(|(p, m)| p.height(frame_width(m))).fold(0.0, f64::max);
            for (column, (panel, m)) in panels.iter().zip(margins).enumerate() {
                let x = EDGE + column as f64 * (cell + BETWEEN);
                let width = frame_width(m);
                let frame = Rect { x: x + m.left, y: y + m.top, width, height: panel.height(width) };
                placed.push(panel.draw(&mut canvas, frame)?);
                self.letter(&mut canvas, row * columns + column, [x, y + 0.85 * self.style.label_pt]);
            }
            let [top, bottom] = margins.first().map_or([0.0; 2], |m| [m.top, m.bottom]);
            y += top + height + bottom + BETWEEN;
        }
        let height = y - BETWEEN + EDGE;
        let svg = canvas.finish(width, height, &self.description);
        Ok(Drawing::new(svg, [width, height], &self.description, placed, canvas.labels))
    }

    fn check(&self) -> Result<(), PlotError> {
        if self.panels.is_empty() {
            return Err(PlotError::Empty { what: "figure".to_owned(), found: "no panels".to_owned() });
        }
        let range = |what: &str, expected, found: f64, low: f64, high: f64| {
            if (low..=high).contains(&found) {
                return Ok(());
            }
            Err(PlotError::Range { what: what.to_owned(), expected, found })
        };
        range("width of the figure", "20 to 1000 mm", self.width_mm, 20.0, 1000.0)?;
        for size in [self.style.label_pt, self.style.tick_pt] {
            range("size of text", "2 to 72 pt", size, 2.0, 72.0)?;
        }
        for size in [self.style.line_pt, self.style.axis_pt] {
            range("width of lines", "0.05 to 10 pt", size, 0.05, 10.0)?;
        }
        Ok(())
    }

    fn lettered(&self) -> bool {
        self.letters && self.panels.len() > 1
    }

    /// Margins of every panel: frames of a column share their left, frames of a row their top and bottom, and all
    /// are equally wide.
    fn margins(&self, prepared: &[Box<dyn Prepared + '_>], columns: usize) -> Vec<Margins> {
        let mut margins: Vec<Margins> = prepared.iter().map(|panel| panel.margins()).collect();
        let own = margins.clone();
        let most = |of: fn(&Margins) -> f64, share: &dyn Fn(usize) -> bool| {
            own.iter().enumerate().filter(|(i, _)| share(*i)).map(|(_, m)| of(m)).fold(0.0, f64::max)
        };
        let letter = if self.lettered() { 1.25 * self.style.label_pt } else { 0.0 };
        for (i, margin) in margins.iter_mut().enumerate() {
            let column = |other: usize| {
                let both = prepared[i].aligned() && prepared[other].aligned();
                other == i || (both && other % columns == i % columns)
            };
            let row = |other: usize| other / columns == i / columns;
            *margin = Margins {
                left: most(|m| m.left, &column),
                right: most(|m| m.right, &column),
                top: most(|m| m.top, &row).max(letter),
                bottom: most(|m| m.bottom, &row),
            };
        }
        let widest = margins.iter().map(|m| m.left + m.right).fold(0.0, f64::max);
        margins.iter_mut().for_each(|m| m.right = widest - m.left);
        margins
    }

    fn letter(&self, canvas: &mut Canvas, index: usize, at: [f64; 2]) {
        if self.lettered() {
            let letter = (b'a' + (index % 26) as u8) as char;
            canvas.text(Text::new(&format!("({letter})"), at, self.style.label_pt));
        }
    }
}
