//! A mesh with its tree: queries, one at a time.
use super::closed_mesh::ClosedMesh;
use super::enclosed_point::encloses;
use super::face_measure::{FaceFeature, FaceRecord};
use super::face_replay::{closest_replay, distance_replay, height_replay, squared_distance_replay};
use super::face_search::{SearchRoom, nearest};
use super::mesh_column::{Mesh, plain};
use super::mesh_fault::MeshFault;
use super::mesh_tree::MeshTree;
use super::ray_search::{candidates, first, meeting, plain_ray};
use crate::intersection3::{Hit3, first_hit_triangle};
use crate::{Lanes, Ray3, Scalar, Vec3};

/// The vectors of single queries.
type Plain = Lanes<f32, 4>;

/// A mesh with its tree, which answers queries. [`MeshTree::on`] makes it.
///
/// Queries that are not finite have the record of face 0 and results that are NaN.
#[derive(Clone, Copy, Debug)]
pub struct MeshSurface<'a, S> {
    mesh: Mesh<'a, S>,
    tree: &'a MeshTree,
}

/// A point in which a ray meets a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshHit<S> {
    /// The face, from zero.
    pub face: u32,
    /// The parameter of the ray, the point and the face's normal towards the ray's start.
    pub hit: Hit3<S>,
}

impl MeshTree {
    /// Returns the mesh with this tree, ready for queries. The tree must have been built or refitted over these columns,
    /// or over the same numbers in another format.
    ///
    /// # Errors
    ///
    /// [`MeshFault::OtherTree`] for another number of vertices or faces.
    pub fn on<'a, S: Copy>(&'a self, mesh: &Mesh<'a, S>) -> Result<MeshSurface<'a, S>, MeshFault> {
        self.check(mesh)?;
        Ok(MeshSurface {
            mesh: *mesh,
            tree: self,
        })
    }
}

impl<'a, S: Copy> MeshSurface<'a, S> {
    /// Returns the mesh.
    #[must_use]
    #[inline]
    pub fn mesh(&self) -> &Mesh<'a, S> {
        &self.mesh
    }
    /// Returns the tree.
    #[must_use]
    #[inline]
    pub fn tree(&self) -> &'a MeshTree {
        self.tree
    }
}

