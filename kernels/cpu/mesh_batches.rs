//! Queries of many points and rays in one mesh, with derivatives for the queries and for the vertices.
//!
//! One search serves any number of replays and adjoints: [`Cpu::nearest_faces`] and [`Cpu::hit_faces`] give records,
//! which the others take. Results are in the order of the queries, each with the bits of the
//! [`MeshSurface`]'s function for one. Cotangents of vertices are added in the order of the queries, in double
//! precision, so that bits are equal for any number of threads.
//!
//! ```
//! use geograd::Vec3;
//! use geograd::kernels::Cpu;
//! use geograd::kernels::cpu::mesh_batches::MeshDistance;
//! use geograd::mesh::{Mesh, MeshTree};
//! let vertices = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 4.0, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
//! let mesh = Mesh::new(&vertices, &[[0, 1, 2]])?;
//! let tree = MeshTree::new(&mesh);
//! let surface = tree.on(&mesh)?;
//! let points = [Vec3::new(1.0, 1.0, 2.0), Vec3::new(1.0, -3.0, 0.0)];
//!
//! let cpu = Cpu::new();
//! let records = cpu.nearest_faces(&surface, &points)?;
//! let apart = MeshDistance::Plain;
//! assert_eq!(cpu.mesh_distances(apart, &surface, &points, &records)?, [2.0, 3.0]);
//! let bars = cpu.mesh_distances_vjp(apart, &surface, &points, &records, &[1.0, 1.0])?;
//! assert_eq!(bars.queries, [Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.0, -1.0, 0.0)]);
//! assert_eq!(bars.vertices[2], Vec3::new(0.0, 0.0, -0.25));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
use crate::ad::adjoint::face_replay::{
    FaceBars, closest_vjp, distance_vjp, height_vjp, hit_vjp, no_hit, squared_distance_vjp,
};
use crate::error::{Argument, Error, Field, Flaw, Validate};
use crate::intersection3::first_hit_triangle;
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::checked::check_upstream;
use crate::kernels::cpu::mesh_orders::{first_of_all, nearest_of_all};
use crate::kernels::cpu::simd::Simd;
use crate::kernels::cpu::work::{in_parallel, rows_per_piece};
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::rows::numbers;
use crate::mesh::{
    ClosedMesh, FaceFeature, FaceRecord, Mesh, MeshBorder, MeshHit, MeshSurface, closest_replay,
    distance_replay, plain, plain_ray, squared_distance_replay,
};
use crate::{Ray3, Real, Vec3};

/// A distance of a point from a mesh.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum MeshDistance<'a> {
    /// The [distance](MeshSurface::distance), at least 0.
    Plain,
    /// Its [square](MeshSurface::squared_distance).
    Squared,
    /// The [signed distance](MeshSurface::signed_distance), negative inside a closed mesh: of the faces of the surface.
    Signed(&'a ClosedMesh),
    /// The [distance](crate::mesh::WoundSurface::signed_distance) that is negative where the winding number is above ½:
    /// of the border of the surface.
    Wound(&'a MeshBorder),
}

/// Cotangents of queries and of the vertices of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshBars<Q, T> {
    /// One per query.
    pub queries: Vec<Q>,
    /// One per vertex.
    pub vertices: Vec<Vec3<T>>,
}

impl Cpu {
    /// Returns the face and the feature that are nearest to each point, among equal ones the face of lowest index.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a point that is not finite, [`Error::TooLarge`] for more than 2³² points, [`Error::Simd`].
    pub fn nearest_faces<T: Real>(
        &self,
        surface: &MeshSurface<'_, T>,
        points: &[Vec3<T>],
    ) -> Result<Vec<FaceRecord>, Error> {
        check("points", points)?;
        Ok(nearest_of_all(surface, points))
    }

    /// Returns the point of the mesh that is nearest to each point, along the records of a search.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a point that is not finite and for a record that names no face or no corner,
    /// [`Error::Length`] unless there is one record per point.
    pub fn closest_points<T: Real>(
        &self,
        surface: &MeshSurface<'_, T>,
        points: &[Vec3<T>],
        records: &[FaceRecord],
    ) -> Result<Vec<Vec3<T>>, Error> {
        check_records(surface, points, records)?;
        let mesh = surface.mesh();
        Ok(each(points.len(), Vec3::zero(), |i| {
            let FaceRecord { face, feature } = records[i];
            closest_replay(points[i], mesh.triangle(face), feature)
        }))
    }

