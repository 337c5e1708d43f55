//! Fig. 3 of the paper: reflection and power against frequency for film and glass.

use super::{Compared, PaperSetup, Picture, Predicted, Section};
use serde_json::json;
use std::f64::consts::TAU;
use unripple::core::Finger;
use unripple::physics::design::{Scattering, Strip, film_strip, glass_strip, table1};
use unripple_plot::{Axis, Dash, Figure, Ink, Layer, Line, Plot, Rule};
use unripple_tasks::TaskError;

/// Lowest and highest frequency shown, in Hz: four decades that include the band of touch.
const RANGE: [f64; 2] = [10.0, 1e5];
/// Number of points of a curve, a hundred for each decade.
const STEPS: usize = 400;
/// Displacement of the finger in table 1, in metres.
const DISPLACEMENT: f64 = 10e-6;

/// Makes the part of the page on Fig. 3: reflection and absorption of a wave that meets a finger.
pub fn section(setup: &PaperSetup) -> Result<Section, TaskError> {
    let finger = Finger::default();
    let strips = [("glass 1 mm", glass_strip()), ("BoPET 0.125 mm, 2 N", film_strip())];
    let marks: Vec<f64> = table1().iter().map(|touch| touch.frequency_hz).collect();
    let swept = strips.map(|(_, strip)| sweep(&strip, &finger));
    let panels = strips
        .iter()
        .zip(&swept)
        .zip(&marks)
        .map(|(((name, _), rows), mark)| shares(name, rows, *mark).into());
    let scattering = Figure {
        width_mm: 178.0,
        columns: 2,
        panels: panels.collect(),
        description: "Amplitude of the reflected and of the transmitted wave over the incident one, and share of its power \
                      that the finger takes, against frequency, for the two strips of table 1"
            .into(),
        ..Figure::default()
    };
    Ok(Section {
        title: "Fig. 3: a wave meets a finger".into(),
        text: text(&swept),
        figures: vec![
            Picture::still(
                "fig3-scattering",
                scattering,
                "What becomes of a wave at the finger, on a strip of glass (a) and of film (b). The vertical line is \
                 where the wavelength is 15 mm, as in table 1.",
            ),
            Picture::still(
                "fig3-power",
                power(&strips, &marks, &finger),
                "Power of the incident wave that moves the finger by 10 µm (equation 4). The circles are table 1.",
            ),
        ],
        compared: compared(setup, &strips.map(|(_, strip)| strip), &finger),
        predicted: vec![most_taken(&strips[1].1, &finger)],
        data: json!({ "glass": every(&swept[0]), "film": every(&swept[1]) }),
        ..Section::default()
    })
}

fn frequencies() -> impl Iterator<Item = f64> {
    let [low, high] = RANGE;
    (0..=STEPS).map(move |i| low * (high / low).powf(i as f64 / STEPS as f64))
}

fn sweep(strip: &Strip, finger: &Finger) -> Vec<Scattering> {
    frequencies().map(|hz| strip.scattering(finger, hz)).collect()
}

/// Every tenth row: enough to redraw the curves from.
fn every(rows: &[Scattering]) -> Vec<&Scattering> {
    rows.iter().step_by(10).collect()
}

fn shares(name: &str, rows: &[Scattering], mark: f64) -> Plot {
    let curve = |label: &str, pick: fn(&Scattering) -> f64| -> Layer {
        Line {
            x: rows.iter().map(|s| s.frequency_hz).collect(),
            y: rows.iter().map(pick).collect(),
            label: label.into(),
            ..Line::default()
        }
        .into()
    };
    Plot {
        x: Axis::log("Frequency (Hz)"),
        y: Axis::new("Ratio to the incident wave").from(0.0).to(1.05),
        layers: vec![
            Rule { at: mark, label: "15 mm".into(), ..Rule::default() }.into(),
            curve("reflected, |Aᵣ/Aᵢ|", |s| s.reflection),
            curve("transmitted, |Aₜ/Aᵢ|", |s| s.transmission),
            curve("power taken by the finger", |s| s.absorbed_power),
        ],
        title: name.into(),
        ..Plot::default()
    }
}

