//! The same measurement through a real JACK server, whose ports lead to the virtual surface as another client.
//!
//! Needs `jackd` and libjack (Debian: jackd2). Without them the test is skipped, and fails in CI.

mod measured_bench;
#[path = "../../unripple-devices/tests/common/server.rs"]
mod server;
#[path = "../../unripple-core/tests/shared/skip.rs"]
mod skip;

use measured_bench::*;
use server::Server;
use skip::skip;
use std::cell::RefCell;
use unripple_calibrate::measure::{Listen, MeasureOptions};
use unripple_core::{Device, PROBE, Point};
use unripple_devices::{Jack, JackOptions, Links, VirtualOptions};

const AT: Point = Point { x: 0.062, y: 0.090 };
const PERIOD: usize = 256;

#[test]
fn a_jack_server_changes_nothing() {
    let Some(server) = Server::start(PERIOD) else {
        return skip(server::NONE);
    };
    let options = VirtualOptions { block: PERIOD, ..VirtualOptions::default() };
    let direct = WORLD.device_with(&options);
    let reach = RefCell::new(None);
    let surface = || {
        let device = WORLD.device_with(&options);
        reach.replace(Some(device.handle()));
        Box::new(device) as Box<dyn Device>
    };
    let bridge = server.bridge("surface", surface).unwrap();
    let handle = reach.take().unwrap();
    let names: Vec<String> = WORLD.surface.actuators.iter().map(|actuator| actuator.name.clone()).collect();
    let joined = JackOptions {
        server: Some(server.name.clone()),
        inputs: names.iter().cloned().chain([PROBE.to_owned()]).collect(),
        outputs: names,
        links: Links::Client("surface".into()),
        full_scale: WORLD.surface.emission.limit,
        freewheel: true,
        ..JackOptions::default()
    };
    let jack = Jack::open(&joined).unwrap();
    assert_eq!(jack.layout().block, PERIOD);

    let mut rig = Hands::new(jack, handle);
    let first = WORLD.session(&rig.device, &MeasureOptions::default());
    let [late, _] = first.find_latency(&mut rig, 0, AT, &WORLD.model).unwrap().unwrap();
    // A server delays by whole periods.
    let periods = (late / PERIOD as f64).round();
    println!("latency {late:.3} samples, {periods} periods");
    assert!(periods >= 1.0 && (late - periods * PERIOD as f64).abs() < 0.1);

    let options = MeasureOptions { latency: late, ..MeasureOptions::default() };
    let session = WORLD.session(&rig.device, &options);
    // A recording with a gap is an error; what a server does while nobody records is its own affair.
    let through = session.measure(&mut rig, 0, AT, 0, Listen::Probe).unwrap();
    let handle = direct.handle();
    let session = WORLD.session(&direct, &MeasureOptions::default());
    let plain = session.measure(&mut Hands::new(direct, handle), 0, AT, 0, Listen::Probe).unwrap();
    let [a, b] = [&through, &plain].map(|found| WORLD.share(&WORLD.sampled(&[AT], found), AT));
    println!("contrast: {a:.4} of the true one through the server, {b:.4} directly");
    assert!((a / b - 1.0).abs() < 0.02);
    drop(rig);
    drop(bridge);
}
