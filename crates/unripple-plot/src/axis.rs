//! Axes: scale, range, ticks.

use crate::{PlotError, font, ticks};

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Evenly: equal steps are equally long.
    #[default]
    Linear,
    /// By their logarithm; every value must be positive.
    Logarithmic,
}

/// One axis of a plot: its label, scale and range. Data stay in their own unit and are multiplied before they are shown.
///
/// # Example
/// ```
/// use unripple_plot::Axis;
/// let time = Axis::new("Time (ms)").times(1e3).from(0.0).to(0.06); // data in seconds
/// assert_eq!(time.high, Some(0.06));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Name of the quantity, with the unit shown, as in `Time (ms)`.
    pub label: String,
    /// How values are spread.
    pub scale: Scale,
    /// Factor from data to the numbers shown: 1e3 for data in seconds on an axis in milliseconds.
    pub multiplier: f64,
    /// Low end of the axis, in the data's unit; determined from the data if absent.
    pub low: Option<f64>,
    /// High end of the axis, in the data's unit; determined from the data if absent.
    pub high: Option<f64>,
    /// Names written at the values 0, 1, 2 and so on, for an axis whose values stand for named things, and
    /// which is linear; empty for an axis of numbers. If there is no room for all names, every second, third
    /// and so on is written; a long name is written without its middle.
    pub names: Vec<String>,
}

impl Default for Axis {
    fn default() -> Self {
        Self {
            label: String::new(),
            scale: Scale::Linear,
            multiplier: 1.0,
            low: None,
            high: None,
            names: Vec::new(),
        }
    }
}

impl Axis {
    /// A linear axis.
    pub fn new(label: impl Into<String>) -> Self {
        Self { label: label.into(), ..Self::default() }
    }

    /// A logarithmic axis.
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Logarithmic, ..Self::default() }
    }

    /// A linear axis whose values stand for named things: the first name is at the value 0, the second at 1
    /// and so on.
    pub fn named(label: impl Into<String>, names: Vec<String>) -> Self {
        Self { label: label.into(), names, ..Self::default() }
    }

    /// How values are spread, with names or without.
    fn spread(&self) -> Scale {
        if self.names.is_empty() { self.scale } else { Scale::Linear }
    }

    /// This axis with its data multiplied for display. `multiplier` is the factor from the data's unit to the unit
    /// shown: 1e3 for data in s on an axis in ms.
    pub fn times(mut self, multiplier: f64) -> Self {
        self.multiplier = multiplier;
        self
    }

    /// The same axis with a given low end, in the data's unit.
    pub fn from(mut self, low: f64) -> Self {
        self.low = Some(low);
        self
    }

    /// The same axis with a given high end, in the data's unit.
    pub fn to(mut self, high: f64) -> Self {
        self.high = Some(high);
        self
    }
}

/// An axis with a fixed range and fixed ticks, which maps data to fractions of its length.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ruler {
    scale: Scale,
    multiplier: f64,
    low: f64,
    high: f64,
    /// Major ticks: value in the unit shown, and label.
    pub major: Vec<(f64, String)>,
    /// Minor ticks: values in the unit shown.
    pub minor: Vec<f64>,
    /// Exponent of the power of ten that is taken out of the labels; `None` if none is.
    pub power: Option<i32>,
}

/// Direction of an axis, for the room its labels need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Direction {
    Across,
    Up,
}

/// Room left round the data, as a share of their span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Padding {
    /// Room at each end, as a share of the data's span.
    pub share: f64,
    /// Whether an axis of non-negative data starts at zero when that wastes little.
    pub zero: bool,
}

