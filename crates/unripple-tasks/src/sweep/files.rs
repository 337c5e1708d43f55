//! Files that the values of a plan name: where they are, and what is in them.

use super::surface::{self, origin};
use super::tasks::tasks;
use crate::commands::Names;
use crate::record::{of_bytes, of_path};
use crate::{SurfaceAsk, TaskError};
use serde_json::{Map, Value};
use std::collections::{BTreeSet, HashMap};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use unripple_store::{
    AxisValues, BUILTINS, Designs, Library, PlanFile, Varied, load_plan, plan_surface, surface_files, to_toml,
};

/// What is known of files that a plan names, each of which is read once by a process.
#[derive(Clone, Debug)]
pub(super) struct Files {
    /// The folder that the plan names files from.
    folder: PathBuf,
    /// The folder of its surface file; `None` of a surface that can name no file.
    ground: Option<PathBuf>,
    known: Arc<Mutex<Known>>,
}

#[derive(Debug, Default)]
struct Known {
    /// SHA-256 of files by their paths; `None` where there is none.
    hashes: HashMap<PathBuf, Option<String>>,
    /// Surfaces by the JSON of what names them.
    surfaces: HashMap<String, SurfaceAsk>,
}

impl Files {
    /// Nothing is known yet of the files that a plan names from this folder.
    pub fn of(folder: &Path, ground: Option<&Path>) -> Self {
        Self { folder: folder.into(), ground: ground.map(Path::to_path_buf), known: Arc::default() }
    }

    /// SHA-256, in hexadecimal digits, of each file that some values name, by `ask:NAME` or `surface:NAME`. Any text that is the path
    /// of a file is taken for its name.
    pub fn named<'v>(&self, values: impl Iterator<Item = (&'v Varied, &'v Value)>) -> Map<String, Value> {
        let mut found = Map::new();
        for (varied, value) in values {
            let (kind, folder) = match varied {
                Varied::Ask(_) => ("ask", Some(&self.folder)),
                Varied::Surface(_) => ("surface", self.ground.as_ref()),
            };
            let Some(folder) = folder else { continue };
            for text in texts(value) {
                if let Some(hash) = self.sha256(folder, text) {
                    found.insert(format!("{kind}:{text}"), hash.into());
                }
            }
        }
        found
    }

    fn sha256(&self, folder: &Path, text: &str) -> Option<String> {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        known.hashes.entry(folder.join(text)).or_insert_with(|| hash(folder, text)).clone()
    }
}

impl Names for Files {
    fn surface(&mut self, surface: &mut SurfaceAsk) {
        let (SurfaceAsk::Name(name) | SurfaceAsk::Set { name, .. }) = &mut *surface else { return };
        if BUILTINS.iter().any(|builtin| builtin.name == *name) {
            return;
        }
        *name = self.folder.join(&*name).to_string_lossy().into_owned();
        let asked = serde_json::to_string(&*surface).unwrap_or_default();
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        *surface = known.surfaces.entry(asked).or_insert_with(|| read(surface)).clone();
    }

    fn file(&mut self, path: &mut PathBuf) {
        // An empty path is none.
        if !path.as_os_str().is_empty() {
            *path = self.folder.join(&*path);
        }
    }
}

/// A surface as its text; a library, or what cannot be read, by its name, for the task to open.
fn read(surface: &SurfaceAsk) -> SurfaceAsk {
    match surface.load() {
        Ok(read) => SurfaceAsk::Text { toml: to_toml(&read), name: Some(surface.to_string()) },
        Err(_) => surface.clone(),
    }
}

/// SHA-256 of the file that a text names; `None` if it names none. What cannot be read is the task's to say.
fn hash(folder: &Path, text: &str) -> Option<String> {
    let hashes: Result<Vec<_>, TaskError> = paths(folder, text).iter().map(|path| of_path(path)).collect();
    match hashes.ok()?.as_slice() {
        [] => None,
        [one] => Some(one.clone()),
        several => Some(of_bytes(several.concat().as_bytes())),
    }
}

/// What is read of the file that a text names, if it names one: a surface file with its drawings, a library, or any other file.
fn paths(folder: &Path, text: &str) -> Vec<PathBuf> {
    if text.is_empty() || BUILTINS.iter().any(|builtin| builtin.name == text) {
        return Vec::new();
    }
    let path = folder.join(text);
    match path.is_file() {
        true => surface_files(&path.to_string_lossy(), &[]),
        false if Library::is_at(&path) => vec![path],
        false => Vec::new(),
    }
}

/// The texts in a value, without keys.
fn texts(value: &Value) -> Vec<&str> {
    match value {
        Value::String(text) => vec![text],
        Value::Array(list) => list.iter().flat_map(texts).collect(),
        Value::Object(map) => map.values().flat_map(texts).collect(),
        Value::Null | Value::Bool(_) | Value::Number(_) => Vec::new(),
    }
}

/// The values of all designs, those of each axis once; numbers of ranges, which name no file, are left out.
pub(super) fn values(designs: &Designs) -> Vec<(&Varied, &Value)> {
    match designs {
        Designs::Grid(axes) | Designs::Sobol { axes, .. } => {
            let mut found = Vec::new();
            for axis in axes {
                if let AxisValues::List(list) = &axis.values {
                    found.extend(list.iter().map(|value| (&axis.varied, value)));
                }
            }
            found
        }
        Designs::List(list) => list.iter().flatten().map(|(varied, value)| (varied, value)).collect(),
    }
}

/// The fields that all designs of a plan have, as values.
pub(super) fn asked(file: &PlanFile) -> Vec<(Varied, &Value)> {
    file.ask.iter().map(|(field, value)| (Varied::Ask(field.clone()), value)).collect()
}

/// Files that the plan in a file reads besides its own; of one with faults, which its reader tells, those of its surface.
pub(crate) fn reads(plan: &Path) -> Vec<PathBuf> {
    match load_plan(plan, &tasks()) {
        Ok(file) => reads_of(plan, &file),
        Err(_) => plan_surface(plan).map_or_else(Vec::new, |(surface, folder)| {
            surface::reads(&origin(plan, folder.as_deref()), &surface)
        }),
    }
}

/// As [`reads`], of a plan that has been read.
pub(crate) fn reads_of(plan: &Path, file: &PlanFile) -> Vec<PathBuf> {
    let folder = origin(plan, file.folder.as_deref());
    let mut found = surface::reads(&folder, &file.surface);
    let ground = found.first().filter(|path| path.is_file()).map(|path| surface::folder(path).to_path_buf());
    let fields = asked(file);
    let all = fields.iter().map(|(varied, value)| (varied, *value)).chain(values(&file.designs));
    let mut seen = BTreeSet::new();
    for (varied, value) in all {
        let from = match varied {
            Varied::Ask(_) => Some(folder.as_path()),
            Varied::Surface(_) => ground.as_deref(),
        };
        let named = from.into_iter().flat_map(|from| texts(value).into_iter().map(move |text| (from, text)));
        for (from, text) in named.filter(|named| seen.insert(*named)) {
            found.extend(paths(from, text));
        }
    }
    let mut once = BTreeSet::new();
    found.retain(|path| once.insert(path.clone()));
    found
}
