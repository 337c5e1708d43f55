//! A film that is played through a real JACK server with its dummy driver: freewheeling, nothing is lost; killed and started again,
//! it is found again, and with another period it gets blocks as before.
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
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use unripple_core::{Device, DeviceError, Layout, State, Status};
use unripple_devices::{Jack, JackOptions, Links};
use unripple_effects::{Curve, Kind, Level, Texture};
use unripple_live::Recovering;
use unripple_touch::{Source, Synthetic, SyntheticOptions};

const PERIOD: usize = 256;

/// One server at a time: libjack keeps some of its state per program.
static ALONE: Mutex<()> = Mutex::new(());

/// What stands at the other side: keeps the largest sample of late, and all of them if asked.
#[derive(Clone, Default)]
struct Ear {
    peak: Arc<AtomicU32>,
    blocks: Arc<AtomicU64>,
}

struct Listening(Ear, Layout);

impl Device for Listening {
    fn layout(&self) -> &Layout {
        &self.1
    }

    fn status(&self) -> Status {
        Status::default()
    }

    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        let peak = drive.iter().fold(0.0f32, |m, x| m.max(x.abs()));
        self.0.peak.fetch_max(peak.to_bits(), Relaxed);
        self.0.blocks.fetch_add(1, Relaxed);
        heard.fill(0.0);
        Ok(())
    }
}

fn names() -> Vec<String> {
    FILM.actuators.iter().map(|actuator| actuator.name.clone()).collect()
}

fn listening(ear: &Ear, block: usize) -> Box<dyn Device> {
    let layout = Layout {
        device: "ear".into(),
        rate: RATE,
        block,
        outputs: names(),
        inputs: names(),
        full_scale: 1.0,
    };
    Box::new(Listening(ear.clone(), layout))
}

fn options(server: &str, freewheel: bool) -> JackOptions {
    JackOptions {
        server: Some(server.to_owned()),
        outputs: names(),
        inputs: names(),
        links: Links::Client("ear".into()),
        lead: 2,
        freewheel,
        // A server without a clock waits for the slowest of a busy machine.
        patience: if freewheel { 30.0 } else { 3.0 },
        ..JackOptions::default()
    }
}

fn fingers(count: usize) -> Vec<Box<dyn Source>> {
    let options = SyntheticOptions { fingers: count, ..SyntheticOptions::default() };
    vec![Box::new(Synthetic::new(&FILM.outline, options).unwrap())]
}

fn grains() -> Kind {
    Kind::Texture(Texture { pitch: 2e-3, grain: 0.3, seed: 1, speed_gain: Curve::constant(1.0) })
}

#[test]
fn freewheeling_nothing_is_lost() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(server) = Server::start(PERIOD) else {
        return skip(server::NONE);
    };
    let ear = Ear::default();
    let bridge = server.bridge("ear", || listening(&ear, PERIOD)).unwrap();
    let device = Jack::open(&options(&server.name, true)).unwrap();
    let mut engine = with_device(&one(grains(), Level::Share(0.2)), sources(fingers(10)), Box::new(device));
    let began = ear.blocks.load(Relaxed);
    // Eight seconds of played time; `UNRIPPLE_MINUTES` says how many minutes instead.
    let seconds = std::env::var("UNRIPPLE_MINUTES").map_or(8.0, |m| 60.0 * m.parse::<f64>().unwrap());
    while engine.stage().time() < seconds {
        engine.step().unwrap();
    }
    let status = engine.heart().device().status();
    println!("{} blocks, {} lost, {} heard", status.blocks, status.lost, ear.blocks.load(Relaxed) - began);
    assert_eq!((status.state, status.lost), (State::Running, 0));
    assert!(f32::from_bits(ear.peak.load(Relaxed)) > 0.01);
    let worst = engine.stage().conductor().tally().first_sample.worst().unwrap();
    assert!(worst <= PERIOD as f64 / RATE + 1e-9, "{worst}");
    drop(engine);
    drop(bridge);
}

