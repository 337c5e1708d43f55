//! Figures of a drive and its field, from measured data.

mod drive;
mod maps;
mod movie;
mod traces;

pub use drive::channels;
pub use maps::{Scene, drawn, felt, peaks, snapshots};
pub use movie::movie;
pub use traces::traces;

use crate::TaskError;
use unripple_plot::{Figure, PRINT_DPI, pngs};
use unripple_store::OutputDir;

/// Writes each figure as NAME.svg and NAME.png; returns the file names.
pub fn write(out: &OutputDir, figures: &[(&str, Figure)]) -> Result<Vec<String>, TaskError> {
    let drawings = figures.iter().map(|(_, figure)| figure.draw()).collect::<Result<Vec<_>, _>>()?;
    let pictures = pngs(&drawings, PRINT_DPI)?;
    let mut names = Vec::new();
    for (((name, _), drawing), picture) in figures.iter().zip(&drawings).zip(&pictures) {
        for (ending, bytes) in [("svg", drawing.svg().as_bytes()), ("png", picture.as_slice())] {
            let file = format!("{name}.{ending}");
            out.write(&file, bytes)?;
            names.push(file);
        }
    }
    Ok(names)
}