    /// Returns the cotangents of points and vertices from those of [`closest_points`](Cpu::closest_points).
    ///
    /// # Errors
    ///
    /// As [`closest_points`](Cpu::closest_points), and [`Error::Length`] unless there is one cotangent per point,
    /// [`Error::Invalid`] for one that is not finite.
    pub fn closest_points_vjp<T: Real>(
        &self,
        surface: &MeshSurface<'_, T>,
        points: &[Vec3<T>],
        records: &[FaceRecord],
        upstream: &[Vec3<T>],
    ) -> Result<MeshBars<Vec3<T>, T>, Error> {
        check_records(surface, points, records)?;
        expect(Argument::Upstream, points.len(), upstream.len())?;
        check_upstream(&numbers(upstream), 3)?;
        let mesh = surface.mesh();
        let of = |i: usize| {
            let FaceRecord { face, feature } = records[i];
            let (point, bar) = (plain(points[i]), plain(upstream[i]));
            closest_vjp(point, mesh.plain_triangle(face), feature, bar)
        };
        let faces = records.iter().map(|record| Some(record.face));
        Ok(gathered(mesh, faces, Vec3::zero(), rounded, of))
    }

    /// Returns the distance of each point from the mesh, along the records of a search.
    ///
    /// # Errors
    ///
    /// As [`closest_points`](Cpu::closest_points), and [`Error::Invalid`] for a border of another mesh.
    pub fn mesh_distances<T: Real>(
        &self,
        kind: MeshDistance<'_>,
        surface: &MeshSurface<'_, T>,
        points: &[Vec3<T>],
        records: &[FaceRecord],
    ) -> Result<Vec<T>, Error> {
        check_records(surface, points, records)?;
        check_border(kind, surface)?;
        let mesh = surface.mesh();
        Ok(each(points.len(), T::zero(), |i| {
            let FaceRecord { face, feature } = records[i];
            let (point, triangle) = (points[i], mesh.triangle(face));
            match kind {
                MeshDistance::Plain => distance_replay(point, triangle, feature),
                MeshDistance::Squared => squared_distance_replay(point, triangle, feature),
                MeshDistance::Signed(closed) => surface.signed_replay(closed, point, records[i]),
                MeshDistance::Wound(border) => {
                    let distance = distance_replay(point, triangle, feature);
                    match is_wound(border, surface, point) {
                        true => -distance,
                        false => distance,
                    }
                }
            }
        }))
    }

    /// Returns the cotangents of points and vertices from those of [`mesh_distances`](Cpu::mesh_distances).
    ///
    /// # Errors
    ///
    /// As [`mesh_distances`](Cpu::mesh_distances), and [`Error::Length`] unless there is one cotangent per point,
    /// [`Error::Invalid`] for one that is not finite.
    pub fn mesh_distances_vjp<T: Real>(
        &self,
        kind: MeshDistance<'_>,
        surface: &MeshSurface<'_, T>,
        points: &[Vec3<T>],
        records: &[FaceRecord],
        upstream: &[T],
    ) -> Result<MeshBars<Vec3<T>, T>, Error> {
        check_records(surface, points, records)?;
        expect(Argument::Upstream, points.len(), upstream.len())?;
        check_upstream(upstream, 1)?;
        check_border(kind, surface)?;
        let mesh = surface.mesh();
        let of = |i: usize| {
            let FaceRecord { face, feature } = records[i];
            let (point, triangle) = (plain(points[i]), mesh.plain_triangle(face));
            let bar = upstream[i].widen();
            match kind {
                MeshDistance::Plain => distance_vjp(point, triangle, feature, bar),
                MeshDistance::Squared => squared_distance_vjp(point, triangle, feature, bar),
                MeshDistance::Signed(closed) => {
                    let is_on = || {
                        let distance = distance_replay(points[i], mesh.triangle(face), feature);
                        distance.equals(T::zero())
                    };
                    if feature == FaceFeature::Interior || is_on() {
                        return height_vjp(point, triangle, bar);
                    }
                    let is_inside = surface.is_inside(closed, points[i], records[i]);
                    let bar = if is_inside { -bar } else { bar };
                    distance_vjp(point, triangle, feature, bar)
                }
                MeshDistance::Wound(border) => {
                    let is_inside = is_wound(border, surface, points[i]);
                    let bar = if is_inside { -bar } else { bar };
                    distance_vjp(point, triangle, feature, bar)
                }
            }
        };
        let faces = records.iter().map(|record| Some(record.face));
        Ok(gathered(mesh, faces, Vec3::zero(), rounded, of))
    }

