//! Linear algebra is called through `unripple-linalg`, which alone compiles the algorithms of the library behind it.

use crate::sources;
use std::path::Path;

/// The crate that may depend on the library.
const OWN: &str = "unripple-linalg";

/// Methods and operators of matrices that would compile an algorithm of the library in the crate that calls them.
const GENERIC: &[&str] = &[
    ".llt(",
    ".ldlt(",
    ".lblt(",
    ".partial_piv_lu(",
    ".full_piv_lu(",
    ".qr(",
    ".col_piv_qr(",
    ".svd(",
    ".thin_svd(",
    ".singular_values(",
    ".eigen(",
    ".eigenvalues(",
    ".self_adjoint_eigen(",
    "_triangular_in_place(",
    ".norm_l2(",
    ".transpose() * ",
    ".adjoint() * ",
];

/// The library's name, in parts, so that this file does not hold it.
fn library() -> String {
    ["fa", "er"].concat()
}

/// Finds dependencies on the library, paths into it and calls of its algorithms outside [`OWN`], line by line.
pub fn check(root: &Path) -> Vec<String> {
    let (mut faults, path) = (Vec::new(), format!("{}::", library()));
    for file in sources::files(&root.join("crates"), &[".rs", "Cargo.toml"]) {
        if file.components().any(|part| part.as_os_str() == OWN) {
            continue;
        }
        let text = std::fs::read_to_string(&file).unwrap_or_default();
        let manifest = file.ends_with("Cargo.toml");
        for (number, line) in text.lines().enumerate() {
            if let Some(word) = breach(line, manifest, &path) {
                faults.push(format!("{}:{}: `{word}`: call `{OWN}`", file.display(), number + 1));
            }
        }
    }
    faults
}

/// The dependency, path or call in a line that bypasses [`OWN`], if there is one.
fn breach<'a>(line: &str, manifest: bool, path: &'a str) -> Option<&'a str> {
    if manifest {
        let name = path.trim_end_matches(':');
        let key = line.trim_start().split(['.', ' ', '=']).next();
        return (key == Some(name)).then_some(name);
    }
    let generic = || GENERIC.iter().copied().find(|call| line.contains(call));
    if line.contains(path) { Some(path) } else { generic() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_round_are_seen() {
        let (name, path) = (library(), format!("{}::", library()));
        assert!(breach(&format!("{name}.workspace = true"), true, &path).is_some());
        assert!(breach(&format!("{name} = {{ version = \"1\" }}"), true, &path).is_some());
        assert!(breach("unripple-linalg.workspace = true", true, &path).is_none());
        assert!(breach(&format!("use {name}::Mat;"), false, &path).is_some());
        assert!(breach("let x = a.transpose() * &b;", false, &path).is_some());
        assert!(breach("let x = times(a.transpose(), b.as_ref());", false, &path).is_none());
    }
}
