//! Neighbours in a mesh: the triangles beside each edge, the fan around each vertex.

use crate::mesh::Mesh;

/// Neighbours within a mesh: triangles beside edges, edges around vertices.
#[derive(Debug)]
pub(crate) struct Topology {
    /// The triangles on both sides of each edge.
    beside: Vec<[Option<usize>; 2]>,
    /// The rim edges that start and end at each vertex.
    rims: Vec<[Option<usize>; 2]>,
    /// Mean length of the edges at each vertex, in metres.
    pub(crate) lengths: Vec<f64>,
}

/// A triangle around a vertex, and the edge shared with the next triangle anticlockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FanStep {
    /// Index of the triangle.
    pub(crate) triangle: usize,
    /// Index of the vertex at the other end of the shared edge.
    pub(crate) towards: usize,
}

impl Topology {
    /// Finds the neighbours within a mesh.
    pub(crate) fn of(mesh: &Mesh) -> Self {
        let mut beside = vec![[None; 2]; mesh.edges.len()];
        for (t, triangle) in mesh.triangles.iter().enumerate() {
            for &e in &triangle.edges {
                let free = usize::from(beside[e][0].is_some());
                beside[e][free] = Some(t);
            }
        }
        let mut rims = vec![[None; 2]; mesh.vertices.len()];
        let mut sums = vec![(0.0, 0usize); mesh.vertices.len()];
        for (e, edge) in mesh.edges.iter().enumerate() {
            let [a, b] = edge.ends;
            let length = mesh.vertices[a].at.distance(mesh.vertices[b].at);
            for v in edge.ends {
                sums[v] = (sums[v].0 + length, sums[v].1 + 1);
            }
            if edge.span.is_some() {
                (rims[a][0], rims[b][1]) = (Some(e), Some(e));
            }
        }
        let lengths = sums.into_iter().map(|(sum, count)| sum / count.max(1) as f64).collect();
        Self { beside, rims, lengths }
    }

    /// Indices of the rim edges that start and end at a vertex; `None` for a vertex inside.
    pub(crate) fn rim(&self, vertex: usize) -> Option<[usize; 2]> {
        let [leaves, arrives] = self.rims[vertex];
        Some([leaves?, arrives?])
    }

    /// The triangles around a vertex on a rim, given by its index, anticlockwise from the rim edge that
    /// starts there.
    pub(crate) fn fan(&self, mesh: &Mesh, vertex: usize) -> Vec<FanStep> {
        let mut steps = Vec::new();
        let mut next = self.rims[vertex][0].and_then(|e| self.beside[e][0]);
        while let Some(triangle) = next {
            let shape = &mesh.triangles[triangle];
            let Some(corner) = shape.vertices.iter().position(|v| *v == vertex) else { break };
            let before = (corner + 2) % 3;
            steps.push(FanStep { triangle, towards: shape.vertices[before] });
            let across = self.beside[shape.edges[before]];
            next = across.into_iter().flatten().find(|t| *t != triangle);
            if steps.len() > mesh.triangles.len() {
                break;
            }
        }
        steps
    }
}
