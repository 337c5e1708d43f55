//! Curves in files of effects.

use crate::surface::range::Limits;
use crate::surface::reader::{Entry, Faults};
use unripple_effects::{Curve, Envelope, limits};

/// Points of a curve, `[[x, y], …]`, ascending along x.
pub(super) fn points(
    entry: &Entry,
    along: &Limits,
    values: &Limits,
    faults: &mut Faults,
) -> Option<Vec<(f64, f64)>> {
    let shape = format!("rows [[{}, value], …], ascending", along.unit);
    let most = limits::MOST_POINTS;
    let Some(rows) = entry.items().filter(|rows| (1..=most).contains(&rows.len())) else {
        entry.refuse(format!("1 to {most} {shape}"), None, faults);
        return None;
    };
    let row = |row: &Entry, faults: &mut Faults| {
        let Some(pair) = row.items().filter(|pair| pair.len() == 2) else {
            row.refuse(&shape, None, faults);
            return None;
        };
        let (x, y) = (pair[0].number(along, faults), pair[1].number(values, faults));
        Some((x?, y?))
    };
    let read: Vec<Option<(f64, f64)>> = rows.iter().map(|item| row(item, faults)).collect();
    let points = read.into_iter().collect::<Option<Vec<_>>>()?;
    if let Some(i) = points.windows(2).position(|pair| pair[1].0 < pair[0].0) {
        rows[i + 1].refuse(format!("a row no earlier than the one before: {shape}"), None, faults);
        return None;
    }
    Some(points)
}

/// A curve of gains over time or speed.
pub(super) fn gains(entry: &Entry, along: &Limits, si: [f64; 2], faults: &mut Faults) -> Option<Curve> {
    let points = points(entry, along, &super::range::SHARE, faults)?;
    said(entry, Curve::new("place on a curve", points, si, limits::SHARE), faults)
}

/// An envelope of `amplitude` rows and `frequency_hz`, a number or rows.
pub(super) fn envelope(amplitude: &Entry, frequency: &Entry, faults: &mut Faults) -> Option<Envelope> {
    let shape = points(amplitude, &super::range::TIME, &super::range::SHARE, faults);
    let pitch = if frequency.is_number() {
        frequency.number(&super::range::FREQUENCY, faults).map(|hz| vec![(0.0, hz)])
    } else if frequency.items().is_some() {
        points(frequency, &super::range::TIME, &super::range::FREQUENCY, faults)
    } else {
        let expected = format!("{}, or rows [[ms, Hz], …]", super::range::FREQUENCY.expected());
        frequency.refuse(expected, None, faults);
        None
    };
    said(amplitude, Envelope::new(shape?, pitch?), faults)
}

/// The result of checking values together, each of which is legal alone; a fault if they are not legal together.
pub(super) fn said<T>(
    entry: &Entry,
    made: Result<T, unripple_effects::EffectsError>,
    faults: &mut Faults,
) -> Option<T> {
    made.map_err(|error| entry.refuse(format!("legal values together ({error})"), None, faults)).ok()
}
