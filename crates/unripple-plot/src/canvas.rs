//! Elements of a drawing, written as SVG. Lengths in points, y down.

use crate::colour::Rgb;
use crate::font;
use crate::label::Label;
use base64::Engine;
use std::fmt::Write;

/// An axis-aligned rectangle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Rect {
    /// Left edge, in points.
    pub x: f64,
    /// Upper edge, in points.
    pub y: f64,
    /// Width to the right, in points.
    pub width: f64,
    /// Height downwards, in points.
    pub height: f64,
}

impl Rect {
    /// Right edge, in points.
    pub fn right(&self) -> f64 {
        self.x + self.width
    }

    /// Lower edge, in points.
    pub fn bottom(&self) -> f64 {
        self.y + self.height
    }

    /// Whether a place, in points, is within the rectangle or on its rim.
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        (self.x..=self.right()).contains(&x) && (self.y..=self.bottom()).contains(&y)
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stroke {
    /// Colour of the line.
    pub ink: Rgb,
    /// Width of the line, in points.
    pub width: f64,
    /// Lengths of marks and spaces by turns, in line widths; empty for an unbroken line.
    pub dash: &'static [f64],
}

impl Stroke {
    /// An unbroken line `width` points wide.
    pub fn solid(ink: Rgb, width: f64) -> Self {
        Self { ink, width, dash: &[] }
    }
}

/// Which part of a line of text lies at the place given for the text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Anchor {
    /// The text starts at its place.
    #[default]
    Start,
    /// The text is centred at its place.
    Middle,
    /// The text ends at its place.
    End,
}

/// Which height of a text is at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rise {
    Baseline,
    Middle,
    Top,
}

/// A line of text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Text<'a> {
    /// The text to be written.
    pub content: &'a str,
    /// The place that anchor and rise refer to, in points.
    pub at: [f64; 2],
    /// Size of the type, in points.
    pub size: f64,
    /// Which end of the line is at the place.
    pub anchor: Anchor,
    /// Which height of the text is at the place: its baseline, its middle or another.
    pub rise: Rise,
    /// Whether the text reads upwards instead of rightwards.
    pub upwards: bool,
    /// Colour of the letters.
    pub ink: Rgb,
    /// Whether the letters have a white rim, to be read over an image.
    pub halo: bool,
}

impl<'a> Text<'a> {
    /// Black text of `size` points that starts at `at`, in points.
    pub fn new(content: &'a str, at: [f64; 2], size: f64) -> Self {
        Self {
            content,
            at,
            size,
            anchor: Anchor::Start,
            rise: Rise::Baseline,
            upwards: false,
            ink: Rgb::BLACK,
            halo: false,
        }
    }

    /// The same text with another horizontal alignment.
    pub fn anchor(mut self, anchor: Anchor) -> Self {
        self.anchor = anchor;
        self
    }

    /// The same text with another vertical alignment.
    pub fn rise(mut self, rise: Rise) -> Self {
        self.rise = rise;
        self
    }

    /// The same text, reading upwards.
    pub fn upwards(mut self) -> Self {
        self.upwards = true;
        self
    }

    /// The same text in another colour.
    pub fn ink(mut self, ink: Rgb) -> Self {
        self.ink = ink;
        self
    }

    /// The same text with a white rim.
    pub fn halo(mut self) -> Self {
        self.halo = true;
        self
    }
}

/// A drawing under way: the SVG elements so far.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    body: String,
    definitions: String,
    clips: usize,
    /// Every line of text so far, with its box.
    pub labels: Vec<Label>,
}

