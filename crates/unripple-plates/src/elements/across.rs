//! Triangles near the rims of glued discs: their functions with jumps of curvature, and their matrices by
//! quadrature on both sides of a rim.

use super::element::{Element, Jumping, Shares};
use super::kink::{Factors, Kink};
use super::monomials::{Jet, QUINTIC};
use super::overlap::{crosses, overlap, uncovered};
use super::rule::{Rule, Rules};
use super::space::{Space, middle};
use super::topology::Topology;
use crate::fabric::{Disc, Fabric, Local};
use crate::mesh::{Mesh, Triangle};
use std::collections::BTreeMap;
use unripple_core::{Edge, Point};
use unripple_linalg::{Mat, exact_symmetric};

/// Least mean square of an added function, relative to that of ψ at an edge length from the rim, which is
/// about 1: a hundred million times that of rounding errors. A hundred times as much, and jumps in
/// triangles that the rim just touches are missed.
const FAINT: f64 = 1e-13;

/// A mesh, the lengths (m) by which derivatives at its vertices are scaled, and the quadrature rule on
/// either side of a rim.
struct Base<'a> {
    mesh: &'a Mesh,
    lengths: Vec<f64>,
    rule: Rule,
}

impl Space {
    /// The space with added functions whose curvature jumps across the rims of glued discs; discs that
    /// touch another disc are left out.
    pub(crate) fn with_kinks(mut self, mesh: &Mesh, fabric: &Fabric) -> Self {
        let discs = fabric.discs();
        if discs.is_empty() {
            return self;
        }
        let base = Base { mesh, lengths: Topology::of(mesh).lengths, rule: Rules::new(false).across };
        let apart = |i: usize| {
            let clear = |(j, other): (usize, &Disc)| {
                i == j || other.at.distance(discs[i].at) > other.radius + discs[i].radius
            };
            discs.iter().enumerate().all(clear)
        };
        for (index, disc) in discs.iter().enumerate().filter(|(i, _)| apart(*i)) {
            self.add_kink(&base, index, disc, fabric.bends());
        }
        self
    }

    /// Adds the functions of a disc to the triangles near its rim.
    fn add_kink(&mut self, base: &Base, index: usize, disc: &Disc, bending: bool) {
        let Base { mesh, lengths, rule } = base;
        let around = self.near(mesh, disc);
        let Some(length) = around.keys().map(|v| lengths[*v]).reduce(f64::min) else { return };
        let kink = Kink::new(index, disc, length, bending);
        for (v, triangles) in &around {
            let vertex = mesh.vertices[*v].at;
            let jumping = |t: usize, factors: Factors| {
                let triangle = &mesh.triangles[t];
                let values = nodal(mesh, triangle, lengths, |p| kink.at(vertex, &factors, p));
                let corner = triangle.vertices.iter().position(|w| w == v).unwrap_or_default();
                let interpolated = self.elements[t].polynomial(&values);
                Jumping { kink, vertex, factors, column: 6 * corner, interpolated }
            };
            let monomial = |i: usize| -> Factors { std::array::from_fn(|j| f64::from(u8::from(i == j))) };
            let each = |t: &usize| (*t, std::array::from_fn(|i| jumping(*t, monomial(i))));
            let all: Vec<(usize, [Jumping; 6])> = triangles.iter().map(each).collect();
            let kept = independent(&self.elements, rule, disc, &all);
            let added: Vec<(usize, Vec<Jumping>)> = triangles
                .iter()
                .map(|t| (*t, kept.iter().map(|factors| jumping(*t, *factors)).collect()))
                .collect();
            for (t, functions) in added {
                for (i, function) in functions.into_iter().enumerate() {
                    self.elements[t].add(function, self.unknowns + i);
                }
            }
            self.unknowns += kept.len();
        }
    }

    /// The vertices of triangles crossed by a disc's rim, each with the triangles around it. Only vertices
    /// all of whose triangles have the full 21 unknowns of a quintic, without any edge condition, are
    /// included.
    fn near(&self, mesh: &Mesh, disc: &Disc) -> BTreeMap<usize, Vec<usize>> {
        let (mut crossed, mut held) = (vec![false; mesh.vertices.len()], vec![false; mesh.vertices.len()]);
        for (element, triangle) in self.elements.iter().zip(&mesh.triangles) {
            let whole = element.polynomials() == QUINTIC && element.monomials() == QUINTIC;
            let crosses = crosses(element, disc);
            for v in triangle.vertices {
                held[v] |= !whole;
                crossed[v] |= crosses;
            }
        }
        let mut around = BTreeMap::new();
        for (t, triangle) in mesh.triangles.iter().enumerate() {
            for v in triangle.vertices.into_iter().filter(|v| crossed[*v] && !held[*v]) {
                around.entry(v).or_insert_with(Vec::new).push(t);
            }
        }
        around
    }
}

/// Combinations of the functions around a vertex that are orthogonal, with a mean square of 1 over the
/// vertex's triangles, as factors of the six monomials. Of the six combinations, those that are only
/// rounding errors are left out. `all` holds the functions of the six monomials for each triangle.
fn independent(
    elements: &[Element],
    rule: &Rule,
    disc: &Disc,
    all: &[(usize, [Jumping; 6])],
) -> Vec<Factors> {
    let (mut products, mut area) = ([[0.0; 6]; 6], 0.0);
    let mut points = Vec::new();
    for (t, functions) in all {
        let element = &elements[*t];
        for (covered, part) in [(false, uncovered(element, &[disc])), (true, overlap(element, disc))] {
            points.clear();
            rule.region(&part, &mut points);
            for (p, w) in &points {
                let values = element.jumps(*p, covered, functions);
                area += w;
                for (row, a) in products.iter_mut().zip(values) {
                    row.iter_mut().zip(values).for_each(|(sum, b)| *sum += w * a * b);
                }
            }
        }
    }
    let gram = Mat::from_fn(6, 6, |i, j| products[i][j] / area);
    let Some((squares, vectors)) = exact_symmetric(gram.as_ref()) else { return Vec::new() };
    let kept = (0..6).filter(|i| squares[*i] > FAINT);
    kept.map(|i| std::array::from_fn(|j| vectors[(j, i)] / squares[i].sqrt())).collect()
}

