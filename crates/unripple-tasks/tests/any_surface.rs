//! Whatever `check` passes, no other task refuses for the file's sake: random surfaces through `check`, `design`, `modes` and a focus.
//!
//! UNRIPPLE_SURFACES says how many, UNRIPPLE_SEED which; an error counts as a fault unless it is memory or an accuracy that the message
//! names.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use unripple::act::{Act, Level, chosen_window, model};
use unripple::core::{Random, Surface};
use unripple::focus::{Options, Target};
use unripple_tasks::{Silent, SurfaceAsk, check, design, modes};

/// Surfaces where nothing else is said; ./soak takes 2000.
const FEW: u64 = 12;

/// One in three has more modes than this.
const MANY: f64 = 100.0;

/// A shape as a file says it, its area in mm², the number of its sides and its extent in mm.
struct Shape {
    text: String,
    area: f64,
    sides: usize,
    extent: [f64; 2],
}

fn pick<'a>(random: &mut Random, of: &[&'a str]) -> &'a str {
    of[((random.uniform() * of.len() as f64) as usize).min(of.len() - 1)]
}

fn chance(random: &mut Random, share: f64) -> bool {
    random.uniform() < share
}

/// A polygon whose corners lie around its middle, in mm, its bounding box at the origin.
fn star(random: &mut Random, size: f64) -> Vec<[f64; 2]> {
    let count = 3 + (random.uniform() * 7.0) as usize;
    let mut corners: Vec<[f64; 2]> = (0..count)
        .map(|i| {
            let angle = TAU * (i as f64 + random.between(-0.3, 0.3)) / count as f64;
            let radius = size * random.between(0.35, 0.6);
            [radius * angle.cos(), radius * angle.sin()]
        })
        .collect();
    for axis in [0, 1] {
        let least = corners.iter().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min);
        corners.iter_mut().for_each(|corner| corner[axis] -= least);
    }
    corners
}

fn area(corners: &[[f64; 2]]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    0.5 * corners.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
}

fn shape(random: &mut Random) -> Shape {
    let size = random.decades(20.0, 1000.0);
    let other = size * random.between(0.3, 1.0);
    let (text, area, sides, extent) = match (random.uniform() * 5.0) as usize {
        0 | 1 => (format!("rectangle_mm = [{size}, {other}]"), size * other, 4, [size, other]),
        2 => (format!("circle_mm = {}", size / 2.0), PI * size * size / 4.0, 1, [size; 2]),
        3 => {
            let radius = other / 2.0;
            let area = size * other + PI * radius * radius;
            (format!("stadium_mm = [{size}, {radius}]"), area, 4, [size + other, other])
        }
        _ => {
            let corners = star(random, size);
            let most = |axis: usize| corners.iter().map(|corner| corner[axis]).fold(0.0, f64::max);
            let extent = [most(0), most(1)];
            (format!("polygon_mm = {corners:?}"), area(&corners), corners.len(), extent)
        }
    };
    Shape { text, area, sides, extent }
}

fn edge(random: &mut Random) -> String {
    let held = pick(random, &["\"clamped\"", "\"clamped\"", "\"supported\"", "\"free\"", "springs"]);
    match held {
        "springs" => format!(
            "{{ lift_n_per_mm2 = {}, tilt_n = {} }}",
            random.decades(1e-4, 1e2),
            random.decades(1e-3, 1e2)
        ),
        held => held.into(),
    }
}

fn edges(random: &mut Random, sides: usize) -> String {
    match chance(random, 0.5) {
        true => edge(random),
        false => format!("[{}]", (0..sides).map(|_| edge(random)).collect::<Vec<_>>().join(", ")),
    }
}

