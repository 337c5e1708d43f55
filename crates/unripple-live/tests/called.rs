//! A device that calls whoever plays, at a pace of its own that changes and halts: what it counts itself is what the play says of its
//! latency.

mod common;

use common::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::sync::{Arc, Mutex, mpsc};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use unripple_core::{Cycle, Device, DeviceError, Layout, Phase, Point, Server, Status, Touch, Work};
use unripple_devices::{Feeler, Handle};
use unripple_effects::{EffectSet, Kind, Level, Train};
use unripple_live::LiveError;
use unripple_touch::{Counts, Heard, Source};

/// Touches in all.
const TOUCHES: u64 = 20;

/// Samples of one cycle after the other, over and over; after the halt it goes on.
const CYCLES: [usize; 6] = [256, 256, 1024, 441, 64, 2048];
const HALT: Duration = Duration::from_millis(300);
/// The cycle before which it does.
const HALTS: usize = 40;

/// What the device counts.
#[derive(Default)]
struct Counted {
    cycles: usize,
    /// Samples given so far, and when the first of the last cycle left.
    given: u64,
    last: Option<(u64, Instant)>,
    /// When something began to sound.
    onsets: Vec<Instant>,
    silent: u64,
    /// The last sample of every output, and the largest step from one to the next.
    ends: Vec<f32>,
    step: f32,
}

/// Calls from a thread of its own.
struct Caller {
    layout: Layout,
    counted: Arc<Mutex<Counted>>,
    thread: Option<JoinHandle<Box<dyn Work>>>,
    stop: Arc<AtomicBool>,
}

struct Buffers {
    planes: Vec<Vec<f32>>,
    began: Instant,
}

impl Cycle for Buffers {
    fn frames(&self) -> usize {
        self.planes[0].len()
    }
    fn began(&self) -> Instant {
        self.began
    }
    fn drive(&mut self, output: usize) -> &mut [f32] {
        &mut self.planes[output]
    }
    fn heard(&self, _: usize) -> &[f32] {
        &[]
    }
}

impl Counted {
    fn count(&mut self, planes: &[Vec<f32>], began: Instant) {
        self.last = Some((self.given, began));
        self.cycles += 1;
        for i in 0..planes[0].len() {
            let sounds = planes.iter().any(|plane| plane[i] != 0.0);
            // A drive has no gap as long as this.
            if sounds && self.silent > 480 {
                self.onsets.push(began + Duration::from_secs_f64(i as f64 / RATE));
            }
            self.silent = if sounds { 0 } else { self.silent + 1 };
        }
        self.ends.resize(planes.len(), 0.0);
        for (end, plane) in self.ends.iter_mut().zip(planes) {
            for x in plane {
                self.step = self.step.max((x - *end).abs());
                *end = *x;
            }
        }
        self.given += planes[0].len() as u64;
    }
}

impl Device for Caller {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn status(&self) -> Status {
        Status { server: Some(Server { period: 256, ..Server::default() }), ..Status::default() }
    }

    fn exchange(&mut self, _: &[f32], _: &mut [f32]) -> Result<(), DeviceError> {
        panic!("a device that calls is asked for blocks");
    }

    fn install_work(&mut self, mut work: Box<dyn Work>) -> Result<(), Box<dyn Work>> {
        let (stop, counted, outputs) = (self.stop.clone(), self.counted.clone(), self.layout.outputs.len());
        self.thread = Some(std::thread::spawn(move || {
            let mut due = Instant::now();
            for (cycle, frames) in CYCLES.into_iter().cycle().enumerate() {
                if stop.load(Relaxed) {
                    break;
                }
                if cycle == HALTS {
                    std::thread::sleep(HALT);
                    due = Instant::now();
                }
                std::thread::sleep(due.saturating_duration_since(Instant::now()));
                let mut buffers = Buffers { planes: vec![vec![0.0; frames]; outputs], began: due };
                work.cycle(&mut buffers);
                counted.lock().unwrap().count(&buffers.planes, due);
                due += Duration::from_secs_f64(frames as f64 / RATE);
            }
            work
        }));
        Ok(())
    }

