//! Each effect against what it should do by hand calculation.

use crate::common;

use Phase::{Down, Move, Up};
use common::{effect, effects, heard, played, pulses, set, sheet, texture, touch};
use std::f64::consts::{FRAC_PI_2, TAU};
use unripple_core::{Phase, Point, Touch};
use unripple_effects::{
    Act, Anchor, Button, Cue, Curve, Edge, Effects, Envelope, Event, Hum, Kind, Level, Line, Notch, Region,
    Score, Sound, Start, Tone, Trace, Traced, Train,
};

/// A finger that goes along x at some speed in mm/s, told of every `step` s.
fn slide(speed: f64, step: f64, steps: usize) -> Vec<Touch> {
    let mut list = vec![touch(Down, 10.0, 50.0, 0.0)];
    list.extend((1..=steps).map(|i| touch(Move, 10.0 + speed * step * i as f64, 50.0, step * i as f64)));
    list
}

#[test]
fn a_button_clicks_twice() {
    let mut button = effect(Kind::Button(Button { press_force: None, release: 0.25 }));
    button.region = Region::Circle { centre: Point::from_mm(50.0, 50.0), radius: 0.01 };
    let cues = played(button.clone(), &[touch(Down, 55.0, 50.0, 1.0), touch(Up, 55.0, 50.0, 1.2)]);
    assert_eq!(pulses(&cues), [(1.0, 55.0, 50.0, 1.0), (1.2, 55.0, 50.0, 0.25)]);
    assert_eq!(cues[0].voice, cues[1].voice);
    // Beside it nothing, slid into it nothing, slid out of it the second click.
    assert!(played(button.clone(), &[touch(Down, 61.0, 50.0, 0.0), touch(Move, 50.0, 50.0, 0.1)]).is_empty());
    let out = played(
        button,
        &[touch(Down, 50.0, 50.0, 0.0), touch(Move, 70.0, 50.0, 0.1), touch(Up, 70.0, 50.0, 0.2)],
    );
    assert_eq!(pulses(&out).len(), 2);
}

#[test]
fn a_button_with_a_force_is_pressed_by_it() {
    let button = effect(Kind::Button(Button { press_force: Some(2.0), release: 1.0 }));
    let forces = [0.5, 1.9, 2.0, 3.0, 1.5, 1.39, 1.9, 2.1];
    let press = |(i, force): (usize, &f64)| Touch {
        force: Some(*force),
        ..touch(if i == 0 { Down } else { Move }, 50.0, 50.0, i as f64)
    };
    let cues = played(button.clone(), &forces.iter().enumerate().map(press).collect::<Vec<_>>());
    // Let go below 1.4 N, pressed again at 2.1 N.
    assert_eq!(pulses(&cues).iter().map(|p| p.0).collect::<Vec<_>>(), [2.0, 5.0, 7.0]);
    assert!(played(button, &[touch(Down, 50.0, 50.0, 0.0), touch(Up, 50.0, 50.0, 1.0)]).is_empty());
}

#[test]
fn texture_follows_the_speed() {
    for (speed, step) in [(50.0, 0.01), (100.0, 0.016), (20.0, 0.005)] {
        let cues = played(effect(Kind::Texture(texture(1.5e-3, 0.0))), &slide(speed, step, 80));
        let found = pulses(&cues);
        let length = speed * step * 80.0;
        assert_eq!(found.len(), ((length + 1e-9) / 1.5) as usize, "{speed}");
        // Each grain lies where it should, within rounding, at the time when the finger is there.
        for (i, (at, x, y, gain)) in found.iter().enumerate() {
            let distance = 1.5 * (i + 1) as f64;
            assert!((x - 10.0 - distance).abs() < 1e-6 && *y == 50.0 && *gain == 1.0);
            assert!((at - distance / speed).abs() < 1e-9, "{i} {at}");
        }
    }
}

