//! What was drawn, read back from the pixels and the text and compared with the data it was drawn from.

use resvg::usvg;
use unripple_plot::*;

const DPI: f64 = 300.0;

/// Pixels of a decoded picture, three bytes each.
struct Picture {
    width: usize,
    bytes: Vec<u8>,
}

impl Picture {
    fn of(drawing: &Drawing) -> Self {
        Self::decode(&drawing.png(DPI).unwrap())
    }

    fn decode(file: &[u8]) -> Self {
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        assert_eq!(info.color_type, png::ColorType::Rgb);
        bytes.truncate(info.buffer_size());
        Self { width: info.width as usize, bytes }
    }

    fn at(&self, [x, y]: [f64; 2]) -> Rgb {
        let i = 3 * (y as usize * self.width + x as usize);
        Rgb(self.bytes[i], self.bytes[i + 1], self.bytes[i + 2])
    }

    /// Whether a colour occurs within two pixels of a place.
    fn near(&self, [x, y]: [f64; 2], colour: Rgb) -> bool {
        (-2..=2)
            .any(|dx| (-2..=2).any(|dy| off(self.at([x + f64::from(dx), y + f64::from(dy)]), colour) <= 12))
    }
}

fn off(a: Rgb, b: Rgb) -> u8 {
    a.0.abs_diff(b.0).max(a.1.abs_diff(b.1)).max(a.2.abs_diff(b.2))
}

fn ramp(count: usize) -> Vec<f64> {
    (0..count).map(|i| i as f64 / (count - 1) as f64).collect()
}

#[test]
fn a_line_passes_through_its_data_and_leaves_gaps() {
    let x = ramp(101);
    let mut y: Vec<f64> = x.iter().map(|x| (6.0 * x).sin()).collect();
    y[40..45].fill(f64::NAN);
    y[70] = f64::INFINITY;
    let plot = Plot {
        layers: vec![Line { x: x.clone(), y: y.clone(), width_pt: Some(1.5), ..Line::default() }.into()],
        ..Plot::default()
    };
    let drawing = Figure::of(plot).draw().unwrap();
    let picture = Picture::of(&drawing);
    for i in [10, 25, 39, 45, 60, 90] {
        let at = drawing.pixel(0, [x[i], y[i]], DPI).unwrap();
        assert_eq!(picture.at(at), Rgb::palette(0), "{i}");
    }
    for i in [42, 70] {
        let at = drawing.pixel(0, [x[i], (6.0 * x[i]).sin()], DPI).unwrap();
        assert_eq!(picture.at(at), Rgb::WHITE, "{i}");
    }
    assert_eq!(drawing.pixel(0, [f64::NAN, 0.0], DPI), None);
    assert_eq!(drawing.pixel(1, [0.5, 0.0], DPI), None);
}

#[test]
fn decades_are_equally_far_apart_on_logarithmic_axes() {
    let plot = Plot {
        x: Axis::log("f (Hz)").from(1.0).to(1e4),
        y: Axis::log("C").from(0.1).to(10.0),
        layers: vec![Points { x: vec![10.0], y: vec![1.0], ..Points::default() }.into()],
        ..Plot::default()
    };
    let drawing = Figure::of(plot).draw().unwrap();
    let place = |x: f64, y: f64| drawing.pixel(0, [x, y], DPI).unwrap();
    let [first, second, last] = [place(1.0, 0.1), place(10.0, 1.0), place(1e4, 10.0)];
    assert!(((last[0] - first[0]) - 4.0 * (second[0] - first[0])).abs() < 1e-9);
    assert!(((first[1] - last[1]) - 2.0 * (first[1] - second[1])).abs() < 1e-9);
    assert_eq!(Picture::of(&drawing).at(second), Rgb::palette(0));
    assert_eq!(drawing.pixel(0, [-1.0, 1.0], DPI), None);
    assert_eq!(drawing.tick_labels(0).unwrap()[0], ["1", "10", "100", "1000", "10000"]);
}

