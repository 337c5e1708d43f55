//! How long one touch and one tick take, with ten fingers in twelve effects: median, p99, worst and the limit.
//!
//! The limit is a tenth of what a touch may take from its arrival to the first sample.

use std::time::Instant;
use unripple_core::{Outline, Phase, Point, Shape, Touch};
use unripple_effects::{
    Anchor, Button, Curve, Effect, EffectSet, Effects, Hum, Kind, Level, Notch, Region, Texture, Tone, Trace,
    Traced, Train,
};

const FINGERS: u64 = 10;
/// Reports a second of each finger.
const REPORTS: f64 = 120.0;
const SECONDS: u64 = 60;
/// In s.
const LIMIT: f64 = 1e-4;

fn set() -> EffectSet {
    let one = Curve::constant(1.0);
    let texture = |pitch| Kind::Texture(Texture { pitch, grain: 0.5, seed: 1, speed_gain: one.clone() });
    let train =
        |rate| Kind::Train(Train { rate, count: None, envelope: None, jitter: 0.5, scatter: 0.01, seed: 1 });
    let path = vec![Point::default(), Point::new(0.02, 0.0), Point::new(0.0, 0.02)];
    let shape = |trace| {
        Kind::Shape(Traced { path: path.clone(), closed: true, anchor: Anchor::Finger, trace, rate: 100.0 })
    };
    let hum = |hz| Kind::Hum(Hum { tone: Tone::Sine(hz), speed_gain: one.clone(), fade: 0.02 });
    let notch = |pitch| Kind::Notch(Notch { pitch, axis: 0.5, origin: Point::default(), hysteresis: 0.1 });
    let button = |press_force| Kind::Button(Button { press_force, release: 0.5 });
    let kinds = [
        button(None),
        button(Some(1.0)),
        texture(1e-3),
        texture(2e-4),
        notch(5e-3),
        notch(1e-3),
        train(20.0),
        train(200.0),
        shape(Trace::Moving(0.1)),
        shape(Trace::AtOnce(1e-3)),
        hum(100.0),
        hum(250.0),
    ];
    let effect = |(i, kind)| Effect {
        name: format!("e{i}"),
        region: Region::Everywhere,
        level: Level::Share(0.5),
        kind,
    };
    EffectSet {
        name: "bench".into(),
        about: String::new(),
        effects: kinds.into_iter().enumerate().map(effect).collect(),
    }
}

fn row(what: &str, mut times: Vec<f64>) {
    times.sort_by(f64::total_cmp);
    let at = |share: f64| 1e6 * times[((times.len() - 1) as f64 * share) as usize];
    println!("{what:8} {:9.2} {:9.2} {:9.2} {:9.2}", at(0.5), at(0.99), at(1.0), 1e6 * LIMIT);
}

fn main() {
    let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
    let mut effects = Effects::new(&set(), sheet, 48e3).expect("a legal set");
    let (mut touches, mut ticks, mut count) = (Vec::new(), Vec::new(), 0);
    let mut cues = Vec::new();
    for report in 0..SECONDS * REPORTS as u64 {
        let time = report as f64 / REPORTS;
        for finger in 0..FINGERS {
            let turn = 2.0 * time + finger as f64;
            let at = Point::new(0.075 + 0.05 * turn.cos(), 0.075 + 0.05 * (1.3 * turn).sin());
            let phase = if report % 240 == 0 { Phase::Down } else { Phase::Move };
            let start = Instant::now();
            effects.touch(&Touch { finger, phase, at, time, force: Some(1.0 + turn.sin()) }, &mut cues);
            touches.push(start.elapsed().as_secs_f64());
        }
        for block in 0..6 {
            let start = Instant::now();
            effects.tick(time + f64::from(block) / (6.0 * REPORTS), &mut cues);
            ticks.push(start.elapsed().as_secs_f64());
        }
        count += cues.len();
        cues.clear();
    }
    println!("{FINGERS} fingers, 12 effects, {SECONDS} s: {count} cues, {} left out", effects.dropped());
    println!("in us       median       p99     worst     limit");
    row("touch", touches);
    row("tick", ticks);
}
