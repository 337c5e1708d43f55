//! Tells the program from which commit it was built, where there is a repository.

use std::path::Path;
use std::process::Command;

fn main() {
    let git = |arguments: &[&str]| {
        let output =
            Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
        Some(String::from_utf8(output.stdout).ok()?.trim().to_owned()).filter(|text| !text.is_empty())
    };
    let commit = git(&["rev-parse", "--short=12", "HEAD"]).unwrap_or_default();
    println!("cargo::rustc-env=UNRIPPLE_COMMIT={commit}");
    // Another commit is another program. Files that are not there would have it built again each time.
    let head = git(&["symbolic-ref", "--quiet", "HEAD"]);
    let paths = ["HEAD"].into_iter().map(str::to_owned).chain(head);
    for path in paths
        .filter_map(|name| git(&["rev-parse", "--git-path", &name]))
        .filter(|path| Path::new(path).exists())
    {
        println!("cargo::rerun-if-changed={path}");
    }
    println!("cargo::rerun-if-changed=build.rs");
}
