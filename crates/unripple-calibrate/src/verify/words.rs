//! Findings on points, in words.

use super::judge::{Bench, Judged, Kind, Whose};
use super::levels::Levels;
use super::verdict::{Doubted, PointVerdict, VerifyOptions};
use unripple_core::Point;

/// Smallest distance from the stated place, in shortest wavelengths of the band, at which a point is
/// doubtful, and (`WORTH`) at which it is reported.
const FAR: f64 = 0.25;
const WORTH: f64 = 0.025;

/// The verdict on one point.
pub(super) fn verdict(
    bench: &Bench,
    judged: &[Judged],
    levels: &Levels,
    point: usize,
    common: f64,
) -> PointVerdict {
    let one = &judged[point];
    let at = bench.places[point];
    let lambda = bench.surface_wave();
    let off = one.nearby.at.distance(at);
    let unlike = one.own.unexplained() > bench.limit();
    let told = one.kind == Kind::Here && off > WORTH * lambda && (unlike || levels.moved(one));
    let counts = one.kind == Kind::Here && bench.options.probe;
    let correction = levels.correction(one, bench.quick.actuators.len()).filter(|_| counts);
    // A response measured too far beside its place is useless there; a large unexplained share at the place shows that
    // as well.
    let beside = off > FAR * lambda || unlike;
    let doubt = match one.kind {
        Kind::Here if beside && told => Some(beside_it(bench, at, one.nearby.at)),
        Kind::Here if levels.common.is_none() && bench.options.probe => Some(format!(
            "its gain is {:.2}, and other points have other gains: expected one gain at all points (was the probe's gain \
             changed?)",
            levels.gain(one) / levels.scale
        )),
        Kind::Here => None,
        Kind::Elsewhere(spot, whose) => Some(elsewhere(bench, judged, point, spot.at, whose)),
        Kind::Late(late) => Some(late_by(bench, late)),
        Kind::Nothing => Some(nowhere(bench, one.own.unexplained())),
    };
    PointVerdict {
        at,
        unexplained: one.own.unexplained(),
        gain: levels.gain(one) / levels.scale,
        late: one.nearby.late - common,
        fits: told.then_some((one.nearby.at, one.nearby.found.unexplained())),
        doubt,
        correction,
    }
}

impl Bench<'_> {
    /// The shortest wavelength of the surface's band, in metres.
    pub fn surface_wave(&self) -> f64 {
        unripple_physics::Medium::of(&self.surface.sheet).lambda_min(self.surface.emission.band[1])
    }
}

/// Doubt about a point whose response fits another place, in words.
fn elsewhere(bench: &Bench, judged: &[Judged], point: usize, at: Point, whose: Whose) -> String {
    match whose {
        Whose::Point(other) => match judged[other].kind {
            Kind::Elsewhere(_, Whose::Point(back)) if back == point => format!(
                "its recording fits point {}, and that of point {} fits it: the two are exchanged (exchange the files)",
                bench.options.number(other),
                bench.options.number(other)
            ),
            _ => format!(
                "its recording fits point {} at {}, not its own place (is it a recording of that point? {} again)",
                bench.options.number(other),
                bench.places[other],
                again(bench)
            ),
        },
        Whose::Actuator(a) if bench.options.probe => format!(
            "its recording fits the place of actuator `{}`: is the probe wired to its own channel?",
            bench.surface.actuators[a].name
        ),
        Whose::Actuator(_) | Whose::Nobody => beside_it(bench, bench.places[point], at),
    }
}

/// Doubt about a point that was measured beside its place, in words.
fn beside_it(bench: &Bench, from: Point, to: Point) -> String {
    let (who, what) = match bench.options.probe {
        true => ("the probe seems", "move it to the point, or give the place where it was"),
        false => ("the taps seem", "tap at the point, or give the place where they were"),
    };
    format!("{who} to have been {} the point, at {to} ({what})", away(from, to))
}

/// Doubt about a point whose responses come later than at the other points by `late` s, in words.
fn late_by(bench: &Bench, late: f64) -> String {
    let who = if bench.options.probe { "probe's signal comes" } else { "responses to its taps come" };
    let way = if late > 0.0 { "later" } else { "earlier" };
    format!(
        "the {who} {:.2} ms {way} than at the other points (were samples lost? {} again)",
        1e3 * late.abs(),
        again(bench)
    )
}

/// Doubt about a point of whose responses a share `unexplained`, as amplitude, fits no place, in words.
fn nowhere(bench: &Bench, unexplained: f64) -> String {
    let (who, what) = match bench.options.probe {
        true => ("probe's signal fits", "another channel, samples lost, another clock"),
        false => ("responses to its taps fit", "something else that moved it, a tap that slid, samples lost"),
    };
    format!(
        "{:.0} % of the {who} no place of this surface ({what}, or a surface that has changed since: {} again)",
        100.0 * unexplained,
        again(bench)
    )
}

/// Instruction to measure a point again, in words.
fn again(bench: &Bench) -> &'static str {
    if bench.options.probe { "record it" } else { "tap" }
}

/// How far and which way a place is from another: `3.1 mm to the right of`.
fn away(from: Point, to: Point) -> String {
    let (dx, dy) = (to.x - from.x, to.y - from.y);
    let way = match dx.abs() > dy.abs() {
        true if dx > 0.0 => "to the right of",
        true => "to the left of",
        false if dy > 0.0 => "above",
        false => "below",
    };
    format!("{:.1} mm {way}", 1e3 * from.distance(to))
}

/// Collects the notes and doubts of all points.
pub(super) fn gather(
    bench: &Bench,
    points: &[PointVerdict],
    (judged, levels): (&[Judged], &Levels),
    (notes, doubts): (&mut Vec<String>, &mut Vec<Doubted>),
) {
    for (p, point) in points.iter().enumerate() {
        let number = bench.options.number(p);
        if let Some(why) = &point.doubt {
            doubts.push(Doubted { what: format!("point {number}: {why}"), points: vec![p] });
            continue;
        }
        if let Some((at, _)) = point.fits {
            notes.push(format!(
                "point {number}: the {} may have been {} it (± {:.2} mm)",
                if bench.options.probe { "probe" } else { "taps" },
                away(point.at, at),
                1e3 * judged[p].error
            ));
        }
        if let Some(factor) = point.correction {
            let sign = if factor < 0.0 { ", with the sign turned" } else { "" };
            notes.push(format!(
                "point {number}: its gain is {:.2} times that of the other points{sign}: corrected",
                1.0 / factor.abs()
            ));
        } else if let Some(factor) = levels.factor_to_common(&judged[p]).filter(|_| bench.options.probe) {
            notes.push(format!(
                "point {number}: its gain seems to be {:.2} times that of the other points, which a wrong place or an error of \
                 the model may also explain: not corrected",
                1.0 / factor
            ));
        }
    }
}

/// A doubt about the probe's delay.
pub(super) fn delay(options: &VerifyOptions, delay: f64, told: bool) -> Option<Doubted> {
    let said = options.probe_delay.filter(|_| told)?;
    Some(Doubted {
        what: format!(
            "the probe's delay is given as {:.3} ms, and the model finds {:.3} ms",
            1e3 * said,
            1e3 * (said + delay)
        ),
        points: Vec::new(),
    })
}
