//! Meshes whose every edge has two faces, and the pseudo-normals that tell inside from outside.
use super::face_measure::{FaceFeature, FaceRecord};
use super::mesh_column::Mesh;
use super::mesh_fault::MeshFault;
use crate::{Scalar, Vec3};

/// The faces around every vertex of a closed mesh: of every edge two faces, which pass it in opposite directions.
///
/// It keeps no reference and depends on the faces alone, so that moved vertices need no other one.
#[derive(Clone, Debug)]
pub struct ClosedMesh {
    /// The faces of all vertices, vertex after vertex, each list in increasing order.
    faces: Vec<u32>,
    /// The end of every vertex's list.
    ends: Vec<u32>,
}

impl ClosedMesh {
    /// Returns the faces around every vertex of a closed mesh.
    ///
    /// # Errors
    ///
    /// [`MeshFault::Open`] and [`MeshFault::Crowded`] with the first face and edge at fault, by their order. Repeated
    /// vertices are different ones: a mesh that is closed by places alone is open. A face with one vertex twice is
    /// crowded.
    pub fn new<S: Copy>(mesh: &Mesh<'_, S>) -> Result<Self, MeshFault> {
        let count = mesh.vertices().len();
        let mut ends = vec![0_u32; count + 1];
        for vertex in mesh.faces().iter().flatten() {
            ends[*vertex as usize + 1] += 1;
        }
        for k in 0..count {
            ends[k + 1] += ends[k];
        }
        let mut next = ends.clone();
        let mut faces = vec![0; 3 * mesh.faces().len()];
        for (face, corners) in mesh.faces().iter().enumerate() {
            for vertex in corners {
                let at = &mut next[*vertex as usize];
                faces[*at as usize] = face as u32;
                *at += 1;
            }
        }
        let made = ClosedMesh {
            faces,
            ends: ends.split_off(1),
        };
        for (face, corners) in mesh.faces().iter().enumerate() {
            for k in 0..3 {
                let edge = [corners[k], corners[(k + 1) % 3]];
                let passes = |[from, to]: [u32; 2]| {
                    let around = made.around(from).iter();
                    around.filter(move |&&other| {
                        let [a, b, c] = mesh.faces()[other as usize];
                        [[a, b], [b, c], [c, a]].contains(&[from, to])
                    })
                };
                if let Some(&second) = passes(edge).nth(1) {
                    let face = second as usize;
                    return Err(MeshFault::Crowded { face, edge });
                }
                if passes([edge[1], edge[0]]).next().is_none() {
                    return Err(MeshFault::Open { face, edge });
                }
            }
        }
        Ok(made)
    }

    /// Returns the faces around a vertex.
    fn around(&self, vertex: u32) -> &[u32] {
        let vertex = vertex as usize;
        let start = vertex.checked_sub(1).map_or(0, |k| self.ends[k]) as usize;
        &self.faces[start..self.ends[vertex] as usize]
    }

    /// Returns the direction out of the mesh at a feature: the normal of a face, the sum of the unit normals of an edge's
    /// two faces, or that of a vertex's faces, each times its angle there (Baerentzen and Aanaes, Signed distance
    /// computation using the angle weighted pseudonormal, 2005).
    pub(crate) fn outward<S: Scalar<Mask = bool>>(
        &self,
        mesh: &Mesh<'_, S>,
        record: FaceRecord,
    ) -> Vec3<f64> {
        let unit = |face: u32| {
            let [a, b, c] = mesh.plain_triangle(face);
            (b - a).cross(c - a).normalize_or_zero()
        };
        let corners = mesh.faces()[record.face as usize];
        match record.feature {
            FaceFeature::Interior => unit(record.face),
            FaceFeature::Edge { from, to } => {
                let [from, to] = [from, to].map(|k| corners[usize::from(k)]);
                let around = self.around(from).iter();
                let own = around.filter(|&&face| mesh.faces()[face as usize].contains(&to));
                own.fold(Vec3::zero(), |sum, &face| sum + unit(face))
            }
            FaceFeature::Vertex { corner } => {
                let vertex = corners[usize::from(corner)];
                let mut sum = Vec3::zero();
                for &face in self.around(vertex) {
                    let indices = mesh.faces()[face as usize];
                    let k = indices.iter().position(|&i| i == vertex).unwrap_or(0);
                    let triangle = mesh.plain_triangle(face);
                    let [p, q, r] = [0, 1, 2].map(|j| triangle[(k + j) % 3]);
                    sum += unit(face) * (q - p).angle_to(r - p);
                }
                sum
            }
        }
    }
}
