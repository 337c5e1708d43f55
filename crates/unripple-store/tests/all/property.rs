//! Properties: any surface comes back from its file, and no text makes the reader panic.

use proptest::prelude::*;
use unripple_core::{
    Actuator, ActuatorKind, Air, CoilDrive, Decay, Edge, Edges, Emission, Finger, Grain, Hole, Outline,
    Patch, Point, Profile, Resonator, Scatterer, ScattererKind, Shape, Sheet, Side, Surface, Uneven,
};
use unripple_store::{BUILTINS, Drawing, parse_surface, parse_surface_with, read_curves, to_toml};

fn edge() -> impl Strategy<Value = Edge> {
    prop_oneof![
        Just(Edge::Clamped),
        Just(Edge::Supported),
        Just(Edge::Free),
        (0.0..1e12_f64, 0.0..1e9_f64).prop_map(|(lift, tilt)| Edge::Elastic { lift, tilt }),
    ]
}

/// The same edge all round, or one for each of so many sides.
fn edges(sides: usize) -> impl Strategy<Value = Edges> {
    prop_oneof![
        edge().prop_map(Edges::All),
        proptest::collection::vec(edge(), sides).prop_map(Edges::PerSide),
    ]
}

fn line(from: Point, to: Point) -> Side {
    Side::Line { from, to }
}

/// A box with a curved lid, and with a round right end if the lid bulges.
fn lidded(w: f64, h: f64, bulge: f64) -> Vec<Side> {
    let p = Point::new;
    let lid = Side::Cubic([p(w, h), p(0.7 * w, h * (1.0 + bulge)), p(0.2 * w, h * (1.0 + bulge)), p(0.0, h)]);
    let right = if bulge > 0.0 {
        let start = -std::f64::consts::FRAC_PI_2;
        Side::Arc { centre: p(w, 0.5 * h), radius: 0.5 * h, start, sweep: std::f64::consts::PI }
    } else {
        line(p(w, 0.0), p(w, h))
    };
    vec![line(p(0.0, 0.0), p(w, 0.0)), right, lid, line(p(0.0, h), p(0.0, 0.0))]
}

fn triangle(w: f64, h: f64, at: f64) -> Shape {
    Shape::Polygon(vec![Point::new(0.0, 0.0), Point::new(w, 0.0), Point::new(at * w, h)])
}

fn shape() -> impl Strategy<Value = Shape> {
    let length = 1e-3..10.0_f64;
    prop_oneof![
        (length.clone(), length.clone()).prop_map(|(width, height)| Shape::Rectangle { width, height }),
        length.clone().prop_map(|radius| Shape::Circle { radius }),
        (0.0..10.0_f64, length.clone()).prop_map(|(straight, radius)| Shape::Stadium { straight, radius }),
        (length.clone(), length.clone(), 0.0..1.0_f64).prop_map(|(w, h, at)| triangle(w, h, at)),
        (length.clone(), length, -0.9..0.9_f64).prop_map(|(w, h, bulge)| Shape::Path(lidded(w, h, bulge))),
    ]
}

/// A hole of some kind and proportions.
#[derive(Clone, Debug)]
struct Cut {
    kind: i32,
    a: f64,
    b: f64,
    turn: f64,
}

impl Cut {
    /// The hole within a square of `size` around a place.
    fn hole(&self, at: Point, size: f64) -> Hole {
        let (a, b) = (self.a, self.b);
        let (w, h) = (a * size, b * size);
        let shape = match self.kind {
            0 => Shape::Rectangle { width: w, height: h },
            1 => Shape::Circle { radius: 0.5 * w.min(h) },
            2 => Shape::Stadium { straight: 0.5 * w, radius: 0.2 * w.min(h) },
            3 => triangle(w, h, a),
            4 => Shape::Path(lidded(0.5 * w, 0.5 * h, 2.0 * b - 1.0)),
            _ => {
                let out = Point::new(0.4 * w * self.turn.cos(), 0.4 * w * self.turn.sin());
                let ends = [-1.0, 1.0].map(|s| Point::new(at.x + s * out.x, at.y + s * out.y));
                return Hole::slit(ends[0], ends[1], (0.1 * h).clamp(1e-5, 0.1));
            }
        };
        Hole::new(&shape, Point::new(at.x - 0.5 * w, at.y - 0.5 * h))
    }
}

