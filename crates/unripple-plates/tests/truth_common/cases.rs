//! Sheets whose frequencies are known by another route, for statements of error to be held against.

use super::particular::Domain;
use super::radial::{self, Piece};
use super::{masses, ritz, sectors, sheets};
use std::f64::consts::{PI, TAU};
use unripple_core::*;
use unripple_plates::Modes;

/// The finest accuracy asked for on most sheets.
pub const FINEST: f64 = 1e-6;

/// A sheet with known frequencies.
pub struct Case {
    pub name: String,
    pub surface: Surface,
    /// Top frequency, in Hz, clear of any mode.
    pub top_hz: f64,
    /// Known frequencies up to the top, in Hz, ascending, without rigid modes: all, or some of them that no other mode is near.
    pub known: Vec<f64>,
    /// Whether all are known.
    pub all: bool,
    /// The finest accuracy that a test asks for: more would take minutes.
    pub finest: f64,
    /// A bound of the relative error of the known frequencies.
    pub told: f64,
}

/// The relative error of frequencies that are known in closed form or by sums of many terms.
pub const TOLD: f64 = 1e-9;

impl Case {
    /// The largest relative error of frequencies found, of those that are known; infinite where modes are missing or too many.
    pub fn error(&self, found: &[f64]) -> f64 {
        let moving: Vec<f64> = found.iter().copied().filter(|hz| *hz > 0.0).collect();
        if self.all {
            let pairs = moving.iter().zip(&self.known);
            let worst = pairs.map(|(f, k)| (f / k - 1.0).abs()).fold(0.0, f64::max);
            return if moving.len() == self.known.len() { worst } else { f64::INFINITY };
        }
        let nearest = |k: &f64| moving.iter().map(|f| (f / k - 1.0).abs()).fold(f64::INFINITY, f64::min);
        self.known.iter().map(nearest).fold(0.0, f64::max)
    }
}

/// A case with all frequencies known, from those up to well beyond `near` (Hz): the top is put into the widest gap near it.
pub fn whole(name: impl Into<String>, surface: Surface, mut known: Vec<f64>, near: f64) -> Case {
    known.sort_by(f64::total_cmp);
    let gaps = known.windows(2).filter(|w| w[0] > 0.8 * near && w[1] < 1.2 * near);
    let widest = gaps.max_by(|a, b| (a[1] / a[0]).total_cmp(&(b[1] / b[0])));
    let top_hz = widest.map_or(near, |w| 0.5 * (w[0] + w[1]));
    known.retain(|hz| *hz < top_hz);
    Case { name: name.into(), surface, top_hz, known, all: true, finest: FINEST, told: TOLD }
}

/// A plate's frequency (Hz) for a wavenumber: D = ρ_s = 1.
pub fn hz(k: f64, tension: f64) -> f64 {
    k * (k * k + tension).sqrt() / TAU
}

/// All cases.
pub fn all() -> Vec<Case> {
    [convex(), singular(), round(), rectangles(), uneven()].into_iter().flatten().collect()
}

/// Supported polygons without re-entrant corners.
fn convex() -> Vec<Case> {
    let supported = |vertices: &[[f64; 2]], tension: f64| {
        sheets::sheet(sheets::polygon(vertices, Edges::All(Edge::Supported)), 1.0, tension, 0.3)
    };
    let pairs = || (1..30).flat_map(|m| (1..30).map(move |n| (f64::from(m), f64::from(n))));
    // Lamé's triangle of side 1: k² = (4π/3)² (m² + mn + n²).
    let equilateral = pairs().map(|(m, n)| 4.0 * PI / 3.0 * (m * m + m * n + n * n).sqrt());
    let right = pairs().filter(|(m, n)| m > n).map(|(m, n)| PI * m.hypot(n));
    let rectangle = pairs().map(|(m, n)| PI * m.hypot(n / 0.7));
    let [a, b, c] = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.75f64.sqrt()]];
    let mut cases = vec![
        whole(
            "supported equilateral triangle",
            supported(&[a, b, c], 0.0),
            equilateral.map(|k| hz(k, 0.0)).collect(),
            130.0,
        ),
        whole(
            "supported right-angled triangle under tension",
            supported(&[a, b, [0.0, 1.0]], 50.0),
            right.map(|k| hz(k, 50.0)).collect(),
            90.0,
        ),
        whole(
            "supported rectangle, as a polygon, under tension",
            supported(&[a, b, [1.0, 0.7], [0.0, 0.7]], 300.0),
            rectangle.map(|k| hz(k, 300.0)).collect(),
            90.0,
        ),
    ];
    for (name, count) in [("supported hexagon", 6), ("supported 24-gon", 24), ("supported 48-gon", 48)] {
        cases.push(regular(name, count));
    }
    cases
}

