//! A plan of a search, opened.

use super::samples::samples;
use crate::record::of_bytes;
use crate::sweep::{self, Plan, canonical, origin, written};
use crate::{SurfaceAsk, TaskError};
use serde_json::{Value, json};
use std::fs::canonicalize;
use std::path::{Component, Path, PathBuf};
use unripple_store::{Axis, AxisValues, Designs, SearchFile, Varied, load_search};

/// A plan of a search with its surface.
#[derive(Clone, Debug)]
pub struct Search {
    file: SearchFile,
    /// The folder that the plan names files from.
    origin: PathBuf,
    /// Designs with all listed values of the unknowns and with both ends of ranges, by which the plan was checked.
    samples: Plan,
    hash: String,
}

impl Search {
    /// Opens a plan from its file, and its surface.
    ///
    /// # Errors
    /// [`TaskError::Faults`] with all faults of the file; [`TaskError::Input`] of a surface that is not there, of keys that surface files
    /// do not have, of fields with values of the wrong kind, and of figures that depend on the clock.
    pub fn open(path: &Path) -> Result<Self, TaskError> {
        let file = load_search(path, &sweep::tasks())?;
        let samples = Plan::of(path, samples(&file))?;
        // Of the number of generations no design depends: a search may be made longer.
        let mut kept = json!({
            "task": file.task, "surface": samples.surface_sha256(), "ask": file.ask, "axes": file.axes, "figures": file.figures,
            "seed": file.seed, "population": file.population, "objectives": file.objectives, "constraints": file.constraints,
        });
        let named = samples.named();
        if !named.is_empty() {
            kept["files"] = named.into();
        }
        let hash = of_bytes(canonical(&kept).as_bytes());
        Ok(Self { origin: origin(path, file.folder.as_deref()), samples, hash, file })
    }

    /// The plan as its file has it.
    pub fn file(&self) -> &SearchFile {
        &self.file
    }

    /// The folder that the plan names files from.
    pub(super) fn origin(&self) -> &Path {
        &self.origin
    }

    /// SHA-256, in hexadecimal digits, of all that the designs of a search follow from, but for the optimiser itself.
    pub fn hash(&self) -> &str {
        &self.hash
    }

    /// Names of the unknowns, `surface:KEY` and `ask:FIELD`, in the order of the plan.
    pub(super) fn names(&self) -> Vec<String> {
        self.file.axes.iter().map(|axis| axis.varied.to_string()).collect()
    }

    /// Whether a plan of a sweep is over designs of this search.
    pub(super) fn owns(&self, plan: &Plan) -> bool {
        let (own, other) = (&self.file, plan.file());
        let same = own.task == other.task && own.ask == other.ask && own.figures == other.figures;
        let sorted = |mut names: Vec<String>| {
            names.sort_unstable();
            names
        };
        let names = sorted(self.names());
        let whole = |design: &Vec<(Varied, Value)>| {
            sorted(design.iter().map(|(varied, _)| varied.to_string()).collect()) == names
        };
        let all = matches!(&other.designs, Designs::List(designs) if designs.iter().all(whole));
        same && all && plan.surface_sha256() == self.samples.surface_sha256() && self.reads_as(plan)
    }

    /// Whether the files that a plan names are those of this search.
    fn reads_as(&self, plan: &Plan) -> bool {
        let known = self.samples.named();
        plan.asked() == self.samples.asked()
            && plan.named().iter().all(|(name, hash)| known.get(name) == Some(hash))
    }

