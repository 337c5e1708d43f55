//! Random sittings, hostile ones among them: no limit of any actuator is ever passed, no step is larger than what the drives that sound have themselves, and
//! nothing is lost. A minute of played time; `UNRIPPLE_MINUTES` says how many instead.

mod common;
#[path = "../../unripple-core/tests/shared/nowhere.rs"]
mod nowhere;

use common::*;
use nowhere::Nowhere;
use unripple_core::{Layout, Phase, Point, Random, Surface, Touch};
use unripple_effects::{
    Curve, Effect, EffectSet, Envelope, Event, Hum, Kind, Level, Region, Score, Sound, Start, Texture, Tone,
    Train,
};
use unripple_live::{Engine, FocusWorker, LiveOptions};
use unripple_player::Clicks;
use unripple_touch::{Counts, Heard, Source};

/// Seconds of one sitting.
const SITTING: f64 = 10.0;

/// Running rms that an actuator may reach, as a share of its peak limit, and over which time.
const RMS: f64 = 0.2;
const OVER: f64 = 1.0;

fn film() -> Surface {
    let mut film = FILM.clone();
    film.emission.rms_limit = Some(RMS * film.emission.limit);
    film
}

/// Fingers that do what no finger does: come twice, leave unasked, jump, hammer, press with any force.
struct Hostile {
    random: Random,
    next: f64,
}

impl Source for Hostile {
    fn name(&self) -> &str {
        "hostile"
    }

    fn poll(&mut self, now: f64, heard: &mut Heard) {
        while self.next <= now {
            let random = &mut self.random;
            let phase = [Phase::Down, Phase::Move, Phase::Up][random.between(0.0, 3.0) as usize % 3];
            let at = Point::from_mm(random.between(1.0, 149.0), random.between(1.0, 149.0));
            let force = (random.uniform() < 0.5).then(|| random.between(0.0, 50.0));
            let finger = random.between(0.0, 12.0) as u64;
            heard.touches.push(Touch { finger, phase, at, time: self.next, force });
            // In volleys: many at once, then none for a while.
            self.next += if random.uniform() < 0.9 { 0.0005 } else { random.between(0.0, 0.3) };
        }
    }

    fn counts(&self) -> Counts {
        Counts::default()
    }
}

/// All kinds of effects at once, loud.
fn loud(random: &mut Random, hums: bool) -> EffectSet {
    let effect = |name: &str, level: f64, kind| {
        let level = Level::Share(level);
        Effect { name: name.into(), region: Region::Everywhere, level, kind }
    };
    let curve = || Curve::constant(1.0);
    let pitch = random.between(0.5e-3, 4e-3);
    let texture = Texture { pitch, grain: 0.5, seed: 1, speed_gain: curve() };
    let hum = Hum { tone: Tone::Sine(random.between(20.0, 900.0)), speed_gain: curve(), fade: 0.02 };
    let train = Train {
        rate: random.between(2.0, 400.0),
        count: None,
        envelope: None,
        jitter: 0.3,
        scatter: 0.01,
        seed: 2,
    };
    let comb = Train { rate: random.between(2.0, 400.0), jitter: 0.0, scatter: 0.0, ..train.clone() };
    let swell = Envelope::new(vec![(0.0, 0.0), (0.05, 1.0), (0.1, 0.0)], vec![(0.0, 150.0)]).unwrap();
    let event = |at, sound| Event { at, gain: 1.0, place: None, sound };
    let swells = hums.then(|| event(0.05, Sound::Wave(swell)));
    let events = [event(0.0, Sound::Pulse), event(0.03, Sound::Pulse)].into_iter().chain(swells).collect();
    let score = Score { start: Start::Touch, period: Some(0.25), events };
    let mut set = clicks();
    set.effects.push(effect("comb", random.uniform(), Kind::Train(comb)));
    set.effects.push(effect("score", random.uniform(), Kind::Score(score)));
    set.effects.push(effect("grains", random.uniform(), Kind::Texture(texture)));
    if hums {
        set.effects.push(effect("hum", random.uniform(), Kind::Hum(hum)));
    }
    set.effects.push(effect("train", random.uniform(), Kind::Train(train)));
    set
}

