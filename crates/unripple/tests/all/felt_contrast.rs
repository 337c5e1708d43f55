//! How much less of the paper's surface is felt elsewhere than by time reversal.

use crate::bench;

use bench::few;
use std::sync::LazyLock;
use unripple::core::{Drive, Point, Responses};
use unripple::field::{Aim, Field};
use unripple::focus::{FeltOptions, FeltPlan, Focuser, Options, Target};
use unripple::physics::design::papers_surface;
use unripple::physics::{ResponseOptions, responses};

const WINDOW: f64 = 0.030;

/// What drives are made for: the modes of the band.
static KNOWN: LazyLock<Responses> =
    LazyLock::new(|| responses(&papers_surface(), &ResponseOptions::default()).unwrap());

/// What they are judged on: modes to twice the band.
static PLANT: LazyLock<Responses> = LazyLock::new(|| {
    let options = ResponseOptions { max_hz: Some(6000.0), ..ResponseOptions::default() };
    responses(&papers_surface(), &options).unwrap()
});

/// Felt background and worst spot, and drive rms for the same felt level, in dB.
fn figures(drive: &Drive, at: Point) -> [f64; 3] {
    let measured = Field::new(&PLANT, drive, 8.0).unwrap().measure(&[Aim::at(at, WINDOW)], None).unwrap();
    let figures = &measured.targets[0];
    let rms = 20.0 * drive.rms().log10() - figures.felt_level_db.unwrap();
    [figures.felt_background_db.unwrap(), figures.felt_worst_spot_db.unwrap(), rms]
}

/// For each target and each balance: background and worst spot over time reversal's, and drive over its drive.
fn gains(targets: &[Point], balances: &[FeltOptions]) -> Vec<Vec<[f64; 3]>> {
    let reversal = Focuser::new(&KNOWN, &Options { window: WINDOW, ..Options::default() }).unwrap();
    let plans: Vec<FeltPlan<'_>> = balances.iter().map(|own| FeltPlan::new(&KNOWN, own).unwrap()).collect();
    let gain = |at: &Point| {
        let target = [Target::at(*at)];
        let before = figures(&reversal.focus(&target).unwrap().drive, *at);
        let gain = |plan: &FeltPlan<'_>| {
            let after = figures(&plan.focus(&target).unwrap().drive, *at);
            [0, 1, 2].map(|i| after[i] - before[i])
        };
        let gains: Vec<[f64; 3]> = plans.iter().map(gain).collect();
        println!("{at}: {before:.2?} {gains:.2?}");
        gains
    };
    targets.iter().map(gain).collect()
}

fn thrifty() -> FeltOptions {
    FeltOptions { economy: 0.5, worst: 0.06, ..FeltOptions::default() }
}

/// Mean, least and greatest of a figure over targets.
fn over(gains: &[Vec<[f64; 3]>], balance: usize, figure: usize) -> [f64; 3] {
    let all = || gains.iter().map(|own| own[balance][figure]);
    let mean = all().sum::<f64>() / gains.len() as f64;
    let found = [mean, all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)];
    println!("balance {balance}, figure {figure}: mean, least, greatest {found:.2?}");
    found
}

#[test]
fn targets_are_felt_alone() {
    let gains = gains(&few(5), &[FeltOptions::default(), thrifty()]);
    let [background, worst, drive] = [0, 1, 2].map(|figure| over(&gains, 0, figure));
    let [less_background, less_worst, less_drive] = [0, 1, 2].map(|figure| over(&gains, 1, figure));
    assert!(background[0] >= 6.0 && background[1] >= 5.5, "{background:?}");
    assert!(worst[0] >= 5.0 && worst[1] >= 4.5, "{worst:?}");
    assert!(drive[2] <= 0.0, "{drive:?}");
    assert!(less_background[0] >= 4.0 && less_worst[0] >= 3.0, "{less_background:?} {less_worst:?}");
    assert!(less_drive[0] <= -6.0, "{less_drive:?}");
}