    /// What the plans of all generations begin with, in TOML; tables headed `[[design]]` follow. `asked` is the folder of these plans,
    /// which name files as the plan of the search does.
    ///
    /// # Errors
    /// [`TaskError::Input`] if the folder that the plan names files from is not there.
    pub(super) fn head(&self, asked: &Path) -> Result<String, TaskError> {
        let file = &self.file;
        let text = |text: &str| Value::from(text).to_string();
        let figures = file.figures.iter().map(|figure| text(figure)).collect::<Vec<_>>().join(", ");
        let ask = Value::Object(file.ask.clone().into_iter().collect());
        Ok(format!(
            "format = 1\nname = {}\nfolder = {}\ntask = {}\nsurface = {}\nask = {}\nshard = {}\nfigures = [{figures}]\n",
            text(&file.name),
            text(&between(asked, &self.origin)?.to_string_lossy()),
            text(&file.task),
            text(&file.surface),
            written(&ask),
            file.shard,
        ))
    }

    /// The unknowns as an optimiser is told them: each with its name, and with two ends, or with values and how a plan writes these.
    pub(super) fn unknowns(&self) -> Vec<Value> {
        let one = |axis: &Axis| match &axis.values {
            AxisValues::List(values) => {
                let texts: Vec<String> = values.iter().map(written).collect();
                json!({ "name": axis.varied, "values": values, "written": texts })
            }
            AxisValues::Range { from, to, log, whole, .. } => {
                json!({ "name": axis.varied, "from": from, "to": to, "log": log, "whole": whole })
            }
        };
        self.file.axes.iter().map(one).collect()
    }

    /// The text of a surface file with the keys that a design sets; `None` if it sets none, or the surface is no text.
    ///
    /// # Errors
    /// [`TaskError::Input`] of keys that cannot be set.
    pub(super) fn surface_of(&self, design: &[(Varied, Value)]) -> Result<Option<String>, TaskError> {
        let key = |(varied, value): &(Varied, Value)| match varied {
            Varied::Surface(key) => Some((key.clone(), written(value))),
            Varied::Ask(_) => None,
        };
        let keys: Vec<(String, String)> = design.iter().filter_map(key).collect();
        if keys.is_empty() {
            return Ok(None);
        }
        match self.samples.surface_with(keys)? {
            SurfaceAsk::Text { toml, .. } => Ok(Some(toml)),
            _ => Ok(None),
        }
    }
}

/// The path from one folder to another. Both are taken for where they really are: from a folder that is a link, `..` leads elsewhere than
/// its path says.
fn between(from: &Path, to: &Path) -> Result<PathBuf, TaskError> {
    let real = |folder: &Path| {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        canonicalize(folder).map_err(|error| {
            TaskError::Input(format!("{}: expected a folder, found {error}", folder.display()))
        })
    };
    let (from, to) = (real(from)?, real(to)?);
    let shared = from.components().zip(to.components()).take_while(|(one, other)| one == other).count();
    if shared == 0 {
        // On two drives of one machine.
        return Ok(to);
    }
    let up = from.components().skip(shared).map(|_| Component::ParentDir);
    let path: PathBuf = up.chain(to.components().skip(shared)).collect();
    Ok(if path.as_os_str().is_empty() { PathBuf::from(".") } else { path })
}

#[cfg(test)]
mod tests {
    use super::between;
    use std::fs;
    use std::path::Path;

    #[test]
    fn one_folder_is_found_from_another() {
        let scratch = std::env::temp_dir().join(format!("unripple-between-{}", std::process::id()));
        let (deep, other) = (scratch.join("a/deep"), scratch.join("other"));
        for folder in [&deep, &other] {
            fs::create_dir_all(folder).unwrap();
        }
        assert_eq!(between(&scratch, &deep).unwrap(), Path::new("a/deep"));
        assert_eq!(between(&deep, &other).unwrap(), Path::new("../../other"));
        assert_eq!(between(&deep, &deep).unwrap(), Path::new("."));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(&deep, scratch.join("link")).unwrap();
            assert_eq!(between(&scratch.join("link"), &other).unwrap(), Path::new("../../other"));
        }
        assert!(between(&scratch.join("none"), &other).is_err());
        fs::remove_dir_all(&scratch).unwrap();
        // The folder that a plan without a folder before its name is in.
        assert_eq!(between(Path::new(""), &std::env::current_dir().unwrap()).unwrap(), Path::new("."));
    }
}
