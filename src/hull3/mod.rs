//! Convex hulls of points of space: by exact decisions, which are recorded.
//!
//! A record ([`HullFaces`]) says which points are corners and which of them bound each face; measures replay it on
//! points of any scalar, so that derivatives go to the corners. Points inside, on faces and on edges, and repeated ones
//! but the first are no corners and have derivative zero. Points in a plane have a hull with two faces, one seen from
//! either side. [`Hull3`] is a hull as a shape, with distances.
//!
//! ```
//! use geograd::{Vec3, hull3::hull_search};
//! let corner = |k: i32| Vec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
//! let cube: Vec<_> = (0..8).map(corner).collect();
//! let mut points = cube.clone();
//! points.push(Vec3::new(0.5, 0.5, 1.0));
//! let faces = hull_search(&points);
//! assert_eq!((faces.corners().len(), faces.faces().count()), (8, 6));
//! assert!((faces.volume(&points) - 1.0).abs() < 1e-15 && (faces.surface(&points) - 6.0).abs() < 1e-14);
//! assert!((faces.centroid(&points) - Vec3::new(0.5, 0.5, 0.5)).length() < 1e-15);
//! ```
//!
//! Decisions are those of exact arithmetic on the given numbers, where sizes differ by less than 10⁷⁰. Values and
//! derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in `f32`, from
//! 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
mod faces_record;
mod orientation;
mod start;
mod surface;
mod triangles;

use crate::distance::edge::scale_of;
use crate::scalar::largest;
use crate::{Hull3, Scalar, Vec3};
pub(crate) use faces_record::HullFacesRecord;
pub(crate) use surface::{HullEdge, Surface};

/// The faces of the convex hull of points, by their numbers.
#[derive(Clone, Debug, Default)]
pub struct HullFaces(Surface);

/// Returns the faces of the convex hull of points. Points that are not finite have no hull.
///
/// The expected time is `O(n log n)`. Formats other than `f32`, `f64` and numbers with derivatives over these have no
/// hull.
#[must_use]
pub fn hull_search<S: Scalar<Mask = bool>>(points: &[Vec3<S>]) -> HullFaces {
    HullFaces(numbers(points).map_or_else(Surface::default, |points| Surface::of(&points)))
}

/// Returns points as plain numbers, exactly, in units of a power of two in which the largest coordinate is about one;
/// `None` where one is not finite.
pub(crate) fn numbers<S: Scalar<Mask = bool>>(points: &[Vec3<S>]) -> Option<Vec<Vec3<f64>>> {
    let wide = |Vec3 { x, y, z }: &Vec3<S>| {
        let point = Vec3::new(x.widened()?, y.widened()?, z.widened()?);
        point.is_finite().then_some(point)
    };
    let mut points: Vec<Vec3<f64>> = points.iter().map(wide).collect::<Option<_>>()?;
    let size = points
        .iter()
        .fold(0.0_f64, |most, p| most.max(largest([p.x, p.y, p.z])));
    let scale = scale_of::<f64>(size);
    for point in &mut points {
        *point = *point * scale;
    }
    Some(points)
}

