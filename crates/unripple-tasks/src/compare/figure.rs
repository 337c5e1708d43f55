//! The figure of a comparison: of methods on one surface, or of several surfaces.

use super::compared::Compared;
use super::front::Front;
use super::row::Row;
use unripple::field::TargetFigures;
use unripple::focus::Method;
use unripple_plot::{Along, Axis, Dash, Figure, Ink, Layer, Line, Mark, Panel, Plot, Points, Rule, Scale};

/// Function that selects abscissae and ordinates from a tradeoff curve.
type Drawn = fn(&Front) -> (Vec<f64>, Vec<f64>);

/// Function that selects a metric of what is felt from those of a target.
type Felt = fn(&TargetFigures) -> Option<f64>;

/// Draws contrast against the drive energy for a given peak, contrast against the peak at the drive limit,
/// and the felt level at the target relative to elsewhere against the drive for a given felt level.
pub fn draw(rows: &[Row], fronts: &[Front], felt: &[Row]) -> Figure {
    // What is felt is not made for contrast.
    let rows: Vec<&Row> = rows.iter().filter(|row| row.method != Method::Felt.name()).collect();
    let energy = plot(
        "Energy for the same peak, time reversal = 1",
        fronts,
        |front| (front.energy_for_peak.clone(), front.contrast.clone()),
        rows.iter().map(|row| (row.energy_for_peak, contrast(row))).unzip(),
    );
    let level = plot(
        "Peak at the drive limit, time reversal = 1",
        fronts,
        |front| (front.peak.clone(), front.contrast.clone()),
        rows.iter().map(|row| (row.peak_at_limit, row.contrast_at_limit)).unzip(),
    );
    let mut panels: Vec<Panel> = vec![energy.into(), level.into()];
    // Where `felt` failed, time reversal stands alone.
    if felt.len() > 1 {
        panels.push(quiet(felt).into());
    }
    Figure {
        width_mm: 178.0,
        columns: 2,
        panels,
        letters: true,
        description: "Contrast of every method against the energy for the same peak and against the peak at the drive limit, over the \
                      whole range of each method's parameter; felt contrast against the drive needed for the same felt level"
            .into(),
        ..Figure::default()
    }
}

fn contrast(row: &Row) -> f64 {
    row.targets.first().and_then(|target| target.contrast).unwrap_or(f64::NAN)
}

fn plot(label: &str, fronts: &[Front], drawn: Drawn, marks: (Vec<f64>, Vec<f64>)) -> Plot {
    let mut layers: Vec<Layer> = Vec::new();
    for (i, front) in fronts.iter().enumerate() {
        let (x, y) = drawn(front);
        layers
            .push(Line { x, y, label: front.method.into(), ink: Ink::Palette(i), ..Line::default() }.into());
    }
    let (x, y) = marks;
    layers.push(
        Points { x, y, label: "default parameters".into(), ink: Ink::Palette(7), ..Points::default() }.into(),
    );
    Plot { x: Axis::log(label), y: Axis::log("Contrast"), layers, ..Plot::default() }
}

/// Felt level at the target relative to the background and to the worst spot, against the drive for the
/// same felt level.
fn quiet(felt: &[Row]) -> Plot {
    let of = |figure: Felt, row: &Row| row.targets.first().and_then(figure).unwrap_or(f64::NAN);
    let mut layers: Vec<Layer> = Vec::new();
    let figures: [(&str, Felt); 2] =
        [("background", |t| t.felt_background_db), ("worst spot", |t| t.felt_worst_spot_db)];
    for (i, (name, figure)) in figures.into_iter().enumerate() {
        let (x, y) = felt.iter().skip(1).map(|row| (row.drive_for_level_db, of(figure, row))).unzip();
        layers.push(Line { x, y, label: name.into(), ink: Ink::Palette(i), ..Line::default() }.into());
        let (x, y) = felt.iter().take(1).map(|row| (row.drive_for_level_db, of(figure, row))).unzip();
        let label = if i == 0 { "time reversal".into() } else { String::new() };
        layers.push(Points { x, y, label, ink: Ink::Palette(i), ..Points::default() }.into());
    }
    Plot {
        x: Axis::new("Drive for the same felt level (dB)"),
        y: Axis::new("Felt: target over elsewhere (dB)"),
        layers,
        ..Plot::default()
    }
}

/// Function that selects a quantity from a row.
type Quantity = fn(&Row) -> Option<f64>;

/// Marks of the methods, the same on every panel.
const MARKS: [Mark; 7] =
    [Mark::Disc, Mark::Square, Mark::Ring, Mark::Triangle, Mark::Diamond, Mark::Cross, Mark::Plus];

/// Height of a surface's line in mm: room for its name.
const LINE_MM: f64 = 5.0;

/// Least and greatest height of all lines in mm, so that a frame is not flat and a figure fits a page.
const HEIGHT_MM: [f64; 2] = [20.0, 160.0];

/// Draws contrast, felt contrast and energy of every method, a line for each surface; `None` if no value is
/// known.
pub fn beside(surfaces: &[Compared]) -> Option<Figure> {
    let quantities: [(Axis, Quantity); 3] = [
        (Axis::log("Contrast"), |row| row.targets.first()?.contrast),
        (Axis::new("Felt contrast (dB)"), |row| row.targets.first()?.felt_contrast_db),
        (Axis::log("Energy, time reversal = 1"), |row| Some(row.energy_for_peak)),
    ];
    let panels: Vec<Panel> = quantities
        .into_iter()
        .filter_map(|(axis, quantity)| Some(dots(surfaces, axis, quantity)?.into()))
        .collect();
    (!panels.is_empty()).then(|| Figure {
        width_mm: 178.0,
        columns: 2,
        panels,
        letters: true,
        description:
            "Contrast, felt contrast and energy for the same peak of every method, a line for each surface"
                .into(),
        ..Figure::default()
    })
}

/// Plot of one quantity, with a mark for each method on the line of each surface, the first surface at the
/// top.
fn dots(surfaces: &[Compared], axis: Axis, quantity: Quantity) -> Option<Plot> {
    let upwards = || surfaces.iter().rev().enumerate();
    let names = upwards().map(|(_, on)| on.label.clone()).collect();
    let line = |(place, _): (usize, &Compared)| {
        let (at, dash) = (place as f64, Dash::Dotted);
        Layer::from(Rule { at, along: Along::X, dash, ..Rule::default() })
    };
    let mut layers: Vec<Layer> = upwards().map(line).collect();
    let drawable = |value: &f64| value.is_finite() && (axis.scale == Scale::Linear || *value > 0.0);
    for (i, method) in Method::ALL.into_iter().enumerate() {
        let found = upwards().filter_map(|(place, on)| {
            let row = on.methods.iter().find(|row| row.method == method.name())?;
            Some((quantity(row).filter(drawable)?, place as f64))
        });
        let (x, y): (Vec<f64>, Vec<f64>) = found.unzip();
        if !x.is_empty() {
            let (label, ink) = (method.name().into(), Ink::Palette(i));
            layers.push(Points { x, y, label, ink, mark: MARKS[i], ..Points::default() }.into());
        }
    }
    let height = (LINE_MM * surfaces.len() as f64).clamp(HEIGHT_MM[0], HEIGHT_MM[1]);
    let y = Axis::named("Surface", names);
    (layers.len() > surfaces.len()).then(|| Plot {
        x: axis,
        y,
        layers,
        height_mm: Some(height),
        ..Plot::default()
    })
}
