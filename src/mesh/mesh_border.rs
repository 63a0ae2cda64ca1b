//! The border of a mesh: the edges that faces pass more often in one direction than in the other.
use super::mesh_column::Mesh;

/// An edge of a mesh's border.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BorderEdge {
    /// The vertex at which it starts.
    pub from: u32,
    /// The vertex at which it ends.
    pub to: u32,
    /// How often more faces pass it in this direction than in the other one: at least 1.
    pub times: u32,
}

/// The border of a mesh: the edges that faces pass more often in one direction than in the other. A closed mesh has
/// none; an edge of three faces, or of two in one direction, belongs to it.
///
/// It keeps no reference and depends on the faces alone, so that moved vertices need no other one. Repeated vertices are
/// different ones.
///
/// ```
/// use geograd::Vec3;
/// use geograd::mesh::{Mesh, MeshBorder};
/// let vertices = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
/// let border = MeshBorder::new(&Mesh::new(&vertices, &[[0, 1, 2], [0, 2, 3]])?);
/// let ends: Vec<_> = border.edges().iter().map(|edge| [edge.from, edge.to]).collect();
/// assert_eq!(ends, [[0, 1], [3, 0], [1, 2], [2, 3]]);
/// # Ok::<(), geograd::mesh::MeshFault>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshBorder {
    edges: Vec<BorderEdge>,
    /// The number of vertices and of faces of the mesh.
    counts: [usize; 2],
}

impl MeshBorder {
    /// Returns the border of a mesh, its edges in the order of their vertices. Takes `O(n log n)` steps.
    #[must_use]
    pub fn new<S: Copy>(mesh: &Mesh<'_, S>) -> Self {
        let mut passes: Vec<(u32, u32, i32)> = Vec::with_capacity(3 * mesh.faces().len());
        for &[a, b, c] in mesh.faces() {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let way = if from < to { 1 } else { -1 };
                passes.push((from.min(to), from.max(to), way));
            }
        }
        passes.sort_unstable();
        let same = |p: &(u32, u32, i32), q: &(u32, u32, i32)| (p.0, p.1) == (q.0, q.1);
        let edges = passes.chunk_by(same).filter_map(|passes| {
            let (low, high, _) = passes[0];
            let net: i32 = passes.iter().map(|pass| pass.2).sum();
            let (from, to) = if net > 0 { (low, high) } else { (high, low) };
            let times = net.unsigned_abs();
            (times > 0 && from != to).then_some(BorderEdge { from, to, times })
        });
        MeshBorder {
            edges: edges.collect(),
            counts: [mesh.vertices().len(), mesh.faces().len()],
        }
    }
    /// Returns the edges, in the direction of their faces.
    #[must_use]
    #[inline]
    pub fn edges(&self) -> &[BorderEdge] {
        &self.edges
    }
    /// Returns the number of vertices and of faces of the mesh.
    pub(super) fn counts(&self) -> [usize; 2] {
        self.counts
    }
}
