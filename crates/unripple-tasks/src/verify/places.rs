//! The places at which the probe records: the target, and some outside its focal disc.

use super::Ask;
use crate::{Source, TaskError, point};
use unripple::core::{FOCAL_RADIUS, Outline, Point};

/// Largest number of places that are chosen or given: on a real surface somebody moves the probe to each.
const MOST: usize = 64;

/// Part of each side of the outline's bounding box in which places are chosen: near the rim of a held sheet little moves.
const WITHIN: [f64; 2] = [0.1, 0.9];

/// Bases of the Halton sequence in the plane (J. H. Halton, Numer. Math. 2 (1960)), whose points lie evenly for any number
/// of them.
const BASES: [u32; 2] = [2, 3];

/// Points of the sequence that are tried for each place that is wanted: enough for outlines of which a twentieth is left.
const TRIED: u32 = 20;

/// Returns an error for numbers of places that make no sense.
pub(super) fn check(ask: &Ask) -> Result<(), TaskError> {
    let number = |field, found: usize| match found <= MOST {
        true => Ok(()),
        false => Err(TaskError::ask(field, format!("at most {MOST}"), found)),
    };
    number("probe_count", ask.probe_count)?;
    number("probes_m", ask.probes_m.len())
}

/// Radius of the focal disc, in m.
pub(super) fn disc(source: &Source) -> f64 {
    FOCAL_RADIUS * source.shortest_wavelength()
}

/// All places, the target first; each must lie on the sheet.
pub(super) fn all(ask: &Ask, source: &Source, target: Point) -> Result<Vec<Point>, TaskError> {
    let outline = &source.surface.outline;
    let mut places = vec![target];
    places.extend(ask.probes_m.iter().map(point));
    for (place, field) in places.iter().zip(["target_m"].into_iter().chain(std::iter::repeat("probes_m"))) {
        if !outline.contains(*place) {
            let expected = format!("a place on the sheet, such as the nearest, {}", outline.nearest(*place));
            return Err(TaskError::ask(field, expected, place));
        }
    }
    if ask.probes_m.is_empty() {
        places.extend(chosen(ask.probe_count, source, target));
    }
    Ok(places)
}

/// Places outside the focal disc: of a library some of its points, evenly among them; of a surface evenly over the sheet.
fn chosen(count: usize, source: &Source, target: Point) -> Vec<Point> {
    let disc = disc(source);
    let outside = |place: &Point| place.distance(target) > disc;
    match &source.stored {
        Some(stored) => {
            let free = |place: &&Point| {
                outside(place) && stored.responses.ports.iter().all(|port| port.at.distance(**place) > 1e-6)
            };
            let known: Vec<Point> = stored.responses.points.iter().filter(free).copied().collect();
            let taken = count.min(known.len());
            (0..taken).map(|n| known[n * known.len() / taken]).collect()
        }
        None => {
            let outline = &source.surface.outline;
            let tried = (1..=TRIED * count as u32).map(|n| halton(n, outline));
            tried.filter(|place| outline.contains(*place) && outside(place)).take(count).collect()
        }
    }
}

/// A point of the Halton sequence in the inner part of an outline's bounding box, in m.
fn halton(n: u32, outline: &Outline) -> Point {
    let share = |base: u32| {
        let (mut rest, mut digit, mut sum) = (n, 1.0 / f64::from(base), 0.0);
        while rest > 0 {
            sum += f64::from(rest % base) * digit;
            (rest, digit) = (rest / base, digit / f64::from(base));
        }
        WITHIN[0] + (WITHIN[1] - WITHIN[0]) * sum
    };
    let (width, height) = outline.extent();
    Point::new(share(BASES[0]) * width, share(BASES[1]) * height)
}
