//! Pictures of a sweep: curves over one axis of a grid, maps over two, points over each axis of anything else.

use super::folder::Folder;
use super::{Extreme, Report, Row};
use crate::TaskError;
use serde_json::Value;
use unripple_plot::{Axis, Cells, ColourMap, Colours, Figure, Ink, Line, Panel, Plot, Points};
use unripple_store::{AxisValues, Designs, Varied};

/// Figures of reports that are drawn: the first that vary. A page has no room for more.
const DRAWN: usize = 6;

/// Most designs that are drawn: more points hide each other, and vector graphics of them become slow to show.
const MOST: usize = 5000;

/// Most panels of points: figures by axes.
const PANELS: usize = 12;

/// Most points of a curve that are marked one by one.
const MARKED: usize = 60;

/// The picture of a sweep, with its name.
///
/// # Errors
/// [`TaskError::Work`] where there is nothing to draw, or too much; those of reading the rows.
pub(super) fn all(folder: &Folder, report: &Report) -> Result<Vec<(&'static str, Figure)>, TaskError> {
    let designs = folder.plan.len();
    if designs > MOST {
        return Err(TaskError::Work(format!("expected at most {MOST} designs to draw, found {designs}")));
    }
    let chosen: Vec<&Extreme> =
        report.extremes.iter().filter(|extreme| extreme.least < extreme.greatest).take(DRAWN).collect();
    if chosen.is_empty() {
        return Err(TaskError::Work(
            "expected a figure that varies from design to design, found none".into(),
        ));
    }
    let mut rows = Vec::new();
    folder.each(&mut |row| {
        rows.push(row);
        Ok(())
    })?;
    let along = axes(&folder.plan.file().designs, &rows);
    let (panels, what): (Vec<Panel>, &str) = match (&folder.plan.file().designs, along.as_slice()) {
        (Designs::Grid(_), [x]) => (chosen.iter().map(|e| curve(x, e, &rows)).collect(), "curves over"),
        (Designs::Grid(_), [y, x]) => (chosen.iter().map(|e| map(y, x, e, &rows)).collect(), "maps over"),
        (_, all) => {
            let pairs = chosen.iter().flat_map(|e| all.iter().map(move |x| (x, *e)));
            (pairs.take(PANELS).map(|(x, e)| points(x, e, &rows)).collect(), "points over")
        }
    };
    let names: Vec<&str> = along.iter().map(|axis| axis.label.as_str()).collect();
    let description = format!("Figures of {designs} designs, as {what} {}", names.join(", "));
    let columns = if panels.len() > 1 { 2 } else { 1 };
    let width_mm = if columns > 1 { 178.0 } else { 85.0 };
    Ok(vec![("sweep", Figure { width_mm, columns, panels, description, ..Figure::default() })])
}

/// The values along one axis.
struct Along {
    /// The key or field that varies.
    label: String,
    /// Place of each row on the axis: its value, or the index of its text.
    places: Vec<f64>,
    /// Texts that the places stand for; empty for numbers.
    names: Vec<String>,
    /// Values of the axis itself, for a grid.
    steps: usize,
    log: bool,
}

/// What varies, with the value of every row.
fn axes(designs: &Designs, rows: &[Row]) -> Vec<Along> {
    let one = |(at, varied): (usize, &Varied)| {
        let name = varied.to_string();
        let values: Vec<Value> =
            rows.iter().map(|row| row.values.get(&name).cloned().unwrap_or_default()).collect();
        let (places, names) = placed(&values);
        let axis = match designs {
            Designs::Grid(axes) | Designs::Sobol { axes, .. } => axes.get(at),
            Designs::List(_) => None,
        };
        let is_log = |values: &AxisValues| matches!(values, AxisValues::Range { log: true, .. });
        let log = names.is_empty() && axis.is_some_and(|axis| is_log(&axis.values));
        let label = match varied {
            Varied::Surface(path) | Varied::Ask(path) => path.clone(),
        };
        Along { label, places, names, steps: axis.map_or(0, |axis| axis.count()), log }
    };
    designs.varied().into_iter().enumerate().map(one).collect()
}

/// Places of values on an axis, and the texts that they stand for; no texts if all are numbers.
fn placed(values: &[Value]) -> (Vec<f64>, Vec<String>) {
    if let Some(numbers) = values.iter().map(Value::as_f64).collect::<Option<Vec<_>>>() {
        return (numbers, Vec::new());
    }
    let mut names: Vec<String> = Vec::new();
    let place = |value: &Value| {
        let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let known = names.iter().position(|name| *name == text);
        known.unwrap_or_else(|| {
            names.push(text);
            names.len() - 1
        }) as f64
    };
    (values.iter().map(place).collect(), names)
}

impl Along {
    fn axis(&self) -> Axis {
        match (self.names.is_empty(), self.log) {
            (false, _) => Axis::named(self.label.clone(), self.names.clone()),
            (true, true) => Axis::log(self.label.clone()),
            (true, false) => Axis::new(self.label.clone()),
        }
    }

    /// A place as text.
    fn text(&self, place: f64) -> String {
        self.names.get(place as usize).cloned().unwrap_or_else(|| place.to_string())
    }
}

