//! Inertia of solids of unit density about their centroids.
//!
//! The angular momentum of a solid that turns at ω is `ρ I ω`, ρ its density. Moments are in the fifth power of the
//! unit of length. About another point at an offset d from the centroid, `V (d² 1 − d dᵀ)` is added, V the volume
//! ([`displaced`]).
//!
//! Every sum is of numbers that are not negative, so that thin solids keep the digits of their small moments.
use crate::arrays::Each;
use crate::shape::{
    Aabb3, Capsule3, Cone, Cylinder, Ellipsoid, Obb3, RoundBox3, Sphere, Symmetric3, Tetrahedron,
    YawBox3,
};
use crate::{Scalar, Vec3};
use std::f64::consts::PI;

/// Returns the inertia of what has these second moments, `∫ x xᵀ dV`: their trace less them.
#[must_use]
#[inline(always)]
pub fn of_second_moments<S: Scalar>(m: Symmetric3<S>) -> Symmetric3<S> {
    Symmetric3::new(m.yy + m.zz, m.xx + m.zz, m.xx + m.yy, -m.xy, -m.xz, -m.yz).canonical()
}

/// Returns the inertia about a point at an offset from the centroid, given that about the centroid and the volume.
///
/// ```
/// use geograd::{Sphere, Vec3, measure::inertia::displaced};
/// let ball = Sphere::new(Vec3::new(0.0_f64, 0.0, 0.0), 1.0);
/// let far = displaced(ball.inertia(), ball.volume(), Vec3::new(2.0, 0.0, 0.0));
/// assert_eq!(far.xx, ball.inertia().xx);
/// assert!((far.yy - ball.inertia().yy - 4.0 * ball.volume()).abs() < 1e-14);
/// ```
#[must_use]
#[inline]
pub fn displaced<S: Scalar>(inertia: Symmetric3<S>, volume: S, by: Vec3<S>) -> Symmetric3<S> {
    inertia + of_second_moments(Symmetric3::square_of(by)) * volume
}

/// Returns the inertia of a solid of revolution, by its moments about its axis and across it.
#[inline(always)]
fn round<S: Scalar>(way: Vec3<S>, along: S, across: S) -> Symmetric3<S> {
    let none = way.length().at_most(S::zero());
    // Without an axis both moments are equal.
    let up = Vec3::new(S::zero(), S::zero(), S::one());
    let axis = Symmetric3::square_of(Vec3::select(none, up, way.normalize_or_zero()));
    let plane = of_second_moments(axis);
    (axis * along + plane * across).canonical()
}

/// Returns the moments of a box about its own axes, by its sizes.
#[inline(always)]
fn of_sizes<S: Scalar>(size: Vec3<S>) -> [S; 3] {
    let share = size.x * size.y * size.z * S::lit(1.0 / 12.0);
    let (x, y, z) = (size.x * size.x, size.y * size.y, size.z * size.z);
    [share * (y + z), share * (x + z), share * (x + y)]
}

#[inline(always)]
fn diagonal<S: Scalar>([x, y, z]: [S; 3]) -> Symmetric3<S> {
    let zero = S::zero();
    Symmetric3::new(x, y, z, zero, zero, zero)
}

impl<S: Scalar> Aabb3<S> {
    /// Returns the inertia about the centre by unit density.
    #[must_use]
    #[inline]
    pub fn inertia(self) -> Symmetric3<S> {
        diagonal(of_sizes(self.max - self.min)).canonical()
    }
}

impl<S: Scalar> YawBox3<S> {
    /// Returns the inertia about the centre by unit density.
    #[must_use]
    #[inline]
    pub fn inertia(self) -> Symmetric3<S> {
        let [x, y, z] = of_sizes(self.size);
        let (sin, cos) = self.heading.sin_cos();
        let (ss, cc, sc) = (sin * sin, cos * cos, sin * cos);
        let zero = S::zero();
        let beside = sc * (x - y);
        Symmetric3::new(x * cc + y * ss, x * ss + y * cc, z, beside, zero, zero).canonical()
    }
}

impl<S: Scalar> Obb3<S> {
    /// Returns the inertia about the centre by unit density.
    ///
    /// ```
    /// use geograd::{Obb3, Rotation3, Vec3};
    /// let plank = Obb3::new(Vec3::new(7.0, 0.0, 0.0), Vec3::new(1.0, 2.0, 6.0), Rotation3::identity());
    /// let found = plank.inertia();
    /// assert_eq!((found.xx, found.yy, found.zz), (40.0, 37.0, 5.0));
    /// ```
    #[must_use]
    #[inline]
    pub fn inertia(self) -> Symmetric3<S> {
        let own = diagonal(of_sizes(self.size));
        own.turned(self.rotation).canonical()
    }
}

