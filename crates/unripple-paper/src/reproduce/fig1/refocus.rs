//! The reversed recording of Fig. 1, played by the actuator.

use super::panels::{curve, strip};
use super::recording::{IMPULSE, Recording};
use crate::reproduce::PaperSetup;
use crate::reproduce::fields::{cells, first, largest};
use crate::reproduce::modes::{FORCE, driven_at};
use crate::reproduce::places::place;
use unripple::core::{Drive, ModalResponses, Point, Port, window_samples};
use unripple::field::{self, Aim, Field, Snapshot, TargetFigures, Trace};
use unripple::focus::{Options, Target, focus};
use unripple_dsp::rms;
use unripple_plot::{Axis, Figure, Ink, Rule, Traces, prefixed};
use unripple_tasks::TaskError;
use unripple_tasks::figures::Scene;
use unripple_tasks::judge::CELLS;

/// Point C, which is no target, where the noise is evaluated.
pub(super) const C: Point = Point::new(0.110, 0.055);

/// Share of the peak at which the colours of the converging wave saturate.
const SATURATED: f64 = 0.6;

/// Instants of the converging wave, in seconds from the focus.
const CONVERGING: [f64; 6] = [-12.0e-3, -0.5e-3, -0.25e-3, 0.0, 0.25e-3, 0.5e-3];

/// Time on either side of the focus that does not count as noise, in seconds. Twice as long would leave out
/// noise, half as long would count the pulse itself.
const PULSE: f64 = 2e-3;

/// The reversed recording as the drive of B, and the field that it makes.
pub(super) struct Refocus {
    drive: Drive,
    /// Largest difference between the reversed recording and the drive computed from B's own responses,
    /// relative to the peak of the latter.
    pub(super) mismatch: f64,
    /// v_A(T) of the paper's equation 2, in m/s.
    pub(super) predicted: f64,
    cells: field::Grid,
    shots: Vec<Snapshot>,
    at_a: Trace,
    at_c: Trace,
    pub(super) figures: TargetFigures,
}

impl Refocus {
    /// Plays the reversed recording, compares it with the drive computed from the responses, and evaluates
    /// its field.
    pub(super) fn make(
        setup: &PaperSetup,
        modal: &ModalResponses,
        b: &Port,
        recording: &Recording,
    ) -> Result<Self, TaskError> {
        let responses = driven_at(modal, b.clone());
        let cropped = recording.cropped(setup);
        let scale = FORCE / largest(cropped);
        let reversed: Vec<f64> = cropped.iter().rev().map(|v| v * scale).collect();
        let drive = Drive::new(setup.rate, vec![b.name.clone()], vec![reversed])
            .map_err(TaskError::work)?
            .as_emitted();

        let options = Options { window: setup.window, limit: FORCE, ..Options::default() };
        let other = focus(&responses, &[Target::at(setup.target)], &options).map_err(TaskError::work)?.drive;
        let pairs = drive.channels().iter().flatten().zip(other.channels().iter().flatten());
        let mismatch = pairs.fold(0.0, |m: f64, (a, b)| m.max((a - b).abs())) / other.peak();

        let field = Field::new(&responses, &drive, CELLS).map_err(TaskError::work)?;
        let instants = CONVERGING.map(|t| setup.window + t);
        let shots = field.snapshots(&instants).map_err(TaskError::work)?;
        let mut traces =
            field.traces(&[setup.target, C], 2.0 * setup.window).map_err(TaskError::work)?.into_iter();
        let (at_a, at_c) = (traces.next().unwrap_or_default(), traces.next().unwrap_or_default());
        let aim = Aim::at(setup.target, setup.window);
        let figures = first(field.measure(&[aim], None).map_err(TaskError::work)?.targets)?;
        let squares: f64 = cropped.iter().map(|v| (v / IMPULSE).powi(2)).sum();
        let predicted = squares * scale * IMPULSE / setup.rate;
        let cells = cells(&field)?;
        drop(field);
        Ok(Self { drive, mismatch, predicted, cells, shots, at_a, at_c, figures })
    }

    /// Peak at A, and the rms of the noise at A (but for the pulse) and at C, in m/s.
    pub(super) fn levels(&self, setup: &PaperSetup) -> [f64; 3] {
        let (focus, pulse) = (window_samples(setup.window, setup.rate), window_samples(PULSE, setup.rate));
        let noise: Vec<f64> = self
            .at_a
            .velocity
            .iter()
            .enumerate()
            .filter(|(i, _)| i.abs_diff(focus) > pulse)
            .map(|(_, v)| *v)
            .collect();
        [self.figures.peak_velocity_m_s, rms(&noise), rms(&self.at_c.velocity)]
    }

    /// Figure of the fields side by side, the force at B, and the velocities at A and C.
    pub(super) fn figure(&self, setup: &PaperSetup, scene: &Scene) -> Figure {
        let high = SATURATED * self.figures.peak_velocity_m_s;
        let from_focus = |t: f64| {
            let us = ((t - setup.window) * 1e6).round();
            let ms = us.abs() / 1e3;
            match us {
                0.0 => "t = T".into(),
                us if us < 0.0 => format!("T − {ms} ms"),
                _ => format!("T + {ms} ms"),
            }
        };
        let strip = strip(scene, &self.cells, &self.shots, high, from_focus);
        let focus = || Rule { at: setup.window, label: "T".into(), ..Rule::default() };
        let mut played = curve(&self.drive.channels()[0], setup.rate, "N", "Force at B");
        played.x = Axis::new("Time (ms)").times(1e3).from(0.0).to(2.0 * setup.window);
        played.layers.push(focus().into());
        let (multiplier, unit) = prefixed(self.figures.peak_velocity_m_s, "m/s");
        let trace = |label: &str, trace: &Trace, ink| unripple_plot::Trace {
            label: label.into(),
            values: trace.velocity.clone(),
            ink: Ink::Palette(ink),
        };
        let heard = Traces {
            x: Axis::new("Time (ms)").times(1e3),
            step: 1.0 / setup.rate,
            traces: vec![trace("at A", &self.at_a, 1), trace("at C", &self.at_c, 0)],
            unit,
            multiplier,
            rules: vec![focus()],
            lane_mm: Some(17.0),
            ..Traces::default()
        };
        Figure {
            width_mm: 178.0,
            panels: vec![strip.into(), played.into(), heard.into()],
            letters: false,
            description: "Waves converging on A, the force at B, and the velocities at A and C".into(),
            ..Figure::default()
        }
    }

    /// Caption of the figure.
    pub(super) fn caption(&self, setup: &PaperSetup, b: &Port) -> String {
        let [peak, noise_a, noise_c] = self.levels(setup);
        format!(
            "Fig. 1b. Reverse and refocus. B ({}) plays the recording backwards; the waves meet at A at t = T. The peak at A is \
             {:.1} times the rms noise at A over 0 … 2T (without the {:.0} ms on either side of T) and {:.1} times that at C, \
             {}. The circle is the focal disc of A; colours saturate at {:.0} % of the peak.",
            b.name,
            peak / noise_a,
            PULSE * 1e3,
            peak / noise_c,
            place(C),
            SATURATED * 100.0
        )
    }
}
