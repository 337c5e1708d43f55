//! The data of a figure as comma-separated values (RFC 4180), for whoever draws it again.

use crate::grid::Grid;
use crate::{Axis, Cells, Colours, Figure, Layer, Map, Panel, Plot, Scatter, Strip, Traces};
use std::fmt::Write;

/// Significant digits of a value: more than any picture shows, few enough that products with a power of ten read well.
const DIGITS: usize = 9;

impl Figure {
    /// The data of each panel as comma-separated values (RFC 4180), in the units that the figure shows, with a heading line. A value that
    /// is not finite is an empty field; cells of maps and points of scatters without a value are left out.
    ///
    /// ```
    /// use unripple_plot::{Axis, Figure, Line, Plot};
    /// let line = Line { x: vec![0.0, 1e-3], y: vec![0.0, 2e-3], label: "focus".into(), ..Line::default() };
    /// let (x, y) = (Axis::new("Time (ms)").times(1e3), Axis::new("Velocity (mm/s)").times(1e3));
    /// let figure = Figure::of(Plot { x, y, layers: vec![line.into()], ..Plot::default() });
    /// assert_eq!(figure.tables(), ["series,Time (ms),Velocity (mm/s)\r\nfocus,0,0\r\nfocus,1,2\r\n"]);
    /// ```
    pub fn tables(&self) -> Vec<String> {
        self.panels.iter().map(Panel::table).collect()
    }
}

impl Panel {
    fn table(&self) -> String {
        match self {
            Self::Plot(plot) => of_plot(plot),
            Self::Traces(traces) => of_traces(traces),
            Self::Map(map) => of_map(map),
            Self::Scatter(scatter) => of_scatter(scatter),
            Self::Strip(strip) => of_strip(strip),
            Self::Cells(cells) => of_cells(cells),
        }
    }
}

/// A table under construction.
struct Table(String);

impl Table {
    fn new(headings: &[&str]) -> Self {
        let mut table = Self(String::new());
        table.line(&headings.iter().map(|heading| text(heading)).collect::<Vec<_>>());
        table
    }

    fn line(&mut self, fields: &[String]) {
        let _ = write!(self.0, "{}\r\n", fields.join(","));
    }

    /// A line of a name and numbers.
    fn row(&mut self, name: &str, numbers: &[f64]) {
        let fields: Vec<String> =
            std::iter::once(text(name)).chain(numbers.iter().map(|n| number(*n))).collect();
        self.line(&fields);
    }
}

