//! Which test programs run one at a time, and which of the others begin.

use super::build::Program;
use std::collections::VecDeque;

/// One of [`ALONE`]: package, program, why it is there.
type Alone = (&'static str, &'static str, &'static str);

/// Reasons why a program of [`ALONE`] runs one at a time.
const REGISTRY: &str = "JACK keeps one registry of servers and clients for a user";
const CLOCK: &str = "it holds times against the machine's clock, or interrupts at moments of it";
const CROWD: &str = "it opens as many connections as the machine grants";

/// Programs that run one at a time, in this order (those that take longest first), while others run beside them; they have priority when
/// cores are short.
#[rustfmt::skip]
pub const ALONE: &[Alone] = &[
    ("unripple-cli", "interrupts", CLOCK),
    ("unripple-cli", "sitting", REGISTRY),
    ("unripple-devices", "jack_server", REGISTRY),
    ("unripple-viewer", "crowds", CROWD),
    ("unripple-cli", "jack_lock", REGISTRY),
    ("unripple-cli", "play", REGISTRY),
    ("unripple-calibrate", "measured_jack", REGISTRY),
    ("unripple-live", "served", REGISTRY),
    ("unripple-live", "called", CLOCK),
    ("unripple-live", "jack", REGISTRY),
    ("unripple-live", "silence", CLOCK),
    ("unripple-live", "day", CLOCK),
    ("unripple-live", "lib", CLOCK),
    ("unripple-devices", "lib", REGISTRY),
    ("unripple-devices", "cards", CLOCK),
    ("unripple-touch", "touch", CLOCK),
    ("unripple-cli", "devices", REGISTRY),
    ("unripple-cli", "doctor", REGISTRY),
    ("unripple-viewer", "ending", CLOCK),
    ("unripple-viewer", "asking", CLOCK),
    ("unripple-viewer", "clocks", CLOCK),
    ("unripple-viewer", "serving", CLOCK),
    ("unripple-viewer", "stopping", CLOCK),
    ("unripple-viewer", "exclusive", CLOCK),
    ("unripple-tasks", "given_up", CLOCK),
];

/// Of the others, those that take longest, the longest first: what begins last should be short. The order costs time alone, never a test.
const LONG: &[(&str, &str)] = &[
    ("unripple-calibrate", "all"),
    ("unripple-cli", "all"),
    ("unripple-plates", "lib"),
    ("unripple-physics", "all"),
    ("unripple", "all"),
    ("unripple-plates", "all"),
    ("unripple-tasks", "any_surface"),
    ("unripple-focus", "all"),
    ("unripple-live", "sessions"),
    ("unripple-paper", "lib"),
    ("unripple", "thread_counts"),
];

/// Sorts programs into those that run one at a time and the others, each in the order in which they begin.
pub fn sorted(programs: VecDeque<Program>) -> (VecDeque<Program>, VecDeque<Program>) {
    let place = |program: &Program| ALONE.iter().position(|alone| is(program, alone.0, alone.1));
    let (mut alone, mut others): (Vec<_>, Vec<_>) =
        programs.into_iter().partition(|program| place(program).is_some());
    alone.sort_by_key(place);
    others.sort_by_key(|program| {
        let place = LONG.iter().position(|long| is(program, long.0, long.1));
        (place.unwrap_or(LONG.len()), program.to_string())
    });
    (alone.into(), others.into())
}

fn is(program: &Program, package: &str, name: &str) -> bool {
    program.package == package && program.name == name
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources;
    use std::path::PathBuf;

    fn program(package: &str, name: &str) -> Program {
        let (path, folder) = (PathBuf::new(), PathBuf::new());
        Program { package: package.into(), name: name.into(), path, folder, version: "0.1.0".into() }
    }

    #[test]
    fn the_longest_begin_and_those_apart_are_apart() {
        let programs = [("b", "all"), ("unripple-cli", "all"), ("unripple-live", "jack"), ("a", "all")];
        let (alone, others) = sorted(programs.map(|(package, name)| program(package, name)).into());
        let names = |programs: VecDeque<Program>| programs.iter().map(Program::to_string).collect::<Vec<_>>();
        assert_eq!(names(alone), ["unripple-live jack"]);
        assert_eq!(names(others), ["unripple-cli all", "a all", "b all"]);
    }

    #[test]
    fn every_name_is_that_of_a_program() {
        let crates = sources::root().join("crates");
        let named = ALONE.iter().map(|(package, name, _)| (*package, *name)).chain(LONG.iter().copied());
        for (package, name) in named {
            let folder = crates.join(package);
            let places =
                [format!("tests/{name}.rs"), format!("tests/{name}/main.rs"), format!("src/{name}.rs")];
            assert!(places.iter().any(|place| folder.join(place).is_file()), "no {package} {name}");
        }
    }
}
