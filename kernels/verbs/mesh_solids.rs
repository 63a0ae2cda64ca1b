//! Distances of many solids and of many poses of a mesh from one mesh, with derivatives for solids, poses and vertices.
//!
//! A search gives records, as in [`mesh_batches`](crate::kernels::cpu::mesh_batches): faces that are nearest to solids,
//! or pairs of faces. Results are in the order of the solids or poses, each with the bits of the [`MeshSurface`]'s
//! function for one. Derivatives are those of [`aligned`](Cpu::aligned) batches of the distances of these faces;
//! cotangents of vertices are added in that order, in double precision, so that bits are equal for any number of
//! threads.
//!
//! ```
//! use geograd::kernels::Cpu;
//! use geograd::mesh::{FacePair, Mesh, MeshTree};
//! use geograd::{Pose3, Rotation3, Sphere, Vec3};
//! let vertices = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 4.0, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
//! let mesh = Mesh::new(&vertices, &[[0, 1, 2]])?;
//! let tree = MeshTree::new(&mesh);
//! let surface = tree.on(&mesh)?;
//! let cpu = Cpu::new();
//!
//! let balls = [2.0, 4.0].map(|z| Sphere::new(Vec3::new(1.0, 1.0, z), 0.5));
//! let faces = cpu.nearest_faces_to(&surface, &balls)?;
//! assert_eq!(cpu.solid_distances(&surface, &balls, &faces)?, [1.5, 3.5]);
//! let bars = cpu.solid_distances_vjp(&surface, &balls, &faces, &[1.0, 1.0])?;
//! assert_eq!(bars.queries[1], Sphere::new(Vec3::new(0.0, 0.0, 1.0), -1.0));
//! assert_eq!(bars.vertices[1], Vec3::new(0.0, 0.0, -0.5));
//!
//! let poses = [3.0, 0.0].map(|z| Pose3::new(Vec3::new(0.0, 0.0, z), Rotation3::identity()));
//! let pairs = cpu.nearest_pairs(&surface, &surface, &poses)?;
//! assert_eq!(cpu.pair_distances([&surface; 2], &poses, &pairs)?, [3.0, 0.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
use crate::distance3::{PointPair3, closest_points, distance};
use crate::error::{Argument, Error, Field, Flaw};
use crate::kernels::call::modes::Function;
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::mesh_batches::{MeshBars, check, each};
use crate::kernels::machine::Indexed;
use crate::kernels::row::item::Single;
use crate::kernels::row::item::counts::expect;
use crate::kernels::verbs::{Arguments, Distance, function};
use crate::mesh::{FacePair, Mesh, MeshSolid, MeshSurface, pair_closest_points, pair_distance};
use crate::mesh::{faces_within, nearest_pair, nearest_to, pairs_within};
use crate::{
    Aabb3, Capsule3, Hull3, Obb3, Pose3, Real, RoundBox3, Scalar, Segment3, Sphere, Tetrahedron,
    Triangle3, Validate, Vec3,
};

/// The number of solids from which on a batch computes their distances: its program is made for each call.
const BATCH: usize = 64;

/// Faces of a mesh as a column over its vertices.
pub type FaceColumn<'a, T> = Indexed<'a, Vec3<T>, [u32; 3]>;

/// A solid whose distances from faces have derivatives in batches.
pub trait SolidItem<T: Real + Single>: MeshSolid<T> + Single<Scalar = T> + Validate {
    /// Returns the distances of solids from faces by a batch; `None` of solids that are as fast one by one.
    fn distances(
        _cpu: &Cpu,
        _faces: FaceColumn<'_, T>,
        _solids: &[Self],
    ) -> Option<Result<Vec<T>, Error>> {
        None
    }
    /// Returns the adjoint of [`distance_from`](MeshSolid::distance_from).
    fn distance_vjp() -> impl Function<((Triangle3<T>, Self), T), Out = (Triangle3<T>, Self)>;
}

/// A solid whose nearest points have derivatives in batches: each but hulls, whose nearest points have none as a batch.
pub trait SolidPoints<T: Real + Single>: SolidItem<T> {
    /// Returns the adjoint of [`closest_from`](MeshSolid::closest_from).
    fn closest_vjp()
    -> impl Function<((Triangle3<T>, Self), PointPair3<T>), Out = (Triangle3<T>, Self)>;
}

