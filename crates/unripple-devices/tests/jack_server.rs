//! A real JACK server with its dummy driver, freewheeling: nothing is lost between two clients, and latency stays.
//!
//! Needs `jackd` and libjack (Debian: jackd2). Without them the test is skipped, and fails in CI.

mod common;
#[path = "../../unripple-core/tests/shared/skip.rs"]
mod skip;

use common::server::Server;
use common::{noise, play};
use skip::skip;
use std::process::Command;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, mpsc};
use std::thread;
use std::time::{Duration, Instant};
use unripple_core::*;
use unripple_devices::*;

const PERIOD: usize = 256;

/// One server at a time: libjack keeps some of its state per program.
static ALONE: Mutex<()> = Mutex::new(());

/// A device that hears what it plays, in the same block.
struct Loop(Layout);

impl Device for Loop {
    fn layout(&self) -> &Layout {
        &self.0
    }

    fn status(&self) -> Status {
        Status::default()
    }

    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        self.0.fits(drive.len(), heard.len())?;
        heard.copy_from_slice(drive);
        Ok(())
    }
}

fn names(count: usize) -> Vec<String> {
    (0..count).map(|i| format!("c{i}")).collect()
}

/// Joins as soon as the server answers.
fn bridge(server: &Server) -> Result<Bridge, DevicesError> {
    let layout = Layout {
        device: "loop".into(),
        rate: 48e3,
        block: server.period,
        outputs: names(3),
        inputs: names(3),
        full_scale: 1.0,
    };
    server.bridge("loop", || Box::new(Loop(layout.clone())))
}

fn options(server: &Server, links: Links) -> JackOptions {
    let server = Some(server.name.clone());
    JackOptions { server, outputs: names(3), inputs: names(3), links, lead: 2, ..Default::default() }
}

/// Latency in samples, if everything sent comes back unchanged after it and nothing else does.
fn latency(device: &mut Jack) -> usize {
    let samples = 60 * PERIOD;
    let sent: Vec<Vec<f64>> = (0..3).map(|seed| noise(seed + 1, samples)).collect();
    let heard = play(device, samples + 20 * PERIOD, |o, i| sent[o].get(i).copied().unwrap_or(0.0));
    let first = f64::from(sent[0][0] as f32);
    let Some(late) = heard[0].iter().position(|x| *x == first) else {
        let came = heard[0].iter().position(|x| *x != 0.0);
        let of = came.and_then(|at| sent[0].iter().position(|x| f64::from(*x as f32) == heard[0][at]));
        panic!("the first that comes back, at {came:?}, is {of:?} of what was sent; {:?}", device.status());
    };
    for (sent, heard) in sent.iter().zip(&heard) {
        assert!(heard[..late].iter().all(|x| *x == 0.0));
        let same = sent.iter().zip(&heard[late..]).position(|(a, b)| f64::from(*a as f32) != *b);
        assert_eq!(same, None, "changed or lost");
    }
    late
}

#[test]
fn samples_pass_a_real_server_unchanged_and_latency_stays() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(mut server) = Server::start(PERIOD) else {
        return skip(common::server::NONE);
    };
    let bridge = bridge(&server).unwrap();
    let client = || options(&server, Links::Client(bridge.name()));
    let mut found = Vec::new();
    for _ in 0..3 {
        let mut device = Jack::open(&JackOptions { freewheel: true, ..client() }).unwrap();
        found.push(latency(&mut device));
        found.push(latency(&mut device));
        assert_eq!((device.status().lost, device.status().state), (0, State::Running));
    }
    println!("latency {found:?} samples at {PERIOD} a period, lead 2");
    assert!(found.iter().all(|late| *late == found[0]), "{found:?}");
    assert_eq!((bridge.faults(), found[0] % PERIOD), (0, 0));
    refusals(&server);
    let device = Jack::open(&client()).unwrap();
    lost(&mut server, device);
}

