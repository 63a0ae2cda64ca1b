//! A mesh as borrowed columns.
use super::mesh_fault::MeshFault;
use crate::{Scalar, Triangle3, Vec3};

/// A mesh of triangles: borrowed columns of vertices and of faces, each three indices of vertices. Corners run
/// counter-clockwise seen from outside.
///
/// ```
/// use geograd::Vec3;
/// use geograd::mesh::{Mesh, MeshFault};
/// let vertices = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
/// assert_eq!(Mesh::new(&vertices, &[[0, 1, 2]])?.triangle(0).area(), 0.5);
/// let fault = Mesh::new(&vertices, &[[0, 1, 2], [0, 2, 3]]).unwrap_err();
/// assert_eq!(fault, MeshFault::NoVertex { face: 1, corner: 2, vertex: 3 });
/// # Ok::<(), MeshFault>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a, S> {
    vertices: &'a [Vec3<S>],
    faces: &'a [[u32; 3]],
}

impl<'a, S: Scalar<Mask = bool>> Mesh<'a, S> {
    /// Creates a mesh from its columns.
    ///
    /// # Errors
    ///
    /// A [`MeshFault`] for a mesh without faces, the first vertex that is not finite, and the first index of a face that
    /// is out of range.
    pub fn new(vertices: &'a [Vec3<S>], faces: &'a [[u32; 3]]) -> Result<Self, MeshFault> {
        if faces.is_empty() {
            return Err(MeshFault::Empty);
        }
        if vertices.len().max(faces.len()) > i32::MAX as usize {
            return Err(MeshFault::TooLarge);
        }
        if let Some(vertex) = vertices.iter().position(|vertex| !vertex.is_finite()) {
            return Err(MeshFault::NotFinite { vertex });
        }
        for (face, corners) in faces.iter().enumerate() {
            let outside = |&vertex: &u32| vertex as usize >= vertices.len();
            if let Some(corner) = corners.iter().position(outside) {
                return Err(MeshFault::NoVertex {
                    face,
                    corner,
                    vertex: corners[corner],
                });
            }
        }
        Ok(Mesh { vertices, faces })
    }
}

impl<'a, S: Copy> Mesh<'a, S> {
    /// Creates a mesh from columns that are known to be valid.
    pub(crate) fn unchecked(vertices: &'a [Vec3<S>], faces: &'a [[u32; 3]]) -> Self {
        Mesh { vertices, faces }
    }
    /// Returns these faces over as many other vertices.
    pub(crate) fn with_vertices<'b, T>(&'b self, vertices: &'b [Vec3<T>]) -> Mesh<'b, T> {
        Mesh {
            vertices,
            faces: self.faces,
        }
    }
    /// Returns the vertices.
    #[must_use]
    #[inline]
    pub fn vertices(&self) -> &'a [Vec3<S>] {
        self.vertices
    }
    /// Returns the faces.
    #[must_use]
    #[inline]
    pub fn faces(&self) -> &'a [[u32; 3]] {
        self.faces
    }
    /// Returns the corners of a face.
    ///
    /// # Panics
    ///
    /// When the mesh does not have the face.
    #[must_use]
    #[inline]
    pub fn triangle(&self, face: u32) -> Triangle3<S> {
        let [a, b, c] = self.faces[face as usize].map(|i| self.vertices[i as usize]);
        Triangle3 { a, b, c }
    }
}

impl<S: Scalar<Mask = bool>> Mesh<'_, S> {
    /// Returns the corners of a face as plain numbers, exactly.
    #[inline(always)]
    pub(crate) fn plain_triangle(&self, face: u32) -> [Vec3<f64>; 3] {
        let [a, b, c] = self.faces[face as usize];
        [
            plain(self.vertices[a as usize]),
            plain(self.vertices[b as usize]),
            plain(self.vertices[c as usize]),
        ]
    }
}

/// Returns a vector as plain numbers, exactly; NaN for formats other than `f32`, `f64` and numbers with derivatives
/// over these.
#[inline(always)]
pub(crate) fn plain<S: Scalar<Mask = bool>>(v: Vec3<S>) -> Vec3<f64> {
    Vec3::new(wide(v.x), wide(v.y), wide(v.z))
}

#[inline(always)]
fn wide<S: Scalar<Mask = bool>>(x: S) -> f64 {
    x.widened().unwrap_or(f64::NAN)
}
