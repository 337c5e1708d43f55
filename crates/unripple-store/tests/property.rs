//! Properties: any surface comes back from its file, and no text makes the reader panic.

use proptest::prelude::*;
use unripple_core::{
    Actuator, ActuatorKind, Air, CoilDrive, Decay, Edge, Edges, Emission, Finger, Outline, Point, Shape,
    Sheet, Surface,
};
use unripple_store::{BUILTINS, Drawing, parse_surface, to_toml};

fn edge() -> impl Strategy<Value = Edge> {
    prop_oneof![Just(Edge::Clamped), Just(Edge::Supported), Just(Edge::Free)]
}

fn outline() -> impl Strategy<Value = Outline> {
    let length = 1e-3..10.0_f64;
    let shape = prop_oneof![
        (length.clone(), length.clone()).prop_map(|(width, height)| Shape::Rectangle { width, height }),
        length.clone().prop_map(|radius| Shape::Circle { radius }),
        (0.0..10.0_f64, length.clone()).prop_map(|(straight, radius)| Shape::Stadium { straight, radius }),
        (length.clone(), length, 0.0..1.0_f64).prop_map(|(w, h, at)| {
            Shape::Polygon(vec![Point::new(0.0, 0.0), Point::new(w, 0.0), Point::new(at * w, h)])
        }),
    ];
    (shape, edge(), proptest::collection::vec(edge(), 4)).prop_map(|(shape, all, list)| {
        let sides = Outline::new(shape.clone()).side_lengths().len();
        let edges = if sides == 4 { Edges::PerSide(list) } else { Edges::All(all) };
        Outline { shape, edges }
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
    (material, stuff, 1e-6..0.1_f64, 0.0..1e6_f64, decay(), air).prop_map(
        |(material, (young, density, poisson, strength), thickness, tension, decay, air)| Sheet {
            material,
            young,
            density,
            poisson,
            strength,
            thickness,
            tension,
            decay,
            air,
        },
    )
}

fn kind() -> impl Strategy<Value = ActuatorKind> {
    let driven_by = prop_oneof![Just(CoilDrive::Current), Just(CoilDrive::Voltage)];
    prop_oneof![
        Just(ActuatorKind::Force),
        Just(ActuatorKind::Piezo),
        (1e-3..1e3_f64, 1e-3..1e6_f64, 0.0..1.0_f64, 0.0..1.0_f64, driven_by).prop_map(
            |(force_constant, resistance, inductance, moving_mass, driven_by)| ActuatorKind::MovingMagnet {
                force_constant,
                resistance,
                inductance,
                moving_mass,
                driven_by,
            }
        ),
    ]
}

prop_compose! {
    fn surface()(
        outline in outline(),
        sheet in sheet(),
        name in "[A-Za-z][a-z\"\\\\'é]{0,10}",
        rate in 100.0..1e7_f64,
        band in (0.0..0.25_f64, 0.3..0.5_f64),
        limits in (1e-6..1e6_f64, proptest::option::of(1e-6..1e6_f64)),
        finger in (0.0..1.0_f64, 0.0..1e3_f64, 0.0..1e6_f64, 1e-4..0.1_f64),
        actuators in proptest::collection::vec((0.0..1.0_f64, 0.0..1.0_f64, kind()), 1..12),
    ) -> Surface {
        let (w, h) = outline.extent();
        let middle = outline.rim(64).iter().fold(Point::default(), |m, p| Point::new(m.x + p.x, m.y + p.y));
        let count = outline.rim(64).len() as f64;
        let middle = Point::new(middle.x / count, middle.y / count);
        let actuators = actuators.into_iter().enumerate().map(|(i, (x, y, kind))| {
            let there = Point::new(x * w, y * h);
            let at = if outline.contains(there) { there } else { middle };
            Actuator { name: format!("{name}{i}"), at, kind }
        }).collect();
        let (mass, damping, stiffness, contact_radius) = finger;
        Surface {
            name,
            outline,
            sheet,
            emission: Emission { band: [band.0 * rate, band.1 * rate], rate, limit: limits.0, rms_limit: limits.1 },
            finger: Finger { mass, damping, stiffness, contact_radius },
            actuators,
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
            "(\\[\\[?(outline|sheet|drive|finger|actuator)\\]?\\]|(format|svg|edge|material|at_mm|name|polygon_mm|band_hz|\
             decay_time_ms|circle_mm) = (1|-1e400|nan|\"x\"|0xfffffffffffffffffffffffffffffffffffff|\\[\\]|\\{\\}|\\[\\[1, 2\\], \\[3\\]\\]))",
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
}
