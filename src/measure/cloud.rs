//! Centroid and covariance of points of space.
//!
//! Points are relative to their own centroid, as a constant, so that a large distance from the origin costs no digits.
use crate::{Scalar, Shape, Symmetric3, Vec3};

/// The sums over some points of a cloud, relative to a point.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
pub struct CloudSums<S> {
    /// The number of points.
    #[shape(number)]
    pub count: S,
    /// The sum of their offsets.
    pub first: Vec3<S>,
    /// The sum of the offsets' outer products.
    pub second: Symmetric3<S>,
}

/// Returns the points' centroid as a constant; zero without points.
#[must_use]
pub fn place_of<S: Scalar>(points: &[Vec3<S>]) -> Vec3<S> {
    let Some(&start) = points.first() else {
        return Vec3::zero();
    };
    let (start, share) = (start.constant(), S::one().over(S::lit(points.len() as f64)));
    let offsets = points.iter().map(|&point| point.constant() - start);
    start + offsets.fold(Vec3::zero(), |sum, offset| sum + offset * share)
}

impl<S: Scalar> CloudSums<S> {
    /// Returns the sums of no point.
    #[must_use]
    pub fn empty() -> Self {
        CloudSums {
            count: S::zero(),
            first: Vec3::zero(),
            second: Symmetric3::isotropic(S::zero()),
        }
    }
    /// Returns the sums of one point, by its offset.
    #[must_use]
    #[inline(always)]
    pub fn of(offset: Vec3<S>) -> Self {
        CloudSums {
            count: S::one(),
            first: offset,
            second: Symmetric3::square_of(offset),
        }
    }
    /// Returns the sums of both.
    #[must_use]
    #[inline(always)]
    pub fn join(self, other: Self) -> Self {
        CloudSums {
            count: self.count + other.count,
            first: self.first + other.first,
            second: self.second + other.second,
        }
    }
    /// Returns one over the number of points; zero without points.
    #[inline(always)]
    fn share(self) -> S {
        let none = self.count.equals(S::zero());
        S::select(
            none,
            S::zero(),
            S::one().over(S::select(none, S::one(), self.count)),
        )
    }
    /// Returns the centroid of the points, given the point to which they were relative.
    #[must_use]
    #[inline(always)]
    pub fn centroid(self, place: Vec3<S>) -> Vec3<S> {
        (place + self.first * self.share()).canonical()
    }
    /// Returns the covariance of the points.
    #[must_use]
    #[inline(always)]
    pub fn covariance(self) -> Symmetric3<S> {
        let share = self.share();
        let mean = Symmetric3::square_of(self.first * share);
        (self.second * share + mean * -S::one()).canonical()
    }
}

fn sums_of<S: Scalar>(points: &[Vec3<S>], place: Vec3<S>) -> CloudSums<S> {
    let all = points.iter().map(|&point| CloudSums::of(point - place));
    all.fold(CloudSums::empty(), CloudSums::join)
}

/// Returns the mean of points of space; zero without points.
///
/// ```
/// use geograd::{Vec3, measure::cloud::centroid};
/// let cloud = [Vec3::new(0.0, 0.0, 0.0), Vec3::new(4.0, 2.0, 6.0)];
/// assert_eq!(centroid(&cloud), Vec3::new(2.0, 1.0, 3.0));
/// ```
#[must_use]
pub fn centroid<S: Scalar>(points: &[Vec3<S>]) -> Vec3<S> {
    let place = place_of(points);
    sums_of(points, place).centroid(place)
}

/// Returns the mean of the outer products of points' offsets from their centroid, in squares of the unit of length;
/// zero without points. The divisor is the number of points.
///
/// ```
/// use geograd::{Vec3, measure::cloud::covariance};
/// let cloud = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(3.0, 2.0, 0.0)];
/// let spread = covariance(&cloud);
/// assert_eq!((spread.xx, spread.yy, spread.xy, spread.zz), (1.0, 1.0, 1.0, 0.0));
/// ```
#[must_use]
pub fn covariance<S: Scalar>(points: &[Vec3<S>]) -> Symmetric3<S> {
    sums_of(points, place_of(points)).covariance()
}
