//! The layers of a plot, drawn inside its frame.

use crate::axis::usable;
use crate::canvas::{Anchor, Canvas, Rect, Rise, Stroke, Text, path, rectangle};
use crate::colour::Rgb;
use crate::layer::{Along, Band, Dash, Ink, Layer, Line, Mark, Note, Points, Rule, Span};
use crate::placed::Placed;
use crate::style::Style;
use crate::{font, thin};

/// Share of its colour a band or span shows. With twice as much it would hide lines, with half as much it fades in
/// print.
pub(crate) const PALE: f64 = 0.22;

/// How each layer looks once automatic choices are made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    /// Colour of line or mark.
    pub ink: Rgb,
    /// Lengths of marks and spaces by turns, in line widths.
    pub dash: &'static [f64],
    /// Shape of the mark.
    pub mark: Mark,
}

/// Makes the automatic choices of colour, pattern and mark, in the order of the layers.
pub(crate) fn looks(layers: &[Layer]) -> Vec<Look> {
    let (mut inks, mut dashes, mut marks) = (0, 0, 0);
    let mut looks = Vec::with_capacity(layers.len());
    for layer in layers {
        let (ink, dash, mark) = match layer {
            Layer::Line(line) => (line.ink, line.dash, Mark::Disc),
            Layer::Points(points) => (points.ink, Dash::Solid, points.mark),
            Layer::Band(band) => (band.ink, Dash::Solid, Mark::Disc),
            Layer::Rule(rule) => (rule.ink, rule.dash, Mark::Disc),
            Layer::Span(span) => (span.ink, Dash::Solid, Mark::Disc),
            Layer::Note(note) => (note.ink, Dash::Solid, Mark::Disc),
        };
        let pattern = if ink == Ink::Auto { dashes } else { 0 };
        looks.push(Look { ink: ink.colour(inks), dash: dash.pattern(pattern), mark: mark.of(marks) });
        inks += usize::from(ink == Ink::Auto);
        dashes += usize::from(ink == Ink::Auto && matches!(layer, Layer::Line(_)));
        marks += usize::from(matches!(layer, Layer::Points(_)));
    }
    looks
}

pub(crate) fn layers(canvas: &mut Canvas, placed: &Placed, layers: &[Layer], style: &Style) {
    let looks = looks(layers);
    canvas.clip(&rectangle(placed.frame));
    for (layer, look) in layers.iter().zip(&looks) {
        match layer {
            Layer::Line(line) => curve(canvas, placed, line, look, style),
            Layer::Band(band) => stripe(canvas, placed, band, look),
            Layer::Span(span) => shade(canvas, placed, span, look),
            Layer::Rule(rule) => ruled(canvas, placed, rule, look, style),
            Layer::Points(points) => error_bars(canvas, placed, points, look, style),
            Layer::Note(_) => {}
        }
    }
    canvas.end();
    // Marks on the rim of the frame stay whole.
    for (layer, look) in layers.iter().zip(&looks) {
        match layer {
            Layer::Points(points) => {
                let shown = points.x.iter().zip(&points.y).filter_map(|(x, y)| visible(placed, *x, *y));
                shown.for_each(|at| mark(canvas, at, look, style));
            }
            Layer::Rule(rule) => rule_label(canvas, placed, rule, look, style),
            Layer::Note(text) => note(canvas, placed, text, look, style),
            _ => {}
        }
    }
}

/// A datum's place if it is inside the frame.
fn visible(placed: &Placed, x: f64, y: f64) -> Option<[f64; 2]> {
    let at = placed.point(x, y)?;
    let frame = placed.frame;
    let slack =
        Rect { x: frame.x - 0.01, y: frame.y - 0.01, width: frame.width + 0.02, height: frame.height + 0.02 };
    (usable(x) && usable(y) && slack.contains(at)).then_some(at)
}

