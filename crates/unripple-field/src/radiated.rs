//! The sound that a surface radiates to a listener, by the Rayleigh integral over its modes.

use crate::FieldError;
use crate::field::check;
use crate::measure::whole_period;
use crate::modal::{READ, STATES};
use crate::motion::Motion;
use crate::quadrature::nodes;
use crate::ringing::Ringing;
use std::f64::consts::{PI, TAU};
use unripple_core::{Drive, Mixture, ModalResponses, Point, Pole, Responses, Shapes, require};
use unripple_dsp::{RateOfChange, sinc, smooth_size};
use unripple_linalg::{Accum, Mat, Par, multiply, product};

/// Samples on each side of a fractional delay from which it is interpolated: within 0.5 % up to 0.7 of half the sample rate. With
/// twice as many, up to 0.85, for twice the work.
const SIDE: usize = 8;

/// Nodes of the surface whose shapes are in memory at once. With twice this value, twice the memory.
const NODES: usize = 128;

/// Length of a panel of the integral over the surface, as a share of the shortest wavelength: that one is integrated within 1 %. Half as long,
/// within 0.01 %, for four times the work.
const PANEL: f64 = 0.75;

/// Fewest panels along the longer side of a surface whose waves are long.
const FEWEST: f64 = 8.0;

/// Share of the energy of the slowest mode that may be left where free vibration is no longer followed from sample to sample. It counts in
/// the exposure all the same, in closed form. With twice this value, the pressure ends a tenth earlier.
const LEFT: f64 = 4e-3;

/// Longest time of free vibration, as a multiple of the drive's length. With twice this value, drives of surfaces without damping take
/// almost twice as long. What rings on counts in the exposure, except without damping, where it has no end.
const LONGEST: usize = 16;

/// Largest number of samples of free vibration, 22 s at 48 kHz. With twice this value, twice the memory, 16 MiB.
const MOST_FREE: usize = 1 << 20;

/// Part of the free vibration at its end that is faded out, as a divisor: so that what is left does not end in a click. With twice this
/// value, the fade is half as long.
const FADED: usize = 5;

/// A listener above a surface, and the air between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Listener {
    /// The point right below the listener, in metres.
    pub above: Point,
    /// Height above the surface, in metres.
    pub height: f64,
    /// Density of the air, in kg/m³.
    pub density: f64,
    /// Speed of sound, in m/s.
    pub celerity: f64,
    /// Shortest wavelength, on the surface or in the air, that has to be resolved, in metres.
    pub wavelength: f64,
}

/// The sound of a modal surface at a listener, for any number of drives.
///
/// The Rayleigh integral p(t) = ρ/2π ∫ a(x, t − r/c)/r dS sums the acceleration a over a surface in a rigid baffle. It is linear in the
/// motion of the modes: the integral of each mode's shape is computed once, sorted by delays of whole samples, and a drive then costs as
/// much as its motion at a few tens of points. After the drive, where modes vibrate freely, all delays of a mode are one change of
/// amplitude and phase, and the energy that they still radiate has a closed form.
///
/// ```
/// use unripple_core::{Conditions, Drive, ModalResponses, Outline, Point, Pole, Port, Responses, Shape, Shapes};
/// use unripple_field::{Listener, Radiated};
/// use unripple_linalg::Mat;
/// use std::sync::Arc;
///
/// #[derive(Debug)]
/// struct Piston; // A single mode that moves the whole surface alike.
/// impl Shapes for Piston {
///     fn modes(&self) -> usize {
///         1
///     }
///     fn at(&self, _: Point, row: &mut [f64]) {
///         row.fill(1.0);
///     }
/// }
///
/// let outline = Outline::new(Shape::Rectangle { width: 0.02, height: 0.01 });
/// let piston = Responses::Modal(ModalResponses {
///     ports: vec![Port { name: "a1".into(), at: Point::new(0.01, 0.005) }],
///     poles: vec![Pole::new(0.0, 0.0)],
///     input: Mat::full(1, 1, 1.0),
///     shapes: Arc::new(Piston),
///     conditions: Conditions { rate: 48e3, band: [0.0, 1000.0], lambda_min: 0.3, outline },
///     frequency_error: 0.0,
///     mode_errors: Vec::new(),
/// });
/// let above = Point::new(0.01, 0.005);
/// let listener = Listener { above, height: 1.0, density: 1.2, celerity: 343.0, wavelength: 0.3 };
/// // An acceleration of 1 m/s² of so small a piston gives ρ S/(2π r) = 1.2 · 2e-4/2π Pa at 1 m.
/// let push = (0..480).map(|i| (std::f64::consts::TAU * 2.0 * f64::from(i) / 480.0).cos()).collect();
/// let drive = Drive::new(48e3, vec!["a1".into()], vec![push])?;
/// let sound = Radiated::new(&piston, &listener)?.map(|radiated| radiated.pressure(&drive, Some(0.01))).transpose()?;
/// let rms = sound.map(|sound| (sound.exposure / sound.duration).sqrt());
/// assert!(rms.is_some_and(|rms| (rms / (1.2 * 2e-4 / std::f64::consts::TAU / 2f64.sqrt()) - 1.0).abs() < 1e-3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Radiated<'a> {
    responses: &'a Responses,
    modal: &'a ModalResponses,
    /// Density of the air, in kg/m³.
    density: f64,
    /// Integral of dS/2πr over each mode's shape, parted by delays of whole samples: delays x modes.
    delayed: Mat<f64>,
    /// What displacement and velocity of each mode in free vibration weigh in the same integral.
    free: [Vec<f64>; 2],
}

