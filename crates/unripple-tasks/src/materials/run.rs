//! Lists the materials that surface files may name.

use super::{Ask, Report};
use crate::{Progress, TaskError, go_on};
use unripple::core::{MATERIALS, Material};

/// Lists materials with their constants and the sources of these.
///
/// ```
/// use unripple_tasks::{Report, Silent, materials};
///
/// let ask = materials::Ask { name: Some("polyimide".into()) };
/// let report = materials::run(&ask, &mut Silent)?;
/// assert_eq!(report.materials[0].young_pa, 2.5e9);
/// assert!(report.text().contains("Kapton"));
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// [`TaskError::Ask`] of a name that no material has.
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    go_on(progress)?;
    match &ask.name {
        None => Ok(Report::of(MATERIALS.iter())),
        Some(name) => match Material::named(name) {
            Some(material) => Ok(Report::of([material])),
            None => Err(TaskError::ask("name", format!("one of {}", Material::names().join(", ")), name)),
        },
    }
}
