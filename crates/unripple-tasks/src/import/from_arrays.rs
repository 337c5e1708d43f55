//! Responses from named arrays, as NPZ and MATLAB files hold them.
//!
//! `responses` is points x actuators x samples, or lines in frequency; `actuators` has the names, `points_m` or `points_mm` the places, and one
//! of `rate_hz`, `time_s` and `frequency_hz` the abscissa. `kind`, `quantity`, `unit` and `per` may say what the values are; instead of `per`,
//! `drive_units` may say the unit of each actuator's reference.

use super::abscissa::even;
use super::found::Found;
use super::labels::Labels;
use super::measured::{Complex, Measured, Says, Signal, Who};
use super::{Kind, Per, Quantity, units};
use crate::TaskError;
use serde::de::DeserializeOwned;
use serde_json::Value;
use unripple::core::Point;
use unripple_exchange::{Array, Arrays, Values};

/// The abscissa of all responses of a file.
struct Abscissa {
    start: f64,
    step: f64,
    in_time: bool,
}

/// Reads the arrays of a file.
pub(super) fn read(arrays: Arrays, file: &str, labels: &Labels, found: &mut Found) -> Result<(), TaskError> {
    let reading = Reading { arrays, file, labels };
    let (names, points) = (reading.names()?, reading.points()?);
    let says = reading.says()?;
    let units =
        reading.arrays.get("drive_units").and_then(Array::as_texts).filter(|u| u.len() == names.len());
    let responses = reading.needed("responses")?;
    let shape = shape(&responses.shape, points.len(), names.len());
    let Some(samples) = shape.filter(|samples| *samples > 1) else {
        return Err(reading.refused(
            "responses",
            format!("{} points x {} actuators x samples", points.len(), names.len()),
            format!("{:?}", responses.shape),
        ));
    };
    let abscissa = reading.abscissa(samples)?;
    for (p, at) in points.iter().enumerate() {
        for (a, name) in names.iter().enumerate() {
            let from = (p * names.len() + a) * samples;
            let by_unit = units.and_then(|units| units::reference(&units[a]));
            let signal = reading.signal(&responses.values, from..from + samples, &abscissa)?;
            found.responses.push(Measured {
                from: format!("{file}: point {}, {name}", p + 1),
                who: Who { names: vec![name.clone()], at: None },
                at: *at,
                signal,
                sign: 1.0,
                says: Says { per: says.per.or(by_unit), ..says },
            });
        }
    }
    Ok(())
}

/// Number of samples of responses of this shape; `None` if it is another one. An axis of length 1 may be left out.
fn shape(shape: &[usize], points: usize, actuators: usize) -> Option<usize> {
    match shape {
        [p, a, samples] if (*p, *a) == (points, actuators) => Some(*samples),
        [p, samples] if *p == points && actuators == 1 => Some(*samples),
        [a, samples] if *a == actuators && points == 1 => Some(*samples),
        [samples] if points == 1 && actuators == 1 => Some(*samples),
        _ => None,
    }
}

/// The arrays of a file that is being read.
struct Reading<'a> {
    arrays: Arrays,
    file: &'a str,
    labels: &'a Labels,
}

