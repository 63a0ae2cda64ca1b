//! Convex hulls of space that store their vertices inline.
use crate::error::{Flaw, Validate, VertexFault};
use crate::shape::{Aabb3, Obb3, Pose3, Tetrahedron};
use crate::{Scalar, Shape, Vec3};
use std::ops::Mul;

/// The convex hull of up to `N` points of space, without heap memory.
///
/// The first `count` vertices span it, in any order. Those inside, on faces or edges, and repeated ones change nothing.
/// All of them may be in a plane, on a line, or at one place. Valid when these are finite and at least one.
///
/// ```
/// use geograd::{Hull3, Vec3};
/// let [x, y, z] = [Vec3::new(2.0_f64, 0.0, 0.0), Vec3::new(0.0, 3.0, 0.0), Vec3::new(0.0, 0.0, 4.0)];
/// let wedge: Hull3<f64, 8> = Hull3::try_new(&[Vec3::zero(), x, y, z, (x + y) * 0.25])?;
/// assert!((wedge.volume() - 4.0).abs() < 1e-15);
/// assert_eq!(wedge.support(Vec3::new(0.0, 1.0, 0.0)), y);
/// assert!(wedge.contains(Vec3::new(1.0, 1.5, 0.0)));
/// # Ok::<(), geograd::Flaw>(())
/// ```
#[derive(Clone, Copy, Debug, Shape)]
#[repr(C)]
#[shape(except(Validate, Sample, Arbitrary))]
pub struct Hull3<S, const N: usize> {
    /// The vertices; the first `count` of them matter.
    pub vertices: [Vec3<S>; N],
    /// The number of vertices, from 1 to `N`.
    #[shape(code)]
    pub count: usize,
}

impl<S: PartialEq, const N: usize> PartialEq for Hull3<S, N> {
    /// Returns `true` if both have equal vertices in one order.
    fn eq(&self, other: &Self) -> bool {
        self.as_slice() == other.as_slice()
    }
}

impl<S, const N: usize> Hull3<S, N> {
    /// Returns the vertices.
    #[must_use]
    #[inline]
    pub fn as_slice(&self) -> &[Vec3<S>] {
        &self.vertices[..self.count.min(N)]
    }
}

impl<S: Scalar, const N: usize> Hull3<S, N> {
    /// Creates a hull of the first `N` of some points, unchecked.
    #[must_use]
    #[inline]
    pub fn from_vertices(vertices: &[Vec3<S>]) -> Self {
        let at = |k: usize| vertices.get(k).copied().unwrap_or(Vec3::zero());
        Hull3 {
            vertices: std::array::from_fn(at),
            count: vertices.len().min(N),
        }
    }
    /// Creates the hull of points.
    ///
    /// # Errors
    ///
    /// [`Flaw::Vertex`] with the first vertex at fault: not finite, beyond the capacity, or missing, of no points.
    pub fn try_new(vertices: &[Vec3<S>]) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        match vertices.len() > N {
            true => Err(overfull(N)),
            false => {
                let made = Self::from_vertices(vertices);
                made.validate().map(|()| made)
            }
        }
    }
    /// Returns the farthest point in a direction of any length; points that tie share the derivative equally, and the
    /// result is their mean. The origin for a hull without vertices.
    #[must_use]
    #[inline]
    pub fn support(&self, direction: Vec3<S>) -> Vec3<S> {
        let Some((&from, others)) = self.as_slice().split_first() else {
            return Vec3::zero();
        };
        let (mut best, mut sum, mut count) = (S::zero(), Vec3::zero(), S::one());
        for &vertex in others {
            let arm = vertex - from;
            let height = direction.dot(arm).primal();
            let height = S::from_primal(height);
            let (more, ties) = (best.below(height), height.equals(best));
            let joint = Vec3::select(ties, sum + arm, sum);
            sum = Vec3::select(more, arm, joint);
            count = S::select(more, S::one(), S::select(ties, count + S::one(), count));
            best = S::select(more, height, best);
        }
        from + sum * S::one().over(count)
    }
    /// Returns the smallest axis-aligned box around it, a point at the origin for no vertices; vertices that share a
    /// bound share its derivative equally.
    #[must_use]
    #[inline]
    pub fn bounding(&self) -> Aabb3<S> {
        let none = Aabb3::new(Vec3::zero(), Vec3::zero());
        Aabb3::around(self.as_slice()).unwrap_or(none)
    }
}

fn overfull(index: usize) -> Flaw {
    Flaw::Vertex {
        index,
        fault: VertexFault::Overfull,
    }
}

impl<S: Scalar<Mask = bool>, const N: usize> Validate for Hull3<S, N> {
    fn validate(&self) -> Result<(), Flaw> {
        let flaw = |index, fault| Err(Flaw::Vertex { index, fault });
        match self.count {
            0 => return flaw(0, VertexFault::Missing),
            count if count > N => return Err(overfull(N)),
            _ => {}
        }
        let lost = |vertex: &Vec3<S>| !vertex.is_finite();
        match self.as_slice().iter().position(lost) {
            Some(index) => flaw(index, VertexFault::NotFinite),
            None => Ok(()),
        }
    }
}

impl<S: Scalar, const N: usize> From<[Vec3<S>; N]> for Hull3<S, N> {
    /// Creates the hull of these points, unchecked.
    #[inline]
    fn from(vertices: [Vec3<S>; N]) -> Self {
        Hull3 { vertices, count: N }
    }
}
impl<S: Scalar> From<Tetrahedron<S>> for Hull3<S, 4> {
    /// Creates the hull of the tetrahedron's corners.
    #[inline]
    fn from(shape: Tetrahedron<S>) -> Self {
        shape.corners().into()
    }
}
impl<S: Scalar> From<Obb3<S>> for Hull3<S, 8> {
    /// Creates the hull of the box's corners.
    #[inline]
    fn from(shape: Obb3<S>) -> Self {
        shape.corners().into()
    }
}

impl<S: Scalar, const N: usize> Mul<Hull3<S, N>> for Pose3<S> {
    type Output = Hull3<S, N>;
    /// Returns the hull carried along.
    #[inline]
    fn mul(self, shape: Hull3<S, N>) -> Hull3<S, N> {
        let mut vertices = shape.vertices;
        for vertex in &mut vertices[..shape.count.min(N)] {
            *vertex = self * *vertex;
        }
        Hull3 { vertices, ..shape }
    }
}
