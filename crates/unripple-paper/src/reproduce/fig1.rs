//! Fig. 1: record, crop, reverse, refocus.

mod refocus;

use self::refocus::Refocus;
use super::bed::Bed;
use super::section::{Compared, Picture, Section};
use serde_json::json;
use unripple::core::{Conditions, Decay, Drive, ModalResponses, Point, Port, Responses, window_samples};
use unripple::field::{self, Aim, Field, Snapshot, TargetFigures};
use unripple::focus::{Options, Target, focus};
use unripple::physics::design::closed;
use unripple_plot::{
    Axis, Colours, Figure, Ink, Legend, Line, Marker, Plot, Rule, Shot, Span, Strip, Symbol, prefixed,
};
use unripple_tasks::TaskError;
use unripple_tasks::figures::{Scene, drawn};
use unripple_tasks::judge::CELLS;

/// The impulse at A, in N·s. All is linear, so that it sets nothing but the scale of what is recorded.
const IMPULSE: f64 = 1e-6;

/// Index of the actuator that plays the part of B.
const ACTUATOR: usize = 0;

/// Largest force, in N: far below the film's limit, so that displacement stays below its thickness.
pub(super) const FORCE: f64 = 10e-3;

/// A point that is not aimed at, where the noise is read.
const C: Point = Point::new(0.110, 0.055);

/// How long is recorded, in windows T: the first is reversed, the rest shows how the motion dies away.
const RECORDED: f64 = 2.5;

/// Instants of the spreading wave, in seconds after the impulse.
const SPREADING: [f64; 6] = [0.3e-3, 0.7e-3, 1.2e-3, 2.0e-3, 6.0e-3, 30.0e-3];

/// Records, crops, reverses and refocuses with one actuator, and compares the contrast with that of all actuators.
pub fn section(bed: &Bed) -> Result<Section, TaskError> {
    let modal = modal(&bed.responses)?;
    let b = actuator(modal, ACTUATOR)?;
    let recording = Recording::make(bed, modal, b.at)?;
    let refocus = Refocus::make(bed, modal, &b, &recording)?;
    let all = contrast_of_all(bed)?;
    let scene = scene(bed, &b);
    let figures = vec![
        Picture::still("fig1a", recording.figure(bed, &scene), recording.caption(bed, &b)),
        Picture::still("fig1b", refocus.figure(bed, &scene), refocus.caption(bed, &b)),
    ];
    Ok(Section {
        title: "Fig. 1: record, crop, reverse, refocus".into(),
        figures,
        compared: compared(bed, modal, &recording, &refocus, all),
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
            bed.window * 1e3,
            FORCE * 1e3,
            refocus.figures.peak_displacement_m.abs() * 1e6,
            bed.surface.sheet.thickness * 1e6
        )],
        table: Vec::new(),
    })
}

/// The modal responses.
pub(super) fn modal(responses: &Responses) -> Result<&ModalResponses, TaskError> {
    match responses {
        Responses::Modal(modal) => Ok(modal),
        Responses::Sampled(_) => {
            Err(TaskError::Work("the paper's figures need modes, found sampled responses".into()))
        }
    }
}

/// One of the actuators.
pub(super) fn actuator(modal: &ModalResponses, index: usize) -> Result<Port, TaskError> {
    let missing = || {
        TaskError::Work(format!("actuators: expected at least {}, found {}", index + 1, modal.ports.len()))
    };
    modal.ports.get(index).cloned().ok_or_else(missing)
}

/// The same surface driven by one ideal point force: a mode takes in at a point what it gives out there.
pub(super) fn driven_at(modal: &ModalResponses, port: Port) -> Responses {
    let input = modal.shapes.at_all(&[port.at]);
    Responses::Modal(ModalResponses { ports: vec![port], input, ..modal.clone() })
}

/// The grid of a field made from modes.
pub(super) fn cells(field: &Field) -> Result<field::Grid, TaskError> {
    field.grid().cloned().ok_or_else(|| TaskError::Work("the field has no grid to draw".into()))
}

/// Largest magnitude of some values; 0 without any.
pub(super) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, x| m.max(x.abs()))
}

/// A named cross.
pub(super) fn named(at: Point, name: &str) -> Marker {
    Marker { at: [at.x, at.y], symbol: Symbol::Target, name: name.into() }
}

