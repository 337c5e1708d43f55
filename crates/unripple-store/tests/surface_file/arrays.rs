//! Actuators in rows, rings and grids, what they have in common said once, and edges on a strip of adhesive.

use crate::good::{GOOD, faults};
use unripple_core::{ActuatorKind, Edge, Edges, Patch, Point, Surface};
use unripple_store::{parse_surface, to_toml};

/// The good file with these tables in place of its actuator.
fn with(tables: &str) -> String {
    format!("{}{tables}", &GOOD[..GOOD.find("[[actuator]]").unwrap()])
}

fn surface(tables: &str) -> Surface {
    parse_surface(&with(tables), "film.toml").unwrap_or_else(|faults| panic!("{faults:#}"))
}

fn names(surface: &Surface) -> Vec<&str> {
    surface.actuators.iter().map(|actuator| actuator.name.as_str()).collect()
}

fn near(found: Point, x: f64, y: f64) -> bool {
    found.distance(Point::from_mm(x, y)) < 1e-12
}

#[test]
fn a_row_has_both_its_ends() {
    let surface = surface("[[actuator]]\nname = \"low\"\nrow_mm = [[10, 20], [140, 7.3]]\ncount = 4\n");
    assert_eq!(names(&surface), ["low-1", "low-2", "low-3", "low-4"]);
    let at: Vec<Point> = surface.actuators.iter().map(|actuator| actuator.at).collect();
    assert_eq!([at[0], at[3]], [Point::from_mm(10.0, 20.0), Point::from_mm(140.0, 7.3)], "to the last bit");
    let step = at[0].distance(at[1]);
    assert!(at.windows(2).all(|pair| (pair[0].distance(pair[1]) - step).abs() < 1e-15));
}

#[test]
fn a_ring_is_even_and_an_arc_has_both_its_ends() {
    let ring =
        surface("[[actuator]]\nring = { centre_mm = [75, 50], radius_mm = 40, start_deg = 90 }\ncount = 4\n");
    assert_eq!(names(&ring), ["a1", "a2", "a3", "a4"]);
    for (actuator, [x, y]) in
        ring.actuators.iter().zip([[75.0, 90.0], [35.0, 50.0], [75.0, 10.0], [115.0, 50.0]])
    {
        assert!(near(actuator.at, x, y), "{actuator:?}");
    }
    let arc = "ring = { centre_mm = [75, 50], radius_mm = 40, start_deg = 0, sweep_deg = -180 }\ncount = 3\n";
    let arc = surface(&format!("[[actuator]]\n{arc}"));
    for (actuator, [x, y]) in arc.actuators.iter().zip([[115.0, 50.0], [75.0, 10.0], [35.0, 50.0]]) {
        assert!(near(actuator.at, x, y), "{actuator:?}");
    }
}

#[test]
fn a_grid_runs_along_x_first_and_channels_go_on_counting() {
    let surface = surface(
        "[[actuator]]\nat_mm = [5, 5]\n[[actuator]]\ngrid_mm = [[10, 10], [30, 50]]\ncount = [3, 2]\n[[actuator]]\nat_mm = [6, 6]\n",
    );
    assert_eq!(names(&surface), ["a1", "a2", "a3", "a4", "a5", "a6", "a7", "a8"]);
    let wanted = [[10.0, 10.0], [20.0, 10.0], [30.0, 10.0], [10.0, 50.0], [20.0, 50.0], [30.0, 50.0]];
    for (actuator, [x, y]) in surface.actuators[1..7].iter().zip(wanted) {
        assert!(near(actuator.at, x, y), "{actuator:?}");
    }
    assert_eq!(parse_surface(&to_toml(&surface), "copy.toml").unwrap(), surface, "written one by one");
}

#[test]
fn what_actuators_have_in_common_is_said_once() {
    let surface = surface(
        r#"[actuator_defaults]
kind = "piezo"
radius_mm = 4
moment_n_per_v = 0.002
contact_radius_mm = 1
[[actuator]]
name = "patch"
row_mm = [[20, 20], [120, 20]]
count = 3
[[actuator]]
name = "wide"
at_mm = [75, 60]
radius_mm = 9
[[actuator]]
name = "pusher"
at_mm = [30, 70]
kind = "force"
"#,
    );
    let radius = |i: usize| match surface.actuators[i].kind {
        ActuatorKind::Piezo { patch: Patch::Round { radius }, moment: 0.002, .. } => radius,
        kind => panic!("{kind:?}"),
    };
    assert_eq!([0, 1, 2, 3].map(radius), [4e-3, 4e-3, 4e-3, 9e-3]);
    assert_eq!(surface.actuators[4].kind, ActuatorKind::Force, "its own kind stands above the common one");
    assert_eq!(surface.actuators[4].contact_radius, 1e-3);
}

#[test]
fn thirty_two_patches_fit_in_twenty_lines() {
    let text = r#"format = 1
[outline]
rectangle_mm = [148, 210]
edge = "free"
[sheet]
material = "soda-lime glass"
thickness_mm = 0.5
loss_factor = 0.005
[drive]
band_hz = [20000, 70000]
sample_rate_hz = 192000
[actuator_defaults]
kind = "piezo"
radius_mm = 4
moment_n_per_v = 0.002
[[actuator]]
grid_mm = [[10, 10], [138, 200]]
count = [4, 8]
"#;
    assert!(text.lines().count() < 20);
    assert_eq!(parse_surface(text, "glass.toml").unwrap().actuators.len(), 32);
}

