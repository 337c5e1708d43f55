//! A day of hostile sittings: effects of every kind, fingers that do what no finger does, an audio side that stands still, is started anew and changes
//! its period. No limit is passed, and each sitting ends in exact silence. A few seconds of played time; `UNRIPPLE_HOURS` says how many hours
//! instead, and `UNRIPPLE_AT_MOST_S` after how many seconds of the machine's clock it is enough all the same.

mod common;
#[path = "common/rig.rs"]
mod rig;

use common::{FILM, RATE};
use rig::*;
use std::time::{Duration, Instant};
use unripple_core::{Phase, Random, Touch};
use unripple_player::{Count, Limit, Options, Running, WaveOptions};

/// Running rms that an actuator may reach, as a share of its peak limit, and over which time.
const RMS: f64 = 0.2;
const OVER: f64 = 1.0;

const FINGERS: u64 = 12;

/// What became of all sittings so far.
#[derive(Debug, Default)]
struct Day {
    played_s: f64,
    /// Of which with fingers.
    touched_s: f64,
    sittings: u64,
    stood: u64,
    restarted: u64,
    periods: u64,
    started: u64,
    lost: u64,
    refused: u64,
    loudest: f64,
}

/// What a sitting's player is made for: often just enough, at times far too little.
fn made_for(random: &mut Random) -> Options {
    let running = Some(Running { level: RMS * FILM.emission.limit, seconds: OVER });
    let limits = vec![Limit { peak: FILM.emission.limit, rms: running, thermal: None }];
    let block = [16, 64, 256, 1024][random.between(0.0, 4.0) as usize % 4];
    let whole = Options { block, limits, ..options() };
    if random.uniform() < 0.6 {
        return whole;
    }
    let waves = WaveOptions { inputs: 3, sounds: 4, ..options().waves.unwrap() };
    Options { commands: 32, copies: 24, voices: 4, waves: Some(waves), ..whole }
}

/// One player between two restarts.
struct Sitting {
    rig: Rig,
    /// Blocks that the server asks for at once.
    period: usize,
    /// Running power of each actuator.
    power: Vec<f64>,
}

impl Sitting {
    fn new(random: &mut Random) -> Self {
        let set = everything(random);
        let mut rig = Rig::new(&set, &made_for(random));
        rig.conductor.keep_log();
        Self { rig, period: 1, power: vec![0.0; FILM.actuators.len()] }
    }

    /// The player for some blocks, held against its limits.
    fn play(&mut self, blocks: usize, day: &mut Day) {
        for _ in 0..blocks {
            self.rig.play(1);
            for (power, plane) in self.power.iter_mut().zip(self.rig.drive.chunks_exact(self.rig.block)) {
                for x in plane {
                    let d = f64::from(*x);
                    assert!(d.is_finite() && d.abs() <= FILM.emission.limit, "{d}");
                    *power += (d * d - *power) / (OVER * RATE);
                    day.loudest = day.loudest.max(d.abs());
                }
                assert!(power.sqrt() <= RMS * FILM.emission.limit * (1.0 + 1e-6), "rms {}", power.sqrt());
            }
        }
    }

    fn touch(&mut self, random: &mut Random, most: f64) {
        let now = self.rig.now();
        let touches = (0..random.between(0.0, most) as usize).map(|_| {
            let phase =
                [Phase::Down, Phase::Move, Phase::Move, Phase::Up][random.between(0.0, 4.0) as usize % 4];
            let finger = random.between(0.0, FINGERS as f64) as u64 % FINGERS;
            at(finger, phase, somewhere(random), now)
        });
        let touches: Vec<Touch> = touches.collect();
        self.rig.touch(touches);
    }