/// Runs of consecutive points that can be drawn.
pub(crate) fn runs(placed: &Placed, x: &[f64], y: &[f64]) -> Vec<Vec<[f64; 2]>> {
    let points: Vec<Option<[f64; 2]>> = x
        .iter()
        .zip(y)
        .map(|(&x, &y)| if usable(x) && usable(y) { placed.point(x, y) } else { None })
        .collect();
    points
        .split(Option::is_none)
        .filter(|run| !run.is_empty())
        .map(|run| run.iter().flatten().copied().collect())
        .collect()
}

/// The path of all runs, thinned to what print can show; a lone point becomes a dot.
pub(crate) fn curve_path(runs: &[Vec<[f64; 2]>]) -> String {
    runs.iter().fold(String::new(), |mut all, run| {
        match run.as_slice() {
            [[x, y]] => all += &path([[x - 0.05, *y], [x + 0.05, *y]], false),
            run => all += &path(thin::thinned(run), false),
        }
        all
    })
}

fn curve(canvas: &mut Canvas, placed: &Placed, line: &Line, look: &Look, style: &Style) {
    let width = line.width_pt.unwrap_or(style.line_pt);
    let path = curve_path(&runs(placed, &line.x, &line.y));
    canvas.stroke(&path, Stroke { ink: look.ink, width, dash: look.dash });
}

fn stripe(canvas: &mut Canvas, placed: &Placed, band: &Band, look: &Look) {
    let whole = |i: usize| usable(band.x[i]) && usable(band.low[i]) && usable(band.high[i]);
    let indices: Vec<usize> = (0..band.x.len().min(band.low.len()).min(band.high.len())).collect();
    for run in indices.split(|&i| !whole(i)).filter(|run| run.len() > 1) {
        let below = run.iter().filter_map(|&i| placed.point(band.x[i], band.low[i]));
        let above = run.iter().rev().filter_map(|&i| placed.point(band.x[i], band.high[i]));
        canvas.fill(&path(below.chain(above), true), look.ink, PALE);
    }
}

fn shade(canvas: &mut Canvas, placed: &Placed, span: &Span, look: &Look) {
    let frame = placed.frame;
    let rect = match span.along {
        Along::Y => {
            let (a, b) = (placed.across(span.from), placed.across(span.to));
            Rect { x: a.min(b), width: (b - a).abs(), ..frame }
        }
        Along::X => {
            let (a, b) = (placed.up(span.from), placed.up(span.to));
            Rect { y: a.min(b), height: (b - a).abs(), ..frame }
        }
    };
    if rect.width.is_finite() && rect.height.is_finite() {
        canvas.fill(&rectangle(rect), look.ink, PALE);
    }
}

fn ruled(canvas: &mut Canvas, placed: &Placed, rule: &Rule, look: &Look, style: &Style) {
    let frame = placed.frame;
    let ends = match rule.along {
        Along::Y => {
            let x = placed.across(rule.at);
            [[x, frame.bottom()], [x, frame.y]]
        }
        Along::X => {
            let y = placed.up(rule.at);
            [[frame.x, y], [frame.right(), y]]
        }
    };
    if ends.iter().flatten().all(|length| length.is_finite()) {
        let width = style.line_pt.min(0.7);
        canvas.line(ends[0], ends[1], Stroke { ink: look.ink, width, dash: look.dash });
    }
}

fn rule_label(canvas: &mut Canvas, placed: &Placed, rule: &Rule, look: &Look, style: &Style) {
    let frame = placed.frame;
    let text = match rule.along {
        Along::Y => {
            let half = font::width(&rule.label, style.tick_pt) / 2.0;
            // A label wider than the frame reaches as far beyond it on both sides.
            let middle = frame.x + frame.width / 2.0;
            let [low, high] = [(frame.x + half).min(middle), (frame.right() - half).max(middle)];
            let x = placed.across(rule.at).clamp(low, high);
            Text::new(&rule.label, [x, frame.y - 2.0], style.tick_pt).anchor(Anchor::Middle)
        }
        Along::X => {
            let y = placed.up(rule.at);
            let y = if y - frame.y < 1.5 * style.tick_pt { y + 1.1 * style.tick_pt } else { y - 2.5 };
            Text::new(&rule.label, [frame.right() - 2.0, y], style.tick_pt).anchor(Anchor::End).halo()
        }
    };
    let place = if rule.along == Along::Y { placed.x.place(rule.at) } else { placed.y.place(rule.at) };
    if (0.0..=1.0).contains(&place) {
        canvas.text(text.ink(look.ink));
    }
}