#[test]
fn texture_goes_on_between_touches() {
    let (mut effects, mut cues) = (effects(effect(Kind::Texture(texture(1e-3, 0.0)))), Vec::new());
    slide(100.0, 0.01, 2).iter().for_each(|touch| effects.touch(touch, &mut cues));
    let before = pulses(&cues).len();
    effects.tick(0.035, &mut cues);
    let ahead = pulses(&cues);
    assert_eq!((before, ahead.len()), (2, 3));
    assert!((ahead[2].0 - 0.03).abs() < 1e-12 && (ahead[2].1 - 13.0).abs() < 1e-9);
    // It was not there: the finger went back. Nothing comes twice, and after 50 ms nothing is guessed.
    effects.tick(10.0, &mut cues);
    assert_eq!(pulses(&cues).len(), 7);
}

#[test]
fn grain_keeps_the_mean() {
    let cues = played(effect(Kind::Texture(texture(0.5e-3, 0.8))), &slide(60.0, 0.008, 350));
    let found = pulses(&cues);
    let mean = (found[found.len() - 1].1 - found[0].1) / (found.len() - 1) as f64;
    // 0.5 mm ± 0.4 mm evenly: a standard error of 0.23 mm / sqrt(336).
    assert!((mean - 0.5).abs() < 4.0 * 0.0126, "{mean}");
    assert!(found.iter().all(|p| (0.2..=1.0).contains(&p.3)));
    let gains: f64 = found.iter().map(|p| p.3).sum::<f64>() / found.len() as f64;
    assert!((gains - 0.6).abs() < 0.06, "{gains}");
}

#[test]
fn an_edge_is_felt_where_it_is_crossed() {
    let mut square = effect(Kind::Edge(Edge { line: None }));
    square.region = Region::Rectangle { corner: Point::from_mm(50.0, 40.0), width: 0.02, height: 0.02 };
    // Through it in one step of 80 mm in 0.1 s: in at 50 mm, out at 70 mm.
    let through = [touch(Down, 20.0, 50.0, 0.0), touch(Move, 100.0, 50.0, 0.1)];
    let found = pulses(&played(square.clone(), &through));
    assert_eq!(found.len(), 2);
    assert!((found[0].0 - 0.0375).abs() < 1e-12 && (found[0].1 - 50.0).abs() < 1e-9);
    assert!((found[1].0 - 0.0625).abs() < 1e-12 && (found[1].1 - 70.0).abs() < 1e-9);
    // A finger that trembles on the rim feels it once.
    let tremble: Vec<Touch> = (0..50)
        .map(|i| {
            touch(
                if i == 0 { Down } else { Move },
                50.0 + 0.3 * (f64::from(i) * 2.0).sin(),
                50.0,
                f64::from(i),
            )
        })
        .collect();
    assert_eq!(pulses(&played(square, &tremble)).len(), 1);

    let line = Line { from: Point::from_mm(30.0, 0.0), to: Point::from_mm(30.0, 60.0) };
    let line = effect(Kind::Edge(Edge { line: Some(line) }));
    assert_eq!(pulses(&played(line.clone(), &through)).len(), 1);
    let above = [touch(Down, 20.0, 70.0, 0.0), touch(Move, 100.0, 70.0, 0.1)];
    assert!(played(line, &above).is_empty());
}

#[test]
fn a_disc_and_a_polygon_are_crossed_alike() {
    // A polygon of 720 corners on the circle; ways that miss its sagitta.
    let (centre, radius) = (Point::from_mm(100.0, 50.0), 0.02);
    let disc = Region::Circle { centre, radius };
    let corner = |i: i32| TAU * f64::from(i) / 720.0;
    let corners =
        (0..720).map(|i| Point::new(0.1 + radius * corner(i).cos(), 0.05 + radius * corner(i).sin()));
    let polygon = Region::Polygon(corners.collect());
    for i in 0..40 {
        let y = 31.3 + f64::from(i);
        let (from, to) = (Point::from_mm(60.0, y), Point::from_mm(140.0, y + 1.7));
        let (a, b) = (disc.crossings(from, to), polygon.crossings(from, to));
        assert_eq!(a.len(), b.len(), "{y}");
        assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-3), "{a:?} {b:?}");
    }
}

