//! `unripple reproduce`: the paper's table and figures beside ours, as one page.

mod bed;
mod cavities;
mod coils;
mod contrast;
mod fig1;
mod fig2;
mod fig3;
mod fig4;
mod finger;
mod levels;
mod numbers;
mod page;
mod repetition;
mod section;
mod table1;

pub use bed::Bed;
pub use section::{Compared, Picture, Section};

use crate::args::ReproduceOptions;
use crate::error::CliError;
use crate::focus::finish;
use crate::{figures, output};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};
use unripple_store::OutputDir;

/// Fewest placements whose mean has a spread.
const FEWEST: usize = 2;

pub fn run(options: &ReproduceOptions, as_json: bool) -> Result<(), CliError> {
    let placements = options.placements;
    if placements < FEWEST {
        return Err(CliError::Input(format!("--placements: expected at least {FEWEST}, found {placements}")));
    }
    let out = OutputDir::create(&options.output)?;
    let sections = sections(placements)?;
    let report = report(&sections, placements);
    let pages = [
        ("index.html", page::html(&sections)),
        ("reproduce.md", page::markdown(&sections)),
        ("reproduce.json", output::json(&report)?),
    ];
    for (name, text) in &pages {
        out.write(name, text.as_bytes())?;
    }
    let pictures = sections.into_iter().flat_map(|section| section.figures);
    let drawn: Vec<_> = pictures.map(|picture| (picture.name, picture.figure)).collect();
    figures::write(&out, &drawn)?;
    finish(out)?;
    output::answer(as_json, &report, &summary(&report))
}

/// Makes one section.
type Maker = fn(&Bed, usize) -> Result<Section, CliError>;

/// Every section in the paper's order.
fn sections(placements: usize) -> Result<Vec<Section>, CliError> {
    let makers: [(&str, Maker); 13] = [
        ("Fig. 1", |bed, _| fig1::section(bed)),
        ("Fig. 2a", |bed, _| fig2::one_actuator(bed)),
        ("Fig. 2b", |bed, _| fig2::triangle(bed)),
        ("section 2", cavities::section),
        ("section 3.1", contrast::section),
        ("section 3.2", repetition::section),
        ("Fig. 3", |bed, _| fig3::section(bed)),
        ("Table 1", |bed, _| table1::section(bed)),
        ("section 4", |bed, _| numbers::section(bed)),
        ("finger", |bed, _| finger::section(bed)),
        ("coils", |bed, _| coils::section(bed)),
        ("Fig. 4", |bed, _| fig4::section(bed)),
        ("40 µm and 200 µm", |bed, _| levels::section(bed)),
    ];
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}").map_err(CliError::work)?;
    let progress = ProgressBar::new(makers.len() as u64).with_style(style);
    progress.set_message("modes of the surface");
    let bed = Bed::new()?;
    let make = |(name, maker): (&'static str, Maker)| {
        progress.set_message(name);
        let section = maker(&bed, placements);
        progress.inc(1);
        section
    };
    let sections = makers.into_iter().map(make).collect();
    progress.finish_and_clear();
    sections
}

/// The page for programs.
fn report(sections: &[Section], placements: usize) -> Value {
    let picture = |picture: &Picture| json!({ "files": picture.files(), "caption": picture.caption, "description": picture.alternative() });
    let section = |section: &Section| {
        json!({
            "title": section.title,
            "text": section.text,
            "compared": section.compared,
            "table": section.table,
            "figures": section.figures.iter().map(picture).collect::<Vec<_>>(),
            "data": section.data,
        })
    };
    json!({
        "placements": placements,
        "sections": sections.iter().map(section).collect::<Vec<_>>(),
    })
}

/// Every comparison as a line, for people.
fn summary(report: &Value) -> String {
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let mut lines = Vec::new();
    for section in list(&report["sections"]) {
        lines.push(text(&section["title"]));
        for row in list(&section["compared"]) {
            let [what, paper, here] = ["what", "paper", "here"].map(|key| text(&row[key]));
            lines.push(format!("  {what}: paper {paper}, here {here}"));
        }
    }
    lines.join("\n")
}
