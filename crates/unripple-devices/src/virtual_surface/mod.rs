//! The virtual surface as a device: simulated in the time domain, block by block.

mod feeler;
mod handle;
mod watch;
mod workings;

pub use feeler::{Feeler, Feeling};
pub use handle::Handle;

use crate::bandwidth::top;
use crate::interface::Converter;
use crate::{DevicesError, Interface, Truth};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use unripple_core::clock::Instant;
use unripple_core::{Device, DeviceError, FORCE, Layout, PROBE, Point, State, Status, Surface, require};
use unripple_physics::stepper::{
    Channel, FaultySurface, InjectedFaults, Plant, Reading, StepperOptions, VirtualSurface,
};
use unripple_physics::{Accuracy, Footprint, Modes, stepped_hz};
use workings::{Workings, lock};

/// Options of a virtual device: blocks, faults, probe, accuracy.
#[derive(Clone, Debug, PartialEq)]
pub struct VirtualOptions {
    /// Samples per block.
    pub block: usize,
    /// Options of the simulation in the time domain, among them the largest number of fingers.
    pub stepper: StepperOptions,
    /// Faults of the surface, its sensors and its wires.
    pub faults: InjectedFaults,
    /// Converters and amplifiers between program and surface.
    pub interface: Interface,
    /// Initial place of the probe, in m; the middle of the outline's bounding box if `None`.
    pub probe: Option<Point>,
    /// Highest frequency of the modes, in Hz. `None` means the top of the band, or 1.5 times that (up to
    /// 0.45 of the sample rate) if coils or masses load the surface, since they couple to modes above the
    /// band.
    pub max_hz: Option<f64>,
    /// Relative accuracy of the modes' natural frequencies, and the largest error that is accepted if that
    /// accuracy cannot be reached.
    pub accuracy: Accuracy,
    /// Largest number of simultaneous taps.
    pub taps: usize,
    /// Whether taps are blows of a hammer with a force sensor, recorded by an input [`FORCE`] (N) behind that of the probe.
    pub hammer: bool,
    /// Whether each exchange of a block takes the block's duration in real time; otherwise it is as fast as
    /// the computation.
    pub real_time: bool,
}

impl Default for VirtualOptions {
    fn default() -> Self {
        Self {
            block: 128,
            stepper: StepperOptions::default(),
            faults: InjectedFaults::default(),
            interface: Interface::default(),
            probe: None,
            max_hz: None,
            accuracy: Accuracy::from(1e-6),
            taps: 1,
            hammer: false,
            real_time: false,
        }
    }
}

/// Simulation steps per sample for a surface with coils or masses that is to be measured. With one, the signals of voltage-driven
/// coils come up to 0.035 samples early; that falls as the square of the number of steps.
const FINE: usize = 3;

impl VirtualOptions {
    /// Default options for a surface that is to be measured: if coils or masses load it, with steps of a
    /// third of a sample, so that no signal is late or early by more than a few hundredths of a sample.
    ///
    /// # Errors
    /// [`DevicesError::Physics`] for actuators that are not valid.
    pub fn to_be_measured(surface: &Surface) -> Result<Self, DevicesError> {
        let top = surface.emission.band[1];
        let loaded = stepped_hz(surface, top)? > top;
        let substeps = if loaded { FINE } else { 1 };
        Ok(Self { stepper: StepperOptions { substeps, ..StepperOptions::default() }, ..Self::default() })
    }
}

/// A simulated surface as a device, with actuators, their sensors and a probe.
///
/// There is an output for each actuator, by its name; an input for the sensor of each, by the same names;
/// then the input [`PROBE`], the normal velocity (m/s) at a place that can be moved; with [`VirtualOptions::hammer`] the input [`FORCE`]
/// last, the force of all taps (N). A sample of 1 is a
/// drive at the surface's emission limit. The signal of an actuator's sensor is that of the motion alone, in
/// the sensor's unit ([`Sensor`](unripple_physics::Sensor)): m/s for an ideal force, V for a coil driven by
/// a current, A for one driven by a voltage and for a patch. Time passes only in [`Device::exchange`].
///
/// ```
/// use unripple_core::*;
/// use unripple_devices::{Tap, Virtual, VirtualOptions};
/// # let sheet = Sheet { material: "BoPET".into(), young: 4e9, density: 1400.0, poisson: 0.3, strength: None,
/// #     thickness: 0.125e-3, tension: 200.0, decay: Decay::Time(0.07), air: Air::None,
/// #     uneven: Uneven::default() };
/// # let a1 = Actuator { name: "a1".into(), at: Point::from_mm(12.0, 31.0), kind: ActuatorKind::Force,
/// #     contact_radius: 0.0 };
/// # let surface = Surface { name: "film".into(), outline: Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 }),
/// #     sheet, emission: Emission { band: [0.0, 1e3], rate: 48e3, limit: 1.0, rms_limit: None },
/// #     finger: Finger::default(), accuracy: None, actuators: vec![a1] };
///
/// let mut device = Virtual::new(&surface, &VirtualOptions { block: 64, ..Default::default() })?;
/// assert_eq!(device.layout().inputs, ["a1", "probe"]);
/// let handle = device.handle();
/// handle.tap(&Tap::half_sine(1.0, 1e-3, 48e3), Point::from_mm(62.0, 90.0), 0.0)?;
/// let (drive, mut heard) = ([0.0; 64], [0.0; 128]);
/// device.exchange(&drive, &mut heard)?;
/// assert!(heard.iter().any(|v| *v != 0.0));
/// # Ok::<(), unripple_devices::DevicesError>(())
/// ```
#[derive(Debug)]
pub struct Virtual {
    layout: Layout,
    workings: Arc<Mutex<Workings>>,
    real_time: bool,
    start: Option<Instant>,
    status: Status,
}

