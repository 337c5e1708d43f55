//! Estimates of cost beside what was used, over thirty-six surfaces: processor time and memory of whole processes.
//!
//! ```text
//! cargo run --release -p unripple-tasks --example costs -- [modes|focus] [TEXT IN THE NAME]
//! ```
//!
//! Each task runs in a process of its own, without a cache. Linux alone, since it reads /proc.

use std::fs;
use std::process::Command;
use unripple::act::model_cost;
use unripple::core::Surface;
use unripple_tasks::cost::{Estimate, of_drives};
use unripple_tasks::machine::speed;
use unripple_tasks::target::PointAsk;
use unripple_tasks::{Silent, SurfaceAsk, TaskError, focus, modes, observed};

const FILM: &str =
    "[sheet]\nmaterial = \"BoPET\"\nthickness_mm = 0.125\ntension_n_per_m = 200\ndecay_time_ms = 70\n";
const THIN: &str =
    "[sheet]\nmaterial = \"BoPET\"\nthickness_mm = 0.05\ntension_n_per_m = 200\ndecay_time_ms = 70\n";
const SKIN: &str =
    "[sheet]\nmaterial = \"BoPET\"\nthickness_mm = 0.25\ntension_n_per_m = 1500\ndecay_time_ms = 70\n";
const GLASS: &str = "[sheet]\nmaterial = \"glass\"\nthickness_mm = 0.5\ndecay_time_ms = 20\n";
const WOOD: &str = "[sheet]\nmaterial = \"wood\"\nyoung_gpa = 10\ndensity_kg_m3 = 500\npoisson_ratio = 0.3\nyoung_across_gpa = 1\nshear_gpa = 0.6\nthickness_mm = 1\nloss_factor = 0.01\n";
const PATCH: &str = "kind = \"piezo\"\nradius_mm = 5\nmoment_n_per_v = 0.01\npatch_mass_mg = 200\n";
const COIL: &str = "kind = \"moving-magnet\"\nmoving_mass_mg = 250\nforce_constant_n_per_a = 6\nresistance_ohm = 6.2\ndriven_by = \"voltage\"\n";