/// Modes of a supported regular polygon that its mirrors leave as they are: the first two of a hexagon, by particular solutions, and
/// those of polygons of many sides by the expansion around the circle.
pub fn regular(name: &str, count: u32) -> Case {
    let area = 0.5 * f64::from(count) * (TAU / f64::from(count)).sin();
    let circle = (PI / area).sqrt();
    // Zeros of J_0 for the circle of that area, which has the lowest wavenumber (Faber and Krahn).
    let zeros = [2.404_825_557_695_773, 5.520_078_110_286_311];
    let known: Vec<f64> = if count < 12 {
        let domain = Domain::regular(count);
        zeros
            .iter()
            .map(|zero| domain.wavenumbers([zero * circle * 0.99, zero * circle * 1.04], 40)[0])
            .collect()
    } else {
        let modes = if count < 40 { &zeros[..1] } else { &zeros[..] };
        modes.iter().map(|zero| zero * circle * around_circle(count, zero * zero).sqrt()).collect()
    };
    let surface = sheets::sheet(sheets::regular(count, Edge::Supported), 1.0, 0.0, 0.3);
    let known: Vec<f64> = known.iter().map(|k| hz(*k, 0.0)).collect();
    // With many corners finer ones would take minutes.
    let finest = match count {
        0..40 => FINEST,
        40..60 => 1e-4,
        _ => 1e-3,
    };
    Case { name: name.into(), surface, top_hz: hz(5.7 * circle, 0.0), known, all: false, finest, told: TOLD }
}

/// The eigenvalue of a regular membrane of many sides over that of the circle of the same area, for a mode without nodal diameters
/// whose eigenvalue on the unit circle is `square` (Jones, *J. Math. Anal. Appl.* 512, 126070, 2022).
pub fn around_circle(sides: u32, square: f64) -> f64 {
    let (n, zeta3, zeta5, zeta7) =
        (f64::from(sides), 1.202_056_903_159_594, 1.036_927_755_143_37, 1.008_349_277_381_923);
    1.0 + 4.0 * zeta3 / n.powi(3)
        + (12.0 - 2.0 * square) * zeta5 / n.powi(5)
        + (8.0 + 4.0 * square) * zeta3 * zeta3 / n.powi(6)
        + (36.0 - 12.0 * square - 2.0 * square * square) * zeta7 / n.powi(7)
}

/// Re-entrant corners.
fn singular() -> Vec<Case> {
    let three_quarters = 1.5 * PI;
    let ell = Domain::ell().wavenumbers([2.5, 7.6], 300);
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [0.0, -1.0]];
    let outline = sheets::polygon(&corners, Edges::All(Edge::Clamped));
    let sector = |straight, bending| {
        sheets::sheet(sheets::sector(three_quarters, straight, Edge::Clamped), bending, 1.0 - bending, 0.3)
    };
    let membranes = sectors::membrane(three_quarters, 16.0);
    let plates = sectors::plate(three_quarters, 14.0);
    vec![
        whole(
            "L-shaped membrane",
            sheets::sheet(outline, 0.0, 1.0, 0.3),
            ell.iter().map(|k| k / TAU).collect(),
            6.8 / TAU,
        ),
        whole(
            "membrane of three quarters of a circle",
            sector(Edge::Clamped, 0.0),
            membranes.iter().map(|k| k / TAU).collect(),
            12.0 / TAU,
        ),
        whole(
            "supported re-entrant corner, three quarters of a circle",
            sector(Edge::Supported, 1.0),
            plates.iter().map(|k| hz(*k, 0.0)).collect(),
            hz(10.5, 0.0),
        ),
    ]
}

