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
    for path in sources::files(root, &[".rs", ".py", ".pyi", ".js", ".css", ".html"]) {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let lines = text.lines().count();
        if lines > FILE_LINES {
            faults.push(format!("{}: {lines} lines, at most {FILE_LINES}", path.display()));
        }
        let python = path.extension().is_some_and(|ending| ending == "py");
        let long = if python { long_definitions(&text) } else { long_functions(&text) };
        for (start, length) in long {
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

/// Start line and length of each long function of Python, found by indentation.
fn long_definitions(text: &str) -> Vec<(usize, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (start, line) in lines.iter().enumerate() {
        let code = line.trim_start();
        if !(code.starts_with("def ") || code.starts_with("async def ")) {
            continue;
        }
        // A signature, of one line or several, ends in a colon, or in dots where there is no body.
        let Some(head) = lines[start..].iter().position(|line| line.ends_with([':', '.'])) else { continue };
        let inner = lines[start + head + 1..].iter();
        let inner = inner.take_while(|inner| inner.is_empty() || indent(inner) > indent(line));
        let last = inner.enumerate().filter(|(_, inner)| !inner.is_empty()).last();
        let length = head + 1 + last.map_or(0, |(at, _)| at + 1);
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
    fn a_long_function_of_python_is_seen() {
        let body = "        x = 1\n\n".repeat(35);
        let text = format!(
            "class A:\n    def short(self) -> None: ...\n\n    def long(\n        self,\n    ) -> int:\n{body}        return x\n\n\nx = 1\n"
        );
        assert_eq!(long_definitions(&text), vec![(4, 74)]);
        let lines = "x = 1\n".repeat(70);
        assert!(long_definitions(&format!("def short():\n    return 1\n\n\n{lines}")).is_empty());
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
