//! A client that does nothing in a JACK server with its dummy driver, first alone, then beside a film that is played in real time:
//! `cargo run --release -p unripple-live --example under_runs -- [SECONDS]`. Needs `jackd`.
//!
//! A server tells all its clients of each late cycle, so what two clients of one run lost is the same by construction. What playing
//! costs is the difference between the runs, and each client's own late cycles.

#[path = "../tests/common/mod.rs"]
mod common;
#[path = "../../unripple-devices/tests/common/server.rs"]
mod server;

use common::*;
use server::Server;
use std::time::Instant;
use unripple_core::{Cycle, Device, Status, Work};
use unripple_devices::{Jack, JackOptions, Links};
use unripple_effects::{Curve, Kind, Level, Texture};
use unripple_live::{Engine, Stage};
use unripple_touch::{Synthetic, SyntheticOptions};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let seconds: f64 = std::env::args().nth(1).map_or(Ok(20.0), |s| s.parse())?;
    let Some(server) = Server::start(BLOCK) else {
        return Err(server::NONE.into());
    };
    // The server is there once a bridge is.
    let nothing = || Box::new(device()) as Box<dyn Device>;
    drop(server.bridge("probe", nothing)?);
    let outputs: Vec<String> = FILM.actuators.iter().map(|actuator| actuator.name.clone()).collect();
    let open = |client: &str| {
        let (server, outputs) = (Some(server.name.clone()), outputs.clone());
        Jack::open(&JackOptions {
            client: client.into(),
            server,
            outputs,
            links: Links::None,
            ..JackOptions::default()
        })
    };
    let alone = alone(&mut open("empty")?, seconds)?;
    let mut empty = open("empty")?;
    let playing = open("playing")?;
    let fingers = SyntheticOptions { fingers: 10, ..SyntheticOptions::default() };
    let fingers = Synthetic::new(&FILM.outline, fingers)?;
    let grains = Texture { pitch: 2e-3, grain: 0.3, seed: 1, speed_gain: Curve::constant(1.0) };
    let set = one(Kind::Texture(grains), Level::Share(0.2));
    let mut engine = with_device(&set, sources(vec![Box::new(fingers)]), Box::new(playing));

    let (idle, priority) = beside(&mut engine, &mut empty, seconds)?;
    println!("audio thread: {priority}");
    let played = engine.heart().device().status();
    println!(
        "blocks of {BLOCK} samples, {:.3} ms, {seconds} s of the server's clock",
        1e3 * BLOCK as f64 / RATE
    );
    println!("{:<26}{:>10}{:>10}{:>10}{:>13}", "client", "blocks", "lost", "own late", "left out, ms");
    for (client, status) in [("empty, alone", &alone), ("empty, beside playing", &idle), ("playing", &played)]
    {
        let server = status.server.clone().unwrap_or_default();
        let skipped = 1e3 * server.skipped as f64 / RATE;
        let Status { blocks, lost, .. } = status;
        println!("{client:<26}{blocks:>10}{lost:>10}{:>10}{skipped:>13.1}", server.own_late);
    }
    let ms = engine.heart().work().four().unwrap_or_default().map(|s| format!("{:.4}", 1e3 * s));
    println!("processor time of a block, ms: p50 {}, p99 {}, p99.9 {}, worst {}", ms[0], ms[1], ms[2], ms[3]);
    latencies(engine.stage());
    Ok(())
}

/// Does nothing in each cycle.
struct Nothing(usize);

impl Work for Nothing {
    fn cycle(&mut self, cycle: &mut dyn Cycle) {
        (0..self.0).for_each(|output| cycle.drive(output).fill(0.0));
    }
}

/// How a client that does nothing fares while nobody plays.
fn alone(empty: &mut Jack, seconds: f64) -> Result<Status, Box<dyn std::error::Error>> {
    let (outputs, start) = (empty.layout().outputs.len(), Instant::now());
    empty.install_work(Box::new(Nothing(outputs))).map_err(|_| "a server does not call")?;
    while start.elapsed().as_secs_f64() < seconds {
        std::thread::sleep(empty.check()?);
    }
    empty.remove_work();
    Ok(empty.status())
}

/// Plays while another client does nothing; how that fared, and what came of the wish for priority.
fn beside(
    engine: &mut Engine,
    empty: &mut Jack,
    seconds: f64,
) -> Result<(Status, String), Box<dyn std::error::Error>> {
    let outputs = empty.layout().outputs.len();
    empty.install_work(Box::new(Nothing(outputs))).map_err(|_| "a server does not call")?;
    let mut priority = String::new();
    engine.run(Some(seconds), |_, play_state| {
        priority = play_state.priority.clone();
        true
    })?;
    empty.check()?;
    empty.remove_work();
    Ok((empty.status(), priority))
}

fn latencies(stage: &Stage) {
    let tally = stage.conductor().tally();
    for (what, times) in [
        ("touch to first sample", &tally.first_sample),
        ("a drive for a new place", stage.conductor().drives().making()),
        ("all touches of a moment", stage.computing()),
    ] {
        let ms = times.four().unwrap_or_default().map(|s| format!("{:.3}", 1e3 * s));
        println!("{what}, ms: p50 {}, p99 {}, p99.9 {}, worst {}", ms[0], ms[1], ms[2], ms[3]);
    }
    println!("{} drives made, {} pulses too late", stage.conductor().drives().making().count(), tally.stale);
}
