//! Circular dependencies between the files of a crate: files that need each other, directly or through others.

mod reading;
mod tokens;

use crate::sources;
use reading::{Module, Names, read};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Most imports that one name is followed through.
const HOPS: usize = 16;

/// Files of a crate that need each other.
pub struct Circle {
    /// The crate's folder.
    pub name: String,
    /// The files, below its `src`.
    pub files: Vec<String>,
    /// Dependencies between these files: from, to, and the names that are needed.
    pub needs: Vec<(String, String, Vec<String>)>,
}

impl std::fmt::Display for Circle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        writeln!(f, "{}: {} files: {}", self.name, self.files.len(), self.files.join(", "))?;
        self.needs
            .iter()
            .try_for_each(|(from, to, names)| writeln!(f, "    {from} -> {to}: {}", names.join(", ")))
    }
}

/// Finds the circular dependencies within every crate.
///
/// A file needs another if its code, tests left out, names or imports an item that is defined there. An item that is reached through
/// re-exports counts as needed from the file that defines it; a re-export itself is no need.
pub fn find(root: &Path) -> Vec<Circle> {
    let mut manifests = sources::files(&root.join("crates"), &["Cargo.toml"]);
    manifests.push(root.join("xtask/Cargo.toml"));
    manifests.iter().filter_map(|manifest| manifest.parent()).flat_map(of_crate).collect()
}

fn of_crate(folder: &Path) -> Vec<Circle> {
    let source = folder.join("src");
    let sources = sources::files(&source, &[".rs"]).into_iter().map(|path| {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        (path.strip_prefix(&source).unwrap_or(&path).to_path_buf(), text)
    });
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    Sources::of(sources).circles(&name)
}

/// Path of the module that a file holds.
fn module(file: &Path) -> Module {
    let mut path: Module =
        file.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if path.last().is_some_and(|last| last == "mod")
        || matches!(&path[..], [one] if one == "lib" || one == "main")
    {
        path.pop();
    }
    path
}

/// A crate's files by their modules.
struct Sources {
    files: Vec<PathBuf>,
    /// Every module: its file, and what is in it.
    modules: BTreeMap<Module, (usize, Names)>,
}

impl Sources {
    fn of(sources: impl Iterator<Item = (PathBuf, String)>) -> Self {
        let (mut files, mut modules) = (Vec::new(), BTreeMap::new());
        for (file, text) in sources {
            for (module, names) in read(&text, &module(&file)) {
                modules.insert(module, (files.len(), names));
            }
            files.push(file);
        }
        Self { files, modules }
    }

    /// Resolves a path written in a module to one from the crate's root; `None` if it leads out of the crate.
    fn absolute(&self, path: &[String], module: &Module) -> Option<Module> {
        let (first, rest) = path.split_first()?;
        let mut start = match first.as_str() {
            "crate" => return Some(rest.to_vec()),
            "self" => module.clone(),
            "super" => module.split_last()?.1.to_vec(),
            name => {
                let child = [&module[..], &[name.to_owned()]].concat();
                let known = self.modules.contains_key(&child);
                return known.then(|| [&child[..], rest].concat());
            }
        };
        let ups = rest.iter().take_while(|next| *next == "super").count();
        start.truncate(start.len().checked_sub(ups)?);
        Some([&start[..], &rest[ups..]].concat())
    }

    /// Resolves a path in a module's code, which may also begin with a name that the module imports.
    fn spoken(&self, path: &[String], module: &Module) -> Option<Module> {
        self.absolute(path, module).or_else(|| {
            let (first, rest) = path.split_first()?;
            let import = self.modules.get(module)?.1.imported.get(first)?;
            Some([&self.absolute(&import.path, module)?[..], rest].concat())
        })
    }

    /// The file that defines what a path leads to, and the item's name; nothing for a module as such.
    fn defines(&self, path: &Module, hops: usize) -> Option<(usize, String)> {
        let within = (0..path.len()).rev().find(|n| self.modules.contains_key(&path[..*n]))?;
        if self.modules.contains_key(path) || hops == 0 {
            return None;
        }
        let (module, name) = (path[..within].to_vec(), &path[within]);
        let (file, names) = &self.modules[&module];
        if names.defined.contains(name) {
            return Some((*file, name.clone()));
        }
        if let Some(import) = names.imported.get(name) {
            let to = [&self.absolute(&import.path, &module)?[..], &path[within + 1..]].concat();
            return self.defines(&to, hops - 1);
        }
        let through = |glob: &Vec<String>| {
            let to = self.absolute(glob, &module)?;
            let offers = |names: &Names| names.defined.contains(name) || names.imported.contains_key(name);
            self.modules.get(&to).filter(|(_, names)| offers(names))?;
            self.defines(&[&to[..], &path[within..]].concat(), hops - 1)
        };
        names.globs.iter().find_map(through).or(Some((*file, name.clone())))
    }

