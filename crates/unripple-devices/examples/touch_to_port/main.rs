//! How late `unripple play` answers a touch through a JACK server, what it costs while nobody touches and under ten fingers, and what
//! its own summary says of that, beside a client that does nothing: `cargo run --release -p unripple-devices --example touch_to_port
//! -- [PROGRAM] [TOUCHES] [SECONDS] [real-time]`. Needs `jackd`.

mod client;
mod rig;

use client::{Client, Jack, Role};
use rig::{Finger, Process, free_port, patiently, processor, program, server};
use serde_json::Value;
use std::error::Error;
use std::net::UdpSocket;
use std::sync::atomic::Ordering::Relaxed;
use std::time::{Duration, Instant};

const OUTPUTS: usize = 8;
const PERIODS: [usize; 3] = [64, 256, 1024];

struct Wanted {
    program: String,
    touches: usize,
    seconds: f64,
    real_time: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut all = std::env::args().skip(1);
    let wanted = Wanted {
        program: all.next().unwrap_or_else(|| "target/release/unripple".into()),
        touches: all.next().map_or(Ok(200), |n| n.parse())?,
        seconds: all.next().map_or(Ok(10.0), |n| n.parse())?,
        real_time: all.next().is_some(),
    };
    let Some(jack) = Jack::load() else {
        println!("SKIPPED: there is no libjack here (Debian: apt install jackd2)");
        return Ok(());
    };
    println!(
        "from a touch, and from its end, to the first sample at the ports, ms, {} touches each; load average {}",
        wanted.touches,
        load()
    );
    println!(
        "{:>6} {:<34}{:>8}{:>8}{:>8}{:>8}{:>8}{:>10}{:>10}{:>8}{:>8}",
        "period",
        "who, told by whom",
        "p50",
        "p90",
        "p99",
        "worst",
        "missed",
        "idle %",
        "fingers %",
        "late",
        "lost"
    );
    for period in PERIODS {
        sitting(jack, &wanted, period)?;
    }
    Ok(())
}

/// One server: touches for the program and for an empty client, one after the other.
fn sitting(jack: &'static Jack, wanted: &Wanted, period: usize) -> Result<(), Box<dyn Error>> {
    let name = format!("touch-to-port-{}", std::process::id());
    let Some(_server) = server(&name, period, wanted.real_time) else {
        println!("SKIPPED: there is no jackd here (Debian: apt install jackd2)");
        return Ok(());
    };
    let socket = UdpSocket::bind("127.0.0.1:0")?;
    socket.set_nonblocking(true)?;
    let empty_port = socket.local_addr()?.port();
    let ours = patiently(|| Client::open(jack, &name, "watch-ours", Role::Watch(OUTPUTS)))?;
    let theirs = patiently(|| Client::open(jack, &name, "watch-empty", Role::Watch(1)))?;
    let empty = Client::open(jack, &name, "empty", Role::Answer(socket)).ok_or("no third client")?;
    if !theirs.hear("empty:out", 0) {
        return Err("the empty client cannot be connected".into());
    }
    let port = free_port()?;
    let mut played = play(wanted, &name, "click-button", port, &ours)?;
    let thread = Some(empty.shared.thread.load(Relaxed));
    let before = [processor(played.0.id(), None), processor(std::process::id(), thread)];
    std::thread::sleep(Duration::from_secs_f64(wanted.seconds));
    let after = [processor(played.0.id(), None), processor(std::process::id(), thread)];
    let idle = [0, 1].map(|i| 100.0 * (after[i] - before[i]) / wanted.seconds);
    let late = ours.shared.late.load(Relaxed);
    let fingers = [Finger::new(port)?, Finger::new(empty_port)?];
    let times = touches(jack, wanted.touches, fingers, [&ours, &theirs])?;
    let late = ours.shared.late.load(Relaxed) - late;
    let summary = played.finish()?;
    let strokes = free_port()?;
    let mut played = play(wanted, &name, "sandpaper", strokes, &ours)?;
    let before = processor(played.0.id(), None);
    Finger::new(strokes)?.ten(wanted.seconds);
    let busy = 100.0 * (processor(played.0.id(), None) - before) / wanted.seconds;
    let stroked = played.finish()?;
    let missed = times.each_ref().map(|all| 2 * wanted.touches - all.len());
    row(
        period,
        "play, an independent client",
        &measured(&times[0]),
        missed[0],
        [Some(idle[0]), Some(busy)],
        Some(late),
        None,
    );
    let lost = summary["lost_blocks"].as_u64().zip(stroked["lost_blocks"].as_u64()).map(|(a, b)| a + b);
    row(period, "play, its own summary", &told(&summary), 0, [None, None], None, lost);
    row(
        period,
        "empty, an independent client",
        &measured(&times[1]),
        missed[1],
        [Some(idle[1]), None],
        Some(late),
        None,
    );
    Ok(())
}

