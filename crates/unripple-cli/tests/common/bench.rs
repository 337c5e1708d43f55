//! A bench for recordings: a small film with five actuators, a folder, and a library that is to come of it.
#![allow(dead_code)] // Each test file uses its own part of this.

use crate::common::{Scratch, run};
use crate::elsewhere::{Elsewhere, bring};
use serde_json::Value;
use std::process::Output;
use unripple::core::Point;
use unripple_store::parse_surface;

pub const SEED: u64 = 5;

/// A small film with five actuators: what is played lasts little.
pub const FILM: &str = r#"
format = 1
name = "small film"

[outline]
rectangle_mm = [110, 90]
edge = "clamped"

[sheet]
material = "BoPET"
thickness_mm = 0.125
tension_n_per_m = 200
decay_time_ms = 40
air = "none"

[drive]
band_hz = [0, 1500]
sample_rate_hz = 48000
limit = 1.0

[[actuator]]
name = "a1"
at_mm = [12, 31]
kind = "force"

[[actuator]]
name = "a2"
at_mm = [31, 80]
kind = "force"

[[actuator]]
name = "a3"
at_mm = [84, 77]
kind = "force"

[[actuator]]
name = "a4"
at_mm = [98, 29]
kind = "force"

[[actuator]]
name = "a5"
at_mm = [47, 9]
kind = "force"
"#;

pub const PLACES: [(f64, f64); 3] = [(52.0, 47.0), (70.0, 38.0), (35.0, 55.0)];

/// A bench with its folder, and a surface on it.
pub struct Bench {
    pub scratch: Scratch,
    pub folder: String,
    pub library: String,
    pub film: String,
    pub surface: Elsewhere,
}

impl Bench {
    /// What is to be played is written, for the first so many places.
    pub fn new(name: &str, places: usize, more: &[&str]) -> Self {
        let scratch = Scratch::new(name);
        let film = scratch.file("film.toml", FILM);
        let (folder, library) = (scratch.join("tape"), scratch.join("film"));
        let planned = run(&Self::command(&film, &folder, &library, places, more)
            .iter()
            .map(String::as_str)
            .collect::<Vec<_>>());
        assert!(planned.status.success(), "{}", String::from_utf8_lossy(&planned.stderr));
        let known = parse_surface(FILM, "film.toml").unwrap();
        let surface = Elsewhere::new(&known, SEED, &format!("{folder}/play.wav"));
        Self { scratch, folder, library, film, surface }
    }

    pub fn command(film: &str, folder: &str, library: &str, places: usize, more: &[&str]) -> Vec<String> {
        let start = ["calibrate", film, "--device", "tape", "--tape", folder, "-o", library];
        let at = PLACES[..places].iter().map(|(x, y)| format!("--at={x},{y}"));
        let owned = |text: &&str| (*text).to_owned();
        start.iter().map(owned).chain(at).chain(more.iter().map(owned)).collect()
    }

    pub fn calibrate(&self, places: usize, more: &[&str]) -> (Output, Value, String) {
        let all = [more, &["--json"]].concat();
        let command = Self::command(&self.film, &self.folder, &self.library, places, &all);
        let output = run(&command.iter().map(String::as_str).collect::<Vec<_>>());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        let told = serde_json::from_slice(&output.stdout).unwrap_or(Value::Null);
        (output, told, said)
    }

    /// What all channels hear with the probe at a place.
    pub fn hear(&mut self, place: usize, seed: u64) -> Vec<Vec<f64>> {
        let (x, y) = PLACES[place];
        self.surface.record(Point::from_mm(x, y), 6_000 + 997 * place, seed)
    }

    /// Recordings of the actuators and of the first so many places, as they are.
    pub fn bring_all(&mut self, places: usize) {
        self.bring_changed(places, |lines| lines);
    }

    pub fn bring_changed(&mut self, places: usize, change: impl Fn(Vec<Vec<f64>>) -> Vec<Vec<f64>>) {
        let own = self.surface.record(Point::from_mm(60.0, 50.0), 9_000, 1);
        bring(&self.folder, "actuators.wav", &change(own));
        for place in 0..places {
            let heard = self.hear(place, 2 + place as u64);
            bring(&self.folder, &format!("point-{:03}.wav", place + 1), &change(heard));
        }
    }

    pub fn focus(&self, more: &[&str]) -> Output {
        let out = self.scratch.join("out");
        let start = ["focus", &self.library, "--at", "52,47", "--window-ms", "30", "-o", &out];
        run(&[&start[..], more].concat())
    }
}
