//! Distances of a mesh from solids and from other meshes: searches by trees, and replays along their records.
use super::face_search::SearchRoom;
use super::mesh_column::Mesh;
use super::mesh_solid::MeshSolid;
use super::mesh_solid::SolidBounds;
use super::mesh_surface::MeshSurface;
use super::mesh_tree::MeshTree;
use super::pair_search::visit_pairs;
use super::solid_search::{Wanted, visit_faces};
use crate::distance3::{PointPair3, closest_points, distance};
use crate::{Lanes, Pack, Pose3, Scalar, Triangle3, Vec3};

/// The vectors of single queries.
type Plain = Lanes<f32, 4>;

/// The record of a search for the nearest faces of two meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FacePair {
    /// The face of the first mesh, from zero.
    pub first: u32,
    /// The face of the second one.
    pub second: u32,
}

impl FacePair {
    /// The record of poses that are not finite.
    pub(crate) const NONE: FacePair = FacePair {
        first: 0,
        second: 0,
    };
}

/// A search for the faces that are near a solid: `visit_faces` in some vectors.
pub(crate) type FaceVisits =
    fn(&MeshTree, &SolidBounds, f64, &mut SearchRoom, &mut dyn FnMut(u32) -> Wanted);
/// A search for the faces of two meshes that are near each other: `visit_pairs` in some vectors.
pub(crate) type PairVisits =
    fn([&MeshTree; 2], &Pose3<f64>, f64, &mut dyn FnMut(u32, u32) -> Wanted);

/// The least distance so far, and its faces; the lowest of equal ones.
struct LeastPair {
    distance: f64,
    faces: Option<FacePair>,
}

impl LeastPair {
    fn new() -> Self {
        LeastPair {
            distance: f64::INFINITY,
            faces: None,
        }
    }
    /// Compares with other faces. Of zeros only those of lower faces are wanted.
    #[inline]
    fn with(&mut self, faces: FacePair, measure: impl FnOnce() -> f64) -> Wanted {
        let is_lower = self.faces.is_none_or(|own| faces < own);
        // Nothing is below zero, so that later faces need not be measured.
        if self.distance > 0.0 || is_lower {
            let distance = measure();
            if distance < self.distance || distance == self.distance && is_lower {
                (self.distance, self.faces) = (distance, Some(faces));
            }
        }
        match self.faces {
            Some(own) if self.distance == 0.0 => Wanted {
                distance: 0.0,
                most: own.first,
            },
            _ => Wanted::up_to(self.distance),
        }
    }
}

/// Returns the face that is nearest to a solid, among equal ones the lowest; `None` for a solid that is not finite.
pub(crate) fn nearest_to<S: Scalar<Mask = bool>>(
    visit: FaceVisits,
    surface: &MeshSurface<'_, S>,
    solid: &impl MeshSolid<S>,
) -> Option<u32> {
    let bounds = solid.bounds();
    if !bounds.is_finite() {
        return None;
    }
    let (mesh, bracket) = (surface.mesh(), solid.bracket());
    let (mut nearest, mut room) = (Bracketed::default(), SearchRoom::default());
    visit(
        surface.tree(),
        &bounds,
        f64::INFINITY,
        &mut room,
        &mut |face| nearest.with(face, |most| bracket(plain_face(mesh, face), most)),
    );
    let measure = solid.measure();
    nearest.lowest(|face| measure(plain_face(mesh, face)))
}

/// Returns the faces whose distance from a solid is at most a number, in their order; of all if `only` is `None`, else
/// as many.
pub(crate) fn faces_within<S: Scalar<Mask = bool>>(
    visit: FaceVisits,
    surface: &MeshSurface<'_, S>,
    solid: &impl MeshSolid<S>,
    most: f64,
    only: Option<usize>,
) -> Vec<u32> {
    let (bounds, mut found) = (solid.bounds(), Vec::new());
    if !bounds.is_finite() || most.is_nan() || most < 0.0 {
        return found;
    }
    let (mesh, measure, bracket) = (surface.mesh(), solid.measure(), solid.bracket());
    let mut room = SearchRoom::default();
    visit(surface.tree(), &bounds, most, &mut room, &mut |face| {
        let triangle = plain_face(mesh, face);
        let [low, high] = bracket(triangle, most);
        if low <= most && (high <= most || measure(triangle) <= most) {
            found.push(face);
        }
        match only {
            Some(count) if found.len() >= count => Wanted::NOTHING,
            _ => Wanted::up_to(most),
        }
    });
    found.sort_unstable();
    found.dedup();
    found
}

