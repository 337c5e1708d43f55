//! Figures of a drive and of its evaluated field.

mod columns;
mod drive;
mod maps;
mod movie;
mod traces;
mod when;

pub use columns::Columns;
pub use drive::channels;
pub use maps::{Scene, drawn, felt, peaks, snapshots};
pub use movie::{MOST_FRAMES, check_animation, movie};
pub use traces::traces;
pub use when::When;

use crate::TaskError;
use unripple_plot::{Figure, PRINT_DPI, pngs};
use unripple_store::OutputDir;

/// Draws named figures, and returns the name and SVG text of each.
///
/// # Errors
/// [`TaskError::Work`] of a figure that cannot be drawn.
pub fn svgs(figures: &[(&str, Figure)]) -> Result<Vec<(String, String)>, TaskError> {
    figures.iter().map(|(name, figure)| Ok(((*name).to_owned(), figure.draw()?.svg().to_owned()))).collect()
}

/// Writes each figure as NAME.svg, NAME.pdf and NAME.png, and its data as NAME.csv (NAME-a.csv and so on
/// for several panels); returns the file names.
pub fn write(out: &OutputDir, figures: &[(&str, Figure)]) -> Result<Vec<String>, TaskError> {
    let drawings = figures.iter().map(|(_, figure)| figure.draw()).collect::<Result<Vec<_>, _>>()?;
    let pictures = pngs(&drawings, PRINT_DPI)?;
    let mut names = Vec::new();
    for (((name, figure), drawing), picture) in figures.iter().zip(&drawings).zip(&pictures) {
        let page = drawing.pdf()?;
        let files =
            [("svg", drawing.svg().as_bytes()), ("pdf", page.as_slice()), ("png", picture.as_slice())];
        for (ending, bytes) in files {
            let file = format!("{name}.{ending}");
            out.write(&file, bytes)?;
            names.push(file);
        }
        let tables = figure.tables();
        for (letter, table) in ('a'..='z').zip(&tables) {
            let file = if tables.len() > 1 { format!("{name}-{letter}.csv") } else { format!("{name}.csv") };
            out.write(&file, table.as_bytes())?;
            names.push(file);
        }
    }
    Ok(names)
}
