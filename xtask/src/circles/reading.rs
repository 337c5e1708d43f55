//! Declarations, imports and names of one source file.

use super::tokens::tokens;
use std::collections::{BTreeMap, BTreeSet};

/// A module's path within its crate.
pub type Module = Vec<String>;

/// Contents of one module, which is a file or a part of it.
#[derive(Debug, Default)]
pub struct Names {
    /// Items that it defines itself.
    pub defined: BTreeSet<String>,
    /// Imports of the module, by the names that they have there.
    pub imported: BTreeMap<String, Import>,
    /// Paths of modules of which it imports everything (`*`).
    pub globs: Vec<Vec<String>>,
    /// Paths that its code uses.
    pub paths: BTreeSet<Vec<String>>,
    /// All names in its code but for those of imports.
    pub spoken: BTreeSet<String>,
}

/// One import of a module.
#[derive(Debug)]
pub struct Import {
    /// Path as it is written.
    pub path: Vec<String>,
    /// Whether it is a re-export.
    pub public: bool,
}

/// Words that declare an item which other files may need.
const ITEMS: [&str; 8] = ["fn", "struct", "enum", "trait", "const", "static", "type", "union"];

/// Reads the modules in a file, tests left out; `module` is the file's own path.
pub fn read(text: &str, module: &Module) -> BTreeMap<Module, Names> {
    let tokens = tokens(text);
    let mut found = BTreeMap::from([(module.clone(), Names::default())]);
    // The module at hand, and the depth of braces at which each of its inline modules began.
    let (mut here, mut opened, mut depth) = (module.clone(), Vec::new(), 0);
    let mut i = 0;
    while i < tokens.len() {
        let at = |n: usize| tokens.get(i + n).map_or("", String::as_str);
        match at(0) {
            "#" => {
                let end = i + attribute(&tokens[i..]);
                i = if is_test(&tokens[i..end]) { end + item(&tokens[end..]) } else { end };
                continue;
            }
            // `use<'a>` in a type says what it captures.
            "use" if at(1) != "<" => {
                let end = tokens[i..].iter().position(|t| t == ";").map_or(tokens.len(), |n| i + n);
                let public = i > 0 && (tokens[i - 1] == "pub" || tokens[i - 1] == ")");
                tree(&tokens[i + 1..end], &[], public, found.entry(here.clone()).or_default());
                i = end;
            }
            "mod" if at(2) == "{" => {
                here.push(at(1).to_owned());
                opened.push(depth);
                found.entry(here.clone()).or_default();
                i += 1;
                continue;
            }
            "{" => depth += 1,
            "}" => {
                depth -= 1;
                if opened.last() == Some(&depth) {
                    opened.pop();
                    here.pop();
                }
            }
            word if is_name(word) => {
                let names = found.entry(here.clone()).or_default();
                // An inline module's own brace is counted after its name.
                if ITEMS.contains(&word) && depth == opened.len() && is_name(at(1)) {
                    names.defined.insert(at(1).to_owned());
                }
                names.spoken.insert(word.to_owned());
                let path = path(&tokens[i..]);
                if path.len() > 1 {
                    i += 2 * (path.len() - 1);
                    names.paths.insert(path);
                }
            }
            _ => {}
        }
        i += 1;
    }
    found
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Tokens of an attribute.
fn attribute(tokens: &[String]) -> usize {
    let open = tokens.iter().take(3).position(|t| t == "[");
    open.map_or(1, |open| open + balanced(&tokens[open..]))
}

fn is_test(attribute: &[String]) -> bool {
    let has = |word: &str| attribute.iter().any(|t| t == word);
    has("cfg") && has("test") && !has("not")
}

/// Tokens of the item that begins here, up to its closing brace or semicolon; attributes before it are part of it. A field or a variant
/// that is its parent's last ends before its parent's closing brace.
fn item(tokens: &[String]) -> usize {
    let mut i = 0;
    while i < tokens.len() {
        match tokens[i].as_str() {
            "{" => return i + balanced(&tokens[i..]),
            ";" => return i + 1,
            "}" => return i,
            "(" | "[" => i += balanced(&tokens[i..]),
            _ => i += 1,
        }
    }
    i
}

/// Tokens from a bracket to the one that closes it.
fn balanced(tokens: &[String]) -> usize {
    let mut depth = 0_i32;
    for (i, token) in tokens.iter().enumerate() {
        match token.as_str() {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return i + 1;
        }
    }
    tokens.len()
}

/// Names joined by `::` from here on.
fn path(tokens: &[String]) -> Vec<String> {
    let mut path = vec![tokens[0].clone()];
    for pair in tokens[1..].chunks_exact(2) {
        if pair[0] != "::" || !is_name(&pair[1]) {
            break;
        }
        path.push(pair[1].clone());
    }
    path
}

/// Notes every import of a tree such as `a::{b, c::{self, D as E}, f::*}`.
fn tree(tokens: &[String], before: &[String], public: bool, names: &mut Names) {
    let Some(first) = tokens.first() else { return };
    match first.as_str() {
        "::" => tree(&tokens[1..], before, public, names),
        "*" => names.globs.push(before.to_vec()),
        "{" => {
            let inner = &tokens[1..balanced(tokens) - 1];
            let mut start = 0;
            for end in commas(inner) {
                tree(&inner[start..end], before, public, names);
                start = end + 1;
            }
        }
        _ => {
            let mut path = before.to_vec();
            // `self` stands for what is before it, unless nothing is.
            if first != "self" || before.is_empty() {
                path.push(first.clone());
            }
            if tokens.get(1).is_some_and(|t| t == "::") {
                return tree(&tokens[2..], &path, public, names);
            }
            let renamed = tokens.get(1).filter(|t| *t == "as").and(tokens.get(2));
            if let Some(name) = renamed.or(path.last()).cloned() {
                names.imported.insert(name, Import { path, public });
            }
        }
    }
}

/// Where commas outside brackets are, and the end.
fn commas(tokens: &[String]) -> Vec<usize> {
    let (mut found, mut i) = (Vec::new(), 0);
    while i < tokens.len() {
        match tokens[i].as_str() {
            "{" => i += balanced(&tokens[i..]),
            "," => {
                found.push(i);
                i += 1;
            }
            _ => i += 1,
        }
    }
    found.push(tokens.len());
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_only_tests_have_ends_with_what_holds_it() {
        let text = "struct A { b: u8, #[cfg(test)] c: u8 }\nmod d { fn e() {} }\nfn f() {}";
        let found = read(text, &Vec::new());
        let defined = |module: &[&str]| -> Vec<String> {
            let module: Module = module.iter().map(|name| (*name).to_owned()).collect();
            found[&module].defined.iter().cloned().collect()
        };
        assert_eq!(defined(&[]), ["A", "f"]);
        assert_eq!(defined(&["d"]), ["e"]);
    }

    #[test]
    fn what_a_type_captures_is_no_import() {
        let found = read("fn a() -> impl B + use<> { c; }\nfn d() {}", &Vec::new());
        let file = &found[&Vec::new()];
        assert_eq!(file.defined.iter().collect::<Vec<_>>(), ["a", "d"]);
        assert!(file.imported.is_empty());
    }

    #[test]
    fn imports_and_paths_are_seen_and_tests_are_not() {
        let text = "pub use a::{b, c::{self, D as E}, f::*};\nfn g() { super::h::i(); }\nmod j { use super::k; struct L; }\n\
                    #[cfg(test)]\nmod tests { use super::*; fn m() {} }\n#[cfg(test)]\nuse n::o;";
        let found = read(text, &vec!["x".to_owned()]);
        let (file, inline) = (&found[&vec!["x".to_owned()]], &found[&vec!["x".to_owned(), "j".to_owned()]]);
        assert_eq!(file.imported.keys().collect::<Vec<_>>(), ["E", "b", "c"]);
        assert_eq!(
            (file.imported["E"].path.join("::").as_str(), file.imported["E"].public),
            ("a::c::D", true)
        );
        assert_eq!(file.globs, [["a", "f"]]);
        assert!(file.paths.contains(["super", "h", "i"].map(str::to_owned).as_slice()));
        assert_eq!(file.defined.iter().collect::<Vec<_>>(), ["g"]);
        assert_eq!(inline.imported["k"].path, ["super", "k"]);
        assert_eq!((inline.defined.len(), found.len()), (1, 2));
    }
}
