//! The plan of a library: the responses that it is to hold.

use crate::StoreError;
use std::collections::{BTreeMap, HashSet};
use unripple_core::{Conditions, Outline, Point, Port, Shape, Surface};

/// Largest number of points of a library: their positions alone are then 256 MiB.
pub(crate) const MOST_POINTS: usize = 1 << 24;
/// Largest number of actuators: about as many as a WAV file has channels for.
const MOST_PORTS: usize = 1 << 16;
/// Largest number of values of one point: its chunk is read whole. 1 GiB of float32.
const MOST_VALUES: usize = 1 << 28;

/// Keys of [`LibraryPlan::provenance`] that may differ when measuring into a library is resumed.
pub const MAY_DIFFER: [&str; 2] = ["created", "software"];

/// The plan of a library: all that is known before the first response is stored.
#[derive(Clone, Debug, PartialEq)]
pub struct LibraryPlan {
    /// The actuators, in channel order; their names are unique.
    pub ports: Vec<Port>,
    /// Unit of each actuator's drive: "N", "A" or "V". A response is in m/s per that unit and second.
    pub drive_units: Vec<String>,
    /// Points at which the responses are measured or computed, in metres.
    pub points: Vec<Point>,
    /// Sample rate, frequency band, shortest wavelength λ_min, and outline of the surface.
    pub conditions: Conditions,
    /// Number of samples per response.
    pub samples: usize,
    /// Time of the impulse in each response, in seconds after the first sample.
    pub onset: f64,
    /// The surface as its file describes it; `None` if there is no such file.
    pub surface: Option<Surface>,
    /// Origin of the data: device, stimulus, software, seed, time. Free text under free keys.
    pub provenance: BTreeMap<String, String>,
}

impl LibraryPlan {
    /// A plan with drives in N, the impulse at the first sample, and no provenance.
    ///
    /// ```
    /// use unripple_core::{Conditions, Outline, Point, Port, Shape};
    /// use unripple_store::LibraryPlan;
    /// let outline = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
    /// let conditions = Conditions { rate: 48e3, band: [0.0, 3e3], lambda_min: 14.6e-3, outline };
    /// let port = Port { name: "a1".into(), at: Point::from_mm(12.0, 31.0) };
    /// let plan = LibraryPlan::new(vec![port], vec![Point::from_mm(62.0, 90.0)], conditions, 1441);
    /// assert_eq!(plan.drive_units, ["N"]);
    /// ```
    pub fn new(ports: Vec<Port>, points: Vec<Point>, conditions: Conditions, samples: usize) -> Self {
        let drive_units = vec!["N".to_owned(); ports.len()];
        let provenance = BTreeMap::new();
        Self { ports, drive_units, points, conditions, samples, onset: 0.0, surface: None, provenance }
    }

    /// Values of one point: actuators times samples.
    pub(crate) fn values(&self) -> usize {
        self.ports.len() * self.samples
    }

    /// Refuses what no library can hold; `file` names the place in the message.
    pub(crate) fn check(&self, file: &str) -> Result<(), StoreError> {
        let require = |legal: bool, expected: String, found: String| {
            if legal { Ok(()) } else { Err(StoreError::content(file, expected, found)) }
        };
        let count = |what: &str, found: usize, most: usize| {
            let expected = format!("1 to {most} {what}");
            require((1..=most).contains(&found), expected, found.to_string())
        };
        count("actuators", self.ports.len(), MOST_PORTS)?;
        count("points", self.points.len(), MOST_POINTS)?;
        count("samples", self.samples, MOST_VALUES / self.ports.len())?;
        let units = self.drive_units.len();
        require(
            units == self.ports.len(),
            format!("a unit for each of {} actuators", self.ports.len()),
            units.to_string(),
        )?;
        let mut names = HashSet::new();
        if let Some(port) = self.ports.iter().find(|p| p.name.is_empty() || !names.insert(p.name.as_str())) {
            return Err(StoreError::content(
                file,
                "a different name for each actuator",
                format!("`{}`", port.name),
            ));
        }
        let places = self.ports.iter().map(|p| p.at).chain(self.points.iter().copied());
        if let Some(at) = places.into_iter().find(|at| !at.is_finite()) {
            return Err(StoreError::content(file, "finite places", at.to_string()));
        }
        self.check_conditions(file)
    }

