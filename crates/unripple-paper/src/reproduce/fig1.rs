//! Fig. 1 of the paper: record, crop, reverse, refocus.

mod panels;
mod recording;
mod refocus;

use self::recording::Recording;
use self::refocus::{C, Refocus};
use super::fields::first;
use super::modes::{FORCE, actuator, closed_contrast, modal};
use super::places::named;
use super::section::{Compared, Picture, Predicted, Section};
use super::setup::PaperSetup;
use serde_json::json;
use unripple::core::{ModalResponses, Port};
use unripple::field::{Aim, Field};
use unripple::focus::{Options, Target, focus};
use unripple_plot::{Marker, Symbol};
use unripple_tasks::TaskError;
use unripple_tasks::figures::Scene;
use unripple_tasks::judge::CELLS;

/// Index of the actuator that takes the place of B in the paper's figure.
const ACTUATOR: usize = 0;

/// Makes the part of the page on Fig. 1: records, crops, reverses and refocuses with one actuator, and
/// compares the contrast with that of all actuators.
pub fn section(setup: &PaperSetup) -> Result<Section, TaskError> {
    let modal = modal(&setup.responses)?;
    let b = actuator(modal, ACTUATOR)?;
    let recording = Recording::make(setup, modal, b.at)?;
    let refocus = Refocus::make(setup, modal, &b, &recording)?;
    let all = contrast_of_all(setup)?;
    let scene = scene(setup, &b);
    let figures = vec![
        Picture::still("fig1a", recording.figure(setup, &scene), recording.caption(setup, &b)),
        Picture::still("fig1b", refocus.figure(setup, &scene), refocus.caption(setup, &b)),
    ];
    Ok(Section {
        title: "Fig. 1: record, crop, reverse, refocus".into(),
        figures,
        compared: compared(setup, modal, &recording, &refocus, all),
        predicted: vec![Predicted::new(
            "contrast with one actuator",
            format!("{:.1}", refocus.figures.contrast.unwrap_or(f64::NAN)),
            format!("closed form, a mean over places: {}", form(setup, modal, 1)),
        )],
        data: json!({
            "reciprocity_mismatch": refocus.mismatch,
            "peak_of_equation_2": refocus.figures.peak_velocity_m_s / refocus.predicted,
            "one_actuator": refocus.figures,
            "contrast_all_actuators": all,
        }),
        text: vec![format!(
            "The steps of the paper's Fig. 1, on its film: a blow at A is recorded at B, one of the eight actuators, and the \
             first {:.0} ms of the recording are played backwards from B alone. Nothing but that recording goes into the \
             drive; the field it makes is computed from the drive, mode by mode. The force peaks at {:.0} mN; the displacement \
             at A then reaches {:.1} µm, the film being {:.0} µm thick.",
            setup.window * 1e3,
            FORCE * 1e3,
            refocus.figures.peak_displacement_m.abs() * 1e6,
            setup.surface.sheet.thickness * 1e6
        )],
        table: Vec::new(),
    })
}

/// The film with B, C and the focal disc of A, which is named beside its disc so that the focus stays visible.
fn scene(setup: &PaperSetup, b: &Port) -> Scene {
    let mut surface = setup.surface.clone();
    surface.actuators.clear();
    let radius = setup.responses.conditions().focal_radius();
    let mut scene = Scene::new(&surface, &[], 0.0);
    let [x, y] = [setup.target.x, setup.target.y];
    scene.markers.extend([
        Marker { at: [b.at.x, b.at.y], symbol: Symbol::Actuator, name: "B".into() },
        Marker { at: [x, y], symbol: Symbol::Circle(radius), name: String::new() },
        Marker { at: [x + radius, y], symbol: Symbol::Circle(0.0), name: "A".into() },
        named(C, "C"),
    ]);
    scene
}

/// Contrast at A with every actuator.
fn contrast_of_all(setup: &PaperSetup) -> Result<f64, TaskError> {
    let options = Options { window: setup.window, limit: FORCE, ..Options::default() };
    let focused = focus(&setup.responses, &[Target::at(setup.target)], &options).map_err(TaskError::work)?;
    let drive = focused.drive.as_emitted();
    let field = Field::new(&setup.responses, &drive, CELLS).map_err(TaskError::work)?;
    let measured = field.measure(&[Aim::at(setup.target, setup.window)], None).map_err(TaskError::work)?;
    Ok(first(measured.targets)?.contrast.unwrap_or(f64::NAN))
}

/// Contrast by the closed form with `actuators` actuators, as text.
fn form(setup: &PaperSetup, modal: &ModalResponses, actuators: usize) -> String {
    closed_contrast(setup, modal, actuators).map_or("-".into(), |contrast| format!("{contrast:.1}"))
}

fn compared(
    setup: &PaperSetup,
    modal: &ModalResponses,
    recording: &Recording,
    refocus: &Refocus,
    all: f64,
) -> Vec<Compared> {
    let count = modal.ports.len();
    let one = refocus.figures.contrast.unwrap_or(f64::NAN);
    let [_, noise_a, noise_c] = refocus.levels(setup);
    vec![
        Compared::new(
            "h_AB against h_BA",
            "equal, by reciprocity",
            format!("apart by {:.1e} of the peak at most", refocus.mismatch),
            format!(
                "the recording of a blow at A, reversed, against the drive made from the responses to B, to an accuracy of {:.0e}; any sum \
                 of modes is reciprocal, so this is a check of the program rather than of the film",
                Options::default().accuracy
            ),
        ),
        Compared::new(
            "v_A(T) (equation 2)",
            "∫h_AB² over T",
            format!(
                "{:.6} of that sum over the recording",
                refocus.figures.peak_velocity_m_s / refocus.predicted
            ),
            format!(
                "measured from the field that the drive makes, at A, {} samples after its start",
                recording.cropped(setup).len() - 1
            ),
        ),
        Compared::new(
            format!("contrast with {count} actuators"),
            "∝ √N",
            format!("{all:.1}, {:.2} times that with one", all / one),
            format!(
                "closed form: {}; √N would be {:.2} times, with one actuator as good as another and a window too short to tell modes apart",
                form(setup, modal, count),
                (count as f64).sqrt()
            ),
        ),
        Compared::new(
            "noise at A and at C",
            "the same background",
            format!("rms at A {:.2} of that at C", noise_a / noise_c),
            "two places and one drive only",
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_actuator_refocuses_as_theory_says() {
        let setup = PaperSetup::new().unwrap();
        let data = section(&setup).unwrap().data;
        let number = |name: &str| data[name].as_f64().unwrap();
        assert!(number("reciprocity_mismatch") < 1e-6);
        assert!((number("peak_of_equation_2") - 1.0).abs() < 1e-6);
        let modal = modal(&setup.responses).unwrap();
        let one = data["one_actuator"]["contrast"].as_f64().unwrap();
        for (found, actuators) in [(one, 1), (number("contrast_all_actuators"), modal.ports.len())] {
            let expected = closed_contrast(&setup, modal, actuators).unwrap();
            assert!((found / expected - 1.0).abs() < 0.25, "{actuators}: {found} against {expected}");
        }
    }
}
