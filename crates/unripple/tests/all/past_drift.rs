//! Beyond time reversal when the surface is not quite the one the drive was made for, or known at points only.

use crate::bench;

use bench::*;
use unripple::core::{Contact, ModalResponses, Point, Responses};
use unripple::focus::{Focuser, Method, Options, Target};
use unripple::physics::design::papers_surface;
use unripple::physics::{ResponseOptions, responses, sample};

fn modal(responses: &Responses) -> &ModalResponses {
    match responses {
        Responses::Modal(modal) => modal,
        Responses::Sampled(_) => unreachable!("responses of a surface are modal"),
    }
}

/// The same plant, all its frequencies times a factor.
fn stretched(plant: &Responses, factor: f64) -> Responses {
    let mut modal = modal(plant).clone();
    modal.poles.iter_mut().for_each(|pole| pole.omega *= factor);
    Responses::Modal(modal)
}

#[test]
fn robust_bears_half_a_per_cent_of_stretch() {
    let bench = Bench::new();
    let plants: Vec<Responses> =
        (-4..=4).map(|step| stretched(&bench.plant, 1.0 + 0.005 * f64::from(step) / 4.0)).collect();
    let [reversal, concentrate, robust] = [Method::TimeReversal, Method::Concentrate, Method::Robust]
        .map(|method| bench.plan(method, Options::default()));
    let (mut ratios, mut shares, mut costs, mut plain) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for at in few(6) {
        let judge = |plan: &Focuser| {
            let drive = plan.focus(&[Target::at(at)]).unwrap().drive.as_emitted();
            let all: Vec<Focus> = plants.iter().map(|plant| on(plant, &drive, at, WINDOW)).collect();
            (all[4], all.iter().map(|focus| focus.contrast).fold(f64::INFINITY, f64::min))
        };
        let ((before, worst_before), (after, worst)) = (judge(&reversal), judge(&robust));
        ratios.push(worst / worst_before);
        shares.push(worst / after.contrast);
        costs.push(after.cost(&before));
        plain.push(judge(&concentrate).1 / worst_before);
    }
    let [ratio, share, cost, plain] = [&ratios, &shares, &costs, &plain].map(|values| spread(values));
    println!(
        "robust: worst {ratio:.2?} of time reversal's, {share:.2?} of nominal, energy {cost:.2?}; plain {plain:.2?}"
    );
    assert!(ratio[0] >= 3.5 && share[0] >= 0.8 && cost[0] <= 2.3);
}

/// Contrasts that look too good are those of the model: a tension that is off takes its share.
#[test]
fn what_a_wrong_tension_leaves() {
    let bench = Bench::new();
    let methods = [Method::TimeReversal, Method::Inverse, Method::Concentrate, Method::Robust];
    let plans = methods.map(|method| bench.plan(method, Options::default()));
    let mut means = Vec::new();
    for off in [0.0, 0.001, 0.003, 0.005] {
        let mut surface = papers_surface();
        surface.sheet.tension *= 1.0 + off;
        let plant = modes_to(&surface, 6000.0);
        let mean = |plan: &Focuser| {
            let each: Vec<f64> = few(4)
                .into_iter()
                .map(|at| on(&plant, &plan.focus(&[Target::at(at)]).unwrap().drive, at, WINDOW).contrast)
                .collect();
            spread(&each)[0]
        };
        let row: Vec<f64> = plans.iter().map(mean).collect();
        println!("tension off by {:.1} %: {row:.1?}", 100.0 * off);
        means.push(row);
    }
    assert!(means.iter().all(|row| row[3] > 3.0 * row[0] && row[2] > 2.0 * row[0]));
    assert!(means.windows(2).all(|pair| pair[1][2] < pair[0][2]));
}

