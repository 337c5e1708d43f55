//! Fig. 2b of the paper: a triangle.

use super::focus::focused;
use super::ratio::ratio;
use crate::reproduce::fields::{cells, first, largest};
use crate::reproduce::modes::FORCE;
use crate::reproduce::{PaperSetup, Picture, Predicted, Section};
use serde_json::json;
use unripple::core::Point;
use unripple::field::{self, Aim, Field, Measured, TargetFigures, Trace};
use unripple::focus::{Pattern, Target};
use unripple_plot::{
    Along, Axis, ColourMap, Colours, Dash, Figure, Ink, Legend, Line, Map, Marker, Plot, Rule, Span, Symbol,
    prefixed,
};
use unripple_tasks::TaskError;
use unripple_tasks::figures::{Scene, drawn};
use unripple_tasks::judge::CELLS;

/// Centre and side of the triangle, in m: large compared with a focus, and well inside the film.
const CENTRE: Point = Point::new(0.075, 0.070);
const SIDE: f64 = 0.070;

/// Distance between the points at which the level along the triangle is evaluated, in metres.
const FINE: f64 = 1e-3;

/// A triangle in focus, with the metrics of its field.
struct Drawn {
    points: Vec<Point>,
    measured: Measured,
    figures: TargetFigures,
    /// Velocity at T along the triangle, about [`FINE`] apart.
    along: Vec<f64>,
    cells: field::Grid,
}

impl Drawn {
    fn make(setup: &PaperSetup) -> Result<Self, TaskError> {
        let pitch = Pattern::pitch(setup.responses.conditions().lambda_min);
        let points = Pattern::triangle(CENTRE, SIDE).sample(pitch).map_err(TaskError::work)?;
        let drive = focused(setup, &setup.responses, Target::of(points.clone()))?.drive.as_emitted();
        let field = Field::new(&setup.responses, &drive, CELLS).map_err(TaskError::work)?;
        let aim = Aim { points: points.clone(), instant: setup.window };
        let mut measured = field.measure(&[aim], None).map_err(TaskError::work)?;
        let figures = first(std::mem::take(&mut measured.targets))?;
        let fine = Pattern::triangle(CENTRE, SIDE).sample(FINE).map_err(TaskError::work)?;
        let traces = field.traces(&fine, setup.window).map_err(TaskError::work)?;
        let along =
            traces.iter().map(|trace: &Trace| trace.velocity.last().copied().unwrap_or(0.0)).collect();
        Ok(Self { points, measured, figures, along, cells: cells(&field)? })
    }

    /// Least and greatest velocity along the triangle, relative to the mean.
    fn velocities(&self) -> [f64; 2] {
        let ends = |[low, high]: [f64; 2], v: &f64| [low.min(*v), high.max(*v)];
        let range = self.along.iter().fold([f64::INFINITY, f64::NEG_INFINITY], ends);
        range.map(|v| v / self.figures.peak_velocity_m_s)
    }

    /// Least and greatest displacement along the triangle, relative to the mean.
    fn displacements(&self) -> [f64; 2] {
        let [low, high] = self.figures.displacement_range_m.unwrap_or([f64::NAN; 2]);
        let [low, high] = [low, high].map(|u| u / self.figures.peak_displacement_m);
        [low.min(high), low.max(high)]
    }
}

/// Makes the part of the page on Fig. 2b: a triangle from eight impulse responses.
pub fn triangle(setup: &PaperSetup) -> Result<Section, TaskError> {
    let drawn = Drawn::make(setup)?;
    let figures = vec![
        Picture::still("fig2b", triangle_maps(setup, &drawn)?, triangle_caption(setup, &drawn)),
        Picture::still("fig2b-along", along(setup, &drawn), along_caption(&drawn)),
    ];
    let [low, high] = drawn.velocities();
    let [low_u, high_u] = drawn.displacements();
    let predicted = vec![
        Predicted::new(
            "triangle: velocity along it at T",
            format!("mean {:.0} mm/s, {low:.2} to {high:.2} of it", drawn.figures.peak_velocity_m_s * 1e3),
            "its points have equal weights and their waves overlap, most at the corners, over noise",
        ),
        Predicted::new(
            "triangle: displacement along it",
            format!(
                "mean {:.1} µm, {low_u:.2} to {high_u:.2} of it",
                drawn.figures.peak_displacement_m * 1e6
            ),
            "at the extreme of the mean: displacement follows velocity by a part of the pulse",
        ),
        Predicted::new(
            "triangle: contrast",
            format!(
                "{} in velocity, {} in displacement",
                ratio(drawn.figures.contrast),
                ratio(drawn.figures.displacement_contrast)
            ),
            "mean along it over the rms farther than a focal disc from all of it; lower than a point's since the noise of all its points adds up",
        ),
    ];
    Ok(Section {
        title: "Fig. 2b: a triangle from eight impulse responses".into(),
        figures,
        predicted,
        data: json!({ "figures": drawn.figures, "least_and_greatest_velocity_of_mean": drawn.velocities() }),
        text: vec![format!(
            "An equilateral triangle of {:.0} mm is sampled at {} points, a quarter of the shortest wavelength apart; their reversed responses \
             are summed, channel by channel. Its side is {:.1} shortest wavelengths of {:.1} mm, and no detail much finer than those can be drawn.",
            SIDE * 1e3,
            drawn.points.len(),
            SIDE / drawn.measured.lambda_min_m,
            drawn.measured.lambda_min_m * 1e3
        )],
        ..Section::default()
    })
}

