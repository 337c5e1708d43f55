//! Random surface files, as people may write them.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use unripple::core::Random;

/// A shape as a file says it, its area in mm², the number of its sides and its extent in mm.
struct Shape {
    text: String,
    area: f64,
    sides: usize,
    extent: [f64; 2],
}

pub fn pick<T: Copy>(random: &mut Random, of: &[T]) -> T {
    of[((random.uniform() * of.len() as f64) as usize).min(of.len() - 1)]
}

pub fn chance(random: &mut Random, share: f64) -> bool {
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

/// A surface file: plausible, and here and there at the border of what is legal. `count` draws about how many modes lie below the top of
/// its band.
pub fn file(random: &mut Random, count: impl FnOnce(&mut Random) -> f64) -> String {
    let shape = shape(random);
    let (sheet, known) = sheet(random);
    let count = count(random);
    let top = top(shape.area * 1e-6, known, count);
    let low = if chance(random, 0.3) { top * random.between(0.0, 0.4) } else { 0.0 };
    // Some are too low for the band.
    let rate = (top * random.decades(1.9, 12.0)).clamp(100.0, 1e7);
    let outline = &shape.text;
    let edge = edges(random, shape.sides);
    let mut text = format!("format = 1\n\n[outline]\n{outline}\nedge = {edge}\n\n[sheet]\n{sheet}\n");
    let limit = random.decades(0.01, 10.0);
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
    // Now and then a rate that is no whole number, or a band that ends at half of it: both are for `check` to refuse.
    let (rate, top) = match random.uniform() {
        luck if luck < 0.06 => (rate.floor() + 0.5, top),
        luck if luck < 0.12 => (rate.round(), rate.round() / 2.0),
        _ => (rate.round(), top),
    };
    let _ = writeln!(text, "\n[drive]\nband_hz = [{low}, {top}]\nsample_rate_hz = {rate}\nlimit = {limit}");
    text
}