/// Young's modulus (Pa), density and thickness (m), and tension (N/m), with the lines that say so.
fn sheet(random: &mut Random) -> (String, [f64; 4]) {
    let (name, young, density, thickness) = match (random.uniform() * 4.0) as usize {
        0 => ("BoPET", 4e9, 1400.0, random.decades(0.02, 0.4)),
        1 => ("glass", 70e9, 2500.0, random.decades(0.3, 4.0)),
        2 => ("aluminium", 70e9, 2700.0, random.decades(0.1, 3.0)),
        _ => ("PMMA", 3.2e9, 1180.0, random.decades(0.5, 5.0)),
    };
    let film = name == "BoPET";
    let tension = if film { random.decades(20.0, 2000.0) } else { 0.0 };
    let mut text =
        format!("material = \"{name}\"\nthickness_mm = {thickness}\ntension_n_per_m = {tension}\n");
    text += &match (random.uniform() * 3.0) as usize {
        0 => format!("loss_factor = {}\n", random.decades(1e-3, 0.2)),
        1 => format!("decay_time_ms = {}\n", random.decades(2.0, 200.0)),
        _ => format!(
            "decay_time_ms = [[100, {}], [3000.5, {}]]\n",
            random.decades(5.0, 200.0),
            random.decades(2.0, 50.0)
        ),
    };
    let _ = writeln!(text, "air = \"{}\"", pick(random, &["none", "none", "one-side", "both-sides"]));
    if chance(random, 0.15) {
        let _ = writeln!(
            text,
            "thickness_profile = [[1.0, {}], [{}, 1.0]]",
            random.between(0.7, 1.4),
            random.between(0.7, 1.4)
        );
    }
    if film && chance(random, 0.15) {
        let _ = writeln!(text, "tension_profile = [[1.0, {}]]", random.between(0.6, 1.5));
    }
    if chance(random, 0.1) {
        let across = young * random.between(0.3, 1.0) / 1e9;
        let _ = writeln!(text, "young_across_gpa = {across}\ngrain_deg = {}", random.between(-90.0, 90.0));
    }
    (text, [young, density, thickness * 1e-3, tension])
}

/// The frequency below which a sheet of some area has about so many modes (Weyl's law), in Hz.
fn top(area: f64, [young, density, thickness, tension]: [f64; 4], count: f64) -> f64 {
    let stiffness = young * thickness.powi(3) / (12.0 * (1.0 - 0.3_f64.powi(2)));
    let square = 4.0 * PI * count / area;
    ((tension * square + stiffness * square * square) / (density * thickness)).sqrt() / TAU
}

fn actuator(random: &mut Random, at: [f64; 2], size: f64) -> String {
    let mut text = format!("\n[[actuator]]\nat_mm = {at:?}\n");
    match (random.uniform() * 4.0) as usize {
        0 | 1 => {
            if chance(random, 0.5) {
                let _ = writeln!(text, "contact_radius_mm = {}", size * random.between(0.005, 0.03));
            }
        }
        2 => {
            let radius = (size * random.between(0.01, 0.08)).max(0.1);
            let moment = random.between(-0.1, 0.1);
            let _ = writeln!(text, "kind = \"piezo\"\nradius_mm = {radius}\nmoment_n_per_v = {moment}");
        }
        _ => {
            let _ = writeln!(
                text,
                "kind = \"moving-magnet\"\nforce_constant_n_per_a = {}\nresistance_ohm = {}\ninductance_mh = {}\nmoving_mass_mg = {}\n\
                 driven_by = \"{}\"",
                random.decades(0.1, 10.0),
                random.decades(2.0, 20.0),
                if chance(random, 0.5) { random.decades(0.01, 2.0) } else { 0.0 },
                if chance(random, 0.7) { random.decades(1.0, 1000.0) } else { 0.0 },
                pick(random, &["current", "voltage"]),
            );
        }
    }
    text
}

fn hole(random: &mut Random, at: [f64; 2], size: f64) -> String {
    let mut text = "\n[[hole]]\n".to_owned();
    let radius = size * random.between(0.02, 0.1);
    text += &match (random.uniform() * 3.0) as usize {
        0 => format!("circle_mm = {radius}\ncentre_mm = {at:?}\n"),
        1 => format!("rectangle_mm = [{radius}, {}]\nat_mm = {at:?}\n", radius * random.between(0.3, 1.0)),
        _ => format!("slit_mm = [{at:?}, [{}, {}]]\nwidth_mm = 0.5\n", at[0] + radius, at[1] + 0.5 * radius),
    };
    if chance(random, 0.5) {
        let _ = writeln!(text, "edge = {}", edge(random));
    }
    text
}

/// A surface file: plausible, and here and there at the border of what is legal.
fn file(random: &mut Random) -> String {
    let shape = shape(random);
    let (sheet, known) = sheet(random);
    let count = if chance(random, 0.4) { random.decades(MANY, 260.0) } else { random.decades(4.0, MANY) };
    let top = top(shape.area * 1e-6, known, count);
    let low = if chance(random, 0.3) { top * random.between(0.0, 0.4) } else { 0.0 };
    // Some rates are too low for the band, most are no whole numbers.
    let rate = (top * random.decades(1.9, 12.0)).clamp(100.0, 1e7);
    let outline = &shape.text;
    let edge = edges(random, shape.sides);
    let mut text = format!(
        "format = 1\n\n[outline]\n{outline}\nedge = {edge}\n\n[sheet]\n{sheet}\n[drive]\nband_hz = [{low}, {top}]\nsample_rate_hz = {rate}\nlimit = {}\n",
        random.decades(0.01, 10.0)
    );
    let size = (shape.area).sqrt();
    // Somewhere around the middle, now and then beyond the rim.
    let reach = if chance(random, 0.1) { 0.6 } else { 0.4 };
    let [width, height] = shape.extent;
    let place = |random: &mut Random| {
        let (angle, share) = (random.between(0.0, TAU), reach * random.uniform().sqrt());
        [width * (0.5 + share * angle.cos()), height * (0.5 + share * angle.sin())]
    };
    if chance(random, 0.2) {
        let at = place(random);
        text += &hole(random, at, size);
    }
    for _ in 0..1 + (random.uniform() * 6.0) as usize {
        let at = place(random);
        text += &actuator(random, at, size);
    }
    text
}