    /// What each file needs of which other: names by pairs of files.
    fn needs(&self) -> BTreeMap<(usize, usize), BTreeSet<String>> {
        let mut needs: BTreeMap<_, BTreeSet<String>> = BTreeMap::new();
        for (module, (file, names)) in &self.modules {
            let imports = names.imported.iter().filter(|(name, import)| {
                // Whoever has no code passes on, and is not in need.
                !names.spoken.is_empty() && (!import.public || names.spoken.contains(*name))
            });
            let imported = imports.filter_map(|(_, import)| self.absolute(&import.path, module));
            let spoken = names.paths.iter().filter_map(|path| self.spoken(path, module));
            let globs = names.globs.iter().filter_map(|glob| self.absolute(glob, module));
            let all = globs.flat_map(|from| {
                let offered = self.modules.get(&from).map(|(_, names)| names);
                let known = move |name: &&String| {
                    offered.is_some_and(|o| o.defined.contains(*name) || o.imported.contains_key(*name))
                };
                let path = move |name: &String| [&from[..], std::slice::from_ref(name)].concat();
                names.spoken.iter().filter(known).map(path).collect::<Vec<_>>()
            });
            for path in imported.chain(spoken).chain(all) {
                if let Some((to, name)) = self.defines(&path, HOPS).filter(|(to, _)| to != file) {
                    needs.entry((*file, to)).or_default().insert(name);
                }
            }
        }
        needs
    }

    fn circles(&self, name: &str) -> Vec<Circle> {
        let needs = self.needs();
        let reach: Vec<BTreeSet<usize>> = (0..self.files.len()).map(|file| reached(file, &needs)).collect();
        let (mut done, mut circles) = (BTreeSet::new(), Vec::new());
        let shown = |file: usize| self.files[file].display().to_string();
        for file in 0..self.files.len() {
            let circle: Vec<usize> =
                reach[file].iter().copied().filter(|other| reach[*other].contains(&file)).collect();
            if circle.is_empty() || !done.insert(circle.clone()) {
                continue;
            }
            let within = needs.iter().filter(|((from, to), _)| circle.contains(from) && circle.contains(to));
            circles.push(Circle {
                name: name.to_owned(),
                files: circle.iter().map(|file| shown(*file)).collect(),
                needs: within
                    .map(|((from, to), names)| (shown(*from), shown(*to), names.iter().cloned().collect()))
                    .collect(),
            });
        }
        circles
    }
}

/// All files that one needs, directly or through others: itself too if it is on a circle.
fn reached(from: usize, needs: &BTreeMap<(usize, usize), BTreeSet<String>>) -> BTreeSet<usize> {
    let (mut found, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(file) = open.pop() {
        let next = needs.range((file, 0)..(file + 1, 0)).map(|((_, to), _)| *to);
        open.extend(next.filter(|to| found.insert(*to)).collect::<Vec<_>>());
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circles(sources: &[(&str, &str)]) -> Vec<Vec<String>> {
        let sources = sources.iter().map(|(file, text)| (PathBuf::from(file), (*text).to_owned()));
        Sources::of(sources).circles("here").into_iter().map(|circle| circle.files).collect()
    }

    #[test]
    fn files_that_need_each_other_are_a_circle() {
        let found = circles(&[
            ("lib.rs", "mod a; mod b; mod c;"),
            ("a.rs", "use crate::b::B; pub struct A(B);"),
            ("b.rs", "pub struct B; fn f() { super::a::A; }"),
            ("c.rs", "use crate::a::A; fn g(a: A) {}"),
        ]);
        assert_eq!(found, [["a.rs", "b.rs"]]);
    }

    #[test]
    fn who_only_passes_on_is_on_no_circle() {
        let lower = ("p/low.rs", "pub struct Low;");
        let upper = ("p/up.rs", "use super::Low; pub struct Up(Low);");
        let parent = ("p/mod.rs", "mod low; mod up; pub use low::Low; use up::Up;");
        assert!(circles(&[("lib.rs", "mod p; pub use p::Low;"), lower, upper, parent]).is_empty());
        // A parent with code of its own that its child needs is on one, and so are files that need each other through it.
        let busy =
            ("p/mod.rs", "mod low; mod up; pub use low::Low; use up::Up; fn f(up: Up) {} const C: u8 = 1;");
        let needy = ("p/up.rs", "pub struct Up; fn g() -> u8 { super::C }");
        assert_eq!(circles(&[("lib.rs", "mod p;"), lower, needy, busy]), [["p/up.rs", "p/mod.rs"]]);
        let back = ("p/low.rs", "use crate::p::Up; pub struct Low(Up);");
        let passing = ("p/mod.rs", "mod low; mod up; pub use low::*; pub use up::*;");
        assert_eq!(circles(&[("lib.rs", "mod p;"), back, upper, passing]), [["p/low.rs", "p/up.rs"]]);
    }
}
