//! Contrast on outlines from regular to chaotic, against theory.

use super::contrast::{Statistic, statistics};
use super::section::row;
use super::{PaperSetup, Picture, Predicted, Section};
use crate::study::{CELLS, ContrastModel, against_window, cavities};
use serde_json::json;
use unripple::core::{Outline, Surface};
use unripple_plot::{Axis, Figure, Ink, Layer, Line, Mark, Plot, Points};
use unripple_tasks::TaskError;

/// Simulated windows, in seconds; the paper's window is among them.
const WINDOWS: [f64; 6] = [0.005, 0.010, 0.020, 0.030, 0.060, 0.150];
/// Numbers of actuators: the fewest possible, and the paper's.
const ACTUATORS: [usize; 2] = [1, 8];

/// Contrast on one outline against the window.
struct Cavity {
    name: &'static str,
    modes: usize,
    rows: Vec<Statistic>,
}

impl Cavity {
    fn of(
        setup: &PaperSetup,
        name: &'static str,
        outline: Outline,
        placements: usize,
    ) -> Result<Self, TaskError> {
        let surface = Surface { outline, ..setup.surface.clone() };
        let model = ContrastModel::of(&surface, CELLS)?;
        let rows = statistics(placements, |s| Ok(against_window(&model, &surface, &WINDOWS, &ACTUATORS, s)))?;
        Ok(Self { name, modes: model.modes(), rows })
    }

    fn at(&self, actuators: usize, window: f64) -> Option<&Statistic> {
        self.rows.iter().find(|r| r.actuators == actuators && (r.varied / window - 1.0).abs() < 1e-9)
    }

    fn mean(&self, actuators: usize, window: f64) -> f64 {
        self.at(actuators, window).map_or(f64::NAN, |r| r.simulated)
    }
}

/// Makes the part of the page on section 2: contrast on outlines of equal area, on the same film.
pub fn section(setup: &PaperSetup, placements: usize) -> Result<Section, TaskError> {
    let all = cavities(setup.surface.outline.area())
        .into_iter()
        .map(|(name, outline)| Cavity::of(setup, name, outline, placements))
        .collect::<Result<Vec<_>, _>>()?;
    let data = all.iter().map(|c| json!({ "outline": c.name, "modes": c.modes, "against_window_s": c.rows }));
    Ok(Section {
        title: "Section 2: the outline".into(),
        text: vec![text(&all, setup.window)],
        figures: vec![Picture::still(
            "outlines",
            figure(&all),
            format!(
                "Contrast against the window for five clamped outlines of {:.0} cm², one actuator (a) and eight (b); means of \
                 {placements} placements along the rim with four targets each, bars their standard error.",
                setup.surface.outline.area() * 1e4
            ),
        )],
        predicted: predicted(&all, setup.window),
        table: table(&all, setup.window),
        data: json!({ "outlines": data.collect::<Vec<_>>() }),
        ..Section::default()
    })
}

fn figure(all: &[Cavity]) -> Figure {
    let panel = |actuators: usize| {
        let mut layers: Vec<Layer> = Vec::new();
        for (i, cavity) in all.iter().enumerate() {
            let rows: Vec<&Statistic> = cavity.rows.iter().filter(|r| r.actuators == actuators).collect();
            let (x, y): (Vec<f64>, Vec<f64>) = rows.iter().map(|r| (r.varied, r.simulated)).unzip();
            let (ink, label) = (Ink::Palette(i), cavity.name.to_owned());
            layers.push(
                Line { x: x.clone(), y: y.clone(), ink, label: label.clone(), ..Line::default() }.into(),
            );
            let error = rows.iter().map(|r| [r.error, r.error]).collect();
            layers.push(Points { x, y, error, label, ink, mark: Mark::Disc }.into());
        }
        let (x, y) = (Axis::log("Window T (ms)").times(1e3), Axis::new("Contrast").from(0.0));
        Plot { x, y, layers, ..Plot::default() }
    };
    Figure {
        width_mm: 178.0,
        columns: 2,
        panels: ACTUATORS.map(|n| panel(n).into()).to_vec(),
        description: "Contrast against window on square, rectangle, circle, stadium and irregular polygon, for one actuator \
                      and for eight"
            .into(),
        ..Figure::default()
    }
}

