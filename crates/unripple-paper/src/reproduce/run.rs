//! Runs `reproduce`: the paper's experiments one after the other.

use super::{
    Ask, PaperSetup, Report, Section, cavities, coils, contrast, fig1, fig2, fig3, fig4, finger, levels,
    numbers, page, repetition, table1,
};
use unripple_tasks::{Progress, TaskError, figures, folder, go_on};

/// Least number of placements: the mean of a single one has no standard error.
const FEWEST: usize = 2;

/// Largest number of placements: their standard errors are 22 times below those of the default. Twice as many take hours more.
const MOST: usize = 10_000;

/// Computes the paper's figures, table and numbers again, and writes them as one page if the request names
/// a folder.
///
/// # Errors
/// [`TaskError::Ask`] for fewer than two placements or more than 10 000; those of writing the folder; [`TaskError::Cancelled`];
/// [`TaskError::Work`] where a simulation fails.
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    if ask.placements < FEWEST {
        return Err(TaskError::ask("placements", format!("at least {FEWEST}"), ask.placements));
    }
    if ask.placements > MOST {
        return Err(TaskError::ask("placements", format!("at most {MOST}"), ask.placements));
    }
    let out = folder::begin(ask.output.as_deref(), ask)?;
    let sections = sections(ask.placements, progress)?;
    let report = Report::of(&sections, ask.placements);
    if let Some((out, record)) = out {
        let pages = [
            ("index.html", page::html(&sections)),
            ("reproduce.md", page::markdown(&sections)),
            ("reproduce.json", record.json(&report)?),
        ];
        for (name, text) in &pages {
            out.write(name, text.as_bytes())?;
        }
        let pictures = sections.into_iter().flat_map(|section| section.figures);
        let drawn: Vec<_> = pictures.map(|picture| (picture.name, picture.figure)).collect();
        figures::write(&out, &drawn)?;
        folder::finish(out, progress)?;
    }
    Ok(report)
}

/// Function that makes one section from the paper's surface and the number of placements.
type Maker = fn(&PaperSetup, usize) -> Result<Section, TaskError>;

/// Every section in the paper's order.
fn sections(placements: usize, progress: &mut dyn Progress) -> Result<Vec<Section>, TaskError> {
    let makers: [(&str, Maker); 13] = [
        ("Fig. 1", |setup, _| fig1::section(setup)),
        ("Fig. 2a", |setup, _| fig2::one_actuator(setup)),
        ("Fig. 2b", |setup, _| fig2::triangle(setup)),
        ("section 2", cavities::section),
        ("section 3.1", contrast::section),
        ("section 3.2", repetition::section),
        ("Fig. 3", |setup, _| fig3::section(setup)),
        ("Table 1", |setup, _| table1::section(setup)),
        ("section 4", |setup, _| numbers::section(setup)),
        ("finger", |setup, _| finger::section(setup)),
        ("coils", |setup, _| coils::section(setup)),
        ("Fig. 4", |setup, _| fig4::section(setup)),
        ("40 µm and 200 µm", |setup, _| levels::section(setup)),
    ];
    go_on(progress)?;
    progress.stage("modes of the surface");
    let setup = PaperSetup::new()?;
    let mut sections = Vec::new();
    for (done, (name, maker)) in makers.iter().enumerate() {
        go_on(progress)?;
        progress.stage(name);
        progress.done(done as f64 / makers.len() as f64);
        sections.push(maker(&setup, placements)?);
    }
    Ok(sections)
}
