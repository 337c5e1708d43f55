//! Truth: the error that is stated is at least the true one, and not far above it, or the modes are refused.

use crate::truth_common::cases::{self, Case};
use crate::truth_common::more;
use rayon::prelude::*;
use unripple_plates::{Modes, PhysicsError};

/// What was stated over what is true, at one accuracy.
struct Held {
    stated: f64,
    exact: f64,
}

/// The accuracies asked for.
const ACCURACIES: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

/// True errors below this multiple of the error of the reference are not told from it.
const TOLD: f64 = 10.0;

/// Solves a case; `None` where the accuracy is refused.
fn held(case: &Case, accuracy: f64) -> Option<Held> {
    match Modes::solve(&case.surface, case.top_hz, accuracy) {
        Ok(modes) => {
            let stated = modes.error();
            assert!(stated <= accuracy, "{}: {stated:e} stated, {accuracy:e} asked for", case.name);
            Some(Held { stated, exact: case.error(&modes.frequencies_hz()) })
        }
        Err(PhysicsError::NotConverged { expected, found, .. }) => {
            assert!(expected == accuracy && found > accuracy, "{}: {found:e} refused", case.name);
            None
        }
        Err(other) => panic!("{}: {other}", case.name),
    }
}

/// Solves all cases at all accuracies, prints a table, and fails where a stated error is below the true one or an accuracy is refused.
/// Gives the ratios of stated and true errors, ascending.
fn ratios(cases: &[Case]) -> Vec<f64> {
    let of = |case: &Case| {
        let asked = ACCURACIES.iter().filter(|accuracy| **accuracy >= case.finest);
        asked.map(|accuracy| held(case, *accuracy)).collect()
    };
    let rows: Vec<Vec<Option<Held>>> = cases.par_iter().map(of).collect();
    let (mut ratios, mut faults, mut refused) = (Vec::new(), Vec::new(), Vec::new());
    println!(
        "| sheet | known | asked 1e-2 | 1e-3 | 1e-4 | 1e-5 | 1e-6 |\n|---|---:|---:|---:|---:|---:|---:|"
    );
    for (case, held) in cases.iter().zip(&rows) {
        let name = &case.name;
        let cell = |i: usize| match held.get(i) {
            Some(Some(held)) => format!(" {:.1e} / {:.1e} |", held.exact, held.stated),
            Some(None) => " refused |".to_owned(),
            None => "  |".to_owned(),
        };
        println!("| {name} | {} |{}", case.known.len(), (0..ACCURACIES.len()).map(cell).collect::<String>());
        if held.iter().any(Option::is_none) {
            refused.push(name);
        }
        for held in held.iter().flatten() {
            if held.exact > TOLD * case.told {
                ratios.push(held.stated / held.exact);
            }
            if held.exact > held.stated + case.told {
                faults.push(format!("{name}: {:e} stated, {:e} true", held.stated, held.exact));
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    let (count, at) = (ratios.len(), |share: f64| ratios[(share * (ratios.len() - 1) as f64) as usize]);
    println!(
        "stated over true: least {:.2}, median {:.1}, nine tenths up to {:.0}, largest {:.0}, of {count}",
        at(0.0),
        at(0.5),
        at(0.9),
        at(1.0)
    );
    assert!(faults.is_empty(), "{faults:#?}");
    assert!(refused.is_empty(), "{refused:?}");
    ratios
}

#[test]
fn the_stated_error_is_a_bound() {
    let ratios = ratios(&cases::all());
    assert!(ratios[ratios.len() / 2] < 30.0);
    assert!(ratios.len() > 90, "{}", ratios.len());
}

/// The long run: `UNRIPPLE_ALL_SHEETS=1` for all of them.
#[test]
fn the_stated_error_is_a_bound_on_more_sheets() {
    let all = std::env::var_os("UNRIPPLE_ALL_SHEETS").is_some();
    let ratios = ratios(&if all { more::all() } else { more::some() });
    assert!(ratios[ratios.len() / 2] < 30.0);
    assert!(ratios.len() > if all { 150 } else { 10 }, "{}", ratios.len());
}