#[test]
fn blocks_of_any_length_pass_a_server_of_any_period() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    for period in [64, PERIOD, 1024] {
        let Some(server) = Server::start(period) else {
            return skip(common::server::NONE);
        };
        let bridge = bridge(&server).unwrap();
        let client = JackOptions { freewheel: true, ..options(&server, Links::Client(bridge.name())) };
        let mut behind = Vec::new();
        for block in [48, 64, PERIOD, 441, 1024] {
            let mut device = Jack::open(&JackOptions { block: Some(block), ..client.clone() }).unwrap();
            let waiting = device.status().waiting as usize;
            behind.extend([(); 2].map(|()| latency(&mut device) - waiting));
            assert!(waiting >= 2 * block.max(period), "{period} {block}: {waiting}");
            assert_eq!((device.layout().block, device.status().lost), (block, 0));
        }
        // What lies behind the ports takes as long whatever the blocks.
        assert!(behind.iter().all(|late| *late == behind[0]), "{period}: {behind:?}");
    }
}

/// No samples in a block, too few channels, and ports that there are not.
fn refusals(server: &Server) {
    let none = Jack::open(&JackOptions { block: Some(0), ..options(server, Links::None) }).unwrap_err();
    assert!(none.to_string().contains("samples of a block: expected 1 to 65536, found 0"), "{none}");
    let refused = |links| Jack::open(&options(server, links)).unwrap_err().to_string();
    let few = refused(Links::System);
    assert!(few.contains("expected at least 3 playback ports, found 2; start the server on"), "{few}");
    assert!(refused(Links::Client("nobody".into())).contains("there is no playback port `nobody:in_c0`"));
    let listed = list(Some(&server.name));
    let Some(Found::Jack(seen)) = listed.get(2) else { panic!("{listed:?}") };
    assert_eq!((seen.rate, seen.block), (48e3, PERIOD));
    assert!(seen.playback.contains(&"system:playback_2".to_owned()));
    assert!(seen.capture.contains(&"loop:out_c2".to_owned()));
}

/// A server that ends is a device that is lost, not one that hangs.
fn lost(server: &mut Server, mut device: Jack) {
    server.stop();
    let (drive, mut heard) = (vec![0.0; 3 * PERIOD], vec![0.0; 3 * PERIOD]);
    let error = (0..20).find_map(|_| device.exchange(&drive, &mut heard).err());
    assert!(matches!(error, Some(DeviceError::Lost { .. } | DeviceError::Stalled { .. })), "{error:?}");
    println!("after the server ended: {}", device.status().state);
}

#[test]
fn blocks_pass_after_the_period_has_changed() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(server) = Server::start(PERIOD) else {
        return skip(common::server::NONE);
    };
    // The server is there once a bridge is.
    drop(bridge(&server).unwrap());
    let mut device = Jack::open(&options(&server, Links::None)).unwrap();
    let (drive, mut heard) = (vec![0.0; 3 * PERIOD], vec![0.0; 3 * PERIOD]);
    for period in [256usize, 1024, 256, 441, 64] {
        let changed = Command::new("jack_bufsize")
            .env("JACK_DEFAULT_SERVER", &server.name)
            .arg(period.to_string())
            .output()
            .expect("jack_bufsize");
        assert!(changed.status.success(), "{changed:?}");
        (0..40).for_each(|_| device.exchange(&drive, &mut heard).unwrap());
        let status = device.status();
        assert_eq!((status.state, status.server.map(|server| server.period)), (State::Running, Some(period)));
    }
    // A measurement under way must know that what it hears is later from now on.
    assert!(device.status().lost > 0);
}

#[test]
fn a_server_that_stands_still_is_left_and_joined_again() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(server) = Server::start(PERIOD) else {
        return skip(common::server::NONE);
    };
    // The server is there once a bridge is.
    drop(bridge(&server).unwrap());
    for freewheel in [false, true] {
        let options = JackOptions { patience: 0.5, freewheel, ..options(&server, Links::None) };
        let mut device = Jack::open(&options).unwrap();
        let (drive, mut heard) = (vec![0.0; 3 * PERIOD], vec![0.0; 3 * PERIOD]);
        (0..10).for_each(|_| device.exchange(&drive, &mut heard).unwrap());
        server.stand_still(true);
        let (left, ended) = mpsc::channel();
        let left = thread::scope(|scope| {
            scope.spawn(move || {
                let stalled = (0..20).find_map(|_| device.exchange(&drive, &mut heard).err());
                drop(device);
                // One client is on its way out yet.
                let refused = Jack::open(&options).unwrap_err().to_string();
                left.send((stalled, refused))
            });
            let left = ended.recv_timeout(Duration::from_secs(60));
            server.stand_still(false);
            left
        });
        let (stalled, refused) = left.expect("a client cannot leave a server that stands still");
        assert!(matches!(stalled, Some(DeviceError::Stalled { .. })), "{stalled:?}");
        assert!(refused.contains("does not respond"), "{refused}");
        drop(bridge(&server).unwrap());
    }
}

