//! A library of JACK that keeps a lock while a client joins, as JACK 2 does for all programs of a user.
//!
//! The stand-in is C, compiled here: with the real one the same happens once in some hundred tries, and then no JACK program starts any
//! more. Needs `cc`, which Rust needs too.
#![cfg(target_os = "linux")]

mod common;

use common::Scratch;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Joins within `JOINS_MS`; the file `lock` is there meanwhile. There is no server.
const LIBRARY: &str = r#"
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>
void *jack_client_open(const char *name, int options, unsigned *status, ...) {
    close(open(getenv("LOCK"), O_CREAT | O_WRONLY, 0600));
    for (int ms = atoi(getenv("JOINS_MS")); ms > 0; ms--) usleep(1000);
    unlink(getenv("LOCK"));
    *status = 0x11;
    return NULL;
}
void jack_set_error_function(void (*f)(const char *)) {}
void jack_set_info_function(void (*f)(const char *)) {}
#define NEVER(name) int jack_##name(void) { abort(); }
NEVER(client_close) NEVER(activate) NEVER(get_sample_rate) NEVER(get_buffer_size) NEVER(get_client_name) NEVER(port_register)
NEVER(port_get_buffer) NEVER(set_process_callback) NEVER(set_xrun_callback) NEVER(set_freewheel_callback) NEVER(on_shutdown)
NEVER(set_freewheel) NEVER(is_realtime) NEVER(client_real_time_priority) NEVER(get_time) NEVER(last_frame_time)
NEVER(get_cycle_times) NEVER(port_get_latency_range) NEVER(connect) NEVER(get_ports) NEVER(free)
"#;

/// `devices` with that library, just when the lock is taken.
fn joining(scratch: &Scratch, joins_ms: u32) -> Child {
    let (source, library) = (scratch.file("jack.c", LIBRARY), scratch.join("libjack.so.0"));
    let built = Command::new("cc").args(["-shared", "-fPIC", "-o", &library, &source]).status();
    assert!(built.expect("cc").success());
    let lock = scratch.join("lock");
    let child = common::program()
        .arg("devices")
        .env("LD_LIBRARY_PATH", scratch.path())
        .env("LOCK", &lock)
        .env("JOINS_MS", joins_ms.to_string())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let began = Instant::now();
    while !Path::new(&lock).exists() {
        assert!(began.elapsed() < Duration::from_secs(60), "the library was never called");
        std::thread::sleep(Duration::from_millis(1));
    }
    child
}

#[test]
fn ctrl_c_does_not_leave_jack_locked() {
    let scratch = Scratch::new("lock");
    for signal in ["-INT", "-TERM"] {
        let mut child = joining(&scratch, 300);
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        // Ended by the signal, or by itself in the moment in which the call returned.
        child.wait().unwrap();
        assert!(
            !Path::new(&scratch.join("lock")).exists(),
            "{signal} came while JACK was locked, and left it so"
        );
    }
}

#[test]
fn a_call_that_is_late_is_not_cut_short() {
    // Longer than a program waits before it goes on without JACK, as on a machine where others take nearly all of the time.
    let scratch = Scratch::new("late");
    let output = joining(&scratch, 7_000).wait_with_output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    assert!(
        !Path::new(&scratch.join("lock")).exists(),
        "the program ended while JACK was locked, and left it so"
    );
}

#[test]
fn a_library_that_never_returns_is_not_waited_for() {
    let scratch = Scratch::new("never");
    let mut child = joining(&scratch, 3_600_000);
    let began = Instant::now();
    while child.try_wait().unwrap().is_none() && began.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(10));
    }
    // One that has ended cannot be ended.
    let _ = child.kill();
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("no answer within") && said.contains("remove /dev/shm/jack_db-"), "{said}");
}
