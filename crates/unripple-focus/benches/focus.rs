//! How long it takes to make a drive: `cargo bench -p unripple-focus`.

#[path = "../tests/common/mod.rs"]
mod common;

use common::Membrane;
use std::hint::black_box;
use std::time::Instant;
use unripple_core::Point;
use unripple_focus::{Focuser, Options, Pattern, Target, focus};

fn best(what: &str, repeats: usize, mut work: impl FnMut()) {
    let time = |_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64() * 1e6
    };
    let mut times: Vec<f64> = (0..repeats).map(time).collect();
    times.sort_by(f64::total_cmp);
    println!("{what:<56} best {:9.1} µs, median {:9.1} µs of {repeats}", times[0], times[repeats / 2]);
}

fn main() {
    let ports = [(12, 31), (9, 84), (40, 140), (95, 137), (141, 106), (138, 44), (103, 11), (50, 9)];
    let membrane = Membrane {
        width: 0.15,
        height: 0.15,
        decay_time: 70e-3,
        top_hz: 2400.0,
        rate: 48e3,
        ports: ports.map(|(x, y)| Point::from_mm(f64::from(x), f64::from(y))).to_vec(),
        ..Membrane::small()
    };
    let responses = membrane.responses();
    println!("{} modes, 8 actuators, 30 ms at 48 kHz", membrane.modal().poles.len());
    let target = [Target::at(Point::from_mm(62.0, 90.0))];
    let options = Options::default();
    let planned = Focuser::new(&responses, &options).expect("legal options");
    best("a drive for one new point, planned", 300, || {
        black_box(planned.focus(&target).is_ok());
    });
    best("the plan and a drive", 30, || {
        black_box(focus(&responses, &target, &options).is_ok());
    });
    let lambda = responses.conditions().lambda_min;
    let disc = Pattern::circle(Point::from_mm(70.0, 80.0), 0.03).filled().sample(Pattern::pitch(lambda));
    let disc = Target::of(disc.expect("legal pattern"));
    best(&format!("a filled disc of {} points, planned", disc.points.len()), 30, || {
        black_box(planned.focus(std::slice::from_ref(&disc)).is_ok());
    });
}
