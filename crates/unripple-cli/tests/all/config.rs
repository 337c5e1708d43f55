//! Options from a configuration file.

use crate::common::Scratch;
use serde_json::Value;
use std::process::Output;

fn run(arguments: &[&str], config: &str) -> Output {
    crate::common::program().args(arguments).env("UNRIPPLE_CONFIG", config).output().unwrap()
}

#[test]
fn a_command_has_the_options_of_the_file_unless_it_is_given_others() {
    let scratch = Scratch::new("config");
    let file = scratch.file("config.toml", "json = true\n\n[modes]\nmax-hz = 300\n");
    let top = |arguments: &[&str]| {
        let output = run(&[&["modes", "hudin-2012"], arguments].concat(), &file);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        report["run"]["ask"]["top_hz"].as_f64()
    };
    assert_eq!((top(&[]), top(&["--max-hz", "200"])), (Some(300.0), Some(200.0)));
    // What was added is told where everything is.
    let output = run(&["modes", "hudin-2012", "-v"], &file);
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(errors.contains("config.toml: --json --max-hz=300"), "{errors}");
}

#[test]
fn the_usual_file_is_the_one_of_the_user() {
    let scratch = Scratch::new("config-home");
    std::fs::create_dir(scratch.path().join("unripple")).unwrap();
    scratch.file("unripple/config.toml", "[modes]\nmax-hz = 'high'\n");
    let modes = || {
        let mut command = crate::common::program();
        command.args(["modes", "hudin-2012"]).env_remove("UNRIPPLE_CONFIG");
        command.env("XDG_CONFIG_HOME", scratch.path()).env("APPDATA", scratch.path());
        command
    };
    let output = modes().output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2));
    assert!(errors.contains("config.toml: invalid value 'high' for '--max-hz <HZ>'"), "{errors}");
    // Help is to be had all the same.
    assert!(modes().arg("--help").output().unwrap().status.success());
    // Whoever gives the option needs no good file, and whoever wants none has none.
    assert!(modes().args(["--max-hz", "200"]).output().unwrap().status.success());
    assert!(modes().env("UNRIPPLE_CONFIG", "").output().unwrap().status.success());
}

#[test]
fn a_file_that_is_no_good_is_refused_by_its_line() {
    let scratch = Scratch::new("config-bad");
    let missing = scratch.join("missing.toml");
    let broken = scratch.file("broken.toml", "quiet = true\nmodes = [\n");
    for (config, wanted) in [(missing.as_str(), "expected a file"), (&broken, "line 2")] {
        let output = run(&["modes", "hudin-2012"], config);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && errors.contains(wanted), "{errors}");
    }
}
