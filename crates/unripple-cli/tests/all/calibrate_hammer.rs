//! Calibration by a hammer with a force sensor and by taps, from recordings in files, and by the virtual surface's hammer.

use crate::bench;
use crate::common;
use crate::elsewhere;

use bench::FILM;
use common::{Scratch, json, number, refused};
use elsewhere::{bring, response};
use unripple::core::{Device, Point};
use unripple_devices::{Tap, Virtual, VirtualOptions};
use unripple_store::parse_surface;

/// What full scale stands for in the recordings: m/s at the sensors, N at the hammer.
const SENSORS: f64 = 0.5;
const NEWTONS: f64 = 20.0;

/// Where it is struck, in mm: the first two points of a grid of 35 mm.
const AT: [(f64, f64); 2] = [(35.0, 35.0), (70.0, 35.0)];

/// Records a push at a place of a film by all sensors and the hammer, scaled to full scale.
fn record(push: &Tap, at: (f64, f64)) -> Vec<Vec<f64>> {
    let surface = parse_surface(FILM, "film").unwrap();
    let options = VirtualOptions { hammer: true, ..VirtualOptions::default() };
    let mut device = Virtual::new(&surface, &options).unwrap();
    let handle = device.handle();
    handle.tap(push, Point::from_mm(at.0, at.1), 0.03).unwrap();
    let (inputs, block) = (device.layout().inputs.len(), device.layout().block);
    let (mut heard, mut lines) = (vec![0.0_f32; inputs * block], vec![Vec::new(); inputs]);
    for _ in 0..(48_000 / block) {
        device.exchange(&vec![0.0; 5 * block], &mut heard).unwrap();
        for (line, plane) in lines.iter_mut().zip(heard.chunks(block)) {
            line.extend(plane.iter().map(|x| f64::from(*x)));
        }
    }
    let probe = lines.len() - 2;
    lines.remove(probe);
    let last = lines.len() - 1;
    for (input, line) in lines.iter_mut().enumerate() {
        let full = if input == last { NEWTONS } else { SENSORS };
        line.iter_mut().for_each(|x| *x /= full);
    }
    lines
}

/// A double hit: a third of a millisecond each, 6 ms apart.
fn double() -> Tap {
    let push = Tap::half_sine(6.0, 0.3e-3, 48e3);
    let mut force = push.force().to_vec();
    force.resize(288, 0.0);
    force.extend(push.force().iter().map(|f| 0.4 * f));
    Tap::new(force)
}

/// Gain of a library's responses at a point relative to computed ones, and the share, as amplitude, by which they differ otherwise, from
/// 2 ms on.
fn against(found: &[f64], real: &[f64], actuators: usize) -> [f64; 2] {
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    let [one, other] = [found, real].map(|all| all.chunks(all.len() / actuators).collect::<Vec<_>>());
    for (found, real) in one.iter().zip(&other) {
        for i in 96..found.len().min(real.len()) - 100 {
            (xx, xy, yy) = (xx + real[i] * real[i], xy + real[i] * found[i], yy + found[i] * found[i]);
        }
    }
    [xy / xx, (1.0 - xy * xy / (xx * yy)).sqrt()]
}

#[test]
fn recordings_of_blows_and_of_taps_are_libraries() {
    let scratch = Scratch::new("hammer");
    let film = scratch.file("film.toml", FILM);
    let folder = scratch.join("blows");
    std::fs::create_dir_all(&folder).unwrap();
    let push = |peak: f64| Tap::half_sine(peak, 0.3e-3, 48e3);
    let files = [
        ("one.wav", push(5.0), 0),
        ("two.wav", push(8.0), 0),
        ("three.wav", double(), 0),
        ("four.wav", push(4.0), 1),
    ];
    let mut table = "file,x_mm,y_mm\n".to_owned();
    for (name, push, place) in &files {
        let (x, y) = AT[*place];
        bring(&folder, name, &record(push, (x, y)));
        table += &format!("{name},{x},{y}\n");
    }
    table += "five.wav,20,20\n";
    let table = scratch.file("blows.csv", table);
    let (library, taps, real) = (scratch.join("library"), scratch.join("taps"), scratch.join("real"));
    let by = |way: &'static str| {
        vec!["calibrate", &film, "--by", way, "--device", "tape", "--tape", &folder, "--table", &table]
    };

    // Units are asked for.
    let bare = [by("hammer"), vec!["-o", &library]].concat();
    assert!(refused(&bare, 2).contains("force=100"));
    let half = [bare.clone(), vec!["--input-scale", "force=20"]].concat();
    assert!(refused(&half, 2).contains("none for `a1`"));
    let told = json(&[half, vec!["--input-scale", "0.5"]].concat());
    assert_eq!((number(&told, "/measured"), number(&told, "/points")), (2.0, 3.0));
    assert_eq!((number(&told, "/blows/used"), number(&told, "/blows/refused")), (3.0, 1.0));
    assert_eq!(told["tape"]["missing"][0], "five.wav");
    assert!(told["notes"].to_string().contains("double hit"), "{}", told["notes"]);

    json(&["respond", &film, "--grid-mm", "35", "--length-ms", "100", "-o", &real]);
    for point in 0..2 {
        let [gain, off] = against(&response(&library, point), &response(&real, point), 5);
        assert!((gain - 1.0).abs() < 0.01 && off < 0.03, "point {point}: gain {gain}, off by {off}");
    }

    // The same recordings as taps of unknown force, by the film's own model.
    let inputs = "a1,a2,a3,a4,a5,force";
    json(&[by("tap"), vec!["--tape-inputs", inputs, "-o", &taps]].concat());
    let [_, off] = against(&response(&taps, 1), &response(&real, 1), 5);
    assert!(off < 0.13, "off by {off}");
}

#[test]
fn the_virtual_hammer_calibrates() {
    let scratch = Scratch::new("virtual-hammer");
    let film = scratch.file("film.toml", FILM);
    let library = scratch.join("library");
    let told = json(&[
        "calibrate",
        &film,
        "--unknowns",
        "5",
        "--at",
        "52,47",
        "--by",
        "hammer",
        "--repeats",
        "2",
        "-o",
        &library,
    ]);
    assert_eq!((number(&told, "/probed"), number(&told, "/blows/used")), (1.0, 2.0));
    assert!(
        number(&told, "/reciprocity_error") < 0.05 && told["doubtful"].as_array().unwrap().is_empty(),
        "{told}"
    );
}
