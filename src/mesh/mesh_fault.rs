//! Reasons why a mesh is refused.
use std::fmt;

/// The reason why a mesh is refused. Faces, corners and vertices count from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MeshFault {
    /// There are no faces.
    Empty,
    /// There are more vertices or faces than 32-bit indices can count.
    TooLarge,
    /// A vertex has a coordinate that is NaN or infinite.
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// A corner of a face is not the index of a vertex.
    NoVertex {
        /// The face.
        face: usize,
        /// Its corner: 0, 1 or 2.
        corner: usize,
        /// The index at fault.
        vertex: u32,
    },
    /// A mesh that must be closed has an edge without a face on its other side.
    Open {
        /// The face.
        face: usize,
        /// The ends of the edge.
        edge: [u32; 2],
    },
    /// A mesh that must be closed has an edge that two faces pass in one direction: more than two faces meet there, or
    /// two of opposite orientation.
    Crowded {
        /// The later face of the two.
        face: usize,
        /// The ends of the edge.
        edge: [u32; 2],
    },
    /// A tree was built over another number of vertices or faces.
    OtherTree {
        /// The number of vertices and of faces of the mesh.
        expected: [usize; 2],
        /// The number of vertices and of faces that the tree was built over.
        found: [usize; 2],
    },
    /// A border is that of a mesh with another number of vertices or faces.
    OtherBorder {
        /// The number of vertices and of faces of the mesh.
        expected: [usize; 2],
        /// The number of vertices and of faces of the border's mesh.
        found: [usize; 2],
    },
}

impl fmt::Display for MeshFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MeshFault::Empty => f.write_str("the mesh has no faces"),
            MeshFault::TooLarge => f.write_str("the mesh has more vertices or faces than 2³¹ − 1"),
            MeshFault::NotFinite { vertex } => write!(
                f,
                "vertex {vertex} has a coordinate that is not a finite number"
            ),
            MeshFault::NoVertex {
                face,
                corner,
                vertex,
            } => write!(
                f,
                "corner {corner} of face {face} is vertex {vertex}, which the mesh does not have"
            ),
            MeshFault::Open {
                face,
                edge: [from, to],
            } => write!(
                f,
                "face {face} has no neighbour at its edge from vertex {from} to vertex {to}"
            ),
            MeshFault::Crowded {
                face,
                edge: [from, to],
            } => write!(
                f,
                "face {face} is the second one with an edge from vertex {from} to vertex {to}"
            ),
            MeshFault::OtherTree { expected, found } => write!(
                f,
                "the tree is of {} vertices and {} faces, the mesh has {} and {}",
                found[0], found[1], expected[0], expected[1]
            ),
            MeshFault::OtherBorder { expected, found } => write!(
                f,
                "the border is of {} vertices and {} faces, the mesh has {} and {}",
                found[0], found[1], expected[0], expected[1]
            ),
        }
    }
}

impl std::error::Error for MeshFault {}