/// A ring of a plate: D = ρ_s = 1.
pub fn plate(radii: [f64; 2], tension: f64) -> Piece {
    Piece { radii, bending: 1.0, poisson: 0.3, tension, mass: 1.0 }
}

/// A circle, or a ring of some inner radius, with the edge conditions inside and outside, up to about a wavenumber.
pub fn ring(name: &str, inner: f64, edges: [Edge; 2], tension: f64, k_top: f64) -> Case {
    let middle = 0.5 * (inner + 1.0);
    let pieces = [plate([inner, middle], tension), plate([middle, 1.0], tension)];
    let outline = if inner > 0.0 { sheets::ring(inner, edges) } else { sheets::meshed_circle(edges[1]) };
    let surface = sheets::sheet(outline, 1.0, tension, 0.3);
    let top = hz(k_top, tension);
    whole(name, surface, radial::frequencies(&pieces, edges, 1.5 * top), top)
}

/// Circles and rings.
fn round() -> Vec<Case> {
    use Edge::{Clamped, Free, Supported};
    vec![
        ring("clamped circle", 0.0, [Clamped; 2], 0.0, 11.0),
        ring("supported circle", 0.0, [Supported; 2], 0.0, 11.0),
        ring("free circle", 0.0, [Free; 2], 0.0, 10.0),
        ring("clamped circle under tension", 0.0, [Clamped; 2], 400.0, 11.0),
        ring("clamped ring under tension", 0.5, [Clamped; 2], 2000.0, 14.0),
        ring("clamped ring under little tension", 0.4, [Clamped; 2], 50.0, 14.0),
        ring("supported ring", 0.4, [Supported; 2], 0.0, 12.0),
        ring("ring free outside, clamped inside", 0.3, [Clamped, Free], 0.0, 9.0),
    ]
}

/// Rectangles drawn as polygons, against the Ritz sums for plain rectangles.
fn rectangles() -> Vec<Case> {
    use Edge::{Clamped, Free, Supported};
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.7], [0.0, 0.7]];
    let of = |name: &str, edges: [Edge; 4], tension: f64, near: f64, accuracy: f64| {
        let edges = Edges::PerSide(edges.to_vec());
        let mut plain = sheets::sheet(sheets::polygon(&corners, edges.clone()), 1.0, tension, 0.3);
        let surface = plain.clone();
        plain.outline = Outline::new(Shape::Rectangle { width: 1.0, height: 0.7 }).with_edges(edges);
        let known = Modes::solve(&plain, 1.3 * near, accuracy).unwrap().frequencies_hz();
        whole(name, surface, known.into_iter().filter(|hz| *hz > 0.0).collect(), near)
    };
    vec![
        of("clamped rectangle", [Clamped; 4], 0.0, 90.0, 1e-10),
        of("clamped rectangle under tension", [Clamped; 4], 1000.0, 120.0, 1e-9),
        of(
            "rectangle supported on three sides, clamped on one",
            [Supported, Supported, Supported, Clamped],
            0.0,
            90.0,
            1e-9,
        ),
        of("free rectangle", [Free; 4], 0.0, 60.0, 1e-8),
    ]
}

/// Grain, a point mass, a glued disc.
fn uneven() -> Vec<Case> {
    vec![
        grained("supported rectangle, grain along a side", 0.0, [0.3, 0.2], 50.0),
        grained("clamped rectangle, grain turned", 0.5, [0.3, 0.2], 50.0),
        weighted("supported rectangle with a point mass", [0.37, 0.31], 0.3),
        // Of one material, sheet and disc bend as one plate of three times the thickness.
        disc("clamped circle with a glued disc", Edge::Clamped, 0.0, [0.35, 2.0, 1.0, 1.0], 20.0),
    ]
}

