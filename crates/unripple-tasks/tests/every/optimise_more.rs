//! Searches over libraries of responses, when searches are over, and what optimisers are told.

use super::searches::{Scratch, question};
use super::sweeps_of_files::library;
use serde_json::Value;
use std::cell::{Cell, RefCell};
use std::fs;
use std::path::Path;
use unripple_tasks::optimise::{Answer, Ask, Asker, EndedBy, Question, run_with};
use unripple_tasks::{Report as _, Silent, TaskError};

/// The window and the method that make most contrast from measured responses.
const OF_LIBRARY: &str = r#"format = 1
task = "focus"
surface = "library"
ask = { points = [{ at_m = [0.06, 0.09] }] }
optimise = { generations = 1 }
[[objective]]
figure = "/targets/0/contrast"
want = "most"
[[axis]]
ask = "window_s"
from = 0.005
to = 0.02
[[axis]]
ask = "method"
values = ["time-reversal", "one-bit"]
"#;

#[test]
fn options_of_a_command_are_searched_on_a_library() {
    let scratch = Scratch::new("search-library");
    library(&scratch.0.join("library"));
    let own = |folder: &Path, generation: usize| -> Result<(), TaskError> {
        let mut text = question(folder, generation)["head"].as_str().unwrap().to_owned();
        for (window_s, method) in [(0.01, "one-bit"), (0.01, "time-reversal"), (0.008, "time-reversal")] {
            text += &format!("[[design]]\n\"ask:window_s\" = {window_s}\n\"ask:method\" = \"{method}\"\n");
        }
        fs::write(folder.join("asked/0.toml"), text).unwrap();
        Ok(())
    };
    let ask: Ask = scratch.ask(OF_LIBRARY, "out");
    let report = run_with(&ask, &own, None, &mut Silent).unwrap();
    assert_eq!((report.designs, report.failed, &report.best_surface), (3, 0, &None), "{report:?}");
    // One bit of each sample has less contrast than all of it.
    let best = report.best.unwrap();
    assert!(best.index > 0 && best.varied[1].value == "time-reversal", "{best:?}");
    let key = OF_LIBRARY.replace("ask = \"window_s\"", "key = \"sheet.thickness_mm\"");
    let refused = run_with(&scratch.ask(&key, "keys"), &own, None, &mut Silent).unwrap_err();
    assert!(refused.is_bad_input() && refused.to_string().contains("options of the task alone"), "{refused}");
}

/// The film of the paper whose first mode is lowest, by its tension.
const TENSION: &str = r#"format = 1
task = "modes"
surface = "hudin-2012"
ask = { top_hz = 250 }
optimise = { generations = 8 }
[[objective]]
figure = "/frequencies_hz/0"
want = "least"
[[axis]]
key = "sheet.tension_n_per_m"
from = 100
to = 400
"#;

/// Writes the plan of a generation with one design, by the question for it.
fn put(folder: &Path, generation: usize, question: &Value, tension: f64) {
    let head = question["head"].as_str().unwrap();
    let text = format!("{head}[[design]]\n\"surface:sheet.tension_n_per_m\" = {tension}\n");
    fs::write(folder.join(format!("asked/{generation}.toml")), text).unwrap();
}

#[test]
fn a_search_is_over_once_it_does_not_improve_any_more() {
    let scratch = Scratch::new("search-stop");
    // 300, 200, 150, 125, and 125 from then on.
    let own = |folder: &Path, generation: usize| -> Result<(), TaskError> {
        let tension = 100.0 + 200.0 / f64::from(1u32 << generation.min(3));
        put(folder, generation, &question(folder, generation), tension);
        Ok(())
    };
    let ask = Ask { stop_after: Some(2), ..scratch.ask(TENSION, "out") };
    let report = run_with(&ask, &own, None, &mut Silent).unwrap();
    assert_eq!((report.done, report.to_ask), (6, None), "{report:?}");
    let ended = report.ended.clone().unwrap();
    assert_eq!(ended.by, EndedBy::NoImprovement);
    assert!(ended.why.contains("no more than 0.1 % than 2 generations before"), "{}", ended.why);
    assert!(report.text().contains(&ended.why), "{}", report.text());
    // It goes on if somebody wants it to, and is as long as it is then.
    let report = run_with(&scratch.ask(TENSION, "out"), &own, None, &mut Silent).unwrap();
    assert_eq!((report.done, report.ended.map(|end| end.by)), (8, Some(EndedBy::Generations)));
    let report = run_with(&ask, &own, None, &mut Silent).unwrap();
    assert_eq!((report.done, report.ended.map(|end| end.by)), (8, Some(EndedBy::Generations)));
    let refused = Ask { stop_after: Some(0), ..scratch.ask(TENSION, "none") };
    let error = run_with(&refused, &own, None, &mut Silent).unwrap_err();
    assert!(error.is_bad_input() && !scratch.0.join("none").exists(), "{error}");
}

/// An optimiser that keeps what it has been told, and has nothing more to ask for after three generations.
#[derive(Default)]
struct Keeping {
    /// For each question: how many generations it leaves out, and how many it tells.
    heard: RefCell<Vec<(usize, usize)>>,
    known: Cell<usize>,
}

impl Asker for Keeping {
    fn ask(&self, question: &Question<'_>) -> Result<Answer, TaskError> {
        let line: Value = serde_json::from_str(&question.json(self.known.get())?).unwrap();
        let told = line["told"].as_array().unwrap();
        self.heard.borrow_mut().push((self.known.get(), told.len()));
        assert_eq!(line["since"].as_u64(), Some(self.known.get() as u64));
        self.known.set(question.generation());
        if question.generation() == 3 {
            return Ok(Answer::Over("that was enough".into()));
        }
        put(question.folder(), question.generation(), &line, 150.0 + question.generation() as f64);
        Ok(Answer::Asked)
    }
}

#[test]
fn an_optimiser_is_told_each_generation_once_and_may_end_the_search() {
    let scratch = Scratch::new("search-kept");
    let ask = scratch.ask(TENSION, "out");
    let own = Keeping::default();
    let report = run_with(&ask, &own, None, &mut Silent).unwrap();
    assert_eq!(*own.heard.borrow(), [(0, 0), (0, 1), (1, 1), (2, 1)]);
    assert_eq!((report.done, report.to_ask), (3, None));
    let ended = report.ended.as_ref().unwrap();
    assert_eq!((ended.by, ended.why.as_str()), (EndedBy::Optimiser, "that was enough"));
    assert!(report.text().contains("that was enough"), "{}", report.text());
    // Another one is told everything, and says so again.
    let another = Keeping::default();
    let again = run_with(&ask, &another, None, &mut Silent).unwrap();
    assert_eq!((&*another.heard.borrow(), &again.ended), (&vec![(0, 3)], &report.ended));
    // Nobody else is asked by a file.
    assert!(!scratch.0.join("out/asked/3.json").exists());
    let open = run_with(&Ask { no_ask: true, ..ask }, &another, None, &mut Silent).unwrap();
    assert_eq!((open.to_ask, open.ended), (Some(3), None));
    assert_eq!(question(&scratch.0.join("out"), 3)["told"].as_array().unwrap().len(), 3);
}
