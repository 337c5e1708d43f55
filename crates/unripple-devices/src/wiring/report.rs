use super::WiringOptions;
use super::likeness::{Likeness, Routes};
use std::fmt;
use unripple_core::Layout;

/// What was found of one output or input.
#[derive(Clone, Debug, PartialEq)]
pub struct Lead {
    /// The channel's name.
    pub name: String,
    /// Whether nothing comes through.
    pub silent: bool,
    /// Whether its sign is reversed.
    pub reversed: bool,
    /// Name of what it leads to, if that is not its own.
    pub instead: Option<String>,
    /// Likeness to what the model says of what it leads to, on average, 0 to 1.
    pub likeness: f64,
    /// Whether that is too little to tell.
    pub unlike: bool,
}

/// What was found of all wires.
#[derive(Clone, Debug, PartialEq)]
pub struct WiringReport {
    /// The outputs, in the device's order.
    pub outputs: Vec<Lead>,
    /// The inputs, in the device's order.
    pub inputs: Vec<Lead>,
    /// Latency of the round trip, in samples: off by what the model's places and celerities are off by, a sample or two.
    pub latency: usize,
}

impl WiringReport {
    /// Whether every wire is as it should be.
    pub fn is_right(&self) -> bool {
        self.faults().is_empty()
    }

    /// What is wrong, a sentence each: silent, swapped and reversed channels. Where an output and the input of its name have
    /// the same fault it is named once, as the actuator's.
    pub fn faults(&self) -> Vec<String> {
        let twin = |name: &str| self.inputs.iter().find(|input| input.name == name);
        let mut faults = Vec::new();
        for output in &self.outputs {
            let said = output.said();
            match twin(&output.name).map(Lead::said).filter(|other| *other == said) {
                Some(_) => {
                    faults.extend(said.iter().map(|what| format!("actuator `{}` {what}", output.name)))
                }
                None => {
                    faults.extend(said.iter().map(|what| format!("output `{}` {what}", output.name)));
                    faults.extend(twin(&output.name).iter().flat_map(|input| input.told()));
                }
            }
        }
        let alone = |input: &&Lead| !self.outputs.iter().any(|output| output.name == input.name);
        faults.extend(self.inputs.iter().filter(alone).flat_map(Lead::told));
        faults
    }
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

    fn told(&self) -> Vec<String> {
        self.said().iter().map(|what| format!("input `{}` {what}", self.name)).collect()
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
