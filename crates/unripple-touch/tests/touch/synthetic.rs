//! Fingers that are not there.

use crate::{Promise, sheet};
use unripple_core::{Hole, Outline, Phase, Point, Shape};
use unripple_touch::{Heard, Source, Synthetic, SyntheticOptions};

fn play(outline: &Outline, options: SyntheticOptions, seconds: f64) -> Heard {
    let mut fingers = Synthetic::new(outline, options).unwrap();
    let mut heard = Heard::default();
    for i in 0..(seconds * 200.0) as i32 {
        fingers.poll(f64::from(i) / 200.0, &mut heard);
    }
    assert_eq!(fingers.counts().touches, heard.touches.len() as u64);
    heard
}

#[test]
fn they_tap_and_slide_on_any_outline_with_margin() {
    let holed = sheet().with_hole(Hole::new(&Shape::Circle { radius: 0.02 }, Point::new(0.05, 0.03)));
    for outline in [sheet(), Outline::new(Shape::Circle { radius: 0.05 }), holed] {
        let options = SyntheticOptions { fingers: 10, margin: 0.008, ..SyntheticOptions::default() };
        let heard = play(&outline, options, 20.0);
        Promise::default().hold(&heard.touches, &outline);
        let rim = |p: Point| {
            let rims = std::iter::once(outline.rim(2000)).chain(outline.hole_rims(2000));
            rims.flatten().map(|q| q.distance(p)).fold(f64::MAX, f64::min)
        };
        // Eight places around at the margin are looked at: between two of them the rim may be nearer by 8 %.
        assert!(heard.touches.iter().step_by(7).all(|touch| rim(touch.at) > 0.0073));
        let count = |phase| heard.touches.iter().filter(|touch| touch.phase == phase).count();
        assert!(
            count(Phase::Down) > 50 && count(Phase::Move) > 1000,
            "{} {}",
            count(Phase::Down),
            count(Phase::Move)
        );
    }
}

#[test]
fn they_slide_within_the_speeds_asked_for() {
    let options = SyntheticOptions { fingers: 5, speed: (0.05, 0.1), ..SyntheticOptions::default() };
    let heard = play(&sheet(), options, 20.0);
    let (mut last, mut turned) = (std::collections::BTreeMap::new(), 0);
    for touch in &heard.touches {
        if let Some((time, at)) = last.insert(touch.finger, (touch.time, touch.at)) {
            let speed = touch.at.distance(at) / (touch.time - time);
            assert!(speed < 0.1 + 1e-9, "{speed}");
            turned += usize::from(speed > 0.0499);
        }
    }
    assert!(turned > 1000);
}

#[test]
fn a_seed_is_a_session() {
    let seed = |seed| play(&sheet(), SyntheticOptions { seed, ..SyntheticOptions::default() }, 5.0);
    assert_eq!(seed(1), seed(1));
    assert_ne!(seed(1), seed(2));
}

#[test]
fn a_clock_that_leaps_costs_bounded_work_a_poll() {
    let options = SyntheticOptions { fingers: 64, ..SyntheticOptions::default() };
    let mut fingers = Synthetic::new(&sheet(), options).unwrap();
    let mut heard = Heard::default();
    fingers.poll(0.0, &mut heard);
    fingers.poll(1e9, &mut heard);
    fingers.poll(f64::INFINITY, &mut heard);
    fingers.poll(f64::NAN, &mut heard);
    assert!(heard.touches.len() <= 3 * 256 * 64 + 64, "{}", heard.touches.len());
}

#[test]
fn options_that_cannot_be_are_refused() {
    let usual = SyntheticOptions::default();
    for wrong in [
        SyntheticOptions { fingers: 0, ..usual },
        SyntheticOptions { margin: f64::NAN, ..usual },
        SyntheticOptions { margin: 0.06, ..usual },
        SyntheticOptions { rate: 0.0, ..usual },
        SyntheticOptions { speed: (0.2, 0.1), ..usual },
    ] {
        assert!(Synthetic::new(&sheet(), wrong).is_err(), "{wrong:?}");
    }
}
