//! Public items, fields and variants each have a doc of three words or more.

use crate::items::{self, declared, indent};
use crate::sources;
use std::path::Path;

/// Words that a doc has at least: "The value." says nothing that the name does not.
const WORDS: usize = 3;

/// Finds public items, fields and variants without a doc, or with one of too few words.
pub fn check(root: &Path) -> Vec<String> {
    sources::faults(root, &|text| {
        let lines: Vec<&str> = text.lines().collect();
        let lines = items::code(&lines);
        let thin = (0..lines.len()).filter(|at| is_public(lines, *at) && words(lines, *at) < WORDS);
        thin.map(|at| (at, format!("expected a doc of {WORDS} words or more"))).collect()
    })
}

/// Words of the doc above a line.
fn words(lines: &[&str], at: usize) -> usize {
    items::doc(lines, at).map_or(0, |doc| doc.split_whitespace().count())
}

/// Whether a line declares something that is public, as far as its file can say.
fn is_public(lines: &[&str], at: usize) -> bool {
    let code = lines[at].trim_start();
    if code.is_empty() || code.starts_with("//") || code.starts_with('#') {
        return false;
    }
    match declared(code) {
        Some(item) if item.kind == "mod" => false,
        Some(item) if item.public => true,
        Some(_) => items::doc(lines, at).is_some() && within_public(lines, at),
        // A field behind a flattening attribute has its doc where its type is.
        None if is_field(code) => !items::has_attribute(lines, at, "flatten"),
        None => items::doc(lines, at).is_some() && !code.starts_with("impl") && within_public(lines, at),
    }
}

/// Whether a line is a public field, of a name or of a place in a tuple.
fn is_field(code: &str) -> bool {
    let Some(rest) = code.strip_prefix("pub ") else { return false };
    !rest.starts_with("use ") && !rest.starts_with("extern ") && (rest.contains(": ") || rest.ends_with(','))
}

/// Whether a line stands directly in a public enum or trait, or in a variant of one.
fn within_public(lines: &[&str], at: usize) -> bool {
    let own = indent(lines[at]);
    let encloses = |line: &&str| !line.trim().is_empty() && indent(line) < own && line.ends_with('{');
    let Some(around) = lines[..at].iter().rposition(encloses) else { return false };
    match declared(lines[around]) {
        Some(item) => item.public && matches!(item.kind, "enum" | "trait"),
        // A variant with fields of its own.
        None => items::doc(lines, around).is_some() && within_public(lines, around),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thin(text: &str) -> Vec<usize> {
        let lines: Vec<&str> = text.lines().collect();
        (0..lines.len()).filter(|at| is_public(&lines, *at) && words(&lines, *at) < WORDS).collect()
    }

    #[test]
    fn what_is_public_needs_three_words() {
        assert_eq!(thin("/// Of two.\npub fn a() {}\n\npub struct B;\n"), [1, 3]);
        assert_eq!(thin("/// Three words now.\npub fn a() {}\n\nstruct B;\npub(crate) struct C;\n"), [0; 0]);
        assert_eq!(
            thin(
                "/// Some kind of thing.\npub struct A {\n    /// Where.\n    pub at: f64,\n    b: f64,\n}\n"
            ),
            [3]
        );
    }

    #[test]
    fn variants_and_their_fields_are_as_public_as_their_enum() {
        let text = |visibility| {
            format!(
                "/// What went wrong there.\n{visibility}enum A {{\n    /// It is gone now.\n    B {{\n        /// Why.\n        why: String,\n    }},\n    /// None.\n    C,\n}}\n"
            )
        };
        assert_eq!(thin(&text("pub ")), [5, 8]);
        assert_eq!(thin(&text("")), [0; 0]);
    }

    #[test]
    fn re_exports_and_flattened_fields_need_none() {
        assert_eq!(thin("pub use a::b;\npub mod c;\n"), [0; 0]);
        assert_eq!(
            thin("/// Options of a kind.\npub struct A {\n    #[command(flatten)]\n    pub b: B,\n}\n"),
            [0; 0]
        );
    }
}