fn cut() -> impl Strategy<Value = Cut> {
    (0..6, 0.15..1.0_f64, 0.15..1.0_f64, 0.0..6.3_f64).prop_map(|(kind, a, b, turn)| Cut { kind, a, b, turn })
}

prop_compose! {
    fn outline()(shape in shape(), holes in proptest::collection::vec(cut(), 0..3))(
        edges in edges(shape.sides().len()),
        held in holes.iter().map(|cut| edges(cut.hole(Point::default(), 1.0).sides.len())).collect::<Vec<_>>(),
        shape in Just(shape),
        holes in Just(holes),
    ) -> Outline {
        let (w, h) = shape.extent();
        let mut outline = Outline::new(shape.clone()).with_edges(edges);
        // Where there is room for sure.
        if matches!(shape, Shape::Rectangle { .. }) {
            let made = holes.iter().zip(held).zip([0.25, 0.75]);
            let place = |x: f64| Point::new(x * w, 0.5 * h);
            outline.holes = made
                .map(|((cut, edges), x)| Hole { edges, ..cut.hole(place(x), 0.4 * w.min(h)) })
                .collect();
        }
        outline
    }
}

fn profile(values: std::ops::Range<f64>) -> impl Strategy<Value = Option<Profile>> {
    let rows = (1..4_usize).prop_flat_map(move |columns| {
        proptest::collection::vec(proptest::collection::vec(values.clone(), columns), 1..4)
    });
    proptest::option::of(rows).prop_map(|rows| rows.and_then(|rows| Profile::new(&rows)))
}

fn uneven(young: f64) -> impl Strategy<Value = Uneven> {
    let grain = (-12.0..12.0_f64, 0.01..1.0_f64, 1e3..2e12_f64)
        .prop_map(move |(direction, share, shear)| Grain { direction, young_across: share * young, shear });
    let profiles = (profile(0.05..20.0), profile(0.0..20.0), profile(0.0..1000.0));
    (proptest::option::of(grain), profiles).prop_map(|(grain, (thickness, tension, added_mass))| Uneven {
        grain,
        thickness,
        tension,
        added_mass,
        scatterers: Vec::new(),
        resonators: Vec::new(),
        lattices: Vec::new(),
    })
}

fn scatterer() -> impl Strategy<Value = ScattererKind> {
    prop_oneof![
        (0.0..10.0_f64).prop_map(ScattererKind::Mass),
        (1e-4..1.0_f64, 1e-6..0.1_f64, 0.0..2e12_f64, 1.0..3e4_f64, -0.99..0.49_f64).prop_map(
            |(radius, thickness, young, density, poisson)| ScattererKind::Disc {
                radius,
                thickness,
                young,
                density,
                poisson
            }
        ),
    ]
}

fn resonator() -> impl Strategy<Value = Resonator> {
    (1e-9..100.0_f64, 1.0..1e5_f64, 0.1..1e6_f64).prop_map(|(mass, frequency, quality_factor)| Resonator {
        at: Point::new(0.0, 0.0),
        mass,
        frequency,
        quality_factor,
    })
}

fn decay() -> impl Strategy<Value = Decay> {
    prop_oneof![
        (1e-5..1e3_f64).prop_map(Decay::Time),
        (1e-6..1.0_f64).prop_map(Decay::LossFactor),
        proptest::collection::vec((1.0..1e4_f64, 1e-5..1e3_f64), 1..6).prop_map(|steps| {
            let rising = steps.into_iter().scan(0.0, |hz, (step, s)| {
                *hz += step;
                Some((*hz, s))
            });
            Decay::Table(rising.collect())
        }),
    ]
}

fn sheet() -> impl Strategy<Value = Sheet> {
    let material = prop_oneof![Just("custom".to_owned()), "[a-z\"\\\\é#=\\[\\]]{1,12}"];
    let air = prop_oneof![Just(Air::None), Just(Air::OneSide), Just(Air::BothSides)];
    let stuff = (1e6..1e12_f64, 1.0..3e4_f64, -0.99..0.49_f64, proptest::option::of(1e5..1e10_f64));
    let uneven = stuff.prop_flat_map(|stuff| (Just(stuff), uneven(stuff.0)));
    (material, uneven, 1e-6..0.1_f64, 0.0..1e6_f64, decay(), air).prop_map(
        |(material, ((young, density, poisson, strength), uneven), thickness, tension, decay, air)| Sheet {
            material,
            young,
            density,
            poisson,
            strength,
            thickness,
            tension,
            decay,
            air,
            uneven,
        },
    )
}

