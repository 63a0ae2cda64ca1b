//! A mesh that owns its columns.
use super::mesh_column::Mesh;
use super::mesh_fault::MeshFault;
use crate::{Scalar, Vec3};
use std::sync::Arc;

/// A mesh that owns its columns, checked once: [`mesh`](OwnedMesh::mesh) lends them without another pass over them.
///
/// Copies and [moved](OwnedMesh::moved) meshes share the faces.
///
/// ```
/// use geograd::Vec3;
/// use geograd::mesh::{MeshFault, MeshTree, OwnedMesh};
/// let vertices = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
/// let owned = OwnedMesh::new(vertices.to_vec(), vec![[0, 1, 2]])?;
/// let tree = MeshTree::new(&owned.mesh());
/// assert_eq!(tree.on(&owned.mesh())?.distance(Vec3::new(0.0, 0.0, 2.0)), 2.0);
/// let lower = owned.moved(vertices.map(|v| v - Vec3::new(0.0, 0.0, 1.0)).to_vec())?;
/// assert_eq!(lower.mesh().triangle(0).a.z, -1.0);
/// # Ok::<(), MeshFault>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct OwnedMesh<S> {
    vertices: Vec<Vec3<S>>,
    faces: Arc<[[u32; 3]]>,
}

impl<S: Scalar<Mask = bool>> OwnedMesh<S> {
    /// Creates a mesh from its columns.
    ///
    /// # Errors
    ///
    /// As [`Mesh::new`].
    pub fn new(
        vertices: Vec<Vec3<S>>,
        faces: impl Into<Arc<[[u32; 3]]>>,
    ) -> Result<Self, MeshFault> {
        let faces = faces.into();
        Mesh::new(&vertices, &faces)?;
        Ok(OwnedMesh { vertices, faces })
    }
    /// Returns the mesh with its vertices at other places.
    ///
    /// # Errors
    ///
    /// As [`Mesh::new`].
    pub fn moved(&self, vertices: Vec<Vec3<S>>) -> Result<Self, MeshFault> {
        OwnedMesh::new(vertices, self.faces.clone())
    }
}

impl<S: Copy> OwnedMesh<S> {
    /// Returns the mesh over these columns.
    #[must_use]
    #[inline]
    pub fn mesh(&self) -> Mesh<'_, S> {
        Mesh::unchecked(&self.vertices, &self.faces)
    }
}