impl HullFaces {
    /// Returns the numbers of the points that are corners, in increasing order.
    #[must_use]
    pub fn corners(&self) -> &[usize] {
        &self.0.corners
    }
    /// Returns the faces, each the numbers of its corners, counter-clockwise seen from outside. Those in one plane are
    /// one face.
    pub fn faces(&self) -> impl Iterator<Item = &[usize]> {
        self.0.facets()
    }
    /// Returns 0 if all points coincide, 1 for points on a line, 2 in a plane, else 3.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.0.dimension
    }
    /// Returns the volume of the hull, in cubed units of length. Kinks where a point passes through a face.
    ///
    /// # Panics
    ///
    /// When there are fewer points than were searched.
    #[must_use]
    pub fn volume<S: Scalar>(&self, points: &[Vec3<S>]) -> S {
        let Some(&first) = self.corners().first() else {
            return S::zero();
        };
        match self.0.dimension {
            3 => self.moments(points, points[first]).0.canonical(),
            _ => S::zero(),
        }
    }
    /// Returns the area of all faces, in squared units of length; of both sides of a flat hull. Kinks where a point
    /// passes through a face.
    ///
    /// # Panics
    ///
    /// When there are fewer points than were searched.
    #[must_use]
    pub fn surface<S: Scalar>(&self, points: &[Vec3<S>]) -> S {
        let areas = self.faces().map(|face| vector_area(face, points).length());
        areas.fold(S::zero(), |sum, area| sum + area).canonical()
    }
    /// Returns the centre of the volume; of a flat hull that of its area, of a segment the middle. The origin of no
    /// points.
    ///
    /// # Panics
    ///
    /// When there are fewer points than were searched.
    #[must_use]
    pub fn centroid<S: Scalar>(&self, points: &[Vec3<S>]) -> Vec3<S> {
        let Some(&first) = self.corners().first() else {
            return Vec3::zero();
        };
        let from = points[first];
        let mean = |sum: Vec3<S>, total: S| {
            let none = total.equals(S::zero());
            let total = S::select(none, S::one(), total);
            let arm = Vec3::new(sum.x.over(total), sum.y.over(total), sum.z.over(total));
            (from + Vec3::select(none, Vec3::zero(), arm)).canonical()
        };
        match (self.0.dimension, self.faces().next()) {
            (3, _) => {
                let (volume, moment) = self.moments(points, from);
                mean(moment, volume)
            }
            (2, Some(face)) => {
                let unit = vector_area(face, points).normalize_or_zero();
                let (mut area, mut moment) = (S::zero(), Vec3::zero());
                for pair in face[1..].windows(2) {
                    let [u, v] = [
                        points[pair[0]] - points[face[0]],
                        points[pair[1]] - points[face[0]],
                    ];
                    let part = u.cross(v).dot(unit);
                    area += part;
                    moment += (u + v) * (part * S::lit(1.0 / 3.0));
                }
                mean(moment + (points[face[0]] - from) * area, area)
            }
            (1, _) => mean(points[self.corners()[1]] - from, S::lit(2.0)),
            _ => from.canonical(),
        }
    }
    /// Returns the volume and its first moment relative to a point.
    fn moments<S: Scalar>(&self, points: &[Vec3<S>], from: Vec3<S>) -> (S, Vec3<S>) {
        let (mut volume, mut moment) = (S::zero(), Vec3::zero());
        for face in self.faces() {
            let a = points[face[0]] - from;
            for pair in face[1..].windows(2) {
                let [b, c] = [points[pair[0]] - from, points[pair[1]] - from];
                let part = (b - a).cross(c - a).dot(a) * S::lit(1.0 / 6.0);
                volume += part;
                moment += (a + b + c) * (part * S::lit(0.25));
            }
        }
        (volume, moment)
    }
}

/// Returns the vector along the normal of a face with its area as length.
fn vector_area<S: Scalar>(face: &[usize], points: &[Vec3<S>]) -> Vec3<S> {
    let from = points[face[0]];
    let mut sum = Vec3::zero();
    for pair in face[1..].windows(2) {
        sum += (points[pair[0]] - from).cross(points[pair[1]] - from);
    }
    sum * S::lit(0.5)
}

impl<S: Scalar<Mask = bool>, const N: usize> Hull3<S, N> {
    /// Returns its faces and corners, as numbers of vertices.
    #[must_use]
    pub fn faces(&self) -> HullFaces {
        hull_search(self.as_slice())
    }
    /// Returns the volume, in cubed units of length: [`HullFaces::volume`].
    #[must_use]
    pub fn volume(&self) -> S {
        self.faces().volume(self.as_slice())
    }
    /// Returns the area of the surface, in squared units of length: [`HullFaces::surface`].
    #[must_use]
    pub fn surface(&self) -> S {
        self.faces().surface(self.as_slice())
    }
    /// Returns the centre of the volume: [`HullFaces::centroid`].
    #[must_use]
    pub fn center(&self) -> Vec3<S> {
        self.faces().centroid(self.as_slice())
    }
    /// Returns `true` where the point is in the hull, which may be flat; the surface belongs to it. Exact, but `false`
    /// for formats other than `f32`, `f64` and numbers with derivatives over these.
    ///
    /// ```
    /// use geograd::{Hull3, Vec3};
    /// let [x, y] = [Vec3::new(3.0, 0.0, 0.1), Vec3::new(0.0, 3.0, 0.2)];
    /// let flat: Hull3<f64, 3> = Hull3::from([Vec3::zero(), x, y]);
    /// assert!(flat.contains(x * 0.5));
    /// assert!(!flat.contains(Vec3::new(1.5, 0.0, 0.05_f64.next_up())));
    /// ```
    #[must_use]
    pub fn contains(&self, point: Vec3<S>) -> bool {
        // The first of equal points is the corner, so that a point at a vertex is none.
        let mut all = self.as_slice().to_vec();
        all.push(point);
        let last = all.len() - 1;
        let known = numbers(&all).map(|points| Surface::of(&points));
        last > 0 && known.is_some_and(|surface| !surface.corners.contains(&last))
    }
}
