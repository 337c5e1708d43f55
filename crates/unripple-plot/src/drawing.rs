//! A finished figure, as SVG, PDF and PNG.

use crate::colour::Rgb;
use crate::label::Label;
use crate::placed::Placed;
use crate::{PlotError, encode};
use rayon::prelude::*;

/// A finished figure: SVG text, and the picture rendered from that same text.
#[derive(Clone, Debug)]
pub struct Drawing {
    svg: String,
    size: [f64; 2],
    description: String,
    placed: Vec<Placed>,
    labels: Vec<Label>,
}

/// Resolution for print, in dots per inch. At half of it thin lines show steps; twice as many make files four times
/// as large.
pub const PRINT_DPI: f64 = 300.0;

/// Largest number of pixels in a picture, so that a slip in its size cannot take all memory.
const MOST_PIXELS: f64 = 1e8;

impl Drawing {
    pub(crate) fn new(
        svg: String,
        size: [f64; 2],
        description: &str,
        placed: Vec<Placed>,
        labels: Vec<Label>,
    ) -> Self {
        Self { svg, size, description: description.to_owned(), placed, labels }
    }

    /// The SVG document.
    pub fn svg(&self) -> &str {
        &self.svg
    }

    /// Width and height in points of 1/72 inch.
    pub fn size_pt(&self) -> [f64; 2] {
        self.size
    }

    /// The picture on white as a PNG file, at a resolution of `dpi` dots per inch, from 20 to 2400.
    ///
    /// Deterministic: the typeface is embedded and no system font is looked at. Errors when the
    /// resolution is out of range or the picture would have more than 10⁸ pixels.
    pub fn png(&self, dpi: f64) -> Result<Vec<u8>, PlotError> {
        png(&self.svg, dpi)
    }

    /// The figure as a page of PDF, curves as curves and text as outlines, titled by the figure's description.
    ///
    /// Deterministic, as [`png`](Self::png). Errors when the drawing cannot be read back, which no figure should give.
    pub fn pdf(&self) -> Result<Vec<u8>, PlotError> {
        crate::pdf::page(&self.svg, self.size, &self.description)
    }

    /// Place of a datum of a panel in the picture, in pixels from its upper left corner, at a resolution in dots per
    /// inch.
    ///
    /// `panel` is the index of the panel; `at` is in the units of its data. Absent where there is no such panel or
    /// the data cannot be shown on its axes.
    pub fn pixel(&self, panel: usize, at: [f64; 2], dpi: f64) -> Option<[f64; 2]> {
        let [x, y] = self.placed.get(panel)?.point(at[0], at[1])?;
        Some([x * dpi / 72.0, y * dpi / 72.0])
    }

    /// Every line of text in the drawing, with the box that the layout keeps for it.
    pub fn labels(&self) -> &[Label] {
        &self.labels
    }

    /// Labels of the major ticks on a panel's abscissae and ordinates.
    pub fn tick_labels(&self, panel: usize) -> Option<[Vec<String>; 2]> {
        let placed = self.placed.get(panel)?;
        Some([&placed.x, &placed.y].map(|ruler| ruler.major.iter().map(|(_, label)| label.clone()).collect()))
    }
}

/// The picture of an SVG document on white as a PNG file, at a resolution of `dpi` dots per inch, from 20 to
/// 2400, with the embedded typeface.
///
/// ```
/// let square = r#"<svg xmlns="http://www.w3.org/2000/svg" width="10mm" height="10mm"/>"#;
/// assert_eq!(&unripple_plot::png(square, 100.0)?[1..4], b"PNG");
/// # Ok::<(), unripple_plot::PlotError>(())
/// ```
///
/// # Errors
/// [`PlotError::Range`] of another resolution, and of more than 10⁸ pixels; [`PlotError::Image`] of what is no SVG.
pub fn png(svg: &str, dpi: f64) -> Result<Vec<u8>, PlotError> {
    if !(20.0..=2400.0).contains(&dpi) {
        let what = "resolution of the picture".to_owned();
        return Err(PlotError::Range { what, expected: "20 to 2400 dots to an inch", found: dpi });
    }
    let tree = encode::tree(svg)?;
    // CSS has 96 pixels to an inch.
    let scale = dpi / 96.0;
    let pixels = f64::from(tree.size().width()) * f64::from(tree.size().height()) * scale * scale;
    if pixels > MOST_PIXELS {
        let what = "pixels of the picture".to_owned();
        return Err(PlotError::Range { what, expected: "at most 10⁸", found: pixels });
    }
    encode::opaque(&encode::rendered(&tree, scale as f32, Some(Rgb::WHITE))?, dpi)
}

/// Pictures of several drawings, rendered in parallel; see [`Drawing::png`]. `dpi` is in dots to an inch.
pub fn pngs(drawings: &[Drawing], dpi: f64) -> Result<Vec<Vec<u8>>, PlotError> {
    drawings.par_iter().map(|drawing| drawing.png(dpi)).collect()
}