/// A figure of every row; not-a-number where a design failed or has none.
fn values(figure: &str, rows: &[Row]) -> Vec<f64> {
    let known = |row: &Row| row.figures.get(figure)?.as_f64().filter(|_| row.error.is_none());
    rows.iter().map(|row| known(row).unwrap_or(f64::NAN)).collect()
}

/// A figure over the only axis of a grid.
fn curve(x: &Along, extreme: &Extreme, rows: &[Row]) -> Panel {
    let (at, y, ink) = (x.places.clone(), values(&extreme.figure, rows), Ink::Palette(0));
    let mut layers = Vec::new();
    if rows.len() <= MARKED {
        layers.push(Points { x: at.clone(), y: y.clone(), ink, ..Points::default() }.into());
    }
    layers.push(Line { x: at, y, ink, ..Line::default() }.into());
    Plot { x: x.axis(), y: Axis::new(extreme.figure.clone()), layers, ..Plot::default() }.into()
}

/// A figure over one axis of a plan, a mark for each design.
fn points(x: &Along, extreme: &Extreme, rows: &[Row]) -> Panel {
    let marks = Points { x: x.places.clone(), y: values(&extreme.figure, rows), ..Points::default() };
    Plot { x: x.axis(), y: Axis::new(extreme.figure.clone()), layers: vec![marks.into()], ..Plot::default() }
        .into()
}

/// A figure over the two axes of a grid: the first upwards, the second across.
fn map(y: &Along, x: &Along, extreme: &Extreme, rows: &[Row]) -> Panel {
    let all = values(&extreme.figure, rows);
    let columns = x.steps.max(1);
    let upwards: Vec<(&[f64], f64)> =
        all.chunks(columns).zip(y.places.iter().copied().step_by(columns)).collect();
    let (edges, axis) = edges(x, columns);
    Cells {
        edges,
        rows: upwards.iter().rev().map(|(_, place)| y.text(*place)).collect(),
        values: upwards.iter().rev().flat_map(|(row, _)| row.iter().copied()).collect(),
        x: axis,
        label: last(&y.label, '.', 1),
        colours: Colours {
            title: last(&extreme.figure, '/', 2),
            map: ColourMap::Sequential,
            low: Some(extreme.least),
            high: Some(extreme.greatest),
            ..Colours::default()
        },
        ..Cells::default()
    }
    .into()
}

/// The last steps of a path, which name what is drawn where there is no room for all.
fn last(path: &str, between: char, steps: usize) -> String {
    let all: Vec<&str> = path.split(between).filter(|step| !step.is_empty()).collect();
    all[all.len().saturating_sub(steps)..].join(&between.to_string())
}

/// Edges of the columns of a map, halfway between the values of its axis; values that are texts or in no order stand side by side.
fn edges(x: &Along, columns: usize) -> (Vec<f64>, Axis) {
    let at = &x.places[..columns.min(x.places.len())];
    let ascending = at.windows(2).all(|pair| pair[0] < pair[1]);
    if !x.names.is_empty() || !ascending || at.len() < 2 {
        let names = at.iter().map(|place| x.text(*place)).collect();
        return ((0..=at.len()).map(|i| i as f64 - 0.5).collect(), Axis::named(x.label.clone(), names));
    }
    let scaled: Vec<f64> = at.iter().map(|value| if x.log { value.ln() } else { *value }).collect();
    let last = scaled.len() - 1;
    let middle = |i: usize| 0.5 * (scaled[i] + scaled[i + 1]);
    let mut edges = vec![2.0 * scaled[0] - middle(0)];
    edges.extend((0..last).map(middle));
    edges.push(2.0 * scaled[last] - middle(last - 1));
    let edges = edges.into_iter().map(|edge| if x.log { edge.exp() } else { edge }).collect();
    (edges, x.axis())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(places: Vec<f64>, log: bool) -> Along {
        Along { label: "a".into(), steps: places.len(), places, names: Vec::new(), log }
    }

    #[test]
    fn cells_end_halfway_between_values() {
        assert_eq!(edges(&along(vec![1.0, 2.0, 4.0], false), 3).0, [0.5, 1.5, 3.0, 5.0]);
        let (found, _) = edges(&along(vec![1.0, 100.0], true), 2);
        for (found, expected) in found.into_iter().zip([0.1, 10.0, 1000.0]) {
            assert!((found / expected - 1.0).abs() < 1e-12, "{found}");
        }
        let (found, axis) = edges(&along(vec![2.0, 1.0], false), 2);
        assert_eq!((found, axis.names), (vec![-0.5, 0.5, 1.5], vec!["2".to_owned(), "1".to_owned()]));
    }

    #[test]
    fn texts_have_places_in_the_order_they_come() {
        let values = ["b", "a", "b"].map(Value::from);
        assert_eq!(placed(&values), (vec![0.0, 1.0, 0.0], vec!["b".to_owned(), "a".to_owned()]));
        assert_eq!(placed(&[1.into(), 2.5.into()]), (vec![1.0, 2.5], Vec::new()));
    }
}