#[test]
fn a_server_that_stands_still_is_not_waited_for_by_who_would_join() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(server) = Server::start(PERIOD) else {
        return skip(common::server::NONE);
    };
    // The server is there once a bridge is.
    drop(bridge(&server).unwrap());
    server.stand_still(true);
    let (tell, told) = mpsc::channel();
    let options = options(&server, Links::None);
    let wanted = options.clone();
    let joins = thread::spawn(move || tell.send(Jack::open(&wanted).map(drop)));
    let joined = told.recv_timeout(Duration::from_secs(60));
    server.stand_still(false);
    joins.join().unwrap().unwrap();
    let refused = joined.expect("no word from a server that stands still").unwrap_err().to_string();
    assert!(refused.contains("no answer within"), "{refused}");
    // Whoever was too late left again, and the way is free.
    let start = Instant::now();
    while let Err(error) = Jack::open(&options) {
        assert!(start.elapsed() < Duration::from_secs(20), "{error}");
    }
}

/// Sleeps for three cycles in every tenth, or does nothing; counts when it slept, and when the cycle's time was over at its end.
struct Sleepy {
    cycles: u64,
    sleeps: Option<Arc<AtomicU64>>,
    over: Arc<AtomicU64>,
}

impl Work for Sleepy {
    fn cycle(&mut self, cycle: &mut dyn Cycle) {
        let lasts = Duration::from_secs_f64(cycle.frames() as f64 / 48e3);
        self.cycles += 1;
        if let Some(sleeps) = self.sleeps.as_ref().filter(|_| self.cycles.is_multiple_of(10)) {
            thread::sleep(3 * lasts);
            sleeps.fetch_add(1, Ordering::Relaxed);
        }
        self.over.fetch_add(u64::from(cycle.began().elapsed() > lasts), Ordering::Relaxed);
    }
}

#[test]
fn who_was_late_is_told_from_who_heard_of_it() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(server) = Server::start(PERIOD) else {
        return skip(common::server::NONE);
    };
    // The server is there once a bridge is.
    drop(bridge(&server).unwrap());
    let (sleeps, over) = (Arc::new(AtomicU64::new(0)), Arc::new(AtomicU64::new(0)));
    let mut devices = [Some(sleeps.clone()), None].map(|sleeps| {
        let mut device = Jack::open(&options(&server, Links::None)).unwrap();
        // What the idle one sees is what is wanted last.
        let over = if sleeps.is_some() { Arc::default() } else { over.clone() };
        assert!(device.install_work(Box::new(Sleepy { cycles: 0, sleeps, over })).is_ok());
        device
    });
    let start = Instant::now();
    while sleeps.load(Ordering::Relaxed) < 40 && start.elapsed() < Duration::from_secs(60) {
        thread::sleep(Duration::from_millis(20));
    }
    let [slow, idle] = devices.each_mut().map(|device| {
        device.remove_work();
        device.status().server.unwrap()
    });
    let (slept, over) = (sleeps.load(Ordering::Relaxed), over.load(Ordering::Relaxed));
    println!("{slept} cycles slept through: {slow:?}, beside it {idle:?}, who saw {over} of its own");
    assert!(slept >= 40 && slow.own_late >= slept, "{slow:?} of {slept}");
    // On a busy machine it is late as well, and sees that; what it only hears of is the other's. The device counts by when the server expects
    // the next cycle, a filtered estimate that after late cycles is nearer than a whole period: then it is late where by the period it
    // was not, as often at most.
    assert!(idle.own_late <= 2 * over + slept / 2, "{idle:?}, beside {slow:?}, of {over}");
}

/// Falls in its fifth cycle.
struct Falling(u32);