    fn remove_work(&mut self) -> Option<Box<dyn Work>> {
        self.stop.store(true, Relaxed);
        self.thread.take()?.join().ok()
    }
}

fn caller(counted: &Arc<Mutex<Counted>>) -> Caller {
    let names = FILM.actuators.iter().map(|actuator| actuator.name.clone()).collect();
    let layout = Layout {
        device: "caller".into(),
        rate: RATE,
        block: 256,
        outputs: names,
        inputs: Vec::new(),
        full_scale: 1.0,
    };
    Caller { layout, counted: counted.clone(), thread: None, stop: Arc::default() }
}

/// Puts a finger down whenever all that the last one set off is over, and notes when.
struct Taps {
    counted: Arc<Mutex<Counted>>,
    asked: Arc<Mutex<Vec<Asked>>>,
    /// How many clicks the play left out, since they would have come a tenth of a second late: on a machine with other work.
    left_out: Arc<AtomicU64>,
    /// When it was last asked how long it can be left alone, and how many samples the device had given.
    left: Mutex<(Instant, u64)>,
}

/// A touch was given at a time of the play's clock, at an instant at which the device stood so.
struct Asked {
    now: f64,
    at: Instant,
    /// Surely before that, and before `now` was looked up; and how many samples the device had given by then.
    before: (Instant, u64),
    stood: (u64, Instant),
    /// Whether its click was left out.
    left_out: bool,
}

/// Whether it is known of all touches what became of them, which is noted of the last.
fn settled(asked: &mut [Asked], onsets: usize, left_out: u64) -> bool {
    if onsets + (left_out as usize) < asked.len() {
        return false;
    }
    let kept = asked.iter().filter(|one| !one.left_out).count();
    if let Some(last) = asked.last_mut().filter(|_| onsets < kept) {
        last.left_out = true;
    }
    true
}

impl Source for Taps {
    fn name(&self) -> &str {
        "taps"
    }

    fn poll(&mut self, now: f64, heard: &mut Heard) {
        let (counted, mut asked) = (self.counted.lock().unwrap(), self.asked.lock().unwrap());
        let finger = asked.len() as u64;
        // None for a while before the device halts, so that one comes as soon as it goes on.
        let halts = (HALTS / 2..=HALTS).contains(&counted.cycles);
        let may = counted.silent > 2000 && finger < TOUCHES && !halts;
        let Some(stood) = counted.last.filter(|_| may) else { return };
        if !settled(&mut asked, counted.onsets.len(), self.left_out.load(Relaxed)) {
            return;
        }
        let at = Point::from_mm(20.0 + 5.0 * finger as f64, 90.0);
        heard.touches.push(Touch { finger, phase: Phase::Down, at, time: now, force: None });
        let before = *self.left.lock().unwrap();
        asked.push(Asked { now, at: Instant::now(), before, stood, left_out: false });
    }

    fn due(&self, now: f64) -> Option<f64> {
        let given = self.counted.lock().unwrap().last.map_or(0, |(given, _)| given);
        *self.left.lock().unwrap() = (Instant::now(), given);
        Some(now + 0.003)
    }

    fn counts(&self) -> Counts {
        Counts::default()
    }
}