macro_rules! solid_items {
    ($($Shape:ident)*) => { $(
        impl<T: Real + Single> SolidItem<T> for $Shape<T> {
            fn distances(cpu: &Cpu, faces: FaceColumn<'_, T>, solids: &[Self]) -> Option<Result<Vec<T>, Error>> {
                let run = function::<_, Arguments<2>>(|face: Triangle3<_>, solid: $Shape<_>| distance(face, solid));
                Some(cpu.aligned(run, (faces, solids)))
            }
            fn distance_vjp()
            -> impl Function<((Triangle3<T>, Self), T), Out = (Triangle3<T>, Self)> {
                function::<_, Arguments<2>>(|face: Triangle3<_>, solid: $Shape<_>| distance(face, solid)).vjp()
            }
        }
        impl<T: Real + Single> SolidPoints<T> for $Shape<T> {
            fn closest_vjp()
            -> impl Function<((Triangle3<T>, Self), PointPair3<T>), Out = (Triangle3<T>, Self)> {
                function::<_, Arguments<2>>(|face: Triangle3<_>, solid: $Shape<_>| closest_points(face, solid)).vjp()
            }
        }
    )* };
}
solid_items! { Sphere Segment3 Capsule3 Triangle3 Tetrahedron Aabb3 Obb3 RoundBox3 }

impl<T: Real + Single, const N: usize> SolidItem<T> for Hull3<T, N> {
    fn distance_vjp() -> impl Function<((Triangle3<T>, Self), T), Out = (Triangle3<T>, Self)> {
        Distance.row::<(Triangle3<T>, Hull3<T, N>)>().vjp()
    }
}

/// Cotangents of poses and of the vertices of two meshes.
#[derive(Clone, Debug, PartialEq)]
pub struct PairBars<T> {
    /// One per pose.
    pub poses: Vec<Pose3<T>>,
    /// One per vertex of the first mesh, and of the second one in its own frame.
    pub vertices: [Vec<Vec3<T>>; 2],
}

impl Cpu {
    /// Returns the face that is nearest to each solid, among equal ones, such as all that it meets, that of lowest index.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a solid that is not valid, [`Error::TooLarge`] for more than 2³² solids, [`Error::Simd`].
    pub fn nearest_faces_to<T: Real + Single, B: SolidItem<T>>(
        &self,
        surface: &MeshSurface<'_, T>,
        solids: &[B],
    ) -> Result<Vec<u32>, Error> {
        check("solids", solids)?;
        Ok(each(solids.len(), 0, |i| {
            nearest_to(kernels_in::<T>().visit_faces, surface, &solids[i]).unwrap_or(0)
        }))
    }

    /// Returns the distance of each solid from the mesh, along the records of a search; 0 where they meet.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a solid that is not valid and for a face that the mesh does not have, [`Error::Length`] unless
    /// there is one face per solid.
    pub fn solid_distances<T: Real + Single, B: SolidItem<T>>(
        &self,
        surface: &MeshSurface<'_, T>,
        solids: &[B],
        faces: &[u32],
    ) -> Result<Vec<T>, Error> {
        check_faces(surface, solids, faces)?;
        if solids.len() >= BATCH {
            let corners = corners(surface.mesh(), faces.iter().copied());
            let column = Indexed::unchecked(surface.mesh().vertices(), &corners);
            if let Some(all) = B::distances(self, column, solids) {
                return all;
            }
        }
        Ok(each(solids.len(), T::nearest(0.0), |i| {
            solids[i].distance_from(surface.mesh().triangle(faces[i]))
        }))
    }

    /// Returns the cotangents of solids and vertices from those of [`solid_distances`](Cpu::solid_distances).
    ///
    /// # Errors
    ///
    /// As [`solid_distances`](Cpu::solid_distances), and [`Error::Length`] unless there is one cotangent per solid,
    /// [`Error::Invalid`] for one that is not finite.
    pub fn solid_distances_vjp<T: Real + Single, B: SolidItem<T>>(
        &self,
        surface: &MeshSurface<'_, T>,
        solids: &[B],
        faces: &[u32],
        upstream: &[T],
    ) -> Result<MeshBars<B, T>, Error> {
        self.solid_bars(B::distance_vjp(), surface, (solids, faces), upstream)
    }

