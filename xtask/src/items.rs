//! Declarations in Rust text, found line by line as rustfmt writes them, with the comments above them.

/// A declaration: whether it is public, its kind and its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Declaration<'t> {
    /// Whether it begins with `pub` alone; `pub(crate)` and the like do not count.
    pub public: bool,
    /// `fn`, `struct`, `enum`, `union`, `trait`, `type`, `const`, `static` or `mod`.
    pub kind: &'t str,
    /// Name of what is declared.
    pub name: &'t str,
}

/// Words that declare something, each followed by a name.
const KINDS: [&str; 9] = ["fn", "struct", "enum", "union", "trait", "type", "const", "static", "mod"];

/// Words that may stand before `fn`, `trait` or `static`.
const QUALIFIERS: [&str; 5] = ["default", "async", "unsafe", "safe", "extern"];

/// Finds the declaration that a line begins, if it begins one.
pub fn declared(line: &str) -> Option<Declaration<'_>> {
    let code = line.trim_start();
    let (public, code) = match code.strip_prefix("pub") {
        Some(rest) if rest.starts_with('(') => (false, rest.split_once(") ")?.1),
        Some(rest) => (true, rest.strip_prefix(' ')?),
        None => (false, code),
    };
    let mut words = code.split_whitespace();
    let mut word = words.next()?;
    loop {
        let next = words.next()?;
        let functional = next == "fn" || QUALIFIERS.contains(&next);
        if QUALIFIERS.contains(&word) || word.starts_with('"') || (word == "const" && functional) {
            word = next;
            continue;
        }
        let kind = KINDS.iter().find(|kind| **kind == word)?;
        let named = if next == "mut" { words.next()? } else { next };
        let end = named.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(named.len());
        return (end > 0).then_some(Declaration { public, kind, name: &named[..end] });
    }
}

/// Number of spaces before a line's first character.
pub fn indent(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

/// The lines of code of a file: those before its tests, which stand at its end.
pub fn code<'l, 't>(lines: &'l [&'t str]) -> &'l [&'t str] {
    let tests = lines
        .windows(2)
        .position(|pair| pair[0] == "#[cfg(test)]" && pair[1].starts_with("mod ") && pair[1].ends_with('{'));
    &lines[..tests.unwrap_or(lines.len())]
}

/// Number of the line after a declaration's signature, which for a function includes arguments on lines of their own.
pub fn signature_end(lines: &[&str], start: usize) -> usize {
    let ends = |line: &&str| line.ends_with(['{', ';', '}']);
    lines[start..].iter().position(ends).map_or(lines.len(), |length| start + length + 1)
}

/// The doc comment above a line, attributes passed over, as one text; nothing if there is none.
pub fn doc(lines: &[&str], at: usize) -> Option<String> {
    let mut said: Vec<&str> = above(lines, at).into_iter().filter_map(|l| l.strip_prefix("///")).collect();
    said.reverse();
    (!said.is_empty()).then(|| said.join("\n"))
}

/// Whether a comment of any kind stands above a line, attributes passed over.
pub fn is_explained(lines: &[&str], at: usize) -> bool {
    above(lines, at).iter().any(|line| line.starts_with("//"))
}

/// Whether an attribute above a line holds a word.
pub fn has_attribute(lines: &[&str], at: usize, word: &str) -> bool {
    above(lines, at).iter().any(|line| line.starts_with("#[") && line.contains(word))
}

/// Comments and attributes right above a line, the nearest first, without their indentation.
fn above<'t>(lines: &[&'t str], at: usize) -> Vec<&'t str> {
    let mut found = Vec::new();
    let mut within = false;
    for line in lines[..at].iter().rev().map(|line| line.trim()) {
        // An attribute of several lines ends in `]` and begins with `#[`.
        within |= line.ends_with(']') && !line.starts_with("//");
        if !(within || line.starts_with("//") || line.starts_with("#[")) {
            break;
        }
        within &= !line.starts_with("#[");
        found.push(line);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declarations_are_seen_behind_any_visibility_and_qualifier() {
        let kind = |line| declared(line).map(|item| (item.public, item.kind, item.name));
        assert_eq!(kind("pub fn a() {"), Some((true, "fn", "a")));
        assert_eq!(kind("    pub(super) async fn b<T>("), Some((false, "fn", "b")));
        assert_eq!(kind("pub(in crate::x) const unsafe fn c()"), Some((false, "fn", "c")));
        assert_eq!(kind("unsafe extern \"C\" fn d(x: u8) {"), Some((false, "fn", "d")));
        assert_eq!(kind("pub const E: usize = 1;"), Some((true, "const", "E")));
        assert_eq!(kind("static mut F: u8 = 1;"), Some((false, "static", "F")));
        assert_eq!(kind("pub struct G(u8);"), Some((true, "struct", "G")));
        assert_eq!(kind("impl H for I {"), None);
        assert_eq!(kind("    pub field: f64,"), None);
        assert_eq!(kind("const { 1 }"), None);
    }

    #[test]
    fn comments_are_found_above_attributes() {
        let lines = [
            "x",
            "/// One",
            "/// two.",
            "#[derive(",
            "    Debug",
            ")]",
            "struct A;",
            "// b",
            "const B: u8 = 1;",
        ];
        assert_eq!(doc(&lines, 6).as_deref(), Some(" One\n two."));
        assert_eq!(doc(&lines, 8), None);
        assert!(is_explained(&lines, 8) && is_explained(&lines, 6) && !is_explained(&lines, 1));
        assert!(has_attribute(&lines, 6, "derive") && !has_attribute(&lines, 8, "derive"));
    }
}