impl Work for Falling {
    fn cycle(&mut self, _: &mut dyn Cycle) {
        self.0 += 1;
        assert!(self.0 < 5, "on purpose");
    }
}

#[test]
fn a_client_that_the_server_calls_no_more_is_lost() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(server) = Server::start(PERIOD) else {
        return skip(common::server::NONE);
    };
    // The server is there once a bridge is.
    drop(bridge(&server).unwrap());
    let mut device = Jack::open(&JackOptions { patience: 0.5, ..options(&server, Links::None) }).unwrap();
    assert!(device.install_work(Box::new(Falling(0))).is_ok());
    let start = Instant::now();
    let lost = loop {
        match device.check() {
            Ok(wait) if start.elapsed() < Duration::from_secs(20) => thread::sleep(wait),
            other => break other,
        }
    };
    assert!(matches!(&lost, Err(DeviceError::Lost { why, .. }) if why.contains("goes on")), "{lost:?}");
    assert!(device.remove_work().is_some());
}

/// Takes longer over its third cycle than a client takes to leave.
struct Slow {
    cycles: u32,
    begun: mpsc::Sender<()>,
    /// Counts those that are over.
    over: Arc<AtomicU64>,
}

impl Work for Slow {
    fn cycle(&mut self, _: &mut dyn Cycle) {
        self.cycles += 1;
        if self.cycles == 3 {
            // Whoever asks is there until the device is gone.
            let _ = self.begun.send(());
            thread::sleep(Duration::from_millis(300));
            self.over.fetch_add(1, Ordering::Relaxed);
        }
    }
}

/// JACK cancels the thread of a client that leaves: in the middle of our code, that ended the whole program.
#[test]
fn a_client_that_leaves_within_a_cycle_ends_the_cycle_first() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(server) = Server::start(PERIOD) else {
        return skip(common::server::NONE);
    };
    drop(bridge(&server).unwrap());
    for _ in 0..3 {
        let over = Arc::new(AtomicU64::new(0));
        let mut device = Jack::open(&options(&server, Links::None)).unwrap();
        let (begun, begins) = mpsc::channel();
        assert!(device.install_work(Box::new(Slow { cycles: 0, begun, over: over.clone() })).is_ok());
        begins.recv_timeout(Duration::from_secs(20)).unwrap();
        drop(device);
        assert_eq!(over.load(Ordering::Relaxed), 1);
    }
}

/// JACK 2 deletes all clients of a program when one joins after a server was gone; who leaves with one of them later crashes.
#[test]
fn nobody_joins_before_the_clients_of_a_server_that_is_gone_have_left() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(mut server) = Server::start(PERIOD) else {
        return skip(common::server::NONE);
    };
    let first = bridge(&server).unwrap();
    let device = Jack::open(&options(&server, Links::Client("loop".into()))).unwrap();
    server.stop();
    let start = Instant::now();
    while !matches!(device.status().state, State::Lost(_)) {
        assert!(start.elapsed() < Duration::from_secs(20), "{:?}", device.status());
        thread::sleep(Duration::from_millis(1));
    }
    drop(first);
    let again = Server::named(&server.name, PERIOD).unwrap();
    let refused = loop {
        let layout = Layout { block: PERIOD, ..device.layout().clone() };
        match Bridge::start(Box::new(Loop(layout)), "loop", Some(&again.name)) {
            Err(why) if why.to_string().contains("answers") && start.elapsed() < Duration::from_secs(20) => {
                thread::sleep(Duration::from_millis(50));
            }
            other => break other.map(drop).unwrap_err().to_string(),
        }
    };
    assert!(refused.contains("has not been closed"), "{refused}");
    drop(device);

    let _loop = bridge(&again).unwrap();
    // Freewheeling: in real time, a busy machine may lose a block, which is not what is asked here.
    let open = JackOptions { freewheel: true, ..options(&again, Links::Client("loop".into())) };
    latency(&mut Jack::open(&open).unwrap());
}

#[test]
fn no_server_is_an_error_that_says_what_to_do() {
    let options = JackOptions { server: Some("unripple-none".into()), ..Default::default() };
    let error = Jack::open(&options).unwrap_err().to_string();
    assert!(error.contains("start one") || error.contains("install it"), "{error}");
}