/// A kind of surface: its name, outline, sheet, rate in Hz, actuators and what they are, and three tops of its band in Hz.
type Kind = (&'static str, &'static str, &'static str, u32, &'static [[f64; 2]], &'static str, [f64; 3]);

const CORNERS: &[[f64; 2]] = &[[20.0, 30.0], [25.0, 70.0], [60.0, 22.0], [40.0, 75.0]];
const INSIDE: &[[f64; 2]] =
    &[[60.0, 100.0], [70.0, 240.0], [150.0, 40.0], [250.0, 60.0], [290.0, 200.0], [170.0, 290.0]];
const EIGHT: &[[f64; 2]] = &[
    [12.0, 31.0],
    [13.0, 77.0],
    [20.0, 120.0],
    [62.0, 11.0],
    [111.0, 15.0],
    [135.0, 40.0],
    [131.0, 93.0],
    [80.0, 137.0],
];

const KINDS: [Kind; 12] = [
    ("film", "rectangle_mm = [150, 150]", FILM, 48_000, EIGHT, "", [2e3, 4e3, 8e3]),
    ("film with coils", "rectangle_mm = [150, 150]", FILM, 48_000, EIGHT, COIL, [1e3, 2e3, 3e3]),
    ("thin film", "rectangle_mm = [300, 200]\nedge = \"clamped\"", THIN, 48_000, EIGHT, "", [1e3, 2e3, 3e3]),
    ("free glass", "rectangle_mm = [148, 210]\nedge = \"free\"", GLASS, 192_000, EIGHT, "", [1e4, 2e4, 4e4]),
    (
        "glass with patches",
        "rectangle_mm = [148, 210]\nedge = \"free\"",
        GLASS,
        192_000,
        EIGHT,
        PATCH,
        [5e3, 1e4, 2e4],
    ),
    ("stadium", "stadium_mm = [80, 50]", FILM, 48_000, CORNERS, "", [1e3, 2e3, 3e3]),
    ("stadium with coils", "stadium_mm = [80, 50]", FILM, 48_000, CORNERS, COIL, [5e2, 1e3, 2e3]),
    ("oval skin", "stadium_mm = [20, 165]\nedge = \"clamped\"", SKIN, 48_000, INSIDE, "", [1e3, 1.5e3, 2e3]),
    (
        "L",
        "polygon_mm = [[0, 0], [200, 0], [200, 90], [100, 90], [100, 180], [0, 180]]\nedge = \"clamped\"",
        FILM,
        48_000,
        CORNERS,
        "",
        [5e2, 1e3, 2e3],
    ),
    (
        "L of glass",
        "polygon_mm = [[0, 0], [200, 0], [200, 90], [100, 90], [100, 180], [0, 180]]\nedge = \"free\"",
        GLASS,
        96_000,
        CORNERS,
        "",
        [4e3, 8e3, 1.5e4],
    ),
    (
        "glass with a hole",
        "rectangle_mm = [200, 150]\nedge = \"clamped\"\n[[hole]]\ncircle_mm = 20\ncentre_mm = [120, 70]\nedge = \"free\"",
        GLASS,
        96_000,
        CORNERS,
        "",
        [4e3, 8e3, 1.5e4],
    ),
    ("veneer", "rectangle_mm = [200, 150]\nedge = \"clamped\"", WOOD, 48_000, CORNERS, "", [3e3, 6e3, 9e3]),
];

fn text((_, outline, sheet, rate, at, kind, _): &Kind, top: f64) -> String {
    let actuator = |[x, y]: &[f64; 2]| format!("[[actuator]]\nat_mm = [{x}, {y}]\n{kind}");
    let actuators: String = at.iter().map(actuator).collect();
    format!(
        "format = 1\n[outline]\n{outline}\n{sheet}[drive]\nband_hz = [0, {top}]\nsample_rate_hz = {rate}\n{actuators}"
    )
}

/// What the tasks are and what they are estimated to cost.
fn estimate(task: &str, surface: &Surface) -> Result<Estimate, TaskError> {
    let cost = match task {
        "modes" => model_cost(surface, None, &[])?,
        _ => of_drives(surface, surface, None, None, &[], 1)?,
    };
    Ok(Estimate::of(cost))
}

/// Does a task on a surface.
fn work(task: &str, surface: SurfaceAsk) -> Result<(), TaskError> {
    observed(&mut Silent, |progress| match task {
        // To the accuracy that drives are computed to.
        "modes" => {
            let accuracy = Some(unripple::physics::accuracy(&surface.load()?).aim);
            modes::run(&modes::Ask { surface, accuracy, ..modes::Ask::default() }, progress).map(drop)
        }
        _ => {
            let points = vec![PointAsk::at(0.062, 0.060)];
            focus::make(&focus::Ask { surface, points, ..focus::Ask::default() }, progress).map(drop)
        }
    })
}

/// Processor time (s) and largest memory (bytes) that this process has used.
fn used() -> [f64; 2] {
    let stat = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after = stat.rsplit(')').next().unwrap_or_default();
    let ticks = |n: usize| after.split_whitespace().nth(n).and_then(|x| x.parse::<f64>().ok()).unwrap_or(0.0);
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap_or_default();
    let kib = peak.split_whitespace().next().and_then(|x| x.parse::<f64>().ok()).unwrap_or(0.0);
    // A hundred ticks a second, whatever the kernel.
    [(ticks(11) + ticks(12)) / 100.0, 1024.0 * kib]
}

/// Processor time (s) and largest memory (bytes) of a task on the surface of a text, in a process of its own; what it said where it failed.
fn measured(task: &str, text: &str) -> Result<[f64; 2], String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let output =
        Command::new(program).args(["--one", task, text]).output().map_err(|error| error.to_string())?;
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let numbers: Vec<f64> =
        said.trim().trim_matches(['[', ']']).split(',').filter_map(|x| x.trim().parse().ok()).collect();
    numbers.try_into().map_err(|_| String::from_utf8_lossy(&output.stderr).trim().to_owned())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [only, task, text] = arguments.as_slice()
        && only == "--one"
    {
        work(task, SurfaceAsk::Text { toml: text.clone(), name: None })?;
        println!("{:?}", used());
        return Ok(());
    }
    let tasks: Vec<&str> =
        ["modes", "focus"].into_iter().filter(|task| arguments.first().is_none_or(|a| a == task)).collect();
    println!(
        "a processor of this machine has {:.2} times the speed of the one that the laws count in",
        speed()
    );
    println!(
        "task   surface                 top Hz   estimate s   used s  ratio   estimate GB  used GB  ratio"
    );
    let asked = |kind: &&Kind| arguments.get(1).is_none_or(|part| kind.0.contains(part.as_str()));
    let mut worst = [1.0_f64; 2];
    for (kind, top) in KINDS.iter().filter(asked).flat_map(|kind| kind.6.map(|top| (kind, top))) {
        for task in &tasks {
            let text = text(kind, top);
            let surface = SurfaceAsk::Text { toml: text.clone(), name: None }.load()?;
            let Estimate { processor_s, bytes, .. } = estimate(task, &surface)?;
            let (name, used) = (kind.0, measured(task, &text));
            let Ok([seconds, peak]) = used else {
                println!("{task:<6} {name:<22} {top:>7}  {}", used.unwrap_err());
                continue;
            };
            let ratios = [processor_s / seconds, bytes / peak];
            let (estimated, taken) = (1e-9 * bytes, 1e-9 * peak);
            println!(
                "{task:<6} {name:<22} {top:>7} {processor_s:>12.2} {seconds:>8.2} {:>6.2} {estimated:>13.2} {taken:>8.2} {:>6.2}",
                ratios[0], ratios[1]
            );
            // What takes less than two seconds, or a tenth of a GB, is not told.
            for (worst, ratio) in
                worst.iter_mut().zip(ratios).zip([seconds > 2.0, peak > 1e8]).filter(|x| x.1).map(|x| x.0)
            {
                *worst = worst.max(ratio).max(1.0 / ratio);
            }
        }
    }
    println!("worst ratio of time {:.2} (above 2 s), of memory {:.2} (above 0.1 GB)", worst[0], worst[1]);
    Ok(())
}
