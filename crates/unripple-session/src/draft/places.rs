//! Places for actuators that are added: near the rim, and as far as possible from the other actuators.

use unripple::core::{Actuator, ActuatorKind, Outline, Point, Surface};

/// Places along the rim that are looked at, and how far inside they lie, as shares of the way to the middle.
const AROUND: usize = 97;
const INWARD: [f64; 3] = [0.14, 0.22, 0.3];

/// Changes the number of actuators of a surface to `count`: the first ones stay, and each new one is placed
/// near the rim where it is farthest from all others, at varying depths, so that distances do not repeat.
pub fn fill(surface: &mut Surface, count: usize) {
    surface.actuators.truncate(count);
    let model = surface.actuators.first().cloned();
    while surface.actuators.len() < count {
        let taken: Vec<Point> = surface.actuators.iter().map(|actuator| actuator.at).collect();
        let Some(at) = loneliest(&surface.outline, &taken) else { return };
        let name =
            (1..).map(|i| format!("a{i}")).find(|name| surface.actuators.iter().all(|a| a.name != *name));
        let model = model.clone().unwrap_or(Actuator {
            name: String::new(),
            at,
            kind: ActuatorKind::Force,
            contact_radius: 0.0,
        });
        surface.actuators.push(Actuator { name: name.unwrap_or_default(), at, ..model });
    }
}

/// The place `at` (m) if it is on the sheet; otherwise a place near it, a little inside the rim.
pub fn onto(outline: &Outline, at: Point) -> Point {
    if outline.contains(at) {
        return at;
    }
    let (width, height) = outline.extent();
    let middle = Point::new(width / 2.0, height / 2.0);
    inside(outline, outline.nearest(at), middle, INWARD[0]).unwrap_or(middle)
}

fn loneliest(outline: &Outline, taken: &[Point]) -> Option<Point> {
    let (width, height) = outline.extent();
    let middle = Point::new(width / 2.0, height / 2.0);
    let rim = outline.rim(AROUND);
    let candidates = rim.iter().enumerate().filter_map(|(i, at)| {
        // Depths take turns, so that places are not mirror images of one another.
        inside(outline, *at, middle, INWARD[i * 2 % INWARD.len()])
    });
    let room = |at: &Point| taken.iter().map(|other| other.distance(*at)).fold(f64::INFINITY, f64::min);
    candidates.max_by(|a, b| room(a).total_cmp(&room(b)))
}

/// A place a share of the way from a point of the rim to the middle, if that is on the sheet.
fn inside(outline: &Outline, rim: Point, middle: Point, share: f64) -> Option<Point> {
    let at = Point::new(rim.x + share * (middle.x - rim.x), rim.y + share * (middle.y - rim.y));
    outline.contains(at).then_some(at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple::core::{Outline, Shape};
    use unripple::physics::design::papers_surface;

    #[test]
    fn new_actuators_lie_apart_on_the_sheet() {
        let mut film = papers_surface();
        film.outline = Outline::new(Shape::Stadium { straight: 0.06, radius: 0.04 });
        film.actuators.clear();
        fill(&mut film, 12);
        assert_eq!(film.actuators.len(), 12);
        for (i, one) in film.actuators.iter().enumerate() {
            assert!(film.outline.contains(one.at));
            assert!(
                film.actuators[..i]
                    .iter()
                    .all(|other| other.at.distance(one.at) > 8e-3 && other.name != one.name)
            );
        }
        fill(&mut film, 3);
        assert_eq!(film.actuators.len(), 3);
    }
}
