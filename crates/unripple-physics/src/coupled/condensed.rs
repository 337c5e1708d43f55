//! Complex modes of a sheet with many light loads, such as a lattice of resonators: the undamped modes far above the band are condensed.
//!
//! In the undamped modes masses and springs are solved for exactly, and only dampers couple modes: s² z + sC z + Λz = 0. Of a mode h far
//! above the band, z_h = -s C_hl z_l / (ω_h² + s² + sC_hh) is small, of second order where it acts back. So what is left are the modes l
//! below, with the mass I - E, E_lm = Σ_h C_lh C_hm / (ω_h² - ω_l ω_m), of which the diagonal is exact to the order of damping (static
//! condensation with its inertia: Craig and Kurdila, *Fundamentals of Structural Dynamics*, 2006, chapter 17). Shapes have their parts
//! z_h, and by symmetry what drives excite has them as well.

use super::conservative::Conservative;
use super::state::{Drives, Root, State};
use crate::Load;
use unripple_linalg::{Mat, MatRef, c64, exact_symmetric, product};

/// Modes up to this multiple of the top of the band are kept one by one. With twice this value, they may be up to four times as many, and
/// the error a fourth.
const KEPT: f64 = 1.5;

/// Least number of modes for which this pays: the eigenvalues of smaller state matrices take less than a second.
const WORTHWHILE: usize = 200;

/// Largest share of the modes that are kept: with more, little is saved.
const MOST: f64 = 0.8;

/// Number of terms of the series of 1/(ω_h² - ω_l ω_m) in ω_l ω_m/ω_h², which is at most 1/KEPT² in the band. Each further one makes what is
/// left out 0.4 times as large or less.
const TERMS: usize = 4;

/// Largest relative mass E of a mode that modes above add through dampers. What is left out of frequencies is smaller than this by the ratio
/// of damping to frequency. Larger, errors of frequencies could exceed a millionth.
const ADDED: f64 = 1e-4;

/// The exponentials of the coupled system in a band up to `top` (rad/s), and some above; `None` where this does not pay, or is not accurate.
pub(super) fn roots(modes: &Conservative, loads: &[Load], drives: &Drives, top: f64) -> Option<Vec<Root>> {
    let count = modes.omegas.len();
    let low = modes.omegas.partition_point(|omega| *omega <= KEPT * top);
    let inductive = loads.iter().any(|load| load.inductive_coil().is_some());
    let strong = (low..count).any(|h| modes.damping[(h, h)] >= modes.omegas[h]);
    if count < WORTHWHILE || low == 0 || low as f64 > MOST * count as f64 || inductive || strong {
        return None;
    }
    let coupling = modes.damping.submatrix(low, 0, count - low, low);
    let added = added_mass(modes, coupling);
    if !(0..low).all(|l| added[(l, l)] <= ADDED) {
        return None;
    }
    let (reduced, basis) = reduced(modes, loads, &added)?;
    // Unit forces, since high modes are excited through the same left eigenvectors.
    let unit = Drives { forces: Mat::identity(low, low), coils: vec![None; low] };
    let found = State::of(&reduced, loads, &unit).roots(top).ok()?;
    let shapes = whole(modes, coupling, &basis, &found, |root| &root.shape);
    let left = whole(modes, coupling, &basis, &found, |root| &root.input);
    let inputs = left.each_ref().map(|part| product(drives.forces.as_ref(), part.as_ref()));
    let root = |(k, root): (usize, &Root)| {
        let column = |[real, imaginary]: &[Mat<f64>; 2]| -> Vec<c64> {
            (0..real.nrows()).map(|i| c64::new(real[(i, k)], imaginary[(i, k)])).collect()
        };
        Root { s: root.s, shape: column(&shapes), input: column(&inputs) }
    };
    Some(found.iter().enumerate().map(root).collect())
}

/// The mass E that the modes above add to the modes below, from the damping that couples them, high x low.
fn added_mass(modes: &Conservative, coupling: MatRef<'_, f64>) -> Mat<f64> {
    let (high, low) = (coupling.nrows(), coupling.ncols());
    let term = |row: usize, l: usize| {
        let (power, h) = (row / high, row % high);
        let above = modes.omegas[low + h];
        coupling[(h, l)] / above * (modes.omegas[l] / above).powi(power as i32)
    };
    let terms = Mat::from_fn(TERMS * high, low, term);
    product(terms.transpose(), terms.as_ref())
}

/// The modes of stiffness Λ and mass I - E, with their damping, and these modes in the coordinates of the undamped ones.
fn reduced(modes: &Conservative, loads: &[Load], added: &Mat<f64>) -> Option<(Conservative, Mat<f64>)> {
    let low = added.nrows();
    // (I - E)^{-1/2} to the second order of E, which is small.
    let square = product(added.as_ref(), added.as_ref());
    let light = Mat::from_fn(low, low, |i, j| {
        let own = if i == j { 1.0 } else { 0.0 };
        own + 0.5 * added[(i, j)] + 0.375 * square[(i, j)]
    });
    let stiff = Mat::from_fn(low, low, |i, j| modes.omegas[i] * light[(i, j)]);
    let (squares, vectors) = exact_symmetric(product(stiff.transpose(), stiff.as_ref()).as_ref())?;
    let basis = product(light.as_ref(), vectors.as_ref());
    let half = product(basis.transpose(), modes.damping.submatrix(0, 0, low, low));
    let at_loads = modes.at_loads.submatrix(0, 0, loads.len(), low);
    let least = modes.omegas[0];
    let reduced = Conservative {
        omegas: squares.iter().map(|square| square.max(0.0).sqrt().max(0.5 * least)).collect(),
        at_loads: product(at_loads, basis.as_ref()),
        damping: product(half.as_ref(), basis.as_ref()),
        shapes: basis.clone(),
    };
    Some((reduced, basis))
}