fn triangle_maps(setup: &PaperSetup, figure: &Drawn) -> Result<Figure, TaskError> {
    let mut scene = Scene::new(&setup.surface, &[], 0.0);
    let dots = Pattern::triangle(CENTRE, SIDE).sample(3e-3).map_err(TaskError::work)?;
    let dot = |p: &Point| Marker { at: [p.x, p.y], symbol: Symbol::Circle(2e-4), name: String::new() };
    scene.markers.extend(dots.iter().map(dot));
    let missing = || TaskError::Work("no field was measured at the focus".into());
    let v = figure.measured.maps.at_peak.first().ok_or_else(missing)?;
    let u = figure.measured.maps.at_displacement_peak.first().ok_or_else(missing)?;
    let map = |values: &[f32], name: &str, unit: &str, title: String| -> Map {
        let top = values.iter().fold(0.0, |m: f32, x| m.max(x.abs()));
        let (multiplier, unit) = prefixed(f64::from(top), unit);
        let colours = Colours {
            title: format!("{name} ({unit})"),
            multiplier,
            map: ColourMap::Diverging,
            ..Colours::default()
        };
        scene.map(drawn(&figure.cells, values), title, colours)
    };
    let after = (u.instant - setup.window) * 1e3;
    Ok(Figure {
        width_mm: 178.0,
        columns: 2,
        panels: vec![
            map(&v.velocity, "Velocity", "m/s", "t = T".into()).into(),
            map(
                &u.displacement,
                "Displacement",
                "m",
                format!("t = T {} {:.2} ms", if after < 0.0 { "−" } else { "+" }, after.abs()),
            )
            .into(),
        ],
        description: "Velocity and displacement of the film when a triangle is in focus".into(),
        ..Figure::default()
    })
}

fn along(setup: &PaperSetup, drawn: &Drawn) -> Figure {
    let step = 3.0 * SIDE / drawn.along.len() as f64;
    let mean = drawn.figures.peak_velocity_m_s;
    let closed = drawn.along.iter().chain(drawn.along.first());
    let y: Vec<f64> = closed.map(|v| v / mean).collect();
    let x = (0..y.len()).map(|i| i as f64 * step).collect();
    let lambda = setup.responses.conditions().lambda_min;
    let top = largest(&y).max(1.0) * 1.15;
    let mut layers = vec![
        Span { from: 0.0, to: lambda, label: "λ at the top of the band".into(), ..Span::default() }.into(),
        Line { x, y, ink: Ink::Palette(0), label: "velocity at T".into(), ..Line::default() }.into(),
        Rule { at: 1.0, along: Along::X, ..Rule::default() }.into(),
    ];
    layers.extend([1.0, 2.0].map(|corner| {
        Rule { at: corner * SIDE, label: "corner".into(), dash: Dash::Dotted, ..Rule::default() }.into()
    }));
    let plot = Plot {
        x: Axis::new("Way along the triangle (mm)").times(1e3).from(0.0).to(3.0 * SIDE),
        y: Axis::new("Velocity, of the mean").from(0.0).to(top),
        layers,
        legend: Legend::Above,
        height_mm: Some(36.0),
        ..Plot::default()
    };
    Figure { description: "Velocity along the triangle when it is in focus".into(), ..Figure::of(plot) }
}

fn triangle_caption(setup: &PaperSetup, drawn: &Drawn) -> String {
    format!(
        "Fig. 2b. A triangle of {:.0} mm (dots) from the responses of {} actuators (squares), T = {:.0} ms, {:.0} mN at most: \
         (a) velocity at T, contrast {}; (b) displacement at the extreme of its mean along the triangle, contrast {}.",
        SIDE * 1e3,
        setup.surface.actuators.len(),
        setup.window * 1e3,
        FORCE * 1e3,
        ratio(drawn.figures.contrast),
        ratio(drawn.figures.displacement_contrast)
    )
}

fn along_caption(drawn: &Drawn) -> String {
    let [low, high] = drawn.velocities();
    format!(
        "Velocity along the triangle of Fig. 2b at T, of its mean of {:.0} mm/s, from the upper corner on: {low:.2} at the least, {high:.2} at \
         the greatest.",
        drawn.figures.peak_velocity_m_s * 1e3
    )
}
