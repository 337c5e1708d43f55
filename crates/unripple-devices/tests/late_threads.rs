//! Threads that begin more than a second late, as on a machine with more work than processors: a client joins a JACK server all the same.
//!
//! Needs `jackd` and libjack (Debian: jackd2), and `rustc` to compile a library that delays threads. Without the former the test is skipped,
//! and fails in CI.
#![cfg(target_os = "linux")]

mod common;
#[path = "../../unripple-core/tests/shared/nowhere.rs"]
mod nowhere;
#[path = "../../unripple-core/tests/shared/skip.rs"]
mod skip;

use common::server::{NONE, Server};
use nowhere::Nowhere;
use skip::skip;
use std::process::Command;
use unripple_core::{Device, Layout};
use unripple_devices::Bridge;

/// Names the server that is to be joined by a program whose threads begin late.
const ROLE: &str = "UNRIPPLE_LATE_THREADS";
const PERIOD: usize = 256;

fn nowhere() -> Box<dyn Device> {
    let ports = vec!["one".to_owned()];
    let (outputs, inputs) = (ports.clone(), ports);
    let layout =
        Layout { device: "nowhere".into(), rate: 48e3, block: PERIOD, outputs, inputs, full_scale: 1.0 };
    Box::new(Nowhere(layout))
}

/// Does nothing by itself: the other test runs it in a process of its own.
#[test]
fn joiner() {
    let Ok(server) = std::env::var(ROLE) else { return };
    for time in 0..2 {
        let joined = Bridge::start(nowhere(), "late", Some(&server));
        println!("join {time}: {:?}", joined.as_ref().err());
        drop(joined.unwrap());
    }
}

#[test]
fn a_client_whose_threads_begin_late_joins_and_leaves() {
    let Some(server) = Server::start(PERIOD) else {
        return skip(NONE);
    };
    // The server answers from here on.
    drop(server.bridge("early", nowhere).unwrap());
    let folder = std::env::temp_dir().join(format!("unripple-late-threads-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let (source, shim) =
        (concat!(env!("CARGO_MANIFEST_DIR"), "/tests/late_threads/shim.rs"), folder.join("liblate.so"));
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let compiled = Command::new(rustc).args(["--edition", "2024", source, "-o"]).arg(&shim).status().unwrap();
    assert!(compiled.success());
    let run = Command::new(std::env::current_exe().unwrap())
        .args(["joiner", "--exact", "--nocapture"])
        .env(ROLE, &server.name)
        .env("LD_PRELOAD", &shim)
        .output()
        .unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    let said = [run.stdout, run.stderr].map(|text| String::from_utf8_lossy(&text).into_owned()).concat();
    assert!(run.status.success(), "{}: {said}", run.status);
}
