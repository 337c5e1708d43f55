//! The quadratic forms of time reversal from sampled responses: of which actuators of a library to keep.

use crate::forms::{Case, held};
use crate::{Aim, Forms, PlacementError};
use rayon::prelude::*;
use unripple_core::{SampledResponses, require, window_samples};
use unripple_linalg::{Accum, Mat, Par, multiply};

/// Largest distance of a target from the nearest stored point, over the shortest wavelength: there a focus still has most of its height.
const NEAR: f64 = 0.25;

impl Forms {
    /// The forms of some actuators of sampled responses, given by their indices `ports`, for all targets. Each target is the stored point
    /// nearest to it.
    ///
    /// Time reversal from actuator a to the point x over a window leaves the velocity r_a(q) = Σ_t h_a(x, t) h_a(q, t) at the point q
    /// at the focal instant, with the responses h and the sum over the window, so that p_a = r_a(x), and Q_ab is the mean of r_a r_b over the
    /// stored points outside the focal disc.
    ///
    /// # Errors
    /// [`PlacementError::Range`] for a window (s) of no sample or longer than the responses, weights that are not positive, or an index
    /// beyond the actuators; [`PlacementError::Target`] for a target that no stored point is near or nothing moves, or with all stored points
    /// in its focal disc; [`PlacementError::TooLarge`].
    ///
    /// ```
    /// use unripple_core::{Conditions, Outline, Point, Port, SampledResponses, Shape};
    /// use unripple_placement::{Aim, Forms, Objective, Search};
    ///
    /// // The first actuator moves both points alike, the second one the second point less.
    /// let outline = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 });
    /// let conditions = Conditions { rate: 1000.0, band: [0.0, 100.0], lambda_min: 0.03, outline };
    /// let points = vec![Point::new(0.05, 0.05), Point::new(0.15, 0.05)];
    /// let port = |name: &str, x: f64| Port { name: name.into(), at: Point::new(x, 0.01) };
    /// let data = vec![1.0, 0.5, 1.0, 0.5, 1.0, 0.5, 0.1, 0.0];
    /// let ports = vec![port("a1", 0.02), port("a2", 0.18)];
    /// let at = [ports[0].at, ports[1].at];
    /// let library = SampledResponses::new(ports, points, conditions, 2, data)?;
    /// let aims = [Aim { at: Point::new(0.05, 0.05), weight: 1.0 }];
    /// let forms = Forms::sampled(&library, &[0, 1], &aims, 1e-3)?;
    /// let search = Search { forms: &forms, at: &at, kept: 0, apart: 0.0, objective: Objective::Mean };
    /// let best = search.best_of_all(1).map(|found| found.actuators);
    /// assert_eq!(best, Some(vec![1]));
    /// assert!((search.score(vec![1]) - 1.25 / 0.1).abs() < 1e-5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sampled(
        responses: &SampledResponses,
        ports: &[usize],
        aims: &[Aim],
        window: f64,
    ) -> Result<Self, PlacementError> {
        let samples = length(responses, window)?;
        let most = responses.ports.len();
        for port in ports {
            let expected = format!("below {most}, the number of actuators");
            require("index of an actuator", *port < most, expected, *port as f64)?;
        }
        for aim in aims {
            require("weight of a target", aim.weight > 0.0, "a positive number", aim.weight)?;
        }
        fit(responses.points.len(), ports.len(), aims.len(), samples)?;
        let at = aims.iter().map(|aim| stored(responses, aim)).collect::<Result<Vec<_>, _>>()?;
        let used = (0..responses.points.len())
            .flat_map(|point| ports.iter().map(move |port| &responses.response(*port, point)[..samples]));
        // Squares of squares of what is far from 1 are beyond single precision.
        let largest = used.flatten().fold(f32::MIN_POSITIVE, |most, h| most.max(h.abs()));
        let fields = ports.par_iter().map(|port| fields(responses, *port, &at, samples, 1.0 / largest));
        let fields: Vec<Mat<f32>> = fields.collect();
        let unit = f64::from(largest).powi(2);
        let cases = (0..at.len()).into_par_iter().map(|i| case(responses, &fields, (i, at[i]), unit));
        let cases = cases.collect::<Result<Vec<_>, _>>()?;
        let weights = aims.iter().map(|aim| aim.weight).collect();
        Ok(Self::of_cases(cases, weights, ports.len(), responses.conditions.rate))
    }
}

