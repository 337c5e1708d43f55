//! Pictures of a search: the value of each design in turn, or the trade-offs between each two objectives.

use super::front::Front;
use super::told::{Told, turned};
use unripple_plot::{Axis, Figure, Ink, Line, Panel, Plot, Points};
use unripple_store::Objective;

/// Most pairs of objectives that are drawn: a page has no room for more.
const PANELS: usize = 6;

/// Most designs that are marked one by one: more hide each other, and vector graphics of them become slow to show.
const MARKED: usize = 5000;

/// The picture of a search, with its name; `None` if no design keeps all constraints.
pub(super) fn all(objectives: &[Objective], told: &[Told], front: &Front) -> Option<(&'static str, Figure)> {
    if front.places().is_empty() {
        return None;
    }
    let (panels, what): (Vec<Panel>, &str) = match objectives {
        [only] => (vec![course(only, told)], "the best design so far"),
        several => {
            let pairs = (0..several.len()).flat_map(|x| (x + 1..several.len()).map(move |y| (x, y)));
            let panel = |pair| trade_off(several, pair, told, front);
            (pairs.take(PANELS).map(panel).collect(), "designs that no other one is better than")
        }
    };
    let description = format!("{} designs, and {what}", told.len());
    let columns = if panels.len() > 1 { 2 } else { 1 };
    let width_mm = if columns > 1 { 178.0 } else { 85.0 };
    Some(("optimise", Figure { width_mm, columns, panels, description, ..Figure::default() }))
}

/// The value of an objective of a design that keeps all constraints, as its report has it; not-a-number of any other.
fn value(objectives: &[Objective], at: usize, told: &Told) -> f64 {
    let loss = told.feasible().and_then(|losses| losses.get(at).copied()).unwrap_or(f64::NAN);
    turned(objectives[at].want, loss)
}

/// The designs that are marked: all, or evenly some of them.
fn marked(told: &[Told]) -> impl Iterator<Item = &Told> {
    told.iter().step_by(told.len().div_ceil(MARKED).max(1))
}

/// The values of all designs in turn, and the best so far.
fn course(objective: &Objective, told: &[Told]) -> Panel {
    let of = |told: &Told| value(std::slice::from_ref(objective), 0, told);
    let (x, y) = marked(told).map(|told| (told.index as f64, of(told))).unzip();
    let points = Points { x, y, ink: Ink::Palette(0), label: "design".into(), ..Points::default() };
    let mut best = f64::NAN;
    let mut line = Line { ink: Ink::Palette(1), label: "best so far".into(), ..Line::default() };
    for told in told {
        let found = of(told);
        if best.is_nan() || turned(objective.want, found) < turned(objective.want, best) {
            best = found;
        }
        line.x.push(told.index as f64);
        line.y.push(best);
    }
    Plot {
        x: Axis::new("Design"),
        y: Axis::new(objective.figure.clone()),
        layers: vec![points.into(), line.into()],
        ..Plot::default()
    }
    .into()
}

/// One objective against another: all designs, and those of the front.
fn trade_off(objectives: &[Objective], pair: (usize, usize), told: &[Told], front: &Front) -> Panel {
    let of = |told: &Told| (value(objectives, pair.0, told), value(objectives, pair.1, told));
    let (x, y) = marked(told).map(of).unzip();
    let points = Points { x, y, ink: Ink::Palette(0), label: "design".into(), ..Points::default() };
    let mut ends: Vec<(f64, f64)> = front.places().iter().map(|at| of(&told[*at])).collect();
    ends.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)));
    let (x, y): (Vec<f64>, Vec<f64>) = ends.into_iter().unzip();
    let marks = Points {
        x: x.clone(),
        y: y.clone(),
        ink: Ink::Palette(1),
        label: "front".into(),
        ..Points::default()
    };
    let mut layers = vec![points.into(), marks.into()];
    // Of more objectives it is no curve.
    if objectives.len() == 2 {
        layers.push(Line { x, y, ink: Ink::Palette(1), ..Line::default() }.into());
    }
    Plot {
        x: Axis::new(objectives[pair.0].figure.clone()),
        y: Axis::new(objectives[pair.1].figure.clone()),
        layers,
        ..Plot::default()
    }
    .into()
}
