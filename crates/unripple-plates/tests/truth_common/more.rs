//! More sheets whose frequencies are known by another route, for long runs: with those of `cases`, sixty of twelve kinds.

use super::cases::{Case, TOLD, disc, grained, hz, plate, regular, ring, weighted, whole};
use super::radial::{self, Piece};
use super::strips::{self, Local};
use super::{sectors, sheets};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use unripple_core::*;
use unripple_plates::{Accuracy, Modes};

/// All of them.
pub fn all() -> Vec<Case> {
    let lists = [polygons(), membranes(), sharp(), round(), strips(), held_by_springs(), discs(), uneven()];
    lists.into_iter().flatten().chain(extrapolated()).collect()
}

/// Some of them, for a few seconds: one of a kind, and coarse accuracies.
pub fn some() -> Vec<Case> {
    let lists = [sharp(), round(), strips(), held_by_springs(), discs()];
    let first = lists.into_iter().filter_map(|list| list.into_iter().nth(1));
    first.map(|case| Case { finest: 1e-4, ..case }).collect()
}

/// The same case asked for at most at some accuracy.
fn up_to(finest: f64, case: Case) -> Case {
    Case { finest, ..case }
}

/// Numbers of half waves, or of whatever stands for them.
fn pairs() -> impl Iterator<Item = (f64, f64)> {
    (1..30).flat_map(|m| (1..30).map(move |n| (f64::from(m), f64::from(n))))
}

/// Supported plates on convex polygons.
fn polygons() -> Vec<Case> {
    let supported = |vertices: &[[f64; 2]], tension: f64| {
        sheets::sheet(sheets::polygon(vertices, Edges::All(Edge::Supported)), 1.0, tension, 0.3)
    };
    let right = pairs().filter(|(m, n)| m > n).map(|(m, n)| PI * m.hypot(n));
    // The modes of Lamé's triangle that are odd across an altitude.
    let half = pairs().filter(|(m, n)| m > n).map(|(m, n)| 4.0 * PI / 3.0 * (m * m + m * n + n * n).sqrt());
    vec![
        whole(
            "supported right-angled triangle",
            supported(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], 0.0),
            right.map(|k| hz(k, 0.0)).collect(),
            90.0,
        ),
        whole(
            "supported triangle of 30, 60 and 90 degrees",
            supported(&[[0.0, 0.0], [0.5, 0.0], [0.5, 0.75f64.sqrt()]], 0.0),
            half.map(|k| hz(k, 0.0)).collect(),
            300.0,
        ),
        regular("supported pentagon", 5),
        regular("supported octagon", 8),
        up_to(1e-5, regular("supported 16-gon", 16)),
        regular("supported 96-gon", 96),
    ]
}

/// Membranes.
fn membranes() -> Vec<Case> {
    let fixed = |outline: Outline| sheets::sheet(outline, 0.0, 1.0, 0.3);
    let triangle = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.75f64.sqrt()]];
    let lame = pairs().map(|(m, n)| 2.0 / 3.0 * (m * m + m * n + n * n).sqrt());
    let sector = |name: &str, angle: f64, k_top: f64| {
        let known = sectors::membrane(angle, k_top + 4.0);
        let outline = sheets::sector(angle, Edge::Clamped, Edge::Clamped);
        whole(name, fixed(outline), known.iter().map(|k| k / TAU).collect(), k_top / TAU)
    };
    let annulus = Piece { radii: [0.3, 1.0], bending: 0.0, poisson: 0.3, tension: 1.0, mass: 1.0 };
    vec![
        whole(
            "membrane of an equilateral triangle",
            fixed(sheets::polygon(&triangle, Edges::All(Edge::Clamped))),
            lame.collect(),
            6.0,
        ),
        sector("membrane of five eighths of a circle", 1.25 * PI, 12.0),
        sector("membrane of nine tenths of a circle", 1.8 * PI, 12.0),
        whole(
            "ring of membrane",
            fixed(sheets::ring(0.3, [Edge::Clamped; 2])),
            // Without bending an edge that is held has any slope.
            radial::frequencies(&[annulus], [Edge::Supported; 2], 3.5),
            2.4,
        ),
    ]
}

