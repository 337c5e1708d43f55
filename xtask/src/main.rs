//! House rules, tests and documentation checks: `cargo xtask tidy`, `test`, `docs` and `circles`.

mod circles;
mod constants;
mod descriptions;
mod docs;
mod floors;
mod items;
mod matrices;
mod openings;
mod profile;
mod quantities;
mod seeds;
mod sizes;
mod sources;
mod suite;
mod words;
#[cfg(test)]
mod workflows;

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let task = arguments.next().unwrap_or_default();
    let root = sources::root();
    let faults = match task.as_str() {
        "tidy" => tidy(&root),
        "test" => suite::run(&root, &arguments.collect::<Vec<_>>()),
        "docs" => docs::run_all(&root),
        "circles" => {
            let circles = circles::find(&root);
            circles.iter().for_each(|circle| print!("{circle}"));
            println!("circles: {}", circles.len());
            return ExitCode::SUCCESS;
        }
        _ => {
            eprintln!(
                "usage: cargo xtask tidy | test [--built FILE | OPTIONS OF CARGO TEST] | docs | circles"
            );
            return ExitCode::from(2);
        }
    };
    faults.iter().for_each(|fault| eprintln!("{fault}"));
    if faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Finds every breach of the house rules, one line each.
fn tidy(root: &Path) -> Vec<String> {
    let mut faults = floors::check(root);
    faults.extend(matrices::check(root));
    faults.extend(openings::check(root));
    faults.extend(seeds::check(root));
    faults.extend(sizes::check(root));
    faults.extend(words::check(root));
    faults.extend(descriptions::check(root));
    faults.extend(constants::check(root));
    faults.extend(quantities::check(root));
    faults
}

#[cfg(test)]
mod tests {
    use crate::sources;

    #[test]
    fn the_house_is_tidy() {
        let root = sources::root();
        assert!(sources::files(&root, &[".rs"]).len() > 10, "the walk found no code");
        let faults = super::tidy(&root);
        assert!(faults.is_empty(), "\n{}", faults.join("\n"));
    }
}
