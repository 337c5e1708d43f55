//! Beyond time reversal on the paper's surface: contrast, energy and peak of every method, on a plant with modes to
//! twice the band.

use crate::bench;

use bench::*;
use unripple::core::Point;
use unripple::field::{Aim, Field};
use unripple::focus::{Focuser, Method, Options, Target};
use unripple::physics::design::papers_surface;
use unripple_paper::study::Random;

/// `√(M/e)`, e = J0² + J1² at the disc's radius: the contrast of a band-limited delta.
const DELTA: f64 = 63.4;

#[test]
fn inverse_reaches_the_band_limited_delta() {
    let bench = Bench::new();
    let [reversal, inverse] =
        [Method::TimeReversal, Method::Inverse].map(|method| bench.plan(method, Options::default()));
    let (mut contrasts, mut ratios, mut costs) = (Vec::new(), Vec::new(), Vec::new());
    for at in few(8) {
        let (before, after) = (bench.judge(&reversal, at), bench.judge(&inverse, at));
        contrasts.push(after.contrast);
        ratios.push(after.contrast / before.contrast);
        costs.push(after.cost(&before));
    }
    let [contrast, ratio, cost] = [&contrasts, &ratios, &costs].map(|values| spread(values));
    println!("inverse: contrast {contrast:.2?}, ratio {ratio:.2?}, energy {cost:.2?}");
    assert!(contrast[0] >= 0.95 * DELTA && ratio[0] >= 2.3 && cost[2] <= 2.0);
}

#[test]
fn concentrate_has_four_and_a_half_times_the_contrast() {
    let bench = Bench::new();
    let [reversal, concentrate] =
        [Method::TimeReversal, Method::Concentrate].map(|method| bench.plan(method, Options::default()));
    let (mut ratios, mut costs, mut widths) = (Vec::new(), Vec::new(), Vec::new());
    for (i, at) in few(8).into_iter().enumerate() {
        let (before, after) = (bench.judge(&reversal, at), bench.judge(&concentrate, at));
        ratios.push(after.contrast / before.contrast);
        costs.push(after.cost(&before));
        if i < few(5).len() {
            let width = |plan| bench.figures(plan, at).targets[0].spot_diameter_m.unwrap();
            widths.push(width(&concentrate) / width(&reversal));
        }
    }
    let [ratio, cost, width] = [&ratios, &costs, &widths].map(|values| spread(values));
    println!("concentrate: ratio {ratio:.2?}, energy {cost:.2?}, spot {width:.3?}");
    assert!(ratio[0] >= 4.5 && ratio[1] >= 3.5 && cost[2] <= 1.7 && width[2] <= 1.12);
}

#[test]
fn concentrate_does_so_wherever_the_actuators_are() {
    let mut random = Random::seeded(7);
    let (mut ratios, mut costs) = (Vec::new(), Vec::new());
    for _ in 0..few(8).len() {
        let mut surface = papers_surface();
        for actuator in &mut surface.actuators {
            actuator.at.x = random.between(0.008, 0.142);
            actuator.at.y = random.between(0.008, 0.142);
        }
        let bench = Bench::of(&surface);
        let at = targets(1)[0];
        let [before, after] = [Method::TimeReversal, Method::Concentrate]
            .map(|method| bench.judge(&bench.plan(method, Options::default()), at));
        ratios.push(after.contrast / before.contrast);
        costs.push(after.cost(&before));
    }
    let [ratio, cost] = [&ratios, &costs].map(|values| spread(values));
    println!("concentrate over placements: ratio {ratio:.2?}, energy {cost:.2?}");
    assert!(ratio[0] >= 4.5 && ratio[1] >= 3.5 && cost[0] <= 1.7);
}

#[test]
fn limited_reaches_twice_the_peak_with_three_times_the_contrast() {
    let bench = Bench::new();
    let reversal = bench.plan(Method::TimeReversal, Options::default());
    let hard = bench.plan(Method::OneBit, Options::default());
    for (push, peak, contrast) in [(0.55, 2.0, 3.0), (0.77, 2.5, 2.0)] {
        let limited = bench.plan(Method::Limited, Options { push, ..Options::default() });
        let (mut peaks, mut ratios, mut shares) = (Vec::new(), Vec::new(), Vec::new());
        for at in few(8) {
            let [before, most, after] = [&reversal, &hard, &limited].map(|plan| bench.judge(plan, at));
            peaks.push(after.peak / before.peak);
            ratios.push(after.contrast / before.contrast);
            shares.push(after.peak / most.peak);
        }
        let [peaks, ratios, shares] = [&peaks, &ratios, &shares].map(|values| spread(values));
        println!("limited, push {push}: peak {peaks:.2?} ({shares:.2?} of one-bit), contrast {ratios:.2?}");
        assert!(peaks[1] >= peak && ratios[1] >= contrast);
    }
}

