//! Evaluation of the wiring test of a device: which actuators are dead, which wires are wrong, and whether to continue.

use super::campaign::Campaign;
use crate::TaskError;
use serde_json::{Value, json};
use unripple_devices::WiringReport;
use unripple_store::{Doubt, Library, PointState};

/// Name of the wiring check, and key of its log entry.
pub const WIRING: &str = "wiring";

/// Result of the wiring test: the dead actuators, and the faults of the wiring that were accepted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// Actuators that are left out, by index: no sensor records them, or the caller named them.
    pub dead: Vec<usize>,
    /// Notes on dead actuators that the test found and the request does not name.
    pub notes: Vec<String>,
    /// Other wiring faults, which the user chose to accept.
    pub faults: Vec<String>,
}

/// Options of the wiring test: actuators that are left out, and the faults that are accepted.
pub struct WiringTestOptions<'a> {
    /// The actuators' names.
    actuators: Vec<&'a str>,
    /// Names of the actuators to be left out.
    without: &'a [String],
    /// Whether measurements are compared with the model.
    model: bool,
    /// Whether to continue whatever faults are found.
    any: bool,
}

impl<'a> WiringTestOptions<'a> {
    /// The options of the wiring test, taken from those of a calibration.
    pub fn of(known: &'a Campaign<'_>) -> Self {
        Self {
            actuators: known.surface.actuators.iter().map(|actuator| actuator.name.as_str()).collect(),
            without: &known.ask.without,
            model: !known.ask.no_model,
            any: known.ask.any_wiring,
        }
    }

    /// Whether a fault is to be ignored: `--without` names its channel, or it follows from the model, with
    /// which nothing is to be compared.
    fn knows(&self, fault: &str) -> bool {
        self.without.iter().any(|name| fault.contains(&format!("`{name}`")))
            || (!self.model && !fault.ends_with("is silent"))
    }

    /// Evaluates the result of the wiring test. Dead actuators are left out, unless they are more than half
    /// of all: then the fault must lie elsewhere.
    pub fn judge(&self, report: &WiringReport) -> Result<Found, TaskError> {
        let silent: Vec<&str> =
            report.outputs.iter().filter(|lead| lead.silent).map(|lead| lead.name.as_str()).collect();
        let few = 2 * silent.len() <= report.outputs.len();
        let is_dead = |fault: &String| {
            let of = |side: &str, name: &str| *fault == format!("{side} `{name}` is silent");
            few && silent.iter().any(|name| of("actuator", name) || of("output", name))
        };
        let news = report.faults().into_iter().filter(|fault| !self.knows(fault));
        let (gone, faults): (Vec<String>, Vec<String>) = news.partition(is_dead);
        if !faults.is_empty() && !self.any {
            return Err(self.refusal(report, faults, &silent));
        }
        let left_out = self.without.iter().map(String::as_str).chain(silent.iter().copied());
        let place = |name: &str| self.actuators.iter().position(|actuator| *actuator == name);
        let mut dead: Vec<usize> = left_out.filter_map(place).collect();
        dead.sort_unstable();
        dead.dedup();
        let named = |(output, name): (usize, &str)| {
            let both = gone.contains(&format!("actuator `{name}` is silent"));
            let alone = gone.contains(&format!("output `{name}` is silent"));
            let too = if both { ", and its own sensor receives nothing" } else { "" };
            (both || alone).then(|| {
                format!(
                    "actuator `{name}` is dead: no sensor receives its burst (output {}){too}; check its amplifier, its cable and the \
                     actuator. The others go on without it",
                    output + 1
                )
            })
        };
        let outputs = report.outputs.iter().map(|lead| lead.name.as_str());
        Ok(Found { dead, notes: outputs.enumerate().filter_map(named).collect(), faults })
    }

    fn refusal(&self, report: &WiringReport, faults: Vec<String>, silent: &[&str]) -> TaskError {
        let dead = match silent.iter().find(|name| !self.without.iter().any(|known| known == *name)) {
            Some(name) => format!(", or leave a dead one out with `without` {name}"),
            None => String::new(),
        };
        // Few lines for many channels, unless some of them are no news.
        let lines = if faults.len() == report.faults().len() { report.summary() } else { faults };
        TaskError::Work(match &lines[..] {
            [fault] => format!("wiring: {fault} (mend it, or go on with `any_wiring`{dead})"),
            lines => format!("wiring:\n  {}\nmend it, or go on with `any_wiring`{dead}", lines.join("\n  ")),
        })
    }
}

/// Prints notes and accepted faults of the wiring.
pub fn tell(campaign: &Campaign<'_>, notes: &[String], faults: &[String]) {
    notes.iter().for_each(|note| campaign.tell(&format!("warning: {note}")));
    faults.iter().for_each(|fault| campaign.tell(&format!("wiring: {fault}")));
}