fn patch() -> impl Strategy<Value = Patch> {
    prop_oneof![
        (1e-4..0.1_f64).prop_map(|radius| Patch::Round { radius }),
        (1e-4..1.0_f64, 1e-4..1.0_f64, -12.0..12.0_f64)
            .prop_map(|(width, height, angle)| Patch::Rectangular { sides: [width, height], angle }),
    ]
}

/// The patch, made smaller so that it keeps within a disc, if it is then large enough for a file.
fn within(patch: Patch, room: f64) -> Option<Patch> {
    match patch {
        Patch::Round { radius } => {
            Some(radius.min(room)).filter(|radius| *radius >= 1e-4).map(|radius| Patch::Round { radius })
        }
        Patch::Rectangular { sides, angle } => {
            let scale = (2.0 * room / sides[0].hypot(sides[1])).min(1.0);
            let sides = sides.map(|side| scale * side);
            (sides[0].min(sides[1]) >= 1e-4).then_some(Patch::Rectangular { sides, angle })
        }
    }
}

fn kind() -> impl Strategy<Value = ActuatorKind> {
    let coil = || {
        let driven_by = prop_oneof![Just(CoilDrive::Current), Just(CoilDrive::Voltage)];
        (1e-3..1e3_f64, 1e-3..1e6_f64, 0.0..1.0_f64, 0.0..1.0_f64, driven_by)
    };
    let housing = (1e-5..100.0_f64, 1.0..1e5_f64, 0.1..1e3_f64);
    prop_oneof![
        Just(ActuatorKind::Force),
        (patch(), -1e5..1e5_f64, 0.0..10.0_f64).prop_map(|(patch, moment, mass)| ActuatorKind::Piezo {
            patch,
            moment,
            mass
        }),
        (coil(), housing).prop_map(|(coil, (housing_mass, resonance, quality_factor))| {
            let (force_constant, resistance, inductance, moving_mass, driven_by) = coil;
            ActuatorKind::Exciter {
                force_constant,
                resistance,
                inductance,
                moving_mass,
                housing_mass,
                resonance,
                quality_factor,
                driven_by,
            }
        }),
        coil().prop_map(|(force_constant, resistance, inductance, moving_mass, driven_by)| {
            ActuatorKind::MovingMagnet { force_constant, resistance, inductance, moving_mass, driven_by }
        }),
    ]
}

prop_compose! {
    fn surface()(
        outline in outline().prop_filter("corners that triangles can follow", |outline| outline.faults().is_empty()),
        sheet in sheet(),
        name in "[A-Za-z][a-z\"\\\\'é]{0,10}",
        rate in (100_u32..10_000_000).prop_map(f64::from),
        band in (0.0..0.25_f64, 0.3..0.5_f64),
        limits in (1e-6..1e6_f64, proptest::option::of(1e-6..1e6_f64)),
        finger in (0.0..1.0_f64, 0.0..1e3_f64, 0.0..1e6_f64, 1e-4..0.1_f64),
        actuators in proptest::collection::vec((0.0..1.0_f64, 0.0..1.0_f64, kind(), 0.0..0.1_f64), 1..12),
        scatterers in proptest::collection::vec((0.0..1.0_f64, 0.0..1.0_f64, scatterer()), 0..4),
        resonators in proptest::collection::vec((0.0..1.0_f64, 0.0..1.0_f64, resonator()), 0..4),
    ) -> Surface {
        let (w, h) = outline.extent();
        let place = |x: f64, y: f64| {
            let there = Point::new(x * w, y * h);
            outline.nearest(there)
        };
        let actuators = actuators.into_iter().enumerate().map(|(i, (x, y, kind, pad))| {
            let at = place(x, y);
            // A patch lies on the sheet whole; where there is no room for one, a force acts.
            let kind = match kind {
                ActuatorKind::Piezo { patch, moment, mass } => match within(patch, 0.99 * outline.to_rim(at)) {
                    Some(patch) => ActuatorKind::Piezo { patch, moment, mass },
                    None => ActuatorKind::Force,
                },
                kind => kind,
            };
            let contact_radius = if matches!(kind, ActuatorKind::Piezo { .. }) || i % 2 == 0 { 0.0 } else { pad };
            Actuator { name: format!("{name}{i}"), at, kind, contact_radius }
        }).collect();
        let mut sheet = sheet;
        sheet.uneven.scatterers =
            scatterers.into_iter().map(|(x, y, kind)| Scatterer { at: place(x, y), kind }).collect();
        let resonating = |(x, y, resonator)| Resonator { at: place(x, y), ..resonator };
        sheet.uneven.resonators = resonators.into_iter().map(resonating).collect();
        let (mass, damping, stiffness, contact_radius) = finger;
        Surface {
            name,
            outline,
            sheet,
            emission: Emission { band: [band.0 * rate, band.1 * rate], rate, limit: limits.0, rms_limit: limits.1 },
            finger: Finger { mass, damping, stiffness, contact_radius },
            actuators,
            // Half of the surfaces say how accurate they are to be computed.
            accuracy: (limits.0 > 0.5).then(|| limits.0.clamp(1e-12, 0.1)),
        }
    }
}

