//! Where actuators should be, so that time reversal has the most contrast, and sensors, so that a calibration tells most.
//!
//! The contrast of time reversal from a set of actuators is a ratio of two sums over the set, one over its members and one over pairs of
//! them. Both are computed once for all places where an actuator may be; after that a layout costs a few operations per target. The best
//! layout is found by greedy choice, exchange of one actuator at a time, and restarts. No bound is known that would prove it the best,
//! but where there are few layouts, all of them are compared.
//!
//! # In reading order
//!
//! A [`Plant`] is a surface with the actuators that it keeps, and the kind of actuator that is placed on it. [`Rules`] say where
//! actuators may be, [`spread`] makes targets. [`Forms`] are the two sums, a [`Search`] finds layouts ([`Found`]), and [`Polish`] moves
//! their actuators off the grid. [`reached`] gives the contrast of a layout at each target, and an [`Objective`] condenses these
//! contrasts to one number. [`Search::refined`] goes on by any score that has to be evaluated layout by layout.
//!
//! [`Forms::sampled`] are the same sums for responses that were measured: then the search chooses among the actuators of a library, and
//! [`reached_from`] gives the contrast of a choice at each target.
//!
//! For calibration, [`Informations`] are what measurements at many places tell of some unknowns. [`Approximate`] is the best possible share
//! of measurements at each place, with a certificate; a [`Picking`] finds single places ([`Picked`]), whose efficiency it bounds.
//!
//! ```
//! use unripple_physics::design::papers_surface;
//! use unripple_placement::{Aim, Forms, Objective, Plant, Rules, Search, spread};
//!
//! // Four forces, 6 to 12 mm from the rim of the paper's film, in a third of its band.
//! let mut film = papers_surface();
//! film.emission.band = [0.0, 1000.0];
//! let kind = film.actuators[0].clone();
//! film.actuators.clear();
//! let outline = film.outline.clone();
//! let plants = [Plant::new(film, &kind)?];
//! let rules = Rules { from_rim: [6e-3, 12e-3], ..Rules::default() };
//! let places = rules.grid(&outline, 4e-3)?;
//! let middle = Rules { from_rim: [30e-3, f64::INFINITY], ..Rules::default() };
//! let aims: Vec<Aim> = spread(&outline, &middle, 0, 10).into_iter().map(|at| Aim { at, weight: 1.0 }).collect();
//! let forms = Forms::new(&plants, &places, &aims, 30e-3, 0.0)?;
//! let search = Search { forms: &forms, at: &places, kept: 0, apart: 0.0, objective: Objective::Mean };
//! let best = search.restarts(4, 3, 1)?.into_iter().map(|found| found.score).fold(0.0, f64::max);
//! let random = search.random(4, 20, 1)?.into_iter().map(|layout| search.score(layout)).sum::<f64>() / 20.0;
//! assert!(best > 1.2 * random, "{best} {random}");
//! # Ok::<(), unripple_placement::PlacementError>(())
//! ```

mod apart;
mod approximate;
mod area;
mod basis;
mod chosen;
mod error;
mod exhaustive;
mod forms;
mod informations;
mod layout;
mod mounting;
mod newton;
mod objective;
mod picking;
mod plant;
mod polish;
mod refine;
mod rules;
mod sampled;
mod search;
mod spread;

pub use approximate::Approximate;
pub use area::encloses;
pub use chosen::Chosen;
pub use error::PlacementError;
pub use forms::{Aim, Forms};
pub use informations::Informations;
pub use layout::{Reached, figure, reached, reached_each, reached_from};
pub use objective::Objective;
pub use picking::{Picked, Picking};
pub use plant::Plant;
pub use polish::Polish;
pub use refine::{Refined, Refining};
pub use rules::Rules;
pub use search::{Found, Search};
pub use spread::spread;