/// The sound pressure of a drive at a listener.
#[derive(Clone, Debug, PartialEq)]
pub struct Pressure {
    /// Pressure in Pa, one value per sample; the time at which the first sample is heard is not counted.
    pub values: Vec<f64>,
    /// Integral of the squared pressure over time, in Pa²s: over the period, or over the whole event with all that rings on after `values`.
    pub exposure: f64,
    /// The same of the A-weighted pressure.
    pub a_weighted_exposure: f64,
    /// The period of a repeated drive, or the length of the part of the event that `values` follow, in seconds.
    pub duration: f64,
}

impl Pressure {
    /// Largest magnitude of the pressure, in Pa.
    pub fn peak(&self) -> f64 {
        self.values.iter().fold(0.0, |most: f64, p| most.max(p.abs()))
    }
}

impl<'a> Radiated<'a> {
    /// Prepares the sound of all drives of a surface at a listener; `None` for sampled responses, whose motion between their points is
    /// not known.
    ///
    /// # Errors
    /// [`FieldError::Range`] for numbers of the listener that are not positive, [`FieldError::Count`] if the integral would have too many
    /// nodes or too many delays.
    pub fn new(responses: &'a Responses, listener: &Listener) -> Result<Option<Self>, FieldError> {
        let Responses::Modal(modal) = responses else { return Ok(None) };
        let numbers = [
            ("height of the listener (m)", listener.height),
            ("density of the air (kg/m³)", listener.density),
            ("speed of sound (m/s)", listener.celerity),
            ("shortest wavelength (m)", listener.wavelength),
        ];
        for (what, found) in numbers {
            require(what, found > 0.0, "a positive number", found)?;
        }
        let outline = &modal.conditions.outline;
        let (width, height) = outline.extent();
        // Near a listener the distance changes as fast as waves do.
        let panel = (PANEL * listener.wavelength).min(listener.height).min(width.max(height) / FEWEST);
        let rate = modal.conditions.rate;
        let samples = rate / listener.celerity;
        let nodes = nodes(outline, panel)?.into_iter().map(|(at, area)| {
            let distance = at.distance(listener.above).hypot(listener.height);
            Node { at, delay: distance * samples, weight: area / (TAU * distance) }
        });
        let nodes: Vec<Node> = nodes.collect();
        let [first, delays] = delays(&nodes, modal.poles.len().max(modal.shapes.modes()))?;
        let delayed = delayed(modal.shapes.as_ref(), &nodes, first, delays);
        let free = free(&delayed, &modal.poles, rate);
        Ok(Some(Self { responses, modal, density: listener.density, delayed, free }))
    }

