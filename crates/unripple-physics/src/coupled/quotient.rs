//! Complex modes of a sheet whose loads are few, by Rayleigh quotient iteration from the undamped modes.
//!
//! With displacements q = e^{st} the coupled system is T(s) q = 0 ([`System`]), of which T(s)⁻¹ costs little. Its matrices are symmetric,
//! so that the scalar equation qᵀT(s)q = 0 has errors of second order and the iteration converges cubically (Parlett, *Math. Comp.*
//! 28, 679, 1974; Lancaster, *Lambda-Matrices and Vibrating Systems*, 1966). What does not oscillate, and what the iteration misses, is found
//! in the complement of the others.

use super::active::Active;
use super::complement;
use super::conservative::Conservative;
use super::state::{Drives, Root, State};
use super::system::System;
use crate::Load;
use rayon::prelude::*;
use unripple_core::Observed;
use unripple_linalg::{Mat, c64, product};

/// Least number of modes for which this pays: the eigenvalues of smaller state matrices take milliseconds.
const WORTHWHILE: usize = 48;

/// Number of modes for each load from which this pays. A step costs the square of the number of loads times the number of modes, and
/// the eigenvalues of the state matrix some two hundred times the cube of the latter.
const PER_LOAD: usize = 4;

/// Largest number of steps of a mode. From a mode of light damping two or three are enough; one that needs more than this many is on
/// its way to another mode.
const STEPS: usize = 12;

/// Relative change of s at which a mode has converged: some thousand rounding errors. Since convergence is cubic, the change of one
/// step more would be a rounding error.
const CONVERGED: f64 = 2e-13;

/// Largest residual ‖T(s)q‖ of a mode, relative to 2|s|²‖q‖: far above rounding errors, far below that of a mode that has not
/// converged.
const RESIDUAL: f64 = 1e-9;

/// Largest error of the sums of s and of s² over all modes, relative to the sum of the magnitudes of their terms. A mode that was found
/// twice and one that was missed differ by more, unless both sums agree by chance.
const SUMS: f64 = 1e-10;

/// Relative distance between two frequencies up to which their modes may be mixed, or one found twice: converged frequencies are a hundred
/// thousand times as near. Where modes farther apart were mixed, sums over all modes would tell.
const SAME: f64 = 1e-7;

/// Least part of a mode of norm 1 that is no mode of the same frequency: where two are found independently, less is improbable.
const TWIN: f64 = 1e-2;

/// A mode: its complex frequency s, its displacement in the coordinates of [`Active`], and qᵀT'(s)q.
struct Found {
    s: c64,
    q: Vec<c64>,
    norm: c64,
}

/// All exponentials of the coupled system, as [`State::roots`] gives them; `None` where this is not worthwhile or not sure to find all: with
/// many modes damped too strongly to oscillate, or if sums over the exponentials found are not those of all.
pub(super) fn roots(
    active: &Active,
    modes: &Conservative,
    loads: &[Load],
    drives: &Drives,
) -> Option<Vec<Root>> {
    let count = modes.omegas.len();
    if count < WORTHWHILE || count < PER_LOAD * loads.len() {
        return None;
    }
    let (system, state) = (System::of(active, loads), State::of(modes, loads, drives));
    let observed = Observed::here();
    let steps = observed.steps(count);
    let found: Vec<Option<Found>> =
        (0..count).into_par_iter().map(|m| mode(&system, &state, m)).inspect(|_| steps.take(1.0)).collect();
    let found = apart(&system, found.into_iter().flatten().collect());
    let mut roots = in_modes(&system, &state, found);
    let others = complement::roots(&state, &roots)?;
    roots.extend(others);
    state.adds_up(&roots, SUMS).then_some(roots)
}

/// The damped mode that the undamped mode of index `m` becomes; `None` if it does not oscillate or the iteration does not converge.
fn mode(system: &System<'_>, state: &State<'_>, m: usize) -> Option<Found> {
    let modes = state.modes;
    let (omega, decay) = (modes.omegas[m], 0.5 * modes.damping[(m, m)]);
    let mut q: Vec<c64> = modes.shapes.col(m).iter().map(|x| c64::new(*x, 0.0)).collect();
    if modes.is_rigid(m) {
        // Its frequency is one by convention, which no iteration finds.
        let mut brakes = (0..state.coils.len()).map(|coil| state.coupling(coil, m));
        let still = modes.damping.col(m).iter().all(|c| c.abs() <= SUMS * omega)
            && brakes.all(|coupling| coupling.abs() <= SUMS * omega);
        let s = c64::new(0.0, omega);
        return still.then(|| Found { s, q, norm: s * 2.0 });
    }
    if decay >= omega {
        return None;
    }
    let mut s = c64::new(-decay, ((omega - decay) * (omega + decay)).sqrt());
    for _ in 0..STEPS {
        let (next, residual) = system.solved(s, &system.derivative(s, &q));
        q = next;
        let (balanced, _) = system.balanced(&q, s);
        let change = (balanced - s).norm() / balanced.norm();
        s = balanced;
        // False where a solution is not finite.
        if change <= CONVERGED && residual <= RESIDUAL {
            // Between modes of nearly one frequency the vector converges after the frequency.
            let (q, _) = system.solved(s, &system.derivative(s, &q));
            let (s, norm) = system.balanced(&q, s);
            // A real frequency has an imaginary part by rounding.
            let oscillates = s.im > SAME * s.norm();
            return (oscillates && norm.norm() > 0.0).then_some(Found { s, q, norm });
        }
    }
    None
}

