//! Report of the task `reproduce`.

use super::{Compared, Picture, Predicted, Section};
use serde::Serialize;
use serde_json::Value;
use std::fmt::Write;

pub use super::section::{Compared as ComparedReport, Predicted as PredictedReport};

/// Report of `reproduce`: the paper's results beside the computed ones.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Number of random placements of actuators and targets over which statistics of contrast are averaged.
    pub placements: usize,
    /// Sections of the page, one for each figure, table or section of the paper, in the paper's order.
    pub sections: Vec<SectionReport>,
}

/// One section of the page.
#[derive(Clone, Debug, Serialize)]
pub struct SectionReport {
    /// Part of the paper that the section is about.
    pub title: String,
    /// Paragraphs of the section's text.
    pub text: Vec<String>,
    /// Numbers of the paper beside the computed ones.
    pub compared: Vec<Compared>,
    /// Computed numbers for which the paper has none.
    pub predicted: Vec<Predicted>,
    /// A table of computed results, as rows of cells; headings first.
    pub table: Vec<Vec<String>>,
    /// Figures of the section.
    pub figures: Vec<FigureReport>,
    /// Numbers of the section as JSON, in SI units; `null` if there are none.
    pub data: Value,
}

/// A figure of the page.
#[derive(Clone, Debug, Serialize)]
pub struct FigureReport {
    /// File names of the figure: SVG, then PNG.
    pub files: Vec<String>,
    /// Caption of the figure.
    pub caption: String,
    /// Description of the figure for readers who cannot see it.
    pub description: String,
}

impl FigureReport {
    fn of(picture: &Picture) -> Self {
        Self {
            files: picture.files(),
            caption: picture.caption.clone(),
            description: picture.alternative().to_owned(),
        }
    }
}

impl Report {
    /// The report of all sections.
    pub(super) fn of(sections: &[Section], placements: usize) -> Self {
        let section = |section: &Section| SectionReport {
            title: section.title.clone(),
            text: section.text.clone(),
            compared: section.compared.clone(),
            predicted: section.predicted.clone(),
            table: section.table.clone(),
            figures: section.figures.iter().map(FigureReport::of).collect(),
            data: section.data.clone(),
        };
        Self { placements, sections: sections.iter().map(section).collect() }
    }
}

impl unripple_tasks::Report for Report {
    fn text(&self) -> String {
        let mut text = String::new();
        for section in &self.sections {
            let _ = writeln!(text, "{}", section.title);
            for Compared { what, paper, here, .. } in &section.compared {
                let _ = writeln!(text, "  {what}: paper {paper}, here {here}");
            }
            for Predicted { what, here, .. } in &section.predicted {
                let _ = writeln!(text, "  {what}: {here} (predicted; the paper has no figure)");
            }
        }
        text
    }
}
