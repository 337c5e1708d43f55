//! Section 4.3: effect of a finger on the focus and the background.

use super::section::row;
use super::{Compared, PaperSetup, Picture, Predicted, Section};
use crate::study::{Touched, finger};
use serde_json::json;
use unripple_plot::{Along, Axis, Figure, Ink, Layer, Line, Mark, Plot, Points, Rule};
use unripple_tasks::TaskError;

/// Radii of the contact, in metres: those of a light to a firm touch of a fingertip.
const RADII: [f64; 6] = [3e-3, 4e-3, 5e-3, 6e-3, 7e-3, 8e-3];

/// Attenuation by a finger that the paper measured (section 4.3), for focus and noise alike.
const PAPERS: f64 = 5.0;

/// Makes the part of the page on section 4 about a finger: its effect on the focus under it and on the
/// noise, against the size of the contact.
pub fn section(setup: &PaperSetup) -> Result<Section, TaskError> {
    let rows = finger(&setup.surface, setup.target, &RADII, setup.window)?;
    let (unaware, aware): (Vec<&Touched>, Vec<&Touched>) = rows.iter().partition(|r| !r.known);
    Ok(Section {
        title: "Section 4: the finger".into(),
        text: vec![text(&unaware)],
        figures: vec![Picture::still(
            "finger",
            figure(&unaware, &aware),
            "Attenuation by a finger of 0.2 g, 1 N·s/m and 1 N/mm against the radius of its contact: (a) of the focus under it, in \
             velocity and displacement, with the drive made without the finger (discs) and with it (squares); (b) of the noise \
             under the finger and elsewhere. Motion under the finger is the mean over its contact, with and without it. Line: \
             the paper's 5.",
        )],
        compared: compared(&unaware),
        predicted: vec![Predicted::new(
            "noise elsewhere attenuated",
            span(&unaware, |r| r.noise_elsewhere),
            "a finger takes a little of the energy",
        )],
        table: table(&rows),
        data: json!({ "rows": rows.iter().map(data).collect::<Vec<_>>() }),
    })
}

fn data(r: &Touched) -> serde_json::Value {
    json!({
        "contact_radius_m": r.contact_radius_m,
        "finger_known": r.known,
        "focus_velocity_attenuation": r.focus_velocity,
        "focus_displacement_attenuation": r.focus_displacement,
        "noise_under_finger_attenuation": r.noise_under_finger,
        "noise_elsewhere_attenuation": r.noise_elsewhere,
        "finger_energy_j": r.finger_energy_j,
        "drive_energy_j": r.drive_energy_j,
    })
}

type Pick = fn(&Touched) -> f64;

fn figure(unaware: &[&Touched], aware: &[&Touched]) -> Figure {
    let series = |rows: &[&Touched], pick: Pick, label: &str, ink: Ink, mark: Mark| -> [Layer; 2] {
        let x: Vec<f64> = rows.iter().map(|r| r.contact_radius_m).collect();
        let y: Vec<f64> = rows.iter().map(|r| pick(r)).collect();
        let line = Line { x: x.clone(), y: y.clone(), ink, label: label.into(), ..Line::default() };
        [line.into(), Points { x, y, label: label.into(), ink, mark, ..Points::default() }.into()]
    };
    let panel = |layers: Vec<[Layer; 2]>| {
        let rule = Rule { at: PAPERS, label: "paper".into(), along: Along::X, ..Rule::default() };
        Plot {
            x: Axis::new("Radius of the contact (mm)").times(1e3),
            y: Axis::new("Attenuation").from(0.0),
            layers: std::iter::once(rule.into()).chain(layers.into_iter().flatten()).collect(),
            ..Plot::default()
        }
    };
    let focus = panel(vec![
        series(unaware, |r| r.focus_velocity, "velocity", Ink::Palette(0), Mark::Disc),
        series(unaware, |r| r.focus_displacement, "displacement", Ink::Palette(1), Mark::Disc),
        series(aware, |r| r.focus_velocity, "velocity, finger known", Ink::Palette(2), Mark::Square),
    ]);
    let noise = panel(vec![
        series(unaware, |r| r.noise_under_finger, "under the finger", Ink::Palette(0), Mark::Disc),
        series(unaware, |r| r.noise_elsewhere, "elsewhere", Ink::Palette(3), Mark::Disc),
    ]);
    Figure {
        width_mm: 178.0,
        columns: 2,
        panels: vec![focus.into(), noise.into()],
        description: "Attenuation of focus and noise by a finger, falling or rising with the radius of its contact, beside the \
                      paper's factor of five"
            .into(),
        ..Figure::default()
    }
}

fn span(rows: &[&Touched], pick: Pick) -> String {
    let (low, high) =
        rows.iter().map(|r| pick(r)).fold((f64::MAX, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
    format!("{low:.1} to {high:.1}")
}

fn text(rows: &[&Touched]) -> String {
    let share = rows.iter().map(|r| r.finger_energy_j / r.drive_energy_j).fold(0.0, f64::max);
    format!(
        "The finger is the paper's: a mass, a damper and a spring to the ground, moving with the mean of the sheet over its \
         contact, coupled both ways. Its impedance at 1 to 3 kHz is ten times the film's own under such a contact, so that it \
         nearly holds the film still: the focus is {} times slower and {} times lower with it than without, for contacts of 3 \
         to 8 mm radius, and the noise under it {} times. Focus and noise are attenuated alike, as the paper found: the ratio \
         of the two, of the intended to the unintended motion, survives the touch. That the paper's factor is smaller may be \
         where it looked: within the contact the sheet bulges, and at its centre it moves more than on the mean. A drive made \
         with the finger known gains the more the smaller the contact. At most {:.0} % of the energy driven into the film \
         stays in the finger.",
        span(rows, |r| r.focus_velocity),
        span(rows, |r| r.focus_displacement),
        span(rows, |r| r.noise_under_finger),
        100.0 * share
    )
}

fn compared(rows: &[&Touched]) -> Vec<Compared> {
    let why = "lumped finger, contacts of 3 to 8 mm radius, motion averaged over the contact";
    vec![
        Compared::new("focus attenuated by a finger, velocity", "5", span(rows, |r| r.focus_velocity), why),
        Compared::new("the same, displacement", "5", span(rows, |r| r.focus_displacement), why),
        Compared::new("noise under the finger attenuated", "5", span(rows, |r| r.noise_under_finger), why),
    ]
}

fn table(rows: &[Touched]) -> Vec<Vec<String>> {
    let headings = row([
        "contact radius mm",
        "drive made",
        "focus, velocity",
        "focus, displacement",
        "noise under finger",
        "noise elsewhere",
        "energy in the finger µJ",
    ]);
    let cells = |r: &Touched| {
        vec![
            format!("{:.0}", r.contact_radius_m * 1e3),
            if r.known { "with the finger" } else { "without" }.to_owned(),
            format!("{:.1}", r.focus_velocity),
            format!("{:.1}", r.focus_displacement),
            format!("{:.1}", r.noise_under_finger),
            format!("{:.2}", r.noise_elsewhere),
            format!("{:.1}", r.finger_energy_j * 1e6),
        ]
    };
    std::iter::once(headings).chain(rows.iter().map(cells)).collect()
}