/// Modes of one frequency apart from each other: of two different modes qᵀ((s + s')M + C)q' vanishes, and what is left of one that was found
/// twice is rounding error.
fn apart(system: &System<'_>, mut found: Vec<Found>) -> Vec<Found> {
    found.sort_by(|a, b| a.s.im.total_cmp(&b.s.im));
    let mut all: Vec<Found> = Vec::new();
    for mut mode in found {
        let reach = SAME * mode.s.norm();
        let near = all.iter().rev().take_while(|other| mode.s.im - other.s.im <= reach);
        let near = near.filter(|other| (mode.s - other.s).norm() <= reach);
        let mut alone = true;
        for other in near {
            let half = system.derivative((mode.s + other.s) * 0.5, &mode.q);
            let between = half.iter().zip(&other.q).map(|(force, q)| force * q).sum::<c64>();
            let share = between / other.norm;
            mode.q.iter_mut().zip(&other.q).for_each(|(q, other)| *q -= share * other);
            alone = false;
        }
        let left = mode.q.iter().map(|q| q.norm_sqr()).sum::<f64>().sqrt();
        if alone || left > TWIN {
            if !alone {
                mode.norm = system.balanced(&mode.q, mode.s).1;
            }
            all.push(mode);
        }
    }
    all
}

/// The modes in the coordinates of the undamped ones, with what each drive excites: z = Ψᵀ M q.
fn in_modes(system: &System<'_>, state: &State<'_>, found: Vec<Found>) -> Vec<Root> {
    let moved: Vec<Vec<c64>> = found.par_iter().map(|found| system.heavy(&found.q)).collect();
    let (modes, count) = (state.modes, state.modes.omegas.len());
    let half = |part: fn(&c64) -> f64| {
        let columns = Mat::from_fn(count, moved.len(), |i, k| part(&moved[k][i]));
        product(modes.shapes.transpose(), columns.as_ref())
    };
    let (real, imaginary) = (half(|x| x.re), half(|x| x.im));
    let root = |(k, found): (usize, &Found)| {
        let shape: Vec<c64> = (0..count).map(|i| c64::new(real[(i, k)], imaginary[(i, k)])).collect();
        let input = state.excited(found.s, &shape, found.norm);
        Root { s: found.s, shape, input }
    };
    found.iter().enumerate().map(root).collect()
}

#[cfg(test)]
mod tests {
    use super::super::basis::split;
    use super::*;
    use crate::Footprint;
    use crate::loads::Circuit;
    use std::f64::consts::TAU;
    use unripple_core::{Point, Pole, Random};

    /// Modes with losses in proportion to their frequency, three loads with the given damping, and two drives. The sheet may have three
    /// rigid-body motions, which are damped too, and the first load a coil with an inductance that the second drive feeds.
    fn system(
        damping: f64,
        rigid: bool,
        inductance: Option<f64>,
    ) -> (Active, Conservative, Vec<Load>, Drives) {
        // Losses in proportion to the frequency leave rigid bodies undamped.
        let still = if damping == 0.0 { 0.0 } else { 50.0 };
        let mut random = Random::seeded(7);
        let poles: Vec<Pole> = (1..=150)
            .map(|m| {
                let omega = TAU * (100.0 + 20.0 * f64::from(m) + 8.0 * random.uniform());
                if rigid && m <= 3 { Pole::new(0.0, still) } else { Pole::new(omega, 0.01 * omega) }
            })
            .collect();
        let shapes = Mat::from_fn(3, poles.len(), |_, _| random.between(-1.0, 1.0));
        let load = |mass: f64, stiffness: f64| Load {
            footprint: Footprint::point(Point::new(0.0, 0.0)),
            mass,
            damping,
            stiffness,
            circuit: None,
            housing: None,
        };
        let spring = if rigid { 0.0 } else { 1.0 };
        let mut loads = vec![load(0.02, 0.0), load(0.0, 3e4 * spring), load(0.1, 1e3 * spring)];
        loads[0].circuit =
            inductance.map(|inductance| Circuit { force_constant: 6.0, resistance: 6.2, inductance });
        let (shaped, _) = split(&poles, shapes.as_ref());
        // The upper modes are combined.
        let active = Active::of(&shaped, shapes.as_ref(), TAU * 2400.0);
        assert!(active.single < active.at_loads.ncols() && active.single > 100);
        let modes = Conservative::of(&active, &loads, 2400.0).unwrap();
        let forces = Mat::from_fn(2, modes.omegas.len(), |drive, _| match (drive, inductance) {
            (1, Some(_)) => 0.0,
            _ => random.between(-1.0, 1.0),
        });
        let coils = vec![None, inductance.map(|_| 0)];
        (active, modes, loads, Drives { forces, coils })
    }