impl Virtual {
    /// A virtual surface at rest; this call computes its modes.
    ///
    /// # Errors
    /// Those of [`Modes::solve`] and [`Virtual::with_modes`].
    pub fn new(surface: &Surface, options: &VirtualOptions) -> Result<Self, DevicesError> {
        let modes = Modes::solve(surface, top(surface, options.max_hz)?, options.accuracy)?;
        Self::with_modes(surface, Arc::new(modes), options)
    }

    /// A virtual surface at rest, with modes that were computed before.
    ///
    /// # Errors
    /// [`DevicesError::Range`] and [`DevicesError::Size`] for values out of range; those of [`VirtualSurface::new`].
    pub fn with_modes(
        surface: &Surface,
        modes: Arc<Modes>,
        options: &VirtualOptions,
    ) -> Result<Self, DevicesError> {
        let (block, taps) = (options.block as f64, options.taps as f64);
        require("samples of a block", (1.0..=1e6).contains(&block), "between 1 and 1000000", block)?;
        require("taps at once", taps <= 64.0, "at most 64", taps)?;
        let plant = Plant::with_residual_compliance(surface, modes, surface.emission.rate)?;
        let (width, height) = surface.outline.extent();
        let place = options.probe.unwrap_or(Point::new(width / 2.0, height / 2.0));
        let mut channels = Channel::all(surface)?;
        let spare = Channel::force(Footprint::point(Point::new(width / 2.0, height / 2.0)));
        channels.extend(std::iter::repeat_n(spare, options.taps));
        let mut stepped = VirtualSurface::new(&plant, &channels, surface.emission.rate, &options.stepper)?;
        stepped.set_probes(&[(place, Reading::Velocity)])?;
        let faults = options.faults.clone();
        let surface_at_work = FaultySurface::new(stepped, faults, options.block)?.with_spare(options.taps)?;
        let names: Vec<String> = surface.actuators.iter().map(|a| a.name.clone()).collect();
        let hammer = options.hammer.then(|| FORCE.to_owned());
        let layout = Layout {
            device: "virtual".into(),
            rate: surface.emission.rate,
            block: options.block,
            inputs: names.iter().cloned().chain([PROBE.to_owned()]).chain(hammer).collect(),
            outputs: names,
            full_scale: surface.emission.limit,
        };
        let converter = Converter::new(&with_force(&options.interface, &layout), &layout)?;
        let workings = Workings::new(surface_at_work, converter, &layout, options.taps, place);
        Ok(Self {
            layout,
            workings: Arc::new(Mutex::new(workings)),
            real_time: options.real_time,
            start: None,
            status: Status::default(),
        })
    }

    /// A virtual device that simulates the true surface of a [`Truth`] with its gains and noise, in addition
    /// to the faults and the interface of the options. Its modes are those of [`Truth::modes`], whatever
    /// accuracy the options request.
    ///
    /// # Errors
    /// Those of [`Virtual::new`].
    pub fn of_truth(truth: &Truth, options: &VirtualOptions) -> Result<Self, DevicesError> {
        Self::of_truth_with_modes(truth, truth.modes(options.max_hz)?, options)
    }

    /// A virtual device that simulates a true surface as [`Virtual::of_truth`] does, with modes that were
    /// computed before.
    ///
    /// # Errors
    /// Those of [`Virtual::with_modes`].
    pub fn of_truth_with_modes(
        truth: &Truth,
        modes: Arc<Modes>,
        options: &VirtualOptions,
    ) -> Result<Self, DevicesError> {
        let interface = truth.interface(&modes, &options.interface);
        Self::with_modes(&truth.surface, modes, &VirtualOptions { interface, ..options.clone() })
    }

    /// A handle for manipulating the surface (probe, taps, fingers) while another part of the program owns
    /// the device.
    pub fn handle(&self) -> Handle {
        Handle::new(self.workings.clone())
    }

    /// Waits until this block would end in real time.
    fn keep_time(&mut self) {
        let start = *self.start.get_or_insert_with(Instant::now);
        let over = (self.status.blocks + 1) as f64 * self.layout.block as f64 / self.layout.rate;
        let left = Duration::from_secs_f64(over).saturating_sub(start.elapsed());
        if !left.is_zero() {
            std::thread::sleep(left);
        }
    }
}

/// An interface whose lists, made for the inputs up to the probe, have an entry for the force of a hammer, too: without gain and noise.
fn with_force(interface: &Interface, layout: &Layout) -> Interface {
    let mut interface = interface.clone();
    let shorter = |list: &[f64]| {
        layout.inputs.last().is_some_and(|last| last == FORCE) && list.len() + 1 == layout.inputs.len()
    };
    if shorter(&interface.heard_gains) {
        interface.heard_gains.push(1.0);
    }
    if shorter(&interface.noise) {
        interface.noise.push(0.0);
    }
    interface
}

impl Device for Virtual {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn status(&self) -> Status {
        self.status.clone()
    }

    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        self.layout.fits(drive.len(), heard.len())?;
        let result = lock(&self.workings).exchange(&self.layout, self.status.blocks, drive, heard);
        if let Err(why) = result {
            self.status.state = State::Lost(why.clone());
            return Err(DeviceError::Lost { device: self.layout.device.clone(), why });
        }
        if self.real_time {
            self.keep_time();
        }
        self.status.blocks += 1;
        self.status.lost = lock(&self.workings).lost();
        Ok(())
    }
}
