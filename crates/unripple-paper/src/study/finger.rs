//! Effect of a finger on a focus: the motion under the finger and elsewhere, with and without the finger.

use super::StudyError;
use unripple_core::{Contact, Drive, Finger, Point, Responses, Surface};
use unripple_dsp::rms;
use unripple_field::{Field, Trace};
use unripple_focus::{Options, Target, focus};
use unripple_physics::{Footprint, ResponseOptions, responses};

/// Number of points along each side of the lattice on which the noise elsewhere is evaluated.
const LATTICE: usize = 14;

/// Time on either side of the focal instant that does not count as noise, in periods of the top frequency
/// of the band.
const PULSE: f64 = 4.0;

/// A focus with a finger on the surface, compared with the same focus without it. Attenuations are ratios
/// of a quantity without the finger to that with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touched {
    /// Radius of the contact disc, in metres.
    pub contact_radius_m: f64,
    /// Whether the drive was computed from responses with the finger on the surface.
    pub known: bool,
    /// Attenuation of the largest velocity at the contact, averaged over the contact disc.
    pub focus_velocity: f64,
    /// Attenuation of the largest displacement, averaged over the contact disc.
    pub focus_displacement: f64,
    /// Attenuation of the largest velocity of the sheet at the centre of the contact, as a vibrometer would measure it
    /// from below. The finger loads the disc with an even pressure and does not stiffen the sheet, so this differs from
    /// the mean over the disc.
    pub centre_velocity: f64,
    /// Attenuation of the noise at the contact: rms of the disc's mean velocity over [0, 2T], without the
    /// four periods (of the top frequency of the band) on either side of the focal instant.
    pub noise_under_finger: f64,
    /// Attenuation of the noise elsewhere: rms velocity outside the focal disc over [0, 2T].
    pub noise_elsewhere: f64,
    /// Largest velocity of the finger, in m/s.
    pub velocity_m_s: f64,
    /// Largest displacement of the finger, in metres.
    pub displacement_m: f64,
    /// Energy dissipated in the finger by the time 2T, in J.
    pub finger_energy_j: f64,
    /// Work of the actuators on the sheet by the time 2T, in J.
    pub drive_energy_j: f64,
}

/// Motion under the finger and elsewhere.
struct Motion {
    velocity: f64,
    centre: f64,
    displacement: f64,
    noise: f64,
    elsewhere: f64,
    /// ∫ v² dt of the disc's mean, in m²/s.
    squared: f64,
}

/// Compares a focus at a point with and without a finger on it, for several contact radii (m) and a window (s). There
/// are two rows for each radius: first with the drive computed without the finger, then with the one computed with it.
///
/// # Errors
/// [`StudyError`] where responses, focus or field cannot be computed: for a point outside the outline, for example.
pub fn finger(surface: &Surface, at: Point, radii: &[f64], window: f64) -> Result<Vec<Touched>, StudyError> {
    let bare = responses(surface, &ResponseOptions::default())?;
    let options = Options {
        window,
        limit: surface.emission.limit,
        rms_limit: surface.emission.rms_limit,
        ..Options::default()
    };
    let plain = focus(&bare, &[Target::at(at)], &options)?.drive;
    let mut rows = Vec::new();
    for radius in radii {
        let finger = Finger { contact_radius: *radius, ..surface.finger };
        let contacts = vec![Contact { at, finger }];
        let touched = responses(surface, &ResponseOptions { contacts, ..ResponseOptions::default() })?;
        let aware = focus(&touched, &[Target::at(at)], &options)?.drive;
        let disc = Footprint::disc(at, *radius, &surface.outline);
        let free = motion(&bare, &plain, at, &disc, window)?;
        for (known, drive) in [(false, &plain), (true, &aware)] {
            let held = motion(&touched, drive, at, &disc, window)?;
            rows.push(Touched {
                contact_radius_m: *radius,
                known,
                focus_velocity: free.velocity / held.velocity,
                focus_displacement: free.displacement / held.displacement,
                centre_velocity: free.centre / held.centre,
                noise_under_finger: free.noise / held.noise,
                noise_elsewhere: free.elsewhere / held.elsewhere,
                velocity_m_s: held.velocity,
                displacement_m: held.displacement,
                finger_energy_j: finger.damping * held.squared,
                drive_energy_j: work(&touched, drive, surface, 2.0 * window)?,
            });
        }
    }
    Ok(rows)
}

