//! How long it takes to judge a drive on the paper's film: `cargo bench -p unripple-field`.

#[path = "../tests/common/mod.rs"]
mod common;

use std::time::Instant;
use unripple_core::Point;
use unripple_field::{Aim, Field, MeasureOptions, measure};

fn best(what: &str, repeats: usize, mut work: impl FnMut()) {
    let time = |_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64() * 1e3
    };
    let mut times: Vec<f64> = (0..repeats).map(time).collect();
    times.sort_by(f64::total_cmp);
    println!("{what:<46} best {:8.2} ms, median {:8.2} ms of {repeats}", times[0], times[repeats / 2]);
}

fn main() {
    let film = common::Film::paper();
    let responses = film.responses();
    let modal = film.modal();
    let at = Point::from_mm(62.0, 90.0);
    let drive = common::reversed(&modal, at, 1440);
    let aim = Aim::at(at, 0.030);
    let found =
        measure(&responses, &drive, std::slice::from_ref(&aim), &MeasureOptions::default()).expect("legal");
    println!("{} modes, {} outside points", modal.poles.len(), found.outside_points);
    println!("{:#?}", found.targets[0]);
    best("measure: all figures, one target, 30 ms", 9, || {
        let _ = measure(&responses, &drive, std::slice::from_ref(&aim), &MeasureOptions::default());
    });
    best("measure: on 1 cell per wavelength", 9, || {
        let _ = measure(
            &responses,
            &drive,
            std::slice::from_ref(&aim),
            &MeasureOptions { cells: 1.0, ..Default::default() },
        );
    });
    let field = Field::new(&responses, &drive, 8.0).expect("legal");
    best("traces at 5 points over 60 ms", 9, || {
        let _ = field.traces(&[at; 5], 0.060);
    });
    let instants: Vec<f64> = (0..60).map(|i| f64::from(i) * 1e-3).collect();
    best("60 snapshots", 9, || {
        let _ = field.snapshots(&instants);
    });
}