    /// Returns the face that each ray meets first, among equal ones that of lowest index; `None` for a miss.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a ray that is not valid, [`Error::TooLarge`] for more than 2³² rays, [`Error::Simd`].
    pub fn hit_faces<T: Real>(
        &self,
        surface: &MeshSurface<'_, T>,
        rays: &[Ray3<T>],
    ) -> Result<Vec<Option<u32>>, Error> {
        check("rays", rays)?;
        Ok(first_of_all(surface, rays, |_, face| face))
    }

    /// Returns the face that each ray meets first, and the parameter there; `None` for a miss. The same as
    /// [`hit_faces`](Cpu::hit_faces) and [`first_hits`](Cpu::first_hits), in one pass.
    ///
    /// # Errors
    ///
    /// As [`hit_faces`](Cpu::hit_faces).
    pub fn hit_parameters<T: Real>(
        &self,
        surface: &MeshSurface<'_, T>,
        rays: &[Ray3<T>],
    ) -> Result<Vec<Option<(u32, T)>>, Error> {
        check("rays", rays)?;
        let mesh = surface.mesh();
        Ok(first_of_all(surface, rays, |ray, face| {
            let hit = first_hit_triangle(ray, mesh.triangle(face));
            (face, hit.parameter)
        }))
    }

    /// Returns the faces that each ray meets, in the order of [`MeshSurface::all_hit_faces`].
    ///
    /// # Errors
    ///
    /// As [`hit_faces`](Cpu::hit_faces).
    pub fn all_hit_faces<T: Real>(
        &self,
        surface: &MeshSurface<'_, T>,
        rays: &[Ray3<T>],
    ) -> Result<Vec<Vec<u32>>, Error> {
        check("rays", rays)?;
        Ok(each(rays.len(), Vec::new(), |i| {
            surface.all_hit_faces(rays[i])
        }))
    }

    /// Returns where each ray meets the face that a search gave.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a ray that is not valid and for a face that the mesh does not have, [`Error::Length`] unless
    /// there is one record per ray.
    pub fn first_hits<T: Real>(
        &self,
        surface: &MeshSurface<'_, T>,
        rays: &[Ray3<T>],
        faces: &[Option<u32>],
    ) -> Result<Vec<Option<MeshHit<T>>>, Error> {
        check_faces(surface, rays, faces)?;
        Ok(each(rays.len(), None, |i| {
            let face = faces[i]?;
            let hit = first_hit_triangle(rays[i], surface.mesh().triangle(face));
            Some(MeshHit { face, hit })
        }))
    }

    /// Returns the cotangents of rays and vertices from those of the parameters of [`first_hits`](Cpu::first_hits), which
    /// are ignored for misses.
    ///
    /// The point of a hit is the ray's start plus the direction times the parameter. So its cotangent `c` is one of the
    /// start, times the parameter one of the direction, and `c·direction` one of the parameter.
    ///
    /// # Errors
    ///
    /// As [`first_hits`](Cpu::first_hits), and [`Error::Length`] unless there is one cotangent per ray,
    /// [`Error::Invalid`] for one that is not finite.
    pub fn first_hits_vjp<T: Real>(
        &self,
        surface: &MeshSurface<'_, T>,
        rays: &[Ray3<T>],
        faces: &[Option<u32>],
        upstream: &[T],
    ) -> Result<MeshBars<Ray3<T>, T>, Error> {
        check_faces(surface, rays, faces)?;
        expect(Argument::Upstream, rays.len(), upstream.len())?;
        check_upstream(upstream, 1)?;
        let mesh = surface.mesh();
        let of = |i: usize| {
            let Some(face) = faces[i] else {
                return no_hit();
            };
            let triangle = mesh.plain_triangle(face);
            hit_vjp(plain_ray(rays[i]), triangle, upstream[i].widen())
        };
        let round = |ray: Ray3<f64>| Ray3 {
            point: rounded(ray.point),
            direction: rounded(ray.direction),
        };
        let none = round(no_hit().query);
        Ok(gathered(mesh, faces.iter().copied(), none, round, of))
    }
}

/// Returns `true` where a mesh goes around a point; its border has been checked.
fn is_wound<T: Real>(border: &MeshBorder, surface: &MeshSurface<'_, T>, point: Vec3<T>) -> bool {
    border.of(surface).is_ok_and(|wound| wound.is_inside(point))
}

