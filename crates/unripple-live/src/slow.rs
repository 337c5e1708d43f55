//! Tests of what is done while drives take long to make: the player goes on meanwhile, and fingers leave.

use crate::{Conductor, DriveCache, FocusWorker, LiveOptions, Timeline, Timing};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use unripple_core::{Phase, Point, Touch};
use unripple_effects::{Curve, Effect, EffectSet, Effects, Kind, Level, Region, Texture, Train};
use unripple_physics::{ResponseOptions, design::papers_surface, responses};
use unripple_player::{Options, Player, player};
use unripple_touch::Heard;

/// Samples per second, and per block: those of a usual sound card.
const RATE: f64 = 48e3;
const BLOCK: usize = 64;

/// Blocks that the player plays while one drive is made: 62 ms.
const MAKING: usize = 47;

struct Slow {
    conductor: Conductor,
    player: Arc<Mutex<Player>>,
    drive: Vec<f32>,
}

impl Slow {
    /// One effect, each drive of which takes 62 ms of the player's time, and as long as said of the machine's.
    fn new(kind: Kind, takes: Duration) -> Self {
        let mut film = papers_surface();
        film.emission.band[1] = 500.0;
        let options = LiveOptions::new(&film, 0.02);
        let outputs = film.actuators.len();
        let (player, desk) =
            player(&Options { outputs, block: BLOCK, rate: RATE, ..Options::default() }).unwrap();
        let player = Arc::new(Mutex::new(player));
        let (plays, mut meanwhile) = (player.clone(), vec![0.0; outputs * BLOCK]);
        let known = Arc::new(responses(&film, &ResponseOptions::default()).unwrap());
        let meanwhile = Mutex::new(std::mem::take(&mut meanwhile));
        let maker = FocusWorker::planned(known, &options.focus, move || {
            let (mut player, mut drive) = (plays.lock().unwrap(), meanwhile.lock().unwrap());
            (0..MAKING).for_each(|_| player.process(&mut drive));
            std::thread::sleep(takes);
        });
        let effect =
            Effect { name: "it".into(), region: Region::Everywhere, level: Level::Share(0.01), kind };
        let set = EffectSet { name: "one".into(), about: String::new(), effects: vec![effect] };
        let effects = Effects::new(&set, film.outline.clone(), RATE).unwrap();
        let drives = DriveCache::new(maker.unwrap(), options.focus.limit, None);
        let time = Timing { rate: RATE, window: 0.02, block: BLOCK };
        let mut conductor = Conductor::new(effects, drives, desk, time, 0);
        conductor.keep_log();
        Self { conductor, player, drive: vec![0.0; outputs * BLOCK] }
    }

    /// The same as when threads play.
    fn threaded(kind: Kind) -> Self {
        // Longer than a step may take before it looks at what came.
        let mut slow = Self::new(kind, Duration::from_millis(6));
        slow.conductor.count_by(Arc::new(Timeline::new(RATE)));
        slow
    }

    fn clock(&self) -> u64 {
        self.conductor.desk().clock()
    }

    /// One block of the player, and what touches set off in it.
    fn step(&mut self, touches: &[(u64, Phase, f64)]) {
        self.player.lock().unwrap().process(&mut self.drive);
        let now = self.clock();
        let touch = |(finger, phase, x): &(u64, Phase, f64)| {
            let at = Point::from_mm(*x, 20.0 + 12.0 * *finger as f64);
            Touch { finger: *finger, phase: *phase, at, time: now as f64 / RATE, force: None }
        };
        let heard = Heard { touches: touches.iter().map(touch).collect(), ..Heard::default() };
        self.conductor.step(&heard, now, now + 4 * BLOCK as u64).unwrap();
    }

    fn made(&self) -> u64 {
        self.conductor.drives().making().count()
    }
}

fn comb() -> Kind {
    Kind::Train(Train { rate: 100.0, count: None, envelope: None, jitter: 0.0, scatter: 0.0, seed: 1 })
}

fn grains() -> Kind {
    Kind::Texture(Texture { pitch: 1e-3, grain: 0.0, seed: 1, speed_gain: Curve::constant(1.0) })
}