/// The film with B, C and the focal disc of A, which is named beside its disc so that the focus stays visible.
fn scene(bed: &Bed, b: &Port) -> Scene {
    let mut surface = bed.surface.clone();
    surface.actuators.clear();
    let radius = bed.responses.conditions().focal_radius();
    let mut scene = Scene::new(&surface, &[], 0.0);
    let [x, y] = [bed.target.x, bed.target.y];
    scene.markers.extend([
        Marker { at: [b.at.x, b.at.y], symbol: Symbol::Actuator, name: "B".into() },
        Marker { at: [x, y], symbol: Symbol::Circle(radius), name: String::new() },
        Marker { at: [x + radius, y], symbol: Symbol::Circle(0.0), name: "A".into() },
        named(C, "C"),
    ]);
    scene
}

/// Fields side by side, colours saturating at `high`.
fn strip(
    scene: &Scene,
    cells: &field::Grid,
    snapshots: &[Snapshot],
    high: f64,
    caption: impl Fn(f64) -> String,
) -> Strip {
    let (multiplier, unit) = prefixed(high, "m/s");
    let shot = |s: &Snapshot| Shot { grid: drawn(cells, &s.velocity), caption: caption(s.instant) };
    Strip {
        shots: snapshots.iter().map(shot).collect(),
        outline: scene.outline.clone(),
        markers: scene.markers.clone(),
        colours: Colours {
            title: format!("Velocity ({unit})"),
            multiplier,
            high: Some(high),
            ..Colours::default()
        },
        ..Strip::default()
    }
}

/// A curve of samples against time, with a height for a wide, low panel.
fn curve(values: &[f64], rate: f64, unit: &str, name: &str) -> Plot {
    let (multiplier, unit) = prefixed(largest(values), unit);
    let x = (0..values.len()).map(|i| i as f64 / rate).collect();
    let line = Line { x, y: values.to_vec(), ink: Ink::Palette(0), width_pt: Some(0.6), ..Line::default() };
    Plot {
        x: Axis::new("Time (ms)").times(1e3),
        y: Axis::new(format!("{name} ({unit})")).times(multiplier),
        layers: vec![line.into()],
        legend: Legend::None,
        height_mm: Some(24.0),
        ..Plot::default()
    }
}

/// The field of a blow at A, and its signal at B.
struct Recording {
    cells: field::Grid,
    shots: Vec<Snapshot>,
    at_b: Vec<f64>,
}

impl Recording {
    fn make(bed: &Bed, modal: &ModalResponses, b: Point) -> Result<Self, TaskError> {
        let name = "A";
        let struck = driven_at(modal, Port { name: name.into(), at: bed.target });
        let blow = Drive::new(bed.rate, vec![name.into()], vec![vec![IMPULSE * bed.rate]])
            .map_err(TaskError::work)?;
        let field = Field::new(&struck, &blow, CELLS).map_err(TaskError::work)?;
        let shots = field.snapshots(&SPREADING).map_err(TaskError::work)?;
        let traces = field.traces(&[b], RECORDED * bed.window).map_err(TaskError::work)?;
        let at_b = traces.into_iter().next().map(|trace| trace.velocity).unwrap_or_default();
        Ok(Self { cells: cells(&field)?, shots, at_b })
    }

    /// The first T of it.
    fn cropped(&self, bed: &Bed) -> &[f64] {
        &self.at_b[..(window_samples(bed.window, bed.rate) + 1).min(self.at_b.len())]
    }

    fn figure(&self, bed: &Bed, scene: &Scene) -> Figure {
        let high = self.shots.get(2).map_or(0.0, |s| s.velocity.iter().fold(0.0, |m: f32, v| m.max(v.abs())));
        let strip = strip(scene, &self.cells, &self.shots, 0.7 * f64::from(high), |t| {
            format!("t = {:.1} ms", t * 1e3)
        });
        let mut heard = curve(&self.at_b, bed.rate, "m/s", "Velocity at B");
        let kept = Span { from: 0.0, to: bed.window, ink: Ink::Palette(5), ..Span::default() };
        heard.layers.insert(0, kept.into());
        heard.layers.push(Rule { at: bed.window, label: "T".into(), ..Rule::default() }.into());
        Figure {
            width_mm: 178.0,
            panels: vec![strip.into(), heard.into()],
            letters: false,
            description: "Waves spreading from a blow at A, and the velocity recorded at B".into(),
            ..Figure::default()
        }
    }