/// Sectors of plates with supported straight sides. If a whole number of them fills a half circle, their modes are those of the circle
/// with a multiple of that number of nodal diameters.
fn sharp() -> Vec<Case> {
    let of = |name: &str, parts: u32, arc: Edge, near: f64| {
        let pieces = [[0.0, 0.4], [0.4, 0.7], [0.7, 1.0]].map(|radii| plate(radii, 0.0));
        let known = (1..12).flat_map(|n| radial::of_diameters(&pieces, [arc; 2], n * parts, 1.3 * near));
        let outline = sheets::sector(PI / f64::from(parts), Edge::Supported, arc);
        whole(name, sheets::sheet(outline, 1.0, 0.0, 0.3), known.collect(), near)
    };
    let re_entrant = |name: &str, angle: f64| {
        let known = sectors::plate(angle, 13.0);
        let outline = sheets::sector(angle, Edge::Supported, Edge::Clamped);
        whole(
            name,
            sheets::sheet(outline, 1.0, 0.0, 0.3),
            known.iter().map(|k| hz(*k, 0.0)).collect(),
            hz(10.0, 0.0),
        )
    };
    vec![
        of("sector of 5 degrees, clamped arc", 36, Edge::Clamped, 600.0),
        of("sector of 12 degrees, clamped arc", 15, Edge::Clamped, 180.0),
        of("sector of 30 degrees, clamped arc", 6, Edge::Clamped, 60.0),
        of("sector of 45 degrees, free arc", 4, Edge::Free, 40.0),
        of("sector of 60 degrees, clamped arc", 3, Edge::Clamped, 40.0),
        // Energy falls as r^0.4 and r^0.2 there: finer meshes than are made would be needed for more.
        up_to(1e-4, re_entrant("supported corner of 225 degrees", 1.25 * PI)),
        up_to(1e-2, re_entrant("supported corner of 324 degrees", 1.8 * PI)),
    ]
}

/// Circles and rings of plates.
fn round() -> Vec<Case> {
    use Edge::{Clamped, Free, Supported};
    vec![
        ring("supported circle under much tension", 0.0, [Supported; 2], 5000.0, 11.0),
        ring("clamped circle with a small free hole", 0.1, [Free, Clamped], 0.0, 10.0),
        ring("supported circle with a free hole", 0.5, [Free, Supported], 0.0, 10.0),
        ring("free ring", 0.4, [Free; 2], 0.0, 9.0),
        ring("ring supported outside, clamped inside, under tension", 0.3, [Clamped, Supported], 300.0, 11.0),
        ring("narrow clamped ring", 0.8, [Clamped; 2], 0.0, 30.0),
    ]
}

/// Rectangles between two supported sides: other edges, and properties that vary along these.
fn strips() -> Vec<Case> {
    use Edge::{Clamped, Free, Supported};
    let sides = [1.0, 0.7];
    let of = |name: &str, edges: [Edge; 2], tension: f64, near: f64, change: &dyn Fn(&mut Surface)| {
        strip(name, sides, edges, tension, near, change)
    };
    let profile = |values: &[f64]| Profile::new(&[values.to_vec()]);
    vec![
        of("rectangle supported on two sides, free on two", [Free; 2], 0.0, 80.0, &|_| {}),
        of("rectangle supported on two sides, clamped and free", [Clamped, Free], 0.0, 80.0, &|_| {}),
        of("supported rectangle of varying thickness", [Supported; 2], 0.0, 80.0, &|surface| {
            surface.sheet.uneven.thickness = profile(&[1.0, 1.3]);
        }),
        of("clamped and free rectangle of varying thickness", [Clamped, Free], 0.0, 80.0, &|surface| {
            surface.sheet.uneven.thickness = profile(&[1.1, 0.95, 0.8]);
        }),
        of(
            "clamped and supported rectangle of varying tension",
            [Clamped, Supported],
            300.0,
            90.0,
            &|surface| {
                surface.sheet.uneven.tension = profile(&[0.9, 1.2, 1.4]);
            },
        ),
        of("supported rectangle with added mass", [Supported; 2], 0.0, 70.0, &|surface| {
            surface.sheet.uneven.added_mass = profile(&[0.0, 0.8]);
        }),
    ]
}

/// A rectangle between two supported sides, with edge conditions on the left and on the right, and whatever changes along x.
fn strip(
    name: &str,
    sides: [f64; 2],
    edges: [Edge; 2],
    tension: f64,
    near: f64,
    change: &dyn Fn(&mut Surface),
) -> Case {
    let corners = [[0.0, 0.0], [sides[0], 0.0], sides, [0.0, sides[1]]];
    let all = vec![Edge::Supported, edges[1], Edge::Supported, edges[0]];
    let mut surface = sheets::sheet(sheets::polygon(&corners, Edges::PerSide(all)), 1.0, tension, 0.3);
    change(&mut surface);
    let uneven = surface.sheet.uneven.clone();
    let at = |x: f64| {
        let of = |p: &Option<Profile>, none: f64| {
            p.as_ref().map_or(none, |p| p.at(Point::new(x, 0.0), (sides[0], sides[1])))
        };
        let thickness = of(&uneven.thickness, 1.0);
        Local {
            bending: thickness.powi(3),
            tension: tension * of(&uneven.tension, 1.0),
            mass: thickness + of(&uneven.added_mass, 0.0),
        }
    };
    let known = strips::frequencies(sides, edges, 0.3, at, 1.3 * near);
    whole(name, surface, known, near)
}

