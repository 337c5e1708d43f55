//! The impulse at A of Fig. 1, as it is recorded at B.

use super::panels::{curve, strip};
use crate::reproduce::PaperSetup;
use crate::reproduce::fields::cells;
use crate::reproduce::modes::driven_at;
use crate::reproduce::places::place;
use unripple::core::{Drive, ModalResponses, Point, Port, window_samples};
use unripple::field::{self, Field, Snapshot};
use unripple_plot::{Figure, Ink, Rule, Span};
use unripple_tasks::TaskError;
use unripple_tasks::figures::Scene;
use unripple_tasks::judge::CELLS;

/// The impulse at A, in N·s. Since everything is linear, it only sets the scale of the recording.
pub(super) const IMPULSE: f64 = 1e-6;

/// Length of the recording, in windows T: the first is reversed, the rest shows how the motion decays.
const RECORDED: f64 = 2.5;

/// Instants of the spreading wave, in seconds after the impulse.
const SPREADING: [f64; 6] = [0.3e-3, 0.7e-3, 1.2e-3, 2.0e-3, 6.0e-3, 30.0e-3];

/// The field of an impulse at A, and the velocity recorded at B.
pub(super) struct Recording {
    cells: field::Grid,
    shots: Vec<Snapshot>,
    at_b: Vec<f64>,
}

impl Recording {
    /// Applies an impulse at A, and records the velocity at B.
    pub(super) fn make(setup: &PaperSetup, modal: &ModalResponses, b: Point) -> Result<Self, TaskError> {
        let name = "A";
        let struck = driven_at(modal, Port { name: name.into(), at: setup.target });
        let blow = Drive::new(setup.rate, vec![name.into()], vec![vec![IMPULSE * setup.rate]])
            .map_err(TaskError::work)?;
        let field = Field::new(&struck, &blow, CELLS).map_err(TaskError::work)?;
        let shots = field.snapshots(&SPREADING).map_err(TaskError::work)?;
        let traces = field.traces(&[b], RECORDED * setup.window).map_err(TaskError::work)?;
        let at_b = traces.into_iter().next().map(|trace| trace.velocity).unwrap_or_default();
        Ok(Self { cells: cells(&field)?, shots, at_b })
    }

    /// The first window T of the recording.
    pub(super) fn cropped(&self, setup: &PaperSetup) -> &[f64] {
        &self.at_b[..(window_samples(setup.window, setup.rate) + 1).min(self.at_b.len())]
    }

    /// Figure of the fields side by side, and of the velocity at B with the window T marked.
    pub(super) fn figure(&self, setup: &PaperSetup, scene: &Scene) -> Figure {
        let high = self.shots.get(2).map_or(0.0, |s| s.velocity.iter().fold(0.0, |m: f32, v| m.max(v.abs())));
        let strip = strip(scene, &self.cells, &self.shots, 0.7 * f64::from(high), |t| {
            format!("t = {:.1} ms", t * 1e3)
        });
        let mut heard = curve(&self.at_b, setup.rate, "m/s", "Velocity at B");
        let kept = Span { from: 0.0, to: setup.window, ink: Ink::Palette(5), ..Span::default() };
        heard.layers.insert(0, kept.into());
        heard.layers.push(Rule { at: setup.window, label: "T".into(), ..Rule::default() }.into());
        Figure {
            width_mm: 178.0,
            panels: vec![strip.into(), heard.into()],
            letters: false,
            description: "Waves spreading from a blow at A, and the velocity recorded at B".into(),
            ..Figure::default()
        }
    }

    /// Caption of the figure.
    pub(super) fn caption(&self, setup: &PaperSetup, b: &Port) -> String {
        format!(
            "Fig. 1a. Record and crop. A blow of {:.0} µN·s at A, {}, spreads and reverberates; its velocity is recorded at B, \
             {} of the actuators, at {}, and the first T = {:.0} ms (shaded) are kept. The circle is the focal disc of A. \
             Colours saturate near the blow at first; the ripple ahead of the front is that of a band with a sharp end.",
            IMPULSE * 1e6,
            place(setup.target),
            b.name,
            place(b.at),
            setup.window * 1e3
        )
    }
}
