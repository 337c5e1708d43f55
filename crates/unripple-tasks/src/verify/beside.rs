//! What a drive was made for, from the report that `focus` wrote beside it.

use crate::Place;
use crate::field::DriveAsk;
use serde_json::Value;

/// Place (m) and instant (s) of the focus that a drive was made for, as far as they are known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Beside {
    /// Place of the first target, in m.
    pub target: Option<Place>,
    /// Focal instant of the first target, in s.
    pub instant: Option<f64>,
    /// Number of targets, of which the first is used.
    pub targets: usize,
}

impl Beside {
    /// Reads `report.json` in the folder of the drive's file; nothing is known if there is none that can be read.
    pub fn of(drive: &DriveAsk) -> Self {
        let DriveAsk::File(file) = drive else { return Self::default() };
        let text = std::fs::read_to_string(file.with_file_name("report.json")).unwrap_or_default();
        serde_json::from_str(&text).map_or_else(|_| Self::default(), |report| Self::said(&report))
    }

    fn said(report: &Value) -> Self {
        let first = &report["targets"][0];
        let number = |value: &Value| value.as_f64();
        Self {
            target: number(&first["at_m"][0]).zip(number(&first["at_m"][1])).map(|(x, y)| [x, y]),
            instant: number(&first["instant_s"]),
            targets: report["targets"].as_array().map_or(0, Vec::len),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_first_target_is_read_and_nothing_is_made_up() {
        let report = json!({ "targets": [{ "at_m": [0.062, 0.09], "instant_s": 0.03 }, { "at_m": [0, 0] }] });
        let said = Beside::said(&report);
        assert_eq!((said.target, said.instant, said.targets), (Some([0.062, 0.09]), Some(0.03), 2));
        assert_eq!(Beside::said(&json!({ "targets": [] })), Beside::default());
        assert_eq!(Beside::of(&DriveAsk::File("no/such/folder/drive.wav".into())), Beside::default());
    }
}
