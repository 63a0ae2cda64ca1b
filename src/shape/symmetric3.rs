//! Symmetric matrices of space: inertia, covariance.
use crate::{Rotation3, Scalar, Shape, Vec3};
use std::ops::{Add, Mul};

/// A symmetric matrix with three rows: an inertia tensor, a covariance. Valid when finite.
///
/// ```
/// use geograd::{Symmetric3, Vec3};
/// let stretch = Symmetric3::new(2.0_f64, 3.0, 4.0, 0.0, 0.0, 1.0);
/// assert_eq!(stretch * Vec3::new(1.0, 0.0, 0.0), Vec3::new(2.0, 0.0, 0.0));
/// assert_eq!(stretch * Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 3.0, 1.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Symmetric3<S> {
    /// First row, first column.
    #[shape(number)]
    pub xx: S,
    /// Second row, second column.
    #[shape(number)]
    pub yy: S,
    /// Third row, third column.
    #[shape(number)]
    pub zz: S,
    /// First row, second column.
    #[shape(number)]
    pub xy: S,
    /// First row, third column.
    #[shape(number)]
    pub xz: S,
    /// Second row, third column.
    #[shape(number)]
    pub yz: S,
}

impl<S> Symmetric3<S> {
    /// Creates a matrix from its diagonal and the entries above it: those of the first row, then that of the second
    /// row.
    #[inline(always)]
    pub const fn new(xx: S, yy: S, zz: S, xy: S, xz: S, yz: S) -> Self {
        Symmetric3 {
            xx,
            yy,
            zz,
            xy,
            xz,
            yz,
        }
    }
}

impl<S: Scalar> Symmetric3<S> {
    /// Returns the multiple of the identity by a number.
    #[must_use]
    #[inline(always)]
    pub fn isotropic(x: S) -> Self {
        Symmetric3::new(x, x, x, S::zero(), S::zero(), S::zero())
    }
    /// Returns the outer product of a vector with itself.
    #[must_use]
    #[inline(always)]
    pub fn square_of(v: Vec3<S>) -> Self {
        Symmetric3::new(
            v.x * v.x,
            v.y * v.y,
            v.z * v.z,
            v.x * v.y,
            v.x * v.z,
            v.y * v.z,
        )
    }
    /// Returns the sum of the diagonal.
    #[must_use]
    #[inline(always)]
    pub fn trace(self) -> S {
        self.xx + self.yy + self.zz
    }
    /// Returns the determinant.
    #[must_use]
    #[inline]
    pub fn determinant(self) -> S {
        let rows = self.rows();
        rows[0].dot(rows[1].cross(rows[2]))
    }
    /// Returns the rows.
    #[must_use]
    #[inline(always)]
    pub fn rows(self) -> [Vec3<S>; 3] {
        [
            Vec3::new(self.xx, self.xy, self.xz),
            Vec3::new(self.xy, self.yy, self.yz),
            Vec3::new(self.xz, self.yz, self.zz),
        ]
    }
    /// Returns the matrix of the turned thing: `R M Rᵀ`.
    ///
    /// ```
    /// use geograd::{Rotation3, Symmetric3};
    /// let flat = Symmetric3::new(1.0_f64, 2.0, 3.0, 0.0, 0.0, 0.0);
    /// let turned = flat.turned(Rotation3::from_yaw(std::f64::consts::FRAC_PI_2));
    /// assert!((turned.xx - 2.0).abs() < 1e-15 && (turned.yy - 1.0).abs() < 1e-15);
    /// ```
    #[must_use]
    #[inline]
    pub fn turned(self, by: Rotation3<S>) -> Self {
        let [u, v, w] = by.axes();
        let column = |a: S, b: S, c: S| u * a + v * b + w * c;
        let x = column(self.xx, self.xy, self.xz);
        let y = column(self.xy, self.yy, self.yz);
        let z = column(self.xz, self.yz, self.zz);
        let part =
            |a: fn(Vec3<S>) -> S, b: fn(Vec3<S>) -> S| a(x) * b(u) + a(y) * b(v) + a(z) * b(w);
        Symmetric3::new(
            part(|p| p.x, |p| p.x),
            part(|p| p.y, |p| p.y),
            part(|p| p.z, |p| p.z),
            part(|p| p.x, |p| p.y),
            part(|p| p.x, |p| p.z),
            part(|p| p.y, |p| p.z),
        )
    }
    /// Returns every number with +0 for −0.
    #[must_use]
    #[inline(always)]
    pub fn canonical(self) -> Self {
        Symmetric3::new(
            self.xx.canonical(),
            self.yy.canonical(),
            self.zz.canonical(),
            self.xy.canonical(),
            self.xz.canonical(),
            self.yz.canonical(),
        )
    }
}

impl<S: Scalar> Add for Symmetric3<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Symmetric3::new(
            self.xx + other.xx,
            self.yy + other.yy,
            self.zz + other.zz,
            self.xy + other.xy,
            self.xz + other.xz,
            self.yz + other.yz,
        )
    }
}

impl<S: Scalar> Mul<S> for Symmetric3<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, by: S) -> Self {
        Symmetric3::new(
            self.xx * by,
            self.yy * by,
            self.zz * by,
            self.xy * by,
            self.xz * by,
            self.yz * by,
        )
    }
}

impl<S: Scalar> Mul<Vec3<S>> for Symmetric3<S> {
    type Output = Vec3<S>;
    #[inline(always)]
    fn mul(self, v: Vec3<S>) -> Vec3<S> {
        let [x, y, z] = self.rows();
        Vec3::new(x.dot(v), y.dot(v), z.dot(v))
    }
}
