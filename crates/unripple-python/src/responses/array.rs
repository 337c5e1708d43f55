//! Responses from an array: what must be known of it, and a surface that is made up where none is given.

use std::sync::Arc;
use unripple::act::{Note, Report};
use unripple::calibrate::Interpolation;
use unripple::core::{
    Actuator, ActuatorKind, Air, Conditions, Decay, Emission, Finger, Outline, Point, Port, SampledResponses,
    Shape, Sheet, Surface, Uneven,
};
use unripple::physics::Medium;
use unripple_store::{parse_surface, to_toml};
use unripple_tasks::source::Stored;
use unripple_tasks::target::{LevelAsk, targets};
use unripple_tasks::{Source, TaskError, above_zero, focus};

/// Places this near to each other, in metres, are the same, as they are to the tasks. Far below any wavelength.
const SAME: f64 = 1e-6;

/// Rates that differ by less than this share are the same, but for what rounding in files leaves.
const SAME_RATE: f64 = 1e-9;

/// Top of the band over the sample rate where no band is given: above half of it samples take a frequency for one as far below, and filters
/// need some room. With twice this value, that would happen.
const OF_RATE: f64 = 0.45;

/// Mass per area of a sheet that is made up: thickness in metres and density in kg/m³. With its tension it gives the waves their speed; no
/// figure depends on the numbers themselves.
const MADE_UP: [f64; 2] = [1e-4, 1e3];

/// An array of responses, and what is known of it.
pub(super) struct Given {
    /// The samples in m/s per unit impulse, `[point][actuator][sample]`.
    pub samples: Vec<f32>,
    /// Numbers of points, actuators and samples.
    pub shape: [usize; 3],
    /// Samples per second.
    pub rate: f64,
    /// The points, in m.
    pub points: Vec<Point>,
    /// Names of the actuators.
    pub names: Vec<String>,
    /// Places of the actuators, in m.
    pub places: Vec<Point>,
    /// Lowest and highest frequency, in Hz.
    pub band: Option<[f64; 2]>,
    /// Shortest wavelength of the band, in m.
    pub lambda_min: Option<f64>,
    /// The surface that the responses are of.
    pub surface: Option<Arc<Surface>>,
    /// Whether the samples are in m/s per unit impulse, rather than known but for a factor.
    pub scaled: bool,
}

impl Given {
    /// The responses as the input of tasks.
    pub fn source(self) -> Result<Source, TaskError> {
        self.check()?;
        let band = self.band()?;
        let lambda_min = self.lambda_min(band[1])?;
        let surface = match &self.surface {
            Some(surface) => self.fits(surface, band)?,
            None => self.made_up(band, lambda_min)?,
        };
        let ports = surface.actuators.iter().map(|a| Port { name: a.name.clone(), at: a.at }).collect();
        let outline = surface.outline.clone();
        let conditions = Conditions { rate: surface.emission.rate, band, lambda_min, outline };
        let told = format!("the {} points of the array", self.points.len());
        let without_scale = (!self.scaled).then(|| {
            "the samples of the array are known but for a factor, unless `scaled` says otherwise".to_owned()
        });
        let notes = without_scale.iter().map(|why| Note { topic: "level", text: why.clone() }).collect();
        let [_, _, samples] = self.shape;
        let responses = SampledResponses::new(ports, self.points, conditions, samples, self.samples);
        let responses = responses.map_err(TaskError::input)?;
        Ok(Source::sampled(surface, Stored { responses, told, notes, without_scale }))
    }

    /// Refuses arrays that do not fit together, and empty ones.
    fn check(&self) -> Result<(), TaskError> {
        let [points, actuators, samples] = self.shape;
        if self.samples.is_empty() {
            return Err(TaskError::Input(format!(
                "h: expected at least one point, actuator and sample, found {points} x {actuators} x {samples}"
            )));
        }
        for (what, expected, found) in [
            ("points_m", points, self.points.len()),
            ("names", actuators, self.names.len()),
            ("actuators_m", actuators, self.places.len()),
        ] {
            if expected != found {
                let message =
                    format!("{what}: expected {expected} of them, as many as `h` has, found {found}");
                return Err(TaskError::Input(message));
            }
        }
        above_zero(self.rate, "rate_hz", "Hz").map(drop)
    }

    /// The band, in Hz: as given, that of the surface, or nearly all that samples tell apart.
    fn band(&self) -> Result<[f64; 2], TaskError> {
        let of_surface = self.surface.as_ref().map(|surface| surface.emission.band);
        let band = self.band.or(of_surface).unwrap_or([0.0, OF_RATE * self.rate]);
        let ([low, high], half) = (band, self.rate / 2.0);
        if low >= 0.0 && low < high && high < half {
            return Ok(band);
        }
        let expected = format!("0 Hz or more, and more than that below {half} Hz, half the sample rate");
        Err(TaskError::ask("band_hz", expected, format!("{low} and {high} Hz")))
    }

    /// The shortest wavelength (m) of a band up to `top` (Hz): as given, or that of the surface's waves.
    fn lambda_min(&self, top: f64) -> Result<f64, TaskError> {
        match (self.lambda_min, &self.surface) {
            (Some(given), _) => above_zero(given, "lambda_min_m", "m"),
            (None, Some(surface)) => Ok(Medium::of(&surface.sheet).lambda_min(top)),
            (None, None) => {
                let expected = "the shortest wavelength of the band, or a surface that it follows from";
                Err(TaskError::ask("lambda_min_m", expected, "neither"))
            }
        }
    }