/// Faces that may be the nearest one to a solid, by bounds of their distances.
struct Bracketed {
    /// A distance that the nearest face has at most.
    high: f64,
    /// Faces, with distances that they have at least.
    faces: Vec<(f64, u32)>,
    /// The lowest face that is known to be at distance zero.
    met: Option<u32>,
}

impl Default for Bracketed {
    fn default() -> Self {
        Bracketed {
            high: f64::INFINITY,
            faces: Vec::new(),
            met: None,
        }
    }
}

impl Bracketed {
    /// Looks at another face. Of faces at distance zero only lower ones are wanted.
    #[inline]
    fn with(&mut self, face: u32, bracket: impl FnOnce(f64) -> [f64; 2]) -> Wanted {
        if self.met.is_none_or(|met| face < met) {
            let [low, high] = bracket(self.high);
            if low <= self.high {
                self.faces.push((low, face));
                self.high = self.high.min(high);
            }
            if high == 0.0 {
                self.met = Some(face);
            }
        }
        match self.met {
            Some(face) => Wanted {
                distance: 0.0,
                most: face,
            },
            None => Wanted::up_to(self.high),
        }
    }
    /// Returns the nearest face, the lowest of equal ones, given a function of their distances.
    fn lowest(mut self, measure: impl Fn(u32) -> f64) -> Option<u32> {
        self.faces.retain(|(low, _)| *low <= self.high);
        self.faces.sort_unstable_by_key(|(_, face)| *face);
        if let [(_, only)] = self.faces[..] {
            return Some(only);
        }
        let mut best: Option<(f64, u32)> = None;
        for (low, face) in self.faces {
            let least = best.map_or(f64::INFINITY, |best| best.0);
            if low < least {
                let distance = if Some(face) == self.met {
                    0.0
                } else {
                    measure(face)
                };
                if distance < least {
                    best = Some((distance, face));
                }
            }
        }
        best.map(|best| best.1)
    }
}

/// Measures the distances of faces of two meshes, the second one placed by a pose.
struct PairMeasure<'a, S> {
    meshes: [&'a Mesh<'a, S>; 2],
    pose: Pose3<f64>,
    /// The last face of the second mesh, where it is placed.
    placed: Option<(u32, Triangle3<f64>)>,
}

impl<S: Scalar<Mask = bool>> PairMeasure<'_, S> {
    #[inline]
    fn of(&mut self, FacePair { first, second }: FacePair) -> f64 {
        let other = match self.placed {
            Some((face, placed)) if face == second => placed,
            _ => {
                let placed = self.pose * plain_face(self.meshes[1], second);
                self.placed = Some((second, placed));
                placed
            }
        };
        distance(plain_face(self.meshes[0], first), other)
    }
}