impl Canvas {
    /// The whole SVG document, `width` by `height` points.
    pub fn finish(&self, width: f64, height: f64, description: &str) -> String {
        let mm = |points: f64| number(points * crate::style::MM_PER_POINT);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {} {}\" \
             font-family=\"{}\" fill=\"none\" stroke-linejoin=\"round\">\n<title>{}</title>\n<defs>\n{}</defs>\n{}</svg>\n",
            mm(width),
            mm(height),
            number(width),
            number(height),
            font::FAMILY,
            escape(description),
            self.definitions,
            self.body
        )
    }

    /// Opens a group that shows nothing outside a path; close it with [`Canvas::end`].
    pub fn clip(&mut self, path: &str) {
        self.clips += 1;
        let _ = writeln!(
            self.definitions,
            "<clipPath id=\"c{0}\"><path d=\"{path}\" clip-rule=\"evenodd\"/></clipPath>",
            self.clips
        );
        let _ = writeln!(self.body, "<g clip-path=\"url(#c{})\">", self.clips);
    }

    /// Closes the group that [`Canvas::clip`] opened.
    pub fn end(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// Draws a line along a path.
    pub fn stroke(&mut self, path: &str, stroke: Stroke) {
        if path.is_empty() {
            return;
        }
        let _ = write!(
            self.body,
            "<path d=\"{path}\" stroke=\"{}\" stroke-width=\"{}\"",
            stroke.ink,
            number(stroke.width)
        );
        if stroke.dash.is_empty() {
            self.body.push_str(" stroke-linecap=\"round\"");
        } else {
            let dashes: Vec<String> = stroke.dash.iter().map(|d| number(d * stroke.width)).collect();
            let _ = write!(self.body, " stroke-dasharray=\"{}\"", dashes.join(" "));
        }
        self.body.push_str("/>\n");
    }

    /// Draws a straight line between two places, in points.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], stroke: Stroke) {
        self.stroke(&path([from, to], false), stroke);
    }

    /// Fills the inside of a path, at an opacity from 0 to 1.
    pub fn fill(&mut self, path: &str, ink: Rgb, opacity: f64) {
        let _ = writeln!(
            self.body,
            "<path d=\"{path}\" fill=\"{ink}\" fill-opacity=\"{}\" fill-rule=\"evenodd\"/>",
            number(opacity)
        );
    }

    /// Draws a circle about a place, its radius in points, filled if a colour is given.
    pub fn circle(&mut self, [x, y]: [f64; 2], radius: f64, fill: Option<Rgb>, stroke: Stroke) {
        let dashes: Vec<String> = stroke.dash.iter().map(|d| number(d * stroke.width)).collect();
        let _ = writeln!(
            self.body,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"{}/>",
            number(x),
            number(y),
            number(radius),
            fill.map_or("none".to_owned(), |ink| ink.to_string()),
            stroke.ink,
            number(stroke.width),
            if dashes.is_empty() {
                String::new()
            } else {
                format!(" stroke-dasharray=\"{}\"", dashes.join(" "))
            }
        );
    }

    /// Writes a line of text.
    pub fn text(&mut self, text: Text) {
        if text.content.is_empty() {
            return;
        }
        let drop = text.size
            * font::DIGIT_HEIGHT
            * match text.rise {
                Rise::Baseline => 0.0,
                Rise::Middle => 0.5,
                Rise::Top => 1.0,
            };
        let [x, y] = text.at;
        let [x, y] = if text.upwards { [x + drop, y] } else { [x, y + drop] };
        let place = if text.upwards {
            format!("transform=\"translate({} {}) rotate(-90)\"", number(x), number(y))
        } else {
            format!("x=\"{}\" y=\"{}\"", number(x), number(y))
        };
        let (anchor, before) = match text.anchor {
            Anchor::Start => ("start", 0.0),
            Anchor::Middle => ("middle", 0.5),
            Anchor::End => ("end", 1.0),
        };
        self.labels.push(Label::of(text.content, [x, y], before, text.size, text.upwards));
        let halo = if text.halo {
            format!(
                " stroke=\"#ffffff\" stroke-width=\"{}\" paint-order=\"stroke\"",
                number(text.size * 0.28)
            )
        } else {
            String::new()
        };
        let _ = writeln!(
            self.body,
            "<text {place} font-size=\"{}\" text-anchor=\"{anchor}\" fill=\"{}\"{halo}>{}</text>",
            number(text.size),
            text.ink,
            escape(text.content)
        );
    }

    /// A rectangle filled with a gradient of colours from bottom to top.
    pub fn gradient(&mut self, rect: Rect, stops: &[Rgb]) {
        self.clips += 1;
        let _ = write!(
            self.definitions,
            "<linearGradient id=\"g{}\" gradientUnits=\"userSpaceOnUse\" x1=\"0\" x2=\"0\" y1=\"{}\" y2=\"{}\">",
            self.clips,
            number(rect.bottom()),
            number(rect.y)
        );
        let last = stops.len().saturating_sub(1).max(1) as f64;
        for (i, stop) in stops.iter().enumerate() {
            let _ =
                write!(self.definitions, "<stop offset=\"{:.4}\" stop-color=\"{stop}\"/>", i as f64 / last);
        }
        self.definitions.push_str("</linearGradient>\n");
        let _ = writeln!(self.body, "<path d=\"{}\" fill=\"url(#g{})\"/>", rectangle(rect), self.clips);
    }

    /// Embeds the bytes of a PNG file, stretched over a rectangle in points.
    pub fn image(&mut self, rect: Rect, png: &[u8]) {
        let _ = writeln!(
            self.body,
            "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" style=\"image-rendering:smooth\" \
             href=\"data:image/png;base64,{}\"/>",
            number(rect.x),
            number(rect.y),
            number(rect.width),
            number(rect.height),
            base64::engine::general_purpose::STANDARD.encode(png)
        );
    }
}

