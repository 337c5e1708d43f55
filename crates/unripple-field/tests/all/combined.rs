//! Shapes that are combinations of others: read through their base, the field is the same.

use crate::common::reversed;
use crate::small::small;
use std::sync::Arc;
use unripple_core::{Mixture, ModalResponses, Point, Pole, Random, Responses, Shapes};
use unripple_field::{Aim, Field, MeasureOptions, measure};
use unripple_linalg::{Mat, product};

/// Combinations that tell what they are of, or do not.
#[derive(Debug)]
struct Combined {
    base: Arc<dyn Shapes>,
    mixing: Mat<f64>,
    columns: Vec<usize>,
    told: bool,
}

impl Shapes for Combined {
    fn modes(&self) -> usize {
        self.columns.len()
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        let mut base = vec![0.0; self.base.modes()];
        self.base.at(point, &mut base);
        let base = Mat::from_fn(1, base.len(), |_, m| base[m]);
        let all = product(base.as_ref(), self.mixing.as_ref());
        row.iter_mut().zip(&self.columns).for_each(|(to, column)| *to = all[(0, *column)]);
    }

    fn mixture(&self) -> Option<Mixture<'_>> {
        let mixture =
            Mixture { base: self.base.as_ref(), mixing: self.mixing.as_ref(), columns: &self.columns };
        self.told.then_some(mixture)
    }
}

/// Two oscillations for each combination of the film's modes, as under loads.
fn combined(told: bool) -> ModalResponses {
    let film = small().modal();
    let count = film.poles.len();
    let mut random = Random::seeded(11);
    let mixing = Mat::from_fn(count, count, |i, j| f64::from(u8::from(i == j)) + 0.2 * random.normal() / 9.0);
    let columns: Vec<usize> = (0..2 * count).map(|m| m / 2).collect();
    let poles: Vec<Pole> = (0..2 * count)
        .map(|m| film.poles[m / 2])
        .enumerate()
        .map(|(m, pole)| if m % 2 == 0 { pole } else { Pole::moved(pole.omega, pole.sigma) })
        .collect();
    let input = Mat::from_fn(film.ports.len(), poles.len(), |a, m| {
        film.input[(a, m / 2)] * if m % 2 == 0 { 1.0 } else { 0.1 * random.normal() }
    });
    let shapes = Arc::new(Combined { base: film.shapes.clone(), mixing, columns, told });
    ModalResponses { poles, input, shapes, ..film }
}

#[test]
fn combinations_are_read_through_their_base() {
    let at = Point::new(0.062, 0.037);
    let (open, closed) = (combined(true), combined(false));
    let sent = reversed(&closed, at, 240);
    let aim = Aim::at(at, 240.0 / closed.conditions.rate);
    let [open, closed] = [open, closed].map(Responses::Modal);
    let instants = [0.01, 0.02, 0.021];
    let [one, other] = [&open, &closed].map(|responses| {
        let field = Field::new(responses, &sent, 8.0).unwrap();
        field.snapshots(&instants).unwrap()
    });
    for (one, other) in one.iter().zip(&other) {
        for (a, b) in [(&one.velocity, &other.velocity), (&one.displacement, &other.displacement)] {
            let most = b.iter().fold(0.0_f32, |most, v| most.max(v.abs()));
            assert!(most > 0.0 && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5 * most));
        }
    }
    let options = MeasureOptions::default();
    let [one, other] =
        [&open, &closed].map(|r| measure(r, &sent, std::slice::from_ref(&aim), &options).unwrap());
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-4, "{a} {b}");
    let (a, b) = (&one.targets[0], &other.targets[0]);
    near(a.contrast.unwrap(), b.contrast.unwrap());
    near(a.background_contrast.unwrap(), b.background_contrast.unwrap());
    near(a.worst_spot.unwrap(), b.worst_spot.unwrap());
    near(one.felt_outside_db.unwrap(), other.felt_outside_db.unwrap());
    near(a.spot_diameter_m.unwrap(), b.spot_diameter_m.unwrap());
    let contact: Vec<(Point, f64)> =
        [(0.05, 0.5), (0.06, 0.3), (0.07, 0.2)].map(|(x, weight)| (Point::new(x, 0.04), weight)).into();
    let [one, other] = [&open, &closed].map(|responses| {
        let field = Field::new(responses, &sent, 8.0).unwrap();
        let under = field.under(&[&contact, &contact[..1]]).unwrap();
        let trace = field.traces(&[at], 0.02).unwrap().remove(0);
        [under, vec![trace.velocity, trace.displacement]].concat()
    });
    for (one, other) in one.iter().zip(&other) {
        let most = other.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        assert!(most > 0.0 && one.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-11 * most));
    }
}
