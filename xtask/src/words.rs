//! Rejects words in sources that mark unfinished code, ignored tests or paths of one machine.

use crate::sources;
use std::path::Path;

/// Finds lines that hold such a word.
pub fn check(root: &Path) -> Vec<String> {
    let open = ["to", "do!("].concat();
    let missing = ["unimpl", "emented!("].concat();
    let mark = ["FIX", "ME"].concat();
    let ignored = ["#[ig", "nore"].concat();
    let home = ["/ho", "me/"].concat();
    let banned = [open, missing, mark, ignored, home];
    let mut faults = Vec::new();
    for path in sources::files(root, &[".rs", ".py", ".pyi", ".toml", ".md", ".svg", ".html"]) {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        for (number, line) in text.lines().enumerate() {
            if let Some(word) = banned.iter().find(|word| line.contains(word.as_str())) {
                faults.push(format!("{}:{}: `{word}`", path.display(), number + 1));
            }
        }
    }
    faults
}