#[test]
fn faults_of_places_and_defaults() {
    let one = |tables: &str| {
        let list = faults(&with(tables));
        assert_eq!(list.len(), 1, "{tables}: {list:#?}");
        format!("{}", list[0])
    };
    let row = "[[actuator]]\nrow_mm = [[10, 20], [170, 20]]\ncount = 5\n";
    assert_eq!(
        one(row),
        "actuator[0].row_mm: expected places on the sheet, found its place 5 at [170, 20] mm"
    );
    for (tables, said) in [
        ("[[actuator]]\nat_mm = [1, 2]\nrow_mm = [[1, 2], [3, 4]]\n", "found at_mm and row_mm"),
        ("[[actuator]]\nat_mm = [1, 2]\ncount = 3\n", "only beside row_mm, ring or grid_mm, found 3"),
        (
            "[[actuator]]\nrow_mm = [[1, 2], [3, 4]]\n",
            "actuator[0].count: expected a whole number from 2 to 4096",
        ),
        ("[[actuator]]\nrow_mm = [[1, 2], [3, 4]]\ncount = 1\n", "found 1 (nearest: 2)"),
        (
            "[[actuator]]\nrow_mm = [[1, 2], [3, 4]]\ncount = 2.5\n",
            "a whole number from 2 to 4096, found 2.5",
        ),
        ("[[actuator]]\nrow_mm = [[1, 2]]\ncount = 2\n", "expected [[x, y], [x, y]] in mm"),
        ("[[actuator]]\ngrid_mm = [[1, 2], [3, 4]]\ncount = [100, 100]\n", "at most 4096 places in all"),
        ("[[actuator]]\ngrid_mm = [[1, 2], [3, 4]]\ncount = 4\n", "two whole numbers, [along x, along y]"),
        ("[[actuator]]\nring = { centre_mm = [75, 50], radius = 4 }\ncount = 3\n", "nearest: radius_mm"),
        (
            "[actuator_defaults]\nat_mm = [1, 2]\n[[actuator]]\nname = \"a\"\nat_mm = [1, 2]\n",
            "it is of one actuator alone",
        ),
        ("[actuator_defaults]\nknd = \"force\"\n[[actuator]]\nat_mm = [1, 2]\n", "nearest: kind"),
    ] {
        let list = faults(&with(tables)).iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
        assert!(list.contains(said), "{tables}: {list}");
    }
    let once = "[actuator_defaults]\nkind = \"piezo\"\nradius_mm = 0\nmoment_n_per_v = 1\n[[actuator]]\nrow_mm = [[9, 9], [60, 9]]\ncount = 9\n";
    assert!(one(once).starts_with("actuator_defaults.radius_mm"), "what stands once is at fault once");
    let many = "[[actuator]]\ngrid_mm = [[1, 1], [99, 99]]\ncount = [64, 64]\n".to_owned()
        + "[[actuator]]\nat_mm = [1, 2]\n";
    assert!(one(&many).contains("at most 4096 actuators in all"));
    let named = "[[actuator]]\nname = \"b-2\"\nat_mm = [1, 2]\n[[actuator]]\nname = \"b\"\nrow_mm = [[5, 5], [9, 9]]\ncount = 2\n";
    assert!(one(named).contains("\"b-2\", which is also the name of actuator[0]"));
    let long = |bytes: usize| {
        format!("[[actuator]]\nname = \"{}\"\nrow_mm = [[5, 5], [9, 9]]\ncount = 10\n", "n".repeat(bytes))
    };
    assert_eq!(faults(&with(&long(197))), []);
    assert!(one(&long(198)).contains("at most 200 bytes with the numbers of its actuators, found 201 bytes"));
}

/// Springs of a strip, against the work of stretching it: a slice at y from its middle stretches by w + y φ.
#[test]
fn a_strip_of_adhesive_is_springs() {
    let edge = "edge = { adhesive_young_mpa = 0.6, adhesive_width_mm = 3, adhesive_thickness_mm = 0.25 }";
    let text = GOOD.replace("edge = \"clamped\"", edge);
    let surface = parse_surface(&text, "film.toml").unwrap();
    let Edges::All(Edge::Elastic { lift, tilt }) = surface.outline.edges else { panic!() };
    let slices = 3000;
    let slice = |i: i32| (f64::from(i) + 0.5) / f64::from(slices) * 3e-3 - 1.5e-3;
    let stiffness = 0.6e6 / 0.25e-3 * 3e-3 / f64::from(slices);
    let both =
        (0..slices).map(slice).fold((0.0, 0.0), |sum, y| (sum.0 + stiffness, sum.1 + stiffness * y * y));
    assert!(
        (lift / both.0 - 1.0).abs() < 1e-9 && (tilt / both.1 - 1.0).abs() < 1e-6,
        "{lift} {tilt} {both:?}"
    );
    assert_eq!(parse_surface(&to_toml(&surface), "copy.toml").unwrap(), surface);
    // Epoxy, a fifth as thick: past what a file takes as springs.
    let epoxy =
        text.replace("= 0.6", "= 3000").replace("width_mm = 3", "width_mm = 20").replace("0.25", "0.05");
    let list = faults(&epoxy);
    assert_eq!((list.len(), list[0].line, list[0].column), (1, 5, 8));
    assert_eq!(
        list[0].to_string(),
        "outline.edge: expected a strip whose springs are at most 1000000 N/mm² against displacement and 1000000000 N \
         against rotation, found a strip whose springs are 1200000 N/mm² and 40000000 N (nearest: \"clamped\")"
    );
    let half = faults(&text.replace("adhesive_width_mm = 3, ", ""));
    assert_eq!(half[0].key, "outline.edge.adhesive_width_mm");
    let both = faults(&text.replace("adhesive_width_mm = 3", "tilt_n = 3"));
    assert!(
        both[0].expected.starts_with("either lift_n_per_mm2 and tilt_n, or adhesive_young_mpa"),
        "{both:?}"
    );
}
