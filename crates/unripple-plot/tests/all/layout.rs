//! Text of figures as wide as one column of a page and as two: none leaves the page, none lies over another, all is of one size.

use unripple_plot::*;

/// Widths of one column and of two in mm, each with the panels side by side.
const WIDTHS: [(f64, usize); 2] = [(86.0, 1), (178.0, 2)];

fn square() -> Vec<Ring> {
    vec![vec![[0.0, 0.0], [0.15, 0.0], [0.15, 0.15], [0.0, 0.15]]]
}

fn colours(title: &str, map: ColourMap, multiplier: f64) -> Colours {
    Colours { title: title.into(), map, multiplier, ..Colours::default() }
}

fn map(title: &str, colours: Colours) -> Panel {
    let mut grid = Grid { columns: 30, rows: 30, first: [2.5e-3; 2], pitch: [5e-3; 2], values: Vec::new() };
    for i in 0..900 {
        let [x, y] = grid.centre(i % 30, i / 30);
        grid.values.push(0.043 * (60.0 * x).sin() * (40.0 * y).cos());
    }
    Map { grid, outline: square(), colours, title: title.into(), ..Map::default() }.into()
}

fn scatter(title: &str, colours: Colours) -> Panel {
    let points: Vec<[f64; 2]> =
        (0..81).map(|i| [0.015 * f64::from(i % 9 + 1), 0.015 * f64::from(i / 9 + 1)]).collect();
    let values =
        points.iter().map(|[x, y]| 0.043 * (60.0 * x).sin().abs() * (40.0 * y).cos().abs()).collect();
    Scatter { points, values, outline: square(), colours, title: title.into(), ..Scatter::default() }.into()
}

fn traces(title: &str, unit: &str, rule: f64) -> Panel {
    let wave = |k: f64| (0..2881).map(|i| 0.7 * (f64::from(i) * 0.01 * k).sin()).collect::<Vec<f64>>();
    let names = ["(62, 90) mm", "(112.5, 60) mm", "shape (75, 75) mm"];
    let lanes = (1..).zip(names).map(|(k, name)| Trace::new(name, wave(f64::from(k))));
    Traces {
        x: Axis::new("Time (ms)").times(1e3),
        step: 1.0 / 48e3,
        traces: lanes.collect(),
        unit: unit.into(),
        rules: vec![Rule { at: rule, label: "focal instant of the first target".into(), ..Rule::default() }],
        title: title.into(),
        ..Traces::default()
    }
    .into()
}

fn plot(label: &str, title: &str) -> Panel {
    let x: Vec<f64> = (0..40).map(|i| 1.0 + 0.18 * f64::from(i)).collect();
    let line = |name: &str, gain: f64| Line {
        x: x.clone(),
        y: x.iter().map(|x| gain * x.sqrt()).collect(),
        label: name.into(),
        ..Line::default()
    };
    let layers =
        vec![line("inverse", 20.0).into(), line("concentrate", 30.0).into(), line("robust", 25.0).into()];
    let (x, y) = (Axis::log(label), Axis::log("Contrast"));
    Plot { x, y, layers, title: title.into(), ..Plot::default() }.into()
}

fn things(label: &str) -> Panel {
    let names =
        ["sheet.tension_n_per_m=400", "sheet.tension_n_per_m=200", "A film"].map(String::from).to_vec();
    let marks = |label: &str, x: [f64; 3]| -> Layer {
        Points { x: x.to_vec(), y: vec![0.0, 1.0, 2.0], label: label.into(), ..Points::default() }.into()
    };
    let layers = vec![marks("time-reversal", [28.0, 27.0, 31.0]), marks("concentrate", [125.0, 99.0, 110.0])];
    Plot { x: Axis::log(label), y: Axis::named("", names), layers, ..Plot::default() }.into()
}