    /// Something that happens.
    fn go_on(&mut self, random: &mut Random, day: &mut Day) {
        match random.uniform() {
            // The server freezes for up to two seconds, and fingers go on.
            x if x < 0.01 => {
                day.stood += 1;
                (0..random.between(1.0, 400.0) as usize).for_each(|_| self.touch(random, 6.0));
            }
            // Nobody hears what fingers do, for as long.
            x if x < 0.02 => self.play(self.rig.blocks(random.between(0.0, 2.0)), day),
            x if x < 0.03 => {
                day.periods += 1;
                self.period = random.between(1.0, 17.0) as usize;
            }
            // All rest.
            x if x < 0.1 => {
                for _ in 0..self.rig.blocks(random.between(0.0, 5.0)) / self.period {
                    self.rig.touch(Vec::new());
                    self.play(self.period, day);
                }
            }
            _ => {
                self.touch(random, 8.0);
                self.play(self.period, day);
            }
        }
    }

    /// All fingers leave, for so many seconds.
    fn end(mut self, rest: f64, day: &mut Day) {
        day.touched_s += self.rig.now();
        let now = self.rig.now();
        let lifts = (0..FINGERS).map(|finger| at(finger, Phase::Up, somewhere(&mut Random::seeded(1)), now));
        self.rig.touch(lifts.collect());
        self.rig.rings_out(rest);
        day.count(&self);
    }

    /// The audio side is started anew in the middle of it all: what was there fades out.
    fn restart(self, random: &mut Random, day: &mut Day) {
        day.restarted += 1;
        day.touched_s += self.rig.now();
        day.count(&self);
        let blocks = self.rig.blocks(0.05) + 1;
        let Rig { mut conductor, mut player, mut drive, .. } = self.rig;
        if random.uniform() < 0.5 {
            conductor.end(0.02);
            (0..blocks).for_each(|_| player.process(&mut drive));
            assert!(conductor.is_over());
        } else {
            drop(conductor);
            (0..blocks).for_each(|_| player.process(&mut drive));
        }
        for _ in 0..blocks {
            player.process(&mut drive);
            assert!(drive.iter().all(|x| *x == 0.0));
        }
    }
}

impl Day {
    fn count(&mut self, sitting: &Sitting) {
        let (tally, meters) = (sitting.rig.conductor.tally(), sitting.rig.conductor.desk().meters());
        self.played_s += sitting.rig.now();
        self.started += tally.started;
        self.lost += tally.lost + meters.count(Count::ReportsLost);
        self.refused += tally.refused;
    }
}

#[test]
fn every_sitting_ends_in_silence() {
    let number = |name: &str, other: f64| std::env::var(name).map_or(other, |text| text.parse().unwrap());
    let (wanted, most) = (3600.0 * number("UNRIPPLE_HOURS", 0.01), number("UNRIPPLE_AT_MOST_S", 1e9));
    let (began, mut told) = (Instant::now(), Instant::now());
    let mut day = Day::default();
    while day.played_s < wanted && began.elapsed().as_secs_f64() < most {
        println!("sitting of seed {}", day.sittings);
        let mut random = Random::seeded(day.sittings);
        let mut sitting = Sitting::new(&mut random);
        let length = random.between(1.0, 40.0);
        while sitting.rig.now() < length && began.elapsed().as_secs_f64() < most {
            sitting.go_on(&mut random, &mut day);
            if random.uniform() < 5e-4 {
                sitting.restart(&mut random, &mut day);
                sitting = Sitting::new(&mut random);
            }
        }
        // Most of a day nobody is there.
        let rest = random.between(60.0, 600.0).min(wanted - day.played_s - sitting.rig.now());
        sitting.end(rest.max(1.0), &mut day);
        day.sittings += 1;
        if told.elapsed() > Duration::from_secs(60) {
            told = Instant::now();
            println!(
                "{:.2} h played in {:.0} s: {day:?}",
                day.played_s / 3600.0,
                began.elapsed().as_secs_f64()
            );
        }
    }
    println!("{:.2} h played in {:.0} s: {day:?}", day.played_s / 3600.0, began.elapsed().as_secs_f64());
    if day.played_s < wanted {
        println!(
            "STOPPED by the time allowed: {:.2} h of {:.2} h were played",
            day.played_s / 3600.0,
            wanted / 3600.0
        );
    }
    assert!(day.loudest > 0.5 * FILM.emission.limit, "limits were never reached");
}