#[test]
fn notches_lie_on_the_axis() {
    let notch = Notch { pitch: 5e-3, axis: FRAC_PI_2, origin: Point::default(), hysteresis: 0.1 };
    let mut way = vec![touch(Down, 50.0, 20.0, 0.0)];
    way.extend((1..=60).map(|i| touch(Move, 50.0, 20.0 + f64::from(i) * 0.5, f64::from(i) * 0.01)));
    let found = pulses(&played(effect(Kind::Notch(notch)), &way));
    // From the detent at 20 mm up to 50 mm: that at 50 begins at 48 mm, midway and a tenth of a pitch.
    let expected: Vec<f64> = (0..6).map(|i| 23.0 + 5.0 * f64::from(i)).collect();
    assert_eq!(found.len(), expected.len());
    for ((_, _, y, _), expected) in found.iter().zip(&expected) {
        assert!((y - expected).abs() < 1e-9, "{y} {expected}");
    }
    // Trembling by 0.4 mm midway, within the hysteresis: at most the one pulse.
    let tremble: Vec<Touch> = (0..50)
        .map(|i| {
            touch(if i == 0 { Down } else { Move }, 50.0, 22.5 + 0.4 * f64::from(i % 2 * 2 - 1), f64::from(i))
        })
        .collect();
    assert!(pulses(&played(effect(Kind::Notch(notch)), &tremble)).len() <= 1);
}

fn train() -> Train {
    Train { rate: 20.0, count: None, envelope: None, jitter: 0.0, scatter: 0.0, seed: 1 }
}

#[test]
fn a_steady_train_is_a_comb_that_follows() {
    let way = [touch(Down, 50.0, 50.0, 0.0), touch(Move, 60.0, 50.0, 0.1), touch(Up, 60.0, 50.0, 0.2)];
    let acts: Vec<Act> = played(effect(Kind::Train(train())), &way).into_iter().map(|cue| cue.act).collect();
    let comb = Act::Comb { place: Point::from_mm(50.0, 50.0), rate: 20.0, gain: Level::Share(1.0) };
    assert_eq!(acts, [comb, Act::Move { place: Point::from_mm(60.0, 50.0) }, Act::Stop { fade: 0.0 }]);
}

#[test]
fn a_counted_train_is_drawn_by_its_envelope() {
    let envelope = Curve::new("time", vec![(0.0, 1.0), (0.2, 0.0)], [0.0, 1.0], [0.0, 1.0]).unwrap();
    let counted = Train { count: Some(3), envelope: Some(envelope), ..train() };
    let (mut effects, mut cues) = (effects(effect(Kind::Train(counted))), Vec::new());
    effects.touch(&touch(Down, 50.0, 50.0, 2.0), &mut cues);
    for i in 0..40 {
        effects.tick(2.0 + 0.013 * f64::from(i), &mut cues);
    }
    let found = pulses(&cues);
    assert_eq!(found.len(), 3);
    for (i, (at, _, _, gain)) in found.iter().enumerate() {
        assert!((at - 2.0 - 0.05 * i as f64).abs() < 1e-12 && (gain - 1.0 + 0.25 * i as f64).abs() < 1e-12);
    }
}

#[test]
fn drops_scatter_evenly() {
    let rain = Train { rate: 200.0, jitter: 0.5, scatter: 0.01, ..train() };
    let (mut effects, mut cues) = (effects(effect(Kind::Train(rain))), Vec::new());
    effects.touch(&touch(Down, 100.0, 50.0, 0.0), &mut cues);
    (0..200).for_each(|i| effects.tick(f64::from(i) * 0.05, &mut cues));
    let found = pulses(&cues);
    let radii = found.iter().map(|p| (p.1 - 100.0).hypot(p.2 - 50.0));
    assert!(radii.clone().all(|r| r <= 10.0 + 1e-9));
    // Half of a disc lies within 1/sqrt 2 of its radius.
    let inner = radii.filter(|r| *r < 10.0 * 0.5_f64.sqrt()).count() as f64 / found.len() as f64;
    assert!((inner - 0.5).abs() < 0.05 && found.len() > 1900, "{inner} {}", found.len());
    assert!(found.windows(2).all(|pair| pair[0].0 <= pair[1].0 && pair[1].0 - pair[0].0 <= 0.0075 + 1e-9));
}

