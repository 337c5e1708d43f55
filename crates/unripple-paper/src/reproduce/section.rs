//! A section of the page: a figure, table or section of the paper beside the computed one.

use unripple_plot::Figure;

/// A section of the page: a figure, table or section of the paper beside the computed one.
#[derive(Debug, Default)]
pub struct Section {
    /// Part of the paper that the section is about, as in `Fig. 2b`.
    pub title: String,
    /// Figures, each written as NAME.svg and NAME.png, with captions.
    pub figures: Vec<Picture>,
    /// Numbers of the paper beside the computed ones.
    pub compared: Vec<Compared>,
    /// Computed numbers for which the paper has none.
    pub predicted: Vec<Predicted>,
    /// A table of computed results, as rows of cells; headings first.
    pub table: Vec<Vec<String>>,
    /// Paragraphs of the section's text.
    pub text: Vec<String>,
    /// Numbers of the section as JSON, in SI units; `null` if there are none.
    pub data: serde_json::Value,
}

/// A figure of the page.
#[derive(Debug)]
pub struct Picture {
    /// File name of the figure without ending.
    pub name: &'static str,
    /// The figure itself.
    pub figure: Figure,
    /// Caption of the figure.
    pub caption: String,
}

impl Picture {
    /// A figure with its file name (without ending) and caption.
    pub fn still(name: &'static str, figure: Figure, caption: impl Into<String>) -> Self {
        Self { name, figure, caption: caption.into() }
    }

    /// Description of the figure for readers who cannot see it.
    pub fn alternative(&self) -> &str {
        let described = !self.figure.description.is_empty();
        if described { &self.figure.description } else { &self.caption }
    }

    /// File names of the figure: SVG, then PNG.
    pub fn files(&self) -> Vec<String> {
        ["svg", "png"].map(|ending| format!("{}.{ending}", self.name)).to_vec()
    }
}

/// A quantity in the paper and as computed here.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Compared {
    /// Name of the quantity.
    pub what: String,
    /// Value in the paper.
    pub paper: String,
    /// Value that this program computes.
    pub here: String,
    /// Why the paper's value and the computed one differ, or that they agree.
    pub why: String,
}

impl Compared {
    /// One row: the quantity, the paper's value, the computed one, and why they differ.
    pub fn new(
        what: impl Into<String>,
        paper: impl Into<String>,
        here: impl Into<String>,
        why: impl Into<String>,
    ) -> Self {
        Self { what: what.into(), paper: paper.into(), here: here.into(), why: why.into() }
    }
}

/// A computed quantity for which the paper has no number.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Predicted {
    /// Name of the quantity.
    pub what: String,
    /// Value that this program computes.
    pub here: String,
    /// How the value comes about, or what to compare it with.
    pub why: String,
}

impl Predicted {
    /// One row: the quantity, the computed value, and how it comes about.
    pub fn new(what: impl Into<String>, here: impl Into<String>, why: impl Into<String>) -> Self {
        Self { what: what.into(), here: here.into(), why: why.into() }
    }
}

/// A row of a table from its cells.
pub fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

/// A number with three significant digits, as text.
pub fn three(value: f64) -> String {
    let places = (2.0 - value.abs().log10().floor()).clamp(0.0, 9.0) as usize;
    format!("{value:.places$}")
}
