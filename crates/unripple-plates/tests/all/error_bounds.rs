//! Truth: the error that is stated is at least the true one, and not far above it, or the modes are refused.

use crate::truth_common::cases::{Case, all};
use rayon::prelude::*;
use unripple_plates::{Modes, PhysicsError};

/// What was stated over what is true, at one accuracy.
struct Held {
    stated: f64,
    exact: f64,
}

/// The accuracies asked for.
const ACCURACIES: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

/// Below this relative error, references and rounding limit what can be told.
const TOLD: f64 = 1e-8;

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

#[test]
fn the_stated_error_is_a_bound() {
    let rows: Vec<(String, Vec<Option<Held>>)> = all()
        .par_iter()
        .map(|case| {
            let asked = ACCURACIES.iter().filter(|accuracy| **accuracy >= case.finest);
            let held = asked.map(|accuracy| held(case, *accuracy)).collect();
            (format!("{} ({} known)", case.name, case.known.len()), held)
        })
        .collect();
    let mut ratios = Vec::new();
    let mut faults = Vec::new();
    println!("| sheet | asked 1e-2 | 1e-3 | 1e-4 | 1e-5 | 1e-6 |\n|---|---|---|---|---|---|");
    for (name, held) in &rows {
        let cells = held.iter().map(|held| match held {
            Some(held) => format!(" {:.1e}, {:.1e} |", held.exact, held.stated),
            None => " refused |".to_owned(),
        });
        println!("| {name} |{}", cells.collect::<String>());
        for held in held.iter().flatten() {
            if held.exact > TOLD {
                ratios.push(held.stated / held.exact);
            }
            if held.exact > held.stated {
                faults.push(format!("{name}: {:e} stated, {:e} true", held.stated, held.exact));
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    println!(
        "stated over true: least {:.2}, median {median:.1}, largest {:.0}, of {}",
        ratios[0],
        ratios[ratios.len() - 1],
        ratios.len()
    );
    assert!(faults.is_empty(), "{faults:#?}");
    assert!(median < 30.0, "{median}");
    let refused = rows.iter().filter(|(_, held)| held.iter().any(Option::is_none));
    assert!(refused.clone().count() == 0, "{:?}", refused.map(|(name, _)| name).collect::<Vec<_>>());
    assert!(ratios.len() > 90, "{}", ratios.len());
}
