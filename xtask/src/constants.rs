//! Constants and statics of a module are preceded by a comment, alone or as a group without an empty line.

use crate::items::{self, declared};
use crate::sources;
use std::path::Path;

/// Finds constants without a comment.
pub fn check(root: &Path) -> Vec<String> {
    sources::faults(root, &|text| {
        let lines: Vec<&str> = text.lines().collect();
        let unsaid = unexplained(items::code(&lines));
        unsaid.into_iter().map(|at| (at, "expected a comment that says why this value".to_owned())).collect()
    })
}

/// Lines of constants at a file's top level without a comment above them or above their group.
fn unexplained(lines: &[&str]) -> Vec<usize> {
    let mut found = Vec::new();
    // Whether a constant stood right above, in a group that has a comment.
    let mut grouped = false;
    for (at, line) in lines.iter().enumerate() {
        let constant = !line.starts_with(' ')
            && declared(line).is_some_and(|item| matches!(item.kind, "const" | "static") && item.name != "_");
        if constant {
            grouped |= items::is_explained(lines, at);
            if !grouped {
                found.push(at);
            }
        } else if line.trim().is_empty() {
            grouped = false;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::unexplained;

    #[test]
    fn a_constant_without_a_word_is_seen() {
        let text = "/// Why one.\nconst A: u8 = 1;\nconst B: [u8; 2] =\n    [1, 2];\nconst C: u8 = 3;\n\nstatic D: u8 = 4;\n\n// Why five.\nconst E: u8 = 5;\n";
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(unexplained(&lines), [6]);
        assert_eq!(unexplained(&["pub const fn f() -> u8 {", "    const INNER: u8 = 1;", "}"]), [0; 0]);
        assert_eq!(unexplained(&["const _: () = ();"]), [0; 0]);
    }
}
