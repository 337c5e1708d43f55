//! Sittings of `unripple play` and `unripple view` at a real JACK server while faults come at random: after each of them all is well again.
//!
//! Well is: whoever comes is served and told of the surface, a touch sounds at the ports, its end is silence, and the program holds no more
//! memory, files and threads than before. A client of the server listens. Half a minute with one fault of each kind; `UNRIPPLE_MINUTES` says
//! how long both sittings last together instead, `UNRIPPLE_AT_MOST_S` after how many seconds it is enough all the same, `UNRIPPLE_SEED` what
//! comes when. Needs `jackd` and libjack (Debian: jackd2). Without them the tests are skipped, and fail in CI.
#![cfg(target_os = "linux")]

#[path = "../common/mod.rs"]
mod common;
mod datagrams;
mod ear;
mod faults;
mod hand;
mod link;
mod program;
#[path = "../../../unripple-devices/tests/common/server.rs"]
mod server;
mod sitting;
#[path = "../../../unripple-core/tests/shared/skip.rs"]
mod skip;
mod tally;

use program::Task;
use server::Server;
use sitting::{PERIOD, Sitting};
use skip::skip;
use std::sync::Mutex;

/// One server at a time: libjack keeps some of its state per program.
static ALONE: Mutex<()> = Mutex::new(());

/// A number of the environment, if it is set.
fn number(name: &str) -> Option<f64> {
    std::env::var(name).ok().map(|text| text.parse().unwrap())
}

fn sit(task: Task) {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(server) = Server::start(PERIOD) else {
        return skip(server::NONE);
    };
    // Each of the two sittings has half of the time.
    let most = number("UNRIPPLE_AT_MOST_S").unwrap_or(f64::INFINITY) / 2.0;
    let seconds = number("UNRIPPLE_MINUTES").map(|minutes| (30.0 * minutes).min(most));
    let seed = number("UNRIPPLE_SEED").unwrap_or(1.0) as u64;
    println!("{task:?}: seed {seed}");
    let mut sitting = Sitting::begin(task, server, seed);
    sitting.go_on(seconds);
    sitting.end();
}

#[test]
fn play_is_well_again_after_each_fault() {
    sit(Task::Play);
}

#[test]
fn view_is_well_again_after_each_fault() {
    sit(Task::View);
}
