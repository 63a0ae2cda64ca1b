//! Axis-aligned boxes in the plane.
use crate::error::{Flaw, Validate};
use crate::scalar::Span;
use crate::{Scalar, Shape, Vec2};

/// An axis-aligned box in the plane. Valid when finite and `min ≤ max`; zero size is valid.
///
/// ```
/// use geograd::Aabb2;
/// let a = Aabb2::new(0.0, 0.0, 2.0, 2.0);
/// let b = Aabb2::new(1.0, 1.0, 3.0, 3.0);
/// assert_eq!(a.meet(b), Aabb2::new(1.0, 1.0, 2.0, 2.0));
/// assert_eq!(a.iou(b), 1.0 / 7.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding, except(Sample))]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Aabb2<S> {
    /// The lower bounds.
    #[shape(at_most = "max")]
    pub min: Vec2<S>,
    /// The upper bounds.
    pub max: Vec2<S>,
}

impl<S> Aabb2<S> {
    /// Creates a box from lower and upper bounds, unchecked.
    #[inline(always)]
    pub const fn new(min_x: S, min_y: S, max_x: S, max_y: S) -> Self {
        Aabb2 {
            min: Vec2::new(min_x, min_y),
            max: Vec2::new(max_x, max_y),
        }
    }
}

impl<S: Scalar> Aabb2<S> {
    /// Returns the box itself.
    #[inline(always)]
    pub(crate) const fn bounding(self) -> Self {
        self
    }
    /// Creates a box from lower and upper bounds.
    ///
    /// # Errors
    ///
    /// When a bound is not finite or a lower one is above its upper one.
    pub fn try_new(min: Vec2<S>, max: Vec2<S>) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Aabb2 { min, max };
        made.validate().map(|()| made)
    }
    /// Returns the smallest box around the points; `None` without points. Points that share a bound share its
    /// derivative equally.
    #[must_use]
    pub fn around(points: &[Vec2<S>]) -> Option<Self> {
        let (&first, rest) = points.split_first()?;
        let (mut x, mut y) = (Span::new(first.x), Span::new(first.y));
        for point in rest {
            (x, y) = (x.or(point.x), y.or(point.y));
        }
        Some(Aabb2 {
            min: Vec2::new(x.least(), y.least()),
            max: Vec2::new(x.most(), y.most()),
        })
    }
    /// Returns width and height.
    #[must_use]
    #[inline(always)]
    pub fn size(self) -> Vec2<S> {
        self.max - self.min
    }
    /// Returns the centre.
    #[must_use]
    #[inline(always)]
    pub fn center(self) -> Vec2<S> {
        Vec2::new(
            self.min.x.halved() + self.max.x.halved(),
            self.min.y.halved() + self.max.y.halved(),
        )
    }
    /// Returns the area; infinite beyond the largest number.
    #[must_use]
    #[inline(always)]
    pub fn area(self) -> S {
        let size = self.size();
        size.x * size.y
    }
    /// Returns the length of the diagonal; derivative zero for a point.
    #[must_use]
    #[inline(always)]
    pub fn diagonal(self) -> S {
        self.size().length()
    }
    /// Returns the corners, counter-clockwise from the lower left.
    #[must_use]
    #[inline(always)]
    pub fn corners(self) -> [Vec2<S>; 4] {
        [
            self.min,
            Vec2::new(self.max.x, self.min.y),
            self.max,
            Vec2::new(self.min.x, self.max.y),
        ]
    }
    /// Returns the shared part. Inverted (`min > max`, not valid) when the boxes are apart. Ties share
    /// the derivative.
    #[must_use]
    #[inline(always)]
    pub fn meet(self, other: Self) -> Self {
        Aabb2 {
            min: self.min.most(other.min),
            max: self.max.least(other.max),
        }
    }
    /// Returns the smallest box around both. Ties share the derivative.
    #[must_use]
    #[inline(always)]
    pub fn join(self, other: Self) -> Self {
        Aabb2 {
            min: self.min.least(other.min),
            max: self.max.most(other.max),
        }
    }
    /// Returns `true` where the other box is in this one; borders belong to both.
    #[must_use]
    #[inline(always)]
    pub fn encloses(self, other: Self) -> S::Mask {
        self.contains(other.min) & self.contains(other.max)
    }
    /// Returns `true` where both boxes have a point in common; borders belong to both.
    ///
    /// ```
    /// use geograd::Aabb2;
    /// let (a, b) = (Aabb2::new(0.0_f64, 0.0, 2.0, 2.0), Aabb2::new(2.0, 1.0, 3.0, 2.0));
    /// assert!(a.touches(b) && !a.encloses(b));
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn touches(self, other: Self) -> S::Mask {
        let (x, y) = (
            self.min.x.at_most(other.max.x),
            self.min.y.at_most(other.max.y),
        );
        let across = other.min.x.at_most(self.max.x) & other.min.y.at_most(self.max.y);
        x & y & across
    }
    /// Returns `true` where the point is in the box; the border belongs to it.
    #[must_use]
    #[inline(always)]
    pub fn contains(self, point: Vec2<S>) -> S::Mask {
        self.min.x.at_most(point.x)
            & point.x.at_most(self.max.x)
            & self.min.y.at_most(point.y)
            & point.y.at_most(self.max.y)
    }
}

impl<S: std::fmt::Display> std::fmt::Display for Aabb2<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("[")?;
        self.min.fmt(f)?;
        f.write_str(" to ")?;
        self.max.fmt(f)?;
        f.write_str("]")
    }
}