fn note(canvas: &mut Canvas, placed: &Placed, note: &Note, look: &Look, style: &Style) {
    let Some([x, y]) = visible(placed, note.at[0], note.at[1]) else {
        return;
    };
    let wide = font::width(&note.text, style.tick_pt);
    let frame = placed.frame;
    let (low, high) = match note.anchor {
        Anchor::Start => (frame.x, frame.right() - wide),
        Anchor::Middle => (frame.x + wide / 2.0, frame.right() - wide / 2.0),
        Anchor::End => (frame.x + wide, frame.right()),
    };
    let at = [x.clamp(low, high.max(low)), y];
    let text = Text::new(&note.text, at, style.tick_pt).anchor(note.anchor).rise(Rise::Middle);
    canvas.text(text.ink(look.ink).halo());
}

fn error_bars(canvas: &mut Canvas, placed: &Placed, points: &Points, look: &Look, style: &Style) {
    let cap = 1.4;
    let mut bars = String::new();
    for ((&x, &y), [below, above]) in points.x.iter().zip(&points.y).zip(&points.error) {
        let Some([across, up]) = visible(placed, x, y) else {
            continue;
        };
        for reach in [y - below, y + above] {
            let beyond = if reach < y { placed.frame.bottom() + 10.0 } else { up };
            let end = placed.point(x, reach).map_or(beyond, |[_, end]| end);
            bars += &path([[across, up], [across, end]], false);
            bars += &path([[across - cap, end], [across + cap, end]], false);
        }
    }
    canvas.stroke(&bars, Stroke::solid(look.ink, 0.75 * style.line_pt));
}

/// One mark; empty ones are filled white so that lines do not show through.
pub(crate) fn mark(canvas: &mut Canvas, [x, y]: [f64; 2], look: &Look, style: &Style) {
    let (r, ink) = (1.7, look.ink);
    let stroke = Stroke::solid(ink, style.line_pt);
    let polygon = |points: &[[f64; 2]]| path(points.iter().map(|[dx, dy]| [x + r * dx, y + r * dy]), true);
    match look.mark {
        Mark::Auto | Mark::Disc => canvas.circle([x, y], r, Some(ink), Stroke::solid(ink, 0.0)),
        Mark::Ring => canvas.circle([x, y], r * 0.95, Some(Rgb::WHITE), stroke),
        Mark::Square => {
            canvas.fill(&polygon(&[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]]), ink, 1.0)
        }
        Mark::Triangle => canvas.fill(&polygon(&[[0.0, -1.25], [1.15, 0.8], [-1.15, 0.8]]), ink, 1.0),
        Mark::Diamond => {
            canvas.fill(&polygon(&[[0.0, -1.35], [1.35, 0.0], [0.0, 1.35], [-1.35, 0.0]]), ink, 1.0)
        }
        Mark::Plus => {
            let bars = path([[x - 1.3 * r, y], [x + 1.3 * r, y]], false)
                + &path([[x, y - 1.3 * r], [x, y + 1.3 * r]], false);
            canvas.stroke(&bars, stroke);
        }
        Mark::Cross => {
            let bars = path([[x - r, y - r], [x + r, y + r]], false)
                + &path([[x - r, y + r], [x + r, y - r]], false);
            canvas.stroke(&bars, stroke);
        }
    }
}