impl Reading<'_> {
    fn refused(&self, name: &str, expected: impl Into<String>, found: impl std::fmt::Display) -> TaskError {
        TaskError::Input(format!("{}: `{name}`: expected {}, found {found}", self.file, expected.into()))
    }

    fn needed(&self, name: &str) -> Result<&Array, TaskError> {
        self.arrays.get(name).ok_or_else(|| {
            let known = self.arrays.keys().map(String::as_str).collect::<Vec<_>>().join(", ");
            self.refused(name, "an array of this name", format!("only {known}"))
        })
    }

    /// Names of the actuators.
    fn names(&self) -> Result<Vec<String>, TaskError> {
        let names = self.needed("actuators")?.as_texts();
        Ok(names.ok_or_else(|| self.refused("actuators", "names", "numbers"))?.to_vec())
    }

    /// Places of the points, in m.
    fn points(&self) -> Result<Vec<Point>, TaskError> {
        let known = [("points_m", Some(1.0)), ("points_mm", Some(1e-3)), ("points", None)];
        let Some((name, metres)) = known.into_iter().find(|(name, _)| self.arrays.contains_key(*name)) else {
            return Err(self.refused("points_m", "places, as `points_m` or `points_mm`", "none"));
        };
        let metres = metres.map_or_else(|| self.labels.needed_length(self.file), Ok)?;
        let array = self.needed(name)?;
        let values = array.as_real().filter(|values| values.iter().all(|x| x.is_finite()));
        match (values, array.shape.last()) {
            (Some(values), Some(2)) if !values.is_empty() => {
                let places = values.as_chunks::<2>().0.iter();
                Ok(places.map(|[x, y]| self.labels.moved(metres * x, metres * y)).collect())
            }
            _ => Err(self.refused(name, "finite places, points x 2", format!("{:?}", array.shape))),
        }
    }

    /// What the file says about its values.
    fn says(&self) -> Result<Says, TaskError> {
        let text = |name: &str| self.arrays.get(name).and_then(Array::as_text);
        let unit = text("unit").map(|unit| {
            let expected = "a unit such as m/s, mm/s, um, m/s2 or g";
            units::response(unit).ok_or_else(|| self.refused("unit", expected, format!("`{unit}`")))
        });
        let per: Option<Per> = self.choice("per", "newton, volt or ampere")?;
        Ok(Says {
            kind: self.choice::<Kind>("kind", "frequency-responses, impulse-responses or filters")?,
            quantity: self.choice::<Quantity>("quantity", "velocity, displacement or acceleration")?,
            unit: unit.transpose()?,
            per: per.map(|per| (per, 1.0)),
            length: None,
        })
    }

    /// One of the values that a field of the request has too.
    fn choice<T: DeserializeOwned>(&self, name: &str, expected: &str) -> Result<Option<T>, TaskError> {
        let Some(text) = self.arrays.get(name).and_then(Array::as_text) else { return Ok(None) };
        let read = serde_json::from_value(Value::String(text.to_owned()));
        read.map(Some).map_err(|_| self.refused(name, expected, format!("`{text}`")))
    }

    /// The abscissa of responses of so many samples.
    fn abscissa(&self, samples: usize) -> Result<Abscissa, TaskError> {
        let number = |name: &str| {
            let value = self.arrays.get(name).map(|array| array.as_number().unwrap_or(f64::NAN));
            let good = value.filter(|value| value.is_finite() && *value > 0.0);
            match (value, good) {
                (Some(value), None) => Err(self.refused(name, "one number above 0", value)),
                _ => Ok(good),
            }
        };
        if let Some(rate) = number("rate_hz")? {
            return Ok(Abscissa { start: 0.0, step: 1.0 / rate, in_time: true });
        }
        for (name, in_time) in [("time_s", true), ("frequency_hz", false)] {
            let Some(array) = self.arrays.get(name) else { continue };
            let values = array.as_real().filter(|values| values.len() == samples);
            let Some(values) = values else {
                return Err(self.refused(name, format!("{samples} numbers"), array.values.len()));
            };
            let (start, step) = even(values, name, |n| format!("{}: `{name}`: number {}", self.file, n + 1))?;
            return Ok(Abscissa { start, step, in_time });
        }
        Err(self.refused("rate_hz", "`rate_hz`, `time_s` or `frequency_hz`", "none"))
    }

    /// The values of one response.
    fn signal(
        &self,
        values: &Values,
        range: std::ops::Range<usize>,
        abscissa: &Abscissa,
    ) -> Result<Signal, TaskError> {
        let Abscissa { start, step, in_time } = *abscissa;
        let finite = match values {
            Values::Real(values) => values[range.clone()].iter().all(|x| x.is_finite()),
            Values::Complex(values) => values[range.clone()].iter().flatten().all(|x| x.is_finite()),
            Values::Text(_) => true,
        };
        if !finite {
            return Err(self.refused("responses", "finite values", "one that is not"));
        }
        match (values, in_time) {
            (Values::Real(values), true) => Ok(Signal::Time { start, step, values: values[range].to_vec() }),
            (Values::Complex(values), false) => {
                let values = values[range].iter().map(|[re, im]| Complex::new(*re, *im)).collect();
                Ok(Signal::Frequency { start, step, values })
            }
            (Values::Real(_), false) => {
                Err(self.refused("responses", "complex values, beside frequencies", "real ones"))
            }
            (Values::Complex(_), true) => {
                Err(self.refused("responses", "real values, beside times", "complex ones"))
            }
            (Values::Text(_), _) => Err(self.refused("responses", "numbers", "texts")),
        }
    }
}
