//! What holds for any data: nothing panics, the text is valid, the same data give the same bytes.

use proptest::prelude::*;
use resvg::usvg;
use unripple_plot::*;

/// Any number a program may come up with, the odd ones often.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -1e3..1e3f64,
        1 => any::<f64>(),
        1 => prop::sample::select(vec![0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e308, -1e308, 5e-324, 1e-300]),
    ]
}

fn numbers() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(number(), 0..30)
}

/// Either a typed error, or a valid drawing whose picture can be made.
fn drawn(figure: &Figure) {
    if let Ok(drawing) = figure.draw() {
        usvg::Tree::from_str(drawing.svg(), &usvg::Options::default()).unwrap();
        if let Err(error) = drawing.png(20.0) {
            panic!("{error}");
        }
        assert_eq!(figure.draw().unwrap().svg(), drawing.svg());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn any_plot_is_drawn_or_refused(
        x in numbers(), y in numbers(), error in number(), at in number(), label in ".{0,12}",
        log in any::<[bool; 2]>(), ends in prop::option::of((number(), number())), multiplier in number(),
    ) {
        let count = x.len().min(y.len());
        let (x, y) = (x[..count].to_vec(), y[..count].to_vec());
        let scale = |log| if log { Scale::Logarithmic } else { Scale::Linear };
        let (low, high) = (ends.map(|e| e.0), ends.map(|e| e.1));
        let plot = Plot {
            x: Axis { label: label.clone(), scale: scale(log[0]), multiplier, low, high, ..Axis::default() },
            y: Axis { scale: scale(log[1]), ..Axis::new(label.clone()) },
            layers: vec![
                Line { x: x.clone(), y: y.clone(), label: label.clone(), ..Line::default() }.into(),
                Points { x: x.clone(), y: y.clone(), error: vec![[error; 2]; count], ..Points::default() }.into(),
                Band { x, low: y.clone(), high: y, ..Band::default() }.into(),
                Rule { at, label: label.clone(), ..Rule::default() }.into(),
                Rule { at, along: Along::X, label: label.clone(), ..Rule::default() }.into(),
                Note { at: [at; 2], text: label, ..Note::default() }.into(),
            ],
            ..Plot::default()
        };
        drawn(&Figure::of(plot));
    }

    #[test]
    fn any_traces_are_drawn_or_refused(
        values in prop::collection::vec(numbers(), 0..6), start in number(), step in number(), own_scales in any::<bool>(),
    ) {
        let traces = values.into_iter().map(|values| Trace::new("a", values)).collect();
        drawn(&Figure::of(Traces { traces, start, step, own_scales, ..Traces::default() }));
    }

    #[test]
    fn any_map_is_drawn_or_refused(
        columns in 0usize..9, rows in 0usize..9, seed in prop::collection::vec(number(), 64), pitch in number(),
        end in prop::option::of(number()), sequential in any::<bool>(), ring in prop::collection::vec(any::<[f32; 2]>(), 0..5),
    ) {
        let grid = Grid { columns, rows, first: [0.0; 2], pitch: [pitch.abs(), 1.0], values: seed[..columns * rows].to_vec() };
        let map = if sequential { ColourMap::Sequential } else { ColourMap::Diverging };
        let colours = Colours { map, high: end, ..Colours::default() };
        let outline = vec![ring.iter().map(|p| p.map(f64::from)).collect()];
        drawn(&Figure::of(Map { grid: grid.clone(), outline: outline.clone(), colours: colours.clone(), ..Map::default() }));
        let shot = Shot { grid, caption: "t".into() };
        let movie = Movie { shots: vec![shot.clone(), shot.clone()], colours: colours.clone(), width_px: 150, ..Movie::default() };
        if (0.05..20.0).contains(&pitch.abs()) {
            let _ = movie.apng();
        }
        drawn(&Figure::of(Strip { shots: vec![shot.clone(), shot], colours, ..Strip::default() }));
    }

    #[test]
    fn any_scatter_is_drawn_or_refused(
        x in numbers(), y in numbers(), seed in prop::collection::vec(number(), 30), high in prop::option::of(number()),
        ring in prop::collection::vec(any::<[f32; 2]>(), 0..5), title in ".{0,60}",
    ) {
        let points: Vec<[f64; 2]> = x.iter().zip(&y).map(|(x, y)| [*x, *y]).collect();
        let values = seed[..points.len()].to_vec();
        let colours = Colours { high, map: ColourMap::Sequential, ..Colours::default() };
        let outline = vec![ring.iter().map(|p| p.map(f64::from)).collect()];
        drawn(&Figure::of(Scatter { points, values, outline, colours, title, ..Scatter::default() }));
    }

    #[test]
    fn any_cells_are_drawn_or_refused(
        edges in numbers(), rows in 0usize..7, seed in prop::collection::vec(number(), 210), log in any::<bool>(),
        height in prop::option::of(number()), high in prop::option::of(number()), name in ".{0,12}",
    ) {
        let mut edges = edges;
        edges.sort_unstable_by(f64::total_cmp);
        let values = seed[..rows * edges.len().saturating_sub(1)].to_vec();
        let x = Axis { scale: if log { Scale::Logarithmic } else { Scale::Linear }, ..Axis::new(name.clone()) };
        let colours = Colours { high, map: ColourMap::Sequential, ..Colours::default() };
        let rows = vec![name.clone(); rows];
        drawn(&Figure::of(Cells { edges, rows, values, x, label: name.clone(), colours, title: name, height_mm: height }));
    }

    #[test]
    fn ticks_are_few_nice_and_inside(low in -1e6..1e6f64, span in 1e-3..1e6f64, most in 1usize..12) {
        let ticks = nice_ticks(low, low + span, most);
        prop_assert!(ticks.len() <= most);
        prop_assert!(ticks.iter().all(|tick| (low..=low + span).contains(tick)));
        prop_assert!(most < 4 || ticks.len() >= most / 3, "{ticks:?}");
    }
}
