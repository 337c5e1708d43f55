//! What touches make of a surface, against drives and fields computed apart.

mod common;

use common::*;
use unripple_core::{Drive, Phase, Point};
use unripple_effects::{Curve, Kind, Level, Texture};
use unripple_field::{Aim, Field};
use unripple_focus::{Options, Target, focus};
use unripple_touch::{Synthetic, SyntheticOptions};

fn taps() -> Script {
    Script::new(vec![
        touch(1, Phase::Down, 62.0, 90.0, 0.010),
        touch(2, Phase::Down, 100.0, 60.0, 0.0131),
        touch(1, Phase::Up, 62.0, 90.0, 0.060),
        touch(2, Phase::Up, 100.0, 60.0, 0.075),
    ])
}

/// The same drives as the focusing command makes, put where the touches were.
#[test]
fn what_is_played_is_what_is_focused() {
    let mut engine = engine(&clicks(), sources(vec![Box::new(taps())]));
    let played = play(&mut engine, 100);
    let options = Options { window: WINDOW, ..Options::default() };
    let mut expected = vec![vec![0.0; 100 * BLOCK]; 8];
    let taps = [
        (62.0, 90.0, 0.010, 0.4),
        (100.0, 60.0, 0.0131, 0.4),
        (62.0, 90.0, 0.060, 0.2),
        (100.0, 60.0, 0.075, 0.2),
    ];
    for (x, y, time, gain) in taps {
        let made = focus(&KNOWN, &[Target::at(Point::from_mm(x, y))], &options).unwrap().drive;
        // Heard at the first block that begins at or after the touch.
        let start = (time * RATE / BLOCK as f64).ceil() as usize * BLOCK;
        for (line, channel) in expected.iter_mut().zip(made.channels()) {
            line[start..].iter_mut().zip(channel).for_each(|(to, d)| *to += gain * d);
        }
    }
    let difference = played.iter().zip(&expected).flat_map(|(a, b)| a.iter().zip(b));
    let most = difference.map(|(a, b)| (f64::from(*a) - b).abs()).fold(0.0, f64::max);
    assert!(most < 1e-6, "{most:e}");
    let tally = engine.stage().conductor().tally();
    assert_eq!((tally.started, tally.failed, tally.limited, tally.lost), (4, 0, 0, 0));
}

/// The figures of the field are those of the focusing command, a level and a delay apart.
#[test]
fn what_is_played_meets_under_the_finger() {
    let tap = Script::new(vec![touch(1, Phase::Down, 62.0, 90.0, 0.010)]);
    let played = play(&mut engine(&clicks(), sources(vec![Box::new(tap)])), 30);
    let names: Vec<String> = FILM.actuators.iter().map(|a| a.name.clone()).collect();
    let lines = played.iter().map(|line| line.iter().map(|x| f64::from(*x)).collect()).collect();
    let played = Drive::new(RATE, names, lines).unwrap();
    let at = Point::from_mm(62.0, 90.0);
    let options = Options { window: WINDOW, ..Options::default() };
    let alone = focus(&KNOWN, &[Target::at(at)], &options).unwrap().drive;
    let contrast = |drive: &Drive, instant: f64| {
        let field = Field::new(&KNOWN, drive, 6.0).unwrap();
        let aim = Aim { points: vec![at], instant };
        field.measure(&[aim], None).unwrap().targets[0].contrast.unwrap()
    };
    let start = (0.010 * RATE / BLOCK as f64).ceil() * BLOCK as f64 / RATE;
    let (live, apart) = (contrast(&played, start + WINDOW), contrast(&alone, WINDOW));
    assert!((live / apart - 1.0).abs() < 1e-5 && live > 10.0, "{live} {apart}");
}

#[test]
fn the_same_touches_give_the_same_drive_and_no_touch_waits_longer_than_a_block() {
    let session = || {
        let options = SyntheticOptions { fingers: 10, seed: 5, ..SyntheticOptions::default() };
        let texture = Kind::Texture(grooves());
        let fingers = Synthetic::new(&FILM.outline, options).unwrap();
        let mut engine = engine(&one(texture, Level::Share(0.2)), sources(vec![Box::new(fingers)]));
        let played = play(&mut engine, 1500);
        (played, engine)
    };
    let (first, mut engine) = session();
    assert!(first == session().0);
    let stage = engine.stage();
    let worst = stage.conductor().tally().first_sample.worst().unwrap();
    assert!(worst <= BLOCK as f64 / RATE + 1e-9, "{worst}");
    assert!(stage.feelings().iter().any(|feeling| feeling.level_db.is_some_and(|db| db > 0.0)));
    assert!(first.iter().flatten().all(|x| x.abs() <= 1.0));
    assert!(first.iter().flatten().any(|x| *x != 0.0));
}

fn grooves() -> Texture {
    Texture { pitch: 2e-3, grain: 0.0, seed: 1, speed_gain: Curve::constant(1.0) }
}