/// Milliseconds from each touch and from its end to their answers, of two who are touched in turn.
fn touches(
    jack: &Jack,
    count: usize,
    mut fingers: [Finger; 2],
    watches: [&Client; 2],
) -> Result<[Vec<f64>; 2], Box<dyn Error>> {
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..count {
        for ((finger, watch), times) in fingers.iter_mut().zip(watches).zip(&mut times) {
            times.extend(touch(jack, finger, watch)?.into_iter().flatten());
        }
    }
    Ok(times)
}

/// The program, once its ports are there and heard.
fn play(
    wanted: &Wanted,
    name: &str,
    effect: &str,
    port: u16,
    watch: &Client,
) -> Result<Process, Box<dyn Error>> {
    let played = program(&wanted.program, name, port, &["--effect", effect])
        .map_err(|e| format!("{}: {e}", wanted.program))?;
    let ports = |i: usize| format!("unripple:out_a{}", i + 1);
    patiently(|| (0..OUTPUTS).all(|i| watch.hear(&ports(i), i)).then_some(()))?;
    // What a start costs is over.
    std::thread::sleep(Duration::from_secs(1));
    Ok(played)
}

/// Milliseconds from a touch to the first sample, and from its end: the program's own summary counts both, and so does this.
fn touch(jack: &Jack, finger: &mut Finger, watch: &Client) -> Result<[Option<f64>; 2], Box<dyn Error>> {
    let place = (10.0 + 130.0 * finger.chance() as f32, 10.0 + 130.0 * finger.chance() as f32);
    let pressed = answer(jack, finger, watch, |finger| finger.touch(1, place))?;
    Ok([pressed, answer(jack, finger, watch, |finger| finger.lift(1))?])
}

/// Milliseconds from what a finger does to the first sample; nothing if none came.
fn answer(
    jack: &Jack,
    finger: &mut Finger,
    watch: &Client,
    act: impl Fn(&mut Finger),
) -> Result<Option<f64>, Box<dyn Error>> {
    let shared = watch.shared;
    // All that the last one set off is over.
    patiently(|| (shared.silent.load(Relaxed) > 3).then_some(()))?;
    // At any moment of a cycle: this spans two of the longest.
    std::thread::sleep(Duration::from_secs_f64(0.06 + 2.0 * 1024.0 / 48e3 * finger.chance()));
    shared.found.store(0, Relaxed);
    shared.armed.store(true, Relaxed);
    let sent = jack.now();
    act(finger);
    let start = Instant::now();
    while shared.found.load(Relaxed) == 0 && start.elapsed() < Duration::from_secs(1) {
        std::thread::sleep(Duration::from_millis(2));
    }
    let found = shared.found.load(Relaxed);
    Ok((found > 0).then_some(1e-3 * (found as f64 - sent as f64)))
}

fn measured(times: &[f64]) -> [f64; 4] {
    let mut times = times.to_vec();
    times.sort_unstable_by(f64::total_cmp);
    let at = |share: f64| times.get((share * times.len() as f64) as usize).or(times.last()).copied();
    [0.5, 0.9, 0.99, 1.0].map(|share| at(share).unwrap_or(f64::NAN))
}

fn told(summary: &Value) -> [f64; 4] {
    let number = |key: &str| summary["first_sample_s"][key].as_f64().map_or(f64::NAN, |s| 1e3 * s);
    ["p50", "p90", "p99", "worst"].map(number)
}

fn row(
    period: usize,
    who: &str,
    times: &[f64; 4],
    missed: usize,
    shares: [Option<f64>; 2],
    late: Option<u64>,
    lost: Option<u64>,
) {
    let times: String = times.iter().map(|ms| format!("{ms:>8.2}")).collect();
    let shares: String =
        shares.map(|share| share.map_or(format!("{:>10}", "-"), |s| format!("{s:>10.2}"))).concat();
    let counts: String =
        [late, lost].map(|n| n.map_or(format!("{:>8}", "-"), |n| format!("{n:>8}"))).concat();
    println!("{period:>6} {who:<34}{times}{missed:>8}{shares}{counts}");
}

fn load() -> String {
    std::fs::read_to_string("/proc/loadavg").unwrap_or_default().split(' ').next().unwrap_or("-").to_owned()
}
