//! Assembly of the stiffness and mass matrices of a whole sheet.

use super::across;
use super::element::{Element, Shares};
use super::moments::{Form, Moments};
use super::monomials::COUNT;
use super::overlap::overlap;
use super::pattern::pattern;
use super::rule::{Rule, Rules};
use super::space::Space;
use crate::fabric::Fabric;
use pulp::{Arch, NullaryFnOnce};
use rayon::prelude::*;
use unripple_core::Edge;
use unripple_linalg::sparse::SparseColMat;

/// Number of triangles whose matrices are computed by all threads before one thread adds them up in order,
/// so that sums do not depend on the number of threads. With twice this value, twice as many matrices are
/// held at once.
const BATCH: usize = 512;

/// Number of unknowns processed at once: a 512-bit register holds as many f64. With twice this value, sums stay the same.
const LANES: usize = 8;

/// The symmetric matrices of a sheet on a space's unknowns. All have the same sparsity pattern, and both
/// their triangles are stored.
#[derive(Clone, Debug)]
pub(crate) struct Forms {
    /// ∫κᵀDκ + ∫T|∇u|² + ∮(lift u² + tilt (∂u/∂n)²), in J.
    pub(crate) stiffness: SparseColMat<usize, f64>,
    /// ∫κᵀDκ, the bending part of the stiffness, in J.
    pub(crate) bending: SparseColMat<usize, f64>,
    /// ∫ρ_s u² plus m u² of each point mass, in kg·m².
    pub(crate) mass: SparseColMat<usize, f64>,
}

impl Space {
    /// Assembles the matrices of a sheet with the given local properties; triangles are shared among threads.
    pub(crate) fn assemble(&self, fabric: &Fabric) -> Forms {
        let symbolic = pattern(self);
        let rules = Rules::new(fabric.uniform().is_none());
        let masses = self.point_masses(fabric);
        let mut sums = [(); 3].map(|()| vec![0.0; symbolic.row_idx().len()]);
        for (batch, elements) in self.elements.chunks(BATCH).enumerate() {
            let shares = elements.par_iter().enumerate().map(|(i, element)| {
                let mut share = match element.kinks().next() {
                    Some(_) => across::shares(element, fabric, &rules.across),
                    None => shares(element, fabric, &rules),
                };
                for (_, weights, mass) in masses.iter().filter(|(e, ..)| *e == batch * BATCH + i) {
                    add_point(&mut share[2], weights, *mass);
                }
                let (unknowns, [mut stiffness, bending, mass]) = self.relative.between(element, share);
                stiffness.iter_mut().zip(&bending).for_each(|(sum, b)| *sum += b);
                (unknowns, [stiffness, bending, mass])
            });
            for (unknowns, share) in shares.collect::<Vec<(Vec<usize>, Shares)>>() {
                let (starts, rows) = (symbolic.col_ptr(), symbolic.row_idx());
                let count = unknowns.len();
                for (c, column) in unknowns.iter().enumerate() {
                    let start = starts[*column];
                    let within = &rows[start..starts[*column + 1]];
                    let mut place = 0;
                    for (r, row) in unknowns.iter().enumerate() {
                        // Most rows follow the one before.
                        if within.get(place) != Some(row) {
                            place = within.partition_point(|other| other < row);
                        }
                        for (sum, share) in sums.iter_mut().zip(&share) {
                            sum[start + place] += share[c * count + r];
                        }
                        place += 1;
                    }
                }
            }
        }
        let [stiffness, bending, mass] = sums.map(|values| SparseColMat::new(symbolic.clone(), values));
        Forms { stiffness, bending, mass }
    }

    /// For each point mass: the triangle that contains it, the weights of the unknowns there, and its mass
    /// in kg.
    fn point_masses(&self, fabric: &Fabric) -> Vec<(usize, Vec<f64>, f64)> {
        let place = |(at, mass): &(_, f64)| {
            let (e, at) = self.locate(*at);
            let element = self.elements.get(e)?;
            Some((e, element.values(at), *mass))
        };
        fabric.masses().iter().filter_map(place).collect()
    }
}