/// Text on the outlines, and on the chaotic cavities from which the paper takes its law.
fn text(all: &[Cavity], window: f64) -> String {
    let long = WINDOWS[WINDOWS.len() - 1];
    let of =
        |name: &str, n: usize, t: f64| all.iter().find(|c| c.name == name).map_or(f64::NAN, |c| c.mean(n, t));
    let (polygon, rectangle) = ("irregular polygon", "rectangle 3:2");
    format!(
        "For one actuator the paper takes its law, contrast that grows as √T, from chaotic cavities and scattering media. With \
         one actuator and {:.0} ms the contrast is {:.1} on the rectangle, {:.1} on the irregular polygon, {:.1} on the stadium, \
         {:.1} on the square and {:.1} on the circle. Symmetry does cost: a square and a circle have modes in pairs of one \
         frequency, of which one actuator drives a single combination, and cannot excite the other, however long it plays. But \
         of these five outlines the two irregular ones, the stadium (a chaotic cavity) and the polygon, do not surpass the \
         rectangle. Once no two modes share a frequency, what matters is how evenly the modes are excited: the mode shapes of a \
         chaotic cavity are like random waves, and an actuator excites some of them hardly at all, while those of a rectangle \
         are products of sines, whose squares have a relative variance of 5/4 instead of 2. So the plain rectangle, whose \
         longer side is no multiple of the shorter, is the best of the five. With eight actuators and {:.0} ms all lie between \
         {:.1} (circle) and {:.1} (rectangle): at places without symmetry, as the paper's, they excite both modes of a pair, and \
         square and circle come nearer to the irregular outlines.",
        long * 1e3,
        of(rectangle, 1, long),
        of(polygon, 1, long),
        of("stadium", 1, long),
        of("square", 1, long),
        of("circle", 1, long),
        window * 1e3,
        of("circle", 8, window),
        of(rectangle, 8, window),
    )
}

fn predicted(all: &[Cavity], window: f64) -> Vec<Predicted> {
    let share = |n: usize, t: f64| {
        let means: Vec<f64> = all.iter().map(|c| c.mean(n, t)).collect();
        let (low, high) = means.iter().fold((f64::MAX, 0.0), |(l, h): (f64, f64), m| (l.min(*m), h.max(*m)));
        format!("{low:.1} to {high:.1} over these five outlines")
    };
    vec![
        Predicted::new(
            format!("contrast of one actuator, {:.0} ms", WINDOWS[WINDOWS.len() - 1] * 1e3),
            share(1, WINDOWS[WINDOWS.len() - 1]),
            "modes of one frequency cost; of these five, the stadium and the polygon gain nothing over the rectangle",
        ),
        Predicted::new(
            format!("contrast of eight actuators, {:.0} ms", window * 1e3),
            share(8, window),
            "eight actuators at places without symmetry excite both modes of a pair",
        ),
    ]
}

fn table(all: &[Cavity], window: f64) -> Vec<Vec<String>> {
    let long = WINDOWS[WINDOWS.len() - 1];
    let heading = |n: usize, t: f64| format!("N = {n}, {:.0} ms", t * 1e3);
    let cases = [(1, window), (1, long), (8, window), (8, long)];
    let mut headings = row(["outline", "modes"]);
    headings.extend(cases.map(|(n, t)| heading(n, t)));
    let cells =
        |c: &Cavity| {
            let mut cells = vec![c.name.to_owned(), c.modes.to_string()];
            cells.extend(cases.map(|(n, t)| {
                c.at(n, t).map_or("-".into(), |r| format!("{:.1} ± {:.1}", r.simulated, r.error))
            }));
            cells
        };
    std::iter::once(headings).chain(all.iter().map(cells)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::Ask;

    /// The guide with this table.
    const GUIDE: &str = include_str!("../../../../docs/any-surface.md");

    /// Square and rectangle, whose modes are quick to compute, with as many placements as `reproduce` takes by default.
    #[test]
    fn the_guide_has_these_contrasts() {
        let setup = PaperSetup::new().unwrap();
        let quick = cavities(setup.surface.outline.area()).into_iter().take(2);
        let placements = Ask::default().placements;
        let found: Vec<Cavity> =
            quick.map(|(name, outline)| Cavity::of(&setup, name, outline, placements).unwrap()).collect();
        for row in table(&found, setup.window) {
            let line = format!("| {} |", row.join(" | "));
            assert!(GUIDE.contains(&line), "{line} is not in the guide");
        }
    }
}
