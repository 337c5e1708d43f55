//! The result of a wiring test, channel by channel.

use super::WiringOptions;
use super::likeness::{Likeness, Routes};
use std::fmt;
use unripple_core::Layout;

/// The result of a wiring test for one output or input.
#[derive(Clone, Debug, PartialEq)]
pub struct Lead {
    /// Name of the channel on the device.
    pub name: String,
    /// Whether no signal passes through the channel.
    pub silent: bool,
    /// Whether the channel's sign is reversed.
    pub reversed: bool,
    /// Name of the channel to which this channel is actually wired; `None` if it is wired correctly or
    /// silent.
    pub instead: Option<String>,
    /// Mean correlation, 0 to 1, of the channel's recordings with the model of the channel to which it is
    /// actually wired.
    pub likeness: f64,
    /// Whether `likeness` is too small for a verdict: less than [`WiringOptions::least_likeness`].
    pub unlike: bool,
}

/// The result of a wiring test for all channels.
#[derive(Clone, Debug, PartialEq)]
pub struct WiringReport {
    /// Results for the outputs, in the device's order.
    pub outputs: Vec<Lead>,
    /// Results for the inputs, in the device's order.
    pub inputs: Vec<Lead>,
    /// Latency of the round trip, in samples; the model's errors of position and wave speed may shift it by
    /// a sample or two.
    pub latency: usize,
}

impl WiringReport {
    /// Whether the test found no faults.
    pub fn is_right(&self) -> bool {
        self.faults().is_empty()
    }

    /// Faults, one sentence each: silent, swapped and reversed channels. If an output and the input of its
    /// name have the same fault, it is reported once, as the actuator's.
    pub fn faults(&self) -> Vec<String> {
        self.each().iter().map(Fault::sentence).collect()
    }

    /// The faults in few lines, for display: a fault of more than three channels is reported once, with
    /// their number and the names of the first six.
    pub fn summary(&self) -> Vec<String> {
        let each = self.each();
        let mut lines = Vec::new();
        for (i, fault) in each.iter().enumerate() {
            let alike = |other: &&Fault| (other.side, &other.what) == (fault.side, &fault.what);
            let group: Vec<&Fault> = each.iter().filter(alike).collect();
            if group.len() <= FEW {
                lines.push(fault.sentence());
            } else if !each[..i].iter().any(|other| alike(&other)) {
                let all = if fault.side == "input" { self.inputs.len() } else { self.outputs.len() };
                lines.push(together(&group, all));
            }
        }
        lines
    }

    fn each(&self) -> Vec<Fault> {
        let twin = |name: &str| self.inputs.iter().find(|input| input.name == name);
        let mut faults = Vec::new();
        for output in &self.outputs {
            let said = output.said();
            match twin(&output.name).map(Lead::said).filter(|other| *other == said) {
                Some(_) => faults.extend(output.faults("actuator")),
                None => {
                    faults.extend(output.faults("output"));
                    faults.extend(twin(&output.name).iter().flat_map(|input| input.faults("input")));
                }
            }
        }
        let alone = |input: &&Lead| !self.outputs.iter().any(|output| output.name == input.name);
        faults.extend(self.inputs.iter().filter(alone).flat_map(|input| input.faults("input")));
        faults
    }
}

/// Largest number of channels with the same fault that are reported one by one, and (`NAMED`) number of
/// names that are listed if there are more: a report of a hundred channels stays a few lines long.
const FEW: usize = 3;
const NAMED: usize = 6;

/// The fault of one channel, in words.
struct Fault {
    side: &'static str,
    name: String,
    what: String,
}

impl Fault {
    fn sentence(&self) -> String {
        format!("{} `{}` {}", self.side, self.name, self.what)
    }
}

