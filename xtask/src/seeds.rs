//! Seeds of random tests that failed once are kept in files where proptest looks for them.

use crate::sources;
use std::path::Path;

/// Finds files of seeds that no test reads, and tests that keep no seeds.
pub fn check(root: &Path) -> Vec<String> {
    let crates = root.join("crates");
    let seeds = sources::files(&crates, &[".proptest-regressions", ".txt"]);
    let lost = seeds.iter().filter(|path| !is_read(path));
    let mut faults: Vec<String> =
        lost.map(|path| format!("{}: proptest does not look for seeds there", path.display())).collect();
    let switched_off = ["failure_pers", "istence: None"].concat();
    for path in sources::files(&crates, &[".rs"]) {
        if std::fs::read_to_string(&path).unwrap_or_default().contains(&switched_off) {
            faults.push(format!("{}: the seeds of its failures are not kept", path.display()));
        }
    }
    faults
}

/// Whether proptest reads this file, which depends on the sources beside it: for a test below a `lib.rs` or `main.rs` the seeds are in a
/// folder `proptest-regressions` beside that file's folder, for any other test beside the test itself. Other text files hold no seeds.
fn is_read(path: &Path) -> bool {
    if path.extension().is_some_and(|ending| ending == "proptest-regressions") {
        let source = path.with_extension("rs");
        return source.is_file() && root_of(&source).is_none();
    }
    let Some(seeds) = path.ancestors().find(|folder| folder.ends_with("proptest-regressions")) else {
        return true;
    };
    let (Some(beside), Ok(name)) = (seeds.parent(), path.strip_prefix(seeds)) else { return false };
    let folders = std::fs::read_dir(beside).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut sources = folders.map(|folder| (folder.join(name).with_extension("rs"), folder));
    sources.any(|(source, folder)| source.is_file() && root_of(&source) == Some(&folder))
}

/// The nearest folder above a source that has a `lib.rs` or `main.rs`.
fn root_of(source: &Path) -> Option<&Path> {
    let has_root = |folder: &&Path| folder.join("lib.rs").is_file() || folder.join("main.rs").is_file();
    source.ancestors().skip(1).find(has_root)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seeds_that_nobody_reads_are_seen() {
        let folder = std::env::temp_dir().join(format!("unripple-seeds-{}", std::process::id()));
        let file = |path: &str| {
            let path = folder.join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(&path, "").unwrap();
            path
        };
        for source in ["tests/all/main.rs", "tests/all/a.rs", "tests/b.rs"] {
            file(source);
        }
        let read = ["tests/proptest-regressions/a.txt", "tests/b.proptest-regressions", "tests/notes.txt"];
        let lost = [
            "tests/all/a.proptest-regressions",
            "tests/proptest-regressions/b.txt",
            "tests/c.proptest-regressions",
        ];
        let found = [read.map(|path| is_read(&file(path))), lost.map(|path| is_read(&file(path)))];
        std::fs::remove_dir_all(&folder).unwrap();
        assert_eq!(found, [[true; 3], [false; 3]]);
    }
}
