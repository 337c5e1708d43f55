//! Report of the task `compare`.

use super::table::Table;
use super::{Compared, FailedSurface};
use serde::Serialize;
use std::fmt::Write;
use unripple::act::Level;

/// Results of all methods on each surface.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the program.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// Name of the task.
    pub command: &'static str,
    /// Results on one surface, or on several.
    #[serde(flatten)]
    pub on: On,
    /// Files in the output folder.
    pub files: Vec<String>,
    #[serde(skip)]
    pub(super) level: Level,
}

/// Results on one surface, or on several; in JSON, results on one surface are fields of the report itself.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum On {
    /// Results on the only surface.
    One(Box<Compared>),
    /// Results on several surfaces.
    Several {
        /// Results on each surface that did not fail, in the order of the request.
        surfaces: Vec<Compared>,
        /// Surfaces that failed, each with the reason.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        failed: Vec<FailedSurface>,
    },
}

impl Report {
    /// Results on each surface that did not fail, in the order of the request.
    pub fn surfaces(&self) -> &[Compared] {
        match &self.on {
            On::One(on) => std::slice::from_ref(&**on),
            On::Several { surfaces, .. } => surfaces,
        }
    }

    /// Whether there are several surfaces, so that each must be named.
    fn has_several(&self) -> bool {
        matches!(self.on, On::Several { .. })
    }

    fn table(&self) -> Table<'_> {
        Table { surfaces: self.surfaces(), several: self.has_several(), level: self.level }
    }

    /// What failed, and why: surfaces first, then methods.
    fn failed(&self) -> Vec<(String, &str)> {
        let mut all = Vec::new();
        if let On::Several { failed, .. } = &self.on {
            all.extend(failed.iter().map(|failed| (failed.label.clone(), failed.why.as_str())));
        }
        for on in self.surfaces() {
            let name = |method: &str| match self.has_several() {
                true => format!("{}, {method}", on.label),
                false => method.to_owned(),
            };
            all.extend(on.failed.iter().map(|failed| (name(failed.method), failed.why.as_str())));
        }
        all
    }

    /// Remarks on the window of each surface and on the modes that its drives were evaluated on.
    fn remarks(&self) -> Vec<String> {
        let mut all = Vec::new();
        for on in self.surfaces() {
            let of = if self.has_several() { format!("{}: ", on.label) } else { String::new() };
            all.extend(on.window_text.iter().map(|window| format!("{of}window {window}")));
            all.extend(on.judged_to_why.iter().map(|why| format!("{of}{why}")));
            all.extend(on.judged_on.iter().map(|told| format!("{of}evaluated on {told}")));
            all.extend(on.notes.iter().map(|note| format!("{of}{}", note.text)));
        }
        all
    }

    /// The report as Markdown, with a link to its picture if there is one.
    pub(super) fn markdown(&self) -> String {
        let (title, picture) = match &self.on {
            On::One(on) => (
                format!("{}: methods compared", on.surface),
                "Contrast against energy, and against the peak at the drive limit",
            ),
            On::Several { .. } => {
                ("Surfaces compared".to_owned(), "Contrast, felt contrast and energy on each surface")
            }
        };
        let mut text = format!("# {title}\n\n{}", self.table().markdown());
        for (name, why) in self.failed() {
            let _ = writeln!(text, "\n**{name}** failed: {why}");
        }
        for remark in self.remarks() {
            let _ = writeln!(text, "\n- {remark}");
        }
        if self.files.iter().any(|file| file == "compare.png") {
            let _ = writeln!(text, "\n![{picture}](compare.png)");
        }
        text
    }
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let mut text = self.table().text();
        for (name, why) in self.failed() {
            text += &format!("\n{name} failed: {why}\n");
        }
        text.extend(self.remarks().iter().map(|remark| format!("\n{remark}\n")));
        text
    }
}
