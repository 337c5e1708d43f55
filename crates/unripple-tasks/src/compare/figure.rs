//! The figure of a comparison.

use super::front::Front;
use super::row::Row;
use unripple::field::TargetFigures;
use unripple::focus::Method;
use unripple_plot::{Axis, Figure, Ink, Layer, Line, Panel, Plot, Points};

/// Abscissae and ordinates of a front, as drawn.
type Drawn = fn(&Front) -> (Vec<f64>, Vec<f64>);

/// A felt figure of a target.
type Felt = fn(&TargetFigures) -> Option<f64>;

/// Draws contrast against the energy that a given peak takes, contrast against the peak at the drive limit, and the level felt outside the
/// target against the drive that a given felt level takes.
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
        description: "Contrast of every method against the energy that the same peak takes and against the peak that the drive \
            limit allows, with the parameter of each method varied from end to end; what is felt elsewhere against the drive \
            that a felt level takes"
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

/// Background and worst spot as felt, against the drive for the same level.
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
