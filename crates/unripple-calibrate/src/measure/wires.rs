//! Assignment of a device's channels to actuators, sensors, probe, reference and the force of a hammer.

use crate::CalibrateError;
use unripple_core::{FORCE, Layout, PROBE, Port};

/// Name of the input that records the sent signal, the reference channel.
pub const REFERENCE: &str = "reference";

/// Channels of a device that are assigned to actuators, their sensors, a probe, a reference and the force of a hammer.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Wires {
    /// Index of each actuator's output.
    pub drives: Vec<usize>,
    /// Index of the input of each actuator's own sensor; empty unless all have one.
    pub sensors: Vec<usize>,
    /// Index of the input of the probe on the surface.
    pub probe: Option<usize>,
    /// Index of the input that records the sent signal.
    pub reference: Option<usize>,
    /// Index of the input that records the force of a hammer.
    pub force: Option<usize>,
}

impl Wires {
    /// Assigns channels by name. `named` holds pairs of a name and the channel that it stands for, such as
    /// `("a1", "playback_3")`, for outputs and inputs alike. If no output has an actuator's name, actuators
    /// take the outputs in order, and sensors and probe the inputs.
    ///
    /// # Errors
    /// [`CalibrateError::Wire`] if an actuator has no output; it says which outputs there are and how to correct that.
    ///
    /// ```
    /// use unripple_calibrate::measure::Wires;
    /// use unripple_core::{Layout, Point, Port};
    /// let names = |all: &[&str]| all.iter().map(|name| name.to_string()).collect::<Vec<_>>();
    /// let layout = Layout { device: "card".into(), rate: 48e3, block: 64, outputs: names(&["b", "a"]),
    ///     inputs: names(&["a", "b", "probe"]), full_scale: 1.0 };
    /// let ports = ["a", "b"].map(|name| Port { name: name.into(), at: Point::new(0.0, 0.0) });
    /// let wires = Wires::by_name(&ports, &layout, &[])?;
    /// assert_eq!((wires.drives, wires.sensors, wires.probe), (vec![1, 0], vec![0, 1], Some(2)));
    /// # Ok::<(), unripple_calibrate::CalibrateError>(())
    /// ```
    pub fn by_name(
        ports: &[Port],
        layout: &Layout,
        named: &[(String, String)],
    ) -> Result<Self, CalibrateError> {
        let known =
            |name: &str| named.iter().find(|(own, _)| own == name).map(|(_, channel)| channel.as_str());
        let find = |channels: &[String], name: &str| {
            let wanted = known(name).unwrap_or(name);
            channels.iter().position(|channel| channel == wanted)
        };
        let in_order =
            ports.iter().all(|port| find(&layout.outputs, &port.name).is_none()) && named.is_empty();
        let drive = |(i, port): (usize, &Port)| match find(&layout.outputs, &port.name) {
            Some(found) => Ok(found),
            None if in_order && i < layout.outputs.len() => Ok(i),
            None => Err(missing(port, ports.len(), layout)),
        };
        let drives = ports.iter().enumerate().map(drive).collect::<Result<Vec<_>, _>>()?;
        let sensors: Option<Vec<usize>> = ports.iter().map(|port| find(&layout.inputs, &port.name)).collect();
        let ordered = (in_order && layout.inputs.len() >= ports.len()).then(|| (0..ports.len()).collect());
        let sensors = sensors.or(ordered).unwrap_or_default();
        let spare = in_order && sensors.len() < layout.inputs.len();
        let probe = find(&layout.inputs, PROBE).or_else(|| spare.then_some(sensors.len()));
        let (reference, force) = (find(&layout.inputs, REFERENCE), find(&layout.inputs, FORCE));
        Ok(Self { drives, sensors, probe: probe.filter(|input| force != Some(*input)), reference, force })
    }
}

fn missing(port: &Port, actuators: usize, layout: &Layout) -> CalibrateError {
    let mend = if layout.outputs.len() < actuators {
        "choose a device or a profile with more outputs, or a surface with fewer actuators".to_owned()
    } else {
        format!("name the channel, as in `--wire {}={}`", port.name, layout.outputs[0])
    };
    CalibrateError::Wire {
        actuator: port.name.clone(),
        device: layout.device.clone(),
        actuators,
        outputs: layout.outputs.join(", "),
        count: layout.outputs.len(),
        mend,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::Point;

    fn layout(outputs: &[&str], inputs: &[&str]) -> Layout {
        let names = |all: &[&str]| all.iter().map(|name| (*name).to_owned()).collect();
        Layout {
            device: "card".into(),
            rate: 48e3,
            block: 64,
            outputs: names(outputs),
            inputs: names(inputs),
            full_scale: 1.0,
        }
    }

    fn ports(names: &[&str]) -> Vec<Port> {
        names.iter().map(|name| Port { name: (*name).into(), at: Point::new(0.0, 0.0) }).collect()
    }

    #[test]
    fn channels_without_known_names_are_taken_in_order() {
        let found =
            Wires::by_name(&ports(&["a", "b"]), &layout(&["1", "2", "3"], &["1", "2", "3"]), &[]).unwrap();
        assert_eq!((found.drives, found.sensors, found.probe), (vec![0, 1], vec![0, 1], Some(2)));
        let found = Wires::by_name(&ports(&["a", "b"]), &layout(&["1", "2"], &["1"]), &[]).unwrap();
        assert_eq!((found.sensors, found.probe), (vec![], Some(0)));
    }

    #[test]
    fn too_few_channels_are_refused_with_what_to_do() {
        let few = Wires::by_name(&ports(&["a", "b", "c"]), &layout(&["1", "2"], &[]), &[]).unwrap_err();
        let text = few.to_string();
        assert!(
            text.contains("3 outputs") && text.contains("2 (1, 2)") && text.contains("more outputs"),
            "{text}"
        );
        let half = Wires::by_name(&ports(&["a", "b"]), &layout(&["a", "x"], &[]), &[]).unwrap_err();
        assert!(half.to_string().contains("--wire b=a"), "{half}");
        let named = [("b".to_owned(), "x".to_owned())];
        let wires = Wires::by_name(&ports(&["a", "b"]), &layout(&["a", "x"], &["x", "a"]), &named).unwrap();
        assert_eq!((wires.drives, wires.sensors), (vec![0, 1], vec![1, 0]));
    }
}
