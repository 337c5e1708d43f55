//! The surface that is being designed: edits, undo and redo.

mod apply;
mod places;

pub use apply::apply;

use crate::ViewError;
use crate::wire::Edit;
use apply::edge;
use unripple::core::{Material, Surface};
use unripple_store::{parse_surface, to_toml};

/// Shortest length of an outline that is drawn at all, in mm; other limits are those of the surface file.
const LEAST_MM: f64 = 0.1;

/// Largest number of undo steps; the oldest are dropped. Each is a few kilobytes.
const MOST: usize = 200;

/// A surface that is edited, with its earlier states for undo and redo.
///
/// ```
/// use unripple_session::{Draft, Edit};
///
/// let mut draft = Draft::new(unripple::physics::design::papers_surface());
/// draft.edit(&Edit { actuator: Some(0), at_mm: Some([30.0, 40.0]), ..Edit::default() })?;
/// assert!((draft.surface().actuators[0].at.x - 0.03).abs() < 1e-12);
/// assert!(draft.undo());
/// # Ok::<(), unripple_session::ViewError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Draft {
    surface: Surface,
    /// Number of the page that edits.
    by: u64,
    /// Before that page's edit that is under way, if it is not settled.
    base: Option<Surface>,
    past: Vec<Step>,
    future: Vec<Step>,
}

/// A state to which an undo or a redo leads back, and the number of the page whose edit that takes back or repeats.
#[derive(Clone, Debug)]
struct Step {
    surface: Surface,
    by: u64,
}

impl Draft {
    /// A draft that begins with a surface.
    pub fn new(surface: Surface) -> Self {
        Self { surface, by: 0, base: None, past: Vec::new(), future: Vec::new() }
    }

    /// Counts edits from now on as those of a page, given by its number; 0 for nobody's. What another page has under way becomes an undo
    /// step of that page.
    pub fn hand_to(&mut self, page: u64) {
        if page == self.by {
            return;
        }
        if let Some(base) = self.base.take().filter(|base| *base != self.surface) {
            self.keep(base);
        }
        self.by = page;
    }

    /// Numbers of the pages whose edits an undo takes back and a redo repeats; `None` where there is none.
    pub fn whose(&self) -> (Option<u64>, Option<u64>) {
        let by = |steps: &[Step]| steps.last().map(|step| step.by);
        match self.base {
            Some(_) => (Some(self.by), None),
            None => (by(&self.past), by(&self.future)),
        }
    }

    /// The surface as it is now.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Whether an edit can be undone, and whether one can be redone.
    pub fn ways(&self) -> (bool, bool) {
        let (undoes, redoes) = self.whose();
        (undoes.is_some(), redoes.is_some())
    }

    /// Applies an edit of the page that edited last. Edits that are not settled, as during a drag, form one undo step with the next settled
    /// one.
    ///
    /// # Errors
    /// [`ViewError::Range`] for names and actuators that do not exist; [`ViewError::Store`] with all faults that the edited surface would
    /// have. The surface then stays as it was.
    pub fn edit(&mut self, edit: &Edit) -> Result<(), ViewError> {
        self.edit_by(self.by, edit)
    }

    /// As [`edit`](Self::edit), for a page given by its number, to which the surface is [handed](Self::hand_to) if the edit can be applied.
    ///
    /// # Errors
    /// Those of [`edit`](Self::edit); what another page has under way then stays under way.
    pub fn edit_by(&mut self, page: u64, edit: &Edit) -> Result<(), ViewError> {
        known(edit, self.surface.actuators.len())?;
        let edited = checked(&apply(&self.surface, edit))?;
        self.hand_to(page);
        let before = std::mem::replace(&mut self.surface, edited);
        let base = self.base.take().unwrap_or(before);
        if edit.settled == Some(false) {
            self.base = Some(base);
        } else if base != self.surface {
            self.keep(base);
        }
        Ok(())
    }

    /// Replaces the surface by another one, as one undo step.
    pub fn replace(&mut self, surface: Surface) {
        let before = std::mem::replace(&mut self.surface, surface);
        let base = self.base.take().unwrap_or(before);
        self.keep(base);
    }

    /// Undoes one edit; returns whether there was one.
    pub fn undo(&mut self) -> bool {
        if let Some(base) = self.base.take() {
            self.keep(base);
        }
        let Some(Step { surface, by }) = self.past.pop() else { return false };
        self.future.push(Step { surface: std::mem::replace(&mut self.surface, surface), by });
        true
    }

    /// Redoes one edit; returns whether there was one. While an edit is under way there is none.
    pub fn redo(&mut self) -> bool {
        if self.base.is_some() {
            return false;
        }
        let Some(Step { surface, by }) = self.future.pop() else { return false };
        self.past.push(Step { surface: std::mem::replace(&mut self.surface, surface), by });
        true
    }

    fn keep(&mut self, before: Surface) {
        self.future.clear();
        self.past.push(Step { surface: before, by: self.by });
        if self.past.len() > MOST {
            self.past.remove(0);
        }
    }
}