impl Found {
    /// Records the notes and accepted faults in the library; faults make it doubtful. If it has points already, earlier doubts on the
    /// wiring stay.
    pub fn keep(&self, library: &mut Library) -> Result<(), TaskError> {
        let said = json!({ "said": self.notes.join("; ") });
        library.log(WIRING, if self.notes.is_empty() { Value::Null } else { said })?;
        let begun = library.in_state(PointState::Missing).len() < library.points().len();
        let before = library.doubts().iter().filter(|doubt| begun && doubt.check == WIRING);
        let before = before.filter(|doubt| !self.faults.contains(&doubt.what)).cloned();
        let doubts = before.chain(self.faults.iter().map(|fault| Doubt::of(WIRING, fault))).collect();
        Ok(library.set_doubts(WIRING, doubts)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_devices::Lead;

    fn report(dead: &[&str], reversed: &[&str]) -> WiringReport {
        let lead = |name: &str| Lead {
            name: name.into(),
            silent: dead.contains(&name),
            reversed: reversed.contains(&name),
            instead: None,
            likeness: 0.9,
            unlike: false,
        };
        let outputs: Vec<Lead> = ["a1", "a2", "a3", "a4"].map(lead).into();
        let inputs = outputs.iter().cloned().chain([lead("probe")]).collect();
        WiringReport { outputs, inputs, latency: 0 }
    }

    fn options<'a>(without: &'a [String], any: bool) -> WiringTestOptions<'a> {
        WiringTestOptions { actuators: vec!["a1", "a2", "a3", "a4"], without, model: true, any }
    }

    #[test]
    fn the_others_go_on_without_a_dead_actuator() {
        let found = options(&[], false).judge(&report(&["a3"], &[])).unwrap();
        assert_eq!((found.dead, found.faults.len()), (vec![2], 0));
        let said = "actuator `a3` is dead: no sensor receives its burst (output 3), and its own sensor receives nothing";
        assert!(found.notes.len() == 1 && found.notes[0].starts_with(said), "{:?}", found.notes);
        // Actuators that are named dead are not reported again.
        let found = options(&["a3".into()], false).judge(&report(&["a3"], &[])).unwrap();
        assert_eq!(found, Found { dead: vec![2], ..Found::default() });
        // Nor is one that is asked for dead.
        let found = options(&["a1".into()], false).judge(&report(&["a3"], &[])).unwrap();
        assert_eq!((found.dead, found.notes.len()), (vec![0, 2], 1));
    }

    #[test]
    fn anything_else_stops_unless_it_is_accepted() {
        let stopped = |report: &WiringReport| options(&[], false).judge(report).unwrap_err().to_string();
        let said = stopped(&report(&["a3"], &["a1"]));
        assert!(said.contains("actuator `a1` is reversed") && said.contains("`any_wiring`"), "{said}");
        let said = stopped(&report(&["a1", "a2", "a3"], &[]));
        assert!(said.contains("actuator `a2` is silent") && said.contains("`without` a1"), "{said}");
        let found = options(&[], true).judge(&report(&["a3"], &["a1"])).unwrap();
        assert_eq!((found.dead, found.faults), (vec![2], vec!["actuator `a1` is reversed".to_owned()]));
    }

    #[test]
    fn accepted_faults_are_doubts_as_long_as_points_are_of_then() {
        use unripple::core::{Conditions, Outline, Point, Port, Shape};
        use unripple_store::{LibraryPlan, Quality};
        let outline = Outline::new(Shape::Rectangle { width: 0.1, height: 0.1 });
        let conditions = Conditions { rate: 48e3, band: [0.0, 1e3], lambda_min: 0.03, outline };
        let port = Port { name: "a1".into(), at: Point::from_mm(10.0, 10.0) };
        let plan = LibraryPlan::new(vec![port], vec![Point::from_mm(50.0, 50.0)], conditions, 3);
        let folder = std::env::temp_dir().join(format!("unripple-wires-{}", std::process::id()));
        let mut library = Library::create(&folder, &plan).unwrap();
        let wrong = Found { faults: vec!["output `a1` is reversed".into()], ..Found::default() };
        wrong.keep(&mut library).unwrap();
        assert_eq!(library.doubts().len(), 1);
        Found::default().keep(&mut library).unwrap();
        assert!(library.doubts().is_empty(), "no point was measured with it");
        wrong.keep(&mut library).unwrap();
        library.put(0, &[0.0, 1.0, 0.0], &[Quality::UNKNOWN]).unwrap();
        let dead = Found { notes: vec!["`a1` is dead".into()], ..Found::default() };
        dead.keep(&mut library).unwrap();
        assert_eq!(library.doubts()[0].what, "output `a1` is reversed");
        assert_eq!(library.logged(WIRING).unwrap()["said"], "`a1` is dead");
        drop(library);
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