impl<S: Scalar<Mask = bool>> MeshSurface<'_, S> {
    /// Returns the face and the feature that are nearest to a point, among equal ones the face of lowest index.
    #[must_use]
    pub fn nearest_face(&self, point: Vec3<S>) -> FaceRecord {
        let mut room = SearchRoom::default();
        let found = nearest::<Plain, S>(&self.mesh, self.tree, plain(point), None, &mut room);
        found.unwrap_or(FaceRecord::NONE)
    }
    /// Returns the point of the mesh that is nearest to a point. Kinks: the medial axis, where it jumps; there it is that
    /// of the lowest face.
    #[must_use]
    pub fn closest_point(&self, point: Vec3<S>) -> Vec3<S> {
        let FaceRecord { face, feature } = self.nearest_face(point);
        closest_replay(point, self.mesh.triangle(face), feature)
    }
    /// Returns the distance of a point from the mesh, at least 0. Kinks: the mesh itself, where the derivative is zero,
    /// and the medial axis, where it is that of the lowest face.
    #[must_use]
    pub fn distance(&self, point: Vec3<S>) -> S {
        let FaceRecord { face, feature } = self.nearest_face(point);
        distance_replay(point, self.mesh.triangle(face), feature)
    }
    /// Returns the squared distance of a point from the mesh; smooth also on the mesh. Kinks: the medial axis.
    #[must_use]
    pub fn squared_distance(&self, point: Vec3<S>) -> S {
        let FaceRecord { face, feature } = self.nearest_face(point);
        squared_distance_replay(point, self.mesh.triangle(face), feature)
    }
    /// Returns the distance of a point from a closed mesh, negative inside. It is smooth through faces. Kinks: the medial
    /// axis, and edges and vertices, on which the derivative is that of the height over the lowest face.
    ///
    /// Where a mesh crosses itself, inside is where the nearest face faces away from.
    #[must_use]
    pub fn signed_distance(&self, closed: &ClosedMesh, point: Vec3<S>) -> S {
        self.signed_replay(closed, point, self.nearest_face(point))
    }
    /// Returns the distance of a point from a closed mesh along the record of its nearest face, negative inside.
    pub(crate) fn signed_replay(
        &self,
        closed: &ClosedMesh,
        point: Vec3<S>,
        record: FaceRecord,
    ) -> S {
        let triangle = self.mesh.triangle(record.face);
        let distance = distance_replay(point, triangle, record.feature);
        if record.feature == FaceFeature::Interior || distance.equals(S::zero()) {
            return height_replay(point, triangle).canonical();
        }
        match self.is_inside(closed, point, record) {
            true => -distance,
            false => distance,
        }
    }
    /// Returns `true` if a point is inside a closed mesh, by the pseudo-normal of its nearest feature.
    pub(crate) fn is_inside(
        &self,
        closed: &ClosedMesh,
        point: Vec3<S>,
        record: FaceRecord,
    ) -> bool {
        let triangle = self.mesh.triangle(record.face);
        let at = plain(closest_replay(point, triangle, record.feature));
        closed.outward(&self.mesh, record).dot(plain(point) - at) < 0.0
    }
    /// Returns the face that a ray meets first, among equal ones that of lowest index; `None` for a miss.
    ///
    /// Decisions are exact, so that no ray passes between two faces: see
    /// [`first_hit_triangle`].
    #[must_use]
    pub fn hit_face(&self, ray: Ray3<S>) -> Option<u32> {
        let mut room = SearchRoom::default();
        first::<Plain, S>(&self.mesh, self.tree, plain_ray(ray), &mut room)
    }
    /// Returns where a ray meets the mesh first. Kinks: edges of the mesh; silhouettes, where the hit jumps.
    #[must_use]
    pub fn first_hit(&self, ray: Ray3<S>) -> Option<MeshHit<S>> {
        let face = self.hit_face(ray)?;
        let hit = first_hit_triangle(ray, self.mesh.triangle(face));
        Some(MeshHit { face, hit })
    }
    /// Returns all faces that a ray meets, in the order of parameters, at equal ones of the faces. A ray through an edge or
    /// a vertex meets every face there that is not edge-on.
    #[must_use]
    pub fn all_hit_faces(&self, ray: Ray3<S>) -> Vec<u32> {
        let (mut room, plain) = (SearchRoom::default(), plain_ray(ray));
        candidates::<Plain>(self.mesh.faces().len(), self.tree, plain, true, &mut room);
        let met = |&(_, face): &(f32, u32)| Some((meeting(&self.mesh, plain, face)?, face));
        let mut all: Vec<(f64, u32)> = room.candidates.iter().filter_map(met).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        all.into_iter().map(|(_, face)| face).collect()
    }
    /// Returns where a ray meets the mesh, face by face in the order of [`all_hit_faces`](Self::all_hit_faces).
    #[must_use]
    pub fn all_hits(&self, ray: Ray3<S>) -> Vec<MeshHit<S>> {
        let replay = |face| MeshHit {
            face,
            hit: first_hit_triangle(ray, self.mesh.triangle(face)),
        };
        self.all_hit_faces(ray).into_iter().map(replay).collect()
    }
    /// Returns `true` if a ray from the point leaves the mesh through an odd number of faces, or if the point is on a
    /// face: for closed meshes, the points inside. Exact on the given numbers.
    #[must_use]
    pub fn encloses(&self, point: Vec3<S>) -> bool {
        let mut room = SearchRoom::default();
        encloses::<Plain, S>(&self.mesh, self.tree, plain(point), &mut room)
    }
}
