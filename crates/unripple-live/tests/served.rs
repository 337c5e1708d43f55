//! A film that is played through a real JACK server, and what that costs the machine: a period that changes is followed, priorities
//! stay below the server's, and nobody wakes without a reason.
//!
//! Needs `jackd` and libjack (Debian: jackd2). Without them the tests are skipped, and fail in CI.

mod common;
#[path = "../../unripple-devices/tests/common/server.rs"]
mod server;
#[path = "../../unripple-core/tests/shared/skip.rs"]
mod skip;

use common::*;
use server::Server;
use skip::skip;
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::time::{Duration, Instant};
use unripple_core::{Device, DeviceError};
use unripple_devices::{DevicesError, Jack, JackOptions, Links};
use unripple_effects::{Curve, Kind, Level, Texture};
use unripple_live::{Engine, Recovering};
use unripple_touch::{Source, Synthetic, SyntheticOptions};

/// One server at a time: libjack keeps some of its state per program.
static ALONE: Mutex<()> = Mutex::new(());

/// How long to wait for what must happen, however slow the machine.
const DEADLINE: Duration = Duration::from_secs(60);

fn names() -> Vec<String> {
    FILM.actuators.iter().map(|actuator| actuator.name.clone()).collect()
}

/// As soon as the server answers.
fn join(options: &JackOptions) -> Jack {
    let start = Instant::now();
    loop {
        match Jack::open(options) {
            Err(DevicesError::Jack { .. }) if start.elapsed() < DEADLINE => {
                std::thread::sleep(Duration::from_millis(50));
            }
            other => return other.unwrap(),
        }
    }
}

/// The film with so many fingers on it, through a server.
fn engine(server: &Server, fingers: usize) -> Engine {
    let known = JackOptions {
        server: Some(server.name.clone()),
        outputs: names(),
        links: Links::None,
        lead: 2,
        ..JackOptions::default()
    };
    let open = move || Ok(Box::new(join(&known)) as Box<dyn Device>);
    let device = Recovering::open(Box::new(open), 1000).unwrap();
    let options = SyntheticOptions { fingers, ..SyntheticOptions::default() };
    let fingers: Vec<Box<dyn Source>> = match fingers {
        0 => Vec::new(),
        _ => vec![Box::new(Synthetic::new(&FILM.outline, options).unwrap())],
    };
    let grains = Texture { pitch: 2e-3, grain: 0.3, seed: 1, speed_gain: Curve::constant(1.0) };
    with_device(&one(Kind::Texture(grains), Level::Share(0.2)), sources(fingers), Box::new(device))
}

/// Plays until a script is through, which runs beside it.
fn beside<T: Send>(mut engine: Engine, script: impl FnOnce(&AtomicBool) -> T + Send) -> T {
    let (playing, over) = (AtomicBool::new(false), AtomicBool::new(false));
    std::thread::scope(|scope| {
        let script = scope.spawn(|| {
            let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| script(&playing)));
            over.store(true, Relaxed);
            result
        });
        let played = engine.run(None, |_, _| {
            playing.store(true, Relaxed);
            !over.load(Relaxed)
        });
        let result = script.join().unwrap();
        played.unwrap();
        result.unwrap_or_else(|fell| std::panic::resume_unwind(fell))
    })
}

fn until(what: &AtomicBool) {
    let start = Instant::now();
    while !what.load(Relaxed) && start.elapsed() < DEADLINE {
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(what.load(Relaxed), "nothing plays");
}

/// Listens to the film's ports as another client until something sounds there.
fn sounds(server: &Server) -> bool {
    let ports = names().iter().map(|name| format!("unripple:out_{name}")).collect();
    let mut watch = join(&JackOptions {
        client: "watch".into(),
        server: Some(server.name.clone()),
        inputs: names(),
        links: Links::Ports { playback: Vec::new(), capture: ports },
        ..JackOptions::default()
    });
    let mut heard = vec![0.0; names().len() * watch.layout().block];
    let start = Instant::now();
    while start.elapsed() < DEADLINE / 2 {
        match watch.exchange(&[], &mut heard) {
            Ok(()) if heard.iter().any(|x| x.abs() > 1e-3) => return true,
            Ok(()) | Err(DeviceError::Stalled { .. }) => {}
            Err(error) => panic!("{error}"),
        }
    }
    false
}

#[test]
fn a_changed_period_is_followed() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(server) = Server::start(256) else {
        return skip(server::NONE);
    };
    beside(engine(&server, 10), |playing| {
        until(playing);
        assert!(sounds(&server), "silent before any change");
        for period in ["1024", "256", "64", "441", "2048"] {
            let changed = Command::new("jack_bufsize")
                .env("JACK_DEFAULT_SERVER", &server.name)
                .arg(period)
                .output()
                .expect("jack_bufsize");
            assert!(changed.status.success(), "{changed:?}");
            assert!(sounds(&server), "silent after the period became {period}");
        }
    });
}