    /// The sound pressure of a drive: over the last period of a drive that is repeated with `period` (s), or of a single event, until the
    /// surface is at rest.
    ///
    /// # Errors
    /// [`FieldError::Channels`] and [`FieldError::Rate`] if the drive is not for these responses, [`FieldError::Count`] if it is empty,
    /// [`FieldError::Range`] for a period longer than the drive.
    pub fn pressure(&self, drive: &Drive, period: Option<f64>) -> Result<Pressure, FieldError> {
        check(self.responses, drive)?;
        let (mut flow, [later, later_heard]) = match period {
            Some(period) => (self.repeated(drive, whole_period(period, drive)?), [0.0; 2]),
            None => self.single(drive),
        };
        let duration = flow.len() as f64 / drive.rate();
        if period.is_none() {
            flow.resize(smooth_size(flow.len()), 0.0);
        }
        let RateOfChange { values, squares, a_weighted_squares } = RateOfChange::of(&flow, drive.rate());
        let square = self.density * self.density;
        Ok(Pressure {
            values: values.into_iter().map(|value| self.density * value).collect(),
            exposure: square * (squares / drive.rate() + later),
            a_weighted_exposure: square * (a_weighted_squares / drive.rate() + later_heard),
            duration,
        })
    }

    /// The integral of the delayed velocity, in m²/s, over the last `period` samples of a drive in its steady state.
    fn repeated(&self, drive: &Drive, period: usize) -> Vec<f64> {
        let first = drive.samples() - period;
        let mut motion = Motion::new(self.modal, drive);
        motion.skip_to(first, self.at_once());
        let mut flow = vec![0.0; period];
        while motion.next() < drive.samples() {
            let at = motion.next() - first;
            let parts = self.parts(&mut motion, drive.samples());
            for (i, part) in parts.col_iter().enumerate() {
                part.iter().enumerate().for_each(|(delay, value)| flow[(at + i + delay) % period] += value);
            }
        }
        flow
    }

    /// The integral of the delayed velocity, in m²/s, from the beginning of a drive until the surface is at rest or has been
    /// followed for long enough; and the integral of its squared rate of change that is not in it, as it is and A-weighted, in m⁴/s³: what
    /// is faded out, and what rings on.
    fn single(&self, drive: &Drive) -> (Vec<f64>, [f64; 2]) {
        let driven = drive.samples() + self.delayed.nrows();
        let mut flow = vec![0.0; driven];
        let mut motion = Motion::new(self.modal, drive);
        while motion.next() < driven {
            let at = motion.next();
            let parts = self.parts(&mut motion, driven);
            for (i, part) in parts.col_iter().enumerate() {
                let heard = flow[at + i..].iter_mut().zip(part.iter());
                heard.for_each(|(flow, value)| *flow += value);
            }
        }
        let longest = MOST_FREE.min(LONGEST * driven);
        let rest = rest(&self.modal.poles, drive.rate()).min(longest as f64) as usize;
        let (end, fade) = (driven + rest, (rest / FADED).max(1));
        let ringing = Ringing::new(&self.modal.poles, &self.free);
        let mut later = [0.0; 2];
        while motion.next() < end {
            let count = (end - motion.next()).min(self.at_once());
            motion.advance(count, |displacement, velocity| {
                let left = end - 1 - flow.len();
                let share =
                    if left < fade { (PI / 2.0 * left as f64 / fade as f64).sin().powi(2) } else { 1.0 };
                flow.push(share * ringing.value(displacement, velocity));
                if left < fade {
                    let lost = (1.0 - share * share) / drive.rate();
                    let squares = ringing.squares(displacement, velocity);
                    later.iter_mut().zip(squares).for_each(|(later, square)| *later += lost * square);
                }
            });
        }
        let (displacement, velocity) = motion.state();
        let on = ringing.to_come(displacement, velocity);
        later.iter_mut().zip(on).for_each(|(later, on)| *later += on);
        (flow, later)
    }

    /// The integral over the surface for each delay, at the next samples before `end`: delays x samples.
    fn parts(&self, motion: &mut Motion<'_>, end: usize) -> Mat<f64> {
        let count = (end - motion.next()).min(self.at_once());
        product(self.delayed.as_ref(), motion.velocities(count).as_ref())
    }

    /// Number of samples whose modal states are in memory at once.
    fn at_once(&self) -> usize {
        (STATES / self.modal.poles.len().max(1)).max(1)
    }
}