    fn check_conditions(&self, file: &str) -> Result<(), StoreError> {
        let Conditions { rate, band: [low, high], lambda_min, outline } = &self.conditions;
        let require = |legal: bool, expected: &str, found: String| {
            if legal { Ok(()) } else { Err(StoreError::content(file, expected, found)) }
        };
        let positive = |x: f64| x.is_finite() && x > 0.0;
        // That of a WAV file, as which drives are written.
        let whole_rate = positive(*rate) && rate.fract() == 0.0;
        require(whole_rate, "a whole sample rate above 0 Hz", rate.to_string())?;
        let band = *low >= 0.0 && low < high && high.is_finite();
        require(band, "a band from 0 Hz or more up to more", format!("{low} to {high} Hz"))?;
        require(positive(*lambda_min), "a shortest wavelength above 0 m", lambda_min.to_string())?;
        let last = (self.samples - 1) as f64 / rate;
        let onset = (0.0..=last).contains(&self.onset);
        require(onset, "an onset within the responses", format!("{} s", self.onset))?;
        require(whole(outline), "an outline around some area", "none".into())
    }

    /// The first difference between this plan and `found`, in words; `None` if they agree, apart from the
    /// keys [`MAY_DIFFER`].
    pub fn difference(&self, found: &Self) -> Option<String> {
        let told = |what: &str, here: String, there: String| {
            (here != there).then(|| format!("{what}: {there} instead of {here}"))
        };
        let (a, b) = (&self.conditions, &found.conditions);
        told("actuators", self.ports.len().to_string(), found.ports.len().to_string())
            .or_else(|| ports(self, found))
            .or_else(|| told("points", self.points.len().to_string(), found.points.len().to_string()))
            .or_else(|| {
                let mut pairs = self.points.iter().zip(&found.points).enumerate();
                let (i, (here, there)) = pairs.find(|(_, (here, there))| here != there)?;
                told(&format!("point {}", i + 1), place(*here), place(*there))
            })
            .or_else(|| told("samples", self.samples.to_string(), found.samples.to_string()))
            .or_else(|| told("sample rate in Hz", a.rate.to_string(), b.rate.to_string()))
            .or_else(|| told("band in Hz", format!("{:?}", a.band), format!("{:?}", b.band)))
            .or_else(|| told("λ_min in m", a.lambda_min.to_string(), b.lambda_min.to_string()))
            .or_else(|| told("onset in s", self.onset.to_string(), found.onset.to_string()))
            .or_else(|| (a.outline != b.outline).then(|| "another outline".to_owned()))
            .or_else(|| {
                let name =
                    |plan: &Self| plan.surface.as_ref().map_or("none".into(), |s| format!("`{}`", s.name));
                told("surface", name(self), name(found))
            })
            .or_else(|| {
                (self.surface != found.surface).then(|| "a different surface of the same name".into())
            })
            .or_else(|| provenance(&self.provenance, &found.provenance))
    }
}

/// A place to the last digit, so that two that differ read differently.
fn place(at: Point) -> String {
    format!("({}, {}) m", at.x, at.y)
}

fn ports(here: &LibraryPlan, there: &LibraryPlan) -> Option<String> {
    let told = |plan: &LibraryPlan, i: usize| {
        let port = &plan.ports[i];
        let unit = plan.drive_units.get(i).map_or("no unit", |u| u);
        format!("`{}` at {} in {unit}", port.name, place(port.at))
    };
    let mut pairs = (0..here.ports.len()).map(|i| (i, told(here, i), told(there, i)));
    let (i, a, b) = pairs.find(|(_, a, b)| a != b)?;
    Some(format!("actuator {}: {b} instead of {a}", i + 1))
}

fn provenance(here: &BTreeMap<String, String>, there: &BTreeMap<String, String>) -> Option<String> {
    let said = |map: &BTreeMap<String, String>, key: &str| {
        map.get(key).map_or("nothing".into(), |v| format!("`{v}`"))
    };
    let mut keys = here.keys().chain(there.keys()).filter(|key| !MAY_DIFFER.contains(&key.as_str()));
    let key = keys.find(|key| here.get(*key) != there.get(*key))?;
    Some(format!("provenance `{key}`: {} instead of {}", said(there, key), said(here, key)))
}

/// Whether an outline can be that of a surface, as far as the library cares.
fn whole(outline: &Outline) -> bool {
    let sides = match &outline.shape {
        Shape::Polygon(vertices) => vertices.len() >= 3,
        Shape::Path(sides) => !sides.is_empty(),
        Shape::Rectangle { width, height } => *width > 0.0 && *height > 0.0,
        Shape::Circle { radius } => *radius > 0.0,
        Shape::Stadium { straight, radius } => *straight >= 0.0 && *radius > 0.0,
    };
    let (width, height) = if sides { outline.extent() } else { (0.0, 0.0) };
    let positive = |x: f64| x.is_finite() && x > 0.0;
    positive(width) && positive(height) && outline.holes.iter().all(|hole| !hole.sides.is_empty())
}
