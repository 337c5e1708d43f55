//! Sittings of `unripple play` at a JACK server that stands still, changes its period or is given more than it can do, and how long
//! after the last finger has gone an independent client still hears anything: `cargo run --release -p unripple-devices --example
//! hostile_sittings -- [PROGRAM]`. Needs `jackd`. Ends with 1 if anything sounds two windows and a cycle after the last lift.

#[path = "../touch_to_port/client.rs"]
#[allow(dead_code)] // `touch_to_port` uses the rest.
mod client;
#[path = "../touch_to_port/rig.rs"]
#[allow(dead_code)] // As above.
mod rig;

use client::{Client, Jack, Role};
use rig::{Finger, Process, free_port, patiently, program, server};
use std::error::Error;
use std::process::Command;
use std::sync::atomic::Ordering::Relaxed;
use std::time::{Duration, Instant};

const OUTPUTS: usize = 8;
const FINGERS: i32 = 8;
const RATE: f64 = 48e3;

/// How long to listen after the last finger has gone.
const LISTENED: Duration = Duration::from_secs(4);

/// What is done to the server while fingers move.
#[derive(Clone, Copy)]
enum Disturbance {
    None,
    /// It stands still for so many seconds, in which the fingers go.
    Frozen(f64),
    /// Its period becomes these, one after the other.
    Periods(&'static [usize]),
}

struct Sitting {
    name: &'static str,
    period: usize,
    effects: String,
    method: &'static str,
    disturbance: Disturbance,
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/release/unripple".into());
    let Some(jack) = Jack::load() else {
        println!("SKIPPED: there is no libjack here (Debian: apt install jackd2)");
        return Ok(());
    };
    println!(
        "eight fingers stroke for 1.5 s; sound after the last of them has gone, by an independent client"
    );
    println!(
        "{:<44}{:>8}{:>11}{:>13}{:>13}{:>12}",
        "sitting", "period", "window, ms", "sounds, ms", "allowed, ms", "drives made"
    );
    let mut wrong = 0;
    for sitting in sittings() {
        wrong += u32::from(!sit(jack, &path, &sitting)?);
    }
    if wrong > 0 {
        return Err(format!("{wrong} sittings sounded on").into());
    }
    Ok(())
}

/// Trains, textures by the dozen, irregular trains: all that goes on until it is stopped.
fn sittings() -> Vec<Sitting> {
    let train = "format = 1\n[[effect]]\nkind = \"pulse-train\"\nrate_hz = 20\ngain = 0.1\n";
    let texture = |mm: f64| format!("[[effect]]\nkind = \"texture\"\nevery_mm = {mm}\ngain = 0.1\n");
    let both = format!("{train}{}", texture(0.8));
    let many = format!("{train}{}", texture(0.1).repeat(40));
    let irregular =
        "format = 1\n[[effect]]\nkind = \"pulse-train\"\nrate_hz = 120\njitter = 1.0\ngain = 0.1\n"
            .to_owned();
    let sitting = |name, period, effects: &String, method, disturbance| Sitting {
        name,
        period,
        effects: effects.clone(),
        method,
        disturbance,
    };
    let there_and_back = Disturbance::Periods(&[1024, 256]);
    vec![
        sitting("nothing happens", 256, &both, "time-reversal", Disturbance::None),
        sitting("the server stands still for 2 s", 256, &both, "time-reversal", Disturbance::Frozen(2.0)),
        sitting("the same, 40 textures", 256, &many, "time-reversal", Disturbance::Frozen(2.0)),
        sitting("40 textures", 256, &many, "time-reversal", Disturbance::None),
        sitting("256 to 1024 and back", 256, &both, "time-reversal", there_and_back),
        sitting("256 to 1024 and back, 40 textures", 256, &many, "time-reversal", there_and_back),
        sitting("irregular trains", 1024, &irregular, "time-reversal", Disturbance::None),
        sitting("irregular trains", 4096, &irregular, "time-reversal", Disturbance::None),
        sitting(
            "irregular trains, the server stands still",
            4096,
            &irregular,
            "time-reversal",
            Disturbance::Frozen(2.0),
        ),
        sitting("limited", 256, &both, "limited", Disturbance::None),
        sitting("limited, the server stands still", 1024, &both, "limited", Disturbance::Frozen(2.0)),
        sitting("robust", 256, &both, "robust", Disturbance::None),
        sitting("robust, the server stands still", 1024, &both, "robust", Disturbance::Frozen(2.0)),
    ]
}

/// One sitting on a server of its own; whether it was silent in time.
fn sit(jack: &'static Jack, path: &str, sitting: &Sitting) -> Result<bool, Box<dyn Error>> {
    let name = format!("hostile-{}", std::process::id());
    let Some(server) = server(&name, sitting.period, true) else {
        println!("SKIPPED: there is no jackd here (Debian: apt install jackd2)");
        return Ok(true);
    };
    let watch = patiently(|| Client::open(jack, &name, "watch", Role::Watch(OUTPUTS)))?;
    let effects = std::env::temp_dir().join(format!("{name}.toml"));
    std::fs::write(&effects, &sitting.effects)?;
    let port = free_port()?;
    let file = effects.display().to_string();
    let played = program(path, &name, port, &["--effect", &file, "--method", sitting.method]);
    let mut played = played.map_err(|error| format!("{path}: {error}"))?;
    let ports = |i: usize| format!("unripple:out_a{}", i + 1);
    patiently(|| (0..OUTPUTS).all(|i| watch.hear(&ports(i), i)).then_some(()))?;
    std::fs::remove_file(&effects)?;
    let gone = stroke(jack, &server, &name, port, sitting)?;
    let heard = watch.shared.last.load(Relaxed) > 0;
    std::thread::sleep(LISTENED);
    let last = watch.shared.last.load(Relaxed);
    let period = period_of(sitting);
    let summary = played.finish()?;
    drop(watch);
    let window = summary["window_s"].as_f64().ok_or("no window in the summary")?;
    let after = (last as f64 - gone as f64) * 1e-6;
    let allowed = 2.0 * window + period as f64 / RATE;
    println!(
        "{:<44}{:>8}{:>11.1}{:>13.1}{:>13.1}{:>12}{}",
        sitting.name,
        sitting.period,
        1e3 * window,
        1e3 * after,
        1e3 * allowed,
        summary["drives_made"].as_u64().unwrap_or(0),
        if heard { "" } else { "  nothing was heard at all" }
    );
    Ok(heard && after <= allowed)
}

/// The period at the end of a sitting.
fn period_of(sitting: &Sitting) -> usize {
    match sitting.disturbance {
        Disturbance::Periods(all) => all.last().copied().unwrap_or(sitting.period),
        _ => sitting.period,
    }
}

/// Fingers stroke while things happen; when the last of them had gone and the server was at work, in µs of its clock.
fn stroke(
    jack: &Jack,
    server: &Process,
    name: &str,
    port: u16,
    sitting: &Sitting,
) -> Result<u64, Box<dyn Error>> {
    let fingers = Finger::new(port)?;
    let (start, mut changes) = (Instant::now(), 0);
    let mut frozen = false;
    let lasts = match sitting.disturbance {
        Disturbance::Frozen(seconds) => 1.5 + seconds,
        _ => 2.5,
    };
    while start.elapsed().as_secs_f64() < lasts {
        let time = start.elapsed().as_secs_f64();
        if let Disturbance::Frozen(_) = sitting.disturbance
            && time > 1.5
            && !frozen
        {
            server.signal("-STOP");
            frozen = true;
        }
        if let Disturbance::Periods(all) = sitting.disturbance
            && let Some(period) = all.get(changes)
            && time > 0.7 * (changes + 1) as f64
        {
            let mut set = Command::new("jack_bufsize");
            set.env("JACK_DEFAULT_SERVER", name).arg(period.to_string());
            if !set.output()?.status.success() {
                return Err("jack_bufsize did not change the period".into());
            }
            changes += 1;
        }
        for finger in 0..FINGERS {
            let place =
                (75.0 + 50.0 * (6.0 * time as f32 + finger as f32).sin(), 20.0 + 14.0 * finger as f32);
            fingers.touch(finger, place);
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    (0..FINGERS).for_each(|finger| fingers.lift(finger));
    if frozen {
        std::thread::sleep(Duration::from_millis(100));
        server.signal("-CONT");
    }
    Ok(jack.now())
}