#[test]
fn bands_spans_rules_and_error_bars_are_where_they_should_be() {
    let x = vec![0.0, 1.0, 2.0];
    let plot = Plot {
        x: Axis::new("x").times(10.0),
        y: Axis::new("y").from(-4.0).to(4.0),
        layers: vec![
            Span { from: 1.5, to: 1.8, ink: Ink::Rgb(Rgb::BLACK), ..Span::default() }.into(),
            Band { x: x.clone(), low: vec![-1.0; 3], high: vec![1.0; 3], ..Band::default() }.into(),
            Rule { at: 3.0, along: Along::X, dash: Dash::Solid, ..Rule::default() }.into(),
            Points {
                x: vec![0.5],
                y: vec![-2.0],
                error: vec![[1.0, 0.5]],
                ink: Ink::Palette(2),
                ..Points::default()
            }
            .into(),
        ],
        ..Plot::default()
    };
    let drawing = Figure::of(plot).draw().unwrap();
    let picture = Picture::of(&drawing);
    let near = |x: f64, y: f64, colour| picture.near(drawing.pixel(0, [x, y], DPI).unwrap(), colour);
    let at = |x: f64, y: f64| picture.at(drawing.pixel(0, [x, y], DPI).unwrap());
    assert!(off(at(1.0, 0.5), at(1.0, -0.5)) == 0 && at(1.0, 0.5) != Rgb::WHITE);
    assert_eq!(at(1.0, 1.5), Rgb::WHITE);
    assert!(off(at(1.65, 2.0), Rgb(199, 199, 199)) < 3);
    assert_eq!(at(1.9, 2.0), Rgb::WHITE);
    assert!(near(0.7, 3.0, Rgb::GREY));
    assert!(near(0.5, -2.0, Rgb::palette(2)) && near(0.5, -2.9, Rgb::palette(2)));
    assert!(near(0.5, -1.6, Rgb::palette(2)) && !near(0.5, -3.3, Rgb::palette(2)));
}

/// A square of 30 cells a side whose value is `value(x, y)`, off the disc of radius 1 round (1, 1) nothing.
fn disc(value: impl Fn(f64, f64) -> f64) -> (Grid, Vec<Ring>) {
    let pitch = 2.0 / 30.0;
    let mut grid =
        Grid { columns: 30, rows: 30, first: [pitch / 2.0; 2], pitch: [pitch; 2], values: Vec::new() };
    for i in 0..900 {
        let [x, y] = grid.centre(i % 30, i / 30);
        grid.values.push(if (x - 1.0).hypot(y - 1.0) <= 1.0 { value(x, y) } else { f64::NAN });
    }
    let ring =
        (0..180).map(|i| f64::from(i).to_radians() * 2.0).map(|a| [1.0 + a.cos(), 1.0 + a.sin()]).collect();
    (grid, vec![ring])
}

fn colours(map: ColourMap) -> Colours {
    Colours { map, title: "v (mm/s)".into(), low: Some(-2.0), high: Some(2.0), ..Colours::default() }
}

#[test]
fn a_map_shows_each_value_in_its_colour_the_right_way_up() {
    for map in [ColourMap::Diverging, ColourMap::Sequential] {
        let value = |x: f64, y: f64| 0.8 * (x - 1.0) - 1.1 * (y - 1.0);
        let (grid, outline) = disc(value);
        let figure = Figure::of(Map { grid, outline, colours: colours(map), ..Map::default() });
        let drawing = figure.draw().unwrap();
        let picture = Picture::of(&drawing);
        for (x, y) in [(1.0, 1.0), (0.3, 1.0), (1.7, 1.1), (1.0, 0.2), (0.9, 1.85), (1.6, 1.6)] {
            let found = picture.at(drawing.pixel(0, [x, y], DPI).unwrap());
            let expected = map.colour((value(x, y) + 2.0) / 4.0);
            assert!(off(found, expected) <= 6, "({x}, {y}): {found} for {expected}");
        }
        for (x, y) in [(0.06, 0.06), (1.95, 1.95), (0.05, 1.95)] {
            assert_eq!(picture.at(drawing.pixel(0, [x, y], DPI).unwrap()), Rgb::WHITE);
        }
        let rim = [1.0 + 0.6, 1.0 + 0.8];
        assert!(picture.near(drawing.pixel(0, rim, DPI).unwrap(), Rgb::BLACK));
    }
}

#[test]
fn a_scatter_shows_each_value_in_its_colour_at_its_point() {
    let places = [[1.0, 1.0], [0.3, 1.0], [1.7, 1.1], [1.0, 0.2], [0.9, 1.85], [1.6, 1.5]];
    let value = |[x, y]: [f64; 2]| 0.8 * (x - 1.0) - 1.1 * (y - 1.0);
    let empty = [0.5, 0.5];
    for map in [ColourMap::Diverging, ColourMap::Sequential] {
        let (_, outline) = disc(|_, _| 0.0);
        let points = places.into_iter().chain([empty]).collect();
        let values = places.into_iter().map(value).chain([f64::NAN]).collect();
        let scatter = Scatter { points, values, outline, colours: colours(map), ..Scatter::default() };
        let drawing = Figure::of(scatter).draw().unwrap();
        let picture = Picture::of(&drawing);
        for at in places {
            let found = picture.at(drawing.pixel(0, at, DPI).unwrap());
            let expected = map.colour((value(at) + 2.0) / 4.0);
            assert!(off(found, expected) <= 6, "{at:?}: {found} for {expected}");
        }
        for at in [empty, [1.3, 0.7]] {
            assert_eq!(picture.at(drawing.pixel(0, at, DPI).unwrap()), Rgb::WHITE, "{at:?}");
        }
        let rim = [1.0 + 0.6, 1.0 - 0.8];
        assert!(picture.near(drawing.pixel(0, rim, DPI).unwrap(), Rgb::BLACK));
    }
}

