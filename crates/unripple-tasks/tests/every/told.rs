//! What long computations within a task tell of themselves, to those who run the task on their own thread and to those who do not.

use std::sync::{Arc, Mutex};
use unripple::core::Observer;
use unripple_tasks::{Progress, apart, modes, observed};

/// What was told: stages, and parts of stages by those who are told of them apart.
#[derive(Default)]
struct Log {
    stages: Vec<String>,
    parts: Vec<String>,
    /// Shares of each stage or part, with the number of stages and parts that had begun before.
    shares: Vec<(usize, f64)>,
}

impl Log {
    fn share(&mut self, share: f64) {
        self.shares.push((self.stages.len() + self.parts.len(), share));
    }

    /// Every share is one, and none of a part falls.
    fn hold(&self) {
        assert!(!self.shares.is_empty() && self.shares.iter().all(|(_, share)| (0.0..=1.0).contains(share)));
        let falls = self.shares.windows(2).any(|pair| pair[0].0 == pair[1].0 && pair[1].1 < pair[0].1);
        assert!(!falls, "{:?}", self.shares);
    }
}

/// Progress as Python has it, which shows stages alone.
struct Plain(Log);

impl Progress for Plain {
    fn stage(&mut self, what: &str) {
        self.0.stages.push(what.into());
    }

    fn done(&mut self, share: f64) {
        self.0.share(share);
    }
}

/// Progress that is told of parts from any thread.
#[derive(Clone, Default)]
struct Watching(Arc<Mutex<Log>>);

impl Observer for Watching {
    fn part(&self, what: &str) {
        self.0.lock().unwrap().parts.push(what.into());
    }

    fn done(&self, share: f64) {
        self.0.lock().unwrap().share(share);
    }
}

impl Progress for Watching {
    fn stage(&mut self, what: &str) {
        self.0.lock().unwrap().stages.push(what.into());
    }

    fn observer(&self) -> Option<Arc<dyn Observer>> {
        Some(Arc::new(self.clone()))
    }
}

/// A sheet that takes several meshes, whose modes are found from several shifts.
fn ask() -> modes::Ask {
    modes::Ask { surface: "stadium-film".into(), top_hz: Some(2000.0), accuracy: Some(1e-4) }
}

fn meshes_and_shifts<'a>(parts: impl Iterator<Item = &'a String> + Clone) {
    for part in ["mesh 1 of 8 at most: ", "mesh 2 of 8 at most: ", " unknowns: ", " modes from ", "triangles"]
    {
        assert!(parts.clone().any(|told| told.contains(part)), "{part}: {:?}", parts.collect::<Vec<_>>());
    }
}

#[test]
fn a_task_tells_the_parts_of_its_stages() {
    let mut watching = Watching::default();
    let told = watching.clone();
    observed(&mut watching, |progress| modes::run(&ask(), progress)).unwrap();
    let log = told.0.lock().unwrap();
    assert_eq!(log.stages, ["modes"]);
    meshes_and_shifts(log.parts.iter());
    // Alone, nobody is told.
    drop(log);
    modes::run(&ask(), &mut watching).unwrap();
    assert_eq!(told.0.lock().unwrap().stages, ["modes", "modes"]);
}

#[test]
fn a_task_on_a_thread_of_its_own_tells_them_as_stages() {
    let mut plain = Plain(Log::default());
    apart(ask(), modes::run, &mut plain).unwrap();
    let log = plain.0;
    assert_eq!(log.stages[0], "modes");
    let of_stage = |stage: &String| {
        stage.starts_with("modes: mesh ") || (stage.starts_with("modes: ") && stage.ends_with(" loads"))
    };
    assert!(log.stages[1..].iter().all(of_stage), "{:?}", log.stages);
    meshes_and_shifts(log.stages.iter());
    log.hold();
}