impl Ruler {
    /// Fixes range and ticks of an axis that is `length` points long for data values, with tick labels of
    /// `size` points.
    ///
    /// Errors when an end is not finite, or not positive on a logarithmic axis, or when the ends are not apart.
    pub fn new(
        axis: &Axis,
        data: impl Iterator<Item = f64>,
        padding: Padding,
        direction: Direction,
        length: f64,
        size: f64,
    ) -> Result<Self, PlotError> {
        let (low, high) = range(axis, data, padding)?;
        let mut ruler = Self {
            scale: axis.spread(),
            multiplier: axis.multiplier,
            low,
            high,
            major: Vec::new(),
            minor: Vec::new(),
            power: None,
        };
        if !axis.names.is_empty() {
            ruler.name(&axis.names, direction, length, size);
            return Ok(ruler);
        }
        let spacing = if direction == Direction::Up { 2.2 * size } else { 2.6 * size };
        let most = ((length / spacing) as usize).clamp(2, 9);
        for most in (2..=most).rev() {
            ruler.tick(most);
            if ruler.has_room(direction, length, size) {
                break;
            }
        }
        Ok(ruler)
    }

    fn tick(&mut self, most: usize) {
        match self.scale {
            Scale::Linear => {
                let places = ticks::nice_ticks(self.low, self.high, most);
                let (labels, power) = ticks::labels(&places);
                self.minor = ticks::linear_minor(&places, self.low, self.high);
                self.major = places.into_iter().zip(labels).collect();
                self.power = power;
            }
            Scale::Logarithmic => {
                let (places, minor) = ticks::logarithmic(self.low, self.high, most);
                let labels = ticks::log_labels(&places);
                self.minor = minor;
                self.major = places.into_iter().zip(labels).collect();
            }
        }
    }

    /// Ticks at the things that an axis names: at all of them, or at as many as have room.
    fn name(&mut self, names: &[String], direction: Direction, length: f64, size: f64) {
        let (low, high) = (self.low, self.high);
        for step in 1..=names.len() {
            let named = names.iter().enumerate().step_by(step).map(|(i, name)| (i as f64, shortened(name)));
            self.major = named.filter(|(value, _)| (low..=high).contains(value)).collect();
            if self.has_room(direction, length, size) {
                break;
            }
        }
    }

    fn has_room(&self, direction: Direction, length: f64, size: f64) -> bool {
        self.major.windows(2).all(|pair| {
            let between = (self.shown(pair[1].0) - self.shown(pair[0].0)) * length;
            let needed = match direction {
                Direction::Up => 1.3 * size,
                Direction::Across => {
                    (font::width(&pair[0].1, size) + font::width(&pair[1].1, size)) / 2.0 + 0.8 * size
                }
            };
            between >= needed
        })
    }

    /// Place of a datum as a fraction of the axis: 0 at the low end, 1 at the high one; NaN where it cannot be shown.
    pub fn place(&self, datum: f64) -> f64 {
        self.shown(datum * self.multiplier)
    }

    /// Place of a value in the unit shown, as a fraction of the axis.
    pub fn shown(&self, value: f64) -> f64 {
        let fraction = match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Logarithmic if value > 0.0 => (value / self.low).log10() / (self.high / self.low).log10(),
            Scale::Logarithmic => f64::NAN,
        };
        if fraction.is_finite() { fraction.clamp(-100.0, 100.0) } else { f64::NAN }
    }

    /// Both ends, in the unit shown.
    pub fn ends(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// The datum half-way along the axis, in the data's unit.
    pub fn middle(&self) -> f64 {
        let shown = match self.scale {
            Scale::Linear => (self.low + self.high) / 2.0,
            Scale::Logarithmic => (self.low * self.high).sqrt(),
        };
        shown / self.multiplier
    }

    /// The widest label's width in points, at a size of type in points.
    pub fn label_width(&self, size: f64) -> f64 {
        self.major.iter().map(|(_, label)| font::width(label, size)).fold(0.0, f64::max)
    }
}

/// Longest name of a thing as it is written, in characters: some 40 mm at the usual size of type, half of a page's column.
const LONGEST: usize = 28;

/// A name as it is written: without its middle if it is too long, since names often begin alike and end alike.
pub(crate) fn shortened(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() <= LONGEST {
        return name.to_owned();
    }
    let half = LONGEST / 2;
    let (start, end) = (&letters[..half], &letters[letters.len() - half + 1..]);
    start.iter().chain(&['…']).chain(end).collect()
}