/// Springs along edges, from soft to hard.
fn held_by_springs() -> Vec<Case> {
    let of = |name: &str, lift: f64, tilt: f64| {
        let edge = Edge::Elastic { lift, tilt };
        strip(name, [1.0, 0.7], [edge; 2], 0.0, 80.0, &|_| {})
    };
    let circle = |name: &str, lift: f64, tilt: f64| {
        let edge = Edge::Elastic { lift, tilt };
        let pieces = [[0.0, 0.5], [0.5, 1.0]].map(|radii| plate(radii, 0.0));
        let known = radial::frequencies(&pieces, [edge; 2], 26.0);
        let outline = sheets::meshed_circle(edge);
        whole(name, sheets::sheet(outline, 1.0, 0.0, 0.3), known, 18.0)
    };
    vec![
        of("rectangle on soft springs", 10.0, 0.1),
        of("rectangle on springs", 1e3, 3.0),
        of("rectangle on hard springs", 1e7, 1e4),
        circle("circle on soft springs", 5.0, 0.0),
        circle("circle on hard springs", 1e6, 10.0),
    ]
}

/// Discs glued to the middle of circles.
fn discs() -> Vec<Case> {
    use Edge::{Clamped, Free, Supported};
    [
        disc("clamped circle with a thin stiff disc", Clamped, 0.0, [0.2, 0.5, 20.0, 5.0], 16.0),
        disc("supported circle with a thick soft disc", Supported, 0.0, [0.4, 3.0, 0.05, 0.5], 16.0),
        disc("free circle with a heavy disc", Free, 0.0, [0.3, 1.0, 1.0, 6.0], 14.0),
        disc("clamped circle under tension with a small disc", Clamped, 300.0, [0.08, 1.0, 3.0, 3.0], 22.0),
    ]
    .map(|case| up_to(1e-5, case))
    .into()
}

/// Point masses and grain.
fn uneven() -> Vec<Case> {
    vec![
        weighted("supported rectangle with a small point mass", [0.23, 0.61], 0.02),
        weighted("supported rectangle with a point mass as heavy as itself", [0.52, 0.37], 1.0),
        grained("supported rectangle, strong grain along a side", 0.0, [0.05, 0.08], 30.0),
        grained("clamped rectangle, grain turned by 60 degrees", PI / 3.0, [0.2, 0.15], 45.0),
        grained("clamped rectangle, grain across", FRAC_PI_2, [0.4, 0.3], 45.0),
    ]
}

/// Outlines for which nobody has a formula, against the same elements on far finer meshes.
fn extrapolated() -> Vec<Case> {
    use Edge::{Clamped, Free};
    let ell = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [0.0, -1.0]];
    let cross = [
        [1.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [3.0, 1.0],
        [3.0, 2.0],
        [2.0, 2.0],
        [2.0, 3.0],
        [1.0, 3.0],
        [1.0, 2.0],
        [0.0, 2.0],
        [0.0, 1.0],
        [1.0, 1.0],
    ];
    let point = |i: u32| {
        let (radius, angle) = (if i.is_multiple_of(2) { 1.0 } else { 0.5 }, 0.2 * PI * f64::from(i));
        [radius * angle.cos(), radius * angle.sin()]
    };
    let star: Vec<[f64; 2]> = (0..10).map(point).collect();
    // Four cubics for a circle of radius 1 (Goldapp 1991), stretched.
    let c = 0.551_915_024_494;
    let at = |x: f64, y: f64| Point::new(1.5 * (1.0 + x), 1.0 + y);
    let quarter = |turn: u32| {
        let (s, c0) = (0.5 * PI * f64::from(turn)).sin_cos();
        let turned = |x: f64, y: f64| at(c0 * x - s * y, s * x + c0 * y);
        Side::Cubic([turned(1.0, 0.0), turned(1.0, c), turned(c, 1.0), turned(0.0, 1.0)])
    };
    let ellipse =
        |edge: Edge| Outline::new(Shape::Path((0..4).map(quarter).collect())).with_edges(Edges::All(edge));
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.8], [0.0, 0.8]];
    let slotted = |edge: Edge| {
        let mut hole = Hole::new(&Shape::Rectangle { width: 0.4, height: 0.02 }, Point::new(0.3, 0.35));
        hole.edges = Edges::All(Free);
        sheets::polygon(&square, Edges::All(edge)).with_hole(hole)
    };
    let of = |name: &str, outline: Outline, tension: f64, near: f64| {
        let surface = sheets::sheet(outline, 1.0, tension, 0.3);
        let reference = Modes::solve(&surface, 1.2 * near, Accuracy::or_best(1e-6)).unwrap();
        let known = reference.frequencies_hz().into_iter().filter(|hz| *hz > 0.0).collect();
        Case { finest: 1e-4, told: TOLD.max(reference.error()), ..whole(name, surface, known, near) }
    };
    vec![
        of("clamped L", sheets::polygon(&ell, Edges::All(Clamped)), 0.0, 14.0),
        of("clamped L under tension", sheets::polygon(&ell, Edges::All(Clamped)), 100.0, 20.0),
        of("free cross", sheets::polygon(&cross, Edges::All(Free)), 0.0, 3.0),
        of("clamped star", sheets::polygon(&star, Edges::All(Clamped)), 0.0, 40.0),
        of("clamped ellipse", ellipse(Clamped), 0.0, 12.0),
        of("free ellipse", ellipse(Free), 0.0, 8.0),
        up_to(1e-3, of("clamped rectangle with a slot", slotted(Clamped), 0.0, 40.0)),
        of("free rectangle with a slot", slotted(Free), 0.0, 30.0),
    ]
}