/// A rectangle with a grain at an angle (rad): supported if it is along a side, else clamped. `across` and `shear` are E2/E1 and G/E1.
pub fn grained(name: &str, angle: f64, [across, shear]: [f64; 2], near: f64) -> Case {
    let poisson = 0.3;
    let edge = if angle == 0.0 { Edge::Supported } else { Edge::Clamped };
    let outline = sheets::polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.7], [0.0, 0.7]], Edges::All(edge));
    let mut surface = sheets::sheet(outline, 1.0, 0.0, poisson);
    let young = surface.sheet.young;
    let uneven = &mut surface.sheet.uneven;
    uneven.grain = Some(Grain { direction: angle, young_across: across * young, shear: shear * young });
    let bending = ritz::turned_grain(poisson, across, shear, angle).map(|d| (1.0 - poisson * poisson) * d);
    let known = if angle == 0.0 {
        let [d11, d12, _, d22, _, d66] = bending;
        let of = |(m, n): (f64, f64)| {
            let (x, y) = ((m * PI).powi(2), (n * PI / 0.7).powi(2));
            (d11 * x * x + 2.0 * (d12 + 2.0 * d66) * x * y + d22 * y * y).sqrt() / TAU
        };
        let pairs = (1..30).flat_map(|m| (1..30).map(move |n| (f64::from(m), f64::from(n))));
        pairs.map(of).collect()
    } else {
        ritz::clamped([1.0, 0.7], bending, 1.0, 1.3 * near)
    };
    whole(name, surface, known, near)
}

/// A supported rectangle with a mass at a point, as a share of its own.
pub fn weighted(name: &str, at: [f64; 2], share: f64) -> Case {
    let sides = [1.0, 0.83];
    let corners = [[0.0, 0.0], [sides[0], 0.0], sides, [0.0, sides[1]]];
    let outline = sheets::polygon(&corners, Edges::All(Edge::Supported));
    let mut surface = sheets::sheet(outline, 1.0, 0.0, 0.3);
    let kind = ScattererKind::Mass(share * sides[0] * sides[1]);
    surface.sheet.uneven.scatterers = vec![Scatterer { at: Point::new(at[0], at[1]), kind }];
    let near = 60.0;
    let squares = masses::squares(sides, at, 1.0, share, (1.3 * TAU * near).powi(2));
    whole(name, surface, squares.iter().map(|s| s.sqrt() / TAU).collect(), near)
}

/// A circle with a disc glued to the middle: its radius, and its thickness, Young's modulus and density over those of the sheet.
pub fn disc(
    name: &str,
    edge: Edge,
    tension: f64,
    [radius, thick, stiff, heavy]: [f64; 4],
    near: f64,
) -> Case {
    let outline = Outline::new(Shape::Circle { radius: 1.0 }).with_edges(Edges::All(edge));
    let mut surface = sheets::sheet(outline, 1.0, tension, 0.3);
    let sheet = &surface.sheet;
    let kind = ScattererKind::Disc {
        radius,
        thickness: thick * sheet.thickness,
        young: stiff * sheet.young,
        density: heavy * sheet.density,
        poisson: sheet.poisson,
    };
    surface.sheet.uneven.scatterers = vec![Scatterer { at: Point::new(1.0, 1.0), kind }];
    // Two layers of thickness 1 and `thick` bend about their common neutral plane; a layer alone has 1/12.
    let neutral = (0.5 + stiff * thick * (1.0 + 0.5 * thick)) / (1.0 + stiff * thick);
    let layer = |stiff: f64, thick: f64, middle: f64| {
        stiff * (thick.powi(3) / 12.0 + thick * (middle - neutral).powi(2))
    };
    let bending = 12.0 * (layer(1.0, 1.0, 0.5) + layer(stiff, thick, 1.0 + 0.5 * thick));
    let middle = 0.5 * (radius + 1.0);
    let under = Piece { bending, mass: 1.0 + heavy * thick, ..plate([0.0, radius], tension) };
    let pieces = [under, plate([radius, middle], tension), plate([middle, 1.0], tension)];
    let known = radial::frequencies(&pieces, [edge; 2], 1.4 * near);
    whole(name, surface, known, near)
}
