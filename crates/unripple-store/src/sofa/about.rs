//! Global attributes of a SOFA file.

use crate::LibraryPlan;
use unripple_core::{Outline, Shape};

/// Name of this software in SOFA files, by which an earlier export is recognised.
pub(super) const API: &str = "unripple";

/// Metadata of a SOFA file beyond what a library knows.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SofaAbout {
    /// Author of the data, with an address for questions.
    pub author: Option<String>,
    /// Organization where the data were measured or computed.
    pub organization: Option<String>,
    /// License of the data; if `None`, the file says that the author must be asked.
    pub license: Option<String>,
    /// Time of writing, in seconds after 1970-01-01 00:00 UTC.
    pub created: u64,
}

impl SofaAbout {
    /// The global attributes of a file, in order; the first says which program wrote the file.
    pub(super) fn attributes(&self, plan: &LibraryPlan) -> Vec<(String, String)> {
        let told = |text: &Option<String>| text.clone().unwrap_or_else(|| "not stated".into());
        let version = env!("CARGO_PKG_VERSION").to_owned();
        let date = date(self.created);
        let title = plan.surface.as_ref().map_or("A surface", |surface| surface.name.as_str()).to_owned();
        let of = |key: &str| plan.provenance.get(key).cloned();
        let history: Vec<String> =
            plan.provenance.iter().map(|(key, value)| format!("{key}: {value}")).collect();
        let license = self.license.clone();
        let all = [
            ("APIName", API.to_owned()),
            ("APIVersion", version.clone()),
            ("Conventions", "SOFA".into()),
            ("Version", "2.1".into()),
            ("SOFAConventions", "GeneralFIR-E".into()),
            ("SOFAConventionsVersion", "2.0".into()),
            ("DataType", "FIR-E".into()),
            ("RoomType", "reverberant".into()),
            ("RoomDescription", room(&plan.conditions.outline)),
            ("EmitterDescription", "Actuators, by name in EmitterDescriptions".into()),
            ("ReceiverDescription", "A probe of normal velocity, where the listener is".into()),
            ("Title", title),
            ("DateCreated", date.clone()),
            ("DateModified", date),
            ("AuthorContact", told(&self.author)),
            ("Organization", told(&self.organization)),
            (
                "License",
                license.unwrap_or_else(|| "No license provided, ask the author for permission".into()),
            ),
            ("ApplicationName", API.to_owned()),
            ("ApplicationVersion", version),
            ("Origin", of("device").unwrap_or_else(|| "not stated".into())),
            ("History", history.join("; ")),
            ("Comment", comment(plan)),
        ];
        all.into_iter().map(|(name, text)| (name.to_owned(), text)).collect()
    }
}

fn comment(plan: &LibraryPlan) -> String {
    let units = plan.ports.iter().zip(&plan.drive_units).map(|(port, unit)| format!("{}: {unit}", port.name));
    let [low, high] = plan.conditions.band;
    format!(
        "Normal velocity of a surface per impulse of drive, from {low} to {high} Hz, shortest wavelength {} m. Units of \
         drive: {}",
        plan.conditions.lambda_min,
        units.collect::<Vec<_>>().join(", "),
    )
}

/// The sheet, in words.
fn room(outline: &Outline) -> String {
    let (width, height) = outline.extent();
    let kind = match outline.shape {
        Shape::Rectangle { .. } => "A rectangular sheet",
        Shape::Circle { .. } => "A circular sheet",
        Shape::Stadium { .. } => "A sheet in the shape of a stadium",
        Shape::Polygon(_) => "A polygonal sheet",
        Shape::Path(_) => "A sheet with a curved edge",
    };
    format!("{kind}, {width} m by {height} m, in which flexural waves reverberate")
}

/// Date and time of day (UTC), written as AES69 prescribes, of a time in seconds after 1970-01-01 00:00 UTC
/// (Hinnant 2013, `civil_from_days`).
///
/// ```
/// assert_eq!(unripple_store::date(1_700_000_000), "2023-11-14 22:13:20");
/// ```
pub fn date(seconds: u64) -> String {
    let (days, rest) = (seconds / 86_400, seconds % 86_400);
    // Years begin in March, so that leap days come last; eras are of 400 years.
    let shifted = days + 719_468;
    let (era, day) = (shifted / 146_097, shifted % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let of_year = day - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    let year = year + era * 400 + u64::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02} {:02}:{:02}:{:02}", rest / 3600, rest / 60 % 60, rest % 60)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        // By `date -u -d @SECONDS`.
        for (seconds, told) in [
            (0, "1970-01-01 00:00:00"),
            (951_782_399, "2000-02-28 23:59:59"),
            (951_868_800, "2000-03-01 00:00:00"),
            (1_709_210_096, "2024-02-29 12:34:56"),
            (4_107_542_399, "2100-02-28 23:59:59"),
            (4_107_542_400, "2100-03-01 00:00:00"),
        ] {
            assert_eq!(date(seconds), told);
        }
    }
}