/// A thread: its number, name and real-time priority, 0 without one.
type Thread = (String, String, u32);

/// Those of this program.
fn threads() -> Vec<Thread> {
    let tasks = std::fs::read_dir("/proc/self/task").unwrap();
    let stats = tasks.filter_map(|task| std::fs::read_to_string(task.ok()?.path().join("stat")).ok());
    let read = |stat: String| {
        let (number, rest) = stat.split_once(" (")?;
        let (name, rest) = rest.rsplit_once(')')?;
        // The 40th field, of which the third is the first after the name.
        let priority = rest.split_whitespace().nth(37)?.parse().ok()?;
        Some((number.to_owned(), name.to_owned(), priority))
    };
    stats.filter_map(read).collect()
}

/// The number of this thread, as in [`threads`].
fn own() -> String {
    let path = std::fs::read_link("/proc/thread-self").unwrap();
    path.file_name().unwrap().to_string_lossy().into_owned()
}

#[test]
fn no_thread_stands_above_the_servers_and_those_that_touches_wait_for_have_a_priority() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    if let Err(refused) = unripple_live::real_time() {
        return skip(&refused);
    }
    let name = format!("unripple-priority-{}", std::process::id());
    let Some(server) = Server::real_time(&name, 256) else {
        return skip(server::NONE);
    };
    let caller = own();
    let named = |found: &[Thread], wanted: &str| -> Vec<u32> {
        let called = found.iter().filter(|(number, name, _)| number == wanted || name == wanted);
        called.map(|(_, _, priority)| *priority).collect()
    };
    let waited_for = ["touch", "focus", &caller];
    let found = beside(engine(&server, 2), |playing| {
        until(playing);
        let start = Instant::now();
        loop {
            let found = threads();
            let have = waited_for.iter().all(|thread| named(&found, thread).iter().any(|own| *own > 0));
            if have || start.elapsed() > DEADLINE / 4 {
                return found;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    });
    println!("{found:?}");
    // JACK runs its clients' callbacks five below its own thread, which has 10.
    const CALLBACK: u32 = 5;
    for thread in waited_for {
        let has = named(&found, thread).iter().any(|own| (1..CALLBACK).contains(own));
        assert!(has, "`{thread}` has no priority below the callback's {CALLBACK}: {found:?}");
    }
    let high: Vec<u32> = found.iter().map(|(_, _, own)| *own).filter(|own| *own >= CALLBACK).collect();
    assert_eq!(high, [CALLBACK], "the callback alone has {CALLBACK}, and nobody more: {found:?}");
}

/// Times that threads of this program went to sleep by themselves.
fn naps() -> u64 {
    let tasks = std::fs::read_dir("/proc/self/task").unwrap();
    let stats = tasks.filter_map(|task| std::fs::read_to_string(task.ok()?.path().join("status")).ok());
    let naps = |status: String| -> Option<u64> {
        let line = status.lines().find(|line| line.starts_with("voluntary_ctxt_switches"))?;
        line.split_whitespace().nth(1)?.parse().ok()
    };
    stats.filter_map(naps).sum()
}

#[test]
fn nobody_wakes_without_a_reason() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(server) = Server::start(256) else {
        return skip(server::NONE);
    };
    let (naps, seconds) = beside(engine(&server, 0), |playing| {
        until(playing);
        let (before, start) = (naps(), Instant::now());
        std::thread::sleep(Duration::from_secs(2));
        (naps() - before, start.elapsed().as_secs_f64())
    });
    // One for each cycle of the server at most, and some looks a second at how all fares.
    let cycles = seconds * RATE / 256.0;
    println!("{naps} naps in {seconds:.1} s, {cycles:.0} cycles");
    assert!(naps as f64 <= 1.5 * cycles + 60.0 * seconds, "{naps} naps in {seconds:.1} s");
}

#[test]
fn a_server_that_stands_still_does_not_hold_up_the_end() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(server) = Server::start(256) else {
        return skip(server::NONE);
    };
    let engine = engine(&server, 2);
    let (over, ended) = std::sync::mpsc::channel();
    let ended = std::thread::scope(|scope| {
        scope.spawn(|| {
            beside(engine, |playing| {
                until(playing);
                server.stand_still(true);
            });
            over.send(()).unwrap();
        });
        let ended = ended.recv_timeout(DEADLINE).is_ok();
        server.stand_still(false);
        ended
    });
    // Whoever is on the way out has left before the server ends: where both happen at once, JACK 2 breaks its database for good.
    drop(join(&JackOptions {
        server: Some(server.name.clone()),
        outputs: names(),
        links: Links::None,
        ..JackOptions::default()
    }));
    assert!(ended, "the end of a play waits for a server that stands still");
}