/// One line for a fault that several channels of `all` have.
fn together(group: &[&Fault], all: usize) -> String {
    let Some(first) = group.first() else { return String::new() };
    let what = match first.what.strip_prefix("is ") {
        Some(rest) => format!("are {rest}"),
        None => first.what.replacen("does ", "do ", 1),
    };
    let names: Vec<String> = group.iter().take(NAMED).map(|fault| format!("`{}`", fault.name)).collect();
    let more = match group.len() - names.len() {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!("{} of {all} {}s {what}: {}{more}", group.len(), first.side, names.join(", "))
}

impl fmt::Display for WiringReport {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let faults = self.faults();
        if faults.is_empty() {
            return write!(f, "all wires are right");
        }
        f.write_str(&faults.join("\n"))
    }
}

impl Lead {
    fn said(&self) -> Vec<String> {
        if self.silent {
            return vec!["is silent".into()];
        }
        let mut said = Vec::new();
        if let Some(other) = &self.instead {
            said.push(format!("is wired to `{other}`"));
        }
        if self.unlike {
            said.push("does not answer as the model says".into());
        } else if self.reversed {
            said.push("is reversed".into());
        }
        said
    }

    fn faults(&self, side: &'static str) -> Vec<Fault> {
        self.said().into_iter().map(|what| Fault { side, name: self.name.clone(), what }).collect()
    }
}

/// The report on all wires.
pub(super) fn leads(
    likeness: &mut Likeness,
    routes: &Routes,
    (sent, heard): &(Vec<f64>, Vec<f64>),
    layout: &Layout,
    options: &WiringOptions,
) -> WiringReport {
    let (outputs, inputs) = (layout.outputs.len(), layout.inputs.len());
    let mut mean = |pairs: Vec<(usize, usize)>| {
        let alive: Vec<(usize, usize)> = pairs
            .into_iter()
            .filter(|(o, i)| !likeness.silent_outputs[*o] && !likeness.silent_inputs[*i])
            .collect();
        let of =
            |(o, i): &(usize, usize)| likeness.of((*o, *i), (routes.outputs[*o], routes.inputs[*i])).abs();
        let count = alive.len().max(1) as f64;
        alive.iter().map(of).sum::<f64>() / count
    };
    let of_outputs: Vec<f64> = (0..outputs).map(|o| mean((0..inputs).map(|i| (o, i)).collect())).collect();
    let of_inputs: Vec<f64> = (0..inputs).map(|i| mean((0..outputs).map(|o| (o, i)).collect())).collect();
    let lead = |names: &[String], at: usize, route: usize, sign: f64, silent: bool, likeness: f64| Lead {
        name: names[at].clone(),
        silent,
        reversed: !silent && sign < 0.0,
        instead: (route != at && !silent).then(|| names[route].clone()),
        likeness,
        unlike: !silent && likeness < options.least_likeness,
    };
    let (no_drive, no_sense) = (likeness.silent_outputs.clone(), likeness.silent_inputs.clone());
    WiringReport {
        outputs: (0..outputs)
            .map(|o| lead(&layout.outputs, o, routes.outputs[o], sent[o], no_drive[o], of_outputs[o]))
            .collect(),
        inputs: (0..inputs)
            .map(|i| lead(&layout.inputs, i, routes.inputs[i], heard[i], no_sense[i], of_inputs[i]))
            .collect(),
        latency: likeness.latency,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_many_have_in_common_is_said_once() {
        let lead = |name: &str, silent: bool, unlike: bool| Lead {
            name: name.into(),
            silent,
            reversed: false,
            instead: None,
            likeness: 0.3,
            unlike,
        };
        let names: Vec<String> = (1..=16).map(|i| format!("a{i}")).collect();
        let outputs: Vec<Lead> = names.iter().map(|name| lead(name, name == "a4", name != "a4")).collect();
        let mut inputs = outputs.clone();
        inputs.push(lead("probe", false, true));
        let report = WiringReport { outputs, inputs, latency: 0 };
        assert_eq!(report.faults().len(), 17);
        let unlike = "do not answer as the model says: `a1`, `a2`, `a3`, `a5`, `a6`, `a7` and 9 more";
        let expected = [
            format!("15 of 16 actuators {unlike}"),
            "actuator `a4` is silent".into(),
            "input `probe` does not answer as the model says".into(),
        ];
        assert_eq!(report.summary(), expected);
    }
}