/// The 21 values of a function that determine a quintic on a triangle, scaled like the triangle's unknowns.
fn nodal(mesh: &Mesh, triangle: &Triangle, lengths: &[f64], function: impl Fn(Point) -> Jet) -> Vec<f64> {
    let mut values = Vec::with_capacity(QUINTIC);
    for v in triangle.vertices {
        let [u, x, y, xx, xy, yy] = function(mesh.vertices[v].at);
        let h = lengths[v];
        values.extend([u, h * x, h * y, h * h * xx, h * h * xy, h * h * yy]);
    }
    for e in triangle.edges {
        let middle = middle(mesh, e);
        let [_, x, y, ..] = function(middle.at);
        values.push(middle.length * (middle.normal[0] * x + middle.normal[1] * y));
    }
    values
}

/// The matrices of a triangle that has functions with jumps.
pub(super) fn shares(element: &Element, fabric: &Fabric, rule: &Rule) -> Shares {
    let mut sums = Sums::new(element.unknowns.len());
    let discs = fabric.discs();
    let split: Vec<usize> = element.kinks().map(|kink| kink.disc).collect();
    let mut points = Vec::new();
    let rims: Vec<&Disc> = split.iter().map(|i| &discs[*i]).collect();
    rule.region(&uncovered(element, &rims), &mut points);
    points.iter().for_each(|(p, w)| sums.add(&element.jets(*p, None), &fabric.bare(*p), *w));
    for (index, disc) in discs.iter().enumerate() {
        points.clear();
        rule.region(&overlap(element, disc), &mut points);
        let is_split = split.contains(&index);
        for (p, w) in &points {
            // A disc across whose rim nothing jumps is on triangles that are integrated already.
            let bare = if is_split { fabric.bare(*p) } else { Local::default() };
            let local = bare.plus(&fabric.added_by(disc, *p));
            sums.add(&element.jets(*p, is_split.then_some(index)), &local, *w);
        }
    }
    for border in &element.borders {
        let Some(Edge::Elastic { lift, tilt }) = border.held else { continue };
        for (p, normal, w) in rule.along(border) {
            sums.add_spring(&element.jets(p, element.covering(p)), normal, [lift * w, tilt * w]);
        }
    }
    sums.shares()
}

/// Sums over quadrature points for the matrices of one triangle, lower triangles row by row.
struct Sums {
    count: usize,
    rest: Vec<f64>,
    bending: Vec<f64>,
    mass: Vec<f64>,
}

impl Sums {
    fn new(count: usize) -> Self {
        let none = || vec![0.0; count * count];
        Self { count, rest: none(), bending: none(), mass: none() }
    }

    /// Adds the contribution of a quadrature point with a given weight (m²).
    fn add(&mut self, jets: &[Vec<f64>; 6], local: &Local, weight: f64) {
        let [u, ux, uy, uxx, uxy, uyy] = jets;
        let [d11, d12, d16, d22, d26, d66] = local.bending.map(|d| weight * d);
        let (mass, tension) = (weight * local.mass, weight * local.tension);
        for i in 0..self.count {
            let row = i * self.count..i * self.count + i + 1;
            let (a, b, c) = (uxx[i], uyy[i], 2.0 * uxy[i]);
            let moments = [
                d11 * a + d12 * b + d16 * c,
                d12 * a + d22 * b + d26 * c,
                2.0 * (d16 * a + d26 * b + d66 * c),
            ];
            let (m, x, y) = (mass * u[i], tension * ux[i], tension * uy[i]);
            for (j, sum) in self.bending[row.clone()].iter_mut().enumerate() {
                *sum += moments[0] * uxx[j] + moments[1] * uyy[j] + moments[2] * uxy[j];
            }
            self.rest[row.clone()].iter_mut().enumerate().for_each(|(j, sum)| *sum += x * ux[j] + y * uy[j]);
            self.mass[row].iter_mut().zip(u).for_each(|(sum, u)| *sum += m * u);
        }
    }

    /// Adds the contribution of a point of an elastic edge with a given normal: springs against deflection
    /// (N/m) and slope (N·m).
    fn add_spring(&mut self, jets: &[Vec<f64>; 6], [nx, ny]: [f64; 2], [lift, tilt]: [f64; 2]) {
        let [u, ux, uy, ..] = jets;
        let slope = |i: usize| nx * ux[i] + ny * uy[i];
        for i in 0..self.count {
            for j in 0..=i {
                self.rest[i * self.count + j] += lift * u[i] * u[j] + tilt * slope(i) * slope(j);
            }
        }
    }

    /// The complete symmetric matrices.
    fn shares(mut self) -> Shares {
        let n = self.count;
        for matrix in [&mut self.rest, &mut self.bending, &mut self.mass] {
            for i in 0..n {
                for j in 0..i {
                    matrix[j * n + i] = matrix[i * n + j];
                }
            }
        }
        [self.rest, self.bending, self.mass]
    }
}
