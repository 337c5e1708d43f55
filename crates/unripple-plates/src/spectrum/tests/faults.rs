//! What is not a pencil is refused.

use super::super::SpectrumError;
use super::*;

fn refused(stiffness: &Entries, mass: &Entries, top: f64) -> bool {
    let found = below(stiffness.matrix().as_ref(), mass.matrix().as_ref(), top, &Observed::default());
    matches!(found, Err(SpectrumError::Matrices { .. }))
}

#[test]
fn the_memory_grows_with_all_it_holds() {
    let bytes = |n, wanted| super::super::estimate_bytes(n, wanted);
    assert!(bytes(3000, 320) < 2e8 && bytes(3000, 320) > 3e7);
    assert!(bytes(6000, 320) > bytes(3000, 320) && bytes(6000, 640) > bytes(6000, 320));
}

#[test]
fn matrices_that_make_no_pencil_are_refused() {
    for n in [40, 500] {
        let stiffness = Entries::second_difference(n, false);
        let mass = Entries::identity(n);
        assert!(!refused(&stiffness, &mass, 0.5));
        assert!(refused(&stiffness, &Entries::identity(n + 1), 0.5));
        assert!(refused(&stiffness, &mass.clone().scaled(-1.0), 0.5));
        assert!(refused(&stiffness, &mass.clone().scaled(0.0), 0.5));
        assert!(refused(&stiffness.clone().scaled(f64::NAN), &mass, 0.5));
        assert!(refused(&stiffness, &mass, f64::INFINITY));
        let indefinite = mass.plus(Entries { n, list: vec![(0, 1, 3.0), (1, 0, 3.0)] });
        assert!(
            below(stiffness.matrix().as_ref(), indefinite.matrix().as_ref(), 0.5, &Observed::default())
                .is_err()
        );
    }
}
