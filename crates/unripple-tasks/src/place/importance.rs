//! How much targets count by where they are: a table of weights at points, and areas with weights.

use super::Ask;
use crate::TaskError;
use crate::areas::polygons;
use unripple::core::{Outline, Point};
use unripple_placement::{Aim, Rules, encloses, spread};
use unripple_store::read_weights;

/// Points that are tried for each target where many have no weight: as many times the number, and then as many times more.
const TIMES: [usize; 4] = [1, 4, 16, 64];

/// How much a target counts at each place of a surface.
pub(super) struct Importance {
    /// Points with their weights, of which the nearest one counts; none where all places weigh the same.
    points: Vec<(Point, f64)>,
    /// Areas, as their corners in m, with the factors on the weights inside them.
    areas: Vec<(Vec<Point>, f64)>,
}

impl Importance {
    /// What a request says of it, after a check of its values.
    ///
    /// # Errors
    /// [`TaskError::Ask`] of weights that are no numbers from 0, and beside targets that are named; those of reading the table.
    pub fn of(ask: &Ask) -> Result<Self, TaskError> {
        let given = ask.importance.is_some() || !ask.important.is_empty();
        if given && !ask.points_m.is_empty() {
            let expected =
                "targets that are spread over the surface: those that are named have weights of their own";
            return Err(TaskError::ask("importance, important", expected, "targets that are named"));
        }
        if let Some(area) = ask.important.iter().find(|area| !(area.weight.is_finite() && area.weight >= 0.0))
        {
            return Err(TaskError::ask("important", "weights from 0", area.weight));
        }
        let areas: Vec<Vec<_>> = ask.important.iter().map(|area| area.area_m.clone()).collect();
        let areas = polygons("important", &areas)?;
        let weights = ask.important.iter().map(|area| area.weight);
        let points = ask.importance.as_ref().map(read_weights).transpose()?.unwrap_or_default();
        Ok(Self { points, areas: areas.into_iter().zip(weights).collect() })
    }

    /// The weight of a target: that of the nearest point of the table, times those of all areas that it is in.
    pub fn at(&self, place: Point) -> f64 {
        let apart = |point: &&(Point, f64)| point.0.distance(place);
        let nearest = self.points.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        let inside = self.areas.iter().filter(|(area, _)| encloses(area, place));
        nearest.map_or(1.0, |(_, weight)| *weight) * inside.map(|(_, weight)| weight).product::<f64>()
    }

    /// A target with its weight; `None` where it has none.
    pub fn aim(&self, at: Point) -> Option<Aim> {
        let weight = self.at(at);
        (weight > 0.0).then_some(Aim { at, weight })
    }

    /// Targets spread over the places that `rules` allow on a sheet, with their weights, without those that have none: `count` of them, or
    /// fewer where hardly any place is left.
    pub fn spread(&self, outline: &Outline, rules: &Rules, count: usize) -> Vec<Aim> {
        let mut aims = Vec::new();
        for times in TIMES {
            let places = spread(outline, rules, 0, times * count);
            aims = places.iter().filter_map(|at| self.aim(*at)).take(count).collect();
            if aims.len() == count || places.len() < times * count {
                break;
            }
        }
        aims
    }
}

#[cfg(test)]
mod tests {
    use super::super::ask::ImportantAsk;
    use super::*;
    use unripple::core::Shape;

    /// The left half of a sheet of 200 mm x 100 mm.
    fn left(weight: f64) -> ImportantAsk {
        ImportantAsk { area_m: vec![[0.0, 0.0], [0.1, 0.0], [0.1, 0.1], [0.0, 0.1]], weight }
    }

    fn importance(important: Vec<ImportantAsk>) -> Importance {
        Importance::of(&Ask { important, ..Ask::default() }).unwrap()
    }

    #[test]
    fn the_nearest_point_counts_and_areas_multiply() {
        let points = vec![(Point::new(0.05, 0.05), 4.0), (Point::new(0.15, 0.05), 0.5)];
        let found = Importance { points, ..importance(vec![left(3.0)]) };
        for (x, weight) in [(0.03, 12.0), (0.099, 12.0), (0.101, 0.5), (0.19, 0.5)] {
            assert_eq!(found.at(Point::new(x, 0.02)), weight, "{x}");
        }
        assert_eq!(importance(Vec::new()).at(Point::new(0.03, 0.02)), 1.0);
    }

    #[test]
    fn targets_without_weight_are_left_out_and_others_take_their_place() {
        let sheet = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 });
        let aims = importance(vec![left(0.0)]).spread(&sheet, &Rules::default(), 40);
        assert_eq!(aims.len(), 40);
        assert!(aims.iter().all(|aim| aim.at.x >= 0.1 && aim.weight == 1.0), "{aims:?}");
        let whole = importance(vec![left(2.0)]).spread(&sheet, &Rules::default(), 40);
        let plain = spread(&sheet, &Rules::default(), 0, 40);
        assert!(whole.iter().map(|aim| aim.at).eq(plain), "{whole:?}");
        assert!(whole.iter().all(|aim| aim.weight == if aim.at.x < 0.1 { 2.0 } else { 1.0 }), "{whole:?}");
        let nowhere =
            Rules { keep_out: vec![left(0.0).area_m.iter().map(crate::point).collect()], ..Rules::default() };
        assert!(
            importance(vec![ImportantAsk { weight: 0.0, ..right() }]).spread(&sheet, &nowhere, 4).is_empty()
        );
    }

    fn right() -> ImportantAsk {
        let area_m = vec![[0.1, -0.1], [0.3, -0.1], [0.3, 0.2], [0.1, 0.2]];
        ImportantAsk { area_m, weight: 1.0 }
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        let error = |ask: Ask| Importance::of(&ask).err().map(|error| error.to_string()).unwrap_or_default();
        let negative = error(Ask { important: vec![left(-1.0)], ..Ask::default() });
        assert_eq!(negative, "important: expected weights from 0, found -1");
        let named = error(Ask { important: vec![left(1.0)], points_m: vec![[0.1, 0.1]], ..Ask::default() });
        assert!(named.starts_with("importance, important: expected targets that are spread"), "{named}");
        assert!(named.ends_with("found targets that are named"), "{named}");
        let line = ImportantAsk { area_m: vec![[0.0, 0.0], [0.1, 0.0]], weight: 1.0 };
        assert!(error(Ask { important: vec![line], ..Ask::default() }).contains("at least 3 corners"));
        assert!(
            error(Ask { importance: Some("no-such-map.csv".into()), ..Ask::default() })
                .contains("no-such-map.csv")
        );
    }
}
