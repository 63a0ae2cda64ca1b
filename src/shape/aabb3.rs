//! Axis-aligned boxes in space.
use crate::scalar::Span;
use crate::{Aabb2, Scalar, Shape, Vec2, Vec3};

/// The corners of each face of a box, by their number in `corners()`, counter-clockwise seen from
/// outside: the faces at low x, high x, low y, high y, low z, high z.
///
/// Corner number `k` is on the high side along x, y and z where bit 0, 1 and 2 of `k` is set.
pub const FACES: [[usize; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// An axis-aligned box in space. Valid when finite and `min ≤ max`; zero size is valid.
///
/// ```
/// use geograd::{Aabb3, Vec3};
/// let a = Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 2.0, 2.0));
/// let b = Aabb3::new(Vec3::new(1.0, 1.0, 1.0), Vec3::new(3.0, 3.0, 3.0));
/// assert_eq!(a.meet(b).volume(), 1.0);
/// assert_eq!(a.surface(), 24.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding, except(Sample))]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Aabb3<S> {
    /// The lower bounds.
    #[shape(at_most = "max")]
    pub min: Vec3<S>,
    /// The upper bounds.
    pub max: Vec3<S>,
}

impl<S> Aabb3<S> {
    /// Creates a box from lower and upper bounds, unchecked.
    #[inline(always)]
    pub const fn new(min: Vec3<S>, max: Vec3<S>) -> Self {
        Aabb3 { min, max }
    }
}

impl<S: Scalar> Aabb3<S> {
    /// Returns the box itself.
    #[inline(always)]
    pub(crate) const fn bounding(self) -> Self {
        self
    }
    /// Returns the smallest box around the points; `None` without points. Points that share a bound share its
    /// derivative equally.
    #[must_use]
    pub fn around(points: &[Vec3<S>]) -> Option<Self> {
        let (&first, rest) = points.split_first()?;
        let mut spans = [Span::new(first.x), Span::new(first.y), Span::new(first.z)];
        for point in rest {
            let [x, y, z] = spans;
            spans = [x.or(point.x), y.or(point.y), z.or(point.z)];
        }
        let [x, y, z] = spans;
        Some(Aabb3::new(
            Vec3::new(x.least(), y.least(), z.least()),
            Vec3::new(x.most(), y.most(), z.most()),
        ))
    }
    /// Returns the smallest box around at least one point; points that share a bound share its derivative equally.
    #[inline(always)]
    pub(crate) fn of<const N: usize>(points: [Vec3<S>; N]) -> Self {
        const { assert!(N > 0, "there is no box around no points") };
        let span = |of: fn(Vec3<S>) -> S| {
            let first = Span::new(of(points[0]));
            points[1..].iter().fold(first, |span, &p| span.or(of(p)))
        };
        let (x, y, z) = (span(|p| p.x), span(|p| p.y), span(|p| p.z));
        Aabb3::new(
            Vec3::new(x.least(), y.least(), z.least()),
            Vec3::new(x.most(), y.most(), z.most()),
        )
    }
    /// Returns the size along x, y and z.
    #[must_use]
    #[inline(always)]
    pub fn size(self) -> Vec3<S> {
        self.max - self.min
    }
    /// Returns the centre.
    #[must_use]
    #[inline(always)]
    pub fn center(self) -> Vec3<S> {
        let half = S::lit(0.5);
        self.min * half + self.max * half
    }
    /// Returns the volume.
    #[must_use]
    #[inline(always)]
    pub fn volume(self) -> S {
        let size = self.size();
        size.x * size.y * size.z
    }
    /// Returns the area of all six faces.
    #[must_use]
    #[inline(always)]
    pub fn surface(self) -> S {
        let size = self.size();
        let half = size.x * size.y + size.y * size.z + size.z * size.x;
        half + half
    }
    /// Returns the corners: x changes fastest, z slowest; see [`FACES`].
    #[must_use]
    #[inline(always)]
    pub fn corners(self) -> [Vec3<S>; 8] {
        let (a, b) = (self.min, self.max);
        [
            a,
            Vec3::new(b.x, a.y, a.z),
            Vec3::new(a.x, b.y, a.z),
            Vec3::new(b.x, b.y, a.z),
            Vec3::new(a.x, a.y, b.z),
            Vec3::new(b.x, a.y, b.z),
            Vec3::new(a.x, b.y, b.z),
            b,
        ]
    }
    /// Returns the shared part. Inverted (`min > max`, not valid) when the boxes are apart. Ties share the derivative.
    #[must_use]
    #[inline(always)]
    pub fn meet(self, other: Self) -> Self {
        Aabb3::new(self.min.most(other.min), self.max.least(other.max))
    }
    /// Returns the smallest box around both. Ties share the derivative.
    #[must_use]
    #[inline(always)]
    pub fn join(self, other: Self) -> Self {
        Aabb3::new(self.min.least(other.min), self.max.most(other.max))
    }
    /// Returns `true` where the point is in the box; the border belongs to it.
    #[must_use]
    #[inline(always)]
    pub fn contains(self, point: Vec3<S>) -> S::Mask {
        let (low, high) = (self.min, self.max);
        (low.x.at_most(point.x) & point.x.at_most(high.x))
            & (low.y.at_most(point.y) & point.y.at_most(high.y))
            & (low.z.at_most(point.z) & point.z.at_most(high.z))
    }
    /// Returns the box seen from above, without its height.
    #[must_use]
    #[inline(always)]
    pub fn birds_eye(self) -> Aabb2<S> {
        Aabb2 {
            min: Vec2::new(self.min.x, self.min.y),
            max: Vec2::new(self.max.x, self.max.y),
        }
    }
}
