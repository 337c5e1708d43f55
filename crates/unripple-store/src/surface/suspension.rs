//! Housings of exciters in a surface file, and the springs that they hang on.

use super::range::of;
use super::reader::{Faults, Section};
use std::f64::consts::TAU;

/// All keys of a housing.
pub(super) const SUSPENSION_KEYS: [&str; 4] = ["housing_g", RESONANCE, SPRING, "quality_factor"];

// The two keys of which a housing has exactly one.
const RESONANCE: &str = "resonance_hz";
const SPRING: &str = "spring_n_per_mm";

/// A housing on its spring.
pub(super) struct Suspension {
    /// Mass of the housing, in kg.
    pub housing_mass: f64,
    /// Natural frequency of the housing on its spring, in Hz.
    pub resonance: f64,
    /// Quality factor of that resonance.
    pub quality_factor: f64,
}

/// Reads the housing of an exciter, with all its keys.
pub(super) fn read(section: &Section, faults: &mut Faults) -> Option<Suspension> {
    let [housing, .., quality] = SUSPENSION_KEYS;
    let housing_mass = section.number(housing, &of::HOUSING_MASS, faults);
    let resonance = resonance(section, housing_mass, faults);
    let quality_factor = section.number(quality, &of::QUALITY_FACTOR, faults);
    Some(Suspension { housing_mass: housing_mass?, resonance: resonance?, quality_factor: quality_factor? })
}

/// The natural frequency that a table gives, by itself or as a spring.
fn resonance(section: &Section, housing_mass: Option<f64>, faults: &mut Faults) -> Option<f64> {
    // A table that gives one of them needs nothing of the other, whichever the defaults give.
    let own = |key: &str, other: &str| section.gives(key) && !section.gives(other);
    let Some(spring) = section.get(SPRING).filter(|_| !own(RESONANCE, SPRING)) else {
        let expected = format!("{}, or {SPRING} instead", of::RESONANCE.expected());
        return section.require(RESONANCE, &expected, faults)?.number(&of::RESONANCE, faults);
    };
    let stiffness = spring.number(&of::SPRING, faults);
    if section.get(RESONANCE).is_some() && !own(SPRING, RESONANCE) {
        let found = format!("{RESONANCE} and {SPRING}");
        faults.add(&spring.key, spring.span, found, "one of them", None);
        return None;
    }
    let found = (stiffness? / housing_mass?).sqrt() / TAU;
    if !of::RESONANCE.allow(found) {
        let expected = format!("a spring on which the housing resonates at {}", of::RESONANCE.expected());
        faults.add(
            &spring.key,
            spring.span,
            format!("one on which it does at {found:.3} Hz"),
            expected,
            None,
        );
        return None;
    }
    Some(found)
}
