//! The schema of reports, and what a report holds against it.

use serde_json::Value;
use std::sync::OnceLock;
use unripple_tasks::REPORT_SCHEMA;

/// The schema as JSON.
pub fn schema() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(|| serde_json::from_str(REPORT_SCHEMA).unwrap())
}

/// What the schema does not allow of a report, a line each, with the place in the report first.
pub fn faults(report: &Value) -> Vec<String> {
    static VALIDATOR: OnceLock<jsonschema::Validator> = OnceLock::new();
    let validator = VALIDATOR.get_or_init(|| jsonschema::validator_for(schema()).unwrap());
    validator.iter_errors(report).map(|error| format!("{}: {error}", error.instance_path())).collect()
}