fn power(strips: &[(&str, Strip)], marks: &[f64], finger: &Finger) -> Figure {
    let mut layers: Vec<Layer> = Vec::new();
    let needed = |strip: &Strip, hz: f64| strip.power(finger, strip.wavenumber(hz), DISPLACEMENT);
    for (i, ((name, strip), mark)) in strips.iter().zip(marks).enumerate() {
        let ink = Ink::Palette(i);
        let dash = if i == 0 { Dash::Dashed } else { Dash::Solid };
        let x: Vec<f64> = frequencies().collect();
        let y = x.iter().map(|hz| needed(strip, *hz)).collect();
        layers.push(Line { x, y, label: (*name).into(), ink, dash, ..Line::default() }.into());
        let point = unripple_plot::Points {
            x: vec![*mark],
            y: vec![needed(strip, *mark)],
            ink,
            mark: unripple_plot::Mark::Ring,
            ..unripple_plot::Points::default()
        };
        layers.push(point.into());
    }
    Figure {
        description:
            "Power of the incident wave that moves the finger by 10 µm, against frequency, for glass and film"
                .into(),
        ..Figure::of(Plot {
            x: Axis::log("Frequency (Hz)"),
            y: Axis::log("Incident power (W)"),
            layers,
            ..Plot::default()
        })
    }
}

fn compared(setup: &PaperSetup, [glass, film]: &[Strip; 2], finger: &Finger) -> Vec<Compared> {
    let resonance = resonance(finger);
    let top = setup.surface.emission.band[1];
    let muffled = |hz: f64| 1.0 / film.scattering(finger, hz).transmission;
    let impedance = |strip: &Strip, hz: f64| strip.impedance(strip.wavenumber(hz));
    vec![
        Compared::new(
            "reflected wave",
            "A_R e^{j(ωt - kx)}",
            "A_R e^{j(ωt + kx)}",
            "a misprint: the reflected wave travels back, and equation 3 follows with this sign only",
        ),
        Compared::new(
            "impedance for least muffling",
            "Z_S larger than Z_F",
            format!("film: {:.3} against {:.0} N·s/m and more", impedance(film, top), finger.damping),
            format!(
                "the film of section 4 does not meet this condition; glass at {top:.0} Hz has {:.1} N·s/m",
                impedance(glass, top)
            ),
        ),
        Compared::new(
            "impedance for most power",
            "Z_F = Z_S",
            "Z_F = 2 Z_S",
            "Z_F = Z_S is the match of a load at the end of a strip; here, by equation 3, waves leave the contact on both sides: \
             the finger sees twice the strip's impedance, and takes half the power at best",
        ),
        Compared::new(
            "attenuation by a finger on the film",
            "5",
            format!("{:.0} at {resonance:.0} Hz, {:.0} at {top:.0} Hz", muffled(resonance), muffled(top)),
            "a strip lets no wave pass round the finger, a membrane does",
        ),
    ]
}

/// Resonance of the finger's mass on its spring, in Hz.
fn resonance(finger: &Finger) -> f64 {
    (finger.stiffness / finger.mass).sqrt() / TAU
}

fn most_taken(film: &Strip, finger: &Finger) -> Predicted {
    let best = frequencies().map(|hz| film.scattering(finger, hz)).fold(None, larger);
    Predicted::new(
        "most power the finger takes from the film",
        best.map_or("-".into(), |s| format!("{:.0} % at {:.0} Hz", 100.0 * s.absorbed_power, s.frequency_hz)),
        format!("near the finger's resonance, {:.0} Hz, where mass and spring cancel", resonance(finger)),
    )
}

fn larger(best: Option<Scattering>, s: Scattering) -> Option<Scattering> {
    Some(best.filter(|best| best.absorbed_power >= s.absorbed_power).unwrap_or(s))
}

fn text([glass, film]: &[Vec<Scattering>; 2]) -> Vec<String> {
    let most = |rows: &[Scattering]| rows.iter().map(|s| s.transmission).fold(0.0, f64::max);
    vec![
        "The paper draws the model only: a strip as wide as the contact, a finger of mass, spring and damper at x = 0. \
         These are its consequences, equation 3, for both strips of table 1."
            .into(),
        format!(
            "A finger is a spring below its resonance and a mass above it. It holds the film nearly still at every frequency: \
             at most {:.2} of the amplitude is transmitted. Of a wave in glass up to {:.2} is. At the same frequency glass \
             takes less power than the film to move a finger; it loses at the same wavelength, which is what resolution asks \
             for.",
            most(film),
            most(glass)
        ),
    ]
}