#[test]
fn colour_reaches_the_rim_but_a_hole_in_the_data_stays_open() {
    let (mut grid, outline) = disc(|_, _| 1.0);
    for (column, row) in [(10, 10), (11, 10), (10, 11), (11, 11)] {
        grid.values[row * 30 + column] = f64::NAN;
    }
    let hole = [grid.centre(10, 10)[0] + grid.pitch[0] / 2.0, grid.centre(10, 10)[1] + grid.pitch[1] / 2.0];
    let drawing = Figure::of(Map { grid, outline, colours: colours(ColourMap::Diverging), ..Map::default() })
        .draw()
        .unwrap();
    let picture = Picture::of(&drawing);
    let expected = ColourMap::Diverging.colour(0.75);
    for degrees in (0..360).step_by(15) {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        let inside = picture.at(drawing.pixel(0, [1.0 + 0.985 * cos, 1.0 + 0.985 * sin], DPI).unwrap());
        assert!(off(inside, expected) <= 6, "{degrees}: {inside}");
    }
    assert_eq!(picture.at(drawing.pixel(0, hole, DPI).unwrap()), Rgb::WHITE);
}

#[test]
fn a_signed_scale_is_symmetric_and_its_bar_says_so() {
    let (grid, outline) = disc(|x, _| 0.003 * x - 0.004);
    let colours = Colours { title: "Velocity (mm/s)".into(), multiplier: 1e3, ..Colours::default() };
    let drawing = Figure::of(Map { grid, outline, colours, ..Map::default() }).draw().unwrap();
    for label in ["−2", "0", "2", "Velocity (mm/s)", "x (mm)", "y (mm)"] {
        assert!(drawing.svg().contains(&format!(">{label}</text>")), "{label}");
    }
}

#[test]
fn the_picture_has_the_size_and_resolution_asked_for() {
    let plot =
        Plot { layers: vec![Line { x: ramp(2), y: ramp(2), ..Line::default() }.into()], ..Plot::default() };
    let drawing = Figure::of(plot).draw().unwrap();
    for dpi in [96.0, 150.0, 300.0, 600.0] {
        let file = drawing.png(dpi).unwrap();
        let reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().unwrap();
        let expected = 85.0 / 25.4 * dpi;
        assert!((f64::from(reader.info().width) - expected).abs() <= 1.0);
        let density = reader.info().pixel_dims.unwrap();
        assert_eq!(density.xppu, (dpi / 0.0254).round() as u32);
    }
}

#[test]
fn every_label_is_in_the_text_and_the_text_is_valid() {
    let hostile = "<script>&\"' ]]> \u{1} 漢";
    let line = |label: &str| Line { x: ramp(3), y: ramp(3), label: label.into(), ..Line::default() };
    let plot = Plot {
        x: Axis::new("Time (ms)"),
        y: Axis::new(hostile),
        layers: vec![
            line("first & last").into(),
            line("λ = 15 mm").into(),
            Note { at: [0.5, 0.5], text: "√T".into(), ..Note::default() }.into(),
            Rule { at: 0.5, label: hostile.into(), ..Rule::default() }.into(),
        ],
        title: "Title <1>".into(),
        ..Plot::default()
    };
    let traces = Traces {
        traces: vec![Trace::new("a1 <x>", ramp(10))],
        unit: "µm & more".into(),
        ..Traces::default()
    };
    let panels = vec![plot.into(), traces.into()];
    let drawing = Figure { panels, description: hostile.into(), ..Figure::default() }.draw().unwrap();
    let svg = drawing.svg();
    for label in
        ["Time (ms)", "first &amp; last", "λ = 15 mm", "√T", "Title &lt;1&gt;", "a1 &lt;x&gt;", "(a)", "(b)"]
    {
        assert!(svg.contains(&format!(">{label}</text>")), "{label}");
    }
    assert!(!svg.contains("<script>") && svg.contains("0.5 µm &amp; more"));
    usvg::Tree::from_str(svg, &usvg::Options::default()).unwrap();
}

