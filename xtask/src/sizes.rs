//! Files of at most 400 lines, functions of at most 60.

use crate::items::{self, declared, indent};
use crate::sources;
use std::path::Path;

/// Most lines of a file and of a function: what a reader holds at once. Half as many would cut thoughts apart.
const FILE_LINES: usize = 400;
const FUNCTION_LINES: usize = 60;

/// Finds files and functions that are too long.
pub fn check(root: &Path) -> Vec<String> {
    let mut faults = Vec::new();
    for path in sources::files(root, &[".rs", ".py", ".js", ".css", ".html"]) {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let lines = text.lines().count();
        if lines > FILE_LINES {
            faults.push(format!("{}: {lines} lines, at most {FILE_LINES}", path.display()));
        }
        for (start, length) in long_functions(&text) {
            faults.push(format!(
                "{}:{start}: a function of {length} lines, at most {FUNCTION_LINES}",
                path.display()
            ));
        }
    }
    faults
}

/// Start line and length of each long function, whatever its visibility, found by rustfmt's indentation.
fn long_functions(text: &str) -> Vec<(usize, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (start, line) in lines.iter().enumerate() {
        let end = items::signature_end(&lines, start);
        // A declaration without a body ends in a semicolon, a body of one line in a brace.
        let has_body = lines[..end].last().is_some_and(|last| last.ends_with('{'));
        if !has_body || declared(line).is_none_or(|item| item.kind != "fn") {
            continue;
        }
        let close = format!("{}}}", &line[..indent(line)]);
        let length = lines[end..].iter().position(|l| **l == close).map_or(0, |last| end + last + 1 - start);
        if length > FUNCTION_LINES {
            found.push((start + 1, length));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_function_is_seen() {
        let body = "    let x = 1;\n".repeat(70);
        let text = format!("fn short() {{\n}}\n\nfn long() {{\n{body}}}\n");
        assert_eq!(long_functions(&text), vec![(4, 72)]);
    }

    #[test]
    fn no_visibility_or_qualifier_hides_one() {
        let body = "        let x = 1;\n".repeat(70);
        for before in [
            "pub(super) ",
            "pub(crate) async ",
            "pub(in crate::x) ",
            "const unsafe ",
            "unsafe extern \"C\" ",
            "",
        ] {
            let text =
                format!("impl A {{\n    {before}fn long(\n        a: u8,\n    ) {{\n{body}    }}\n}}\n");
            assert_eq!(long_functions(&text), vec![(2, 74)], "{before}");
        }
    }

    #[test]
    fn what_has_no_body_is_not_long() {
        let rest = "    let x = 1;\n".repeat(70);
        let text = format!(
            "trait A {{\n    fn a(\n        &self,\n    );\n    fn b(&self) {{}}\n{rest}    }}\n}}\n"
        );
        assert!(long_functions(&text).is_empty());
    }
}
