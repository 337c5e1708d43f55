//! Searches over libraries of responses.

use super::searches::{Scratch, question};
use super::sweeps_of_files::library;
use std::fs;
use std::path::Path;
use unripple_tasks::optimise::{Ask, run_with};
use unripple_tasks::{Silent, TaskError};

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