#[test]
fn latency_is_what_the_device_counts() {
    let (counted, asked) = (Arc::<Mutex<Counted>>::default(), Arc::<Mutex<Vec<Asked>>>::default());
    let device = caller(&counted);
    let left_out = Arc::<AtomicU64>::default();
    let left = Mutex::new((Instant::now(), 0));
    let taps = Taps { counted: counted.clone(), asked: asked.clone(), left_out: left_out.clone(), left };
    let mut engine = with_device(&clicks(), sources(vec![Box::new(taps)]), Box::new(device));
    let (start, mut looks) = (Instant::now(), 0);
    engine
        .run(None, |stage, _| {
            left_out.store(stage.conductor().tally().stale, Relaxed);
            // One look more, so that all that the player said was heard.
            let over = counted.lock().unwrap().onsets.len() as u64 + left_out.load(Relaxed);
            looks += u64::from(over == TOUCHES);
            looks < 2 && start.elapsed() < Duration::from_secs(60)
        })
        .unwrap();
    let (counted, mut asked) = (counted.lock().unwrap(), asked.lock().unwrap());
    let tally = engine.stage().conductor().tally();
    let said = &tally.first_sample;
    assert!(settled(&mut asked, counted.onsets.len(), tally.stale));
    assert_eq!([asked.len() as u64, said.count() + tally.stale], [TOUCHES; 2]);
    assert_eq!(said.count(), counted.onsets.len() as u64);
    let kept = || asked.iter().filter(|one| !one.left_out);
    // What the play says, worst of all, beside what the device counted for the same touches: a source is asked after it was left alone.
    let worst = |came: fn(&Asked) -> Instant| {
        let late = |(onset, asked): (&Instant, &Asked)| onset.saturating_duration_since(came(asked));
        counted.onsets.iter().zip(kept()).map(late).max().unwrap().as_secs_f64()
    };
    let (least, most, said) = (worst(|asked| asked.at), worst(|asked| asked.before.0), said.worst().unwrap());
    println!("worst latency by the device {least:.6} to {most:.6} s, by the play {said:.6}");
    assert!(least - 1.5 / RATE <= said && said <= most + 1.5 / RATE, "{least} to {most}: {said}");
    // And touches are timed by where the device stood when they came, but for a cycle while it halts.
    for Asked { now, at, before: (_, least), stood: (given, began), .. } in asked.iter() {
        let since = at.saturating_duration_since(*began).as_secs_f64();
        let longest = CYCLES.into_iter().max().unwrap() as f64 / RATE;
        let (least, most) = (*least as f64 / RATE - longest, *given as f64 / RATE + since + longest);
        assert!((least..=most).contains(now), "{now} where the device stood at {least} to {most}");
    }
    assert!(engine.heart().work().count() > 100);
}

/// One finger that stays, and a train under it of which each pulse begins before the last is over, so that there is never silence.
fn steady() -> (EffectSet, Script) {
    let steady = Train { rate: 100.0, count: None, envelope: None, jitter: 0.0, scatter: 0.0, seed: 1 };
    let finger = Script::new(vec![touch(1, Phase::Down, 62.0, 90.0, 0.1)]);
    (one(Kind::Train(steady), Level::Share(0.2)), finger)
}

#[test]
fn the_end_fades_to_silence() {
    let counted = Arc::<Mutex<Counted>>::default();
    let (set, finger) = steady();
    let mut engine = with_device(&set, sources(vec![Box::new(finger)]), Box::new(caller(&counted)));
    let (start, mut before) = (Instant::now(), None);
    engine
        .run(None, |stage, _| {
            let counted = counted.lock().unwrap();
            let sounds = stage.time() > 1.0 && counted.silent == 0 && counted.step > 0.0;
            before = sounds.then_some(counted.step);
            !sounds && start.elapsed() < Duration::from_secs(60)
        })
        .unwrap();
    let counted = counted.lock().unwrap();
    let before = before.expect("it sounds");
    assert!(counted.silent > 0, "cut off in the midst of a wave");
    assert!(counted.step <= 1.01 * before, "a step of {} at the end, {before} while it played", counted.step);
}

/// How a play ended: as it said, or by unwinding.
type Ended = std::thread::Result<Result<(), LiveError>>;

/// Goes wrong, by this, once it has sounded for a second.
struct Wrong {
    counted: Arc<Mutex<Counted>>,
    /// The largest step by then.
    before: Arc<Mutex<Option<f32>>>,
}

