use super::front::Front;
use super::row::Row;
use unripple_plot::{Axis, Figure, Ink, Layer, Line, Plot, Points};

/// What is drawn of a front: abscissae and ordinates.
type Drawn = fn(&Front) -> (Vec<f64>, Vec<f64>);

/// Contrast against the energy that a peak takes, and against the peak at the drive limit.
pub fn draw(rows: &[Row], fronts: &[Front]) -> Figure {
    let peak = |row: &Row| row.targets.first().map_or(f64::NAN, |t| t.peak_velocity_m_s.abs());
    let first = rows.first().map_or(f64::NAN, peak);
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
        rows.iter().map(|row| (peak(row) / first, contrast(row))).unzip(),
    );
    Figure {
        width_mm: 178.0,
        columns: 2,
        panels: vec![energy.into(), level.into()],
        letters: true,
        description: "Contrast of every method against the energy that the same peak takes and against the peak that the \
                      drive limit allows, each method's knob turned from end to end"
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
        Points { x, y, label: "as they come".into(), ink: Ink::Palette(7), ..Points::default() }.into(),
    );
    Plot { x: Axis::log(label), y: Axis::log("Contrast"), layers, ..Plot::default() }
}