/// All fingers but the first go elsewhere, and that leaves.
#[test]
fn a_lift_is_obeyed_before_what_came_with_it_is_made() {
    let mut slow = Slow::new(comb(), Duration::ZERO);
    let all = |phase, x: f64| (1..=8).map(|finger| (finger, phase, x)).collect::<Vec<_>>();
    slow.step(&all(Phase::Down, 60.0));
    (0..40).for_each(|_| slow.step(&[]));
    let first = slow.conductor.drives.at(&[Point::from_mm(60.0, 32.0)]).unwrap().prepared;
    let mut touches = all(Phase::Move, 70.0);
    touches[0] = (9, Phase::Down, 70.0);
    touches.push((1, Phase::Up, 60.0));
    let _ = slow.conductor.began();
    let before = slow.made();
    slow.step(&touches);
    assert_eq!(slow.made() - before, 8);
    let lifted = slow.clock() - (8 * MAKING * BLOCK) as u64;
    slow.step(&[]);
    let began = slow.conductor.began();
    let after = |of: &crate::Began| of.sample >= lifted && Arc::ptr_eq(&of.drive, &first);
    assert!(began.iter().any(|of| of.sample >= lifted), "the others go on");
    assert_eq!(began.iter().filter(|of| after(of)).count(), 0, "begun after the lift");
}

#[test]
fn a_pulse_whose_drives_turn_came_too_late_is_not_begun() {
    let mut slow = Slow::new(grains(), Duration::ZERO);
    slow.step(&[(1, Phase::Down, 40.0)]);
    slow.step(&[(1, Phase::Move, 60.5)]);
    let asked = slow.clock();
    slow.step(&[(1, Phase::Up, 60.5)]);
    (0..20).for_each(|_| slow.step(&[]));
    let began = slow.conductor.began();
    // As late as may be, and a drive more.
    let latest = (0.1 * RATE) as u64 + ((2 * MAKING + 20) * BLOCK) as u64;
    assert!(!began.is_empty() && slow.conductor.tally().stale > 10, "{}", slow.conductor.tally().stale);
    let last = began.iter().map(|of| of.sample).max().unwrap();
    let first = began.iter().map(|of| of.sample).min().unwrap();
    assert!(last <= first + latest, "{first} to {last} of {asked}");
}

#[test]
fn what_a_finger_set_off_is_not_made_once_it_has_left() {
    let mut slow = Slow::threaded(grains());
    slow.step(&[(1, Phase::Down, 40.0)]);
    slow.step(&[(1, Phase::Move, 60.5)]);
    assert_eq!(slow.made(), 1, "what came is looked at after each drive");
    assert!(!slow.conductor.rests());
    slow.step(&[(1, Phase::Up, 60.5)]);
    (0..20).for_each(|_| slow.step(&[]));
    assert_eq!(slow.made(), 1, "drives for a finger that had left");
    assert!(slow.conductor.waiting.is_empty() && slow.conductor.rests());
}

/// Four fingers move faster than drives are made.
#[test]
fn of_places_that_nobody_had_time_for_only_the_last_is_made() {
    let mut slow = Slow::threaded(comb());
    let all = |phase, x: f64| (1..=4).map(|finger| (finger, phase, x)).collect::<Vec<_>>();
    slow.step(&all(Phase::Down, 30.0));
    for step in 0..30 {
        slow.step(&all(Phase::Move, 31.0 + f64::from(step)));
        assert!(slow.conductor.waiting.len() <= 8, "{} wait", slow.conductor.waiting.len());
    }
    (0..8).for_each(|_| slow.step(&[]));
    assert!(slow.conductor.waiting.is_empty());
    for state in slow.conductor.sounding.values() {
        let crate::voice_state::SustainedSound::Comb { place, .. } = state.sound else { panic!("{state:?}") };
        assert!((place.x - 0.06).abs() < 1e-9, "{place:?}");
    }
    assert!(slow.made() <= 40, "{} drives", slow.made());
    slow.step(&all(Phase::Up, 60.0));
    assert!(slow.conductor.sounding.is_empty() && slow.conductor.rests());
}
