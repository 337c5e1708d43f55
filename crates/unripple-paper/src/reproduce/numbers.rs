//! Numbers in the paper's text, computed again: first mode, wavelength, phase velocity.

use super::section::row;
use super::{Compared, PaperSetup, Section};
use serde_json::json;
use std::f64::consts::TAU;
use unripple::core::{Air, Surface};
use unripple::physics::design::{Nature, PaperFigures};
use unripple::physics::{Design, Medium, Modes, design};
use unripple_tasks::TaskError;

/// Frequency below which the first mode is searched for, in Hz.
const LOW: f64 = 300.0;
/// Relative accuracy of the first mode, far below the digits that the paper prints.
const ACCURACY: f64 = 1e-6;
/// The tension that the paper prints, in N/m.
const PRINTED_TENSION: f64 = 30.0;

/// Makes the part of the page on section 4 with the numbers printed for the paper's membrane, and remarks
/// on its text.
pub fn section(setup: &PaperSetup) -> Result<Section, TaskError> {
    let surface = &setup.surface;
    let design = design(surface).map_err(TaskError::input)?;
    let missing = || TaskError::Work("the bed: expected the paper's film, found another surface".into());
    let paper = design.paper.as_ref().ok_or_else(missing)?;
    let firsts = [Air::None, Air::OneSide, Air::BothSides].map(|air| {
        let mut aired = surface.clone();
        aired.sheet.air = air;
        first_mode(&aired)
    });
    let [vacuum, one, both] = firsts;
    let firsts = [vacuum?, one?, both?];
    let mut compared = waves(surface, &design, paper);
    compared.extend(modes(surface, &design, paper, firsts));
    Ok(Section {
        title: "Section 4: the numbers of the membrane".into(),
        text: vec![
            format!(
                "The paper's film with {:.0} N/m. What is printed beside it, and what follows from the sheet's data.",
                surface.sheet.tension
            ),
            "Remarks on the text tell apart misprints and slips of arithmetic, which can be shown from the paper alone, and \
             differences of model, assumption or convention, in which the paper need not be wrong."
                .into(),
        ],
        compared,
        table: remarks(paper),
        data: json!({ "design": design, "first_mode_hz": { "vacuum": firsts[0], "air_one_side": firsts[1], "air_both_sides": firsts[2] } }),
        ..Section::default()
    })
}

fn first_mode(surface: &Surface) -> Result<f64, TaskError> {
    let modes = Modes::solve(surface, LOW, ACCURACY).map_err(TaskError::input)?;
    let first = modes.frequencies_hz().first().copied();
    first.ok_or_else(|| TaskError::Work(format!("no mode below {LOW} Hz")))
}

fn waves(surface: &Surface, design: &Design, paper: &PaperFigures) -> Vec<Compared> {
    let medium = Medium::of(&surface.sheet);
    let wavelength = paper.table1.first().map_or(0.0, |touch| touch.wavelength_m);
    let hz = medium.omega(TAU / wavelength) / TAU;
    let slack = Medium { tension: PRINTED_TENSION, ..medium };
    vec![
        Compared::new(
            "tension",
            format!("{PRINTED_TENSION:.0} N/m"),
            format!("{:.0} N/m", surface.sheet.tension),
            format!(
                "a misprint: {PRINTED_TENSION:.0} N/m would make long waves run at {:.1} m/s, not at the velocity printed beside it; \
                 as a force, {PRINTED_TENSION:.0} N on a side of 150 mm is 200 N/m",
                slack.phase_celerity(0.0)
            ),
        ),
        Compared::new(
            "phase velocity of long waves",
            "34 m/s",
            format!("{:.2} m/s", design.celerity_min_m_s),
            "agrees: √(R/ρ_s)",
        ),
        Compared::new(
            format!("phase velocity at {:.0} mm", wavelength * 1e3),
            "43 m/s",
            format!("{:.2} m/s", paper.celerity_at_15mm_m_s),
            format!("agrees; at the top of the band it is {:.2} m/s", design.celerity_max_m_s),
        ),
        Compared::new(
            format!("frequency at {:.0} mm", wavelength * 1e3),
            "3 kHz",
            format!("{:.3} kHz", hz / 1e3),
            format!("rounded; 3 kHz is a wave of {:.2} mm", medium.lambda_min(3e3) * 1e3),
        ),
    ]
}

fn modes(
    surface: &Surface,
    design: &Design,
    paper: &PaperFigures,
    [vacuum, one, both]: [f64; 3],
) -> Vec<Compared> {
    let k = TAU / design.lambda_min_m;
    // The two terms of Weyl's law for a membrane, S k²/4π and P k/4π.
    let inside = surface.outline.area() * k * k / (2.0 * TAU);
    let edge = surface.outline.perimeter() * k / (2.0 * TAU);
    let exact = design.mode_count_exact.map_or("-".into(), |count| format!("{count}"));
    vec![
        Compared::new(
            "first mode",
            "150 Hz",
            format!("{vacuum:.1} Hz"),
            format!(
                "the air that moves along lowers it: {one:.1} Hz with air on one side, {both:.1} Hz on both, as if the film \
                 were infinite"
            ),
        ),
        Compared::new(
            format!("modes below {:.0} Hz", design.band_hz[1]),
            format!("+Pf/2c, which gives {:.0}", inside + edge),
            format!("{exact} counted, {:.0} with -Pf/2c", inside - edge),
            "another assumption: the sign + is that of free edges, and the paper's sheet is glued to a frame",
        ),
        Compared::new(
            "window T",
            "30 ms",
            format!("{:.1} ms", paper.window_s * 1e3),
            format!(
                "arithmetic: the paper's formula with its own values does not give 30 ms (see the remarks); nine tenths of the largest \
                 contrast take {:.1} ms",
                design.window_recommended_s * 1e3
            ),
        ),
        Compared::new(
            "decay time",
            "about 70 ms",
            format!("{:.0} ms", design.decay_time_s * 1e3),
            "taken from the paper",
        ),
    ]
}

/// Table of all remarks on the paper's text, misprints first.
fn remarks(paper: &PaperFigures) -> Vec<Vec<String>> {
    let foci = line(
        "names of the foci",
        Nature::Misprint,
        "D and E in the caption of Fig. 4, E and F in the text, with the rates exchanged",
        "the two contradict each other; the caption is followed here: E at 5 Hz, D at 2 Hz",
    );
    let of = |nature: Nature| {
        let remarks = paper.remarks.iter().filter(move |r| r.nature == nature);
        remarks.map(|r| line(&r.topic, r.nature, &r.printed, &r.remark))
    };
    let headings = row(["remark on", "nature", "printed", "remark"]);
    std::iter::once(headings).chain(of(Nature::Misprint)).chain([foci]).chain(of(Nature::Model)).collect()
}

fn line(topic: &str, nature: Nature, printed: &str, remark: &str) -> Vec<String> {
    row([topic, nature.name(), printed, remark])
}