/// The path of a polyline.
pub(crate) fn path(points: impl IntoIterator<Item = [f64; 2]>, closed: bool) -> String {
    let mut path = String::new();
    for (i, [x, y]) in points.into_iter().enumerate() {
        path.push(if i == 0 { 'M' } else { 'L' });
        push_number(&mut path, x);
        path.push(' ');
        push_number(&mut path, y);
    }
    if closed && !path.is_empty() {
        path.push('Z');
    }
    path
}

/// The path of a rectangle.
pub(crate) fn rectangle(rect: Rect) -> String {
    let (left, top, right, bottom) = (rect.x, rect.y, rect.right(), rect.bottom());
    path([[left, top], [right, top], [right, bottom], [left, bottom]], true)
}

/// A length to a hundredth of a point, without trailing zeros.
pub(crate) fn number(value: f64) -> String {
    let mut text = String::new();
    push_number(&mut text, value);
    text
}

fn push_number(text: &mut String, value: f64) {
    let hundredths = (value * 100.0).round().clamp(-1e9, 1e9) as i64;
    if hundredths < 0 {
        text.push('-');
    }
    let (whole, part) = (hundredths.abs() / 100, hundredths.abs() % 100);
    let _ = match (part, part % 10) {
        (0, _) => write!(text, "{whole}"),
        (_, 0) => write!(text, "{whole}.{}", part / 10),
        _ => write!(text, "{whole}.{part:02}"),
    };
}

/// Text with XML's own signs escaped and characters XML forbids replaced.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\t' | '\n' | '\r' => escaped.push(' '),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_never_exponents() {
        for (value, text) in
            [(0.0, "0"), (-0.001, "0"), (1.5, "1.5"), (-2.25, "-2.25"), (3.05, "3.05"), (f64::NAN, "0")]
        {
            assert_eq!(number(value), text);
        }
        assert!(!number(1e300).contains('e'));
    }

    #[test]
    fn hostile_text_is_made_harmless() {
        assert_eq!(escape("<a href=\"x\">&\u{0}\n"), "&lt;a href=&quot;x&quot;&gt;&amp;\u{fffd} ");
    }
}