/// Largest magnitude of a value that is drawn, in the unit shown; anything beyond counts as a gap.
pub(crate) const LARGEST: f64 = 1e100;

/// Smallest value on a logarithmic axis and smallest span of any other, so that the ratio of any two is a number.
const SMALLEST: f64 = 1e-100;

/// Both ends of the range, in the unit shown.
fn range(axis: &Axis, data: impl Iterator<Item = f64>, padding: Padding) -> Result<(f64, f64), PlotError> {
    let log = axis.spread() == Scale::Logarithmic;
    let name = || if axis.label.is_empty() { "axis".to_owned() } else { format!("axis `{}`", axis.label) };
    check(&name, "a finite, non-zero multiplier", axis.multiplier, |m| usable(m) && m != 0.0)?;
    for end in [axis.low, axis.high].into_iter().flatten().map(|end| end * axis.multiplier) {
        check(&name, "a finite end", end, usable)?;
        check(&name, "a positive end, 1e-100 or more, on a logarithmic axis", end, |end| {
            !log || end >= SMALLEST
        })?;
    }
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for value in data.map(|datum| datum * axis.multiplier).filter(|value| usable(*value)) {
        check(&name, "a positive value, 1e-100 or more, on a logarithmic axis", value, |v| {
            !log || v >= SMALLEST
        })?;
        (least, most) = (least.min(value), most.max(value));
    }
    let (least, most) = if least <= most { (least, most) } else { (1.0, 1.0) };
    let (low, high) = match axis.names.len() {
        0 if log => log_range(least, most, padding),
        0 => linear_range(least, most, padding),
        // Half a step beyond the first and the last.
        things => (-0.5, things as f64 - 0.5),
    };
    let given = |end: Option<f64>| end.map(|end| end * axis.multiplier);
    let (low, high) = (given(axis.low).unwrap_or(low), given(axis.high).unwrap_or(high));
    check(&name, "a high end above the low one", high, |high| high > low)?;
    check(&name, "a high end at least 1e-100 above the low one", high, |high| log || high - low >= SMALLEST)?;
    Ok((low, high))
}

fn check(
    name: &dyn Fn() -> String,
    expected: &'static str,
    found: f64,
    legal: impl Fn(f64) -> bool,
) -> Result<(), PlotError> {
    if legal(found) { Ok(()) } else { Err(PlotError::Range { what: name(), expected, found }) }
}

/// Whether a value can be drawn.
pub(crate) fn usable(value: f64) -> bool {
    value.abs() <= LARGEST
}

/// Both ends moved outwards to a round number if one is within 0.3 % of the span: the last of many samples often
/// falls just short of one.
fn snapped(least: f64, most: f64) -> (f64, f64) {
    let span = most - least;
    let unit = 10f64.powf(span.log10().floor()) / 10.0;
    let near = |round: f64, end: f64| if (round - end).abs() < 3e-3 * span { round } else { end };
    (near((least / unit).floor() * unit, least), near((most / unit).ceil() * unit, most))
}

fn linear_range(least: f64, most: f64, padding: Padding) -> (f64, f64) {
    let size = least.abs().max(most.abs());
    let span = most - least;
    if span <= 1e-9 * size || span < 1e-100 {
        let room = if size < 1e-100 { 1.0 } else { size * 0.1 };
        return (least - room, most + room);
    }
    if padding.share == 0.0 {
        return snapped(least, most);
    }
    let low =
        if padding.zero && (0.0..0.5 * most).contains(&least) { 0.0 } else { least - padding.share * span };
    let high =
        if padding.zero && most <= 0.0 && most > 0.5 * least { 0.0 } else { most + padding.share * span };
    (low, high)
}

fn log_range(least: f64, most: f64, padding: Padding) -> (f64, f64) {
    let ratio = most / least;
    let room = if ratio < 1.0 + 1e-9 { 2.0 } else { ratio.powf(padding.share) };
    (least / room, most * room)
}