/// What reading a text may do: give a surface, or at least one fault that can be shown.
fn is_handled(text: &str) -> bool {
    match parse_surface(text, "any.toml") {
        Ok(surface) => parse_surface(&to_toml(&surface), "copy.toml").is_ok_and(|copy| copy == surface),
        Err(faults) => {
            let mut shown = String::new();
            let handler = miette::GraphicalReportHandler::new_themed(miette::GraphicalTheme::none());
            handler.render_report(&mut shown, &faults).is_ok() && !faults.faults().is_empty()
        }
    }
}

proptest! {
    #[test]
    fn any_surface_comes_back(surface in surface()) {
        let text = to_toml(&surface);
        let back = parse_surface(&text, "copy.toml").map_err(|faults| format!("{faults:#}\n{text}"));
        prop_assert_eq!(back, Ok(surface));
    }

    #[test]
    fn any_text_is_handled(text in "\\PC{0,200}") {
        prop_assert!(is_handled(&text));
        let _ = Drawing::parse(&text, "any.svg", 1e-5);
    }

    #[test]
    fn any_keys_are_handled(
        lines in proptest::collection::vec(
            "(\\[\\[?(outline|hole|sheet|scatterer|drive|finger|actuator)\\]?\\]|(format|svg|edge|material|at_mm|name|polygon_mm|\
             path_mm|slit_mm|centre_mm|tension_profile|added_mass_kg_m2|grain_deg|young_across_gpa|kind|band_hz|\
             decay_time_ms|circle_mm) = (1|-1e400|nan|\"x\"|\"piezo\"|0xfffffffffffffffffffffffffffffffffffff|\\[\\]|\\{\\}|\
             \\[\\[1, 2\\], \\[3\\]\\]|\\[\\[\\[1, 2\\], \\[3, 4\\]\\], \\{centre_mm = 1\\}\\]|\\{lift_n_per_mm2 = 1\\}))",
            0..20,
        ),
    ) {
        prop_assert!(is_handled(&lines.join("\n")), "{}", lines.join("\n"));
    }

    #[test]
    fn any_change_to_a_builtin_is_handled(
        which in 0..BUILTINS.len(),
        changes in proptest::collection::vec((any::<prop::sample::Index>(), 0_usize..8, "\\PC{0,6}"), 1..6),
    ) {
        let mut text: Vec<char> = BUILTINS[which].text.chars().collect();
        for (place, cut, put) in changes {
            let at = place.index(text.len());
            let end = (at + cut).min(text.len());
            text.splice(at..end, put.chars());
        }
        let text: String = text.into_iter().collect();
        prop_assert!(is_handled(&text), "{text}");
    }

    #[test]
    fn any_path_drawn_is_handled(data in "M0 0(([LHVCSQTAZlhvcsqtaz]|-?[0-9]{1,3}|0\\.[0-9]{1,3}| |,){0,40})") {
        let svg = format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 999 999"><path d="{data}" stroke="red"/></svg>"#
        );
        for curve in read_curves(&svg, "any.svg").unwrap_or_default() {
            prop_assert_eq!(curve.counts.iter().sum::<usize>(), curve.sides.len());
            prop_assert!(curve.sides.windows(2).all(|pair| pair[0].at(1.0).distance(pair[1].at(0.0)) < 1e-12));
            prop_assert!(curve.sides.iter().all(|side| side.length() > 0.0));
        }
        let text = BUILTINS[0].text.replace("rectangle_mm = [150, 150]", "svg = \"rim.svg\"");
        if let Ok(surface) = parse_surface_with(&text, "film.toml", &|_| Ok(svg.clone())) {
            prop_assert_eq!(parse_surface(&to_toml(&surface), "copy.toml").unwrap(), surface);
        }
    }
}
