//! Commands by their names: their asks are whole, and what comes of them is what their functions return.

use super::{Gone, folder};
use serde_json::{Value, json};
use std::fmt::Debug;
use unripple_tasks::record::Request;
use unripple_tasks::*;

/// Holds that the request of a command by its name is that of its type.
fn whole<A: Request + Default + PartialEq + Debug>() {
    assert!(commands::COMMANDS.contains(&A::COMMAND));
    let ask = commands::default_ask(A::COMMAND).unwrap();
    assert_eq!(commands::asked::<A>(ask).unwrap(), A::default());
}

#[test]
fn the_ask_of_every_command_is_that_of_its_task() {
    whole::<check::Ask>();
    whole::<design::Ask>();
    whole::<modes::Ask>();
    whole::<materials::Ask>();
    whole::<place::Ask>();
    whole::<sensors::Ask>();
    whole::<focus::Ask>();
    whole::<waveform::Ask>();
    whole::<stroke::Ask>();
    whole::<field::Ask>();
    whole::<compare::Ask>();
    whole::<respond::Ask>();
    whole::<calibrate::Ask>();
    whole::<import::Ask>();
    whole::<fit::Ask>();
    whole::<listen::Ask>();
    whole::<fit_modes::Ask>();
    whole::<export::Ask>();
    whole::<verify::Ask>();
    whole::<drift::Ask>();
    whole::<doctor::Ask>();
    whole::<devices::Ask>();
    whole::<play::Ask>();
    whole::<sweep::Ask>();
    whole::<optimise::Ask>();
    whole::<rerun::Ask>();
    assert_eq!(commands::COMMANDS.len(), 26);
}

#[test]
fn asks_have_every_field_and_no_other() {
    for command in commands::COMMANDS {
        let mut ask = commands::default_ask(command).unwrap();
        let mut had: Vec<String> = ask.as_object().unwrap().keys().cloned().collect();
        ask["no_such_key"] = 1.into();
        let refused = commands::run(command, ask, &mut Gone).unwrap_err();
        assert!(matches!(refused, TaskError::Input(_)), "{refused:?}");
        let refused = refused.to_string();
        // The command, the key that there is not, and those that there are.
        let mut quoted = refused.split('`').skip(1).step_by(2).map(str::to_owned);
        assert_eq!(
            (quoted.next().as_deref(), quoted.next().as_deref()),
            (Some(command), Some("no_such_key"))
        );
        let mut known: Vec<String> = quoted.collect();
        had.sort();
        known.sort();
        assert_eq!(had, known, "{command}");
    }
}

/// A report without the time at which it was made.
fn undated(text: &str) -> Value {
    let mut report: Value = serde_json::from_str(text).unwrap();
    assert!(report["run"].as_object_mut().unwrap().remove("date").is_some());
    report
}

/// Does a task by its name, and holds that it is what its function returns.
fn agrees<A: Request, R: Report>(
    ask: &A,
    run: fn(&A, &mut dyn Progress) -> Result<R, TaskError>,
) -> commands::Done {
    let done = commands::run(A::COMMAND, serde_json::to_value(ask).unwrap(), &mut Silent).unwrap();
    let (record, report) = (Record::of(ask).unwrap(), run(ask, &mut Silent).unwrap());
    assert_eq!(undated(&done.json), undated(&record.json(&report).unwrap()));
    assert_eq!((&done.text, &done.failure), (&report.text(), &report.failure()));
    done
}

#[test]
fn commands_return_what_their_tasks_do() {
    let surface = SurfaceAsk::Name("hudin-2012".into());
    agrees(&check::Ask { surface: surface.clone() }, check::run);
    agrees(&design::Ask { surface }, design::run);
    agrees(&materials::Ask { name: Some("glass".into()) }, materials::run);
    let wrong = SurfaceAsk::Text { toml: "format = 1\n".into(), name: Some("empty.toml".into()) };
    let faulty = agrees(&check::Ask { surface: wrong.clone() }, check::run);
    assert!(faulty.failure.is_some() && faulty.text.contains("empty.toml"), "{faulty:?}");
    let ask = json!({ "surface": wrong });
    assert!(matches!(commands::run("design", ask, &mut Silent), Err(TaskError::Faults(_))));
}

#[test]
fn a_run_is_repeated_by_name() {
    let done = agrees(&modes::Ask { top_hz: Some(300.0), ..modes::Ask::default() }, modes::run);
    let file = folder("by-name").with_extension("json");
    std::fs::write(&file, &done.json).unwrap();
    let again = commands::run("rerun", json!({ "report": file }), &mut Silent).unwrap();
    std::fs::remove_file(file).unwrap();
    assert_eq!(undated(&again.json), undated(&done.json));
    assert_eq!((again.text, again.failure), (done.text, done.failure));
}

#[test]
fn a_command_that_is_none_is_refused_with_the_nearest() {
    let errors = [
        commands::default_ask("fokus").unwrap_err(),
        commands::run("fokus", json!({}), &mut Silent).unwrap_err(),
    ];
    for error in errors {
        let (field, expected, found) = match error {
            TaskError::Ask { field, expected, found } => (field, expected, found),
            other => panic!("{other}"),
        };
        assert_eq!((field, found.as_str()), ("command", "`fokus`"));
        assert!(expected.starts_with("one of check, design") && expected.ends_with("(nearest: focus)"));
    }
}
