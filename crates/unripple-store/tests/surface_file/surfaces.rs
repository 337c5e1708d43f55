//! Surfaces that load: the built-ins, what every key means, and the way back to a file.

use unripple_core::{Actuator, ActuatorKind, Air, CoilDrive, Decay, Edge, Edges, Finger, Point, Shape};
use unripple_store::{BUILTINS, StoreError, load_surface, parse_surface, parse_surface_with, to_toml};

#[test]
fn the_papers_surface() {
    let film = load_surface("hudin-2012").unwrap();
    assert_eq!(film.outline.shape, Shape::Rectangle { width: 0.15, height: 0.15 });
    assert_eq!(film.outline.edges, Edges::All(Edge::Clamped));
    let sheet = &film.sheet;
    assert_eq!((sheet.young, sheet.density, sheet.poisson), (4e9, 1400.0, 0.3));
    assert_eq!((sheet.thickness, sheet.tension, sheet.air), (0.125e-3, 200.0, Air::None));
    assert_eq!(sheet.decay, Decay::Time(0.07));
    assert_eq!((film.emission.band, film.emission.rate, film.emission.limit), ([0.0, 3000.0], 48e3, 1.0));
    assert_eq!(film.finger, Finger::default());
    let places: Vec<Point> = film.actuators.iter().map(|a| a.at).collect();
    let paper = [(12, 31), (9, 84), (40, 140), (95, 137), (141, 106), (138, 44), (103, 11), (50, 9)];
    assert_eq!(places, paper.map(|(x, y)| Point::from_mm(f64::from(x), f64::from(y))));
    assert!(film.actuators.iter().all(|a| a.kind == ActuatorKind::Force));
}

#[test]
fn builtins_load_and_come_back() {
    for builtin in BUILTINS {
        let surface = load_surface(builtin.name).unwrap();
        assert_eq!(surface.name, builtin.name);
        assert_eq!(parse_surface(&to_toml(&surface), "copy.toml").unwrap(), surface);
    }
}

/// No built-in has two actuators that a mirror or half a turn of its rectangle maps onto each other, but for the board of others, whose
/// magnets are as they placed them.
#[test]
fn builtins_are_without_symmetry() {
    for builtin in BUILTINS.iter().filter(|builtin| builtin.name != "phone-board") {
        let surface = load_surface(builtin.name).unwrap();
        let (w, h) = surface.outline.extent();
        for a in &surface.actuators {
            for b in &surface.actuators {
                let images = [(w - a.at.x, a.at.y), (a.at.x, h - a.at.y), (w - a.at.x, h - a.at.y)];
                for (x, y) in images {
                    assert!(
                        b.at.distance(Point::new(x, y)) > 1.5e-3,
                        "{}: {} {}",
                        builtin.name,
                        a.name,
                        b.name
                    );
                }
            }
        }
    }
}

/// A file that uses every key but those of other outlines.
const EVERY_KEY: &str = r#"
format = 1
name = "all"
[outline]
polygon_mm = [[0, 0], [120, 0], [90, 80]]
edge = ["clamped", "supported", "free"]
[sheet]
material = "my foil"
young_gpa = 3
density_kg_m3 = 1_390
poisson_ratio = 0x0
strength_mpa = 90
thickness_mm = 5e-2
decay_time_ms = [[100, 70], [2000, 20.5]]
air = "both-sides"
[drive]
band_hz = [20, 2000]
limit = 2
rms_limit = 0.5
[finger]
mass_g = 0.1
[[actuator]]
at_mm = [60, 20]
[[actuator]]
at_mm = [60, 30]
kind = "moving-magnet"
force_constant_n_per_a = 6
resistance_ohm = 6.2
inductance_mh = 1.9
moving_mass_mg = 250
driven_by = "voltage"
[[actuator]]
name = "patch"
at_mm = [70, 30]
kind = "piezo"
radius_mm = 5
moment_n_per_v = 0.01
"#;

#[test]
fn every_key() {
    let surface = parse_surface(EVERY_KEY, "x/all.toml").unwrap();
    assert_eq!(surface.outline.edges, Edges::PerSide(vec![Edge::Clamped, Edge::Supported, Edge::Free]));
    let sheet = &surface.sheet;
    assert_eq!((sheet.material.as_str(), sheet.young, sheet.density), ("my foil", 3e9, 1390.0));
    assert_eq!((sheet.poisson, sheet.strength, sheet.thickness), (0.0, Some(90e6), 5e-5));
    assert_eq!((sheet.tension, sheet.air), (0.0, Air::BothSides));
    assert_eq!(sheet.decay, Decay::Table(vec![(100.0, 0.07), (2000.0, 0.0205)]));
    assert_eq!((surface.emission.rate, surface.emission.rms_limit), (48e3, Some(0.5)));
    assert_eq!(surface.finger, Finger { mass: 1e-4, ..Finger::default() });
    assert_eq!(
        surface.actuators[1],
        Actuator {
            name: "a2".into(),
            at: Point::from_mm(60.0, 30.0),
            kind: ActuatorKind::MovingMagnet {
                force_constant: 6.0,
                resistance: 6.2,
                inductance: 1.9e-3,
                moving_mass: 250e-6,
                driven_by: CoilDrive::Voltage,
            },
            contact_radius: 0.0,
        }
    );
    assert!(matches!(surface.actuators[2].kind, ActuatorKind::Piezo { .. }));
    assert_eq!(parse_surface(&to_toml(&surface), "copy.toml").unwrap(), surface);
}