/// A node of the integral over a surface.
#[derive(Clone, Copy, Debug)]
struct Node {
    at: Point,
    /// Travel time to the listener, in samples.
    delay: f64,
    /// dS/2πr, in metres.
    weight: f64,
}

/// The first delay, in whole samples from `SIDE − 1` before, and the number of delays to which the nodes contribute.
fn delays(nodes: &[Node], modes: usize) -> Result<[usize; 2], FieldError> {
    let whole = || nodes.iter().map(|node| node.delay as usize);
    let [first, last] = [whole().min().unwrap_or(0), whole().max().unwrap_or(0)];
    let count = last - first + 2 * SIDE;
    if count.saturating_mul(modes) > READ {
        let (what, expected) =
            ("delays of the sound of the surface", format!("at most {} with {modes} modes", READ / modes));
        return Err(FieldError::Count { what, expected, found: count });
    }
    Ok([first, count])
}

/// The integrals of shapes over the nodes, parted by delay: delays x shapes. Of combinations, those of the base are combined.
fn delayed(shapes: &dyn Shapes, nodes: &[Node], first: usize, delays: usize) -> Mat<f64> {
    if let Some(Mixture { base, mixing, columns }) = shapes.mixture() {
        let mixed = product(delayed(base, nodes, first, delays).as_ref(), mixing);
        return Mat::from_fn(delays, columns.len(), |delay, m| mixed[(delay, columns[m])]);
    }
    let mut sums = Mat::<f64>::zeros(delays, shapes.modes());
    let at_once = (READ / shapes.modes().max(1)).clamp(1, NODES);
    for nodes in nodes.chunks(at_once) {
        let mut parts = Mat::<f64>::zeros(delays, nodes.len());
        for (n, node) in nodes.iter().enumerate() {
            let kernel = kernel(node.delay.fract());
            let scale = node.weight / kernel.iter().sum::<f64>();
            let row = node.delay as usize - first;
            kernel.iter().enumerate().for_each(|(i, value)| parts[(row + i, n)] = scale * value);
        }
        let points: Vec<Point> = nodes.iter().map(|node| node.at).collect();
        let read = shapes.at_all(&points);
        multiply(sums.as_mut(), Accum::Add, parts.as_ref(), read.as_ref(), 1.0, Par::Seq);
    }
    sums
}

/// What each of the delays 1 − SIDE … SIDE weighs in a delay of `part` samples (0 to 1): a sinc under a Hann window.
fn kernel(part: f64) -> [f64; 2 * SIDE] {
    std::array::from_fn(|i| {
        let distance = part - (i as f64 + 1.0 - SIDE as f64);
        sinc(distance) * (PI / 2.0 * distance / SIDE as f64).cos().powi(2)
    })
}

/// The weights of displacement and velocity of every mode in free vibration. A mode's velocity some samples ago follows from its state now, so
/// that all delays together are one weighted sum; of modes that die out within the delays nothing is left to hear.
fn free(delayed: &Mat<f64>, poles: &[Pole], rate: f64) -> [Vec<f64>; 2] {
    let weights = |(m, pole): (usize, &Pole)| {
        let longest = delayed.nrows() as f64 / rate;
        let dies_out = 2.0 * pole.sigma * longest > 20.0;
        let delays = if dies_out { 0 } else { delayed.nrows() };
        (0..delays).fold((0.0, 0.0), |(u, v), delay| {
            let [_, [of_u, of_v]] = pole.step(-(delay as f64) / rate);
            let weight = delayed[(delay, m)];
            (u + weight * of_u, v + weight * of_v)
        })
    };
    let (displacements, velocities) = poles.iter().enumerate().map(weights).unzip();
    [displacements, velocities]
}

/// Samples of free vibration after which the slowest of the modes has hardly any energy left; infinite without damping.
fn rest(poles: &[Pole], rate: f64) -> f64 {
    let decay = |pole: &Pole| {
        let Pole { omega, sigma, .. } = *pole;
        if sigma <= omega {
            sigma
        } else if omega > 0.0 {
            omega * omega / (sigma + (sigma * sigma - omega * omega).sqrt())
        } else {
            2.0 * sigma
        }
    };
    let slowest = poles.iter().map(decay).fold(f64::INFINITY, f64::min);
    (rate * LEFT.recip().ln() / (2.0 * slowest)).ceil()
}