/// Refuses names, actuators and lengths that no surface can have.
fn known(edit: &Edit, actuators: usize) -> Result<(), ViewError> {
    let refuse =
        |what, expected: String, found: &str| Err(ViewError::Range { what, expected, found: found.into() });
    if let Some(name) = edit.material.as_deref().filter(|name| Material::named(name).is_none()) {
        return refuse("material", Material::names().join(", "), name);
    }
    if let Some(name) = edit.edge.as_deref().filter(|name| edge(name).is_none()) {
        return refuse("edge", "clamped, supported or free".into(), name);
    }
    let sides = edit.rectangle_mm.iter().flatten().chain(&edit.circle_mm);
    let radius = edit.stadium_mm.iter().map(|[_, radius]| radius);
    if let Some(length) = sides.chain(radius).find(|mm| !(**mm >= LEAST_MM && mm.is_finite())) {
        return refuse("length in mm", format!("at least {LEAST_MM}"), &length.to_string());
    }
    if let Some([straight, _]) =
        edit.stadium_mm.filter(|[straight, _]| !(*straight >= 0.0 && straight.is_finite()))
    {
        return refuse("straight length in mm", "0 or more".into(), &straight.to_string());
    }
    let actuators = edit.actuators.unwrap_or(actuators);
    match edit.actuator {
        Some(index) if index >= actuators => {
            refuse("actuator", format!("less than {actuators}, their number"), &index.to_string())
        }
        _ => Ok(()),
    }
}

/// The surface as it is read back from the text of its file: this refuses what a file cannot hold, and shows what would be saved.
fn checked(surface: &Surface) -> Result<Surface, ViewError> {
    parse_surface(&to_toml(surface), &surface.name).map_err(|faults| ViewError::Store(faults.into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple::physics::design::papers_surface;

    fn tension(value: f64, settled: bool) -> Edit {
        Edit { tension_n_per_m: Some(value), settled: Some(settled), ..Edit::default() }
    }

    #[test]
    fn a_drag_is_one_step_back() {
        let mut draft = Draft::new(papers_surface());
        for value in [210.0, 220.0, 230.0] {
            draft.edit(&tension(value, false)).unwrap();
        }
        draft.edit(&tension(240.0, true)).unwrap();
        draft.edit(&tension(100.0, true)).unwrap();
        assert!(draft.undo() && draft.surface().sheet.tension == 240.0);
        assert!(draft.undo() && draft.surface().sheet.tension == 200.0);
        assert!(!draft.undo());
        assert!(draft.redo() && draft.surface().sheet.tension == 240.0);
        draft.edit(&tension(50.0, true)).unwrap();
        assert!(!draft.redo());
    }

    #[test]
    fn a_refused_edit_of_another_page_leaves_a_drag_as_it_is() {
        let mut draft = Draft::new(papers_surface());
        draft.edit_by(1, &tension(230.0, false)).unwrap();
        assert_eq!((draft.whose(), draft.ways()), ((Some(1), None), (true, false)));
        draft.edit_by(2, &Edit { thickness_mm: Some(0.0), ..Edit::default() }).unwrap_err();
        assert_eq!(draft.whose(), (Some(1), None));
        draft.edit_by(1, &tension(240.0, true)).unwrap();
        assert_eq!(draft.whose(), (Some(1), None));
        assert!(draft.undo() && draft.surface() == &papers_surface());
        assert!(!draft.undo());
    }

    #[test]
    fn an_edit_of_another_page_is_no_part_of_a_drag() {
        let mut draft = Draft::new(papers_surface());
        let before = draft.surface().sheet.clone();
        draft.edit_by(1, &tension(230.0, false)).unwrap();
        draft.edit_by(2, &Edit { thickness_mm: Some(0.15), ..Edit::default() }).unwrap();
        draft.edit_by(1, &tension(240.0, true)).unwrap();
        let thick = draft.surface().sheet.thickness;
        assert!((thick - 0.15e-3).abs() < 1e-12 && thick != before.thickness);
        for (page, tension, thickness) in
            [(1, 230.0, thick), (2, 230.0, before.thickness), (1, before.tension, before.thickness)]
        {
            assert_eq!(draft.whose().0, Some(page));
            assert!(draft.undo());
            assert_eq!(
                (draft.surface().sheet.tension, draft.surface().sheet.thickness),
                (tension, thickness)
            );
        }
        assert_eq!(draft.whose(), (None, Some(1)));
    }

    #[test]
    fn nothing_is_redone_in_the_middle_of_a_drag() {
        let mut draft = Draft::new(papers_surface());
        draft.edit_by(2, &tension(100.0, true)).unwrap();
        assert!(draft.undo() && draft.ways() == (false, true));
        draft.edit_by(1, &tension(230.0, false)).unwrap();
        assert_eq!(draft.ways(), (true, false));
        assert!(!draft.redo() && draft.surface().sheet.tension == 230.0);
    }

    #[test]
    fn what_cannot_be_is_refused_and_nothing_changes() {
        let mut draft = Draft::new(papers_surface());
        let away = Edit { actuator: Some(0), at_mm: Some([900.0, 10.0]), ..Edit::default() };
        let why = draft.edit(&away).unwrap_err().to_string();
        assert!(why.starts_with("actuator[0].at_mm: expected"), "{why}");
        for edit in [
            Edit { material: Some("unobtainium".into()), ..Edit::default() },
            Edit { edge: Some("magic".into()), ..Edit::default() },
            Edit { actuator: Some(8), at_mm: Some([9.0, 9.0]), ..Edit::default() },
            Edit { thickness_mm: Some(0.0), ..Edit::default() },
        ] {
            assert!(draft.edit(&edit).unwrap_err().to_string().contains("expected"));
        }
        assert_eq!(draft.surface(), &papers_surface());
        assert_eq!(draft.ways(), (false, false));
    }
}