/// What tasks draw: two maps, two scatters, traces, curves, marks for each of several things.
fn figures() -> Vec<Vec<Panel>> {
    let velocity = |map| colours("Velocity (mm/s)", map, 1e3);
    let displacement = |map| colours("Displacement (µm)", map, 1e3);
    let later =
        "when largest at the first target, t = 30.17 ms, 0.17 ms after the focal instant of the first target";
    vec![
        vec![
            map("at the focal instant, t = 30.00 ms", velocity(ColourMap::Diverging)),
            map(later, displacement(ColourMap::Diverging)),
        ],
        vec![
            scatter("largest over time", velocity(ColourMap::Sequential)),
            scatter(later, displacement(ColourMap::Sequential)),
        ],
        vec![
            traces("velocity at the targets, of a shape at its first point", "m/s", 0.0),
            traces("displacement at the targets, of a shape at its first point", "µm", 0.06),
        ],
        vec![
            plot(
                "Energy for the same peak, time reversal = 1",
                "A title that is far longer than its panel is wide, by some words",
            ),
            plot("Peak at the drive limit, time reversal = 1", ""),
            plot("Ratio", "Contrast"),
        ],
        vec![things("Contrast"), things("Energy, time reversal = 1")],
    ]
}

#[test]
fn no_text_leaves_the_page_or_lies_over_another() {
    for panels in figures() {
        for (width_mm, columns) in WIDTHS {
            let drawing =
                Figure { width_mm, columns, panels: panels.clone(), ..Figure::default() }.draw().unwrap();
            let ([width, height], labels) = (drawing.size_pt(), drawing.labels());
            assert!(labels.len() > 10, "{labels:?}");
            for (i, label) in labels.iter().enumerate() {
                let ([left, top], [right, bottom]) = (label.upper_left, label.lower_right);
                let on_page = left >= 0.0 && top >= 0.0 && right <= width && bottom <= height;
                assert!(on_page, "{label:?} on a page of {width} x {height} pt");
                for other in &labels[i + 1..] {
                    let beside = right <= other.upper_left[0] || other.lower_right[0] <= left;
                    let apart = beside || bottom <= other.upper_left[1] || other.lower_right[1] <= top;
                    assert!(apart, "{label:?} over {other:?} at {width_mm} mm");
                }
            }
        }
    }
}

#[test]
fn text_is_as_large_in_one_column_as_in_two() {
    for panels in figures() {
        for (width_mm, columns) in WIDTHS {
            let drawing =
                Figure { width_mm, columns, panels: panels.clone(), ..Figure::default() }.draw().unwrap();
            let sizes =
                drawing.svg().split("font-size=\"").skip(1).map(|rest| rest.split('"').next().unwrap());
            let sizes: Vec<&str> = sizes.collect();
            assert_eq!(sizes.len(), drawing.labels().len());
            assert!(sizes.iter().all(|size| ["7", "8"].contains(size)), "{sizes:?}");
        }
    }
}

#[test]
fn a_box_is_where_its_text_is_drawn() {
    let panel = map("at the focal instant", colours("Velocity (mm/s)", ColourMap::Diverging, 1e3));
    let drawing = Figure::of(panel).draw().unwrap();
    let file = drawing.png(300.0).unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let (width, height) = (info.width as usize, info.height as usize);
    let dark = |x: usize, y: usize| bytes[3 * (y * width + x)..][..3].iter().all(|channel| *channel < 100);
    // Pixels of a length in points, as far as the picture goes.
    let pixel = |point: f64, end: usize| ((point * 300.0 / 72.0).round() as usize).min(end);
    for text in ["at the focal instant", "x (mm)", "y (mm)", "Velocity (mm/s)"] {
        let label = drawing.labels().iter().find(|label| label.text == text).unwrap();
        let across = pixel(label.upper_left[0], width)..pixel(label.lower_right[0], width);
        let down = pixel(label.upper_left[1], height)..pixel(label.lower_right[1], height);
        let inked =
            down.clone().flat_map(|y| across.clone().map(move |x| (x, y))).filter(|(x, y)| dark(*x, *y));
        let all = across.len() * down.len();
        let share = inked.count() as f64 / all as f64;
        assert!((0.05..0.5).contains(&share), "{text}: {share} of its box is inked");
    }
}