    /// Compares the roots with the eigenvalues of the state matrix, and what each excites.
    fn agree(what: &str, (active, modes, loads, drives): (Active, Conservative, Vec<Load>, Drives)) {
        let mut found = roots(&active, &modes, &loads, &drives).unwrap_or_else(|| panic!("{what}: none"));
        let mut known = State::of(&modes, &loads, &drives).roots(2400.0).unwrap();
        let is_rigid = |root: &Root| root.s.norm() < 1e-3;
        for list in [&mut found, &mut known] {
            list.sort_by(|a, b| (a.s.im, a.s.re).partial_cmp(&(b.s.im, b.s.re)).unwrap());
            // Their frequency is one by convention.
            list.retain(|root| !is_rigid(root));
        }
        assert_eq!(found.len(), known.len(), "{what}");
        for (a, b) in found.iter().zip(&known) {
            assert!((a.s - b.s).norm() < 1e-11 * b.s.norm().max(100.0), "{what}: {} {}", a.s, b.s);
            // Shape times input does not depend on the scale of either.
            let largest = |root: &Root| root.shape.iter().map(|x| x.norm()).fold(0.0, f64::max);
            let most = largest(b) * b.input.iter().map(|x| x.norm()).fold(0.0, f64::max);
            for (i, j) in [(0, 0), (40, 1), (90, 0)] {
                let [x, y] = [a, b].map(|root| root.shape[i] * root.input[j]);
                assert!((x - y).norm() < 1e-9 * most, "{what}, {}: {x} {y}", a.s);
            }
        }
    }

    #[test]
    fn the_same_as_the_eigenvalues_of_the_state_matrix() {
        for damping in [0.0, 0.3, 20.0] {
            agree(&format!("damping {damping}"), system(damping, false, None));
        }
    }

    #[test]
    fn so_are_those_that_do_not_oscillate() {
        for damping in [100.0, 300.0, 1000.0, 3000.0] {
            agree(&format!("damping {damping}"), system(damping, false, None));
        }
        for damping in [0.0, 0.3, 20.0] {
            agree(&format!("a free sheet, damping {damping}"), system(damping, true, None));
        }
    }