impl<S: Scalar> Ellipsoid<S> {
    /// Returns the inertia about the centre by unit density.
    ///
    /// ```
    /// use geograd::{Ellipsoid, Rotation3, Vec3};
    /// let egg = Ellipsoid::new(Vec3::new(7.0_f64, 0.0, 0.0), Vec3::new(1.0, 2.0, 3.0), Rotation3::identity());
    /// let found = egg.inertia();
    /// assert!((found.xx - egg.volume() * 13.0 / 5.0).abs() < 1e-13);
    /// ```
    #[must_use]
    #[inline]
    pub fn inertia(self) -> Symmetric3<S> {
        // A box with these sizes and the volume of the ellipsoid has 5/3 of its moments.
        let [x, y, z] = of_sizes(self.semi_axes + self.semi_axes);
        let share = S::lit(PI / 10.0);
        diagonal([x * share, y * share, z * share])
            .turned(self.rotation)
            .canonical()
    }
}

impl<S: Scalar> Sphere<S> {
    /// Returns the inertia about the centre by unit density.
    #[must_use]
    #[inline]
    pub fn inertia(self) -> Symmetric3<S> {
        let square = self.radius * self.radius;
        Symmetric3::isotropic(square * square * self.radius * S::lit(8.0 / 15.0 * PI)).canonical()
    }
}

impl<S: Scalar> Cylinder<S> {
    /// Returns the inertia about the centroid by unit density; zero where it has no height.
    #[must_use]
    #[inline]
    pub fn inertia(self) -> Symmetric3<S> {
        let way = self.end - self.start;
        let (height, square) = (way.length(), self.radius * self.radius);
        let volume = square * height * S::lit(PI);
        let across = volume * (square * S::lit(3.0) + height * height) * S::lit(1.0 / 12.0);
        round(way, volume * square.halved(), across)
    }
}

impl<S: Scalar> Cone<S> {
    /// Returns the inertia about the centroid by unit density; zero where it has no height.
    #[must_use]
    #[inline]
    pub fn inertia(self) -> Symmetric3<S> {
        let way = self.base - self.apex;
        let (height, square) = (way.length(), self.radius * self.radius);
        let volume = square * height * S::lit(PI / 3.0);
        let across = volume * (square * S::lit(4.0) + height * height) * S::lit(3.0 / 80.0);
        round(way, volume * square * S::lit(0.3), across)
    }
}

impl<S: Scalar> Capsule3<S> {
    /// Returns the inertia about the centroid by unit density. Kink: both ends at one point, with derivative zero by
    /// them.
    #[must_use]
    #[inline]
    pub fn inertia(self) -> Symmetric3<S> {
        let way = self.end - self.start;
        let (height, r) = (way.length(), self.radius);
        let (square, long) = (r * r, height * height);
        let (tube, ball) = (
            square * height * S::lit(PI),
            square * r * S::lit(4.0 / 3.0 * PI),
        );
        let halves = square * S::lit(0.4);
        let apart = (long + r * height * S::lit(1.5)) * S::lit(0.25);
        let own = square * S::lit(0.25) + long * S::lit(1.0 / 12.0);
        round(
            way,
            tube * square.halved() + ball * halves,
            tube * own + ball * (halves + apart),
        )
    }
}

impl<S: Scalar> Tetrahedron<S> {
    /// Returns the inertia about the centroid by unit density. Kink: volume zero, with derivative zero by it.
    #[must_use]
    #[inline]
    pub fn inertia(self) -> Symmetric3<S> {
        let center = self.center();
        let [a, b, c, d] = self
            .corners()
            .each_as(|corner| Symmetric3::square_of(corner - center));
        of_second_moments((a + b + (c + d)) * (self.volume() * S::lit(0.05)))
    }
}

impl<S: Scalar> RoundBox3<S> {
    /// Returns the inertia about the centre by unit density: the sum over the box inside, the slabs beyond its faces,
    /// quarters of cylinders along its edges, and eighths of a ball at its corners.
    #[must_use]
    #[inline]
    pub fn inertia(self) -> Symmetric3<S> {
        let (size, r) = (self.inner.size, self.radius);
        let (a, b, c) = (size.x.halved(), size.y.halved(), size.z.halved());
        let (x, y, z) = (half(b, c, a, r), half(a, c, b, r), half(a, b, c, r));
        let own = diagonal([y + z, x + z, x + y]);
        own.turned(self.inner.rotation).canonical()
    }
}

/// Returns the second moment along the axis of the third of three half sizes of a box with edges of a radius.
#[inline(always)]
fn half<S: Scalar>(a: S, b: S, c: S, r: S) -> S {
    let (n, square, r2) = (S::lit, c * c, r * r);
    let core = (a * b + (a + b) * r + r2 * n(PI / 4.0)) * square * c * n(8.0 / 3.0);
    let ahead = a * b * r * (square * n(3.0) + c * r * n(3.0) + r2) * n(8.0 / 3.0);
    let edge = square * n(PI / 4.0) + c * r * n(2.0 / 3.0) + r2 * n(PI / 16.0);
    let corner = square * n(PI / 6.0) + c * r * n(PI / 8.0) + r2 * n(PI / 30.0);
    core + ahead + ((a + b) * edge + r * corner) * r2 * n(8.0)
}