/// What came of a surface.
enum Outcome {
    /// `check` refused it.
    Refused,
    /// Everything was computed, on so many modes.
    Computed(usize),
    /// Memory or an accuracy stood in the way, and was named.
    Excused(String),
    /// Something passed `check` and was refused later, or is no number.
    Fault(String),
}

/// Errors of memory and of accuracy name what was wanted and what there is.
fn excused(error: &str) -> bool {
    error.contains("GiB") || error.contains("expected an error of at most")
}

fn judged(text: &str) -> Outcome {
    let surface = SurfaceAsk::Text { toml: text.into(), name: None };
    match check::run(&check::Ask { surface: surface.clone() }, &mut Silent) {
        Ok(report) if !report.ok => return Outcome::Refused,
        Ok(_) => {}
        Err(error) => return Outcome::Fault(format!("check: {error}")),
    }
    let found =
        match modes::run(&modes::Ask { surface: surface.clone(), ..modes::Ask::default() }, &mut Silent) {
            Ok(found) => found,
            Err(error) if excused(&error.to_string()) => return Outcome::Excused(error.to_string()),
            Err(error) => return Outcome::Fault(format!("modes: {error}")),
        };
    if !found.frequencies_hz.iter().chain([&found.relative_error]).all(|x| x.is_finite()) {
        return Outcome::Fault("modes: expected numbers, found others".into());
    }
    if let Err(error) = design::run(&design::Ask { surface: surface.clone() }, &mut Silent) {
        return Outcome::Fault(format!("design: {error}"));
    }
    match surface.load().map_err(|error| error.to_string()).and_then(|surface| focused(&surface)) {
        Ok(()) => Outcome::Computed(found.count),
        Err(error) if excused(&error) => Outcome::Excused(error),
        Err(error) => Outcome::Fault(format!("focus: {error}")),
    }
}

/// Focuses near the middle of the surface, and judges that.
fn focused(surface: &Surface) -> Result<(), String> {
    let responses = model(surface, None, &[]).map_err(|error| error.to_string())?;
    let (width, height) = surface.outline.extent();
    let at = surface.outline.nearest(unripple::core::Point::new(0.45 * width, 0.52 * height));
    let window = chosen_window(surface, &responses).seconds;
    let options = Options { window, limit: surface.emission.limit, ..Options::default() };
    let targets = [Target::at(at)];
    let act =
        Act { surface, responses: &responses, targets: &targets, options: &options, level: Level::Linear };
    let acted = act.run().map_err(|error| error.to_string())?;
    let peak = acted.judged.measured.targets[0].peak_velocity_m_s;
    if peak.is_finite() { Ok(()) } else { Err(format!("expected a peak, found {peak}")) }
}

fn number(name: &str, usual: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

#[test]
fn what_check_passes_is_computed() {
    let (count, seed) = (number("UNRIPPLE_SURFACES", FEW), number("UNRIPPLE_SEED", 1));
    let mut counts: BTreeMap<&str, u64> = BTreeMap::new();
    let (mut many, mut faults) = (0, Vec::new());
    for surface in 0..count {
        let text = file(&mut Random::seeded(seed * 1_000_003 + surface));
        let outcome = std::panic::catch_unwind(|| judged(&text));
        let kind = match outcome.unwrap_or_else(|_| Outcome::Fault("a panic".into())) {
            Outcome::Refused => "refused by check",
            Outcome::Computed(modes) => {
                many += u64::from(modes as f64 > MANY);
                "computed"
            }
            Outcome::Excused(why) => {
                println!("surface {surface}: {why}");
                "memory or accuracy"
            }
            Outcome::Fault(why) => {
                println!("surface {surface} of seed {seed}: {why}\n{text}\n");
                faults.push((surface, why));
                "fault"
            }
        };
        *counts.entry(kind).or_default() += 1;
    }
    println!("{count} surfaces of seed {seed}: {counts:?}, {many} with more than {MANY} modes");
    assert!(faults.is_empty(), "{faults:?}");
    assert!(counts.get("computed").is_some_and(|computed| computed * 3 > count), "{counts:?}");
}
