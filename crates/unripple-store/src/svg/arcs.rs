//! Elliptic arcs of path data, spelled out before the reader of SVG gets them: it follows arcs to a tenth of a user unit,
//! which is too coarse for a rim, and does not tell that a curve was an arc.

use svgtypes::{PathParser, PathSegment};
use usvg::roxmltree::Document;

/// The document's text with each elliptic arc of its paths as cubic curves of at most a quarter turn, between two
/// quadratic curves of no length; `None` if there is no arc.
pub(super) fn spelled_out(document: &Document) -> Option<String> {
    let data = document.descendants().filter(|n| n.is_element() && n.tag_name().name() == "path");
    let data = data.filter_map(|n| n.attribute_node("d")).filter(|d| d.value().contains(['a', 'A']));
    let mut edits: Vec<_> = data.map(|d| (d.range_value(), path(d.value()))).collect();
    edits.sort_by_key(|(range, _)| range.start);
    if edits.is_empty() {
        return None;
    }
    let text = document.input_text();
    let (mut out, mut done) = (String::new(), 0);
    for (range, new) in edits {
        out.push_str(text.get(done..range.start)?);
        out.push_str(&new);
        done = range.end;
    }
    out.push_str(text.get(done..)?);
    Some(out)
}

/// Path data in absolute coordinates, its arcs spelled out. Ends where the data stop making sense, as readers must.
fn path(data: &str) -> String {
    let mut pen = Pen::default();
    PathParser::from(data).map_while(Result::ok).for_each(|segment| pen.draw(segment));
    pen.out
}

/// Writes path data and knows where it is.
#[derive(Default)]
struct Pen {
    out: String,
    at: (f64, f64),
    start: (f64, f64),
}

impl Pen {
    fn write(&mut self, command: char, numbers: &[f64]) {
        self.out.push(command);
        for number in numbers {
            // The reader keeps single precision.
            self.out.push_str(&format!("{} ", *number as f32));
        }
    }

    /// Writes a segment and moves to the end of it.
    fn go(&mut self, command: char, before: &[(f64, f64)], to: (f64, f64)) {
        let numbers: Vec<f64> = before.iter().chain([&to]).flat_map(|(x, y)| [*x, *y]).collect();
        self.write(command, &numbers);
        self.at = to;
    }

    fn draw(&mut self, segment: PathSegment) {
        let from = if segment.is_abs() { (0.0, 0.0) } else { self.at };
        let place = |x: f64, y: f64| (from.0 + x, from.1 + y);
        match segment {
            PathSegment::MoveTo { x, y, .. } => {
                self.go('M', &[], place(x, y));
                self.start = self.at;
            }
            PathSegment::LineTo { x, y, .. } => self.go('L', &[], place(x, y)),
            PathSegment::HorizontalLineTo { x, .. } => self.go('L', &[], (from.0 + x, self.at.1)),
            PathSegment::VerticalLineTo { y, .. } => self.go('L', &[], (self.at.0, from.1 + y)),
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                self.go('C', &[place(x1, y1), place(x2, y2)], place(x, y));
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => self.go('S', &[place(x2, y2)], place(x, y)),
            PathSegment::Quadratic { x1, y1, x, y, .. } => self.go('Q', &[place(x1, y1)], place(x, y)),
            PathSegment::SmoothQuadratic { x, y, .. } => self.go('T', &[], place(x, y)),
            PathSegment::EllipticalArc { rx, ry, x_axis_rotation, large_arc, sweep, x, y, .. } => {
                let (to, radii) = (place(x, y), (rx, ry));
                self.arc(radii, x_axis_rotation, (large_arc, sweep), to);
            }
            PathSegment::ClosePath { .. } => {
                self.out.push('Z');
                self.at = self.start;
            }
        }
    }

    fn arc(&mut self, (rx, ry): (f64, f64), rotation: f64, (large_arc, sweep): (bool, bool), to: (f64, f64)) {
        let point = |(x, y): (f64, f64)| kurbo::Point::new(x, y);
        let arc = kurbo::Arc::from_svg_arc(&kurbo::SvgArc {
            from: point(self.at),
            to: point(to),
            radii: kurbo::Vec2::new(rx, ry),
            x_rotation: rotation.to_radians(),
            large_arc,
            sweep,
        });
        let Some(arc) = arc else { return self.go('L', &[], to) };
        // So loose a tolerance gives the fewest curves: one for each quarter begun.
        let tolerance = arc.radii.x.max(arc.radii.y);
        let mut curves = Vec::new();
        arc.to_cubic_beziers(tolerance, |a, b, end| curves.push([a, b, end].map(|p| (p.x, p.y))));
        if let Some(last) = curves.last_mut() {
            last[2] = to;
        }
        self.go('Q', &[self.at], self.at);
        for [a, b, end] in curves {
            self.go('C', &[a, b], end);
        }
        self.go('Q', &[to], to);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcs_stand_between_points() {
        assert_eq!(path("m1 2h3v-1l1 1z"), "M1 2 L4 2 L4 1 L5 2 Z");
        let half = path("M0 0 a5 5 0 0 1 10 0 T 20 0");
        assert!(half.starts_with("M0 0 Q0 0 0 0 C"), "{half}");
        assert!(half.ends_with("Q10 0 10 0 T20 0 "), "{half}");
        assert_eq!(half.matches('C').count(), 2);
        assert_eq!(path("M0 0 A0 5 0 0 1 10 0 A5 x"), "M0 0 L10 0 ");
    }

    #[test]
    fn only_paths_with_arcs_change() {
        let text = "<svg xmlns='a'><path d='M0 0L1 1'/><path d='M0 0A1 1 0 0 0 1 1'/><g d='A'/></svg>";
        let document = Document::parse(text).unwrap();
        let new = spelled_out(&document).unwrap();
        assert!(new.starts_with("<svg xmlns='a'><path d='M0 0L1 1'/><path d='M0 0 Q0 0 0 0 C"), "{new}");
        assert!(new.ends_with("'/><g d='A'/></svg>"), "{new}");
        assert!(spelled_out(&Document::parse("<svg><path d='M0 0L1 1'/></svg>").unwrap()).is_none());
    }
}