    fn caption(&self, bed: &Bed, b: &Port) -> String {
        format!(
            "Fig. 1a. Record and crop. A blow of {:.0} µN·s at A, {}, spreads and reverberates; its velocity is recorded at B, \
             {} of the actuators, at {}, and the first T = {:.0} ms (shaded) are kept. The circle is the focal disc of A. \
             Colours saturate near the blow at first; the ripple ahead of the front is that of a band with a sharp end.",
            IMPULSE * 1e6,
            place(bed.target),
            b.name,
            place(b.at),
            bed.window * 1e3
        )
    }
}

/// A place in whole millimetres.
pub(super) fn place(at: Point) -> String {
    format!("({:.0}, {:.0}) mm", at.x * 1e3, at.y * 1e3)
}

/// The only target's figures.
pub(super) fn first(targets: Vec<TargetFigures>) -> Result<TargetFigures, TaskError> {
    targets.into_iter().next().ok_or_else(|| TaskError::Work("no target was measured".into()))
}

/// Contrast at A with every actuator.
fn contrast_of_all(bed: &Bed) -> Result<f64, TaskError> {
    let options = Options { window: bed.window, limit: FORCE, ..Options::default() };
    let focused = focus(&bed.responses, &[Target::at(bed.target)], &options).map_err(TaskError::work)?;
    let drive = focused.drive.as_emitted();
    let field = Field::new(&bed.responses, &drive, CELLS).map_err(TaskError::work)?;
    let measured = field.measure(&[Aim::at(bed.target, bed.window)], None).map_err(TaskError::work)?;
    Ok(first(measured.targets)?.contrast.unwrap_or(f64::NAN))
}

/// The closed form's contrast on the bed's film with so many actuators; `None` where decay varies with frequency.
pub(super) fn closed_contrast(bed: &Bed, modal: &ModalResponses, actuators: usize) -> Option<f64> {
    let Decay::Time(tau) = bed.surface.sheet.decay else { return None };
    let Conditions { band: [low, high], .. } = modal.conditions;
    Some(closed::contrast(actuators as f64, high - low, tau, bed.window, modal.poles.len() as f64))
}

fn compared(
    bed: &Bed,
    modal: &ModalResponses,
    recording: &Recording,
    refocus: &Refocus,
    all: f64,
) -> Vec<Compared> {
    let count = modal.ports.len();
    let one = refocus.figures.contrast.unwrap_or(f64::NAN);
    let form = |n| closed_contrast(bed, modal, n).map_or("-".into(), |c| format!("{c:.1}"));
    let [_, noise_a, noise_c] = refocus.levels(bed);
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
                recording.cropped(bed).len() - 1
            ),
        ),
        Compared::new(
            "contrast with one actuator",
            "no figure",
            format!("{one:.1}"),
            format!("closed form, a mean over places: {}", form(1)),
        ),
        Compared::new(
            format!("contrast with {count} actuators"),
            "∝ √N",
            format!("{all:.1}, {:.2} times that with one", all / one),
            format!(
                "closed form: {}; √N would be {:.2} times, with one actuator as good as another and a window too short to tell modes apart",
                form(count),
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
        let bed = Bed::new().unwrap();
        let data = section(&bed).unwrap().data;
        let number = |name: &str| data[name].as_f64().unwrap();
        assert!(number("reciprocity_mismatch") < 1e-6);
        assert!((number("peak_of_equation_2") - 1.0).abs() < 1e-6);
        let modal = modal(&bed.responses).unwrap();
        let one = data["one_actuator"]["contrast"].as_f64().unwrap();
        for (found, actuators) in [(one, 1), (number("contrast_all_actuators"), modal.ports.len())] {
            let expected = closed_contrast(&bed, modal, actuators).unwrap();
            assert!((found / expected - 1.0).abs() < 0.25, "{actuators}: {found} against {expected}");
        }
    }

    #[test]
    fn one_port_takes_in_what_that_actuator_does() {
        let bed = Bed::new().unwrap();
        let modal = modal(&bed.responses).unwrap();
        let port = actuator(modal, ACTUATOR).unwrap();
        let Responses::Modal(alone) = driven_at(modal, port) else { unreachable!() };
        assert_eq!(alone.input.ncols(), modal.poles.len());
        for mode in 0..modal.poles.len() {
            let (found, expected) = (alone.input[(0, mode)], modal.input[(ACTUATOR, mode)]);
            assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0));
        }
        assert!(actuator(modal, modal.ports.len()).is_err());
    }
}
