//! How the sides of a rectangle are held, and which other arrangements frequencies may not tell from it.

use unripple_core::{ActuatorKind, Edge, Edges, Outline, Shape, Surface};

/// Sides of a rectangle in the order of the file.
const SIDES: [&str; 4] = ["bottom", "right", "top", "left"];

/// The sides that come to the places of bottom, right, top and left when a rectangle is mirrored: at neither axis, left to right, bottom to
/// top, both.
const MIRRORED: [[usize; 4]; 4] = [[0, 1, 2, 3], [0, 3, 2, 1], [2, 1, 0, 3], [2, 3, 0, 1]];

/// The same when the conditions of all sides move on by one.
const TURNED: [usize; 4] = [3, 0, 1, 2];

/// The edge conditions of an outline in words, sides of a rectangle by name.
pub(super) fn words(outline: &Outline) -> String {
    let count = outline.shape.sides().len();
    let all: Vec<Edge> = (0..count).map(|side| outline.edges.of(side)).collect();
    if all.windows(2).all(|two| two[0] == two[1]) {
        return all.first().map_or(String::new(), |edge| format!("{} all round", word(*edge)));
    }
    let name = |side: usize| match outline.shape {
        Shape::Rectangle { .. } => SIDES[side].to_owned(),
        _ => format!("side {}", side + 1),
    };
    let said: Vec<String> =
        all.iter().enumerate().map(|(side, edge)| format!("{} {}", name(side), word(*edge))).collect();
    said.join(", ")
}

fn word(edge: Edge) -> String {
    match edge {
        Edge::Clamped => "clamped".into(),
        Edge::Supported => "supported".into(),
        Edge::Free => "free".into(),
        Edge::Elastic { lift, tilt } => format!("on springs of {lift:.3e} N/m² and {tilt:.3e} N"),
    }
}

/// Surfaces like one whose sides are held in different ways, but with these ways at other sides.
#[derive(Debug, Default)]
pub(super) struct Arrangements {
    /// Mirror images, whose frequencies are the same to the last digit.
    pub mirrored: Vec<Surface>,
    /// Others, whose frequencies differ until other values of the fitted quantities make up for it.
    pub others: Vec<Surface>,
}

impl Arrangements {
    /// The arrangements of a rectangle; none of other outlines.
    pub fn of(surface: &Surface) -> Self {
        let mut all = Self::default();
        let (Shape::Rectangle { .. }, Edges::PerSide(_)) = (&surface.outline.shape, &surface.outline.edges)
        else {
            return all;
        };
        let own: [Edge; 4] = std::array::from_fn(|side| surface.outline.edges.of(side));
        let mut known = vec![own];
        let turned = TURNED.map(|side| own[side]);
        let images = is_symmetric(surface);
        for (base, order) in [own, turned].iter().flat_map(|base| MIRRORED.map(|order| (base, order))) {
            let edges = order.map(|side| base[side]);
            if known.contains(&edges) {
                continue;
            }
            let of_own = *base == own;
            known.push(edges);
            let mut arranged = surface.clone();
            arranged.outline.edges = Edges::PerSide(edges.to_vec());
            if of_own && images {
                all.mirrored.push(arranged);
                continue;
            }
            all.others.push(arranged);
            if images {
                // Of the others, too, mirror images have the same frequencies: one stands for all.
                break;
            }
        }
        all
    }
}

/// Whether a rectangle without its edge conditions is its own mirror image, at both axes.
fn is_symmetric(surface: &Surface) -> bool {
    let uneven = &surface.sheet.uneven;
    let even = uneven.thickness.is_none() && uneven.tension.is_none() && uneven.added_mass.is_none();
    let straight = uneven.grain.is_none_or(|grain| (2.0 * grain.direction).sin().abs() < 1e-9);
    let bare = surface.actuators.iter().all(|actuator| matches!(actuator.kind, ActuatorKind::Force));
    let bare = bare && uneven.scatterers.is_empty() && !uneven.resonates();
    even && straight && bare && surface.outline.holes.is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_physics::design::papers_surface;

    fn arranged(edges: [Edge; 4]) -> Arrangements {
        let mut surface = papers_surface();
        surface.outline.edges = Edges::PerSide(edges.to_vec());
        Arrangements::of(&surface)
    }

    #[test]
    fn a_side_may_be_at_three_others() {
        let (c, f) = (Edge::Clamped, Edge::Free);
        let one = arranged([c, f, f, f]);
        let edges = |of: &[Surface]| of.iter().map(|s| words(&s.outline)).collect::<Vec<_>>();
        assert_eq!(edges(&one.mirrored), ["bottom free, right free, top clamped, left free"]);
        assert_eq!(edges(&one.others), ["bottom free, right clamped, top free, left free"]);
    }

    #[test]
    fn what_is_held_alike_all_round_is_one_arrangement() {
        let all = arranged([Edge::Supported; 4]);
        assert!(all.mirrored.is_empty() && all.others.is_empty());
    }

    #[test]
    fn opposite_sides_have_no_mirror_image() {
        let (c, f) = (Edge::Clamped, Edge::Free);
        let all = arranged([c, f, c, f]);
        assert_eq!((all.mirrored.len(), all.others.len()), (0, 1));
    }
}