    /// Returns the nearest points of the mesh and each solid, along the records of a search.
    ///
    /// # Errors
    ///
    /// As [`solid_distances`](Cpu::solid_distances).
    pub fn solid_closest_points<T: Real + Single, B: SolidItem<T>>(
        &self,
        surface: &MeshSurface<'_, T>,
        solids: &[B],
        faces: &[u32],
    ) -> Result<Vec<PointPair3<T>>, Error> {
        check_faces(surface, solids, faces)?;
        Ok(each(solids.len(), no_points(), |i| {
            solids[i].closest_from(surface.mesh().triangle(faces[i]))
        }))
    }

    /// Returns the cotangents of solids and vertices from those of [`solid_closest_points`](Cpu::solid_closest_points).
    ///
    /// # Errors
    ///
    /// As [`solid_distances_vjp`](Cpu::solid_distances_vjp).
    pub fn solid_closest_points_vjp<T: Real + Single, B: SolidPoints<T>>(
        &self,
        surface: &MeshSurface<'_, T>,
        solids: &[B],
        faces: &[u32],
        upstream: &[PointPair3<T>],
    ) -> Result<MeshBars<B, T>, Error> {
        self.solid_bars(B::closest_vjp(), surface, (solids, faces), upstream)
    }

    /// Returns `true` for each solid that a face meets: see [`MeshSurface::is_touching`].
    ///
    /// # Errors
    ///
    /// As [`nearest_faces_to`](Cpu::nearest_faces_to).
    pub fn touching<T: Real + Single, B: SolidItem<T>>(
        &self,
        surface: &MeshSurface<'_, T>,
        solids: &[B],
    ) -> Result<Vec<bool>, Error> {
        check("solids", solids)?;
        let visit = kernels_in::<T>().visit_faces;
        Ok(each(solids.len(), false, |i| {
            !faces_within(visit, surface, &solids[i], 0.0, Some(1)).is_empty()
        }))
    }

    /// Returns the faces whose distance from each solid is at most `most`, in their order.
    ///
    /// # Errors
    ///
    /// As [`nearest_faces_to`](Cpu::nearest_faces_to), and [`Error::Invalid`] for a distance below zero or NaN.
    pub fn faces_within<T: Real + Single, B: SolidItem<T>>(
        &self,
        surface: &MeshSurface<'_, T>,
        solids: &[B],
        most: T,
    ) -> Result<Vec<Vec<u32>>, Error> {
        check("solids", solids)?;
        let most = check_most(most)?;
        Ok(each(solids.len(), Vec::new(), |i| {
            faces_within(
                kernels_in::<T>().visit_faces,
                surface,
                &solids[i],
                most,
                None,
            )
        }))
    }

    /// Returns the faces of two meshes that are nearest to each other for each pose, from the frame of the second mesh to
    /// that of the first one: among equal ones the lowest of the first mesh, then of the second one.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a pose that is not valid, [`Error::TooLarge`] for more than 2³² poses, [`Error::Simd`].
    pub fn nearest_pairs<T: Real + Single>(
        &self,
        first: &MeshSurface<'_, T>,
        second: &MeshSurface<'_, T>,
        poses: &[Pose3<T>],
    ) -> Result<Vec<FacePair>, Error> {
        check("poses", poses)?;
        Ok(each(poses.len(), FacePair::NONE, |i| {
            let visit = kernels_in::<T>().visit_pairs;
            nearest_pair(visit, [first, second], poses[i]).unwrap_or(FacePair::NONE)
        }))
    }