#[test]
fn defaults() {
    let text = "format = 1\n[outline]\ncircle_mm = 70\n[sheet]\nmaterial = \"GLASS\"\nthickness_mm = 1\n\
                loss_factor = 0.01\n[drive]\nband_hz = [0, 20000]\n[[actuator]]\nat_mm = [70, 10]\n";
    let surface = parse_surface(text, "dir/plate.toml").unwrap();
    assert_eq!((surface.name.as_str(), surface.sheet.material.as_str()), ("plate", "glass"));
    assert_eq!(surface.outline.edges, Edges::All(Edge::Clamped));
    assert_eq!((surface.sheet.tension, surface.sheet.air), (0.0, Air::None));
    assert_eq!(surface.sheet.decay, Decay::LossFactor(0.01));
    assert_eq!((surface.emission.rate, surface.emission.limit), (48e3, 1.0));
    assert_eq!(surface.emission.rms_limit, None);
    assert_eq!((surface.actuators[0].name.as_str(), surface.finger), ("a1", Finger::default()));
}

#[test]
fn an_outline_drawn_in_svg() {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">
        <circle cx="60" cy="40" r="30"/></svg>"#;
    let text = "format = 1\n[outline]\nsvg = \"disc.svg\"\nedge = \"free\"\n[sheet]\nmaterial = \"steel\"\n\
                thickness_mm = 1\ndecay_time_ms = 10\n[drive]\nband_hz = [0, 9000]\n[[actuator]]\nat_mm = [30, 5]\n";
    let surface = parse_surface_with(text, "plate.toml", &|name| {
        assert_eq!(name, "disc.svg");
        Ok(svg.into())
    })
    .unwrap();
    let area = std::f64::consts::PI * 0.03 * 0.03;
    assert!((surface.outline.area() / area - 1.0).abs() < 2e-3);
    let (width, height) = surface.outline.extent();
    assert!((width - 0.06).abs() < 2e-5 && (height - 0.06).abs() < 2e-5);
    assert_eq!(parse_surface(&to_toml(&surface), "copy.toml").unwrap().outline, surface.outline);

    let bad = parse_surface_with(text, "plate.toml", &|_| Ok(svg.replace("circle", "text"))).unwrap_err();
    assert_eq!(
        bad.faults()[0].to_string(),
        "outline.svg: expected a filled or stroked shape (turn text into paths first), found no visible shape"
    );
    let listed = text.replace("\"free\"", "[\"free\", \"free\"]");
    let bad = parse_surface_with(&listed, "plate.toml", &|_| Ok(svg.into())).unwrap_err();
    assert_eq!(bad.faults()[0].key, "outline.edge");
}

#[test]
fn from_disk() {
    let folder = std::env::temp_dir().join(format!("unripple-surfaces-{}", std::process::id()));
    std::fs::create_dir(&folder).unwrap();
    let file = folder.join("film.toml");
    let load = || load_surface(&file.display().to_string());

    let text = BUILTINS[0].text.replace("rectangle_mm = [150, 150]", "svg = \"rim.svg\"");
    std::fs::write(&file, &text).unwrap();
    let error = format!("{:#}", load().unwrap_err());
    let absent = folder.join("rim.svg").display().to_string();
    assert!(
        error.ends_with(&format!(":8:7: outline.svg: expected an SVG file, found no file {absent}")),
        "{error}"
    );
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="15cm" height="15cm" viewBox="0 0 1 1">
        <path d="M0 0H1V1H0Z"/></svg>"#;
    std::fs::write(folder.join("rim.svg"), svg).unwrap();
    assert!((load().unwrap().outline.area() - 0.0225).abs() < 1e-8);

    std::fs::write(&file, b"format = 1\nname = \"\xff\"\n").unwrap();
    let error = format!("{:#}", load().unwrap_err());
    assert!(error.ends_with("film.toml:2:9: expected text in UTF-8, found the byte 0xff"), "{error}");
    std::fs::write(&file, vec![b'#'; (1 << 20) + 1]).unwrap();
    assert!(format!("{:#}", load().unwrap_err()).contains("at most 1048576 bytes"));
    assert!(matches!(load_surface(&folder.display().to_string()), Err(StoreError::Read { .. })));
    std::fs::remove_dir_all(&folder).unwrap();

    let error = load_surface("picture-farme").unwrap_err();
    assert!(error.is_bad_input());
    assert_eq!(
        error.to_string(),
        "no surface `picture-farme`: expected a file, or one of hudin-2012, glass-plate, picture-frame, \
         stadium-film, drum, copper, spruce-a, spruce-b, phone-board, leissa, glass-2015 \
         (nearest: picture-frame)"
    );
}
