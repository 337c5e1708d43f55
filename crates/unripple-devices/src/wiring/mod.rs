//! Test for silent, swapped or reversed channels: one actuator plays at a time, all inputs record, and the
//! recordings are compared with a model.

mod expected;
mod likeness;
mod options;
mod reciprocal;
mod report;
mod take;

pub use expected::Expected;
pub use options::WiringOptions;
pub use reciprocal::{Reciprocal, reciprocal};
pub use report::{Lead, WiringReport};

use crate::DevicesError;
use crate::error::same;
use likeness::{Likeness, Routes, routes, signs};
use report::leads;
use take::{Takes, record};
use unripple_core::{Device, Layout};

/// Sends a burst through one output at a time, records all inputs, and finds which actuator or sensor each channel is wired to.
///
/// Each recording r of output o and input i is compared with each prediction p by its normalised
/// correlation, at the one latency that explains most of all. The wiring is that whose sum of magnitudes is
/// largest, found from the expected one by exchanging two outputs, two inputs, or both of one name as long
/// as that helps. Signs follow from the product of an output's and an input's sign: a reversal of all
/// outputs and all inputs together is not detected.
///
/// # Errors
/// [`DevicesError::Device`] if a block cannot be exchanged, [`DevicesError::Size`] if the model has other channels than the device,
/// [`DevicesError::Range`] for options out of range.
///
/// ```
/// # use unripple_core::*;
/// # use unripple_physics::{ResponseOptions, responses};
/// use unripple_devices::{Expected, Interface, Virtual, VirtualOptions, WiringOptions, check_wiring};
/// # let sheet = Sheet { material: "BoPET".into(), young: 4e9, density: 1400.0, poisson: 0.3, strength: None,
/// #     thickness: 0.125e-3, tension: 200.0, decay: Decay::Time(0.07), air: Air::None,
/// #     uneven: Uneven::default() };
/// # let at = [(12.0, 31.0), (40.0, 140.0), (141.0, 106.0)];
/// # let actuators = at.iter().enumerate().map(|(i, (x, y))| Actuator { name: format!("a{}", i + 1),
/// #     at: Point::from_mm(*x, *y), kind: ActuatorKind::Force, contact_radius: 0.0 }).collect();
/// # let surface = Surface { name: "film".into(), outline: Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 }),
/// #     sheet, emission: Emission { band: [0.0, 1e3], rate: 48e3, limit: 1.0, rms_limit: None },
/// #     finger: Finger::default(), accuracy: None, actuators };
///
/// let interface = Interface { drive_gains: vec![1.0, -1.0, 1.0], ..Default::default() };
/// let mut device = Virtual::new(&surface, &VirtualOptions { interface, ..Default::default() })?;
/// let Responses::Modal(model) = responses(&surface, &ResponseOptions::default())? else { unreachable!() };
/// let expected = Expected::of_modes(&model, Some(Point::from_mm(75.0, 75.0)), 0.02);
/// let report = check_wiring(&mut device, &expected, &WiringOptions::for_band([0.0, 1e3]))?;
/// assert_eq!(report.faults(), ["output `a2` is reversed"]);
/// # Ok::<(), unripple_devices::DevicesError>(())
/// ```
pub fn check_wiring(
    device: &mut dyn Device,
    expected: &Expected,
    options: &WiringOptions,
) -> Result<WiringReport, DevicesError> {
    let layout = device.layout().clone();
    options.check(layout.rate)?;
    same("outputs of the wiring's model", expected.outputs(), layout.outputs.len())?;
    same("inputs of the wiring's model", expected.inputs(), layout.inputs.len())?;
    let takes: Takes = record(device, &layout, options)?;
    let predicted = take::predict(expected, &layout, options);
    Ok(judged(&takes, &predicted, &layout, options))
}

/// Finds the wiring as [`check_wiring`] does, from measured responses `heard[output][input][sample]` instead
/// of bursts. They are per unit impulse of drive, with any latency; the level of each input does not matter.
/// `layout` has only the channels of the model.
///
/// # Errors
/// As [`check_wiring`].
pub fn check_responses(
    heard: &[Vec<Vec<f64>>],
    layout: &Layout,
    expected: &Expected,
    options: &WiringOptions,
) -> Result<WiringReport, DevicesError> {
    options.check(layout.rate)?;
    same("outputs of the wiring's model", expected.outputs(), layout.outputs.len())?;
    same("inputs of the wiring's model", expected.inputs(), layout.inputs.len())?;
    same("outputs of measured responses", heard.len(), layout.outputs.len())?;
    for row in heard {
        same("inputs of measured responses", row.len(), layout.inputs.len())?;
    }
    let mut takes = take::played(heard, layout, options);
    let mut predicted = take::predict(expected, layout, options);
    take::level(&mut takes.heard, takes.inputs);
    take::level(&mut predicted, takes.inputs);
    Ok(judged(&takes, &predicted, layout, options))
}

/// Report on the wiring, from a comparison of recordings and predictions.
fn judged(takes: &Takes, predicted: &[Vec<f64>], layout: &Layout, options: &WiringOptions) -> WiringReport {
    let latency = likeness::latency(takes, predicted);
    let mut likeness = Likeness::new(takes, predicted, latency);
    let found: Routes = routes(&mut likeness, layout);
    let signs = signs(&mut likeness, &found);
    leads(&mut likeness, &found, &signs, layout, options)
}