/// Number of samples of a window (s): at least two, and no more than the responses have.
fn length(responses: &SampledResponses, window: f64) -> Result<usize, PlacementError> {
    let rate = responses.conditions.rate;
    let longest = responses.samples().saturating_sub(1) as f64 / rate;
    let found = window_samples(window, rate);
    let legal = window > 0.0 && found > 0 && found < responses.samples();
    require(
        "window (s)",
        legal,
        format!("a positive number, up to the length of the responses, {longest}"),
        window,
    )?;
    Ok(found + 1)
}

/// Returns an error if the forms of so many actuators, stored points, targets and samples need more memory than is allowed.
fn fit(points: usize, actuators: usize, cases: usize, samples: usize) -> Result<(), PlacementError> {
    // The fields of all actuators for all targets; their products, and rows of these; the responses of one actuator for each thread.
    let fields = (actuators * points) as f64 * (cases + rayon::current_num_threads()) as f64;
    let products = 3.0 * cases as f64 * (actuators as f64).powi(2);
    let responses = (rayon::current_num_threads() * (points + cases)) as f64 * samples as f64;
    held(4.0 * (fields + products + responses), actuators, cases)
}

/// Index of the stored point that is used for a target: the nearest one.
fn stored(responses: &SampledResponses, aim: &Aim) -> Result<usize, PlacementError> {
    let reach = NEAR * responses.conditions.lambda_min;
    let near = |point: &usize| responses.points[*point].distance(aim.at) <= reach;
    let none = PlacementError::Target {
        at: aim.at,
        expected: "a point with responses at most a quarter of the shortest wavelength away",
    };
    responses.nearest(aim.at).filter(near).ok_or(none)
}

/// What time reversal from one actuator to each of the stored points `at` leaves at all stored points at the focal instant, points x
/// targets, from responses times `scale`.
fn fields(responses: &SampledResponses, port: usize, at: &[usize], samples: usize, scale: f32) -> Mat<f32> {
    let points = responses.points.len();
    let mut everywhere = Mat::<f32>::zeros(samples, points);
    for point in 0..points {
        let response = &responses.response(port, point)[..samples];
        let column = everywhere.col_as_slice_mut(point);
        column.iter_mut().zip(response).for_each(|(to, h)| *to = scale * h);
    }
    let aimed = Mat::from_fn(samples, at.len(), |t, i| everywhere[(t, at[i])]);
    let mut left = Mat::<f32>::zeros(points, at.len());
    multiply(left.as_mut(), Accum::Replace, everywhere.transpose(), aimed.as_ref(), 1.0, Par::Seq);
    left
}

/// The forms of the target that has this number among the columns of `fields`, and is this stored point.
fn case(
    responses: &SampledResponses,
    fields: &[Mat<f32>],
    (number, target): (usize, usize),
    unit: f64,
) -> Result<Case, PlacementError> {
    let (at, radius) = (responses.points[target], responses.conditions.focal_radius());
    let beyond = |point: &usize| responses.points[*point].distance(at) > radius;
    let outside: Vec<usize> = (0..responses.points.len()).filter(beyond).collect();
    if outside.is_empty() {
        return Err(PlacementError::Target { at, expected: "a point with responses outside its focal disc" });
    }
    let count = fields.len();
    let away = Mat::from_fn(outside.len(), count, |point, a| fields[a][(outside[point], number)]);
    let mut squares = Mat::<f32>::zeros(count, count);
    let share = 1.0 / outside.len() as f32;
    multiply(squares.as_mut(), Accum::Replace, away.transpose(), away.as_ref(), share, Par::Seq);
    let peaks = fields.iter().map(|field| field[(target, number)]).collect();
    Case::of_squares(peaks, squares, unit).moved(at)
}