fn check_border<T: Real>(
    kind: MeshDistance<'_>,
    surface: &MeshSurface<'_, T>,
) -> Result<(), Error> {
    match kind {
        MeshDistance::Wound(border) if border.of(surface).is_err() => {
            Err(unknown("border", 0, "is of another mesh"))
        }
        _ => Ok(()),
    }
}

/// Checks queries, each by its own rules.
pub(crate) fn check<Q: Validate>(name: &'static str, queries: &[Q]) -> Result<(), Error> {
    Simd::current()?;
    if queries.len() > u32::MAX as usize {
        return Err(Error::TooLarge);
    }
    for (item, query) in queries.iter().enumerate() {
        query.validate().map_err(|flaw| Error::Invalid {
            argument: Argument::Named(name),
            item,
            flaw,
        })?;
    }
    Ok(())
}

fn unknown(argument: &'static str, item: usize, rule: &'static str) -> Error {
    Error::Invalid {
        argument: Argument::Named(argument),
        item,
        flaw: Flaw::Broken(Field::VALUE, rule),
    }
}

fn check_records<T: Real>(
    surface: &MeshSurface<'_, T>,
    points: &[Vec3<T>],
    records: &[FaceRecord],
) -> Result<(), Error> {
    check("points", points)?;
    expect(Argument::Named("records"), points.len(), records.len())?;
    let count = surface.mesh().faces().len();
    let is_known = |record: &FaceRecord| {
        let corners = match record.feature {
            FaceFeature::Interior => [0, 0],
            FaceFeature::Edge { from, to } => [from, to],
            FaceFeature::Vertex { corner } => [corner, 0],
        };
        (record.face as usize) < count && corners.iter().all(|&corner| corner < 3)
    };
    match records.iter().position(|record| !is_known(record)) {
        Some(item) => Err(unknown(
            "records",
            item,
            "is not a feature of a face of the mesh",
        )),
        None => Ok(()),
    }
}

fn check_faces<T: Real>(
    surface: &MeshSurface<'_, T>,
    rays: &[Ray3<T>],
    faces: &[Option<u32>],
) -> Result<(), Error> {
    check("rays", rays)?;
    expect(Argument::Named("faces"), rays.len(), faces.len())?;
    let count = surface.mesh().faces().len();
    let is_unknown = |face: &Option<u32>| face.is_some_and(|face| face as usize >= count);
    match faces.iter().position(is_unknown) {
        Some(item) => Err(unknown("faces", item, "is not a face of the mesh")),
        None => Ok(()),
    }
}

/// Returns the results of all items, computed on all threads.
pub(crate) fn each<R: Clone + Send>(
    count: usize,
    none: R,
    of: impl Fn(usize) -> R + Send + Sync,
) -> Vec<R> {
    let mut all = vec![none; count];
    let piece = rows_per_piece(count);
    let work = all.chunks_mut(piece).enumerate().collect();
    in_parallel(work, |(k, results): (usize, &mut [R])| {
        for (i, result) in results.iter_mut().enumerate() {
            *result = of(k * piece + i);
        }
    });
    all
}

/// Returns a vector in another format.
pub(super) fn rounded<T: Real>(v: Vec3<f64>) -> Vec3<T> {
    Vec3::new(T::nearest(v.x), T::nearest(v.y), T::nearest(v.z))
}

/// Returns the cotangents of all queries and of the vertices, added in the order of the queries.
fn gathered<T: Real, Q: Copy + Send, P: Copy + Send>(
    mesh: &Mesh<'_, T>,
    faces: impl Iterator<Item = Option<u32>>,
    none: Q,
    round: impl Fn(P) -> Q + Send + Sync,
    of: impl Fn(usize) -> FaceBars<P> + Send + Sync,
) -> MeshBars<Q, T> {
    let faces: Vec<Option<u32>> = faces.collect();
    let bars = each(faces.len(), (none, [Vec3::zero(); 3]), |i| {
        let bars = of(i);
        (round(bars.query), bars.corners)
    });
    let mut sums = vec![Vec3::zero(); mesh.vertices().len()];
    for (face, (_, corners)) in faces.into_iter().zip(&bars) {
        let Some(face) = face else { continue };
        for (&vertex, &bar) in mesh.faces()[face as usize].iter().zip(corners) {
            sums[vertex as usize] += bar;
        }
    }
    MeshBars {
        queries: bars.into_iter().map(|bar| bar.0).collect(),
        vertices: sums.into_iter().map(rounded).collect(),
    }
}