/// Real and imaginary parts of vectors over all modes, modes x roots, from `part` of each root over the reduced ones.
fn whole(
    modes: &Conservative,
    coupling: MatRef<'_, f64>,
    basis: &Mat<f64>,
    found: &[Root],
    part: impl Fn(&Root) -> &Vec<c64>,
) -> [Mat<f64>; 2] {
    let low = basis.nrows();
    let of = |take: fn(&c64) -> f64| {
        let reduced = Mat::from_fn(basis.ncols(), found.len(), |i, k| take(&part(&found[k])[i]));
        product(basis.as_ref(), reduced.as_ref())
    };
    let below = [of(|x| x.re), of(|x| x.im)];
    let moved = below.each_ref().map(|part| product(coupling, part.as_ref()));
    let above = |h: usize, k: usize| {
        let (s, mode) = (found[k].s, low + h);
        let omega = modes.omegas[mode];
        let stiff = s * (s + modes.damping[(mode, mode)]) + omega * omega;
        -s * c64::new(moved[0][(h, k)], moved[1][(h, k)]) / stiff
    };
    let value = |i: usize, k: usize| {
        if i < low { c64::new(below[0][(i, k)], below[1][(i, k)]) } else { above(i - low, k) }
    };
    let take = |take: fn(c64) -> f64| Mat::from_fn(modes.omegas.len(), found.len(), |i, k| take(value(i, k)));
    [take(|x| x.re), take(|x| x.im)]
}

#[cfg(test)]
mod tests {
    use super::super::active::Active;
    use super::super::basis::split;
    use super::*;
    use crate::Footprint;
    use std::f64::consts::TAU;
    use unripple_core::{Point, Pole, Random};

    /// Top of the band, in rad/s.
    const TOP: f64 = TAU * 400.0;

    /// A sheet of 180 modes up to 3.7 kHz with 60 resonators of 20 g near 250 Hz, and two drives.
    fn lattice(quality: f64) -> (Conservative, Vec<Load>, Drives) {
        let mut random = Random::seeded(5);
        let (modes, count) = (180, 60);
        let mut poles: Vec<Pole> = (0..modes)
            .map(|m| {
                let omega = TAU * (60.0 + 20.0 * m as f64 + 5.0 * random.uniform());
                Pole::new(omega, 0.005 * omega)
            })
            .collect();
        poles.extend((0..count).map(|_| Pole::new(0.0, 0.0)));
        let mass = 0.02_f64;
        let mut at_loads = Mat::zeros(count, modes + count);
        let mut loads = Vec::new();
        for load in 0..count {
            (0..modes).for_each(|m| at_loads[(load, m)] = random.between(-1.0, 1.0));
            at_loads[(load, modes + load)] = -1.0 / mass.sqrt();
            let omega = TAU * 250.0 * (1.0 + 0.02 * random.between(-1.0, 1.0));
            loads.push(Load {
                footprint: Footprint::point(Point::new(0.0, 0.0)),
                mass: 0.0,
                damping: mass * omega / quality,
                stiffness: mass * omega * omega,
                circuit: None,
                housing: None,
            });
        }
        let (shaped, _) = split(&poles, at_loads.as_ref());
        let active = Active::of(&shaped, at_loads.as_ref(), 1.1 * TOP);
        let coupled = Conservative::of(&active, &loads, 400.0).unwrap();
        let forces = Mat::from_fn(2, coupled.omegas.len(), |_, _| random.between(-1.0, 1.0));
        (coupled, loads, Drives { forces, coils: vec![None; 2] })
    }

    #[test]
    fn the_same_as_the_eigenvalues_of_the_whole_state_within_a_millionth() {
        let (modes, loads, drives) = lattice(30.0);
        let mut found = roots(&modes, &loads, &drives, TOP).unwrap();
        let mut known = State::of(&modes, &loads, &drives).roots(400.0).unwrap();
        for list in [&mut found, &mut known] {
            list.retain(|root| root.s.norm() <= TOP);
            list.sort_by(|a, b| a.s.im.total_cmp(&b.s.im));
        }
        assert_eq!(found.len(), known.len());
        assert!(known.len() > 70, "{}", known.len());
        for (a, b) in found.iter().zip(&known) {
            assert!((a.s - b.s).norm() < 1e-6 * b.s.norm(), "{} {}", a.s, b.s);
        }
        // What the drives cause, in all modes, those above the band too: roots that are near each other may be mixed.
        let caused = |roots: &[Root], i: usize, drive: usize, time: f64| -> f64 {
            roots
                .iter()
                .map(|root| 2.0 * (root.shape[i] * root.input[drive] * (root.s * time).exp()).re)
                .sum()
        };
        // Modes above the band hardly move, and of what they move a share as large as kd/Q is left out, with d their compliance at a load.
        for (i, least) in [(0, 1e-6), (40, 1e-4), (75, 1e-3), (100, 1e-2), (200, 1e-2)] {
            let times = || (0..50).map(|t| 2e-4 * f64::from(t));
            for drive in [0, 1] {
                let most = times().map(|t| caused(&known, i, drive, t).abs()).fold(0.0, f64::max);
                for time in times() {
                    let (a, b) = (caused(&found, i, drive, time), caused(&known, i, drive, time));
                    assert!((a - b).abs() < least * most, "{i} {drive} {time}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn left_to_others_where_dampers_are_strong_or_most_modes_are_in_the_band() {
        let (modes, loads, drives) = lattice(0.5);
        assert!(roots(&modes, &loads, &drives, TOP).is_none());
        let (modes, loads, drives) = lattice(30.0);
        assert!(roots(&modes, &loads, &drives, 10.0 * TOP).is_none());
    }
}