#[test]
fn a_triangle_is_drawn_at_its_speed() {
    let path = vec![Point::default(), Point::new(0.03, 0.0), Point::new(0.0, 0.04)];
    let shape =
        Traced { path, closed: true, anchor: Anchor::Finger, trace: Trace::Moving(0.12), rate: 100.0 };
    let (mut effects, mut cues) = (effects(effect(Kind::Shape(shape.clone()))), Vec::new());
    effects.touch(&touch(Down, 100.0, 20.0, 0.0), &mut cues);
    effects.tick(0.2, &mut cues);
    let found = pulses(&cues);
    assert_eq!(found.len(), 21);
    // 1.2 mm apart along 3 + 5 + 4: the corners at 30 mm after 25 pulses, so here all lie on the first side.
    assert!(
        found.iter().enumerate().all(|(i, p)| (p.1 - 100.0 - 1.2 * i as f64).abs() < 1e-9 && p.2 == 20.0)
    );
    (1..=5).for_each(|i| effects.tick(0.2 + 0.2 * f64::from(i), &mut cues));
    let found = pulses(&cues);
    // 120 mm a second once round in a second; half way along the second side after 55 mm, at (15, 20).
    let (_, x, y, _) = found[100];
    assert!((x - 100.0).abs() < 1e-6 && (y - 20.0).abs() < 1e-6, "{x} {y}");
    let nearest = found.iter().map(|p| (p.1 - 115.0).hypot(p.2 - 40.0)).fold(f64::MAX, f64::min);
    assert!(nearest < 0.6, "{nearest}");

    // All at once, 6 + 10 + 8 points; two of them would lie off the sheet.
    let at_once = Traced { trace: Trace::AtOnce(0.005), ..shape };
    let cues = played(effect(Kind::Shape(at_once)), &[touch(Down, 100.0, 65.0, 0.0)]);
    let Act::Shape { points, .. } = &cues[0].act else { panic!("{cues:?}") };
    let off = |p: &Point| p.y <= 0.1 + 1e-12;
    assert!(points.iter().all(off) && (21..24).contains(&points.len()), "{}", points.len());
}

#[test]
fn a_hum_grows_with_the_speed_and_rests() {
    let gain = Curve::new("speed", vec![(0.0, 0.0), (0.1, 1.0)], [0.0, 1.0], [0.0, 1.0]).unwrap();
    let hum = Hum { tone: Tone::Sine(120.0), speed_gain: gain, fade: 0.05 };
    let (mut effects, mut cues) = (effects(effect(Kind::Hum(hum))), Vec::new());
    slide(50.0, 0.01, 30).iter().for_each(|touch| effects.touch(touch, &mut cues));
    effects.tick(0.5, &mut cues);
    effects.touch(&touch(Up, 25.0, 50.0, 0.6), &mut cues);
    let Act::Wave { wave, looped: true, gain: Level::Share(0.0), .. } = &cues[0].act else {
        panic!("{cues:?}")
    };
    assert_eq!(wave.rate, common::RATE);
    let gains: Vec<(f64, Level)> = cues
        .iter()
        .filter_map(|cue| match cue.act {
            Act::Gain { gain } => Some((cue.at, gain)),
            _ => None,
        })
        .collect();
    let [(_, Level::Share(moving)), (rest, Level::Share(0.0))] = gains[..] else { panic!("{gains:?}") };
    assert!((moving - 0.5).abs() < 1e-6 && (rest - 0.35).abs() < 1e-9);
    assert_eq!(cues[cues.len() - 1], Cue { voice: cues[0].voice, at: 0.6, act: Act::Stop { fade: 0.05 } });
}

