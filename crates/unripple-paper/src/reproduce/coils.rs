//! Effect of moving-magnet coils on the focus: added mass and damping.

use super::section::{row, three};
use super::{Compared, PaperSetup, Section};
use crate::study::{Coiled, Coils, Credibility, coils, credibility};
use serde_json::json;
use unripple::core::CoilDrive;
use unripple::physics::Medium;
use unripple_tasks::TaskError;

/// Radius of the contact between magnet and film, in metres: half the diameter of the light magnet.
const CONTACT: f64 = 0.75e-3;

/// Diameter and thickness of a magnet so light that it hardly changes the motion of the film, in metres.
const MAGNET: [f64; 2] = [1.5e-3, 0.5e-3];

/// Mass of that magnet, in kg: about its volume times 7500 kg/m³, the density of neodymium magnets.
const MAGNET_MASS: f64 = 7e-6;

/// Frequency at which the impedance of the film is compared with the damping by the coil, in Hz.
const HZ: f64 = 1000.0;

/// Makes the part of the page on section 4 about real coils, driven by a current or by a voltage.
pub fn section(setup: &PaperSetup) -> Result<Section, TaskError> {
    let kinds = kinds();
    let parts: Vec<Coils> = kinds.iter().map(|(_, coils)| *coils).collect();
    let rows = coils(&setup.surface, &parts, CONTACT, (setup.target, setup.window))?;
    let numbers = judged(setup);
    let named = || kinds.iter().map(|(name, _)| *name).zip(&rows);
    let data = named().map(|(name, r)| {
        json!({
            "coils": name,
            "decay_time_s": r.decay_time_s,
            "contrast": r.contrast,
            "peak_velocity_m_s": r.peak_velocity_m_s,
        })
    });
    Ok(Section {
        title: "Section 4: coils".into(),
        text: vec![text(&rows), doubt(&numbers)],
        compared: compared(&numbers),
        data: json!({ "rows": data.collect::<Vec<_>>() }),
        table: table(named()),
        ..Section::default()
    })
}

/// Numbers that show whether the printed force constant is possible.
pub(super) fn judged(setup: &PaperSetup) -> Credibility {
    credibility(&Coils::papers(CoilDrive::Voltage), MAGNET, &Medium::of(&setup.surface.sheet), HZ)
}

fn kinds() -> Vec<(&'static str, Coils)> {
    let [current, voltage] = [CoilDrive::Current, CoilDrive::Voltage].map(Coils::papers);
    let weak = |coils: Coils| Coils { force_constant: 0.6, ..coils };
    let light = |coils: Coils| Coils { moving_mass: MAGNET_MASS, ..coils };
    vec![
        ("ideal forces", Coils { moving_mass: 0.0, driven_by: None, ..current }),
        ("6 N/A, current, 100 mg", current),
        ("6 N/A, voltage, 100 mg", voltage),
        ("0.6 N/A, voltage, 100 mg", weak(voltage)),
        ("6 N/A, current, 7 mg", light(current)),
        ("0.6 N/A, voltage, 7 mg", light(weak(voltage))),
    ]
}

fn text(rows: &[Coiled]) -> String {
    let at = |i: usize| rows.get(i).copied();
    let tau = |i: usize| at(i).map_or(f64::NAN, |r| r.decay_time_s * 1e3);
    let contrast = |i: usize| at(i).map_or(f64::NAN, |r| r.contrast);
    let peak = |i: usize| at(i).map_or(f64::NAN, |r| r.peak_velocity_m_s);
    format!(
        "A magnet that rides on the film loads it by its mass and, where the amplifier holds the voltage, by the current that \
         its motion induces: a damper of (bl)²/R. The moving mass matters most. With 100 mg on each of eight places (the paper \
         prints no mass) and current drive, the film rings as long as before ({:.0} ms) but the contrast falls from {:.1} to \
         {:.1}, and the focal velocity for a force of 1 N at rest from {:.0} to {:.0} m/s, since above a few hundred hertz the \
         inertia of the magnets takes nearly all of the force; 7 mg leave a contrast of {:.1}. Voltage drive damps: 6 N/A and \
         100 mg give a median decay time of {:.0} ms, a peak of {:.1} m/s and a contrast of {:.1}: the response to a drive \
         that works mostly against the damper is nearly flat over the band. 0.6 N/A and 7 mg are a good match for this film: \
         {:.0} ms, {:.1}, and {:.0} m/s. All levels are far past linear theory and scale down together.",
        tau(1),
        contrast(0),
        contrast(1),
        peak(0),
        peak(1),
        contrast(4),
        tau(2),
        peak(2),
        contrast(2),
        tau(5),
        contrast(5),
        peak(5),
    )
}

/// Text on whether a force constant of 6 N/A agrees with the other values.
fn doubt(c: &Credibility) -> String {
    format!(
        "The printed force constant of 6 N/A is hard to reconcile with actuators that drive a film. With voltage drive it \
         would be a damper of {} N·s/m, where the mechanical impedance of the film at a point is {} N·s/m at {HZ:.0} Hz: eight \
         of them would hold the film nearly still at eight places and reflect what arrives there. In a field of half a good \
         magnet's remanence, 6 N/A takes {:.0} m of wire, {:.0} g of copper at 6.2 Ω. And 1.9 mH at the size of a magnet of \
         {:.1} mm makes some {:.0} turns, which reach about {} N/A with it. This rests on a model of coil and magnet, not on \
         the paper alone; a misplaced decimal point (0.6 N/A), or a force per volt or per ampere of all coils in series, would \
         fit the rest of the paper.",
        three(c.coil_damping),
        three(c.sheet_resistance),
        c.wire_length_m,
        c.copper_kg * 1e3,
        MAGNET[0] * 1e3,
        c.turns,
        three(c.reachable),
    )
}

fn compared(c: &Credibility) -> Vec<Compared> {
    vec![Compared::new(
        "force constant of a coil",
        "6 N/A",
        format!("about {} N/A within reach of such a coil and magnet", three(c.reachable)),
        "turns from the inductance, the magnet's moment times the largest gradient of the coil's field",
    )]
}

fn table<'a>(rows: impl Iterator<Item = (&'a str, &'a Coiled)>) -> Vec<Vec<String>> {
    let headings = row(["coils", "median decay time ms", "contrast", "focal velocity for 1 N at rest m/s"]);
    let cells = |(name, r): (&str, &Coiled)| {
        vec![
            name.to_owned(),
            format!("{:.1}", r.decay_time_s * 1e3),
            format!("{:.1}", r.contrast),
            three(r.peak_velocity_m_s),
        ]
    };
    std::iter::once(headings).chain(rows.map(cells)).collect()
}
