//! The mesh of a sheet as planned.

use super::sizing::Plan;
use crate::PhysicsError;
use crate::elements::Space;
use crate::fabric::Fabric;
use crate::mesh::Mesh;
use unripple_core::Surface;
use unripple_core::plane::doubled;

/// The mesh of a sheet as planned, and the functions on it.
pub(super) fn meshed(surface: &Surface, fabric: &Fabric, plan: &Plan) -> Result<(Mesh, Space), PhysicsError> {
    let mesh = Mesh::new(&surface.outline, &plan.sizing())?;
    let space = Space::new(&mesh, fabric.bends()).with_kinks(&mesh, fabric);
    Ok((mesh, space))
}

/// The geometric mean over the sheet's area of the edge length (m) of equilateral triangles as large as
/// those of a mesh: it stands for most of the sheet, however many triangles there are at corners.
pub(super) fn mean_edge(mesh: &Mesh) -> f64 {
    let (mut sheet, mut logs) = (0.0, 0.0);
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.vertices.map(|v| mesh.vertices[v].at);
        let area = 0.5 * doubled(a, b, c);
        (sheet, logs) = (sheet + area, logs + area * area.ln());
    }
    (f64::exp(logs / sheet) / 0.1875_f64.sqrt()).sqrt()
}