    /// The surface that was given, with the band (Hz) of the responses, provided that they can be its own.
    fn fits(&self, surface: &Surface, band: [f64; 2]) -> Result<Surface, TaskError> {
        let expected: Vec<&str> = surface.actuators.iter().map(|a| a.name.as_str()).collect();
        if expected != self.names {
            return Err(TaskError::ask("names", expected.join(", "), self.names.join(", ")));
        }
        let moved = |(actuator, at): &(&Actuator, &Point)| actuator.at.distance(**at) > SAME;
        if let Some((actuator, at)) = surface.actuators.iter().zip(&self.places).find(moved) {
            let expected = format!("`{}` at {}, as on the surface", actuator.name, actuator.at);
            return Err(TaskError::ask("actuators_m", expected, at));
        }
        let rate = surface.emission.rate;
        if (self.rate / rate - 1.0).abs() > SAME_RATE {
            return Err(TaskError::ask("rate_hz", format!("{rate} Hz, that of the surface"), self.rate));
        }
        let outline = &surface.outline;
        let beyond = |at: &&Point| !outline.contains(**at) && outline.to_rim(**at) > SAME;
        if let Some(at) = self.points.iter().find(beyond) {
            let found = format!("{at}, beyond its rim (nearest: {})", outline.nearest(*at));
            return Err(TaskError::ask("points_m", "points on the surface", found));
        }
        let emission = Emission { band, ..surface.emission.clone() };
        Ok(Surface { emission, ..surface.clone() })
    }

    /// A rectangle around points and actuators, which are ideal forces, with waves of one speed: a wavelength (m) of `lambda_min` at the top of
    /// the band (Hz).
    fn made_up(&self, band: [f64; 2], lambda_min: f64) -> Result<Surface, TaskError> {
        let all = || self.points.iter().chain(&self.places);
        if let Some(at) = all().find(|at| at.x < 0.0 || at.y < 0.0) {
            let expected = "places that count from the lower-left corner of the surface, 0 m or more";
            return Err(TaskError::ask("points_m, actuators_m", expected, at));
        }
        // Places on one line still have a surface around them.
        let reach = |along: fn(&Point) -> f64| all().map(along).fold(lambda_min, f64::max);
        let (width, height) = (reach(|at| at.x), reach(|at| at.y));
        let [thickness, density] = MADE_UP;
        let speed = lambda_min * band[1];
        let force = |(name, at): (&String, &Point)| Actuator {
            name: name.clone(),
            at: *at,
            kind: ActuatorKind::Force,
            contact_radius: 0.0,
        };
        let surface = Surface {
            name: "array".into(),
            outline: Outline::new(Shape::Rectangle { width, height }),
            sheet: Sheet {
                material: "unknown".into(),
                young: 0.0,
                density,
                poisson: 0.3,
                strength: None,
                thickness,
                tension: density * thickness * speed * speed,
                // A table of one row, since losses of one decay time would be corrected for one that nobody knows.
                decay: Decay::Table(vec![(0.0, 1.0)]),
                air: Air::None,
                uneven: Uneven::default(),
            },
            emission: Emission { band, rate: self.rate, limit: 1.0, rms_limit: None },
            finger: Finger::default(),
            accuracy: None,
            actuators: self.names.iter().zip(&self.places).map(force).collect(),
        };
        // Through its file, which names, places and rates have to fit into.
        parse_surface(&to_toml(&surface), "array").map_err(|faults| TaskError::Faults(Box::new(faults)))
    }
}

/// The first of some places (m) that is none of the points.
pub(super) fn elsewhere(stored: &SampledResponses, places: &[Point]) -> Option<Point> {
    let known = |place: &Point| stored.points.iter().any(|point| point.distance(*place) < SAME);
    places.iter().copied().find(|place| !known(place))
}

/// Refuses to interpolate with the waves of a sheet that nobody knows.
pub(super) fn between(
    stored: &SampledResponses,
    places: &[Point],
    way: Interpolation,
) -> Result<(), TaskError> {
    match elsewhere(stored, places) {
        Some(place) if way == Interpolation::Kernel => Err(TaskError::ask(
            "between",
            format!(
                "nearest or linear at {place}, between the points of an array without a surface, whose waves kernel needs"
            ),
            way.name(),
        )),
        _ => Ok(()),
    }
}

/// Chooses for an ask what follows from the sheet, where nobody knows it: the level is that of the limit, and the window half as long as the
/// responses, so that they last for twice the window.
pub(super) fn choose(ask: &mut focus::Ask, source: &mut Source) -> Result<(), TaskError> {
    let Some(stored) = &mut source.stored else { return Ok(()) };
    let Conditions { rate, lambda_min, .. } = stored.responses.conditions;
    let targets = targets(&ask.points, &ask.shapes, lambda_min)?;
    let places: Vec<Point> = targets.into_iter().flat_map(|target| target.points).collect();
    between(&stored.responses, &places, ask.between)?;
    if ask.on.is_none() && ask.level == LevelAsk::Linear {
        ask.level = LevelAsk::Limit;
    }
    if ask.window_s.is_none() {
        let window = (stored.responses.samples().saturating_sub(1) / 2) as f64 / rate;
        ask.window_s = Some(window);
        let text =
            format!("{:.2} ms, half the length of the responses, since no surface is known", window * 1e3);
        stored.notes.push(Note { topic: "window", text });
    }
    Ok(())
}

/// Removes from a report what was said of a sheet that is made up.
pub(super) fn forget(report: &mut Report) {
    report.notes.retain(|note| note.topic != "linear theory");
}
