//! Table 1: power to move a fingertip by 10 µm through glass and film.

use super::section::{row, three};
use super::{Compared, PaperSetup, Section};
use std::f64::consts::TAU;
use unripple::core::Finger;
use unripple::physics::design::{Touch, glass_strip, table1};
use unripple_tasks::TaskError;

/// Displacement of the finger in the paper, in metres.
const DISPLACEMENT: f64 = 10e-6;

/// Makes the part of the page on table 1: the power that moves a fingertip by 10 µm, through glass and
/// through film.
pub fn section(_: &PaperSetup) -> Result<Section, TaskError> {
    let touches = table1();
    let data = serde_json::to_value(&touches).map_err(TaskError::work)?;
    Ok(Section {
        title: "Table 1: power to move a fingertip".into(),
        text: text(&touches),
        compared: touches.iter().filter_map(power).chain(ratio(&touches)).collect(),
        table: table(&touches),
        data,
        ..Section::default()
    })
}

fn power(touch: &Touch) -> Option<Compared> {
    let printed = touch.printed_power_w?;
    let share = 100.0 * (touch.power_w / printed - 1.0);
    Some(Compared::new(
        format!("power for 10 µm, {}", touch.strip),
        format!("{printed} W"),
        format!("{} W", three(touch.power_w)),
        format!("{share:+.1} %: the paper rounds; the formula (eq. 4) and its inputs are the same"),
    ))
}

fn ratio(touches: &[Touch]) -> Option<Compared> {
    let [glass, film] = touches else { return None };
    let printed = glass.printed_power_w? / film.printed_power_w?;
    Some(Compared::new(
        "glass over film",
        format!("{printed:.0}"),
        format!("{:.0}", glass.power_w / film.power_w),
        same_frequency(film),
    ))
}

/// Text on the power that glass takes at the film's frequency instead of at the film's wavelength.
fn same_frequency(film: &Touch) -> String {
    let (glass, hz) = (glass_strip(), film.frequency_hz);
    let power = glass.power(&Finger::default(), glass.wavenumber(hz), DISPLACEMENT);
    format!(
        "it is for the same wavelength, hence the same resolution, that the film takes less; at {hz:.0} Hz the glass would take \
         {power:.2} W, on a wave of {:.0} mm",
        TAU / glass.wavenumber(hz) * 1e3
    )
}

fn table(touches: &[Touch]) -> Vec<Vec<String>> {
    let headings =
        row(["strip", "c (m/s)", "f (Hz)", "|Z_S| (N·s/m)", "|Z_F| (N·s/m)", "P (W)", "taken by the finger"]);
    let cells = |t: &Touch| {
        vec![
            t.strip.clone(),
            format!("{:.1}", t.celerity_m_s),
            format!("{:.0}", t.frequency_hz),
            three(t.impedance_n_s_per_m),
            three(t.finger_impedance_n_s_per_m),
            three(t.power_w),
            format!("{:.2} %", 100.0 * t.absorbed_power),
        ]
    };
    std::iter::once(headings).chain(touches.iter().map(cells)).collect()
}

fn text(touches: &[Touch]) -> Vec<String> {
    let finger = Finger::default();
    let first = touches.first().map_or(0.0, |t| t.wavelength_m * 1e3);
    vec![
        format!(
            "A strip as wide as the contact carries waves of {first:.0} mm to a finger of {} g, {} N·s/m and {} N/mm \
             (equations 3 to 5). The power is the crest of the incident wave's, as the paper has it; its mean over a period is half.",
            finger.mass * 1e3,
            finger.damping,
            finger.stiffness / 1e3
        ),
        "The two rows are at the same wavelength and so at very different frequencies: that is what a given resolution \
         costs in each medium."
            .into(),
    ]
}