    #[test]
    fn modes_of_nearly_one_frequency_have_shapes_of_their_own() {
        // As of a square that is a little off: the loads couple pairs whose frequencies differ by ten thousandths of a hertz.
        let mut random = Random::seeded(5);
        let poles: Vec<Pole> = (0..120)
            .map(|m| {
                let omega = TAU * (100.0 + 40.0 * f64::from(m / 2)) * (1.0 + 1e-7 * f64::from(m % 2));
                Pole::new(omega, 0.01 * omega)
            })
            .collect();
        let shapes = Mat::from_fn(3, poles.len(), |_, _| random.between(-1.0, 1.0));
        let loads = system(0.3, false, None).2;
        let (shaped, _) = split(&poles, shapes.as_ref());
        let active = Active::of(&shaped, shapes.as_ref(), TAU * 2000.0);
        let modes = Conservative::of(&active, &loads, 2000.0).unwrap();
        let forces = Mat::from_fn(1, modes.omegas.len(), |_, _| random.between(-1.0, 1.0));
        let drives = Drives { forces, coils: vec![None] };
        let found = roots(&active, &modes, &loads, &drives).unwrap();
        let state = State::of(&modes, &loads, &drives);
        let vectors: Vec<Vec<c64>> = found.iter().map(|root| state.vector(root.s, &root.shape)).collect();
        let between = |a: usize, b: usize| -> f64 {
            let sum = |i: usize, j: usize| -> c64 {
                let both = vectors[i].iter().zip(&vectors[j]).enumerate();
                both.map(|(row, (x, y))| x * y * state.sign(row)).sum()
            };
            sum(a, b).norm() / (sum(a, a).norm() * sum(b, b).norm()).sqrt()
        };
        let worst = (0..found.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        let worst = worst.map(|(a, b)| between(a, b)).fold(0.0, f64::max);
        assert!(worst < 1e-7, "{worst}");
    }

    #[test]
    fn so_are_those_of_one_frequency() {
        // Families of four modes of one frequency, three of which the loads feel: a square has such.
        let mut random = Random::seeded(11);
        let poles: Vec<Pole> = (0..160)
            .map(|m| {
                let omega = TAU * (100.0 + 40.0 * f64::from(m / 4));
                Pole::new(omega, 0.01 * omega)
            })
            .collect();
        let shapes = Mat::from_fn(3, poles.len(), |_, _| random.between(-1.0, 1.0));
        for damping in [0.3, 20.0, 300.0] {
            // Without masses and springs, undamped modes are of one frequency too.
            let mut loads = system(damping, false, None).2;
            (loads[1].stiffness, loads[2].mass) = (0.0, 0.0);
            let (shaped, _) = split(&poles, shapes.as_ref());
            let active = Active::of(&shaped, shapes.as_ref(), TAU * 1500.0);
            let modes = Conservative::of(&active, &loads, 1500.0).unwrap();
            let forces = Mat::from_fn(2, modes.omegas.len(), |_, _| random.between(-1.0, 1.0));
            let drives = Drives { forces, coils: vec![None; 2] };
            agree(&format!("families, damping {damping}"), (active, modes, loads, drives));
        }
    }

    #[test]
    fn so_are_those_of_coils_alike() {
        // Two coils at places that mirror each other, on modes of which each is even or odd; and two that hardly move anything.
        for force_constant in [6.0, 1e-5] {
            let (_, _, mut loads, _) = system(0.3, false, Some(2e-3));
            let circuit = Circuit { force_constant, resistance: 6.2, inductance: 2e-3 };
            loads[0].circuit = Some(circuit);
            (loads[1].circuit, loads[1].mass, loads[1].stiffness) =
                (Some(circuit), loads[0].mass, loads[0].stiffness);
            let mut random = Random::seeded(3);
            let poles: Vec<Pole> = (1..=150)
                .map(|m| {
                    let omega = TAU * (100.0 + 20.0 * f64::from(m) + 8.0 * random.uniform());
                    Pole::new(omega, 0.01 * omega)
                })
                .collect();
            let mut shapes = Mat::from_fn(3, poles.len(), |_, _| random.between(-1.0, 1.0));
            for m in 0..poles.len() {
                shapes[(1, m)] = if m % 2 == 0 { shapes[(0, m)] } else { -shapes[(0, m)] };
            }
            let (shaped, _) = split(&poles, shapes.as_ref());
            let active = Active::of(&shaped, shapes.as_ref(), TAU * 2400.0);
            let modes = Conservative::of(&active, &loads, 2400.0).unwrap();
            let drives = Drives { forces: Mat::zeros(2, modes.omegas.len()), coils: vec![Some(0), Some(1)] };
            let found = roots(&active, &modes, &loads, &drives).unwrap();
            let known = State::of(&modes, &loads, &drives).roots(2400.0).unwrap();
            // What the drives cause in all, since roots of one frequency may be any combination of each other.
            let caused = |roots: &[Root], time: f64, drive: usize| -> f64 {
                let each = |root: &Root| {
                    let twice = if root.s.im == 0.0 { 1.0 } else { 2.0 };
                    (root.shape[5] * root.input[drive] * (root.s * time).exp()).re * twice
                };
                roots.iter().map(each).sum()
            };
            let most = (0..40).map(|i| caused(&known, 1e-4 * f64::from(i), 0).abs()).fold(0.0, f64::max);
            for i in 0..40 {
                for drive in [0, 1] {
                    let [a, b] = [&found, &known].map(|roots| caused(roots, 1e-4 * f64::from(i), drive));
                    assert!((a - b).abs() <= 1e-7 * most, "{force_constant}, {i}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn left_to_the_state_matrix_where_most_do_not_oscillate() {
        let (active, modes, loads, drives) = system(1e5, false, None);
        assert!(roots(&active, &modes, &loads, &drives).is_none());
    }

    #[test]
    fn so_are_those_of_coils_with_an_inductance() {
        for inductance in [1e-5, 2e-3, 1.0] {
            agree(&format!("{inductance} H"), system(0.3, false, Some(inductance)));
            for damping in [0.0, 0.3] {
                let what = format!("{inductance} H on a free sheet, damping {damping}");
                agree(&what, system(damping, true, Some(inductance)));
            }
        }
    }
}