fn add_point(mass: &mut [f64], weights: &[f64], added: f64) {
    for (row, w) in mass.chunks_exact_mut(weights.len().max(1)).zip(weights) {
        row.iter_mut().zip(weights).for_each(|(sum, v)| *sum += added * w * v);
    }
}

/// The matrices of one triangle, by quadrature with the sheet's properties at the quadrature points.
fn shares(element: &Element, fabric: &Fabric, rules: &Rules) -> Shares {
    let frame = &element.frame;
    let mut moments = Moments::new(frame, element.monomials());
    let rule = rules.of(element.monomials());
    let points = rule.triangle(&element.borders);
    match fabric.uniform() {
        Some(sheet) => moments.add_even(frame, &points, &sheet),
        None => moments.add_varying(frame, &points, |p| fabric.bare(p)),
    }
    for disc in fabric.discs() {
        let mut points = Vec::new();
        rule.region(&overlap(element, disc), &mut points);
        match fabric.uniform() {
            Some(_) => moments.add_even(frame, &points, &fabric.added_by(disc, disc.at)),
            None => moments.add_varying(frame, &points, |p| fabric.added_by(disc, p)),
        }
    }
    let mut rest = moments.tension();
    add_springs(&mut rest, element, rule);
    let arch = Arch::new();
    let congruent = |form: &Form| arch.dispatch(Congruent { element, form });
    [congruent(&rest), congruent(&moments.bending()), congruent(&moments.mass())]
}

/// Adds ∮ lift uv + tilt ∂u/∂n ∂v/∂n along elastic edges.
fn add_springs(form: &mut Form, element: &Element, rule: &Rule) {
    for border in &element.borders {
        let Some(Edge::Elastic { lift, tilt }) = border.held else { continue };
        for (p, [nx, ny], w) in rule.along(border) {
            let jets = element.frame.jets(p);
            for (q, row) in form.iter_mut().enumerate() {
                let (u, slope) = (lift * w * jets[0][q], tilt * w * (nx * jets[1][q] + ny * jets[2][q]));
                for (r, sum) in row.iter_mut().enumerate() {
                    *sum += u * jets[0][r] + slope * (nx * jets[1][r] + ny * jets[2][r]);
                }
            }
        }
    }
}

/// Transforms a bilinear form of monomials to a form of the triangle's unknowns: Bᵀ F B.
struct Congruent<'a> {
    element: &'a Element,
    form: &'a Form,
}

impl NullaryFnOnce for Congruent<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn call(self) -> Vec<f64> {
        let (basis, count) = (&self.element.basis, self.element.unknowns.len());
        let groups = count.div_ceil(LANES);
        let mut out = vec![[0.0; LANES]; count * groups];
        let mut rows = vec![[0.0; LANES]; COUNT * groups];
        for (p, row) in basis.chunks_exact(count.max(1)).enumerate() {
            for (lanes, values) in rows[p * groups..].iter_mut().zip(row.chunks(LANES)) {
                lanes[..values.len()].copy_from_slice(values);
            }
        }
        let size = self.element.monomials();
        for (p, form) in self.form.iter().enumerate().take(size) {
            let row = &basis[p * count..(p + 1) * count];
            for group in 0..groups {
                let mut half = [0.0; LANES];
                for (f, lanes) in form[..size].iter().zip(rows[group..].iter().step_by(groups)) {
                    half = plus(half, *lanes, *f);
                }
                for (b, lanes) in row.iter().zip(out[group..].iter_mut().step_by(groups)) {
                    *lanes = plus(*lanes, half, *b);
                }
            }
        }
        let mut flat = Vec::with_capacity(count * groups * LANES);
        for row in out.chunks_exact(groups.max(1)) {
            row.iter().for_each(|lanes| flat.extend_from_slice(lanes));
            flat.truncate(flat.len() - (groups * LANES - count));
        }
        flat
    }
}

#[inline(always)]
fn plus(mut sums: [f64; LANES], row: [f64; LANES], factor: f64) -> [f64; LANES] {
    for (sum, lane) in sums.iter_mut().zip(row) {
        *sum += factor * lane;
    }
    sums
}