    /// Returns the distance of two meshes for each pose, along the records of a search; 0 where they meet.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a pose that is not valid and for a pair of faces that the meshes do not have,
    /// [`Error::Length`] unless there is one pair per pose.
    pub fn pair_distances<T: Real + Single>(
        &self,
        surfaces: [&MeshSurface<'_, T>; 2],
        poses: &[Pose3<T>],
        pairs: &[FacePair],
    ) -> Result<Vec<T>, Error> {
        check_pairs(surfaces, poses, pairs)?;
        Ok(each(poses.len(), T::nearest(0.0), |i| {
            let [first, second] = faces_of(surfaces, pairs[i]);
            pair_distance(first, second, poses[i])
        }))
    }

    /// Returns the cotangents of poses and of the vertices of both meshes from those of
    /// [`pair_distances`](Cpu::pair_distances).
    ///
    /// # Errors
    ///
    /// As [`pair_distances`](Cpu::pair_distances), and [`Error::Length`] unless there is one cotangent per pose,
    /// [`Error::Invalid`] for one that is not finite.
    pub fn pair_distances_vjp<T: Real + Single>(
        &self,
        surfaces: [&MeshSurface<'_, T>; 2],
        poses: &[Pose3<T>],
        pairs: &[FacePair],
        upstream: &[T],
    ) -> Result<PairBars<T>, Error> {
        let run =
            function::<_, Arguments<3>>(|a: Triangle3<_>, b: Triangle3<_>, pose: Pose3<_>| {
                pair_distance(a, b, pose)
            })
            .vjp();
        self.pair_bars(run, surfaces, (poses, pairs), upstream)
    }

    /// Returns the nearest points of two meshes for each pose, both in the frame of the first one.
    ///
    /// # Errors
    ///
    /// As [`pair_distances`](Cpu::pair_distances).
    pub fn pair_closest_points<T: Real + Single>(
        &self,
        surfaces: [&MeshSurface<'_, T>; 2],
        poses: &[Pose3<T>],
        pairs: &[FacePair],
    ) -> Result<Vec<PointPair3<T>>, Error> {
        check_pairs(surfaces, poses, pairs)?;
        Ok(each(poses.len(), no_points(), |i| {
            let [first, second] = faces_of(surfaces, pairs[i]);
            pair_closest_points(first, second, poses[i])
        }))
    }

    /// Returns the cotangents of poses and of the vertices of both meshes from those of
    /// [`pair_closest_points`](Cpu::pair_closest_points).
    ///
    /// # Errors
    ///
    /// As [`pair_distances_vjp`](Cpu::pair_distances_vjp).
    pub fn pair_closest_points_vjp<T: Real + Single>(
        &self,
        surfaces: [&MeshSurface<'_, T>; 2],
        poses: &[Pose3<T>],
        pairs: &[FacePair],
        upstream: &[PointPair3<T>],
    ) -> Result<PairBars<T>, Error> {
        let run =
            function::<_, Arguments<3>>(|a: Triangle3<_>, b: Triangle3<_>, pose: Pose3<_>| {
                pair_closest_points(a, b, pose)
            })
            .vjp();
        self.pair_bars(run, surfaces, (poses, pairs), upstream)
    }

    /// Returns `true` for each pose at which faces of both meshes meet: see [`MeshSurface::is_meeting`].
    ///
    /// # Errors
    ///
    /// As [`nearest_pairs`](Cpu::nearest_pairs).
    pub fn meeting<T: Real + Single>(
        &self,
        first: &MeshSurface<'_, T>,
        second: &MeshSurface<'_, T>,
        poses: &[Pose3<T>],
    ) -> Result<Vec<bool>, Error> {
        check("poses", poses)?;
        Ok(each(poses.len(), false, |i| {
            let visit = kernels_in::<T>().visit_pairs;
            !pairs_within(visit, [first, second], poses[i], 0.0, Some(1)).is_empty()
        }))
    }

    /// Returns the pairs of faces whose distance is at most `most` for each pose, in their order.
    ///
    /// # Errors
    ///
    /// As [`nearest_pairs`](Cpu::nearest_pairs), and [`Error::Invalid`] for a distance below zero or NaN.
    pub fn pairs_within<T: Real + Single>(
        &self,
        [first, second]: [&MeshSurface<'_, T>; 2],
        poses: &[Pose3<T>],
        most: T,
    ) -> Result<Vec<Vec<FacePair>>, Error> {
        check("poses", poses)?;
        let most = check_most(most)?;
        Ok(each(poses.len(), Vec::new(), |i| {
            let visit = kernels_in::<T>().visit_pairs;
            pairs_within(visit, [first, second], poses[i], most, None)
        }))
    }

    /// Returns the cotangents of solids and vertices by an adjoint.
    fn solid_bars<T: Real + Single, B: SolidItem<T>, Y: Single<Scalar = T>>(
        &self,
        run: impl Function<((Triangle3<T>, B), Y), Out = (Triangle3<T>, B)>,
        surface: &MeshSurface<'_, T>,
        (solids, faces): (&[B], &[u32]),
        upstream: &[Y],
    ) -> Result<MeshBars<B, T>, Error> {
        check_faces(surface, solids, faces)?;
        expect(Argument::Upstream, solids.len(), upstream.len())?;
        let corners = corners(surface.mesh(), faces.iter().copied());
        let column = Indexed::unchecked(surface.mesh().vertices(), &corners);
        let (by_face, queries) = self.aligned(run, ((column, solids), upstream))?;
        let vertices = column.gathered(&by_face)?;
        Ok(MeshBars { queries, vertices })
    }

    /// Returns the cotangents of poses and vertices by an adjoint.
    fn pair_bars<T: Real + Single, Y: Single<Scalar = T>>(
        &self,
        run: impl Function<(Faces<T>, Y), Out = Faces<T>>,
        surfaces: [&MeshSurface<'_, T>; 2],
        (poses, pairs): (&[Pose3<T>], &[FacePair]),
        upstream: &[Y],
    ) -> Result<PairBars<T>, Error> {
        check_pairs(surfaces, poses, pairs)?;
        expect(Argument::Upstream, poses.len(), upstream.len())?;
        let [first, second] = surfaces.map(MeshSurface::mesh);
        let firsts = corners(first, pairs.iter().map(|pair| pair.first));
        let seconds = corners(second, pairs.iter().map(|pair| pair.second));
        let (own, other) = (
            Indexed::unchecked(first.vertices(), &firsts),
            Indexed::unchecked(second.vertices(), &seconds),
        );
        let columns = ((own, other, poses), upstream);
        let (by_first, by_second, poses) = self.aligned(run, columns)?;
        let vertices = [own.gathered(&by_first)?, other.gathered(&by_second)?];
        Ok(PairBars { poses, vertices })
    }
}

/// The arguments of a distance of two meshes at a record.
type Faces<T> = (Triangle3<T>, Triangle3<T>, Pose3<T>);

/// Returns the indices of the corners of faces.
fn corners<T: Copy>(mesh: &Mesh<'_, T>, faces: impl Iterator<Item = u32>) -> Vec<[u32; 3]> {
    faces.map(|face| mesh.faces()[face as usize]).collect()
}

fn faces_of<T: Scalar>(surfaces: [&MeshSurface<'_, T>; 2], pair: FacePair) -> [Triangle3<T>; 2] {
    let [first, second] = surfaces;
    [
        first.mesh().triangle(pair.first),
        second.mesh().triangle(pair.second),
    ]
}

fn no_points<T: Real + Single>() -> PointPair3<T> {
    PointPair3 {
        on_a: Vec3::zero(),
        on_b: Vec3::zero(),
    }
}

fn broken(argument: &'static str, item: usize, rule: &'static str) -> Error {
    Error::Invalid {
        argument: Argument::Named(argument),
        item,
        flaw: Flaw::Broken(Field::VALUE, rule),
    }
}

/// Returns a number as a plain one.
fn check_most<T: Real + Single>(most: T) -> Result<f64, Error> {
    match most.widen() {
        most if most >= 0.0 => Ok(most),
        _ => Err(broken("most", 0, "is negative or not a number")),
    }
}

fn check_faces<T: Real + Single, B: SolidItem<T>>(
    surface: &MeshSurface<'_, T>,
    solids: &[B],
    faces: &[u32],
) -> Result<(), Error> {
    check("solids", solids)?;
    expect(Argument::Named("faces"), solids.len(), faces.len())?;
    let count = surface.mesh().faces().len();
    match faces.iter().position(|&face| face as usize >= count) {
        Some(item) => Err(broken("faces", item, "is not a face of the mesh")),
        None => Ok(()),
    }
}

fn check_pairs<T: Real + Single>(
    surfaces: [&MeshSurface<'_, T>; 2],
    poses: &[Pose3<T>],
    pairs: &[FacePair],
) -> Result<(), Error> {
    check("poses", poses)?;
    expect(Argument::Named("pairs"), poses.len(), pairs.len())?;
    let [first, second] = surfaces.map(|surface| surface.mesh().faces().len());
    let is_unknown =
        |pair: &FacePair| pair.first as usize >= first || pair.second as usize >= second;
    match pairs.iter().position(is_unknown) {
        Some(item) => Err(broken("pairs", item, "is not a face of each mesh")),
        None => Ok(()),
    }
}
