//! Tasks that plans of sweeps may name.

use crate::commands::{Command, TASKS};
use serde_json::Value;
use unripple_store::PlanTask;

/// Tasks of devices, or that look at this machine: their reports are of the moment, and no process may disturb another.
const OF_DEVICES: [&str; 4] = ["verify", "drift", "doctor", "play"];

/// Fields that a plan does not set: the surface has a key of its own, and designs write no files.
const NOT_SET: [&str; 2] = ["surface", "output"];

/// Tasks that plans may name, with the fields that they may set: tasks of one surface that need neither a device nor a folder.
pub(crate) fn tasks() -> Vec<PlanTask> {
    let task = |task: &Command| {
        let Ok(Value::Object(ask)) = (task.default_ask)() else { return None };
        let writes = ask.get("output").is_some_and(|output| !output.is_null());
        let fits = ask.contains_key("surface") && !writes && !OF_DEVICES.contains(&task.name);
        let fields = ask.keys().filter(|field| !NOT_SET.contains(&field.as_str())).cloned();
        fits.then(|| (task.name, fields.collect()))
    };
    TASKS.iter().filter_map(task).collect()
}