impl Wrong {
    /// Whether it is time, which is noted.
    fn is_due(&self, now: f64) -> bool {
        let counted = self.counted.lock().unwrap();
        let due = now > 1.0 && counted.silent == 0 && counted.step > 0.0;
        let mut before = self.before.lock().unwrap();
        if due && before.is_none() {
            *before = Some(counted.step);
        }
        due
    }
}

/// A source that panics.
struct Panics(Wrong);

impl Source for Panics {
    fn name(&self) -> &str {
        "panics"
    }
    fn poll(&mut self, now: f64, _: &mut Heard) {
        assert!(!self.0.is_due(now), "as planned");
    }
    fn due(&self, now: f64) -> Option<f64> {
        Some(now + 0.01)
    }
    fn counts(&self) -> Counts {
        Counts::default()
    }
}

/// One that tells of a finger when nothing of it can be watched any more.
struct Unwatched(Wrong, Handle);

impl Source for Unwatched {
    fn name(&self) -> &str {
        "unwatched"
    }
    fn poll(&mut self, now: f64, heard: &mut Heard) {
        if self.0.is_due(now) {
            // Fewer places than before.
            self.1.watch(&[Point::from_mm(60.0, 60.0)], 4).unwrap();
            heard.touches.push(touch(7, Phase::Down, 60.0, 60.0, now));
        }
    }
    fn due(&self, now: f64) -> Option<f64> {
        Some(now + 0.01)
    }
    fn counts(&self) -> Counts {
        Counts::default()
    }
}

/// Plays on a thread of its own until it ends, with a source besides and with what looks on, and holds the end against a cut.
fn ends_without_a_cut(
    source: impl FnOnce(Wrong, Handle) -> Option<Box<dyn Source>> + Send + 'static,
    look: impl Fn(&Wrong, f64) + Send + 'static,
) -> Ended {
    let (counted, before) = (Arc::<Mutex<Counted>>::default(), Arc::<Mutex<Option<f32>>>::default());
    let wrong = || Wrong { counted: counted.clone(), before: before.clone() };
    let (here, there) = (wrong(), wrong());
    let (ended, end) = mpsc::channel();
    std::thread::spawn(move || {
        let (set, finger) = steady();
        let sheet = common::device();
        let all = [Some(Box::new(finger) as Box<dyn Source>), source(here, sheet.handle())];
        let device = caller(&there.counted);
        let feeler = Feeler::new(sheet.handle(), &FILM, 10).unwrap();
        let all = sources(all.into_iter().flatten().collect());
        let mut engine = with_device(&set, all, Box::new(device)).with_feeler(feeler);
        let run = std::panic::AssertUnwindSafe(|| {
            engine.run(None, |stage, _| {
                look(&there, stage.time());
                true
            })
        });
        let run = std::panic::catch_unwind(run);
        // While the engine is still there.
        ended.send(run).unwrap();
    });
    let end = end.recv_timeout(Duration::from_secs(30)).expect("it goes on as if nothing had happened");
    let (counted, before) = (counted.lock().unwrap(), before.lock().unwrap().expect("it sounded"));
    assert!(counted.silent > 0, "cut off in the midst of a wave");
    assert!(counted.step <= 1.01 * before, "a step of {} at the end, {before} while it played", counted.step);
    end
}

#[test]
fn a_look_that_panics_ends_the_play() {
    let end = ends_without_a_cut(|_, _| None, |wrong, now| assert!(!wrong.is_due(now), "as planned"));
    assert!(end.is_err());
}

#[test]
fn a_source_that_panics_ends_the_play() {
    let end = ends_without_a_cut(|wrong, _| Some(Box::new(Panics(wrong))), |_, _| ());
    assert!(end.is_err());
}

#[test]
fn an_error_ends_the_play_with_a_fade() {
    let end = ends_without_a_cut(|wrong, handle| Some(Box::new(Unwatched(wrong, handle))), |_, _| ());
    assert!(matches!(end, Ok(Err(LiveError::Devices(_)))), "{end:?}");
}
