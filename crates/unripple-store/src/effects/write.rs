//! Effects written as a file.

use super::kind::{ANCHORS, PLAYS};
use super::range;
use super::score::STARTS;
use crate::decimal::text;
use crate::lines::{Lines, list, named, point, quoted};
use crate::surface::range::Limits;
use unripple_core::Point;
use unripple_effects::{
    Curve, Effect, EffectSet, Envelope, Event, Hum, Kind, Level, Region, Score, Sound, Texture, Tone, Trace,
    Traced, Train,
};

/// Writes effects as the text of a file in format 1. [`crate::parse_effects`] turns the text back into the
/// same effects, bit for bit, provided the values are within the format's limits and names are lines of
/// text.
///
/// ```
/// let set = unripple_store::builtin_effect("sandpaper").unwrap();
/// let text = unripple_store::effects_to_toml(&set);
/// assert_eq!(unripple_store::parse_effects(&text, "copy.toml")?, set);
/// # Ok::<(), unripple_store::FileFaults>(())
/// ```
pub fn effects_to_toml(set: &EffectSet) -> String {
    let mut out = Lines::default();
    out.line("format", "1");
    out.line("name", &quoted(&set.name));
    if !set.about.is_empty() {
        out.line("about", &quoted(&set.about));
    }
    set.effects.iter().for_each(|one| effect(one, &mut out));
    out.into_text()
}

impl Lines {
    fn number(&mut self, key: &str, value: f64, limits: &Limits) {
        self.line(key, &limits.text(value));
    }
}

fn points(list_of: &[Point]) -> String {
    list(list_of.iter().map(point))
}

fn curve(curve: &Curve, along: &Limits, values: &Limits) -> String {
    list(curve.points().iter().map(|(x, y)| format!("[{}, {}]", along.text(*x), values.text(*y))))
}

fn effect(effect: &Effect, out: &mut Lines) {
    out.table("[[effect]]");
    out.line("kind", &quoted(effect.kind.name()));
    out.line("name", &quoted(&effect.name));
    match effect.level {
        Level::Share(share) => out.number("gain", share, &range::SHARE),
        Level::Felt(db) => out.number("felt_db", db, &range::FELT),
    }
    region(&effect.region, out);
    match &effect.kind {
        Kind::Button(button) => {
            if let Some(force) = button.press_force {
                out.number("press_n", force, &range::FORCE);
            }
            out.number("release", button.release, &range::SHARE);
        }
        Kind::Texture(one) => texture(one, out),
        Kind::Edge(edge) => {
            if let Some(line) = edge.line {
                out.line("line_mm", &points(&[line.from, line.to]));
            }
        }
        Kind::Notch(notch) => {
            out.number("every_mm", notch.pitch, &range::PITCH);
            out.number("axis_deg", notch.axis, &range::ANGLE);
            out.line("origin_mm", &point(&notch.origin));
            out.number("hysteresis", notch.hysteresis, &range::HYSTERESIS);
        }
        Kind::Train(one) => train(one, out),
        Kind::Shape(one) => shape(one, out),
        Kind::Hum(one) => hum(one, out),
        Kind::Score(one) => score(one, out),
    }
}

fn region(region: &Region, out: &mut Lines) {
    match region {
        Region::Everywhere => {}
        Region::Rectangle { corner, width, height } => {
            let size = list([width, height].into_iter().map(|v| range::LENGTH.text(*v)));
            out.line("region", &format!("{{ rectangle_mm = {size}, at_mm = {} }}", point(corner)));
        }
        Region::Circle { centre, radius } => {
            let radius = range::LENGTH.text(*radius);
            out.line("region", &format!("{{ circle_mm = {radius}, centre_mm = {} }}", point(centre)));
        }
        Region::Polygon(corners) => {
            out.line("region", &format!("{{ polygon_mm = {} }}", points(corners)));
        }
    }
}

fn texture(texture: &Texture, out: &mut Lines) {
    out.number("every_mm", texture.pitch, &range::PITCH);
    out.number("grain", texture.grain, &range::SHARE);
    out.line("seed", &texture.seed.to_string());
    out.line("speed_gain", &curve(&texture.speed_gain, &range::SPEED, &range::SHARE));
}

fn train(train: &Train, out: &mut Lines) {
    out.number("rate_hz", train.rate, &range::RATE);
    if let Some(count) = train.count {
        out.line("count", &count.to_string());
    }
    if let Some(envelope) = &train.envelope {
        out.line("envelope", &curve(envelope, &range::TIME, &range::SHARE));
    }
    out.number("jitter", train.jitter, &range::SHARE);
    out.number("scatter_mm", train.scatter, &range::SCATTER);
    out.line("seed", &train.seed.to_string());
}

fn shape(shape: &Traced, out: &mut Lines) {
    let key = if shape.closed { "polygon_mm" } else { "path_mm" };
    out.line(key, &points(&shape.path));
    out.line("around", &named(&ANCHORS, &shape.anchor));
    match shape.trace {
        Trace::Moving(speed) => out.number("speed_mm_per_s", speed, &range::SPEED),
        Trace::AtOnce(spacing) => out.number("spacing_mm", spacing, &range::PITCH),
    }
    out.number("rate_hz", shape.rate, &range::RATE);
}

fn envelope(envelope: &Envelope, out: &mut Lines) {
    out.line("amplitude", &curve(envelope.amplitude(), &range::TIME, &range::SHARE));
    let frequency = match envelope.frequency().points() {
        [(0.0, hz)] => text(*hz, 0),
        _ => curve(envelope.frequency(), &range::TIME, &range::FREQUENCY),
    };
    out.line("frequency_hz", &frequency);
}

fn hum(hum: &Hum, out: &mut Lines) {
    match &hum.tone {
        Tone::Sine(hz) => out.number("frequency_hz", *hz, &range::FREQUENCY),
        Tone::Once(drawn) | Tone::Looped(drawn) => {
            envelope(drawn, out);
            out.line("play", &named(&PLAYS, &matches!(hum.tone, Tone::Looped(_))));
        }
    }
    out.line("speed_gain", &curve(&hum.speed_gain, &range::SPEED, &range::SHARE));
    out.number("fade_ms", hum.fade, &range::FADE);
}

fn score(score: &Score, out: &mut Lines) {
    out.line("start", &named(&STARTS, &score.start));
    if let Some(period) = score.period {
        out.number("period_ms", period, &range::PERIOD);
    }
    score.events.iter().for_each(|one| event(one, out));
}

fn event(event: &Event, out: &mut Lines) {
    out.table("[[effect.event]]");
    out.number("at_ms", event.at, &range::TIME);
    out.number("gain", event.gain, &range::SHARE);
    if let Some(place) = &event.place {
        out.line("at_mm", &point(place));
    }
    if let Sound::Wave(drawn) = &event.sound {
        envelope(drawn, out);
    }
}