fn event(at: f64, place: Option<Point>, sound: Sound) -> Event {
    Event { at, gain: 0.5, place, sound }
}

#[test]
fn scores_start_by_touch_at_zero_and_by_name() {
    let drum = Sound::Wave(Envelope::new(vec![(0.0, 1.0), (0.5, 0.0)], vec![(0.0, 60.0)]).unwrap());
    let corner = Some(Point::from_mm(150.0, 80.0));
    let events =
        vec![event(0.3, None, drum), event(0.0, None, Sound::Pulse), event(0.1, corner, Sound::Pulse)];
    let score = |start, period| effect(Kind::Score(Score { start, period, events: events.clone() }));

    let (mut touched, mut cues) = (effects(score(Start::Touch, None)), Vec::new());
    touched.touch(&touch(Down, 50.0, 50.0, 1.0), &mut cues);
    (1..=50).for_each(|i| touched.tick(1.0 + 0.01 * f64::from(i), &mut cues));
    touched.touch(&touch(Up, 50.0, 50.0, 1.5), &mut cues);
    assert_eq!(pulses(&cues), [(1.0, 50.0, 50.0, 0.5), (1.1, 150.0, 80.0, 0.5)]);
    let wave = cues.iter().find(|cue| matches!(cue.act, Act::Wave { .. })).unwrap();
    let stop =
        cues.iter().find(|cue| cue.voice == wave.voice && matches!(cue.act, Act::Stop { .. })).unwrap();
    assert_eq!((wave.at, stop.at), (1.3, 1.5));

    let (mut zero, mut cues) = (effects(score(Start::Zero, Some(0.4))), Vec::new());
    (0..=100).for_each(|i| zero.tick(5.0 + 0.01 * f64::from(i), &mut cues));
    let times: Vec<f64> = pulses(&cues).iter().map(|p| p.0).collect();
    let expected = [5.0, 5.1, 5.4, 5.5, 5.8, 5.9];
    assert!(times.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9) && times.len() == 6, "{times:?}");
    assert_eq!(pulses(&cues)[0].1, 100.0);

    let (mut named, mut cues) = (effects(score(Start::Name, Some(0.4))), Vec::new());
    named.tick(0.0, &mut cues);
    assert!(cues.is_empty());
    assert!(named.start("that", 0.0, None).unwrap_err().to_string().contains("one of it, found `that`"));
    named.start("it", 0.5, corner).unwrap();
    named.tick(0.55, &mut cues);
    assert_eq!(pulses(&cues), [(0.5, 150.0, 80.0, 0.5)]);
    named.stop("it", 0.55, &mut cues).unwrap();
    let heard = heard(&cues).len();
    named.tick(9.0, &mut cues);
    assert_eq!(cues.len(), heard);
}

#[test]
fn sets_are_checked() {
    fn moves_to_another_thread<T: Send + 'static>() {}
    moves_to_another_thread::<Effects>();
    let bad = [
        effect(Kind::Button(Button { press_force: Some(0.0), release: 0.5 })),
        effect(Kind::Texture(texture(f64::NAN, 0.0))),
        effect(Kind::Edge(Edge { line: None })),
        effect(Kind::Train(Train { rate: 0.0, ..train() })),
        effect(Kind::Score(Score { start: Start::Touch, period: None, events: Vec::new() })),
    ];
    for one in bad {
        assert!(Effects::new(&set(vec![one.clone()]), sheet(), 8e3).is_err(), "{one:?}");
    }
    let good = effect(Kind::Button(Button { press_force: None, release: 0.5 }));
    assert!(Effects::new(&set(vec![good.clone()]), sheet(), f64::INFINITY).is_err());
    let twice = Effects::new(&set(vec![good.clone(), good]), sheet(), 8e3);
    assert!(twice.is_err_and(|error| error.to_string().contains("`it` twice")));
}
