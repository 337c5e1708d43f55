//! Files of at most 400 lines, functions of at most 60.

use std::path::Path;

const FILE_LINES: usize = 400;
const FUNCTION_LINES: usize = 60;

/// Files and functions that are too long.
pub fn check(root: &Path) -> Vec<String> {
    let mut faults = Vec::new();
    for path in crate::files(root, &[".rs", ".py", ".js", ".css", ".html"]) {
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

/// Start line and length of each long function, told by rustfmt's indentation.
fn long_functions(text: &str) -> Vec<(usize, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (start, line) in lines.iter().enumerate() {
        let code = line.trim_start();
        let declares = ["fn ", "pub fn ", "pub(crate) fn ", "const fn ", "pub const fn "]
            .iter()
            .any(|prefix| code.starts_with(prefix));
        if !declares || code.ends_with(';') {
            continue;
        }
        let close = format!("{}}}", &line[..line.len() - code.len()]);
        let length = lines[start..].iter().position(|l| **l == close).map_or(0, |end| end + 1);
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
}
