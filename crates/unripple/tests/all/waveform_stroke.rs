//! A focus that moves along a path, on the paper's surface.

use unripple::core::{Point, Responses};
use unripple::field::Field;
use unripple::focus::{Line, Pattern, PulseOptions, Stroke, strike};
use unripple::physics::design::papers_surface;
use unripple::physics::{ResponseOptions, responses};

/// Places measured for each pulse.
const BETWEEN: usize = 4;

fn line(from: Point, to: Point) -> Pattern {
    Pattern { lines: vec![Line { points: vec![from, to], closed: false }], filled: false }
}

/// Least and greatest level along the path in dB: of each place at the pulse nearest in time to when the focus passes it, and the largest
/// within half an interval of that.
fn evenness(stroke: &Stroke, model: &Responses, plant: &Responses) -> [[f64; 2]; 2] {
    let pulses = stroke.pulses(model).unwrap();
    let struck = strike(model, &pulses, &PulseOptions::default()).unwrap();
    let drive = struck.drive.as_emitted();
    let (rate, asked) = (drive.rate(), stroke.level * struck.scale);
    let steps = BETWEEN * (pulses.len() - 1);
    let end = pulses[pulses.len() - 1].instant;
    let times: Vec<f64> = (0..=steps).map(|i| end * i as f64 / steps as f64).collect();
    let places: Vec<Point> = times.iter().map(|t| stroke.place(*t)).collect();
    let field = Field::new(plant, &drive, 1.0).unwrap();
    let traces = field.traces(&places, drive.duration() - 1.0 / rate).unwrap();
    let half = (end / (pulses.len() - 1) as f64 / 2.0 * rate) as usize;
    let mut found = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    for (i, trace) in traces.iter().enumerate() {
        let passes = struck.instants[0] + (times[i] * rate).round() as usize;
        let near = passes.saturating_sub(half)..(passes + half + 1).min(trace.velocity.len());
        let largest = trace.velocity[near].iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let pulse = trace.velocity[struck.instants[(i + BETWEEN / 2) / BETWEEN]].abs();
        for (range, v) in found.iter_mut().zip([pulse, largest]) {
            let db = 20.0 * (v / asked).log10();
            *range = [range[0].min(db), range[1].max(db)];
        }
    }
    println!("{} pulses, level {:.3?} dB, largest {:.3?} dB", pulses.len(), found[0], found[1]);
    found
}

/// 100 mm/s: within 1 dB everywhere along the path, between pulses too, on a plant with modes to twice the band.
#[test]
fn a_stroke_is_even_along_its_path() {
    let surface = papers_surface();
    let model = responses(&surface, &ResponseOptions::default()).unwrap();
    let wide = ResponseOptions { max_hz: Some(6000.0), ..ResponseOptions::default() };
    let plant = responses(&surface, &wide).unwrap();
    let across = line(Point::from_mm(40.0, 50.0), Point::from_mm(110.0, 90.0));
    let round = Pattern::circle(Point::from_mm(75.0, 75.0), 0.015);
    for (path, alternating) in [(across.clone(), false), (across, true), (round, false)] {
        let stroke = Stroke { level: 10e-3, alternating, ..Stroke::along(path, 0.1) };
        for [least, most] in evenness(&stroke, &model, &plant) {
            assert!(least > -1.0 && most < 1.0, "{least} {most}");
        }
    }
}