#[test]
fn traces_keep_their_lanes_and_share_their_scale() {
    let step: Vec<f64> = (0..100).map(|i| if i < 50 { 0.0 } else { 1.0 }).collect();
    let half: Vec<f64> = step.iter().map(|v| 0.5 * v).collect();
    let traces = vec![
        Trace { ink: Ink::Palette(1), ..Trace::new("one", step) },
        Trace { ink: Ink::Palette(2), ..Trace::new("half", half) },
    ];
    let drawing = Figure::of(Traces { traces, unit: "N".into(), ..Traces::default() }).draw().unwrap();
    let picture = Picture::of(&drawing);
    // Lanes are counted from the foot; each keeps 6 % clear at both edges.
    let at = |lane: f64, share: f64| drawing.pixel(0, [75.0, lane + 0.06 + 0.88 * share], DPI).unwrap();
    assert!(picture.near(at(1.0, 1.0), Rgb::palette(1)) && !picture.near(at(1.0, 0.5), Rgb::palette(1)));
    assert!(picture.near(at(0.0, 0.5), Rgb::palette(2)) && !picture.near(at(0.0, 1.0), Rgb::palette(2)));
}

#[test]
fn cells_are_one_colour_each_the_first_row_at_the_top() {
    let (rows, columns) = (6, 4);
    let value = |row: usize, column: usize| (row * columns + column) as f64;
    let mut values: Vec<f64> = (0..rows * columns).map(|i| value(i / columns, i % columns)).collect();
    values[2 * columns + 1] = f64::NAN;
    let edges: Vec<f64> = (0..=columns).map(|i| 100.0 * 2f64.powi(i as i32)).collect();
    let cells = Cells {
        edges: edges.clone(),
        rows: (1..=rows).map(|row| format!("p{row}")).collect(),
        values,
        x: Axis::log("Frequency (Hz)").from(50.0).to(1600.0),
        colours: Colours {
            map: ColourMap::Sequential,
            low: Some(0.0),
            high: Some(20.0),
            ..Colours::default()
        },
        ..Cells::default()
    };
    let drawing = Figure::of(cells.clone()).draw().unwrap();
    let picture = Picture::of(&drawing);
    for row in 0..rows {
        for (column, left) in edges[..columns].iter().enumerate() {
            // Near all four corners of the cell: no colour runs into the next.
            for (a, b) in [(0.1, 0.1), (0.9, 0.1), (0.1, 0.9), (0.9, 0.9)] {
                let at = [left * 2f64.powf(a), (rows - row) as f64 - b];
                let found = picture.at(drawing.pixel(0, at, DPI).unwrap());
                let expected = match (row, column) {
                    (2, 1) => Rgb::WHITE,
                    _ => ColourMap::Sequential.colour(value(row, column) / 20.0),
                };
                assert!(off(found, expected) <= 3, "{row} {column}: {found} for {expected}");
            }
        }
    }
    assert_eq!(picture.at(drawing.pixel(0, [70.0, 3.0], DPI).unwrap()), Rgb::WHITE, "beside all columns");
    assert_eq!(drawing.tick_labels(0).unwrap()[1], ["p1", "p2", "p3", "p4", "p5", "p6"]);
    // Of many rows some are named.
    let many = Cells {
        rows: (1..=240).map(|row| row.to_string()).collect(),
        values: vec![1.0; 240 * columns],
        ..cells
    };
    let names = Figure::of(many).draw().unwrap().tick_labels(0).unwrap()[1].clone();
    assert_eq!(names[..3], ["5", "10", "15"], "{names:?}");
}

#[test]
fn things_are_named_where_they_stand() {
    let names = ["glass", "film", "steel"].map(String::from).to_vec();
    let of = |names: Vec<String>| {
        let places: Vec<f64> = (0..names.len()).map(|i| i as f64).collect();
        let layers = vec![Points { x: vec![1.0; places.len()], y: places, ..Points::default() }.into()];
        let y = Axis::named("Surface", names);
        Figure::of(Plot { y, layers, height_mm: Some(30.0), ..Plot::default() }).draw().unwrap()
    };
    let drawing = of(names.clone());
    assert_eq!(drawing.tick_labels(0).unwrap()[1], names);
    for (place, name) in names.iter().enumerate() {
        let [_, y] = drawing.pixel(0, [1.0, place as f64], 72.0).unwrap();
        let label = drawing.labels().iter().find(|label| label.text == *name).unwrap();
        assert!(label.upper_left[1] < y && y < label.lower_right[1], "{label:?} at {y}");
    }
    // Of many things some are named, the first among them.
    let many: Vec<String> = (0..200).map(|i| i.to_string()).collect();
    let told = of(many).tick_labels(0).unwrap()[1].clone();
    assert!((2..20).contains(&told.len()) && told[0] == "0", "{told:?}");
    // Of a long name both ends are written.
    let long = vec!["a film of a long name, sheet.tension_n_per_m=200".to_owned()];
    assert_eq!(of(long).tick_labels(0).unwrap()[1], ["a film of a lo…n_n_per_m=200"]);
}
