//! Tests that the workflow and the issue forms are valid YAML with the keys that they need.

use crate::sources;
use yaml_rust2::{Yaml, YamlLoader};

fn read(path: &std::path::Path) -> Yaml {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut documents =
        YamlLoader::load_from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert_eq!(documents.len(), 1, "{}: expected one document", path.display());
    documents.remove(0)
}

/// The top level of a file may hold these keys, and must hold those.
fn keys(yaml: &Yaml, allowed: &[&str], needed: &[&str]) {
    let found: Vec<&str> = yaml.as_hash().unwrap().keys().map(|key| key.as_str().unwrap()).collect();
    assert!(found.iter().all(|key| allowed.contains(key)), "{found:?}, of which only {allowed:?} are known");
    assert!(needed.iter().all(|key| found.contains(key)), "{found:?}, of which {needed:?} are needed");
}

#[test]
fn each_job_runs_somewhere_and_does_something() {
    let workflow = read(&sources::root().join(".github/workflows/check.yml"));
    keys(&workflow, &["name", "on", "permissions", "jobs"], &["name", "on", "permissions", "jobs"]);
    let jobs = workflow["jobs"].as_hash().unwrap();
    assert!(!jobs.is_empty());
    for job in jobs.values() {
        let allowed = ["runs-on", "timeout-minutes", "strategy", "env", "steps"];
        keys(job, &allowed, &["runs-on", "timeout-minutes", "steps"]);
        let steps = job["steps"].as_vec().unwrap();
        for step in steps {
            keys(step, &["name", "uses", "run", "with"], &[]);
            assert!(step["uses"].as_str().is_some() != step["run"].as_str().is_some(), "{step:?}");
        }
        assert!(steps.iter().any(|step| step["run"].as_str().is_some()));
    }
    let systems = workflow["jobs"]["others"]["strategy"]["matrix"]["os"].as_vec().unwrap();
    assert_eq!(
        systems.iter().map(|os| os.as_str().unwrap()).collect::<Vec<_>>(),
        ["macos-latest", "windows-latest"]
    );
}

#[test]
fn the_oldest_rust_is_the_one_that_is_promised() {
    let manifest = std::fs::read_to_string(sources::root().join("Cargo.toml")).unwrap();
    let manifest: toml::Table = manifest.parse().unwrap();
    let promised = manifest["workspace"]["package"]["rust-version"].as_str().unwrap();
    let workflow = read(&sources::root().join(".github/workflows/check.yml"));
    let steps = workflow["jobs"]["oldest-rust"]["steps"].as_vec().unwrap();
    let runs: Vec<&str> = steps.iter().filter_map(|step| step["run"].as_str()).collect();
    assert!(runs.iter().any(|run| run.contains(&format!("toolchain install {promised} "))), "{runs:?}");
    assert!(runs.iter().any(|run| run.starts_with(&format!("cargo +{promised} "))), "{runs:?}");
}

#[test]
fn each_form_asks_something() {
    let forms = sources::files(&sources::root().join(".github/ISSUE_TEMPLATE"), &["fault.yml", "wish.yml"]);
    assert_eq!(forms.len(), 2);
    for form in forms.iter().map(|path| read(path)) {
        keys(&form, &["name", "description", "labels", "body"], &["name", "description", "body"]);
        let body = form["body"].as_vec().unwrap();
        assert!(!body.is_empty());
        for part in body {
            keys(part, &["type", "id", "attributes", "validations"], &["type", "id", "attributes"]);
            assert!(["textarea", "input"].contains(&part["type"].as_str().unwrap()), "{part:?}");
            keys(&part["attributes"], &["label", "description", "render"], &["label"]);
        }
    }
}
