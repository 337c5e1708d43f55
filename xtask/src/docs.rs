//! Runs every shell block of the README and the guides, as a reader would type them.

use crate::profile::PROFILE;
use crate::sources;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

/// How many of the blocks that took longest are named at the end.
const NAMED: usize = 12;

/// Runs the ```sh blocks of README.md and docs/*.md, each page in a folder of its own; returns those that failed.
///
/// README blocks run at the top of the checkout; guide blocks run with `unripple` on the path. Both use the program that was built beside
/// this one: `cargo run --release -- …` there is that program with those arguments ([`SHIM`]), so that nothing is compiled a second time in
/// another profile. All other commands of cargo are cargo's own. What one command has computed is kept for those after it, as on a reader's
/// machine, but in a folder of its own, which is empty at first.
pub fn run_all(root: &Path) -> Vec<String> {
    let scratch = root.join("target/docs");
    let _ = std::fs::remove_dir_all(scratch.join("cache"));
    let path = match search_path(&scratch) {
        Ok(path) => path,
        Err(reason) => return vec![reason],
    };
    let mut faults = Vec::new();
    let mut took = Vec::new();
    let mut pages = vec![root.join("README.md")];
    pages.extend(sources::files(&root.join("docs"), &[".md"]));
    for page in pages {
        let text = std::fs::read_to_string(&page).unwrap_or_default();
        let folder =
            if page.ends_with("README.md") { root.to_path_buf() } else { page_folder(&scratch, &page) };
        for block in blocks(&text, "sh") {
            let name = page.file_name().unwrap_or_default().to_string_lossy().into_owned();
            eprintln!("{name}:\n{block}");
            let began = Instant::now();
            if let Err(reason) = run(&block, &folder, &path) {
                faults.push(format!("{}: {reason}\n{block}", page.display()));
            }
            took.push((began.elapsed(), name, block));
        }
    }
    if took.is_empty() {
        faults.push("no shell block was found in README.md or docs".into());
    }
    tell(took);
    faults
}

/// Prints how long all blocks took, and those that took longest.
fn tell(mut took: Vec<(Duration, String, String)>) {
    let all: Duration = took.iter().map(|(time, ..)| *time).sum();
    took.sort_by_key(|(time, ..)| std::cmp::Reverse(*time));
    println!("{} blocks in {:.0} s; the longest:", took.len(), all.as_secs_f64());
    for (time, page, block) in took.iter().take(NAMED) {
        println!("{:6.1} s  {page}: {}", time.as_secs_f64(), block.lines().next().unwrap_or_default());
    }
}

/// Stands for `cargo` while the blocks run.
const SHIM: &str = r#"#!/bin/sh
# cargo, but for `cargo run --release -- ...`: that is the program that is built already.
if [ "$1 $2 $3" = "run --release --" ]; then
    shift 3
    exec "$UNRIPPLE" "$@"
fi
PATH=$UNRIPPLE_PATH exec cargo "$@"
"#;

/// Where the shell finds the program of the documentation, and a `cargo` that runs it.
struct SearchPath {
    /// The program.
    program: PathBuf,
    /// As it was.
    before: String,
    /// With the folders of both before all others.
    path: String,
    /// Where results are kept.
    cache: PathBuf,
}

fn search_path(scratch: &Path) -> Result<SearchPath, String> {
    let said = |error: std::io::Error| error.to_string();
    let built = std::env::current_exe().and_then(|own| own.canonicalize()).map_err(said)?;
    let built = built.parent().ok_or("xtask is in no folder")?;
    let program = built.join(format!("unripple{}", std::env::consts::EXE_SUFFIX));
    if !program.is_file() {
        return Err(format!("no {}: cargo build --profile {PROFILE} makes it", program.display()));
    }
    let folder = scratch.join("path");
    std::fs::create_dir_all(&folder).map_err(said)?;
    let shim = folder.join("cargo");
    std::fs::write(&shim, SHIM).map_err(said)?;
    #[cfg(unix)]
    std::fs::set_permissions(&shim, std::os::unix::fs::PermissionsExt::from_mode(0o755)).map_err(said)?;
    let folder = folder.canonicalize().map_err(said)?;
    let cache = folder.with_file_name("cache");
    let before = std::env::var("PATH").unwrap_or_default();
    let path = format!("{}:{}:{before}", folder.display(), built.display());
    Ok(SearchPath { program, before, path, cache })
}

fn page_folder(scratch: &Path, page: &Path) -> PathBuf {
    let folder = scratch.join(page.file_stem().unwrap_or_default());
    let _ = std::fs::remove_dir_all(&folder);
    let _ = std::fs::create_dir_all(&folder);
    folder
}

/// The fenced blocks of one language, in order. `sh` only: `console` and others are for the eye.
fn blocks(text: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}");
    let mut found = Vec::new();
    let mut block: Option<String> = None;
    for line in text.lines() {
        match &mut block {
            Some(lines) if line.trim_end() == "```" => {
                found.push(std::mem::take(lines));
                block = None;
            }
            Some(lines) => {
                lines.push_str(line);
                lines.push('\n');
            }
            None if line.trim_end() == fence => block = Some(String::new()),
            None => {}
        }
    }
    found
}

fn run(block: &str, folder: &Path, search: &SearchPath) -> Result<(), String> {
    let status = Command::new("sh")
        .args(["-e", "-c", block])
        .current_dir(folder)
        .env("PATH", &search.path)
        .env("UNRIPPLE", &search.program)
        .env("UNRIPPLE_PATH", &search.before)
        .env("UNRIPPLE_INSIDE_CHECK", "1")
        .env("UNRIPPLE_CACHE", &search.cache)
        .stdout(std::process::Stdio::null())
        .status()
        .map_err(|e| e.to_string())?;
    if status.success() { Ok(()) } else { Err(format!("ended with {status}")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_named_language_is_taken() {
        let text = "a\n```sh\nls\npwd\n```\n```toml\nx = 1\n```\n```sh\ntrue\n```\n";
        assert_eq!(blocks(text, "sh"), vec!["ls\npwd\n", "true\n"]);
    }
}