#[test]
fn points_half_a_wavelength_apart_are_enough() {
    let bench = Bench::new();
    let known = modal(&bench.known);
    let pitch = known.conditions.lambda_min / 2.0;
    let count = (0.15 / pitch).floor() as usize;
    let place = |i: usize| 0.075 + (i as f64 - (count as f64 - 1.0) / 2.0) * pitch;
    let points: Vec<Point> =
        (0..count * count).map(|i| Point::new(place(i % count), place(i / count))).collect();
    let library = Responses::Sampled(sample(known, &points, 1441));
    let options = Options { window: WINDOW, method: Method::Concentrate, ..Options::default() };
    let (measured, modal) =
        (Focuser::new(&library, &options).unwrap(), Focuser::new(&bench.known, &options).unwrap());
    let mut shares = Vec::new();
    for near in few(10) {
        let at = *points.iter().min_by(|a, b| a.distance(near).total_cmp(&b.distance(near))).unwrap();
        shares.push(bench.judge(&measured, at).contrast / bench.judge(&modal, at).contrast);
    }
    let share = spread(&shares);
    println!("{} points, no modes: {share:.3?} of the modal contrast", points.len());
    assert!(share[0] >= 0.9);
}

#[test]
fn targets_keep_their_gains() {
    let bench = Bench::new();
    let places = [Point::from_mm(40.0, 50.0), Point::from_mm(62.0, 90.0), Point::from_mm(110.0, 60.0)];
    let gains = [1.0, -0.5, 0.25];
    for method in [Method::Inverse, Method::Concentrate, Method::Limited, Method::Robust] {
        let plan = bench.plan(method, Options::default());
        let asked: Vec<Target> =
            places.iter().zip(gains).map(|(at, gain)| Target::at(*at).with_gain(gain)).collect();
        let drive = plan.focus(&asked).unwrap().drive;
        let peaks = places.map(|at| on(&bench.known, &drive, at, WINDOW).peak);
        for (peak, gain) in peaks.iter().zip(gains) {
            assert!((peak / peaks[0] / gain - 1.0).abs() < 0.01, "{method}: {peaks:?}");
        }
    }
}

/// The drive that bears a finger that may or may not be there, and a tension that may be off by 1 %.
#[test]
fn robust_bears_fingers_and_tensions() {
    let surface = papers_surface();
    let at = Point::from_mm(62.0, 90.0);
    let under = |tension: f64, finger: bool| {
        let mut surface = surface.clone();
        surface.sheet.tension *= tension;
        let contacts = if finger { vec![Contact { at, finger: surface.finger }] } else { Vec::new() };
        responses(&surface, &ResponseOptions { contacts, ..Default::default() }).unwrap()
    };
    let known = under(1.0, false);
    let others = [under(1.0, true), under(0.99, false), under(1.01, false)];
    let options = |method| Options { method, window: WINDOW, spread: 0.0, ..Options::default() };
    let robust = Focuser::beside(&known, &others, &options(Method::Robust)).unwrap();
    let plans = [Method::TimeReversal, Method::Concentrate]
        .map(|method| Focuser::new(&known, &options(method)).unwrap());
    let worst = |plan: &Focuser| {
        let drive = plan.focus(&[Target::at(at)]).unwrap().drive.as_emitted();
        let all = [known.clone()].into_iter().chain(others.clone());
        let each: Vec<f64> = all.map(|plant| on(&plant, &drive, at, WINDOW).contrast).collect();
        println!("{each:.1?}");
        spread(&each)[1]
    };
    let [reversal, plain, robust] = [&plans[0], &plans[1], &robust].map(worst);
    println!("worst of four plants: time reversal {reversal:.1}, concentrate {plain:.1}, robust {robust:.1}");
    assert!(robust > 1.5 * plain && robust > 1.5 * reversal);
}

/// A drive made for the surface under a finger restores what the finger takes from the focus.
#[test]
fn a_finger_is_focused_through() {
    let surface = papers_surface();
    let at = Point::from_mm(62.0, 90.0);
    let contacts = vec![Contact { at, finger: surface.finger }];
    let under = responses(&surface, &ResponseOptions { contacts, ..Default::default() }).unwrap();
    let bare = responses(&surface, &ResponseOptions::default()).unwrap();
    let focus = |responses: &Responses, method| {
        let options = Options { method, window: WINDOW, ..Options::default() };
        let plan = Focuser::new(responses, &options).unwrap();
        on(&under, &plan.focus(&[Target::at(at)]).unwrap().drive.as_emitted(), at, WINDOW)
    };
    for method in [Method::TimeReversal, Method::Concentrate] {
        let [unaware, aware] = [&bare, &under].map(|responses| focus(responses, method));
        println!("{method} under a finger: unaware {unaware:.3?}, aware {aware:.3?}");
        assert!(aware.contrast > 1.2 * unaware.contrast);
    }
}