/// What was emitted, held against the limits and against the steps that smooth drives have.
struct Watch {
    limit: f64,
    /// Running power of each actuator.
    power: Vec<f64>,
    largest: f64,
    loudest: f64,
    clicks: usize,
}

impl Watch {
    fn new(film: &Surface) -> Self {
        let count = film.actuators.len();
        let limit = film.emission.limit;
        Self { limit, power: vec![0.0; count], largest: 0.0, loudest: 0.0, clicks: 0 }
    }

    fn hear(&mut self, block: &[f32]) {
        for (power, plane) in self.power.iter_mut().zip(block.chunks_exact(BLOCK)) {
            for x in plane {
                let d = f64::from(*x);
                assert!(d.is_finite() && d.abs() <= self.limit, "{d} over {}", self.limit);
                *power += (d * d - *power) / (OVER * RATE);
                self.largest = self.largest.max(d.abs());
            }
            self.loudest = self.loudest.max(power.sqrt());
        }
        assert!(self.loudest <= RMS * self.limit * (1.0 + 1e-6), "{}", self.loudest);
    }
}

fn sitting(seed: u64, watch: &mut Watch) -> (u64, u64) {
    let film = film();
    let mut random = Random::seeded(seed);
    let pulses_alone = !seed.is_multiple_of(2);
    let names: Vec<String> = film.actuators.iter().map(|a| a.name.clone()).collect();
    let layout = Layout {
        device: "nowhere".into(),
        rate: RATE,
        block: BLOCK,
        outputs: names.clone(),
        inputs: names,
        full_scale: 1.0,
    };
    let set = loud(&mut random, !pulses_alone);
    let hostile = Hostile { random, next: 0.0 };
    let options = LiveOptions { rms_seconds: OVER, ..LiveOptions::new(&film, WINDOW) };
    let maker = FocusWorker::new(KNOWN.clone(), &options.focus).unwrap();
    let sources = sources(vec![Box::new(hostile)]);
    let mut engine = Engine::new(&film, maker, &set, sources, Box::new(Nowhere(layout)), &options).unwrap();
    let mut clicks = Clicks::new(film.actuators.len(), BLOCK);
    engine.stage().conductor_mut().keep_log();
    watch.power.fill(0.0);
    while engine.stage().time() < SITTING {
        let clock = engine.stage().conductor().desk().clock();
        engine.step().unwrap();
        watch.hear(engine.heart().drive());
        // What waveforms step by nobody announces.
        if pulses_alone {
            for began in engine.stage().conductor_mut().began() {
                clicks.expect(&began.drive, began.gain, began.sample);
            }
            watch.clicks += clicks.hear(clock, engine.heart().drive());
        }
    }
    let tally = engine.stage().conductor().tally().clone();
    assert_eq!(tally.lost, 0);
    // Drops that scatter onto the held rim move nothing, and are counted; nothing else fails.
    assert!(tally.failure.is_none_or(|failure| failure.contains("no actuator can move")));
    assert!(tally.started > 0 && tally.failed * 1000 < tally.started);
    (tally.started, tally.limited)
}

#[test]
fn no_sitting_passes_a_limit_or_clicks() {
    let minutes: f64 = std::env::var("UNRIPPLE_MINUTES").map_or(1.0, |m| m.parse().unwrap());
    let sittings = (60.0 * minutes / SITTING).ceil().max(1.0) as u64;
    let mut watch = Watch::new(&film());
    let mut total = (0, 0);
    for seed in 0..sittings {
        println!("sitting of seed {seed}");
        let (started, limited) = sitting(seed, &mut watch);
        total = (total.0 + started, total.1 + limited);
    }
    println!(
        "{sittings} sittings: {} started, {} limited, largest {:.4}, rms {:.4} of {RMS}, {} clicks",
        total.0, total.1, watch.largest, watch.loudest, watch.clicks
    );
    assert_eq!(watch.clicks, 0);
    assert!(watch.loudest > 0.1 * RMS && total.1 > 0, "limits were never reached");
}
