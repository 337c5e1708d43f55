//! Every source file opens with a line that says what it is.

use crate::sources;
use std::path::Path;

/// Words that such a line has at least: a name alone says nothing.
const WORDS: usize = 2;

/// Finds source files whose first line does not describe them.
pub fn check(root: &Path) -> Vec<String> {
    let files = sources::files(root, &[".rs", ".py", ".pyi"]).into_iter();
    let silent = files.filter(|path| !opens(&std::fs::read_to_string(path).unwrap_or_default()));
    silent.map(|path| format!("{}: expected a first line that says what it is", path.display())).collect()
}

fn opens(text: &str) -> bool {
    let first = text.lines().next().unwrap_or_default();
    let said = first.strip_prefix("//!").or_else(|| first.strip_prefix("\"\"\""));
    said.is_some_and(|said| said.split_whitespace().count() >= WORDS)
}

#[cfg(test)]
mod tests {
    use super::opens;

    #[test]
    fn a_file_that_says_nothing_is_seen() {
        assert!(opens("//! Gauss-Legendre quadrature.\n\nuse std::fmt;\n"));
        assert!(!opens("use std::fmt;\n"));
        assert!(!opens("//! Modes.\n"));
        assert!(opens("\"\"\"Modes by plain numpy.\"\"\"\n\nimport numpy\n"));
        assert!(!opens("import numpy\n"));
    }
}
