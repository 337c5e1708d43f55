//! Finite elements of Argyris: continuously differentiable (C1) quintics on triangles, for tensioned plates
//! of any outline.

mod across;
mod border;
mod corner;
mod element;
mod forms;
mod grid;
mod kink;
mod moments;
mod monomials;
mod overlap;
mod pattern;
mod rigid;
mod rule;
mod shapes;
mod space;
mod topology;
mod trim;

#[cfg(test)]
mod tests;

#[cfg(test)]
pub(crate) use forms::Forms;
pub(crate) use shapes::MeshShapes;
pub(crate) use space::Space;