fn motion(
    responses: &Responses,
    drive: &Drive,
    at: Point,
    disc: &Footprint,
    window: f64,
) -> Result<Motion, StudyError> {
    let conditions = responses.conditions();
    let field = Field::new(responses, drive, 1.0)?;
    let (end, rate) = (2.0 * window, conditions.rate);
    let places: Vec<Point> = disc.points.iter().map(|(p, _)| *p).collect();
    let traces = field.traces(&places, end)?;
    let mean = |part: fn(&Trace) -> &Vec<f64>| -> Vec<f64> {
        let samples = traces.first().map_or(0, |trace| part(trace).len());
        let sum = |i: usize| traces.iter().zip(&disc.points).map(|(t, (_, w))| w * part(t)[i]).sum();
        (0..samples).map(sum).collect()
    };
    let (velocity, displacement) = (mean(|t| &t.velocity), mean(|t| &t.displacement));
    let pulse = PULSE / conditions.band[1];
    let noise: Vec<f64> = velocity
        .iter()
        .enumerate()
        .filter(|(i, _)| (*i as f64 / rate - window).abs() > pulse)
        .map(|(_, v)| *v)
        .collect();
    let (width, height) = conditions.outline.extent();
    let cell = |i: usize| (i as f64 + 0.5) / LATTICE as f64;
    let outside: Vec<Point> = (0..LATTICE * LATTICE)
        .map(|i| Point::new(width * cell(i % LATTICE), height * cell(i / LATTICE)))
        .filter(|p| conditions.outline.contains(*p) && p.distance(at) > conditions.focal_radius())
        .collect();
    let centre = field.traces(&[at], end)?.into_iter().flat_map(|t| t.velocity).collect::<Vec<f64>>();
    let elsewhere: Vec<f64> = field.traces(&outside, end)?.into_iter().flat_map(|t| t.velocity).collect();
    Ok(Motion {
        velocity: largest(&velocity),
        centre: largest(&centre),
        displacement: largest(&displacement),
        noise: rms(&noise),
        elsewhere: rms(&elsewhere),
        squared: velocity.iter().map(|v| v * v).sum::<f64>() / rate,
    })
}

/// Work of force actuators on the sheet until a time (s), in J: every sample is an impulse, whose work is its strength
/// times the mean of the velocities just before and just after it. Zero for sampled responses.
fn work(responses: &Responses, drive: &Drive, surface: &Surface, end: f64) -> Result<f64, StudyError> {
    let places: Vec<Point> = surface.actuators.iter().map(|actuator| actuator.at).collect();
    let rate = drive.rate();
    let traces = Field::new(responses, drive, 1.0)?.traces(&places, end)?;
    let Responses::Modal(modal) = responses else { return Ok(0.0) };
    // Jumps at each place from an impulse at every actuator.
    let read = modal.shapes.at_all(&places);
    let jump = |from: usize, to: usize| -> f64 {
        (0..modal.poles.len())
            .map(|m| modal.input[(from, m)] * read[(to, m)] * modal.poles[m].velocity(0.0))
            .sum()
    };
    let jumps: Vec<Vec<f64>> =
        (0..places.len()).map(|to| (0..places.len()).map(|from| jump(from, to)).collect()).collect();
    let channels = drive.channels();
    let at_sample = |i: usize| -> f64 {
        (0..places.len())
            .map(|to| {
                let jumped: f64 =
                    (0..places.len()).map(|from| jumps[to][from] * channels[from][i] / rate).sum();
                channels[to][i] / rate * (traces[to].velocity[i] - 0.5 * jumped)
            })
            .sum()
    };
    let samples = traces.first().map_or(0, |trace| trace.velocity.len()).min(drive.samples());
    Ok((0..samples).map(at_sample).sum())
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, v| v.abs().max(most))
}
