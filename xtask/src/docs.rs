//! Runs every shell block of the README and the guides, as a reader would type them.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Runs the ```sh blocks of README.md and docs/*.md, each page in a folder of its own; returns those that failed.
///
/// README blocks run at the top of the checkout; guide blocks run with `unripple` on the path.
pub fn run_all(root: &Path) -> Vec<String> {
    let scratch = root.join("target/docs");
    let mut faults = Vec::new();
    let mut count = 0;
    let mut pages = vec![root.join("README.md")];
    pages.extend(crate::files(&root.join("docs"), &[".md"]));
    for page in pages {
        let text = std::fs::read_to_string(&page).unwrap_or_default();
        let folder =
            if page.ends_with("README.md") { root.to_path_buf() } else { page_folder(&scratch, &page) };
        for block in blocks(&text, "sh") {
            count += 1;
            eprintln!("{}:\n{block}", page.file_name().unwrap_or_default().to_string_lossy());
            if let Err(reason) = run(&block, &folder, root) {
                faults.push(format!("{}: {reason}\n{block}", page.display()));
            }
        }
    }
    if count == 0 {
        faults.push("no shell block was found in README.md or docs".into());
    }
    faults
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

fn run(block: &str, folder: &Path, root: &Path) -> Result<(), String> {
    let binaries = root.join("target/release").canonicalize().map_err(|e| e.to_string())?;
    let path = format!("{}:{}", binaries.display(), std::env::var("PATH").unwrap_or_default());
    let status = Command::new("sh")
        .args(["-e", "-c", block])
        .current_dir(folder)
        .env("PATH", path)
        .env("UNRIPPLE_INSIDE_CHECK", "1")
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