#[test]
fn repetition_at_the_decay_time() {
    let bench = Bench::new();
    let plan = |method| bench.plan(method, Options { strength: Some(0.948), ..Options::default() });
    let (comb, periodic) = (plan(Method::TimeReversal), plan(Method::Concentrate));
    let (mut ratios, mut costs) = (Vec::new(), Vec::new());
    for at in few(5) {
        let judge = |plan: &Focuser| {
            let focused = plan.focus(&[Target::at(at).repeated(1.0 / 0.070)]).unwrap();
            let drive = focused.drive.as_emitted();
            let instant = focused.timing[0].instant as f64 / drive.rate();
            Focus { energy: drive.energy() / drive.duration(), ..on(&bench.plant, &drive, at, instant) }
        };
        let (before, after) = (judge(&comb), judge(&periodic));
        ratios.push(after.contrast / before.contrast);
        costs.push(after.cost(&before));
    }
    let [ratio, cost] = [&ratios, &costs].map(|values| spread(values));
    println!("repeated every 70 ms: ratio {ratio:.2?}, energy {cost:.2?}");
    assert!(ratio[0] >= 4.0 && cost[0] <= 1.0);
}

/// A focus, its background contrast and worst spot, and contrast, background and worst spot as felt, in dB.
fn told(bench: &Bench, plan: &Focuser, at: Point) -> (Focus, [f64; 5]) {
    let focused = plan.focus(&[Target::at(at)]).unwrap();
    let drive = focused.drive.as_emitted();
    let instant = focused.timing[0].instant as f64 / drive.rate();
    let field = Field::new(&bench.plant, &drive, 8.0).unwrap();
    let measured = field.measure(&[Aim::at(at, instant)], None).unwrap();
    let figures = &measured.targets[0];
    let (peak, contrast) = (figures.peak_velocity_m_s, figures.contrast.unwrap());
    let more = [
        figures.background_contrast,
        figures.worst_spot,
        figures.felt_contrast_db,
        figures.felt_background_db,
        figures.felt_worst_spot_db,
    ];
    (Focus { peak, contrast, energy: measured.drive.energy }, more.map(Option::unwrap))
}

/// The rows of the table of methods in docs/methods.md: means over targets.
#[test]
fn every_method_by_every_figure() {
    let bench = Bench::new();
    let pushed = |push| Options { push, ..Options::default() };
    let mut plans = Vec::from(Method::ALL.map(|method| (method.name(), bench.plan(method, pushed(0.55)))));
    plans.push(("limited, push 0.75", bench.plan(Method::Limited, pushed(0.75))));
    let places = few(1);
    let all: Vec<Vec<(Focus, [f64; 5])>> =
        plans.iter().map(|(_, plan)| places.iter().map(|at| told(&bench, plan, *at)).collect()).collect();
    let mut rows = Vec::new();
    for ((name, _), own) in plans.iter().zip(&all) {
        let mean = |figure: &dyn Fn(usize) -> f64| {
            let each: Vec<f64> = (0..places.len()).map(figure).collect();
            spread(&each)[0]
        };
        let reversal = |i: usize| &all[0][i].0;
        let [background, worst, felt_contrast, felt_background, felt_worst] =
            [0, 1, 2, 3, 4].map(|k| mean(&|i| own[i].1[k]));
        let contrast = mean(&|i| own[i].0.contrast);
        let energy = mean(&|i| own[i].0.cost(reversal(i)));
        let peak = mean(&|i| (own[i].0.peak / reversal(i).peak).abs());
        println!(
            "{name}: contrast {contrast:.1}, background {background:.1}, worst spot {worst:.2}, energy {energy:.2}, peak {peak:.2}; felt \
             contrast {felt_contrast:.1} dB, background {felt_background:.1} dB, worst spot {felt_worst:.1} dB"
        );
        rows.push([contrast, peak, felt_background, felt_worst]);
    }
    let [reversal, hard, _, concentrate, _, _, felt, _] = rows[..] else { panic!("{} methods", rows.len()) };
    assert!(concentrate[0] >= 3.5 * reversal[0] && hard[1] >= 2.0);
    assert!(felt[2] >= reversal[2] + 4.0 && felt[3] >= reversal[3] + 3.0);
}