#[test]
fn a_server_that_was_killed_is_found_again() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let Some(server) = Server::start(PERIOD) else {
        return skip(server::NONE);
    };
    let name = server.name.clone();
    let ear = Ear::default();
    let bridge = server.bridge("ear", || listening(&ear, PERIOD)).unwrap();
    let known = options(&name, false);
    let open = move || {
        let opened = Jack::open(&known).map(|device| Box::new(device) as Box<dyn Device>);
        opened.map_err(|error| error.to_string())
    };
    let device = Recovering::open(Box::new(open), 1000).unwrap();
    let mut engine = with_device(&one(grains(), Level::Share(0.2)), sources(fingers(10)), Box::new(device));

    let (mut server, mut bridge) = (Some(server), Some(bridge));
    let (mut before, mut away) = (0.0, false);
    let start = Instant::now();
    engine
        .run(None, |stage, play_state| {
            let peak = f32::from_bits(ear.peak.load(Relaxed));
            if server.is_some() && before == 0.0 && peak > 0.0 && stage.time() > 1.0 {
                // Killed while it plays.
                before = peak;
                server = None;
                bridge = None;
            } else if server.is_none() && play_state.state != State::Running {
                away = true;
                server = Server::named(&name, PERIOD);
                bridge = Some(server.as_ref().unwrap().bridge("ear", || listening(&ear, PERIOD)).unwrap());
                ear.peak.store(0, Relaxed);
            } else if away && peak > 0.0 {
                return false;
            }
            start.elapsed() < Duration::from_secs(60)
        })
        .unwrap();
    let after = f32::from_bits(ear.peak.load(Relaxed));
    println!("peak {before} before, {after} after, back within {:.1?}", start.elapsed());
    assert!(away && before > 0.01 && after > 0.01);
    assert_eq!(engine.heart().device().status().state, State::Running);
}

/// A device that opens again in the blocks that it had at first.
fn in_same_blocks(server: &str) -> Recovering {
    let mut known = options(server, false);
    let open = move || -> Result<Box<dyn Device>, String> {
        let device = Jack::open(&known).map_err(|error| error.to_string())?;
        known.block = Some(device.layout().block);
        Ok(Box::new(device))
    };
    Recovering::open(Box::new(open), 1000).unwrap()
}

/// Exchanges blocks until a device is as wanted.
fn pass(device: &mut Recovering, wanted: impl Fn(&Recovering) -> bool) {
    let samples = names().len() * device.layout().block;
    let (drive, mut heard, start) = (vec![0.5; samples], vec![0.0; samples], Instant::now());
    while !wanted(device) {
        assert!(start.elapsed() < Duration::from_secs(60), "{:?}", device.status());
        device.exchange(&drive, &mut heard).unwrap();
    }
}

#[test]
fn a_server_that_comes_back_with_another_period_gets_the_same_blocks() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let name = format!("unripple-periods-{}", std::process::id());
    let (ear, mut device) = (Ear::default(), None);
    for (returns, period) in (0..).zip([PERIOD, 1024, 64, PERIOD]) {
        let Some(server) = Server::named(&name, period) else {
            return skip(server::NONE);
        };
        let bridge = server.bridge("ear", || listening(&ear, period)).unwrap();
        let device = device.get_or_insert_with(|| in_same_blocks(&name));
        pass(device, |_| f32::from_bits(ear.peak.load(Relaxed)) == 0.5);
        let status = device.status();
        assert_eq!((device.returns(), device.layout().block), (returns, PERIOD));
        assert_eq!((status.state, status.server.map(|server| server.period)), (State::Running, Some(period)));
        // Two periods of drive wait, or two blocks: as few as before once the old period is back.
        assert_eq!(status.waiting as usize, 2 * period.max(PERIOD));
        drop(server);
        drop(bridge);
        // Until the device is let go of: nobody joins a server before all clients of the one that is gone have left.
        pass(device, |device| matches!(device.status().state, State::Stalled(_)));
        ear.peak.store(0, Relaxed);
    }
}
