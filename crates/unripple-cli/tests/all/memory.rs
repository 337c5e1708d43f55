//! What a surface costs is said before it is solved, and what needs more memory than is allowed is refused with what would do.

use crate::common::{program, run};

#[test]
fn check_says_what_a_surface_costs() {
    let output = run(&["check", "glass-plate"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && text.contains("modes take ") && text.contains("a focus "), "{text}");
    assert!(text.contains(" GB of memory"), "{text}");
    // Of JSON nothing depends on the machine.
    let output = run(&["check", "glass-plate", "--json"]);
    let json = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && json.contains("\"ok\"") && !json.contains("cost"), "{json}");
}

#[test]
fn memory_is_what_the_variable_allows() {
    let run = |gib: &str, arguments: &[&str]| {
        let output = program().env("UNRIPPLE_MEMORY_GIB", gib).args(arguments).output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let modes = ["modes", "stadium-film", "--accuracy", "1e-4"];
    let (code, said) = run("0.01", &modes);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("expected at most 0.01 GiB") && said.contains("Hz fits"), "{said}");
    assert!(said.contains("UNRIPPLE_MEMORY_GIB=1 allows it on this machine"), "{said}");
    assert_eq!(run("1", &modes).0, Some(0));
    let (code, said) = run("much", &modes);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("UNRIPPLE_MEMORY_GIB: expected a number of GiB above 0"), "{said}");
}
