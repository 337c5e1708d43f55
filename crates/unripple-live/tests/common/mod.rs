//! A film that is played, in a band low enough to be quick.
#![allow(dead_code)] // Each test file uses its own part of this.

use std::sync::{Arc, LazyLock};
use unripple_core::{Device, Phase, Point, Responses, Surface, Touch};
use unripple_devices::{Feeler, Virtual, VirtualOptions};
use unripple_effects::{Button, Effect, EffectSet, Kind, Level, Region};
use unripple_live::{Engine, FocusWorker, LiveOptions};
use unripple_physics::design::papers_surface;
use unripple_physics::{ResponseOptions, StepperOptions, responses};
use unripple_touch::{Counts, Heard, Source, Sources};

pub const BLOCK: usize = 64;
pub const RATE: f64 = 48e3;
pub const WINDOW: f64 = 0.020;

pub static FILM: LazyLock<Surface> = LazyLock::new(|| {
    let mut film = papers_surface();
    film.emission.band[1] = 1500.0;
    film
});

pub static KNOWN: LazyLock<Arc<Responses>> =
    LazyLock::new(|| Arc::new(responses(&FILM, &ResponseOptions::default()).unwrap()));

/// Touches laid out beforehand.
pub struct Script {
    pub touches: Vec<Touch>,
    next: usize,
}

impl Script {
    pub fn new(touches: Vec<Touch>) -> Self {
        Self { touches, next: 0 }
    }
}

impl Source for Script {
    fn name(&self) -> &str {
        "script"
    }

    fn poll(&mut self, now: f64, heard: &mut Heard) {
        while let Some(touch) = self.touches.get(self.next).filter(|touch| touch.time <= now) {
            heard.touches.push(*touch);
            self.next += 1;
        }
    }

    fn counts(&self) -> Counts {
        Counts { touches: self.next as u64, ..Counts::default() }
    }
}

pub fn touch(finger: u64, phase: Phase, x: f64, y: f64, time: f64) -> Touch {
    Touch { finger, phase, at: Point::from_mm(x, y), time, force: None }
}

pub fn sources(all: Vec<Box<dyn Source>>) -> Sources {
    let mut sources = Sources::new(&FILM.outline);
    all.into_iter().for_each(|source| sources.push(source));
    sources
}

/// A click wherever a finger comes down, a softer one where it leaves.
pub fn clicks() -> EffectSet {
    one(Kind::Button(Button { press_force: None, release: 0.5 }), Level::Share(0.4))
}

pub fn one(kind: Kind, level: Level) -> EffectSet {
    let effect = Effect { name: "it".into(), region: Region::Everywhere, level, kind };
    EffectSet { name: "one".into(), about: String::new(), effects: vec![effect] }
}

pub fn device() -> Virtual {
    let stepper = StepperOptions { max_fingers: 24, ..StepperOptions::default() };
    Virtual::new(&FILM, &VirtualOptions { block: BLOCK, stepper, ..VirtualOptions::default() }).unwrap()
}

pub fn engine(set: &EffectSet, sources: Sources) -> Engine {
    let device = device();
    let feeler = Feeler::new(device.handle(), &FILM, 10).unwrap();
    with_device(set, sources, Box::new(device)).with_feeler(feeler)
}

pub fn with_device(set: &EffectSet, sources: Sources, device: Box<dyn Device>) -> Engine {
    let options = LiveOptions::new(&FILM, WINDOW);
    let maker = FocusWorker::new(KNOWN.clone(), &options.focus).unwrap();
    Engine::new(&FILM, maker, set, sources, device, &options).unwrap()
}

/// All that an engine drives in some blocks, a line for each actuator.
pub fn play(engine: &mut Engine, blocks: usize) -> Vec<Vec<f32>> {
    let mut lines = vec![Vec::new(); FILM.actuators.len()];
    for _ in 0..blocks {
        engine.step().unwrap();
        for (line, plane) in lines.iter_mut().zip(engine.heart().drive().chunks_exact(BLOCK)) {
            line.extend_from_slice(plane);
        }
    }
    lines
}
