//! Searches: whoever asks, designs are computed once, a search that was cut short goes on to the same table, and bad plans are refused.

use super::sweeps_of_files::film;
use serde_json::Value;
use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};
use unripple_tasks::optimise::{Ask, Report, run_with};
use unripple_tasks::sweep::Plan;
use unripple_tasks::{Progress, Record, Report as _, Silent, TaskError, commands};

/// A folder of a test's own, gone afterwards.
pub(crate) struct Scratch(pub(crate) PathBuf);

impl Scratch {
    pub(crate) fn new(name: &str) -> Self {
        let folder = super::folder(name);
        fs::create_dir(&folder).unwrap();
        Self(folder)
    }

    /// The request for a plan of this text, whose designs go to a folder.
    pub(crate) fn ask(&self, plan: &str, output: &str) -> Ask {
        let file = self.0.join("plan.toml");
        fs::write(&file, plan).unwrap();
        Ask { plan: file, output: Some(self.0.join(output)), no_figures: true, ..Ask::default() }
    }

    pub(crate) fn read(&self, file: &str) -> String {
        fs::read_to_string(self.0.join(file)).unwrap()
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// The first mode of a film is lower the less it is stretched; below a bound of the second figure.
const PLAN: &str = r#"format = 1
task = "modes"
surface = "hudin-2012"
ask = { top_hz = 250 }
figures = ["/count"]
[optimise]
generations = 5
[[objective]]
figure = "/frequencies_hz/0"
want = "least"
[[constraint]]
figure = "/decay_times_s/0"
at_least = 0.001
[[axis]]
key = "sheet.tension_n_per_m"
from = 100
to = 400
[[axis]]
key = "sheet.material"
values = ["BoPET", "no such material"]
"#;

/// The question of a generation.
pub(crate) fn question(folder: &Path, generation: usize) -> Value {
    let text = fs::read_to_string(folder.join(format!("asked/{generation}.json"))).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// Asks for designs with these tensions and materials.
fn put(folder: &Path, generation: usize, designs: &[(f64, &str)]) {
    let question = question(folder, generation);
    let mut text = format!("# asked for by a test\n{}", question["head"].as_str().unwrap());
    for (tension, material) in designs {
        text += &format!(
            "[[design]]\n\"surface:sheet.tension_n_per_m\" = {tension}\n\"surface:sheet.material\" = \"{material}\"\n"
        );
    }
    fs::write(folder.join(format!("asked/{generation}.toml")), text).unwrap();
}

/// Asks for the tension half-way from the best one that was told to the least, that best one again, and one that fails.
fn halving(folder: &Path, generation: usize) -> Result<(), TaskError> {
    let question = question(folder, generation);
    assert_eq!(question["told"].as_array().unwrap().len(), generation);
    let told = question["told"].as_array().unwrap().iter().flat_map(|told| told.as_array().unwrap());
    let of = |design: &Value| Some((design["losses"][0].as_f64()?, design["values"][0].as_f64().unwrap()));
    let best = told.filter_map(of).min_by(|one, other| one.0.total_cmp(&other.0));
    let tension = best.map_or(400.0, |(_, tension)| tension);
    put(
        folder,
        generation,
        &[(0.5 * (tension + 100.0), "BoPET"), (tension, "BoPET"), (tension, "no such material")],
    );
    Ok(())
}

fn searched(ask: &Ask) -> Report {
    run_with(ask, &halving, None, &mut Silent).unwrap()
}

/// Cancels after so many looks.
struct After(Cell<usize>);

impl Progress for After {
    fn cancelled(&self) -> bool {
        self.0.set(self.0.get().saturating_sub(1));
        self.0.get() == 0
    }
}

/// Number of lines of a table, its heading among them: texts of errors may have several of their own, which end otherwise.
fn lines(table: &str) -> usize {
    table.matches("\r\n").count()
}

#[test]
fn a_search_tells_what_it_has_computed_and_reports_the_best() {
    let scratch = Scratch::new("search-best");
    let report = searched(&Ask { no_figures: false, ..scratch.ask(PLAN, "out") });
    assert_eq!((report.done, report.generations, report.to_ask), (5, 5, None));
    assert_eq!(
        (report.designs, report.failed, report.optimisers.as_slice()),
        (15, 5, &["a test".to_owned()][..])
    );
    assert!(report.failures[0].error.contains("no such material"), "{}", report.failures[0].error);
    // 400, 250, 175, 137.5, 118.75, 109.375.
    let best = report.best.as_ref().unwrap();
    assert_eq!((best.index, best.generation, best.varied[0].value.as_f64()), (12, 4, Some(109.375)));
    assert_eq!((report.front.len(), &report.front[0]), (1, best));
    let names: Vec<&str> = best.figures.iter().map(|figure| figure.name.as_str()).collect();
    assert_eq!(names, ["/frequencies_hz/0", "/decay_times_s/0", "/count"]);
    assert!(report.history.windows(2).all(|pair| pair[0].best > pair[1].best), "{:?}", report.history);
    assert_eq!(report.history[4].best, best.figures[0].value.as_f64());
    let text = scratch.read("out/best.toml");
    assert!(text.contains("tension_n_per_m = 109.375") && Some(&text) == report.best_surface.as_ref());
    assert!(report.text().contains("best, design 12") && report.failure().is_none(), "{}", report.text());
    assert!(report.files.iter().any(|file| file == "optimise.svg"), "{report:?}");
    let table = scratch.read("out/table.csv");
    assert!(table.starts_with(
        "index,generation,surface:sheet.tension_n_per_m,surface:sheet.material,hash,version,/frequencies_hz/0,/decay_times_s/0,/count,violation,error\r\n0,0,250,BoPET,"
    ));
    assert_eq!(lines(&table), 16);
    assert!(!scratch.0.join("out/asked/0.json").exists());
}

#[test]
fn a_search_that_was_cut_short_goes_on_to_the_same_table() {
    let scratch = Scratch::new("search-cut");
    searched(&scratch.ask(PLAN, "whole"));
    let ask = scratch.ask(PLAN, "cut");
    let (mut looks, mut cuts) = (2, 0);
    while let Err(error) = run_with(&ask, &halving, None, &mut After(Cell::new(looks))) {
        assert!(matches!(error, TaskError::Cancelled), "{error}");
        (looks, cuts) = (looks + 1, cuts + 1);
        assert!(looks < 1000);
    }
    assert!(cuts > 4, "it was cut short {cuts} times");
    // Between generations, too: who asks is another program.
    let asked = Cell::new(false);
    let once = |folder: &Path, generation: usize| match asked.replace(true) {
        false => halving(folder, generation),
        true => Err(TaskError::Work("gone".into())),
    };
    for turn in 1..5 {
        asked.set(false);
        let error = run_with(&scratch.ask(PLAN, "between"), &once, None, &mut Silent).unwrap_err();
        assert_eq!(error.to_string(), "gone");
        assert_eq!(lines(&scratch.read("between/table.csv")), 1 + 3 * turn);
    }
    let report =
        run_with(&Ask { no_ask: true, ..scratch.ask(PLAN, "between") }, &once, None, &mut Silent).unwrap();
    assert_eq!((report.done, report.to_ask), (4, Some(4)));
    searched(&scratch.ask(PLAN, "between"));
    let whole = scratch.read("whole/table.csv");
    assert_eq!(whole, scratch.read("cut/table.csv"));
    assert_eq!(whole, scratch.read("between/table.csv"));
}

#[test]
fn a_design_that_is_asked_for_again_is_not_computed_again() {
    let scratch = Scratch::new("search-again");
    let ask = scratch.ask(&PLAN.replace("generations = 5", "generations = 2"), "out");
    let same = |folder: &Path, generation: usize| -> Result<(), TaskError> {
        put(folder, generation, &[(200.0, "BoPET")]);
        Ok(())
    };
    run_with(&Ask { no_ask: true, ..ask.clone() }, &same, None, &mut Silent).unwrap();
    same(&scratch.0.join("out"), 0).unwrap();
    run_with(&Ask { no_ask: true, ..ask.clone() }, &same, None, &mut Silent).unwrap();
    // What stands in for a computation that nobody repeats.
    let part = scratch.0.join("out/generations/0/parts/0.jsonl");
    let marked = fs::read_to_string(&part).unwrap().replace("\"/count\":", "\"/count\":1000");
    fs::write(&part, marked).unwrap();
    let report = run_with(&ask, &same, None, &mut Silent).unwrap();
    assert_eq!((report.designs, report.front.len()), (2, 1));
    assert!(scratch.read("out/generations/1/parts/0.jsonl").contains("\"/count\":1000"));
}

/// A search of the better one of two surfaces to compare with a first one.
const COMPARE: &str = r#"format = 1
task = "compare"
surface = "first.toml"
[optimise]
generations = 1
[ask]
points = [{ at_m = [0.062, 0.09] }]
methods = ["concentrate"]
no_tradeoffs = true
[[objective]]
figure = "/surfaces/1/methods/0/contrast_at_limit"
want = "most"
[[axis]]
ask = "others"
values = [["low.toml"], ["high.toml"]]
"#;

#[test]
fn files_are_named_from_the_folder_of_the_plan_and_a_change_is_noticed() {
    let scratch = Scratch::new("search-files");
    for (name, tension) in [("first", 200.0), ("low", 150.0), ("high", 300.0)] {
        fs::write(scratch.0.join(format!("{name}.toml")), film(name, tension)).unwrap();
    }
    let ask = scratch.ask(COMPARE, "some/out");
    let both = |folder: &Path, generation: usize| -> Result<(), TaskError> {
        let head = question(folder, generation)["head"].as_str().unwrap().to_owned();
        let designs = ["low", "high"].map(|name| format!("[[design]]\n\"ask:others\" = [\"{name}.toml\"]\n"));
        fs::write(folder.join("asked/0.toml"), format!("{head}{}", designs.concat())).unwrap();
        Ok(())
    };
    let report = run_with(&ask, &both, None, &mut Silent).unwrap();
    assert_eq!((report.designs, report.failed), (2, 0), "{report:?}");
    // The folder may be moved, though its plans say where files are from where it was.
    fs::rename(scratch.0.join("some/out"), scratch.0.join("moved")).unwrap();
    let moved = run_with(&scratch.ask(COMPARE, "moved"), &both, None, &mut Silent).unwrap();
    assert_eq!((moved.designs, &moved.best), (2, &report.best));
    fs::rename(scratch.0.join("moved"), scratch.0.join("some/out")).unwrap();
    let read: Vec<_> = Record::of(&ask).unwrap().files.into_iter().map(|file| file.path).collect();
    let named = ["plan.toml", "first.toml", "low.toml", "high.toml"];
    assert_eq!(read, named.map(|name| scratch.0.join(name)));
    let hash = || Plan::open(&scratch.0.join("some/out/asked/0.toml")).unwrap().design(1).hash;
    let before = hash();
    assert!(scratch.read("some/out/table.csv").contains(&before));
    fs::write(scratch.0.join("high.toml"), film("high", 310.0)).unwrap();
    assert_ne!(hash(), before);
    let refused = run_with(&ask, &both, None, &mut Silent).unwrap_err().to_string();
    assert!(refused.contains("expected rows of this plan"), "{refused}");
}

#[test]
fn a_search_may_be_made_longer_and_no_other_goes_into_its_folder() {
    let scratch = Scratch::new("search-longer");
    searched(&scratch.ask(&PLAN.replace("generations = 5", "generations = 3"), "out"));
    let first = scratch.read("out/table.csv");
    let report = searched(&scratch.ask(PLAN, "out"));
    assert_eq!(report.designs, 15);
    let whole = scratch.read("out/table.csv");
    assert!(whole.starts_with(&first));
    let refused = |plan: &str| run_with(&scratch.ask(plan, "out"), &halving, None, &mut Silent).unwrap_err();
    let error = refused(&PLAN.replace("generations = 5", "generations = 5\nseed = 2"));
    assert!(error.is_bad_input() && error.to_string().contains("found those of another"), "{error}");
    let other = scratch.read("out/asked/4.toml").replace("top_hz\" = 250", "top_hz\" = 251");
    fs::write(scratch.0.join("out/asked/4.toml"), other).unwrap();
    let error = refused(PLAN);
    assert!(error.to_string().contains("asked/4.toml: expected designs of this search"), "{error}");
    // No shorter table takes the place of one that is whole.
    assert_eq!(scratch.read("out/table.csv"), whole);
}

#[test]
fn generations_beyond_those_of_a_shorter_plan_are_left_out_with_a_note() {
    let scratch = Scratch::new("search-shorter");
    let of = |number: usize| PLAN.replace("generations = 5", &format!("generations = {number}"));
    let longer = searched(&scratch.ask(&of(3), "out"));
    assert!(longer.notes.iter().all(|note| note.topic != "generations"), "{:?}", longer.notes);
    for (number, expected) in
        [(2, "1 later generation in"), (1, "2 later generations in the folder are left out")]
    {
        let shorter = searched(&scratch.ask(&of(number), "out"));
        assert!(shorter.text().contains(&format!("note, generations: {expected}")), "{}", shorter.text());
        assert_eq!(shorter.designs, number * longer.designs / 3);
    }
}

#[test]
fn the_front_of_two_objectives_is_reported_and_drawn() {
    let scratch = Scratch::new("search-front");
    let second = "[[objective]]\nfigure = \"/decay_times_s/0\"\nwant = \"most\"\n[[constraint]]";
    let plan = PLAN.replace("[[constraint]]", second).replace("generations = 5", "generations = 1");
    let ask = Ask { no_figures: false, ..scratch.ask(&plan, "out") };
    let own = |folder: &Path, generation: usize| -> Result<(), TaskError> {
        put(
            folder,
            generation,
            &[(150.0, "BoPET"), (400.0, "BoPET"), (300.0, "no such material"), (150.0, "BoPET")],
        );
        Ok(())
    };
    let report = run_with(&ask, &own, None, &mut Silent).unwrap();
    assert_eq!((report.best.as_ref(), report.best_surface.as_ref(), report.failed), (None, None, 1));
    let values = |index: usize| -> Vec<f64> {
        let table = scratch.read("out/table.csv");
        let line = table.lines().nth(index + 1).unwrap().to_owned();
        line.split(',').skip(6).take(2).map(|field| field.parse().unwrap()).collect()
    };
    let (low, high) = (values(0), values(1));
    assert!(low[0] < high[0]);
    // Whichever decays longer: a design that is better in both stands alone; of two equal ones the first counts.
    let expected: &[usize] = if high[1] > low[1] { &[0, 1] } else { &[0] };
    assert_eq!(report.front.iter().map(|good| good.index).collect::<Vec<_>>(), expected);
    assert!(report.files.iter().any(|file| file == "optimise.svg"), "{report:?}");
    assert!(report.text().contains("that no other one is better than"), "{}", report.text());
}

#[test]
fn bad_plans_are_refused_with_their_place() {
    let scratch = Scratch::new("search-bad");
    let axes = PLAN.find("[[axis]]").unwrap();
    let cases = [
        (
            PLAN.replace("figure = \"/frequencies_hz/0\"\n", ""),
            "plan.toml:8:1: objective[0].figure: expected a JSON pointer",
        ),
        (PLAN.replace("want = \"least\"", "want = \"lest\""), "(nearest: \"least\")"),
        (PLAN[..axes].to_owned(), "axis: expected tables headed [[axis]]"),
        (PLAN.replace("to = 400\n", ""), "axis[0]: expected values, or from and to"),
        (PLAN.replace("to = 400", "to = 400\nsteps = 3"), "expected no steps"),
        (
            PLAN.replace("[\"BoPET\", \"no such material\"]", "[\"BoPET\"]"),
            "at least two values to choose from",
        ),
        (
            PLAN.replace("[\"BoPET\", \"no such material\"]", "[-1e308, 1, 1e100]"),
            "axis[1].values[0]: expected a number from -1.0e100 to 1.0e100",
        ),
        (
            PLAN.replace("generations = 5", "generations = 5\npopulation = 0"),
            "optimise.population: expected a whole number from 4",
        ),
        (
            PLAN.replace("generations = 5", "generations = 0"),
            "optimise.generations: expected a whole number from 1",
        ),
        (PLAN.replace("generations = 5\n", ""), "optimise.generations: expected"),
        (PLAN.replace("at_least = 0.001\n", ""), "constraint[0]: expected at_least or at_most"),
        (PLAN.replace("at_least = 0.001", "at_least = 2\nat_most = 1"), "no figure is within these bounds"),
        (PLAN.replace("sheet.tension_n_per_m", "sheet.tensio_n_per_m"), "(nearest: tension_n_per_m)"),
        (PLAN.replace("/frequencies_hz/0", "/methods/0/plan_s"), "a time by the clock"),
        (
            PLAN.replace("[optimise]\ngenerations = 5\n", ""),
            "optimise: expected a table with the number of generations",
        ),
    ];
    for (plan, expected) in cases {
        let refused = run_with(&scratch.ask(&plan, "out"), &halving, None, &mut Silent).unwrap_err();
        assert!(refused.is_bad_input(), "{refused}");
        assert!(refused.to_string().contains(expected), "{expected}: {refused}");
    }
    assert!(!scratch.0.join("out").exists());
    // A plan of one kind is refused as one of the other, with what computes it.
    let plan = scratch.ask(PLAN, "out").plan;
    let refused =
        commands::run("sweep", serde_json::json!({ "plan": plan, "count": true }), &mut Silent).unwrap_err();
    assert!(refused.to_string().contains("`unripple optimise` computes this one"), "{refused}");
}

#[test]
fn a_search_needs_a_folder() {
    let scratch = Scratch::new("search-nowhere");
    let ask = Ask { output: None, ..scratch.ask(PLAN, "out") };
    let refused = run_with(&ask, &halving, None, &mut Silent).unwrap_err();
    assert_eq!(refused.to_string(), "output: expected a folder for the designs, found none");
}