/// A field that holds text; quoted where it has to be.
fn text(text: &str) -> String {
    match text.contains([',', '"', '\r', '\n']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

/// A field that holds a number, or nothing if it is not finite.
fn number(value: f64) -> String {
    let rounded = format!("{value:.*e}", DIGITS - 1).parse::<f64>();
    rounded.ok().filter(|value| value.is_finite()).map_or_else(String::new, |value| value.to_string())
}

/// A field that holds a value along an axis: a number, or the name of a thing.
fn along(axis: &Axis, value: f64) -> String {
    let shown = value * axis.multiplier;
    let mut things = axis.names.iter().enumerate();
    let named = things.find(|(place, _)| *place as f64 == shown);
    named.map_or_else(|| number(shown), |(_, name)| text(name))
}

fn heading<'a>(label: &'a str, otherwise: &'a str) -> &'a str {
    if label.is_empty() { otherwise } else { label }
}

fn of_plot(plot: &Plot) -> String {
    let mut table = Table::new(&["series", heading(&plot.x.label, "x"), heading(&plot.y.label, "y")]);
    let mut curve = |name: &str, x: &[f64], y: &[f64]| {
        let pairs = x.iter().zip(y);
        pairs.for_each(|(x, y)| table.line(&[text(name), along(&plot.x, *x), along(&plot.y, *y)]));
    };
    for layer in &plot.layers {
        match layer {
            Layer::Line(line) => curve(&line.label, &line.x, &line.y),
            Layer::Points(points) => {
                curve(&points.label, &points.x, &points.y);
                if !points.error.is_empty() {
                    let ends = points.y.iter().zip(&points.error);
                    let [low, high]: [Vec<f64>; 2] = [
                        ends.clone().map(|(y, e)| y - e[0]).collect(),
                        ends.map(|(y, e)| y + e[1]).collect(),
                    ];
                    curve(&format!("{} (lower end)", points.label), &points.x, &low);
                    curve(&format!("{} (upper end)", points.label), &points.x, &high);
                }
            }
            Layer::Band(band) => {
                curve(&format!("{} (lower end)", band.label), &band.x, &band.low);
                curve(&format!("{} (upper end)", band.label), &band.x, &band.high);
            }
            // They point at values, and are none of the data.
            Layer::Rule(_) | Layer::Span(_) | Layer::Note(_) => {}
        }
    }
    table.0
}

fn of_traces(traces: &Traces) -> String {
    let unit = format!("value ({})", traces.unit);
    let mut table = Table::new(&["trace", heading(&traces.x.label, "x"), &unit]);
    for trace in &traces.traces {
        for (i, value) in trace.values.iter().enumerate() {
            let x = (traces.start + i as f64 * traces.step) * traces.x.multiplier;
            table.row(&trace.label, &[x, value * traces.multiplier]);
        }
    }
    table.0
}

fn of_map(map: &Map) -> String {
    let [x, y] = ["x", "y"].map(|axis| format!("{axis} ({})", map.unit));
    let mut table = Table::new(&[&x, &y, heading(&map.colours.title, "value")]);
    each(&map.grid, map.multiplier, &map.colours, |[x, y, value]| table.line(&[x, y, value]));
    table.0
}

fn of_scatter(scatter: &Scatter) -> String {
    let [x, y] = ["x", "y"].map(|axis| format!("{axis} ({})", scatter.unit));
    let mut table = Table::new(&[&x, &y, heading(&scatter.colours.title, "value")]);
    let known = scatter.points.iter().zip(&scatter.values).filter(|(_, value)| value.is_finite());
    for ([x, y], value) in known {
        let (unit, shown) = (scatter.multiplier, scatter.colours.multiplier);
        table.line(&[x * unit, y * unit, value * shown].map(number));
    }
    table.0
}

fn of_strip(strip: &Strip) -> String {
    let [x, y] = ["x", "y"].map(|axis| format!("{axis} ({})", strip.unit));
    let mut table = Table::new(&["picture", &x, &y, heading(&strip.colours.title, "value")]);
    for shot in &strip.shots {
        each(&shot.grid, strip.multiplier, &strip.colours, |[x, y, value]| {
            table.line(&[text(&shot.caption), x, y, value]);
        });
    }
    table.0
}

/// Shows `take` the centre and the value of each cell that has one.
fn each(grid: &Grid, multiplier: f64, colours: &Colours, mut take: impl FnMut([String; 3])) {
    for (i, value) in grid.values.iter().enumerate().filter(|(_, value)| value.is_finite()) {
        let [x, y] = grid.centre(i % grid.columns.max(1), i / grid.columns.max(1));
        take([x * multiplier, y * multiplier, value * colours.multiplier].map(number));
    }
}

fn of_cells(cells: &Cells) -> String {
    let Axis { label, multiplier, .. } = &cells.x;
    let [from, to] = ["from", "to"].map(|end| format!("{end} {}", heading(label, "x")));
    let mut table =
        Table::new(&[heading(&cells.label, "row"), &from, &to, heading(&cells.colours.title, "value")]);
    let columns = cells.edges.len().saturating_sub(1).max(1);
    for (name, values) in cells.rows.iter().zip(cells.values.chunks(columns)) {
        for (edges, value) in cells.edges.windows(2).zip(values) {
            table
                .row(name, &[edges[0] * multiplier, edges[1] * multiplier, value * cells.colours.multiplier]);
        }
    }
    table.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Band, Points, Shot, Trace};

    #[test]
    fn every_kind_of_panel_has_a_table() {
        let points = Points {
            x: vec![1.0],
            y: vec![2.0],
            error: vec![[0.5, 1.0]],
            label: "a, b".into(),
            ..Points::default()
        };
        let band = Band {
            x: vec![0.0],
            low: vec![-1.0],
            high: vec![f64::NAN],
            label: "range".into(),
            ..Band::default()
        };
        let plot = Plot { layers: vec![points.into(), band.into()], ..Plot::default() };
        let traces = Traces {
            start: 0.5,
            step: 0.25,
            traces: vec![Trace::new("a1", vec![1.0, f64::NAN])],
            unit: "N".into(),
            ..Traces::default()
        };
        let grid =
            Grid { columns: 2, rows: 1, first: [0.0105, 0.0], pitch: [1e-3; 2], values: vec![f64::NAN, 3.0] };
        let map = Map { grid: grid.clone(), ..Map::default() };
        let scatter = Scatter {
            points: vec![[0.0105, 0.0], [0.02, 0.01]],
            values: vec![3e-3, f64::NAN],
            colours: Colours { title: "Velocity (mm/s)".into(), multiplier: 1e3, ..Colours::default() },
            ..Scatter::default()
        };
        let strip = Strip { shots: vec![Shot { grid, caption: "0.1 ms".into() }], ..Strip::default() };
        let cells = Cells {
            edges: vec![1.0, 2.0, 4.0],
            rows: vec!["7".into()],
            values: vec![5.0, f64::NAN],
            ..Cells::default()
        };
        let figure = Figure {
            panels: vec![plot.into(), traces.into(), map.into(), scatter.into(), strip.into(), cells.into()],
            ..Figure::default()
        };
        let expected = [
            "series,x,y\r\n\"a, b\",1,2\r\n\"a, b (lower end)\",1,1.5\r\n\"a, b (upper end)\",1,3\r\nrange (lower end),0,-1\r\nrange (upper end),0,\r\n",
            "trace,x,value (N)\r\na1,0.5,1\r\na1,0.75,\r\n",
            "x (mm),y (mm),value\r\n11.5,0,3\r\n",
            "x (mm),y (mm),Velocity (mm/s)\r\n10.5,0,3\r\n",
            "picture,x (mm),y (mm),value\r\n0.1 ms,11.5,0,3\r\n",
            "row,from x,to x,value\r\n7,1,2,5\r\n7,2,4,\r\n",
        ];
        assert_eq!(figure.tables(), expected);
    }

    #[test]
    fn things_are_told_by_their_names() {
        let points =
            Points { x: vec![28.0, 125.0], y: vec![1.0, 0.0], label: "a".into(), ..Points::default() };
        let y = Axis::named("Surface", vec!["glass, thick".into(), "film".into()]);
        let figure = Figure::of(Plot { y, layers: vec![points.into()], ..Plot::default() });
        assert_eq!(figure.tables(), ["series,x,Surface\r\na,28,film\r\na,125,\"glass, thick\"\r\n"]);
    }
}
