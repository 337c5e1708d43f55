//! What cannot be drawn is refused with what was expected and what was found.

use unripple_plot::*;

fn plot(x: Vec<f64>, y: Vec<f64>) -> Plot {
    Plot { layers: vec![Line { x, y, label: "v".into(), ..Line::default() }.into()], ..Plot::default() }
}

fn refusal(panel: impl Into<Panel>) -> PlotError {
    Figure::of(panel).draw().unwrap_err()
}

#[test]
fn nothing_to_draw_is_refused() {
    assert!(matches!(Figure::default().draw(), Err(PlotError::Empty { .. })));
    assert!(matches!(refusal(Plot::default()), PlotError::Empty { .. }));
    assert!(matches!(refusal(Traces::default()), PlotError::Empty { .. }));
    assert!(matches!(refusal(Map::default()), PlotError::Empty { .. }));
    assert!(matches!(refusal(Scatter::default()), PlotError::Empty { .. }));
    assert!(matches!(refusal(Strip::default()), PlotError::Empty { .. }));
    assert!(matches!(refusal(Cells::default()), PlotError::Empty { .. }));
    let nan = refusal(plot(vec![0.0, 1.0], vec![f64::NAN, f64::INFINITY]));
    assert_eq!(nan.to_string(), "line `v`: expected at least one finite value, found 2 values, none finite");
}

#[test]
fn lengths_that_disagree_are_refused() {
    let found = refusal(plot(vec![0.0, 1.0], vec![0.0]));
    assert_eq!(found, PlotError::Length { what: "line `v`".into(), expected: 2, found: 1 });
    let grid = Grid { columns: 2, rows: 2, first: [0.0; 2], pitch: [1.0; 2], values: vec![1.0; 3] };
    assert!(matches!(
        refusal(Map { grid, ..Map::default() }),
        PlotError::Length { expected: 4, found: 3, .. }
    ));
    let places =
        |count: usize| Scatter { points: vec![[0.0; 2]; count], values: vec![1.0], ..Scatter::default() };
    assert!(matches!(refusal(places(2)), PlotError::Length { expected: 2, found: 1, .. }));
    // One point has no extent of its own; an outline gives it one.
    assert!(matches!(refusal(places(1)), PlotError::Range { .. }));
    let outline = vec![vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0]]];
    assert!(Figure::of(Scatter { outline, ..places(1) }).draw().is_ok());
    let table = |edges: [f64; 3]| Cells {
        edges: edges.to_vec(),
        rows: vec!["1".into(); 2],
        values: vec![1.0; if edges[1] < edges[2] { 3 } else { 4 }],
        ..Cells::default()
    };
    assert!(matches!(refusal(table([1.0, 2.0, 3.0])), PlotError::Length { expected: 4, found: 3, .. }));
    assert!(matches!(refusal(table([1.0, 3.0, 2.0])), PlotError::Range { .. }));
    let points = Points { x: vec![0.0; 2], y: vec![0.0; 2], error: vec![[1.0; 2]], ..Points::default() };
    let points = Plot { layers: vec![points.into()], ..Plot::default() };
    assert!(matches!(refusal(points), PlotError::Length { expected: 2, found: 1, .. }));
}

#[test]
fn what_is_not_positive_is_refused_on_logarithmic_axes() {
    let log = |x: Axis, y: Axis| Plot { x, y, ..plot(vec![0.5, 1.0], vec![0.0, 1.0]) };
    let found = refusal(log(Axis::default(), Axis::log("Contrast")));
    let expected =
        "axis `Contrast`: expected a positive value, 1e-100 or more, on a logarithmic axis, found 0";
    assert_eq!(found.to_string(), expected);
    assert!(matches!(refusal(log(Axis::log("T").from(-1.0), Axis::default())), PlotError::Range { .. }));
    assert!(Figure::of(log(Axis::log("T"), Axis::default())).draw().is_ok());
}

#[test]
fn values_too_far_apart_for_a_logarithm_are_refused() {
    let wide = |y: Vec<f64>| Plot { y: Axis::log("Gain"), ..plot(vec![0.0, 1.0], y) };
    assert!(matches!(refusal(wide(vec![5e-324, 1e100])), PlotError::Range { .. }));
    assert!(Figure::of(wide(vec![1e-100, 1e100])).draw().is_ok());
    let tiny = Plot { y: Axis::log("Gain").times(1e-200).from(1e-200), ..plot(vec![0.0, 1.0], vec![1.0; 2]) };
    assert!(matches!(refusal(tiny), PlotError::Range { .. }));
}

#[test]
fn options_out_of_range_are_refused() {
    let good = || plot(vec![0.0, 1.0], vec![0.0, 1.0]);
    let backwards = Plot { x: Axis::new("x").from(2.0).to(1.0), ..good() };
    assert!(matches!(refusal(backwards), PlotError::Range { .. }));
    let endless = Plot { x: Axis::new("x").to(f64::INFINITY), ..good() };
    assert!(matches!(refusal(endless), PlotError::Range { .. }));
    assert!(Figure { width_mm: 1.0, ..Figure::of(good()) }.draw().is_err());
    let drawing = Figure::of(good()).draw().unwrap();
    for dpi in [0.0, f64::NAN, 1e9] {
        assert!(matches!(drawing.png(dpi), Err(PlotError::Range { .. })));
    }
}

#[test]
fn data_all_alike_are_drawn_in_a_range_of_their_own() {
    for value in [0.0, 7.0, -3e-9, 1e30] {
        let drawing = Figure::of(plot(vec![1.0; 3], vec![value; 3])).draw().unwrap();
        let [x, y] = drawing.tick_labels(0).unwrap();
        assert!(x.len() >= 2 && y.len() >= 2, "{value}: {x:?} {y:?}");
        let grid = Grid { columns: 2, rows: 1, first: [0.0; 2], pitch: [1.0; 2], values: vec![value; 2] };
        for map in [ColourMap::Diverging, ColourMap::Sequential] {
            let colours = Colours { map, ..Colours::default() };
            Figure::of(Map { grid: grid.clone(), colours, ..Map::default() }).draw().unwrap();
        }
    }
    let log = Plot { y: Axis::log("C"), ..plot(vec![1.0, 2.0], vec![5.0, 5.0]) };
    assert!(Figure::of(log).draw().unwrap().tick_labels(0).unwrap()[1].len() >= 2);
}
