//! A conductor and a player that are run by hand, so that either may stand still while the other goes on.
#![allow(dead_code)] // Each test file uses its own part of this.

use crate::common::{BLOCK, FILM, KNOWN, RATE, WINDOW, clicks};
use unripple_core::{Phase, Point, Random, Touch};
use unripple_effects::{
    Curve, Effect, EffectSet, Effects, Envelope, Event, Hum, Kind, Level, Region, Score, Sound, Start,
    Texture, Tone, Train,
};
use unripple_live::{Conductor, DriveCache, FocusWorker, LiveOptions, Timing};
use unripple_player::{Limit, Options, Player, WaveOptions, player};
use unripple_touch::Heard;

/// Blocks ahead that commands are given, as when threads play.
const AHEAD: u64 = 4;

pub struct Rig {
    pub conductor: Conductor,
    pub player: Player,
    pub drive: Vec<f32>,
    pub block: usize,
}

/// What the player is made for, as when a surface is played.
pub fn options() -> Options {
    let taps = (WINDOW * RATE) as usize + 1;
    Options {
        outputs: FILM.actuators.len(),
        block: BLOCK,
        rate: RATE,
        limits: vec![Limit { peak: FILM.emission.limit, ..Limit::default() }],
        longest: 7200,
        waves: Some(WaveOptions { taps, band_top_hz: FILM.emission.band[1], ..WaveOptions::default() }),
        ..Options::default()
    }
}

impl Rig {
    pub fn new(set: &EffectSet, options: &Options) -> Self {
        let live = LiveOptions::new(&FILM, WINDOW);
        let maker = FocusWorker::new(KNOWN.clone(), &live.focus).unwrap();
        let (player, desk) = player(options).unwrap();
        let effects = Effects::new(set, FILM.outline.clone(), RATE).unwrap();
        let time = Timing { rate: RATE, window: WINDOW, block: options.block };
        let drives = DriveCache::new(maker, live.focus.limit, None);
        let inputs = options.waves.map_or(0, |waves| waves.inputs);
        let conductor = Conductor::new(effects, drives, desk, time, inputs);
        let drive = vec![0.0; options.outputs * options.block];
        Self { conductor, player, drive, block: options.block }
    }

    pub fn now(&self) -> f64 {
        self.player.clock() as f64 / RATE
    }

    /// The conductor alone.
    pub fn touch(&mut self, touches: Vec<Touch>) {
        self.touch_ahead(touches, AHEAD * self.block as u64);
    }

    /// The same, so many samples ahead.
    pub fn touch_ahead(&mut self, touches: Vec<Touch>, ahead: u64) {
        let now = self.player.clock();
        let heard = Heard { touches, ..Heard::default() };
        self.conductor.step(&heard, now, now + ahead).unwrap();
    }

    /// The player alone, for some blocks; the largest sample.
    pub fn play(&mut self, blocks: usize) -> f32 {
        let mut most = 0.0;
        for _ in 0..blocks {
            self.player.process(&mut self.drive);
            most = self.drive.iter().fold(most, |m: f32, x| m.max(x.abs()));
        }
        most
    }

    /// Both, for some blocks in which nothing is touched; the largest sample.
    pub fn rest(&mut self, blocks: usize) -> f32 {
        let block = |_| {
            self.touch(Vec::new());
            self.play(1)
        };
        (0..blocks).map(block).fold(0.0, f32::max)
    }

    /// Two windows without a touch, a block in which the lift is heard and one that rounds up; then exact silence for so many seconds.
    pub fn falls_silent(&mut self, seconds: f64) {
        self.rest(self.blocks(2.0 * WINDOW) + 2);
        let left = self.rest(self.blocks(seconds));
        assert!(left == 0.0, "{left} two windows after the last lift");
        assert!(self.conductor.desk().meters().is_silent());
    }

    /// The same after waveforms: these come later by the player's delay, and fade.
    pub fn rings_out(&mut self, seconds: f64) {
        self.rest(self.blocks(self.conductor.desk().wave_delay() as f64 / RATE));
        self.falls_silent(seconds);
    }

    /// So many seconds, in whole blocks.
    pub fn blocks(&self, seconds: f64) -> usize {
        (seconds * RATE / self.block as f64).ceil() as usize
    }
}

fn effect(name: &str, level: f64, kind: Kind) -> Effect {
    Effect { name: name.into(), region: Region::Everywhere, level: Level::Share(level), kind }
}

/// Effects at once, each under a name of its own.
pub fn set(mut effects: Vec<Effect>) -> EffectSet {
    for (number, effect) in effects.iter_mut().enumerate() {
        effect.name = format!("{} {number}", effect.name);
    }
    EffectSet { name: "some".into(), about: String::new(), effects }
}

/// A focus repeated by the player itself.
pub fn comb(rate: f64) -> Effect {
    let steady = Train { rate, count: None, envelope: None, jitter: 0.0, scatter: 0.0, seed: 2 };
    effect("comb", 0.1, Kind::Train(steady))
}

pub fn pulses(rate: f64) -> Effect {
    let train = Train { rate, count: None, envelope: None, jitter: 0.3, scatter: 0.0, seed: 2 };
    effect("pulses", 0.1, Kind::Train(train))
}

pub fn grains(pitch: f64) -> Effect {
    let texture = Texture { pitch, grain: 0.2, seed: 1, speed_gain: Curve::constant(1.0) };
    effect("grains", 0.1, Kind::Texture(texture))
}

pub fn hum(tone: Tone) -> Effect {
    effect("hum", 0.2, Kind::Hum(Hum { tone, speed_gain: Curve::constant(1.0), fade: 0.01 }))
}

pub fn swell(seconds: f64) -> Envelope {
    let amplitude = vec![(0.0, 0.0), (0.5 * seconds, 1.0), (seconds, 0.0)];
    Envelope::new(amplitude, vec![(0.0, 200.0)]).unwrap()
}

/// Waveforms played once, all at the same time, and a pulse.
pub fn score(waves: usize, seconds: f64) -> Effect {
    let event = |sound| Event { at: 0.0, gain: 0.5, place: None, sound };
    let mut events: Vec<Event> = (0..waves).map(|_| event(Sound::Wave(swell(seconds)))).collect();
    events.push(event(Sound::Pulse));
    effect("score", 0.2, Kind::Score(Score { start: Start::Touch, period: None, events }))
}

/// Effects of every kind that goes on by itself or follows a finger.
pub fn everything(random: &mut Random) -> EffectSet {
    let mut all = vec![
        comb(random.between(2.0, 300.0)),
        pulses(random.between(2.0, 300.0)),
        hum(Tone::Sine(random.between(20.0, 900.0))),
        hum(Tone::Looped(swell(0.05))),
        hum(Tone::Once(swell(0.3))),
        score(2, 0.2),
    ];
    // Each grain is a drive for a place of its own: most of the work of a sitting.
    if random.uniform() < 0.3 {
        all.push(grains(random.between(0.1e-3, 4e-3)));
    }
    all.extend(clicks().effects);
    set(all)
}

/// One of a hundred places on the film, so that drives are remembered.
pub fn somewhere(random: &mut Random) -> Point {
    let mut line = || 15.0 + 13.0 * random.between(0.0, 10.0).floor();
    Point::from_mm(line(), line())
}

pub fn at(finger: u64, phase: Phase, at: Point, time: f64) -> Touch {
    Touch { finger, phase, at, time, force: None }
}