/// Returns the faces of two meshes that are nearest to each other, among equal ones the lowest of the first mesh, then
/// of the second one; `None` for a pose that is not finite. The second mesh is placed by the pose.
pub(crate) fn nearest_pair<S: Scalar<Mask = bool>>(
    visit: PairVisits,
    [own, other]: [&MeshSurface<'_, S>; 2],
    pose: Pose3<S>,
) -> Option<FacePair> {
    let pose = plain_pose(pose)?;
    let mut measure = PairMeasure {
        meshes: [own.mesh(), other.mesh()],
        pose,
        placed: None,
    };
    let mut least = LeastPair::new();
    let trees = [own.tree(), other.tree()];
    visit(trees, &pose, f64::INFINITY, &mut |first, second| {
        let pair = FacePair { first, second };
        least.with(pair, || measure.of(pair))
    });
    least.faces
}

/// Returns the pairs of faces whose distance is at most a number, in their order; of all if `only` is `None`, else as
/// many.
pub(crate) fn pairs_within<S: Scalar<Mask = bool>>(
    visit: PairVisits,
    [own, other]: [&MeshSurface<'_, S>; 2],
    pose: Pose3<S>,
    most: f64,
    only: Option<usize>,
) -> Vec<FacePair> {
    let mut found = Vec::new();
    let Some(pose) = plain_pose(pose).filter(|_| most >= 0.0) else {
        return found;
    };
    let mut measure = PairMeasure {
        meshes: [own.mesh(), other.mesh()],
        pose,
        placed: None,
    };
    let trees = [own.tree(), other.tree()];
    visit(trees, &pose, most, &mut |first, second| {
        let pair = FacePair { first, second };
        if measure.of(pair) <= most {
            found.push(pair);
        }
        match only {
            Some(count) if found.len() >= count => Wanted::NOTHING,
            _ => Wanted::up_to(most),
        }
    });
    found.sort_unstable();
    found
}

/// Returns a face as plain numbers.
#[inline]
fn plain_face<S: Scalar<Mask = bool>>(mesh: &Mesh<'_, S>, face: u32) -> Triangle3<f64> {
    let [a, b, c] = mesh.plain_triangle(face);
    Triangle3 { a, b, c }
}

/// Returns a pose as plain numbers; `None` for one that is not finite.
fn plain_pose<S: Scalar<Mask = bool>>(pose: Pose3<S>) -> Option<Pose3<f64>> {
    let pose: Pose3<f64> = pose.remake(&mut |x| x.widened().unwrap_or(f64::NAN));
    let axes = pose.rotation.axes();
    let is_finite =
        pose.translation.is_finite() && axes.iter().all(|axis: &Vec3<f64>| axis.is_finite());
    is_finite.then_some(pose)
}

/// Returns the distance of a face from one of a mesh that a pose places, 0 where they meet.
#[must_use]
#[inline]
pub fn pair_distance<S: Scalar>(first: Triangle3<S>, second: Triangle3<S>, pose: Pose3<S>) -> S {
    distance(first, pose * second)
}

/// Returns the nearest points of a face and of one of a mesh that a pose places: both in the frame of the first mesh.
#[must_use]
#[inline]
pub fn pair_closest_points<S: Scalar>(
    first: Triangle3<S>,
    second: Triangle3<S>,
    pose: Pose3<S>,
) -> PointPair3<S> {
    closest_points(first, pose * second)
}

/// Distances of solids: of the faces of the mesh, not of the volume inside, so that a solid that no face meets has a
/// distance, also inside.
impl<S: Scalar<Mask = bool>> MeshSurface<'_, S> {
    /// Returns the face that is nearest to a solid, among equal ones, such as all that it meets, that of lowest index.
    #[must_use]
    pub fn nearest_face_to(&self, solid: impl MeshSolid<S>) -> u32 {
        nearest_to(visit_faces::<Plain>, self, &solid).unwrap_or(0)
    }
    /// Returns the distance of a solid from the mesh, at least 0: 0 where a face meets the solid. Kinks: contact, with
    /// derivative zero, and solids with several nearest faces, where it is that of the lowest one.
    ///
    /// ```
    /// use geograd::mesh::{Mesh, MeshTree};
    /// use geograd::{Capsule3, Vec3};
    /// let vertices = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 4.0, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
    /// let mesh = Mesh::new(&vertices, &[[0, 1, 2]])?;
    /// let tree = MeshTree::new(&mesh);
    /// let surface = tree.on(&mesh)?;
    /// let finger = Capsule3::new(Vec3::new(1.0, 1.0, 1.0), Vec3::new(1.0, 1.0, 9.0), 0.25);
    /// assert_eq!(surface.distance_to(finger), 0.75);
    /// assert_eq!(surface.closest_points_to(finger).on_a, Vec3::new(1.0, 1.0, 0.0));
    /// assert!(surface.is_touching(Capsule3::new(finger.start, finger.end, 1.25)));
    /// # Ok::<(), geograd::mesh::MeshFault>(())
    /// ```
    #[must_use]
    pub fn distance_to(&self, solid: impl MeshSolid<S>) -> S {
        let face = self.nearest_face_to(solid);
        solid.distance_from(self.mesh().triangle(face))
    }
    /// Returns the nearest points of the mesh and a solid. Where they meet these are the points of the lowest face that
    /// does: see [`closest_points`].
    #[must_use]
    pub fn closest_points_to(&self, solid: impl MeshSolid<S>) -> PointPair3<S> {
        let face = self.nearest_face_to(solid);
        solid.closest_from(self.mesh().triangle(face))
    }
    /// Returns `true` if a face meets a solid: if the distance of one is 0. It ends at the first such face.
    #[must_use]
    pub fn is_touching(&self, solid: impl MeshSolid<S>) -> bool {
        !faces_within(visit_faces::<Plain>, self, &solid, 0.0, Some(1)).is_empty()
    }
    /// Returns the faces whose distance from a solid is at most `most`, in their order. None for a number below zero.
    #[must_use]
    pub fn faces_within(&self, solid: impl MeshSolid<S>, most: S) -> Vec<u32> {
        let most = most.widened().unwrap_or(f64::NAN);
        faces_within(visit_faces::<Plain>, self, &solid, most, None)
    }
}

/// Distances of another mesh, which a pose places: from the frame of the other one to that of this one. Distances are
/// of faces: a mesh inside of another one that no face meets has a distance.
impl<S: Scalar<Mask = bool>> MeshSurface<'_, S> {
    /// Returns the faces of this mesh and of another one that are nearest to each other: among equal ones, such as all
    /// that meet, the lowest of this mesh, then the lowest of the other one.
    #[must_use]
    pub fn nearest_pair(&self, other: &MeshSurface<'_, S>, pose: Pose3<S>) -> FacePair {
        nearest_pair(visit_pairs::<Plain>, [self, other], pose).unwrap_or(FacePair::NONE)
    }
    /// Returns the distance of another mesh, at least 0: 0 where faces meet. Kinks: contact, with derivative zero, and
    /// several nearest pairs, where it is that of the lowest one.
    ///
    /// ```
    /// use geograd::mesh::{FacePair, Mesh, MeshTree};
    /// use geograd::{Pose3, Rotation3, Vec3};
    /// let vertices = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 4.0, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
    /// let mesh = Mesh::new(&vertices, &[[0, 1, 2]])?;
    /// let tree = MeshTree::new(&mesh);
    /// let surface = tree.on(&mesh)?;
    /// let above = Pose3::new(Vec3::new(0.5, 0.5, 2.0), Rotation3::identity());
    /// assert_eq!(surface.nearest_pair(&surface, above), FacePair { first: 0, second: 0 });
    /// assert_eq!(surface.distance_between(&surface, above), 2.0);
    /// assert!(surface.is_meeting(&surface, Pose3::identity()));
    /// # Ok::<(), geograd::mesh::MeshFault>(())
    /// ```
    #[must_use]
    pub fn distance_between(&self, other: &MeshSurface<'_, S>, pose: Pose3<S>) -> S {
        let FacePair { first, second } = self.nearest_pair(other, pose);
        pair_distance(
            self.mesh().triangle(first),
            other.mesh().triangle(second),
            pose,
        )
    }
    /// Returns the nearest points of this mesh and of another one, both in the frame of this one.
    #[must_use]
    pub fn closest_points_between(
        &self,
        other: &MeshSurface<'_, S>,
        pose: Pose3<S>,
    ) -> PointPair3<S> {
        let FacePair { first, second } = self.nearest_pair(other, pose);
        pair_closest_points(
            self.mesh().triangle(first),
            other.mesh().triangle(second),
            pose,
        )
    }
    /// Returns `true` if faces of both meshes meet: if the distance of two is 0. It ends at the first such pair.
    #[must_use]
    pub fn is_meeting(&self, other: &MeshSurface<'_, S>, pose: Pose3<S>) -> bool {
        !pairs_within(visit_pairs::<Plain>, [self, other], pose, 0.0, Some(1)).is_empty()
    }
    /// Returns the pairs of faces whose distance is at most `most`, in their order. None for a number below zero.
    #[must_use]
    pub fn pairs_within(
        &self,
        other: &MeshSurface<'_, S>,
        pose: Pose3<S>,
        most: S,
    ) -> Vec<FacePair> {
        let most = most.widened().unwrap_or(f64::NAN);
        pairs_within(visit_pairs::<Plain>, [self, other], pose, most, None)
    }
}
