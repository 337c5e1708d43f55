//! The recordings that a plan requests: files by point and repeat; files of earlier points keep their names
//! when points are added.

use crate::calibrate::points::Places;
use serde_json::Value;
use unripple::core::Point;

/// Distance in metres below which two places count as the same.
pub const SAME: f64 = 1e-9;

/// Largest number of missing recordings that are named one by one; beyond it, only their number is reported.
const LISTED: usize = 12;

/// A recording that the plan requests.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Number of the point, from 0; the number after the last point stands for the recording of the
    /// actuators.
    pub number: usize,
    /// Number of the repeat at the point, from 0.
    pub repeat: usize,
    /// Name of the recording's file.
    pub file: String,
    /// Place of the probe; `None` for the recording of the actuators, where the probe may be anywhere.
    pub at: Option<Point>,
}

/// Beginning of the names of a point's files: its number, from 1, among so many points.
pub fn stem(number: usize, points: usize) -> String {
    let digits = points.to_string().len().max(3);
    format!("point-{number:0digits$}")
}

/// Name of the file of a repeat, counted from 0.
pub fn file(stem: &str, repeat: usize) -> String {
    let last = if repeat == 0 { String::new() } else { format!("-{}", repeat + 1) };
    format!("{stem}{last}.wav")
}

/// Text on recordings that are missing, one line each with `what` is to be recorded; how many more there are, and where (`elsewhere`).
pub fn listed(missing: &[&Wanted], what: impl Fn(&Wanted) -> String, elsewhere: &str) -> String {
    let mut text: String =
        missing.iter().take(LISTED).map(|one| format!("  {:20} {}\n", one.file, what(one))).collect();
    if missing.len() > LISTED {
        text += &format!("  and {} more{elsewhere}\n", missing.len() - LISTED);
    }
    text + "then the same command again, now or after each\n"
}

/// Points of the recordings that a plan requests: the place of the probe at each, and the beginning of its
/// files' names.
#[derive(Clone, Debug, Default)]
pub struct PlannedPoints {
    points: Vec<(Point, String)>,
}

impl PlannedPoints {
    /// Reads the points of the requested recordings from a plan.
    pub fn of(plan: &Value) -> Self {
        let recordings = plan["recordings"].as_array().into_iter().flatten();
        let first = recordings.filter(|one| one["repeat"] == 1);
        let point = |one: &Value| {
            let at = one["probe_at_m"].as_array()?;
            let at = Point::new(at.first()?.as_f64()?, at.get(1)?.as_f64()?);
            Some((at, one["file"].as_str()?.strip_suffix(".wav")?.to_owned()))
        };
        Self { points: first.filter_map(point).collect() }
    }

    /// Points of this plan that `other` lacks, as one line of text each.
    pub fn lost(&self, other: &Self) -> Vec<String> {
        let has = |(at, stem): &&(Point, String)| {
            other.points.iter().any(|(there, name)| there.distance(*at) < SAME && name == stem)
        };
        let lost = self.points.iter().filter(|point| !has(point));
        lost.map(|(at, stem)| {
            format!(
                "  `recordings`: {stem}.wav at {at} in the folder, not requested (points may be added, not left out)"
            )
        })
        .collect()
    }

    /// All recordings of a calibration, in order; those of the actuators come first, if an input records
    /// the actuators. Points of this plan keep their files; files of new points get the next free numbers.
    pub fn wanted(&self, places: &Places, hears_itself: bool, repeats: usize) -> Vec<Wanted> {
        let own = (0..repeats).filter(|_| hears_itself).map(|repeat| Wanted {
            number: places.points.len(),
            repeat,
            file: file("actuators", repeat),
            at: None,
        });
        let mut known = self.points.clone();
        let mut next = self.points.len();
        let mut wanted: Vec<Wanted> = own.collect();
        for (number, at) in places.points.iter().enumerate().take(places.probed) {
            let there = known.iter().position(|(other, _)| other.distance(*at) < SAME);
            let stem = match there {
                Some(there) => known.swap_remove(there).1,
                None => {
                    next += 1;
                    stem(next, places.probed)
                }
            };
            wanted.extend((0..repeats).map(|repeat| Wanted {
                number,
                repeat,
                file: file(&stem, repeat),
                at: Some(*at),
            }));
        }
        wanted
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn places(all: &[(f64, f64)]) -> Places {
        let points = all.iter().map(|(x, y)| Point::from_mm(*x, *y)).collect();
        Places { points, probed: all.len() }
    }

    #[test]
    fn old_points_keep_their_files_and_new_ones_count_on() {
        let files = |wanted: &[Wanted]| wanted.iter().map(|one| one.file.clone()).collect::<Vec<_>>();
        let first = PlannedPoints::default().wanted(&places(&[(1.0, 2.0), (3.0, 4.0)]), true, 2);
        let names = ["actuators.wav", "actuators-2.wav", "point-001.wav", "point-001-2.wav", "point-002.wav"];
        assert_eq!(files(&first)[..5], names);
        let recordings: Vec<Value> = first
            .iter()
            .map(|one| json!({ "file": one.file, "probe_at_m": one.at.map(|at| [at.x, at.y]), "repeat": one.repeat + 1 }))
            .collect();
        let plan = PlannedPoints::of(&json!({ "recordings": recordings }));
        // A new point before, and one between.
        let more = plan.wanted(&places(&[(9.0, 9.0), (3.0, 4.0), (5.0, 5.0), (1.0, 2.0)]), false, 1);
        assert_eq!(files(&more), ["point-003.wav", "point-002.wav", "point-004.wav", "point-001.wav"]);
        assert!(plan.lost(&plan).is_empty());
        let lost = plan.lost(&PlannedPoints { points: plan.points[..1].to_vec() });
        assert!(lost.len() == 1 && lost[0].contains("point-002.wav at (3.0000, 4.0000) mm"), "{lost:?}");
    }
}
