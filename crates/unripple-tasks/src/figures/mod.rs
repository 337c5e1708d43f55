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

/// Writes the [`files`] of figures; returns their names.
///
/// # Errors
/// Those of [`files`] and of writing.
pub fn write(out: &OutputDir, figures: &[(&str, Figure)]) -> Result<Vec<String>, TaskError> {
    let mut names = Vec::new();
    for (name, bytes) in files(figures)? {
        out.write(&name, &bytes)?;
        names.push(name);
    }
    Ok(names)
}

/// Each figure as NAME.svg, NAME.pdf and NAME.png, and its data as NAME.csv (NAME-a.csv and so on for several panels): names and bytes of the
/// files.
///
/// # Errors
/// [`TaskError::Work`] of a figure that cannot be drawn.
pub fn files(figures: &[(&str, Figure)]) -> Result<Vec<(String, Vec<u8>)>, TaskError> {
    let drawings = figures.iter().map(|(_, figure)| figure.draw()).collect::<Result<Vec<_>, _>>()?;
    let pictures = pngs(&drawings, PRINT_DPI)?;
    let mut files = Vec::new();
    for (((name, figure), drawing), picture) in figures.iter().zip(&drawings).zip(pictures) {
        files.push((format!("{name}.svg"), drawing.svg().as_bytes().to_vec()));
        files.push((format!("{name}.pdf"), drawing.pdf()?));
        files.push((format!("{name}.png"), picture));
        let tables = figure.tables();
        let several = tables.len() > 1;
        for (letter, table) in ('a'..='z').zip(tables) {
            let file = if several { format!("{name}-{letter}.csv") } else { format!("{name}.csv") };
            files.push((file, table.into_bytes()));
        }
    }
    Ok(files)
}
